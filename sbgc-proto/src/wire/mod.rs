//! How one field becomes bytes and back: the vocabulary in which messages are declared.
//!
//! Here live the traits [`FromWire`], [`ToWire`] and [`Layout`], and the types that know nothing of gimbals: integers,
//! floats, arrays, per-axis groups, lists, texts, reserved bytes. Physical quantities are in
//! [`units`](crate::units), whole payloads in [`commands`](crate::commands).
//!
//! All numbers are little-endian and packed. What always has the same length is read at fixed offsets of a slice that is
//! known to be long enough, without a step that can fail for each field; lists, whose length the payload decides, are
//! parsed by nom.

mod axes;
mod bytes;
mod fault;
mod list;
mod number;
mod option;
mod packed;
mod slot;
#[cfg(test)]
mod tests;
mod writer;

pub use axes::{PerAxis, PerXyz};
pub use bytes::{Bytes, FixedText, Reserved, Text};
pub use fault::{Fault, Read};
pub use list::List;
pub use number::{Float, Label, U24};
pub use packed::{Element, Elements, Packed};
pub use slot::Slot;
pub use writer::Writer;

#[cfg(any(feature = "serde", test))]
pub(crate) use bytes::Hex;
pub(crate) use option::{read_field, read_tail, read_when, read_whole, write_tail, write_when};
pub(crate) use slot::fixed;

use crate::EncodeError;

/// How many bytes a value takes on the wire.
pub trait Layout: Sized {
    /// The minimum number of bytes.
    const MIN_LEN: usize;
    /// The most bytes.
    const MAX_LEN: usize;
    /// Whether it always takes the same number of bytes.
    const FIXED: bool = Self::MIN_LEN == Self::MAX_LEN;
    /// The places of the fields, for a declared struct.
    #[doc(hidden)]
    const SLOTS: &'static [Slot] = &[];
}

/// Can be decoded from the bytes of a payload. `C` is external context, `()` for most types.
pub trait FromWire<'a, C = ()>: Layout {
    /// Reads a value from the front of `input` and returns what follows it.
    ///
    /// # Errors
    /// If the input ends too early.
    fn read(input: &'a [u8], context: C) -> Read<'a, Self>;

    /// Reads a value of [fixed](Layout::FIXED) length from the front of `input`, or nothing where that is shorter.
    ///
    /// No error to build and no rest to return, so it comes down to loads from fixed offsets.
    #[inline]
    fn read_fixed(input: &'a [u8], context: C) -> Option<Self> {
        Self::read(input, context).ok().map(|(_, value)| value)
    }
}

/// Can be written as bytes of a payload. `C` is the same as in [`FromWire`].
pub trait ToWire<C = ()> {
    /// Appends the value to `out`.
    ///
    /// # Errors
    /// When `out` is full, or when the value contradicts itself, for example in an optional part that is there though
    /// a flag says that it is not.
    fn write(&self, context: C, out: &mut Writer<'_>) -> Result<(), EncodeError>;
}
