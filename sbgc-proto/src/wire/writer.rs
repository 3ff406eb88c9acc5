//! Output for encoding fields.

use crate::EncodeError;

/// Writer that appends bytes to a caller's slice.
#[derive(Debug)]
pub struct Writer<'o> {
    buffer: &'o mut [u8],
    length: usize,
}

impl<'o> Writer<'o> {
    /// Creates a writer that starts at the beginning of `buffer`.
    pub fn new(buffer: &'o mut [u8]) -> Self {
        Self { buffer, length: 0 }
    }

    /// Writes behind the first `length` bytes of `buffer`, which count as written.
    pub(crate) fn after(buffer: &'o mut [u8], length: usize) -> Self {
        Self { buffer, length }
    }

    /// Number of bytes written so far.
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether nothing was written yet.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Appends an array of bytes.
    ///
    /// # Errors
    /// If they do not fit: [`EncodeError::BufferTooSmall`]. Nothing is written in that case.
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
    /// If they do not fit: [`EncodeError::BufferTooSmall`]. Nothing is written in that case.
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

    /// Appends `count` bytes that `write` puts in their place.
    #[inline]
    pub(crate) fn put_with(
        &mut self,
        count: usize,
        write: impl FnOnce(&mut [u8]) -> Option<()>,
    ) -> Result<(), EncodeError> {
        let place = self.buffer.get_mut(self.length..).and_then(|rest| rest.get_mut(..count));
        match place.and_then(write) {
            Some(()) => {
                self.length += count;
                Ok(())
            }
            None => Err(self.full(count)),
        }
    }

    #[cold]
    fn full(&self, more: usize) -> EncodeError {
        EncodeError::BufferTooSmall { needed: self.length.saturating_add(more), capacity: self.buffer.len() }
    }
}
