//! Numbers on the wire, the physical values they stand for, and their names.

use core::fmt;

use crate::wire::Label;

/// How a number stands on the wire.
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
    /// The name, for example `u16`.
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

    /// Bytes on the wire.
    pub const fn size(self) -> usize {
        match self {
            Scalar::u8 | Scalar::i8 => 1,
            Scalar::u16 | Scalar::i16 => 2,
            Scalar::u24 => 3,
            Scalar::u32 | Scalar::i32 | Scalar::f32 => 4,
        }
    }

    /// The minimum and maximum raw number; for a float, those of its value.
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

/// What raw numbers mean beyond their value.
#[derive(Clone, Copy, Debug)]
pub enum Meaning {
    /// Nothing.
    Plain,
    /// Each value has a name.
    Enum(&'static [Label]),
    /// Each bit has a name.
    Flags(&'static [Label]),
    /// Groups of bits are numbers of their own, and some values have names as a whole.
    Bits(&'static [BitPart], &'static [Label]),
    /// A quantity of which a few values are names.
    Special(&'static [Label]),
    /// Shown and read in a way of its own.
    Shown {
        /// Shows a raw number.
        show: fn(i64, &mut fmt::Formatter<'_>) -> fmt::Result,
        /// The raw number that is shown as this text.
        read: fn(&str) -> Option<i64>,
    },
}

/// A number within a number.
#[derive(Clone, Copy, Debug)]
pub struct BitPart {
    /// The spec's name.
    pub name: &'static str,
    /// Its lowest bit.
    pub low: u32,
    /// How many bits it takes.
    pub width: u32,
    /// Names of its values.
    pub labels: &'static [Label],
    /// Type of the device.
    pub doc: &'static str,
}

impl BitPart {
    pub(super) const fn mask(&self) -> i64 {
        (1 << self.width) - 1
    }
}

/// A kind of number: how it stands on the wire and what it stands for.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Its form on the wire.
    pub scalar: Scalar,
    /// The unit of the value; empty when it has none.
    pub unit: &'static str,
    /// The value is `raw * multiply / divide`.
    pub multiply: f64,
    /// The value is `raw * multiply / divide`.
    pub divide: f64,
    /// What raw numbers mean beyond that.
    pub meaning: Meaning,
}

/// A type that is one number on the wire.
pub trait NumberType: Sized {
    /// What kind of number.
    const NUMBER: Number;

    /// The number as it stands on the wire; of a float, its bits.
    fn raw_number(&self) -> i64;

    /// The value for a raw number, `None` where the wire cannot hold it.
    fn from_raw_number(raw: i64) -> Option<Self>;
}

/// Makes a [`NumberType`] a leaf of messages.
macro_rules! reflect_number {
    ($name:ty) => {
        const _: () = {
            use $crate::reflect::{
                Assign, AssignError, Describe, FieldInfo, Input, NumberType, Place, Raw, Shape, Steps,
                Visitor,
            };

            impl Describe for $name {
                const SHAPE: Shape = Shape::Number(<$name as NumberType>::NUMBER);

                fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
                    let number = &<$name as NumberType>::NUMBER;
                    place.leaf(number.scalar.size(), Some(number), Raw::Number(self.raw_number()), visitor)
                }
            }

            impl<'a> Assign<'a> for $name {
                fn assign(
                    &mut self,
                    path: Steps<'_>,
                    value: Input<'a>,
                    field: &'static FieldInfo,
                ) -> Result<(), AssignError> {
                    let number = &<$name as NumberType>::NUMBER;
                    let raw = path.number(number, value, field)?;
                    *self = <$name as NumberType>::from_raw_number(raw)
                        .ok_or_else(|| number.out_of_range(None, field))?;
                    Ok(())
                }
            }
        };
    };
}
pub(crate) use reflect_number;

impl Number {
    /// A number without unit or names.
    pub const fn plain(scalar: Scalar) -> Self {
        Number { scalar, unit: "", multiply: 1.0, divide: 1.0, meaning: Meaning::Plain }
    }

    /// The value that `raw` stands for, in [`unit`](Self::unit).
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub fn value(&self, raw: i64) -> f64 {
        match self.scalar {
            // The raw number of a float is its 32 bits.
            Scalar::f32 => f64::from(f32::from_bits(raw as u32)),
            _ => raw as f64 * self.multiply / self.divide,
        }
    }

    /// Whether the value is another number than the raw one.
    #[allow(clippy::float_cmp, reason = "they are written side by side and never calculated")]
    pub fn is_scaled(&self) -> bool {
        self.multiply != self.divide
    }

    /// The name of `raw` in an enumeration or of a special case, if it has one.
    pub fn name(&self, raw: i64) -> Option<&'static str> {
        let (Meaning::Enum(labels) | Meaning::Special(labels)) = self.meaning else { return None };
        labels.iter().find(|label| label.value == raw).map(|label| label.name)
    }

    /// The names that `raw` has, if any.
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
