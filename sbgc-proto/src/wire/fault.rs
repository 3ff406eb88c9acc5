//! Why a field could not be read, as nom's parsers carry it.

use nom::error::{ErrorKind, ParseError};

/// What [`FromWire::read`](super::FromWire::read) returns: the rest of the input and the value.
pub type Read<'a, T> = nom::IResult<&'a [u8], T, Fault>;

/// A field that could not be read. The payload as a whole makes a [`DecodeError`](crate::DecodeError) of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The spec's name of the innermost field; empty as long as nobody named it.
    pub field: &'static str,
    /// Bytes that the field needs.
    pub needed: usize,
    /// Bytes that were left for it.
    pub left: usize,
}

impl Fault {
    /// A field that needs more bytes than are left, as nom's recoverable error.
    pub(crate) fn short<'a, T>(needed: usize, input: &[u8]) -> Read<'a, T> {
        Err(nom::Err::Error(Fault { field: "", needed, left: input.len() }))
    }

    /// Names the field, unless a field inside it was named already.
    pub(crate) fn named(error: nom::Err<Fault>, field: &'static str) -> nom::Err<Fault> {
        error.map(|fault| if fault.field.is_empty() { Fault { field, ..fault } } else { fault })
    }
}

impl ParseError<&[u8]> for Fault {
    fn from_error_kind(input: &[u8], _kind: ErrorKind) -> Self {
        Fault { field: "", needed: input.len().saturating_add(1), left: input.len() }
    }

    fn append(_input: &[u8], _kind: ErrorKind, other: Self) -> Self {
        other
    }
}
