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

/// Parameters read from a TOML document.
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

/// A parameter file cannot be read.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}{problem}", Line(*.line))]
pub struct FileError {
    /// Line number, counted from 1, if known.
    pub line: Option<usize>,
    /// The problem.
    pub problem: Box<FileProblem>,
}

/// Problems in a parameter file.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileProblem {
    /// The text is not valid TOML.
    #[error("{0}")]
    Syntax(String),
    /// Unknown key.
    #[error("unknown key {name:?}; expected {expected}")]
    Key {
        /// Key as written.
        name: String,
        /// Keys that are valid there.
        expected: String,
    },
    /// Unknown parameter name.
    #[error(transparent)]
    Name(#[from] NameError),
    /// Invalid value for its parameter.
    #[error("{path} = {value}: {source}")]
    Value {
        /// Path of the parameter.
        path: String,
        /// Value as written.
        value: String,
        /// Cause.
        source: ValueError,
    },
    /// Wrong type of value.
    #[error("{path}: expected {expected}")]
    Form {
        /// Path of the value.
        path: String,
        /// Expected type.
        expected: String,
    },
    /// No table with parameters, as in a file that was cut short.
    #[error("no parameters; expected a table [board] or [profile.N]")]
    Empty,
    /// The same parameter is given twice.
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
    /// Firmware version the parameters come from.
    pub const fn firmware(&self) -> Option<FirmwareVersion> {
        self.firmware
    }

    /// Profiles in the file.
    pub fn profiles(&self) -> impl Iterator<Item = Profile> {
        self.profiles.keys().copied()
    }

    /// Whether the file has settings that belong to no profile.
    pub const fn has_shared(&self) -> bool {
        self.shared.is_some()
    }

    /// Keeps one profile only, without the settings that belong to no profile.
    #[must_use]
    pub fn only(mut self, kept: Profile) -> Self {
        self.profiles.retain(|profile, _| *profile == kept);
        self.shared = None;
        self
    }

    /// Assigns the only profile of the file to another profile number.
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
