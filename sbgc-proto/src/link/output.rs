//! Frames that wait to be sent.

use crate::EncodeError;

/// A queue of bytes in one piece.
#[derive(Clone, Debug)]
pub(super) struct Output<const N: usize> {
    bytes: [u8; N],
    start: usize,
    end: usize,
}

impl<const N: usize> Output<N> {
    pub(super) const fn new() -> Self {
        Self { bytes: [0; N], start: 0, end: 0 }
    }

    pub(super) fn as_slice(&self) -> &[u8] {
        self.bytes.get(self.start..self.end).unwrap_or_default()
    }

    /// Appends what `write` puts into the free bytes, whose number it returns.
    pub(super) fn put(
        &mut self,
        write: impl FnOnce(&mut [u8]) -> Result<usize, EncodeError>,
    ) -> Result<(), EncodeError> {
        let free = self.bytes.get_mut(self.end..).unwrap_or_default();
        self.end = self.end.saturating_add(write(free)?).min(N);
        Ok(())
    }

    pub(super) fn sent(&mut self, count: usize) {
        self.start = self.start.saturating_add(count).min(self.end);
        if self.start == self.end {
            (self.start, self.end) = (0, 0);
        }
    }
}
