//! Setting a field by its path.

use core::fmt;

use super::{FieldInfo, Meaning, Number};

/// A value whose fields can be set by path.
pub trait Assign<'a> {
    /// Sets what `path` names, or this value itself at the end of the path.
    ///
    /// # Errors
    /// When the path names nothing here, or `value` is not one that the field can have. Nothing is changed then.
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError>;
}

/// Sets the field of `message` that `path` names.
///
/// # Errors
/// When there is no such field, or `value` is not one that it can have. Nothing is changed then.
pub fn set<'a, T: Assign<'a>>(message: &mut T, path: &str, value: Input<'a>) -> Result<(), AssignError> {
    message.assign(Steps { rest: path }, value, &FieldInfo::UNNAMED)
}

/// A value for a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input<'a> {
    /// The number as it stands on the wire.
    Raw(i64),
    /// A physical value in the field's unit.
    Value(f64),
    /// What a person types: a physical value, the name of a value, names of flags joined by `|`, a raw number in hex
    /// after `0x`, or the text of a text field.
    Text(&'a str),
    /// The bytes of a field that is not a number.
    Bytes(&'a [u8]),
}

impl<'a> Input<'a> {
    /// The bytes, and whether they are text.
    pub(crate) fn bytes(self) -> Result<(&'a [u8], bool), AssignError> {
        match self {
            Input::Bytes(bytes) => Ok((bytes, false)),
            Input::Text(text) => Ok((text.as_bytes(), true)),
            Input::Raw(_) | Input::Value(_) => Err(AssignError::NotBytes),
        }
    }
}

/// The part of a path that is still to go.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'p> {
    rest: &'p str,
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
        fields.iter().find(named).map(|field| field.name).ok_or(AssignError::NoSuchField { fields })
    }

    /// The next step as the place of one of `names`, by name or number.
    pub(crate) fn next_of(&mut self, names: &'static [&'static str]) -> Result<usize, AssignError> {
        let step = self.next_step();
        let place = names.iter().position(|name| name.eq_ignore_ascii_case(step));
        place
            .or_else(|| index(step))
            .filter(|place| *place < names.len())
            .ok_or(AssignError::NoSuchPart { parts: names })
    }

    /// The next step as a number in brackets, below `count`.
    pub(crate) fn next_index(&mut self, count: usize) -> Result<usize, AssignError> {
        index(self.next_step()).filter(|index| *index < count).ok_or(AssignError::NoSuchElement { count })
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

/// Why a field could not be set.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum AssignError {
    /// No field has that name.
    NoSuchField {
        /// The fields that are there.
        fields: &'static [FieldInfo],
    },
    /// The field's parts have other names.
    NoSuchPart {
        /// The parts that are there.
        parts: &'static [&'static str],
    },
    /// The field's elements have numbers.
    NoSuchElement {
        /// How many there can be; they count from 0.
        count: usize,
    },
    /// The path goes on, but the field has no parts.
    NoParts,
    /// More elements than there can be.
    TooMany {
        /// How many there can be.
        most: usize,
    },
    /// Neither a number nor one of the names that the field knows.
    NotANumber {
        /// What the field knows.
        number: Number,
    },
    /// Bytes or text are wanted.
    NotBytes,
    /// Another number of bytes than the field has.
    Length {
        /// The bytes it has.
        expected: usize,
        /// The bytes that were given.
        got: usize,
    },
    /// Beyond what the field may have.
    OutOfRange {
        /// The least physical value.
        least: f64,
        /// The greatest physical value.
        most: f64,
        /// Their unit, empty when they have none.
        unit: &'static str,
    },
}

impl fmt::Display for AssignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AssignError::NoSuchField { fields: [] } => f.write_str("no such field: there are none"),
            AssignError::NoSuchField { fields } => {
                f.write_str("no such field; there are ")?;
                list(f, fields.iter().map(|field| field.name))
            }
            AssignError::NoSuchPart { parts } => {
                f.write_str("no such part; there are ")?;
                list(f, parts.iter().copied())
            }
            AssignError::NoSuchElement { count } => {
                write!(f, "no such element; say which in brackets, [0] to [{}]", count.saturating_sub(1))
            }
            AssignError::NoParts => f.write_str("this field has no parts"),
            AssignError::TooMany { most } => write!(f, "at most {most} elements fit"),
            AssignError::NotANumber { number } => {
                f.write_str("not a number")?;
                match number.meaning {
                    Meaning::Enum(labels) | Meaning::Flags(labels) | Meaning::Special(labels) => {
                        f.write_str(" nor one of ")?;
                        list(f, labels.iter().map(|label| label.name))
                    }
                    Meaning::Bits(parts, _) => {
                        f.write_str(", nor NAME=VALUE for some of ")?;
                        list(f, parts.iter().map(|part| part.name))
                    }
                    Meaning::Plain | Meaning::Shown(_) => Ok(()),
                }
            }
            AssignError::NotBytes => f.write_str("bytes or text are wanted, not a number"),
            AssignError::Length { expected, got } => {
                write!(f, "{got} bytes do not fit a field of {expected}")
            }
            AssignError::OutOfRange { least, most, unit } => {
                write!(f, "out of range, which is {least} to {most}")?;
                if unit.is_empty() { Ok(()) } else { write!(f, " {unit}") }
            }
        }
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

impl core::error::Error for AssignError {}
