//! The place that fields are written to.

use crate::EncodeError;

/// Appends bytes to a slice of the caller's.
#[derive(Debug)]
pub struct Writer<'o> {
    buffer: &'o mut [u8],
    length: usize,
}

impl<'o> Writer<'o> {
    /// Writes from the front of `buffer` on.
    pub fn new(buffer: &'o mut [u8]) -> Self {
        Self { buffer, length: 0 }
    }

    /// Writes behind the first `length` bytes of `buffer`, which count as written.
    pub(crate) fn after(buffer: &'o mut [u8], length: usize) -> Self {
        Self { buffer, length }
    }

    /// Bytes written so far.
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether nothing was written yet.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Appends so many bytes.
    ///
    /// # Errors
    /// [`EncodeError::BufferTooSmall`] if they do not fit; nothing is written then.
    #[inline]
    pub fn put_array<const N: usize>(&mut self, bytes: &[u8; N]) -> Result<(), EncodeError> {
        match self.buffer.get_mut(self.length..).and_then(<[u8]>::first_chunk_mut) {
            Some(place) => {
                *place = *bytes;
                self.length += N;
                Ok(())
            }
            None => Err(self.full(N)),
        }
    }

    /// Appends `bytes`.
    ///
    /// # Errors
    /// [`EncodeError::BufferTooSmall`] when they do not fit; nothing is written then.
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), EncodeError> {
        let end = self.length.saturating_add(bytes.len());
        match self.buffer.get_mut(self.length..end) {
            Some(place) => {
                // Not `copy_from_slice`, whose panic the smallest builds keep.
                place.iter_mut().zip(bytes).for_each(|(place, byte)| *place = *byte);
                self.length = end;
                Ok(())
            }
            None => Err(self.full(bytes.len())),
        }
    }

    #[cold]
    fn full(&self, more: usize) -> EncodeError {
        EncodeError::BufferTooSmall { needed: self.length.saturating_add(more), capacity: self.buffer.len() }
    }
}
