//! Errors of decoding and encoding.

use core::fmt;

/// Error of decoding a payload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum DecodeError {
    /// The payload is shorter than the message.
    TooShort {
        /// Spec name of the command.
        command: &'static str,
        /// Minimum length of the message.
        needed: usize,
        /// Length of the payload.
        got: usize,
    },
    /// The payload ends within a field whose place or length varies.
    Truncated {
        /// Spec name of the command.
        command: &'static str,
        /// Spec name of the field.
        field: &'static str,
        /// Offset of the field in the payload.
        offset: usize,
        /// Bytes that the field needs.
        needed: usize,
        /// Bytes left for it.
        got: usize,
    },
    /// The command has several forms, distinguished by length, and none has this length.
    NoSuchForm {
        /// Spec name of the command.
        command: &'static str,
        /// Length of the payload.
        got: usize,
    },
    /// A value declares an unknown type, so its length is unknown.
    UnknownType {
        /// Spec name of the command.
        command: &'static str,
        /// Spec name of the field.
        field: &'static str,
        /// Number of the type.
        raw: u8,
    },
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DecodeError::TooShort { command, needed, got } => {
                write!(f, "{command}: payload too short: expected at least {}, got {got}", Count(*needed))
            }
            DecodeError::Truncated { command, field, offset, needed, got } => write!(
                f,
                "{command}: {field} at offset {offset} needs {}, the payload has {got} left",
                Count(*needed)
            ),
            DecodeError::NoSuchForm { command, got } => {
                write!(f, "{command}: no known layout is {} long", Count(*got))
            }
            DecodeError::UnknownType { command, field, raw } => {
                write!(f, "{command}: {field} has unknown type {raw}")
            }
        }
    }
}

impl core::error::Error for DecodeError {}

/// Error of encoding a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum EncodeError {
    /// The message does not fit the buffer, or is longer than a payload can be.
    BufferTooSmall {
        /// Bytes needed so far.
        needed: usize,
        /// Size of the buffer.
        capacity: usize,
    },
    /// An optional field is present or missing, contrary to the preceding fields.
    Presence {
        /// Spec name of the field.
        field: &'static str,
        /// Whether it has to be present.
        expected: bool,
    },
    /// A field of an optional tail is present although an earlier one is absent.
    Gap {
        /// The spec's name of the field that is present.
        field: &'static str,
        /// The spec's name of the absent field.
        absent: &'static str,
    },
    /// A list does not have the number of elements that the preceding fields require.
    Count {
        /// The spec's name of the list.
        field: &'static str,
        /// Expected number of elements.
        expected: usize,
        /// Actual number of elements.
        got: usize,
    },
    /// The payload would have the length of another form of the command, which means something else.
    OtherForm {
        /// Spec name of the command.
        command: &'static str,
        /// The name of the message's form.
        form: &'static str,
        /// The bytes of the payload.
        length: usize,
    },
    /// A text is longer than its length byte can express.
    TextTooLong(TextTooLong),
    /// The frame cannot be built.
    Frame(crate::frame::EncodeFrameError),
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EncodeError::BufferTooSmall { needed, capacity } => {
                write!(f, "buffer too small: need at least {}, have {capacity}", Count(*needed))
            }
            EncodeError::Presence { field, expected: true } => {
                write!(f, "{field} is required by the preceding fields but missing")
            }
            EncodeError::Presence { field, expected: false } => {
                write!(f, "{field} is set but the preceding fields exclude it")
            }
            EncodeError::Gap { field, absent } => {
                write!(f, "{field} requires {absent} to be set as well")
            }
            EncodeError::Count { field, expected, got } => {
                write!(f, "{field} has {got} elements, expected {expected}")
            }
            EncodeError::OtherForm { command, form, length } => {
                write!(f, "{command}: a payload of {} belongs to another form than {form:?}", Count(*length))
            }
            EncodeError::TextTooLong(error) => error.fmt(f),
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

impl From<TextTooLong> for EncodeError {
    fn from(error: TextTooLong) -> Self {
        EncodeError::TextTooLong(error)
    }
}

/// A text that is longer than its field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TextTooLong {
    /// Length of the text in bytes.
    pub length: usize,
    /// Maximum length in bytes.
    pub maximum: usize,
}

impl fmt::Display for TextTooLong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "text too long: {}, maximum {}", Count(self.length), self.maximum)
    }
}

impl core::error::Error for TextTooLong {}

/// A value outside of the range that a field can have.
///
/// ```
/// use sbgc_proto::units::Angle;
///
/// let error = Angle::try_from_degrees(1000.0).unwrap_err();
/// assert_eq!(error.minimum, -720.0);
/// assert_eq!(error.to_string(), "out of range; expected -720 to 719.978 deg");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OutOfRange {
    /// Minimum value.
    pub minimum: f64,
    /// Maximum value.
    pub maximum: f64,
    /// Unit of both; empty when they have none.
    pub unit: &'static str,
}

impl OutOfRange {
    /// The range of a number without unit.
    pub(crate) const fn plain(minimum: f64, maximum: f64) -> Self {
        Self { minimum, maximum, unit: "" }
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "out of range; expected {} to {}", Limit(self.minimum), Limit(self.maximum))?;
        if self.unit.is_empty() { Ok(()) } else { write!(f, " {}", self.unit) }
    }
}

impl core::error::Error for OutOfRange {}

/// A number of bytes.
struct Count(usize);

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = if self.0 == 1 { "" } else { "s" };
        write!(f, "{} byte{plural}", self.0)
    }
}

/// An end of a range, with at most three digits after the point.
struct Limit(f64);

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !(-1e15..=1e15).contains(&self.0) {
            return write!(f, "{:e}", self.0);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "below 1e18")]
        let is_whole = |value: f64| (value - value as i64 as f64).abs() < 1e-9;
        let digits = [1.0, 10.0, 100.0].into_iter().position(|scale| is_whole(self.0 * scale)).unwrap_or(3);
        write!(f, "{:.*}", digits, self.0)
    }
}
