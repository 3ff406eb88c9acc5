//! The bytes of a candidate that straddles two chunks.

use heapless::Vec;

use super::MAX_FRAME;

/// A queue of at most one frame's bytes, in one piece.
///
/// What is taken stays in memory until the next [`fill_to`](Self::fill_to), so that a frame can be lent out
/// of it and be gone from it all the same.
#[derive(Clone, Debug, Default)]
pub(super) struct Pending {
    bytes: Vec<u8, MAX_FRAME>,
    /// How many bytes at the start were taken; never more than there are.
    head: usize,
}

impl Pending {
    pub(super) const fn new() -> Self {
        Self { bytes: Vec::new(), head: 0 }
    }

    pub(super) fn as_slice(&self) -> &[u8] {
        self.bytes.get(self.head..).unwrap_or_default()
    }

    pub(super) fn len(&self) -> usize {
        self.bytes.len().saturating_sub(self.head)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Copies from the start of `chunk` until there are `target` bytes, or `chunk` or the room ends; says how
    /// many it copied.
    pub(super) fn fill_to(&mut self, target: usize, chunk: &[u8]) -> usize {
        let len = self.len();
        if self.head > 0 {
            self.bytes.rotate_left(self.head);
            self.bytes.truncate(len);
            self.head = 0;
        }
        let wanted = target.min(MAX_FRAME).saturating_sub(len).min(chunk.len());
        let part = chunk.get(..wanted).unwrap_or_default();
        let fits = self.bytes.extend_from_slice(part).is_ok();
        debug_assert!(fits, "more than one frame is pending");
        part.len()
    }

    /// Forgets the last `count` bytes.
    pub(super) fn give_back(&mut self, count: usize) {
        self.bytes.truncate(self.bytes.len().saturating_sub(count).max(self.head));
    }

    /// Takes up to `count` bytes from the start.
    pub(super) fn take(&mut self, count: usize) -> &[u8] {
        let from = self.head;
        self.head = from.saturating_add(count).min(self.bytes.len());
        self.bytes.get(from..self.head).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_its_bytes_in_order() {
        let mut pending = Pending::new();
        assert_eq!(pending.fill_to(3, b"abcdef"), 3);
        assert_eq!(pending.take(1), b"a");
        assert_eq!(pending.as_slice(), b"bc");
        assert_eq!(pending.fill_to(4, b"def"), 2);
        assert_eq!(pending.as_slice(), b"bcde");
        pending.give_back(1);
        assert_eq!((pending.as_slice(), pending.len()), (&b"bcd"[..], 3));
        assert_eq!(pending.take(9), b"bcd");
        assert!(pending.is_empty());
        pending.give_back(5);
        assert!(pending.is_empty());
    }

    #[test]
    fn never_takes_more_than_a_frame() {
        let mut pending = Pending::new();
        assert_eq!(pending.fill_to(1000, &[1; 1000]), MAX_FRAME);
        assert_eq!(pending.fill_to(1000, &[1; 1000]), 0);
        pending.take(10);
        assert_eq!(pending.fill_to(1000, &[2; 1000]), 10);
        assert_eq!(pending.len(), MAX_FRAME);
    }
}
