//! Encoding and decoding of fields.
//!
//! Contains the traits [`FromWire`], [`ToWire`] and [`Layout`], and general types: floats, per-axis groups, lists,
//! texts and reserved bytes. Physical quantities are in [`units`](crate::units), whole payloads in
//! [`commands`](crate::commands).
//!
//! All numbers are little-endian and packed. Structures of fixed length are read at fixed offsets after a single length
//! check; lists, whose length the payload determines, are parsed element by element.

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
pub(crate) use option::{read_field, read_tail, read_when, read_whole, write_tail, write_when, write_whole};
pub(crate) use slot::fixed;

use crate::EncodeError;

/// Size of a value on the wire.
pub trait Layout: Sized {
    /// Minimum number of bytes.
    const MIN_LEN: usize;
    /// Maximum number of bytes.
    const MAX_LEN: usize;
    /// Whether the size is fixed.
    const FIXED: bool = Self::MIN_LEN == Self::MAX_LEN;
    /// Positions of the fields of a declared struct.
    #[doc(hidden)]
    const SLOTS: &'static [Slot] = &[];
}

/// Decoding from payload bytes. `C` is external context, `()` for most types.
pub trait FromWire<'a, C = ()>: Layout {
    /// Reads a value from the start of `input` and returns the remaining bytes.
    ///
    /// # Errors
    /// If the input ends too early.
    fn read(input: &'a [u8], context: C) -> Read<'a, Self>;

    /// Reads a value of [fixed](Layout::FIXED) size from the start of `input`; `None` if it is too short.
    ///
    /// Without error details and remaining bytes, this compiles to loads from fixed offsets.
    #[inline]
    fn read_fixed(input: &'a [u8], context: C) -> Option<Self> {
        Self::read(input, context).ok().map(|(_, value)| value)
    }
}

/// Encoding to payload bytes. `C` is external context, as in [`FromWire`].
pub trait ToWire<C = ()> {
    /// Appends the value to `out`.
    ///
    /// # Errors
    /// If `out` is full or the value is inconsistent, for example if an optional field is present although its flag is
    /// not set.
    fn write(&self, context: C, out: &mut Writer<'_>) -> Result<(), EncodeError>;

    /// Writes a value of [fixed](Layout::FIXED) length to the front of `place`, or returns nothing where that is
    /// shorter.
    ///
    /// No error to build and no length to count, so it comes down to stores to fixed offsets.
    #[inline]
    fn write_fixed(&self, context: C, place: &mut [u8]) -> Option<()> {
        self.write(context, &mut Writer::new(place)).ok()
    }
}
