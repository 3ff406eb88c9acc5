//! Numbers on the wire, their physical values and their names.

use core::fmt;

use crate::wire::Label;

/// Wire type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(non_camel_case_types, reason = "they are the names of the types")]
#[allow(missing_docs, reason = "they are the names of the types")]
pub enum Scalar {
    u8,
    i8,
    u16,
    i16,
    u24,
    u32,
    i32,
    f32,
}

impl Scalar {
    /// Name of the type, for example `u16`.
    pub const fn name(self) -> &'static str {
        match self {
            Scalar::u8 => "u8",
            Scalar::i8 => "i8",
            Scalar::u16 => "u16",
            Scalar::i16 => "i16",
            Scalar::u24 => "u24",
            Scalar::u32 => "u32",
            Scalar::i32 => "i32",
            Scalar::f32 => "f32",
        }
    }

    /// Number of bytes on the wire.
    pub const fn size(self) -> usize {
        match self {
            Scalar::u8 | Scalar::i8 => 1,
            Scalar::u16 | Scalar::i16 => 2,
            Scalar::u24 => 3,
            Scalar::u32 | Scalar::i32 | Scalar::f32 => 4,
        }
    }

    /// Minimum and maximum raw number; for a float, those of its value.
    pub const fn limits(self) -> (f64, f64) {
        match self {
            Scalar::u8 => (0.0, 255.0),
            Scalar::i8 => (-128.0, 127.0),
            Scalar::u16 => (0.0, 65_535.0),
            Scalar::i16 => (-32_768.0, 32_767.0),
            Scalar::u24 => (0.0, 16_777_215.0),
            Scalar::u32 => (0.0, 4_294_967_295.0),
            Scalar::i32 => (-2_147_483_648.0, 2_147_483_647.0),
            Scalar::f32 => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }
}

/// Interpretation of raw numbers beyond their value.
#[derive(Clone, Copy, Debug)]
pub enum Meaning {
    /// No further interpretation.
    Plain,
    /// Enumeration: values with names.
    Enum(&'static [Label]),
    /// Flags: bits with names.
    Flags(&'static [Label]),
    /// Groups of bits that are separate numbers, and whole values with names.
    Bits(&'static [BitPart], &'static [Label]),
    /// Quantity in which a few values have names instead.
    Special(&'static [Label]),
    /// Custom display and parse functions.
    Shown {
        /// Displays a raw number.
        show: fn(i64, &mut fmt::Formatter<'_>) -> fmt::Result,
        /// Parses the displayed text; `None` if it is invalid.
        read: fn(&str) -> Option<i64>,
    },
}

/// Part of a number.
#[derive(Clone, Copy, Debug)]
pub struct BitPart {
    /// Spec name.
    pub name: &'static str,
    /// Lowest bit.
    pub low: u32,
    /// Number of bits.
    pub width: u32,
    /// Names of its values.
    pub labels: &'static [Label],
    /// Description in one sentence.
    pub doc: &'static str,
}

impl BitPart {
    pub(super) const fn mask(&self) -> i64 {
        (1 << self.width) - 1
    }
}

/// Description of a number: wire type, unit, scale and names.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Wire type.
    pub scalar: Scalar,
    /// Unit of the value; empty if it has none.
    pub unit: &'static str,
    /// Numerator of the scale: the value is `raw * multiply / divide`.
    pub multiply: f64,
    /// Denominator of the scale: the value is `raw * multiply / divide`.
    pub divide: f64,
    /// Interpretation of raw numbers beyond their value.
    pub meaning: Meaning,
}

/// Type that is a single number on the wire.
pub trait NumberType: Sized {
    /// Description of the number.
    const NUMBER: Number;

    /// Raw number on the wire; for a float, its bits.
    fn raw_number(&self) -> i64;

    /// Creates the value from a raw number; `None` if the wire cannot hold it.
    fn from_raw_number(raw: i64) -> Option<Self>;
}

impl Number {
    /// Describes a number without unit, scale and names.
    pub const fn plain(scalar: Scalar) -> Self {
        Number { scalar, unit: "", multiply: 1.0, divide: 1.0, meaning: Meaning::Plain }
    }

    /// Physical value of `raw`, in [`unit`](Self::unit).
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub fn value(&self, raw: i64) -> f64 {
        match self.scalar {
            // The raw number of a float is its 32 bits.
            Scalar::f32 => f64::from(f32::from_bits(raw as u32)),
            _ => raw as f64 * self.multiply / self.divide,
        }
    }

    /// Whether the value differs from the raw number.
    #[allow(clippy::float_cmp, reason = "they are written side by side and never calculated")]
    pub fn is_scaled(&self) -> bool {
        self.multiply != self.divide
    }

    /// Name of `raw` in an enumeration or as a special value, if it has one.
    pub fn name(&self, raw: i64) -> Option<&'static str> {
        let (Meaning::Enum(labels) | Meaning::Special(labels)) = self.meaning else { return None };
        labels.iter().find(|label| label.value == raw).map(|label| label.name)
    }

    /// Names of `raw`, if it has any.
    pub fn label(&self, raw: i64) -> Option<impl fmt::Display + use<>> {
        let named = match self.meaning {
            Meaning::Plain => false,
            Meaning::Enum(_) | Meaning::Special(_) => self.name(raw).is_some(),
            Meaning::Flags(_) => raw != 0,
            Meaning::Bits(..) | Meaning::Shown { .. } => true,
        };
        named.then_some(Names { meaning: self.meaning, raw })
    }
}

struct Names {
    meaning: Meaning,
    raw: i64,
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.meaning {
            Meaning::Plain => Ok(()),
            Meaning::Enum(labels) | Meaning::Special(labels) => {
                let label = labels.iter().find(|label| label.value == self.raw);
                f.write_str(label.map_or("", |label| label.name))
            }
            Meaning::Flags(labels) => flag_names(labels, self.raw, f),
            Meaning::Bits(parts, names) => match names.iter().find(|label| label.value == self.raw) {
                Some(label) => f.write_str(label.name),
                None => part_values(parts, self.raw, f),
            },
            Meaning::Shown { show, .. } => show(self.raw, f),
        }
    }
}

fn part_values(parts: &[BitPart], raw: i64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let mut left = raw;
    let mut separator = "";
    for part in parts {
        let value = (raw >> part.low) & part.mask();
        match part.labels.iter().find(|label| label.value == value) {
            Some(label) => write!(f, "{separator}{}={}", part.name, label.name)?,
            None => write!(f, "{separator}{}={value}", part.name)?,
        }
        left &= !(part.mask() << part.low);
        separator = " ";
    }
    if left == 0 { Ok(()) } else { write!(f, "{separator}{left:#x}") }
}

fn flag_names(labels: &[Label], raw: i64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let mut left = raw;
    let mut separator = "";
    for label in labels.iter().filter(|label| label.value != 0 && raw & label.value == label.value) {
        write!(f, "{separator}{}", label.name)?;
        left &= !label.value;
        separator = "|";
    }
    if left != 0 {
        write!(f, "{separator}{left:#x}")?;
    }
    Ok(())
}
