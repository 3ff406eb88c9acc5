//! The bytes of a candidate that straddles two chunks.

use super::MAX_FRAME;

/// How many bytes there is room for, those included that were taken: on computers for so many that the rest is moved to
/// the front once a frame, however small the steps are in which false candidates are taken.
const ROOM: usize = if cfg!(target_os = "none") { MAX_FRAME } else { 2 * MAX_FRAME };

/// A queue of at most one frame's bytes, in one piece, that knows when it is worth a look.
///
/// What is taken stays in memory until the next byte is put in, so that a frame can be lent out of it and be gone from
/// it all the same.
#[derive(Clone, Debug)]
pub(super) struct Pending {
    bytes: [u8; ROOM],
    /// Where the bytes start that were not taken.
    head: usize,
    /// Where they end. 0, as `head`, once all were taken.
    end: usize,
    /// The candidate at `head` waits until `end` is here.
    until: usize,
    /// Where those bytes start that were taken last.
    taken: usize,
}

impl Pending {
    pub(super) const fn new() -> Self {
        Self { bytes: [0; ROOM], head: 0, end: 0, until: 0, taken: 0 }
    }

    pub(super) fn as_slice(&self) -> &[u8] {
        self.bytes.get(self.head..self.end).unwrap_or_default()
    }

    pub(super) const fn len(&self) -> usize {
        self.end.saturating_sub(self.head)
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.end == self.head
    }

    /// How many bytes have to come before there is anything new to see, as far as is known.
    #[inline]
    pub(super) const fn lacks(&self) -> usize {
        self.until.saturating_sub(self.end)
    }

    /// The next look is worth it once there are `length` bytes, which is at most [`MAX_FRAME`].
    pub(super) fn wait_for(&mut self, length: usize) {
        if self.head + length > ROOM {
            self.move_to_front();
        }
        self.until = (self.head + length).min(ROOM);
    }

    /// What is known of the candidate holds no more.
    pub(super) const fn look_again(&mut self) {
        self.until = 0;
    }

    /// Puts one byte in.
    #[inline]
    pub(super) fn push(&mut self, byte: u8) {
        if self.end >= ROOM {
            self.move_to_front();
        }
        if let Some(place) = self.bytes.get_mut(self.end) {
            *place = byte;
            self.end += 1;
        } else {
            debug_assert!(false, "more than one frame is pending");
        }
    }

    /// Puts in from `chunk` what the candidate [lacks](Self::lacks) and says how many bytes that were.
    pub(super) fn fill(&mut self, chunk: &[u8]) -> usize {
        let count = self.lacks().min(chunk.len());
        if cfg!(target_os = "none") || count < 4 {
            // Byte by byte, for that takes less code than a call of memcpy needs besides memcpy itself.
            for &byte in chunk {
                if self.lacks() == 0 {
                    break;
                }
                self.push(byte);
            }
        } else if let (Some(place), Some(part)) =
            (self.bytes.get_mut(self.end..self.end + count), chunk.get(..count))
        {
            place.copy_from_slice(part);
            self.end += count;
        }
        count
    }

    /// Forgets the last `count` bytes.
    pub(super) const fn give_back(&mut self, count: usize) {
        let end = self.end.saturating_sub(count);
        self.end = if end < self.head { self.head } else { end };
    }

    /// Takes up to `count` bytes from the start. What follows is worth a look.
    pub(super) fn take(&mut self, count: usize) -> &[u8] {
        let from = self.head;
        let to = from.saturating_add(count).min(self.end);
        (self.head, self.until, self.taken) = (to, 0, from);
        if to == self.end {
            (self.head, self.end) = (0, 0);
        }
        self.bytes.get(from..to).unwrap_or_default()
    }

    /// `length` of the bytes that were taken last, from the offset `skip` on, as long as nothing was put in since.
    pub(super) fn taken(&self, skip: usize, length: usize) -> &[u8] {
        let start = self.taken.saturating_add(skip);
        self.bytes.get(start..start.saturating_add(length)).unwrap_or_default()
    }

    /// Makes the room of the taken bytes free.
    #[cold]
    fn move_to_front(&mut self) {
        let head = core::mem::take(&mut self.head);
        self.until = self.until.saturating_sub(head);
        if cfg!(target_os = "none") {
            // The way out before each store keeps this from becoming a call of memmove, which is as large as the rest.
            for (to, from) in (head..self.end).enumerate() {
                let (Some(&byte), true) = (self.bytes.get(from), to < from) else { break };
                if let Some(place) = self.bytes.get_mut(to) {
                    *place = byte;
                }
            }
        } else if head <= self.end && self.end <= ROOM {
            self.bytes.copy_within(head..self.end, 0);
        }
        self.end = self.end.saturating_sub(head);
    }
}

impl Default for Pending {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As a decoder fills it that is told how many bytes there should be.
    fn fill_to(pending: &mut Pending, length: usize, chunk: &[u8]) -> usize {
        pending.wait_for(length);
        pending.fill(chunk)
    }

    #[test]
    fn keeps_its_bytes_in_order() {
        let mut pending = Pending::new();
        assert_eq!(fill_to(&mut pending, 3, b"abcdef"), 3);
        assert_eq!(pending.take(1), b"a");
        assert_eq!(pending.as_slice(), b"bc");
        assert_eq!(fill_to(&mut pending, 4, b"def"), 2);
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
        assert_eq!(fill_to(&mut pending, MAX_FRAME, &[1; 1000]), MAX_FRAME);
        assert_eq!(pending.fill(&[1; 1000]), 0);
        pending.take(10);
        assert_eq!(fill_to(&mut pending, MAX_FRAME, &[2; 1000]), 10);
        assert_eq!(pending.len(), MAX_FRAME);
        assert_eq!(pending.as_slice()[250..], [1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2]);
    }

    #[test]
    fn single_bytes_find_room_behind_those_taken() {
        let mut pending = Pending::new();
        for round in 0..3 {
            while pending.len() < MAX_FRAME {
                pending.push(round);
            }
            assert_eq!(pending.take(200).len(), 200);
        }
        assert_eq!(pending.as_slice(), [2; 61]);
    }

    #[test]
    fn waits_until_the_candidate_is_long_enough() {
        let mut pending = Pending::new();
        pending.wait_for(4);
        assert_eq!(pending.lacks(), 4);
        pending.push(1);
        assert_eq!((pending.lacks(), pending.fill(&[2; 9]), pending.lacks()), (3, 3, 0));
        pending.wait_for(MAX_FRAME);
        pending.take(1);
        assert_eq!(pending.lacks(), 0);
        pending.wait_for(4);
        assert_eq!(pending.lacks(), 1);
        pending.look_again();
        assert_eq!(pending.lacks(), 0);
    }
}
