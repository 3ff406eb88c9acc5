//! What can go wrong with parameters.

use sbgc_proto::units::FirmwareVersion;

use super::block::Place;
use super::catalog::NameError;
use super::parameter::ValueError;
use super::set::Difference;

/// [`std::result::Result`] with [`ParamsError`].
pub type Result<T, E = ParamsError> = std::result::Result<T, E>;

/// An operation on parameters failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ParamsError {
    /// The board, or the way to it.
    #[error(transparent)]
    Host(#[from] crate::Error),
    /// A name does not identify a parameter.
    #[error(transparent)]
    Name(#[from] NameError),
    /// A value is invalid for its parameter.
    #[error("{path} = {value}: {source}")]
    Value {
        /// The parameter.
        path: String,
        /// What was given.
        value: String,
        /// Why it does not fit.
        source: Box<ValueError>,
    },
    /// The firmware is too old.
    #[error("{what} needs firmware {since} or later, the board has {firmware}")]
    Firmware {
        /// What was asked for.
        what: &'static str,
        /// The first firmware that has it.
        since: FirmwareVersion,
        /// The board's firmware.
        firmware: FirmwareVersion,
    },
    /// The board names an active profile that does not exist.
    #[error("the board reports active profile {0}, which does not exist; expected 0 to 4")]
    NoActiveProfile(u8),
    /// A name of a profile is too long.
    #[error("a profile's name has at most 48 bytes, got {0}")]
    NameTooLong(usize),
    /// Writing was interrupted.
    #[error("{}{}; run the same command again to complete it: {source}", Written(.written), Left(.left))]
    Interrupted {
        /// The blocks that were written.
        written: Vec<Place>,
        /// The blocks that were not, the first of them perhaps in part.
        left: Vec<Place>,
        /// What happened.
        source: crate::Error,
    },
    /// Everything was written but could not be read back.
    #[error("{} but could not be verified; compare with `params diff`: {source}", Written(.written))]
    NotVerified {
        /// The blocks that were written.
        written: Vec<Place>,
        /// What happened.
        source: crate::Error,
    },
    /// The board holds other values than those written.
    #[error("the board did not take {}{}", Listed(.differences), if *.restored {
        "; the previous values were restored"
    } else {
        "; the previous values could not be restored, the backup has them"
    })]
    Mismatch {
        /// What was written, and what the board has instead.
        differences: Vec<Difference>,
        /// Whether the board has the previous values again.
        restored: bool,
    },
}

struct Written<'p>(&'p [Place]);
struct Left<'p>(&'p [Place]);
struct Listed<'d>(&'d [Difference]);

impl std::fmt::Display for Written<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0.is_empty() {
            return f.write_str("nothing was written");
        }
        write!(f, "written: {}", joined(self.0))
    }
}

impl std::fmt::Display for Left<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "; not written: {}", joined(self.0))
    }
}

impl std::fmt::Display for Listed<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let shown = self.0.iter().take(5).map(|difference| {
            let profile = difference.profile.map_or_else(String::new, |profile| format!(" of {profile}"));
            let (wanted, got) = (difference.show(&difference.a), difference.show(&difference.b));
            format!("{}{profile} (wrote {wanted}, read {got})", difference.path)
        });
        f.write_str(&shown.collect::<Vec<_>>().join(", "))?;
        match self.0.len().saturating_sub(5) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

fn joined(places: &[Place]) -> String {
    places.iter().map(Place::to_string).collect::<Vec<_>>().join(", ")
}

impl ParamsError {
    /// Error of the board or the link, if that is the cause.
    pub fn host(&self) -> Option<&crate::Error> {
        match self {
            Self::Host(error)
            | Self::Interrupted { source: error, .. }
            | Self::NotVerified { source: error, .. } => Some(error),
            _ => None,
        }
    }
}
