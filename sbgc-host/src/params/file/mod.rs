//! Parameters as a TOML document.
//!
//! ```toml
//! board_version = "3.6"
//! firmware = "2.73.5"
//!
//! [board]                            # what belongs to no profile
//! "profile_name[0]" = "Studio"
//! [board.raw]
//! CMD_READ_PROFILE_NAMES = "5374…"
//!
//! [profile.1]                        # every parameter by its path, in its unit
//! motors.roll.p = 30
//! rc_memory.pitch = -30.0  # deg
//! follow_mode = "FOLLOW_MODE_PITCH"
//! [profile.1.raw]                    # the blocks as they were, in hex
//! CMD_READ_PARAMS_3 = "001e14…"
//! ```
//!
//! A value wins over the raw block; a parameter whose line is missing stays as it is on the board; of a raw block only
//! the bytes that no parameter covers are taken, and a document without raw blocks is valid. A path may be written as
//! dotted keys, as one quoted key, or with tables and arrays.
//!
//! `read` takes a document apart, `write` makes one or brings one up to date, `apply` lays it over what a board has.

mod apply;
mod read;
mod write;

use std::collections::BTreeMap;

use sbgc_proto::units::FirmwareVersion;

use super::block::{Block, Profile};
use super::catalog::NameError;
use super::parameter::{Parameter, ValueError};

pub use apply::Applied;

/// The parameters of a file, by name.
#[derive(Clone, Debug, Default)]
pub struct ParameterFile {
    firmware: Option<FirmwareVersion>,
    shared: Option<Section>,
    profiles: BTreeMap<Profile, Section>,
}

/// The parameters of a profile, or those that belong to none.
#[derive(Clone, Debug, Default)]
pub(super) struct Section {
    /// Values by parameter, each as its bytes on the wire.
    values: Vec<(Parameter, Vec<u8>)>,
    raw: BTreeMap<Block, Vec<u8>>,
}

/// Why a file is not one of parameters.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}{problem}", Line(*.line))]
pub struct FileError {
    /// The line, from 1 on, where it can be told.
    pub line: Option<usize>,
    /// What is wrong there.
    pub problem: Box<FileProblem>,
}

/// What can be wrong in a file of parameters.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileProblem {
    /// It is not TOML.
    #[error("{0}")]
    Syntax(String),
    /// A key that has no meaning here.
    #[error("unknown key {name:?}; expected {expected}")]
    Key {
        /// The key.
        name: String,
        /// What may stand there.
        expected: String,
    },
    /// A name is not that of a parameter.
    #[error(transparent)]
    Name(#[from] NameError),
    /// A value does not fit its parameter.
    #[error("{path} = {value}: {source}")]
    Value {
        /// The parameter.
        path: String,
        /// What was given.
        value: String,
        /// Why it does not fit.
        source: ValueError,
    },
    /// A value has the wrong form.
    #[error("{path}: expected {expected}")]
    Form {
        /// Where.
        path: String,
        /// What it should be.
        expected: String,
    },
    /// The same parameter stands twice.
    #[error("{0} is given twice")]
    Twice(String),
}

struct Line(Option<usize>);

impl std::fmt::Display for Line {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.map_or(Ok(()), |line| write!(f, "line {line}: "))
    }
}

impl ParameterFile {
    /// The version of the firmware that the parameters come from.
    pub const fn firmware(&self) -> Option<FirmwareVersion> {
        self.firmware
    }

    /// The profiles in it.
    pub fn profiles(&self) -> impl Iterator<Item = Profile> {
        self.profiles.keys().copied()
    }

    /// Whether it has what belongs to no profile.
    pub const fn has_shared(&self) -> bool {
        self.shared.is_some()
    }

    /// The same parameters with only `kept`; what belongs to no profile goes, too.
    #[must_use]
    pub fn only(mut self, kept: Profile) -> Self {
        self.profiles.retain(|profile, _| *profile == kept);
        self.shared = None;
        self
    }

    /// The same parameters as those of another profile, where there is just one.
    #[must_use]
    pub fn moved_to(mut self, to: Profile) -> Self {
        if self.profiles.len() == 1
            && let Some((_, section)) = self.profiles.pop_first()
        {
            self.profiles.insert(to, section);
        }
        self
    }

    /// Whether the parameters come from a firmware with the same major and minor version.
    pub fn is_for(&self, firmware: FirmwareVersion) -> bool {
        let generation = |version: FirmwareVersion| (version.parts().0, version.parts().1);
        self.firmware.is_some_and(|own| generation(own) == generation(firmware))
    }
}
