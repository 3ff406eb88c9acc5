//! Setting a field by its path.

use core::cell::Cell;
use core::fmt;

use super::walk::PAYLOAD;
use super::{FieldInfo, Meaning, Number};
use crate::OutOfRange;

/// Value whose fields can be set by path.
pub trait Assign<'a> {
    /// Sets the field that `path` names, or this value itself at the end of the path.
    ///
    /// # Errors
    /// If there is no such field, or it cannot have `value`. Nothing is changed in that case.
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError>;
}

/// Sets the field of `message` that `path` names, within its documented range.
///
/// The field gets exactly this value, except that scaled values are rounded to the nearest raw number.
///
/// # Errors
/// If there is no such field, or it cannot have `value`. Nothing is changed in that case.
pub fn set<'a, T: Assign<'a> + ?Sized>(
    message: &mut T,
    path: &str,
    value: Input<'a>,
) -> Result<(), AssignError> {
    message.assign(Steps { rest: path, length: path.len(), outside: None }, value, &FieldInfo::UNNAMED)
}

/// Sets the field of `message` that `path` names to any value that the wire can hold, and returns the documented range
/// if the value is outside of it.
///
/// Intended for messages that are displayed, stored or compared. Use [`set`] for messages that are sent to a board.
///
/// ```
/// use sbgc_proto::commands::Control;
/// use sbgc_proto::reflect::{self, Input};
/// use sbgc_proto::units::Angle;
///
/// let mut control = Control::default();
/// assert!(reflect::set(&mut control, "axes.yaw.angle", Input::Text("721")).is_err());
/// assert_eq!(reflect::force(&mut control, "axes.yaw.angle", Input::Text("90"))?, None);
/// assert_eq!(control.axes.yaw.angle, Angle::from_degrees(90.0));
/// # Ok::<(), sbgc_proto::reflect::AssignError>(())
/// ```
///
/// # Errors
/// If there is no such field, or the wire cannot hold `value`. Nothing is changed in that case.
pub fn force<'a, T: Assign<'a> + ?Sized>(
    message: &mut T,
    path: &str,
    value: Input<'a>,
) -> Result<Option<OutOfRange>, AssignError> {
    let outside = Cell::new(None);
    let steps = Steps { rest: path, length: path.len(), outside: Some(&outside) };
    message.assign(steps, value, &FieldInfo::UNNAMED)?;
    Ok(outside.take())
}

/// Sets the payload of an unknown command.
pub(crate) fn assign_payload<'a>(
    payload: &mut &'a [u8],
    mut path: Steps<'_>,
    value: Input<'a>,
) -> Result<(), AssignError> {
    path.next_name(PAYLOAD)?;
    payload.assign(path, value, &FieldInfo::UNNAMED)
}

/// New value of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input<'a> {
    /// Raw number on the wire.
    Raw(i64),
    /// Physical value in the unit of the field.
    Value(f64),
    /// Text: user input, or the displayed value of a field.
    ///
    /// For a number: a physical value with or without unit, the name of a value, names of flags joined by `|`,
    /// `NAME=VALUE` for parts of a number, a raw number in hex after `0x`, or one of these followed by another one with
    /// the same meaning in parentheses. For bytes: hex digits. For texts: see [`text_bytes`](super::text_bytes).
    Text(&'a str),
    /// Bytes of a field that is not a number.
    Bytes(&'a [u8]),
}

/// Rest of a path, and the policy for values at its end.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'p> {
    rest: &'p str,
    /// Length of the whole path.
    length: usize,
    /// Where values may be outside of their documented range, that range is noted here.
    outside: Option<&'p Cell<Option<OutOfRange>>>,
}

impl<'p> Steps<'p> {
    fn next_step(&mut self) -> &'p str {
        let rest = self.rest.strip_prefix('.').unwrap_or(self.rest);
        let end = match rest.strip_prefix('[') {
            Some(inner) => inner.find(']').map_or(rest.len(), |end| end + 2),
            None => rest.find(['.', '[']).unwrap_or(rest.len()),
        };
        let (step, rest) = rest.split_at_checked(end).unwrap_or((rest, ""));
        self.rest = rest;
        step
    }

    /// The next step as the name of one of `fields`.
    pub(crate) fn next_name(&mut self, fields: &'static [FieldInfo]) -> Result<&'static str, AssignError> {
        let step = self.next_step();
        let named = |field: &&FieldInfo| field.name == step || field.spec.eq_ignore_ascii_case(step);
        let at = self.before(step);
        fields.iter().find(named).map(|field| field.name).ok_or(AssignError::NoSuchField { at, fields })
    }

    /// The next step as the place of one of `names`, by name or number.
    pub(crate) fn next_of(&mut self, names: &'static [&'static str]) -> Result<usize, AssignError> {
        let step = self.next_step();
        let place = names.iter().position(|name| name.eq_ignore_ascii_case(step));
        place
            .or_else(|| index(step))
            .filter(|place| *place < names.len())
            .ok_or(AssignError::NoSuchPart { at: self.before(step), parts: names })
    }

    /// The next step as a number in brackets, below `count`.
    pub(crate) fn next_index(&mut self, count: usize) -> Result<usize, AssignError> {
        index(self.next_step()).filter(|index| *index < count).ok_or(AssignError::NoSuchElement { count })
    }

    /// Where in the whole path `step` begins, which was just taken.
    fn before(&self, step: &str) -> usize {
        self.length.saturating_sub(self.rest.len() + step.len())
    }

    /// The raw number for a field of this kind at the end of the path.
    pub(crate) fn number(
        self,
        number: &'static Number,
        value: Input<'_>,
        field: &'static FieldInfo,
    ) -> Result<i64, AssignError> {
        self.end()?;
        let raw = number.raw_of(value, field)?;
        match (number.outside(raw, field), self.outside) {
            (Some(range), None) => Err(AssignError::OutOfRange(range)),
            (range, Some(outside)) => {
                outside.set(range);
                Ok(raw)
            }
            (None, None) => Ok(raw),
        }
    }

    /// Whether the path ends here.
    pub(crate) fn is_at_end(&self) -> bool {
        self.rest.is_empty()
    }

    /// Nothing may follow a leaf.
    pub(crate) fn end(self) -> Result<(), AssignError> {
        if self.rest.is_empty() { Ok(()) } else { Err(AssignError::NoParts) }
    }
}

fn index(step: &str) -> Option<usize> {
    step.strip_prefix('[')?.strip_suffix(']')?.parse().ok()
}

impl<'a, T: Assign<'a> + Default> Assign<'a> for Option<T> {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        match self {
            Some(present) => present.assign(path, value, field),
            None => {
                let mut present = T::default();
                present.assign(path, value, field)?;
                *self = Some(present);
                Ok(())
            }
        }
    }
}

/// Reason why a field could not be set.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum AssignError {
    /// Unknown field name.
    NoSuchField {
        /// Offset of the name in the path.
        at: usize,
        /// Available fields.
        fields: &'static [FieldInfo],
    },
    /// Unknown name of a part.
    NoSuchPart {
        /// Offset of the name in the path.
        at: usize,
        /// Available parts.
        parts: &'static [&'static str],
    },
    /// Invalid element index.
    NoSuchElement {
        /// Number of elements, which are counted from 0.
        count: usize,
    },
    /// The path continues although the field has no parts.
    NoParts,
    /// Too many elements.
    TooMany {
        /// Maximum number of elements.
        most: usize,
    },
    /// Neither a number nor one of the names of the field.
    NotANumber {
        /// Kind of number, with the available names.
        number: Number,
    },
    /// The value would have to be rounded.
    Inexact,
    /// The number and the name given for it contradict each other.
    Contradiction,
    /// Number given for a field of bytes or text.
    NotBytes,
    /// Invalid hex digits for a field of bytes.
    NotHex,
    /// Unknown escape sequence in quoted text.
    Escape,
    /// The field borrows its bytes, so hex digits and escapes cannot be decoded into it.
    ///
    /// Decode them with [`hex_bytes`](super::hex_bytes) or [`text_bytes`](super::text_bytes), and pass
    /// [`Input::Bytes`].
    Borrowed {
        /// Whether the field is text.
        text: bool,
    },
    /// Wrong number of bytes.
    Length {
        /// Length of the field.
        expected: usize,
        /// Number of bytes given.
        got: usize,
    },
    /// The value is out of range.
    OutOfRange(OutOfRange),
}

impl fmt::Display for AssignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AssignError::NoSuchField { fields: [], .. } => f.write_str("unknown field; there are none"),
            AssignError::NoSuchField { fields, .. } => {
                f.write_str("unknown field; available: ")?;
                list(f, fields.iter().map(|field| field.name))
            }
            AssignError::NoSuchPart { parts, .. } => {
                f.write_str("unknown part; available: ")?;
                list(f, parts.iter().copied())
            }
            AssignError::NoSuchElement { count: 0 } => f.write_str("no such element; there are none"),
            AssignError::NoSuchElement { count: 1 } => {
                f.write_str("no such element; the only valid index is [0]")
            }
            AssignError::NoSuchElement { count } => {
                write!(f, "no such element; valid indices are [0] to [{}]", count - 1)
            }
            AssignError::NoParts => f.write_str("this field has no parts"),
            AssignError::TooMany { most } => write!(f, "too many elements; maximum {most}"),
            AssignError::NotANumber { number } => expected(f, number),
            AssignError::Inexact => {
                f.write_str("the field cannot hold this value exactly; expected a whole number")
            }
            AssignError::Contradiction => f.write_str("the value and the one in parentheses differ"),
            AssignError::NotBytes => f.write_str("expected bytes or text, got a number"),
            AssignError::NotHex => f.write_str("expected bytes as pairs of hex digits"),
            AssignError::Escape => f.write_str(
                r#"invalid escape; expected \\, \", \n, \r, \t, \0, \x and two hex digits, or \u{…}"#,
            ),
            AssignError::Borrowed { text: true } => f.write_str("expected a text without escapes"),
            AssignError::Borrowed { text: false } => f.write_str("expected bytes, got text"),
            AssignError::Length { expected, got } => write!(f, "expected {expected} bytes, got {got}"),
            AssignError::OutOfRange(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for AssignError {}

fn expected(f: &mut fmt::Formatter<'_>, number: &Number) -> fmt::Result {
    f.write_str("expected a number")?;
    match number.meaning {
        Meaning::Enum(labels) | Meaning::Flags(labels) | Meaning::Special(labels) => {
            f.write_str(" or one of ")?;
            list(f, labels.iter().map(|label| label.name))
        }
        Meaning::Bits(parts, _) => {
            f.write_str(", or NAME=VALUE for some of ")?;
            list(f, parts.iter().map(|part| part.name))
        }
        Meaning::Plain | Meaning::Shown { .. } => Ok(()),
    }
}

fn list<'n>(f: &mut fmt::Formatter<'_>, names: impl Iterator<Item = &'n str>) -> fmt::Result {
    let mut separator = "";
    for name in names {
        write!(f, "{separator}{name}")?;
        separator = ", ";
    }
    Ok(())
}
