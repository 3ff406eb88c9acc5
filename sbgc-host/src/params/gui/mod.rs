//! Files of the vendor's GUI, with the ending `.profile`: what they mean for parameters.
//!
//! They are XML of Java objects, and nobody has published what their elements mean. `elements.txt` has what is known of
//! each, and how surely: numbers that are `sure` are parameters in a known scale; `likely` ones, calibrations of one
//! machine and what can end the connection are written on request only; everything else is never written, and named
//! where it holds something.
//!
//! A file is refused as a whole where anything in it is not understood in its form, for then it may be of another
//! version. `xml` reads elements, `content` what they hold, `element` is the table, `read` gives them their meaning, `apply` lays them over what a
//! board has, `template` puts a board's values into a file that the GUI saved.

mod apply;
mod content;
mod element;
mod read;
mod template;
mod xml;

use std::ops::Range;

use sbgc_proto::units::FirmwareVersion;

use self::element::{Class, Element};
use super::parameter::{Parameter, ValueError};

pub use apply::Include;
pub use template::Filled;

/// From this firmware on gains have another scale, and what the GUI then writes is not known.
const OTHER_GAINS: FirmwareVersion = FirmwareVersion::new(2, 73, 1);

/// The elements with gains.
const GAINS: [&str; 4] = ["P", "I", "D", "pid__gain"];

/// A file of the vendor's GUI, checked.
#[derive(Clone, Debug)]
pub struct GuiFile {
    firmware: FirmwareVersion,
    board: Reading,
    profiles: Vec<Reading>,
    /// Whether it has one profile without saying which.
    single: bool,
}

/// Contents of one part of a file.
#[derive(Clone, Debug, Default)]
struct Reading {
    numbers: Vec<Number>,
    /// Elements that are never written and hold something, with what they hold.
    held: Vec<String>,
}

/// A number of the file with the parameter that it is.
#[derive(Clone, Debug)]
struct Number {
    element: &'static Element,
    parameter: Parameter,
    /// The number of the wire; of a part of a parameter, that part.
    raw: i64,
    /// The bytes of the number in the file.
    content: Range<usize>,
}

impl Number {
    /// The bits of the parameter that it is, and how far they stand from the lowest.
    fn mask(&self) -> (i64, u32) {
        match self.element.bits {
            Some((low, width)) => (((1 << width) - 1) << low, low),
            None => ((1 << (8 * self.parameter.size)) - 1, 0),
        }
    }
}

/// A file of the GUI is refused.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}{problem}", match line { Some(line) => format!("line {line}: "), None => String::new() })]
pub struct GuiError {
    /// Line number, counted from 1, if known.
    pub line: Option<usize>,
    /// The problem.
    pub problem: Box<GuiProblem>,
}

/// Reasons to refuse a file of the GUI.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GuiProblem {
    /// Not well-formed XML.
    #[error("not XML: {0}")]
    Xml(String),
    /// Has a document type declaration.
    #[error("a document type is not allowed")]
    DocumentType,
    /// An element has an attribute, such as a reference to another.
    #[error("<{0}> has an attribute, which is not understood")]
    Attribute(String),
    /// Null value.
    #[error("<null/> is not understood")]
    Null,
    /// Unexpected root element.
    #[error("the root is <{0}>, expected <saved-configuration>")]
    Root(String),
    /// Required element missing.
    #[error("<{0}> is missing")]
    Missing(&'static str),
    /// Duplicate element.
    #[error("<{0}> stands twice")]
    Twice(String),
    /// Unexpected content of an element.
    #[error("<{element}>: expected {expected}")]
    Form {
        /// The element.
        element: String,
        /// What it should hold.
        expected: String,
    },
    /// Number out of the parameter's range.
    #[error("<{element}> {value}: {source}")]
    Value {
        /// The element.
        element: String,
        /// The number.
        value: String,
        /// Why it does not fit.
        source: ValueError,
    },
    /// Number that is not a value of its parameter.
    #[error("<{element}> {value}: {problem}")]
    Number {
        /// The element.
        element: String,
        /// The number.
        value: String,
        /// Why not.
        problem: String,
    },
}

impl GuiFile {
    /// Whether a text is meant to be such a file.
    pub fn is_meant(text: &str) -> bool {
        text.trim_start_matches('\u{FEFF}').trim_start().starts_with('<')
    }

    /// The version of the firmware that the values come from.
    pub const fn firmware(&self) -> FirmwareVersion {
        self.firmware
    }

    /// Whether it comes from a firmware with the same major and minor version.
    pub fn is_for(&self, firmware: FirmwareVersion) -> bool {
        let generation = |version: FirmwareVersion| (version.parts().0, version.parts().1);
        generation(self.firmware) == generation(firmware)
    }

    /// How many profiles it has.
    pub fn profile_count(&self) -> usize {
        self.profiles.len()
    }

    /// Whether it has one profile without saying which of the five that is.
    pub const fn is_single(&self) -> bool {
        self.single
    }

    /// What is never written though it holds something: elements with what they hold.
    pub fn never_written(&self) -> impl Iterator<Item = &str> {
        self.board
            .held
            .iter()
            .chain(self.profiles.iter().flat_map(|profile| &profile.held))
            .map(String::as_str)
    }

    /// What must be included for the parameter with this path to be written.
    pub fn asks_for(&self, path: &str) -> Vec<Include> {
        let readings = std::iter::once(&self.board).chain(&self.profiles);
        let numbers = readings.flat_map(|reading| &reading.numbers);
        let mut asked: Vec<Include> = numbers
            .filter(|number| number.parameter.path == path)
            .flat_map(|number| Include::asked_by(number.element))
            .collect();
        asked.sort_unstable();
        asked.dedup();
        asked
    }

    /// Whether gains mean the same in the file and on a board with this firmware.
    fn gains_are_known(&self, firmware: FirmwareVersion) -> bool {
        self.firmware < OTHER_GAINS && firmware < OTHER_GAINS
    }
}

impl Include {
    fn asked_by(element: &Element) -> impl Iterator<Item = Include> {
        let asked = [
            (element.class == Class::Likely, Include::Likely),
            (element.unit_specific, Include::UnitSpecific),
            (element.cuts_link, Include::Link),
        ];
        asked.into_iter().filter_map(|(asks, include)| asks.then_some(include))
    }
}
