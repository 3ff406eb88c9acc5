//! One parameter: where it lies, what it means, and its values as text and numbers.
//!
//! All of it comes from the declaration of the block's message; a value is the bytes that stand for it on the wire, so
//! that nothing is lost between a board and a file.

use std::fmt::Write as _;

use sbgc_proto::frame::MAX_PAYLOAD;
use sbgc_proto::reflect::{AssignError, FieldInfo, Input, Meaning, Number, Raw, Scalar};
use sbgc_proto::{DecodeError, EncodeError, IncomingCommand, OutOfRange};

use super::block::Block;
use super::quantity::{self, Amount, UnitError};

/// Fields with the board's present state or the profile of the block: shown, never written.
const STATE: [&str; 3] = ["PROFILE_ID", "CUR_IMU", "CUR_PROFILE_ID"];

/// A parameter of the board.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Block that carries it.
    pub block: Block,
    /// Path, such as `rc_memory.yaw`.
    pub path: String,
    /// Declared field that it is or belongs to.
    pub field: &'static FieldInfo,
    /// Kind of number; `None` for text and bytes.
    pub number: Option<&'static Number>,
    /// Whether it is text.
    pub is_text: bool,
    /// Offset of its first byte in the block.
    pub offset: usize,
    /// Size in bytes.
    pub size: usize,
}

/// Value of a parameter in engineering units.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Number without a scale.
    Integer(i64),
    /// Number in the parameter's unit.
    Number(f64),
    /// Text.
    Text(String),
    /// Bytes other than a number or text.
    Bytes(Vec<u8>),
}

/// A value is invalid for a parameter.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ValueError {
    /// The unit does not belong to the parameter.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// The field does not accept the value.
    #[error(transparent)]
    Assign(#[from] AssignError),
    /// The parameter is read-only.
    #[error("it is set by the board and cannot be written")]
    State,
    /// The block cannot be decoded.
    #[error(transparent)]
    Decode(#[from] DecodeError),
    /// The block cannot be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

impl Parameter {
    /// Whether it is state of the board, or the profile of its block. Such parameters are never written.
    pub fn is_state(&self) -> bool {
        STATE.contains(&self.field.spec)
    }

    /// The unit of its value, empty when it has none.
    pub fn unit(&self) -> &'static str {
        self.number.map(|number| number.unit).filter(|unit| !unit.is_empty()).unwrap_or(self.field.unit)
    }

    /// The minimum and maximum value, in its unit; none for what is not a quantity.
    pub fn range(&self) -> Option<(f64, f64)> {
        let number = self.number?;
        let (least, most) = match (self.field.range, number.meaning) {
            (Some(range), _) => range,
            (None, Meaning::Plain | Meaning::Special(_)) => number.scalar.limits(),
            (None, _) => return None,
        };
        if number.scalar == Scalar::f32 {
            return (least.is_finite() && most.is_finite()).then_some((least, most));
        }
        let scale = number.multiply / number.divide;
        Some((least * scale, most * scale))
    }

    /// The name of its wire type: `u8` to `f32`, `str` or `bytes`.
    pub fn type_name(&self) -> &'static str {
        match self.number {
            Some(number) => number.scalar.name(),
            None if self.is_text => "str",
            None => "bytes",
        }
    }

    /// Its bytes in a payload of its block.
    pub fn of<'b>(&self, payload: &'b [u8]) -> Option<&'b [u8]> {
        payload.get(self.offset..self.offset.checked_add(self.size)?)
    }

    /// Puts its bytes into a payload of its block. Nothing happens where they do not fit.
    pub(super) fn put(&self, payload: &mut [u8], bytes: &[u8]) {
        let place = self.offset..self.offset.saturating_add(self.size);
        if let Some(place) = payload.get_mut(place)
            && place.len() == bytes.len()
        {
            place.copy_from_slice(bytes);
        }
    }

    /// The number that these bytes are on the wire; none for text and bytes.
    pub fn raw(&self, bytes: &[u8]) -> Option<i64> {
        let number = self.number?;
        let unsigned = bytes.iter().rev().fold(0_i64, |sum, byte| sum << 8 | i64::from(*byte));
        let bits = 8 * u32::try_from(bytes.len()).ok()?;
        let signed = matches!(number.scalar, Scalar::i8 | Scalar::i16 | Scalar::i32);
        let negative = signed && bits > 0 && unsigned >> (bits - 1) & 1 == 1;
        Some(if negative { unsigned - (1 << bits) } else { unsigned })
    }

    /// The value that these bytes stand for.
    pub fn value(&self, bytes: &[u8]) -> Value {
        match (self.number, self.raw(bytes)) {
            (Some(number), Some(raw)) if number.is_scaled() || number.scalar == Scalar::f32 => {
                Value::Number(number.value(raw))
            }
            (_, Some(raw)) => Value::Integer(raw),
            _ if self.is_text => Value::Text(text_of(bytes)),
            _ => Value::Bytes(bytes.to_vec()),
        }
    }

    /// The name of the value: of an enumeration, of flags, of a special case.
    pub fn label(&self, bytes: &[u8]) -> Option<String> {
        let label = self.number?.label(self.raw(bytes)?)?.to_string();
        (!label.is_empty()).then_some(label)
    }

    /// The value as it is shown and as [`parse`](Self::parse) reads it: its name, or the number with its unit.
    pub fn show(&self, bytes: &[u8]) -> String {
        match self.name_that_reads_back(bytes) {
            Some(label) => label,
            None => match self.value(bytes) {
                Value::Text(text) => format!("{text:?}"),
                Value::Bytes(bytes) => hex(&bytes),
                _ if self.unit().is_empty() => self.digits(bytes),
                _ => format!("{} {}", self.digits(bytes), self.unit()),
            },
        }
    }

    /// The name of the value, where that alone gives the same bytes again.
    pub(super) fn name_that_reads_back(&self, bytes: &[u8]) -> Option<String> {
        let number = self.number?;
        if matches!(number.meaning, Meaning::Plain | Meaning::Shown { .. }) {
            return None;
        }
        let label = self.label(bytes)?;
        let again = self.wire(Input::Text(&label));
        again.is_ok_and(|again| again == bytes).then_some(label)
    }

    /// The number with as many digits as tell it from its neighbors.
    pub(super) fn digits(&self, bytes: &[u8]) -> String {
        let (Some(number), Some(raw)) = (self.number, self.raw(bytes)) else { return String::new() };
        quantity::digits(number, raw)
    }

    /// Parses user input into wire bytes: a number with or without its unit, the name of a value, names of flags
    /// joined by `|`, a raw number in hex after `0x`, text, or bytes in hex.
    ///
    /// # Errors
    /// If the unit or the value does not fit.
    pub fn parse(&self, text: &str) -> Result<Vec<u8>, ValueError> {
        let text = text.trim();
        let Some(number) = self.number else {
            let bytes = if self.is_text { None } else { unhex(text) };
            return match bytes {
                Some(bytes) => self.wire(Input::Bytes(&bytes)),
                None => self.wire(Input::Text(text)),
            };
        };
        // Names come first, for some begin with digits.
        let plain = self.wire(Input::Text(text));
        if !matches!(plain, Err(ValueError::Assign(AssignError::NotANumber { .. }))) {
            return plain;
        }
        match Amount::split(text) {
            Some(amount) if !matches!(number.meaning, Meaning::Enum(_) | Meaning::Flags(_)) => {
                self.wire(Input::Value(amount.in_unit(self.unit())?))
            }
            _ => plain,
        }
    }

    /// Converts a value into wire bytes, checked against the documented range.
    ///
    /// # Errors
    /// If the field does not accept it.
    pub fn wire(&self, input: Input<'_>) -> Result<Vec<u8>, ValueError> {
        let blank = vec![0; self.block.size()];
        let (mut message, _) = IncomingCommand::decode(self.block.read_id(), &blank)?;
        // The message may not outlive the input.
        message = match message.set(&self.path, input) {
            Ok(()) => message,
            // What the bytes cannot hold is beyond the documented range all the more.
            Err(AssignError::OutOfRange(wider)) => {
                let (minimum, maximum) = self.range().unwrap_or((wider.minimum, wider.maximum));
                return Err(
                    AssignError::OutOfRange(OutOfRange { minimum, maximum, unit: self.unit() }).into()
                );
            }
            Err(error) => return Err(error.into()),
        };
        let mut buffer = [0; MAX_PAYLOAD];
        let payload = message.encode(&mut buffer)?;
        Ok(self.of(payload).unwrap_or_default().to_vec())
    }
}

/// The text before the first zero.
pub(super) fn text_of(bytes: &[u8]) -> String {
    let text = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
    String::from_utf8_lossy(text).into_owned()
}

/// Bytes as lower-case hex.
pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// The bytes of hex digits, between which there may be white space.
pub(super) fn unhex(text: &str) -> Option<Vec<u8>> {
    let digits: Vec<u8> = text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let pairs = digits.chunks(2).map(|pair| {
        let pair = std::str::from_utf8(pair).ok().filter(|pair| pair.len() == 2 && !pair.starts_with('+'))?;
        u8::from_str_radix(pair, 16).ok()
    });
    pairs.collect()
}

/// All parameters of a block in wire order, reserved bytes left out.
pub(super) fn parameters_of(block: Block) -> Vec<Parameter> {
    let mut parameters = Vec::new();
    let Some(blank) = IncomingCommand::blank(block.read_id(), block.form()) else { return parameters };
    blank.walk(&mut |leaf: &sbgc_proto::reflect::Leaf<'_>| {
        if !leaf.field.reserved {
            parameters.push(Parameter {
                block,
                path: leaf.path.to_string(),
                field: leaf.field,
                number: leaf.number,
                is_text: matches!(leaf.raw, Raw::Text(_)),
                offset: leaf.offset,
                size: leaf.size,
            });
        }
    });
    parameters
}
