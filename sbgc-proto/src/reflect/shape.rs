//! The description of fields as constant data.

use super::Number;
use crate::version::FirmwareVersion;

/// One declared field.
#[derive(Clone, Copy, Debug)]
pub struct FieldInfo {
    /// The field's name in Rust.
    pub name: &'static str,
    /// The spec's name.
    pub spec: &'static str,
    /// What it is, in a sentence.
    pub doc: &'static str,
    /// The unit of a plain number; where the type brings its own unit, empty.
    pub unit: &'static str,
    /// The allowed raw values, both ends included.
    pub range: Option<(f64, f64)>,
    /// The first firmware that uses it; `None` if that is unknown or the first of all.
    pub since: Option<FirmwareVersion>,
    /// Whether it is always on the wire.
    pub presence: Presence,
    /// Whether the protocol keeps it for later.
    pub reserved: bool,
    /// What it consists of.
    pub shape: Shape,
}

impl FieldInfo {
    /// Stands where a value is not a field of anything.
    pub(crate) const UNNAMED: FieldInfo = FieldInfo::new("", "", Shape::Struct(&[]));

    /// A field that is always there and says nothing more about itself.
    pub(crate) const fn new(name: &'static str, spec: &'static str, shape: Shape) -> Self {
        FieldInfo {
            name,
            spec,
            doc: "",
            unit: "",
            range: None,
            since: None,
            presence: Presence::Always,
            reserved: false,
            shape,
        }
    }
}

/// When a field is on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// In every payload.
    Always,
    /// Unless the payload ends before it.
    Tail,
    /// When this condition on earlier fields, or on what the request asked for, holds.
    When(&'static str),
}

/// What a value consists of.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// One number.
    Number(Number),
    /// Bytes; `least` and `most` are the same where their number is fixed.
    Bytes {
        /// The minimum.
        least: usize,
        /// The most.
        most: usize,
    },
    /// Text.
    Text {
        /// Maximum number of bytes.
        most: usize,
    },
    /// Fields one after the other.
    Struct(&'static [FieldInfo]),
    /// The same for each of several names: axes, components of a vector.
    Group {
        /// The names in wire order.
        names: &'static [&'static str],
        /// What each has.
        element: &'static Shape,
    },
    /// So many of the same.
    Array {
        /// How many.
        count: usize,
        /// What each is.
        element: &'static Shape,
    },
    /// As many of the same as the payload says.
    List {
        /// The most.
        most: usize,
        /// What each is.
        element: &'static Shape,
    },
}
