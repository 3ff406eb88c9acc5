//! Bytes that are not numbers: blocks, reserved areas, texts, and the rest of a payload.

use super::{Fault, FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

macro_rules! blocks {
    ($($(#[$attribute:meta])* $block:ident)*) => { $(
        $(#[$attribute])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        pub struct $block<const N: usize>(pub [u8; N]);

        impl<const N: usize> Default for $block<N> {
            /// All zero.
            fn default() -> Self {
                Self([0; N])
            }
        }

        impl<const N: usize> From<[u8; N]> for $block<N> {
            fn from(bytes: [u8; N]) -> Self {
                Self(bytes)
            }
        }

        impl<const N: usize> Layout for $block<N> {
            const MIN_LEN: usize = N;
            const MAX_LEN: usize = N;
        }

        impl<'a, const N: usize> FromWire<'a> for $block<N> {
            #[inline]
            fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
                super::read_whole(input, ())
            }

            #[inline]
            fn read_fixed(input: &'a [u8], (): ()) -> Option<Self> {
                let bytes: &[u8; N] = input.first_chunk()?;
                // Byte by byte what CMD_REALTIME_DATA_4 reserves: copied at once, it would be all for which small programs
                // have memcpy.
                if cfg!(target_os = "none") && N == 18 {
                    let byte = |index| bytes.get(index).copied().unwrap_or_default();
                    return Some(Self(core::array::from_fn(|index| core::hint::black_box(byte(index)))));
                }
                Some(Self(*bytes))
            }
        }

        impl<const N: usize> ToWire for $block<N> {
            #[inline]
            fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
                out.put_array(&self.0)
            }

            #[inline]
            fn write_fixed(&self, (): (), place: &mut [u8]) -> Option<()> {
                *place.first_chunk_mut()? = self.0;
                Some(())
            }
        }
    )* };
}

blocks! {
    /// Block of raw bytes. Spec type `Nb`.
    Bytes
    /// Reserved bytes. They are preserved, because newer firmware may use them.
    Reserved
    /// Text in a fixed number of bytes, padded with zeros. All bytes are preserved.
    FixedText
}

macro_rules! debug_as_hex {
    ($($block:ident)*) => { $(
        impl<const N: usize> core::fmt::Debug for $block<N> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{}", Hex(&self.0))
            }
        }
    )* };
}

debug_as_hex!(Bytes Reserved);

impl<const N: usize> core::fmt::Debug for FixedText<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.as_str() {
            Ok(text) => text.fmt(f),
            Err(_) => write!(f, "{}", Hex(&self.0)),
        }
    }
}

impl<const N: usize> FixedText<N> {
    /// Bytes before the first zero.
    pub fn as_bytes(&self) -> &[u8] {
        self.0.split(|byte| *byte == 0).next().unwrap_or_default()
    }

    /// Text before the first zero.
    ///
    /// # Errors
    /// If the bytes are not UTF-8.
    pub fn as_str(&self) -> Result<&str, core::str::Utf8Error> {
        core::str::from_utf8(self.as_bytes())
    }

    /// Creates the bytes of `text`, padded with zeros.
    ///
    /// # Errors
    /// If it has more than `N` bytes.
    pub fn new(text: &str) -> Result<Self, crate::TextTooLong> {
        let mut bytes = [0; N];
        match bytes.get_mut(..text.len()) {
            Some(place) => place.copy_from_slice(text.as_bytes()),
            None => return Err(crate::TextTooLong { length: text.len(), maximum: N }),
        }
        Ok(Self(bytes))
    }
}

/// Shows bytes as lower-case hex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hex<'b>(pub(crate) &'b [u8]);

impl core::fmt::Display for Hex<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// Text with a length byte in front, borrowed from the payload. Normally ASCII; all bytes are preserved.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Text<'a>(pub &'a [u8]);

impl<'a> Text<'a> {
    /// Text as a string.
    ///
    /// # Errors
    /// If the bytes are not UTF-8.
    pub fn as_str(&self) -> Result<&'a str, core::str::Utf8Error> {
        core::str::from_utf8(self.0)
    }
}

impl core::fmt::Debug for Text<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.as_str() {
            Ok(text) => text.fmt(f),
            Err(_) => write!(f, "{}", Hex(self.0)),
        }
    }
}

impl Layout for Text<'_> {
    const MIN_LEN: usize = 1;
    const MAX_LEN: usize = 255;
}

impl<'a> FromWire<'a> for Text<'a> {
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        let Some((&length, text)) = input.split_first() else { return Fault::short(1, input) };
        match text.split_at_checked(usize::from(length)) {
            Some((text, rest)) => Ok((rest, Text(text))),
            None => Fault::short(1 + usize::from(length), input),
        }
    }
}

impl ToWire for Text<'_> {
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        let Ok(length) = u8::try_from(self.0.len()) else {
            return Err(crate::TextTooLong { length: self.0.len(), maximum: 255 }.into());
        };
        out.put(&[length])?;
        out.put(self.0)
    }
}

impl Layout for &[u8] {
    const MIN_LEN: usize = 0;
    const MAX_LEN: usize = 255;
}

/// All that is left of the payload. Spec type `Nb` without a number.
impl<'a> FromWire<'a> for &'a [u8] {
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        Ok((&[], input))
    }
}

impl ToWire for &[u8] {
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        out.put(self)
    }
}
