//! What can go wrong between bytes and messages.

use core::fmt;

/// A payload that is not the message it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum DecodeError {
    /// The payload is shorter than the message.
    TooShort {
        /// The spec's name of the command.
        command: &'static str,
        /// The fewest bytes that the message has.
        needed: usize,
        /// The bytes that came.
        got: usize,
    },
    /// The payload ends within a field whose place or length varies.
    Truncated {
        /// The spec's name of the command.
        command: &'static str,
        /// The spec's name of the field.
        field: &'static str,
        /// Where in the payload the field starts.
        offset: usize,
        /// The bytes that the field needs.
        needed: usize,
        /// The bytes that were left for it.
        got: usize,
    },
    /// The command has several forms, told apart by length, and none of this one.
    NoSuchForm {
        /// The spec's name of the command.
        command: &'static str,
        /// The bytes that came.
        got: usize,
    },
    /// A value says of itself, or was described, to have a type that nobody knows, so that its length is not known.
    UnknownType {
        /// The spec's name of the command.
        command: &'static str,
        /// The spec's name of the field.
        field: &'static str,
        /// The number of the type.
        raw: u8,
    },
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DecodeError::TooShort { command, needed, got } => {
                write!(f, "{command}: a payload of {got} bytes is too short, {needed} are needed")
            }
            DecodeError::Truncated { command, field, offset, needed, got } => write!(
                f,
                "{command}: {field} at offset {offset} needs {needed} bytes, {got} are left in the payload"
            ),
            DecodeError::NoSuchForm { command, got } => {
                write!(f, "{command}: no form of it has a payload of {got} bytes")
            }
            DecodeError::UnknownType { command, field, raw } => {
                write!(f, "{command}: {field} has the type {raw}, whose length is not known")
            }
        }
    }
}

impl core::error::Error for DecodeError {}

/// A message that cannot be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum EncodeError {
    /// The message does not fit the buffer, or is longer than a payload can be.
    BufferTooSmall {
        /// The bytes that are needed so far.
        needed: usize,
        /// The bytes there are.
        capacity: usize,
    },
    /// An optional field is there, or missing, against what the fields before it say.
    Presence {
        /// The spec's name of the field.
        field: &'static str,
        /// Whether it should be there.
        expected: bool,
    },
    /// A field of an optional tail is there, though one before it is not.
    Gap {
        /// The spec's name of the field that is there.
        field: &'static str,
        /// The spec's name of the one that is missing.
        absent: &'static str,
    },
    /// A list has another number of elements than the fields before it say.
    Count {
        /// The spec's name of the list.
        field: &'static str,
        /// The elements it should have.
        expected: usize,
        /// The elements it has.
        got: usize,
    },
    /// A text is longer than its length byte can say.
    TextTooLong {
        /// The bytes of the text.
        length: usize,
    },
    /// The payload would have the length of another form of the command, which means something else.
    OtherForm {
        /// The spec's name of the command.
        command: &'static str,
        /// The name of the message's form.
        form: &'static str,
        /// The bytes of the payload.
        length: usize,
    },
    /// The id is none that a frame can carry.
    Frame(crate::frame::EncodeFrameError),
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EncodeError::BufferTooSmall { needed, capacity } => {
                write!(f, "the message needs {needed} bytes or more, there is room for {capacity}")
            }
            EncodeError::Presence { field, expected: true } => {
                write!(f, "{field} is missing, though the fields before it say that it is there")
            }
            EncodeError::Presence { field, expected: false } => {
                write!(f, "{field} is there, though the fields before it say that it is not")
            }
            EncodeError::Gap { field, absent } => {
                write!(f, "{field} is there, though {absent} before it is missing")
            }
            EncodeError::Count { field, expected, got } => {
                write!(f, "{field} has {got} elements, the fields before it say {expected}")
            }
            EncodeError::TextTooLong { length } => {
                write!(f, "a text of {length} bytes is too long, 255 is the most")
            }
            EncodeError::OtherForm { command, form, length } => {
                write!(f, "{command}: a payload of {length} bytes is not of the form {form:?} but of another")
            }
            EncodeError::Frame(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for EncodeError {}

impl From<crate::frame::EncodeFrameError> for EncodeError {
    fn from(error: crate::frame::EncodeFrameError) -> Self {
        EncodeError::Frame(error)
    }
}

/// A value that is beyond what the wire can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OutOfRange;

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the value is beyond what the wire can hold")
    }
}

impl core::error::Error for OutOfRange {}
