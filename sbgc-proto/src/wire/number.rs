//! Integers and floats, and the rule by which every type that is one number on the wire gets its codec.

use super::{FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

/// A named raw value: of an enumeration, a flag, or a special case of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label<V = i64> {
    /// The raw value, for a flag its bit or bits.
    pub value: V,
    /// The spec's name.
    pub name: &'static str,
    /// What it means.
    pub doc: &'static str,
}

macro_rules! integers {
    ($($integer:ident)*) => { $(
        impl Layout for $integer {
            const MIN_LEN: usize = size_of::<$integer>();
            const MAX_LEN: usize = size_of::<$integer>();
        }

        impl<'a> FromWire<'a> for $integer {
            #[inline]
            fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
                super::read_whole(input, ())
            }

            #[inline]
            fn read_fixed(input: &'a [u8], (): ()) -> Option<Self> {
                input.first_chunk().map(|bytes| $integer::from_le_bytes(*bytes))
            }
        }

        impl ToWire for $integer {
            #[inline]
            fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
                out.put_array(&self.to_le_bytes())
            }
        }

        #[cfg(feature = "reflect")]
        impl crate::reflect::NumberType for $integer {
            const NUMBER: crate::reflect::Number =
                crate::reflect::Number::plain(crate::reflect::Scalar::$integer);

            fn raw_number(&self) -> i64 {
                i64::from(*self)
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                raw.try_into().ok()
            }
        }

        #[cfg(feature = "reflect")]
        crate::reflect::reflect_number!($integer);
    )* };
}

integers!(u8 i8 u16 i16 u32 i32);

/// Gives a type that is one number on the wire its codec: `Type: integer, read |raw| value, raw |value| raw`.
///
/// With `labelled` it also gets a human-readable serde form that is the name of the value where it has one; without,
/// the caller says how serde sees it.
macro_rules! number_type {
    ($name:ty: $integer:ty, read |$raw:ident| $from:expr, raw |$value:ident| $into:expr, labelled) => {
        $crate::wire::number_type!($name: $integer, read |$raw| $from, raw |$value| $into);

        #[cfg(feature = "serde")]
        $crate::serde_support::labelled!($name: $integer, |$raw| $from, |$value| $into);
    };
    ($name:ty: $integer:ty, read |$raw:ident| $from:expr, raw |$value:ident| $into:expr) => {
        impl $crate::wire::Layout for $name {
            const MIN_LEN: usize = <$integer as $crate::wire::Layout>::MIN_LEN;
            const MAX_LEN: usize = <$integer as $crate::wire::Layout>::MAX_LEN;
        }

        impl<'a> $crate::wire::FromWire<'a> for $name {
            #[inline]
            fn read(input: &'a [u8], (): ()) -> $crate::wire::Read<'a, Self> {
                let (input, $raw) = <$integer as $crate::wire::FromWire>::read(input, ())?;
                Ok((input, $from))
            }

            #[inline]
            fn read_fixed(input: &'a [u8], (): ()) -> Option<Self> {
                let $raw = <$integer as $crate::wire::FromWire>::read_fixed(input, ())?;
                Some($from)
            }
        }

        impl $crate::wire::ToWire for $name {
            #[inline]
            fn write(&self, (): (), out: &mut $crate::wire::Writer<'_>) -> Result<(), $crate::EncodeError> {
                let $value = *self;
                $crate::wire::ToWire::write(&$into, (), out)
            }
        }

        #[cfg(feature = "reflect")]
        $crate::reflect::reflect_number!($name);
    };
}
pub(crate) use number_type;

/// An unsigned number of 24 bits. Spec type `3u`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "u32", into = "u32")
)]
pub struct U24([u8; 3]);

impl U24 {
    /// The greatest value, 2^24 - 1.
    pub const MAX: Self = Self([0xFF; 3]);

    /// The number as 32 bits.
    pub const fn get(self) -> u32 {
        let [low, middle, high] = self.0;
        u32::from_le_bytes([low, middle, high, 0])
    }
}

impl From<U24> for u32 {
    fn from(value: U24) -> Self {
        value.get()
    }
}

impl TryFrom<u32> for U24 {
    type Error = crate::OutOfRange;

    fn try_from(value: u32) -> Result<Self, Self::Error> {
        match value.to_le_bytes() {
            [low, middle, high, 0] => Ok(Self([low, middle, high])),
            _ => Err(crate::OutOfRange::plain(0.0, 16_777_215.0)),
        }
    }
}

impl Layout for U24 {
    const MIN_LEN: usize = 3;
    const MAX_LEN: usize = 3;
}

impl<'a> FromWire<'a> for U24 {
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        super::read_whole(input, ())
    }

    #[inline]
    fn read_fixed(input: &'a [u8], (): ()) -> Option<Self> {
        input.first_chunk().map(|bytes| Self(*bytes))
    }
}

impl ToWire for U24 {
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        out.put_array(&self.0)
    }
}

#[cfg(feature = "reflect")]
impl crate::reflect::NumberType for U24 {
    const NUMBER: crate::reflect::Number = crate::reflect::Number::plain(crate::reflect::Scalar::u24);

    fn raw_number(&self) -> i64 {
        i64::from(self.get())
    }

    fn from_raw_number(raw: i64) -> Option<Self> {
        u32::try_from(raw).ok()?.try_into().ok()
    }
}

#[cfg(feature = "reflect")]
crate::reflect::reflect_number!(U24);

/// A float of 32 bits that compares by its bits and keeps them all, those of a NaN too. Spec type `4f`.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Float(u32);

impl Float {
    /// The float that has these bits.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The bits.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// The number.
    pub const fn get(self) -> f32 {
        f32::from_bits(self.0)
    }
}

impl core::fmt::Debug for Float {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.get().fmt(f)
    }
}

impl From<f32> for Float {
    fn from(value: f32) -> Self {
        Self(value.to_bits())
    }
}

impl From<Float> for f32 {
    fn from(value: Float) -> Self {
        value.get()
    }
}

number_type!(Float: u32, read |raw| Self(raw), raw |value| value.0);

#[cfg(feature = "reflect")]
impl crate::reflect::NumberType for Float {
    const NUMBER: crate::reflect::Number = crate::reflect::Number::plain(crate::reflect::Scalar::f32);

    fn raw_number(&self) -> i64 {
        i64::from(self.0)
    }

    fn from_raw_number(raw: i64) -> Option<Self> {
        raw.try_into().ok().map(Self)
    }
}
