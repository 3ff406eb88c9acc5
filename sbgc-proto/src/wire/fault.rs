//! Why a field could not be read.

/// What [`FromWire::read`](super::FromWire::read) returns: the rest of the input and the value.
pub type Read<'a, T> = Result<(&'a [u8], T), Fault>;

/// Details of a field that could not be read, which become a [`DecodeError`](crate::DecodeError).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The spec's name of the innermost field whose length varies, or that is of fixed length in one that does; empty
    /// as long as nobody named it.
    pub field: &'static str,
    /// Bytes that the field needs.
    pub needed: usize,
    /// Bytes that were left for it.
    pub left: usize,
}

impl Fault {
    /// A field that needs more bytes than are left.
    #[cold]
    pub(crate) fn short<'a, T>(needed: usize, input: &[u8]) -> Read<'a, T> {
        Err(Fault { field: "", needed, left: input.len() })
    }

    /// Names the field, unless a field inside it was named already.
    #[cold]
    pub(crate) fn named(self, field: &'static str) -> Self {
        if self.field.is_empty() { Fault { field, ..self } } else { self }
    }
}
