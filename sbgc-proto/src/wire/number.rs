//! Integers and floats, and the names of raw values.

use super::{FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

/// Named raw value: of an enumeration, a flag or a special value of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label<V = i64> {
    /// Raw value; for a flag, its bit or bits.
    pub value: V,
    /// Spec name.
    pub name: &'static str,
    /// Description in one sentence.
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

            #[inline]
            fn write_fixed(&self, (): (), place: &mut [u8]) -> Option<()> {
                *place.first_chunk_mut()? = self.to_le_bytes();
                Some(())
            }
        }
    )* };
}

integers!(u8 i8 u16 i16 u32 i32);

/// Unsigned 24-bit number. Spec type `3u`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "u32", into = "u32")
)]
pub struct U24([u8; 3]);

impl U24 {
    /// Maximum value, 2^24 - 1.
    pub const MAX: Self = Self([0xFF; 3]);

    /// Creates the number from bytes, low byte first.
    pub const fn from_le_bytes(bytes: [u8; 3]) -> Self {
        Self(bytes)
    }

    /// Value as a 32-bit number.
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

    #[inline]
    fn write_fixed(&self, (): (), place: &mut [u8]) -> Option<()> {
        *place.first_chunk_mut()? = self.0;
        Some(())
    }
}

/// 32-bit float that preserves all bits, including those of a NaN, and compares by them. Spec type `4f`.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Float(u32);

impl Float {
    /// Creates the float from its bits.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// Bits of the float.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Value as a float.
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

impl Layout for Float {
    const MIN_LEN: usize = 4;
    const MAX_LEN: usize = 4;
}

impl<'a> FromWire<'a> for Float {
    #[inline]
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        let (input, bits) = u32::read(input, ())?;
        Ok((input, Self(bits)))
    }

    #[inline]
    fn read_fixed(input: &'a [u8], (): ()) -> Option<Self> {
        u32::read_fixed(input, ()).map(Self)
    }
}

impl ToWire for Float {
    #[inline]
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        self.0.write((), out)
    }

    #[inline]
    fn write_fixed(&self, (): (), place: &mut [u8]) -> Option<()> {
        self.0.write_fixed((), place)
    }
}
