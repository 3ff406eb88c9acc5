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

    /// Bytes written so far.
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether nothing was written yet.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Appends `bytes`.
    ///
    /// # Errors
    /// [`EncodeError::BufferTooSmall`] when they do not fit; nothing is written then.
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), EncodeError> {
        let end = self.length.saturating_add(bytes.len());
        let capacity = self.buffer.len();
        match self.buffer.get_mut(self.length..end) {
            Some(place) => {
                place.copy_from_slice(bytes);
                self.length = end;
                Ok(())
            }
            None => Err(EncodeError::BufferTooSmall { needed: end, capacity }),
        }
    }
}
