//! How a link is set up.

use std::time::Duration;

use sbgc_proto::frame::Version;

use crate::machine::Setup;

/// Nobody waits longer than this, thirty years; clocks have an end, too.
pub(crate) const LONGEST: Duration = Duration::from_hours(30 * 365 * 24);

/// In which version frames go out. Frames of both versions are always taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VersionChoice {
    /// Version 2, unless the handshake finds that the board knows version 1 only.
    #[default]
    Auto,
    /// This one.
    Only(Version),
}

impl VersionChoice {
    /// The version, if one is chosen.
    pub(crate) const fn only(self) -> Option<Version> {
        match self {
            Self::Auto => None,
            Self::Only(version) => Some(version),
        }
    }

    /// The version to begin with.
    pub(crate) const fn first(self) -> Version {
        match self {
            Self::Auto => Version::V2,
            Self::Only(version) => version,
        }
    }
}

/// How a link is set up.
///
/// ```
/// use sbgc_host::Options;
///
/// let options = Options { baud: Some(115_200), ..Options::default() };
/// assert_eq!(options.attempts, 3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// In which version frames go out.
    pub version: VersionChoice,
    /// How long one attempt of a request may take. A request ends after the time of all its attempts, counted from the
    /// call.
    pub timeout: Duration,
    /// How often a read is sent before it has failed. Whatever changes something is sent once.
    pub attempts: u32,
    /// Bits a second of the serial line, `None` where that is not known or there is none.
    ///
    /// Nothing is sent faster than this.
    pub baud: Option<u32>,
    /// How long the bytes of one frame may stop coming before what came of it counts as noise.
    pub gap: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            version: VersionChoice::Auto,
            timeout: Duration::from_millis(500),
            attempts: 3,
            baud: None,
            gap: Duration::from_millis(100),
        }
    }
}

impl Options {
    pub(crate) fn setup(&self) -> Setup {
        Setup {
            version: self.version.first(),
            baud: self.baud,
            gap: self.gap,
            timeout: self.timeout,
            attempts: self.attempts,
        }
    }
}
