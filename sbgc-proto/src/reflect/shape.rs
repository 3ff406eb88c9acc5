//! Description of fields as constant data.

use super::Number;
use crate::version::FirmwareVersion;

/// Description of a field.
#[derive(Clone, Copy, Debug)]
pub struct FieldInfo {
    /// Name in Rust.
    pub name: &'static str,
    /// Spec name.
    pub spec: &'static str,
    /// Description in one sentence.
    pub doc: &'static str,
    /// Unit of a plain number; empty if the type defines the unit.
    pub unit: &'static str,
    /// Minimum and maximum allowed raw value.
    pub range: Option<(f64, f64)>,
    /// First firmware that uses the field; `None` if that is unknown or the first of all.
    pub since: Option<FirmwareVersion>,
    /// Condition for its presence in a payload.
    pub presence: Presence,
    /// Whether the field is reserved.
    pub reserved: bool,
    /// Structure of the value.
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

/// Condition for the presence of a field in a payload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// Present in every payload.
    Always,
    /// Present unless the payload ends before it.
    Tail,
    /// Present if this condition on earlier fields, or on the request, holds.
    When(&'static str),
}

/// Structure of a value.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Number.
    Number(Number),
    /// Bytes; `least` equals `most` if their number is fixed.
    Bytes {
        /// Minimum number of bytes.
        least: usize,
        /// The most.
        most: usize,
    },
    /// Text.
    Text {
        /// Maximum number of bytes.
        most: usize,
    },
    /// Fields, one after the other.
    Struct(&'static [FieldInfo]),
    /// Elements with names: axes, or components of a vector.
    Group {
        /// Names in wire order.
        names: &'static [&'static str],
        /// Structure of each element.
        element: &'static Shape,
    },
    /// Fixed number of elements.
    Array {
        /// Number of elements.
        count: usize,
        /// Structure of each element.
        element: &'static Shape,
    },
    /// Variable number of elements.
    List {
        /// The most.
        most: usize,
        /// Structure of each element.
        element: &'static Shape,
    },
}
