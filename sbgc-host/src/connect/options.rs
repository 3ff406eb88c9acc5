//! How a board is looked for and connected.

use std::sync::Arc;
use std::time::Duration;

use crate::gimbal::Options;
use crate::transport::{Io, Parity};

/// What is put between a port and the driver whenever the port is opened, such as a recording.
pub type Wrap = Arc<dyn Fn(Io) -> Io + Send + Sync>;

/// Whether a port that is lost is opened again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reconnect {
    /// Until the link is closed.
    #[default]
    Always,
    /// If the same board is there again within this time.
    Within(Duration),
    /// Not at all: the link ends.
    Never,
}

impl Reconnect {
    /// For how long it is looked for, if it is.
    pub(super) fn within(self) -> Option<Duration> {
        match self {
            Self::Always => Some(Duration::MAX),
            Self::Within(time) => Some(time),
            Self::Never => None,
        }
    }
}

/// How a board is looked for and connected.
///
/// ```
/// use sbgc_host::ConnectOptions;
/// use sbgc_host::transport::Parity;
///
/// let options = ConnectOptions { baud: Some(115_200), parity: Some(Parity::None), ..ConnectOptions::default() };
/// assert_eq!(options.reconnect, sbgc_host::Reconnect::Always);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConnectOptions {
    /// Bits per second of a serial line; `None` finds them.
    pub baud: Option<u32>,
    /// Parity of a serial line; `None` finds it.
    pub parity: Option<Parity>,
    /// How the link is set up. The bit rate comes from the line.
    pub link: Options,
    /// How long a board may take to answer in one combination; `None` is as long as a request where there is one
    /// combination only, and 200 ms where there are many.
    pub patience: Option<Duration>,
    /// Whether a port that is lost is opened again.
    pub reconnect: Reconnect,
}

impl Default for ConnectOptions {
    fn default() -> Self {
        Self {
            baud: None,
            parity: None,
            link: Options::default(),
            patience: None,
            reconnect: Reconnect::Always,
        }
    }
}
