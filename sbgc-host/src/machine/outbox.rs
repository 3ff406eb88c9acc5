//! What is about to go out: the newest set-points, and the batch that the port is taking.

use std::collections::VecDeque;

use bytes::Bytes;
use sbgc_proto::frame::{self, BOARD_BUFFER, EncodeFrameError, MAX_PAYLOAD, Version};

/// Set-points that wait to be sent, one per command: a stale one is worse than none.
#[derive(Debug, Default)]
pub(super) struct Setpoints(VecDeque<(u8, Bytes)>);

impl Setpoints {
    /// Puts one in. Returns whether an older one made way for it.
    pub(super) fn put(&mut self, command: u8, payload: Bytes) -> bool {
        match self.0.iter_mut().find(|(other, _)| *other == command) {
            Some(older) => {
                older.1 = payload;
                true
            }
            None => {
                self.0.push_back((command, payload));
                false
            }
        }
    }

    /// Takes the one that waits longest, if its payload is not longer than `room`.
    pub(super) fn take(&mut self, room: usize) -> Option<(u8, Bytes)> {
        let fits = self.0.front().is_some_and(|(_, payload)| payload.len() <= room);
        if fits { self.0.pop_front() } else { None }
    }

    /// Drops that of a command. Returns whether there was one.
    pub(super) fn remove(&mut self, command: u8) -> bool {
        let before = self.0.len();
        self.0.retain(|(other, _)| *other != command);
        self.0.len() < before
    }

    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// A frame in the batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    /// Number of its command in the table of requests.
    number: u64,
    length: usize,
    kind: Kind,
}

/// What kind of frame is added to a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Goes before all others.
    Urgent,
    /// The set-point of this command.
    Setpoint(u8),
    Other,
}

/// Frames that the port is taking. Those of which it has taken nothing yet can be taken back.
#[derive(Debug, Default)]
pub(super) struct Batch {
    /// What the port has not yet taken.
    bytes: Vec<u8>,
    frames: VecDeque<Place>,
    /// How many bytes of the first frame are written.
    begun: usize,
    /// How many bytes of the whole batch are written.
    written: usize,
}

impl Batch {
    pub(super) fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// How many payload bytes the next frame may have if so many bytes of the board's buffer are taken; `None` if there
    /// is no room for any frame.
    pub(super) fn room(&self, version: Version, taken: usize) -> Option<usize> {
        if self.is_empty() && taken == 0 {
            // Alone in its batch goes whatever was let in, so that nothing stays for ever.
            return Some(MAX_PAYLOAD);
        }
        // What the port has begun with is as long as it is.
        let length = if self.written > 0 { BOARD_BUFFER } else { self.bytes.len() };
        BOARD_BUFFER.checked_sub(length + taken + version.overhead())
    }

    /// Adds a frame.
    pub(super) fn add(
        &mut self,
        version: Version,
        number: u64,
        (command, payload): (u8, &[u8]),
        kind: Kind,
    ) -> Result<(), EncodeFrameError> {
        let mut buffer = [0; frame::MAX_FRAME];
        let frame = frame::encode_into(version, command, payload, &mut buffer)?;
        let index = match kind {
            Kind::Urgent => self.frames.iter().take_while(|place| place.kind == Kind::Urgent).count(),
            Kind::Setpoint(_) | Kind::Other => self.frames.len(),
        };
        let at = self.frames.iter().take(index).map(|place| place.length).sum::<usize>();
        let at = at.min(self.bytes.len());
        self.bytes.splice(at..at, frame.iter().copied());
        self.frames.insert(index, Place { number, length: frame.len(), kind });
        Ok(())
    }

    /// The bytes that the port has not yet taken.
    pub(super) fn pending(&self) -> &[u8] {
        &self.bytes
    }

    /// The port took so many bytes.
    pub(super) fn take(&mut self, count: usize) {
        let count = count.min(self.bytes.len());
        self.bytes.drain(..count);
        self.begun += count;
        self.written += count;
    }

    /// The number of the next command whose frame is wholly written, and how long that is; call it until there is none.
    pub(super) fn next_written(&mut self) -> Option<(u64, usize)> {
        let first = self.frames.front()?;
        self.begun = self.begun.checked_sub(first.length)?;
        self.frames.pop_front().map(|place| (place.number, place.length))
    }

    /// How many bytes the batch had, once all of it is written.
    pub(super) fn finish(&mut self) -> Option<usize> {
        (self.is_empty() && self.written > 0).then(|| std::mem::take(&mut self.written))
    }

    /// Takes back the frame of a command. Returns whether it was there and the port had not begun with it.
    pub(super) fn withdraw(&mut self, number: u64) -> bool {
        self.remove(|place| place.number == number).is_some()
    }

    /// Takes back the set-point of a command. Returns its number.
    pub(super) fn withdraw_setpoint(&mut self, command: u8) -> Option<u64> {
        self.remove(|place| place.kind == Kind::Setpoint(command))
    }

    fn remove(&mut self, is_it: impl Fn(&Place) -> bool) -> Option<u64> {
        let index = self.frames.iter().position(is_it)?;
        if index == 0 && self.begun > 0 {
            return None;
        }
        let start = self.frames.iter().take(index).map(|place| place.length).sum::<usize>();
        let start = start.saturating_sub(self.begun);
        let place = self.frames.remove(index)?;
        let end = (start + place.length).min(self.bytes.len());
        self.bytes.drain(start..end);
        Some(place.number)
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn add(batch: &mut Batch, number: u64, command: u8, kind: Kind) {
        batch.add(Version::V1, number, (command, &[]), kind).unwrap();
    }

    fn ids(batch: &Batch) -> Vec<u8> {
        batch.pending().chunks(5).map(|frame| frame[1]).collect()
    }

    #[test]
    fn the_newest_set_point_of_each_command_is_kept() {
        let mut setpoints = Setpoints::default();
        assert!(!setpoints.put(67, Bytes::from_static(&[1])));
        assert!(!setpoints.put(45, Bytes::from_static(&[2])));
        assert!(setpoints.put(67, Bytes::from_static(&[3])));
        assert_eq!(setpoints.take(0), None);
        assert_eq!(setpoints.take(9), Some((67, Bytes::from_static(&[3]))));
        assert!(setpoints.remove(45) && !setpoints.remove(45) && setpoints.is_empty());
    }

    #[test]
    fn urgent_frames_go_first_and_keep_their_order() {
        let mut batch = Batch::default();
        add(&mut batch, 1, 86, Kind::Other);
        add(&mut batch, 2, 109, Kind::Urgent);
        add(&mut batch, 3, 67, Kind::Urgent);
        assert_eq!(ids(&batch), [109, 67, 86]);
    }

    #[test]
    fn what_the_port_has_not_begun_with_can_be_taken_back() {
        let mut batch = Batch::default();
        add(&mut batch, 1, 86, Kind::Other);
        add(&mut batch, 2, 67, Kind::Setpoint(67));
        add(&mut batch, 3, 73, Kind::Other);
        batch.take(2);
        assert!(!batch.withdraw(1) && batch.withdraw(3) && !batch.withdraw(3));
        assert_eq!(batch.withdraw_setpoint(67), Some(2));
        assert_eq!(batch.pending().len(), 3);
        batch.take(3);
        assert_eq!((batch.next_written(), batch.next_written()), (Some((1, 5)), None));
        assert_eq!((batch.finish(), batch.finish()), (Some(5), None));
    }

    #[test]
    fn a_batch_that_is_begun_has_no_room() {
        let mut batch = Batch::default();
        assert_eq!(batch.room(Version::V1, 0), Some(MAX_PAYLOAD));
        assert_eq!(batch.room(Version::V1, 100), Some(BOARD_BUFFER - 105));
        add(&mut batch, 1, 86, Kind::Other);
        assert_eq!(batch.room(Version::V1, 0), Some(BOARD_BUFFER - 10));
        assert_eq!((batch.room(Version::V1, 245), batch.room(Version::V1, 246)), (Some(0), None));
        batch.take(1);
        assert_eq!(batch.room(Version::V1, 0), None);
    }
}
