//! How values look in serde: names and physical values where people read them, raw numbers elsewhere.
//!
//! What has no name stays a number, and what no physical value stands for (a special value, a NaN) stays what it is on
//! the wire, so that nothing is lost on the way through a file.

use core::fmt;

use serde::de::{Error, Unexpected, Visitor};

use crate::wire::{Bytes, FixedText, Label, Reserved};

/// Reads a label by name, or a raw number.
pub(crate) struct LabelVisitor(pub(crate) &'static [Label]);

impl Visitor<'_> for LabelVisitor {
    type Value = i64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a raw number")?;
        self.0.iter().try_for_each(|label| write!(f, ", {}", label.name))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<i64, E> {
        let label = self.0.iter().find(|label| label.name.eq_ignore_ascii_case(name));
        label.map(|label| label.value).ok_or_else(|| E::invalid_value(Unexpected::Str(name), &self))
    }

    fn visit_i64<E: Error>(self, raw: i64) -> Result<i64, E> {
        Ok(raw)
    }

    fn visit_u64<E: Error>(self, raw: u64) -> Result<i64, E> {
        i64::try_from(raw).map_err(|_| E::invalid_value(Unexpected::Unsigned(raw), &self))
    }
}

/// Serde for enumerations: the name of the value, or the raw number where it has none.
macro_rules! labelled {
    ($name:ty: $integer:ty, |$raw:ident| $from:expr, |$value:ident| $into:expr) => {
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let $value = *self;
                let raw: $integer = $into;
                if serializer.is_human_readable() {
                    let label = <$name>::LABELS.iter().find(|label| label.value == i64::from(raw));
                    if let Some(label) = label {
                        return serializer.serialize_str(label.name);
                    }
                }
                serde::Serialize::serialize(&raw, serializer)
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                if !deserializer.is_human_readable() {
                    let $raw = <$integer as serde::Deserialize>::deserialize(deserializer)?;
                    return Ok($from);
                }
                let visitor = crate::serde_support::LabelVisitor(<$name>::LABELS);
                let number = deserializer.deserialize_any(visitor)?;
                let $raw = <$integer>::try_from(number).map_err(serde::de::Error::custom)?;
                Ok($from)
            }
        }
    };
}
pub(crate) use labelled;

/// Reads a physical value, or the name of a special value.
pub(crate) struct QuantityVisitor {
    pub(crate) labels: &'static [Label],
    pub(crate) multiply: f64,
    pub(crate) divide: f64,
    pub(crate) limits: (f64, f64),
}

impl Visitor<'_> for QuantityVisitor {
    type Value = i64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scale = self.multiply / self.divide;
        write!(f, "a value from {} to {}", self.limits.0 * scale, self.limits.1 * scale)?;
        self.labels.iter().try_for_each(|label| write!(f, ", {}", label.name))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<i64, E> {
        let label = self.labels.iter().find(|label| label.name.eq_ignore_ascii_case(name));
        label.map(|label| label.value).ok_or_else(|| E::invalid_value(Unexpected::Str(name), &self))
    }

    #[allow(clippy::cast_possible_truncation, reason = "checked against the limits")]
    fn visit_f64<E: Error>(self, value: f64) -> Result<i64, E> {
        let raw = value * self.divide / self.multiply;
        let raw = raw + if raw < 0.0 { -0.5 } else { 0.5 };
        if raw > self.limits.0 - 1.0 && raw < self.limits.1 + 1.0 {
            Ok(raw as i64)
        } else {
            Err(E::invalid_value(Unexpected::Float(value), &self))
        }
    }

    #[allow(clippy::cast_precision_loss, reason = "values of this size are beyond every limit")]
    fn visit_i64<E: Error>(self, value: i64) -> Result<i64, E> {
        self.visit_f64(value as f64)
    }

    #[allow(clippy::cast_precision_loss, reason = "values of this size are beyond every limit")]
    fn visit_u64<E: Error>(self, value: u64) -> Result<i64, E> {
        self.visit_f64(value as f64)
    }
}

/// Serde for physical quantities: the value in its unit, or the name of a special value.
macro_rules! quantity {
    ($name:ident: $integer:ident, $multiply:literal, $divide:literal) => {
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                if !serializer.is_human_readable() {
                    return serde::Serialize::serialize(&self.0, serializer);
                }
                match Self::LABELS.iter().find(|label| label.value == i64::from(self.0)) {
                    Some(label) => serializer.serialize_str(label.name),
                    None => serializer
                        .serialize_f64(f64::from(self.0) * f64::from($multiply) / f64::from($divide)),
                }
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                if !deserializer.is_human_readable() {
                    return serde::Deserialize::deserialize(deserializer).map(Self);
                }
                let visitor = crate::serde_support::QuantityVisitor {
                    labels: Self::LABELS,
                    multiply: f64::from($multiply),
                    divide: f64::from($divide),
                    limits: (f64::from($integer::MIN), f64::from($integer::MAX)),
                };
                let raw = deserializer.deserialize_any(visitor)?;
                $integer::try_from(raw).map(Self).map_err(serde::de::Error::custom)
            }
        }
    };
}
pub(crate) use quantity;

/// Serde for numbers that are shown and read in a way of their own.
macro_rules! shown {
    ($name:ident($integer:ident), $expected:literal) => {
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                if serializer.is_human_readable() {
                    serializer.collect_str(self)
                } else {
                    serde::Serialize::serialize(&self.0, serializer)
                }
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Shown;

                impl serde::de::Visitor<'_> for Shown {
                    type Value = $name;

                    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                        f.write_str($expected)
                    }

                    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<$name, E> {
                        text.parse().map_err(|_| E::invalid_value(serde::de::Unexpected::Str(text), &self))
                    }
                }

                if deserializer.is_human_readable() {
                    deserializer.deserialize_str(Shown)
                } else {
                    serde::Deserialize::deserialize(deserializer).map($name)
                }
            }
        }
    };
}
pub(crate) use shown;

/// Serde for numbers that are made of several: the values of the parts by name.
macro_rules! parts {
    ($name:ident($integer:ident)) => {
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let label = <$name as crate::reflect::NumberType>::NUMBER.label(i64::from(self.0));
                match label.filter(|_| serializer.is_human_readable()) {
                    Some(label) => serializer.collect_str(&label),
                    None => serde::Serialize::serialize(&self.0, serializer),
                }
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Parts;

                impl serde::de::Visitor<'_> for Parts {
                    type Value = $name;

                    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                        f.write_str("NAME=VALUE for each part, the name of a value, or a raw number")
                    }

                    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<$name, E> {
                        let number = <$name as crate::reflect::NumberType>::NUMBER;
                        let raw = number.raw_of_name(text).and_then(|raw| raw.try_into().ok());
                        raw.map($name)
                            .ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(text), &self))
                    }

                    fn visit_u64<E: serde::de::Error>(self, raw: u64) -> Result<$name, E> {
                        let fits = raw.try_into().map($name);
                        fits.map_err(|_| E::invalid_value(serde::de::Unexpected::Unsigned(raw), &self))
                    }
                }

                if deserializer.is_human_readable() {
                    deserializer.deserialize_any(Parts)
                } else {
                    serde::Deserialize::deserialize(deserializer).map($name)
                }
            }
        }
    };
}
pub(crate) use parts;

/// Fills `block` from hex digits.
pub(crate) struct HexVisitor<'b>(pub(crate) &'b mut [u8]);

impl Visitor<'_> for HexVisitor<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes as {} hex digits", self.0.len(), self.0.len() * 2)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        if text.len() != self.0.len() * 2 {
            return Err(E::invalid_length(text.len(), &self));
        }
        let digit = |byte: u8| char::from(byte).to_digit(16).and_then(|digit| u8::try_from(digit).ok());
        let (pairs, _) = text.as_bytes().as_chunks::<2>();
        for (place, [high, low]) in self.0.iter_mut().zip(pairs) {
            match (digit(*high), digit(*low)) {
                (Some(high), Some(low)) => *place = high << 4 | low,
                _ => return Err(E::invalid_value(Unexpected::Str(text), &"hex digits")),
            }
        }
        Ok(())
    }

    fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<(), E> {
        if bytes.len() != self.0.len() {
            return Err(E::invalid_length(bytes.len(), &self));
        }
        self.0.copy_from_slice(bytes);
        Ok(())
    }
}

/// Serde for blocks of bytes: hex digits where people read.
macro_rules! block {
    ($block:ident) => {
        impl<const N: usize> serde::Serialize for $block<N> {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                if serializer.is_human_readable() {
                    serializer.collect_str(&crate::wire::Hex(&self.0))
                } else {
                    serializer.serialize_bytes(&self.0)
                }
            }
        }

        impl<'de, const N: usize> serde::Deserialize<'de> for $block<N> {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let mut block = [0; N];
                let visitor = crate::serde_support::HexVisitor(&mut block);
                if deserializer.is_human_readable() {
                    deserializer.deserialize_str(visitor)?;
                } else {
                    deserializer.deserialize_bytes(visitor)?;
                }
                Ok(Self(block))
            }
        }
    };
}

block!(Bytes);
block!(Reserved);
block!(FixedText);

impl serde::Serialize for crate::wire::Float {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match (serializer.is_human_readable(), self.get()) {
            (true, value) if value.is_finite() => serializer.serialize_f32(value),
            (true, _) => serializer.collect_str(&format_args!("{:#010x}", self.bits())),
            (false, _) => serializer.serialize_u32(self.bits()),
        }
    }
}

impl<'de> serde::Deserialize<'de> for crate::wire::Float {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            deserializer.deserialize_any(FloatVisitor)
        } else {
            <u32 as serde::Deserialize>::deserialize(deserializer).map(Self::from_bits)
        }
    }
}

struct FloatVisitor;

impl Visitor<'_> for FloatVisitor {
    type Value = crate::wire::Float;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or the bits of a float as 0x and eight hex digits")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        let bits = text.strip_prefix("0x").and_then(|digits| u32::from_str_radix(digits, 16).ok());
        bits.map(Self::Value::from_bits).ok_or_else(|| E::invalid_value(Unexpected::Str(text), &self))
    }

    #[allow(clippy::cast_possible_truncation, reason = "the field is a float of 32 bits")]
    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        Ok((value as f32).into())
    }

    #[allow(clippy::cast_precision_loss, reason = "the field is a float of 32 bits")]
    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        Ok((value as f32).into())
    }

    #[allow(clippy::cast_precision_loss, reason = "the field is a float of 32 bits")]
    fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
        Ok((value as f32).into())
    }
}

/// Serde for bytes that a message borrows: hex digits where people read.
///
/// Hex digits cannot be borrowed as bytes, and there is no allocator to keep decoded ones, so such messages are read back
/// from formats that keep bytes as they are. From text they are read only if the field is empty.
pub(crate) mod borrowed_bytes {
    use core::fmt;

    use serde::de::{Error, Visitor};
    use serde::{Deserializer, Serializer};

    pub(crate) fn serialize<S: Serializer>(bytes: &&[u8], serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            serializer.collect_str(&crate::wire::Hex(bytes))
        } else {
            serializer.serialize_bytes(bytes)
        }
    }

    pub(crate) fn deserialize<'de: 'a, 'a, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<&'a [u8], D::Error> {
        if deserializer.is_human_readable() {
            deserializer.deserialize_str(Borrowed)
        } else {
            deserializer.deserialize_bytes(Borrowed)
        }
    }

    struct Borrowed;

    impl<'de> Visitor<'de> for Borrowed {
        type Value = &'de [u8];

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("bytes that can be borrowed, which hex digits cannot")
        }

        fn visit_borrowed_bytes<E: Error>(self, bytes: &'de [u8]) -> Result<Self::Value, E> {
            Ok(bytes)
        }

        fn visit_borrowed_str<E: Error>(self, text: &'de str) -> Result<Self::Value, E> {
            match text {
                "" => Ok(&[]),
                text => Err(E::invalid_value(serde::de::Unexpected::Str(text), &self)),
            }
        }
    }
}

impl<'de: 'a, 'a> serde::Deserialize<'de> for crate::wire::Text<'a> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            <&str as serde::Deserialize>::deserialize(deserializer).map(|text| Self(text.as_bytes()))
        } else {
            borrowed_bytes::deserialize(deserializer).map(Self)
        }
    }
}

impl serde::Serialize for crate::wire::Text<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.as_str() {
            Ok(text) if serializer.is_human_readable() => serializer.serialize_str(text),
            _ => serializer.serialize_bytes(self.0),
        }
    }
}
