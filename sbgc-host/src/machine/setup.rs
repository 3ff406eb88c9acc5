//! How a machine is set up, and how its link stands.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::frame::Version;

/// Whether the port is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LinkState {
    /// It is.
    Open,
    /// It went away or fell silent, and is being opened again. Requests fail at once meanwhile.
    Reconnecting,
    /// It went away for good.
    Lost,
    /// After it was opened again, another board answered than before. It is left alone.
    Replaced,
    /// It was closed from this side.
    Closed,
}

/// How a machine is set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setup {
    /// The version in which frames go out at first.
    pub version: Version,
    /// Bits per second of the serial line; `None` where that is unknown or there is none.
    pub baud: Option<u32>,
    /// How long the bytes of one frame may stop coming before it is given up.
    pub gap: Duration,
    /// How long an attempt to register a stream may take.
    pub timeout: Duration,
    /// How often a stream is registered before that has failed.
    pub attempts: u32,
}

impl Default for Setup {
    fn default() -> Self {
        let (gap, timeout) = (Duration::from_millis(100), Duration::from_millis(500));
        Self { version: Version::V2, baud: None, gap, timeout, attempts: 3 }
    }
}

/// What tells one board from another: the front of the answer to a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The request, which has no payload and is answered under its own id.
    pub command: u8,
    /// The front of the answer; empty for a board that has no identity.
    pub front: Bytes,
}

/// Why the port has to be closed and opened again, or left alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// The board does not answer.
    Silent,
    /// Another board answers.
    Replaced,
}
