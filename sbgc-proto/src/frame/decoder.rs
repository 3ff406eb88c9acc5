//! Incremental decoder of frames.

use super::counters::Tally;
use super::pending::Pending;
use super::scan::{Header, Measure, measure};
use super::{Cause, Counters, Frame, HEADER, Skipped, Versions};

/// Event reported by the [`Decoder`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Event<'a> {
    /// A frame.
    Frame {
        /// Offset of its first byte in the stream.
        at: u64,
        /// Frame.
        frame: Frame<'a>,
    },
    /// Bytes that belong to no frame.
    Skipped(Skipped),
}

/// Incremental decoder that finds frames in a stream of chunks of any size.
///
/// It does not allocate. A frame that lies completely in the caller's chunk is borrowed from it; only a frame that
/// straddles chunks is assembled in the decoder's buffer, which holds one frame of maximum length. The chunk boundaries
/// affect neither the frames nor the skipped bytes, only the number of pieces in which a run of noise is reported (see
/// [`Skipped::join`]).
///
/// The decoder does not know the time. A start byte in noise may announce 255 bytes that never arrive, so a driver
/// should check [`pending`](Self::pending) when [`next`](Self::next) has returned `None`, and call
/// [`skip_candidate`](Self::skip_candidate) after a gap that is too long for one within a frame.
///
/// The work per byte is bounded: each byte is checked as part of at most one candidate for each of the 260 bytes before
/// it, and usually of a single one.
///
/// # Borrowing
/// An event may borrow from the decoder, so it must be dropped before the next call:
///
/// ```compile_fail,E0499
/// use sbgc_proto::frame::{Decoder, Versions};
///
/// let mut decoder = Decoder::new(Versions::Both);
/// let mut chunk = &b"\x3E\x56\x00\x56\x00\x3E\x56\x00\x56\x00"[..];
/// let first = decoder.next(&mut chunk);
/// let second = decoder.next(&mut chunk);
/// assert!(first.is_some());
/// ```
///
/// An event may also borrow from the chunk, which must outlive it:
///
/// ```compile_fail,E0597
/// use sbgc_proto::frame::{Decoder, Versions};
///
/// let mut decoder = Decoder::new(Versions::Both);
/// let first = {
///     let bytes = [0x3E, 0x56, 0x00, 0x56, 0x00];
///     decoder.next(&mut &bytes[..])
/// };
/// assert!(first.is_some());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    versions: Versions,
    /// Between calls: empty, or bytes of earlier chunks that no event has told of.
    pending: Pending,
    tally: Tally,
}

impl Decoder {
    /// Creates a decoder at the start of a stream.
    pub const fn new(versions: Versions) -> Self {
        Self { versions, pending: Pending::new(), tally: Tally::new() }
    }

    /// Returns the next event, or `None` when `input` is used up.
    ///
    /// Advances `input` past the used bytes, so the caller can stop after any event and continue later with the rest.
    /// With an empty `input`, it reports events that need no more bytes.
    ///
    /// ```
    /// use sbgc_proto::frame::{Decoder, Event, Versions};
    ///
    /// let mut decoder = Decoder::new(Versions::Both);
    /// let mut chunk = &b"\x3E\x56\x00\x56\x00\x3E\x19"[..];
    /// let event = decoder.next(&mut chunk);
    /// assert!(matches!(event, Some(Event::Frame { at: 0, frame }) if frame.id == 0x56));
    /// assert_eq!(decoder.next(&mut chunk), None);
    /// assert_eq!((chunk, decoder.pending()), (&[][..], 2));
    /// ```
    // The two lifetimes are apart so that a loop can call it again with the same cursor.
    #[inline]
    pub fn next<'a, 'c: 'a>(&'a mut self, input: &mut &'c [u8]) -> Option<Event<'a>> {
        if self.pending.is_empty() {
            return self.next_from_chunk(input);
        }
        if let (&[byte], true) = (*input, self.pending.lacks() > 1) {
            self.pending.push(byte);
            *input = &[];
            return None;
        }
        self.next_from_pending(input)
    }

    /// Adds one byte, for example in an interrupt, and returns the next event, if any.
    ///
    /// While a candidate is incomplete, this is one store and one comparison. A byte that ends a false candidate may
    /// cause several events; [`more`](Self::more) returns the others. If it is not called, each further byte returns
    /// one of them.
    ///
    /// ```
    /// use sbgc_proto::frame::{Decoder, Event, Versions};
    ///
    /// let mut decoder = Decoder::new(Versions::Both);
    /// let mut ids = Vec::new();
    /// // A false start that announces 3 bytes, and a frame that is all over before it.
    /// for byte in *b"\x3E\x01\x03\x04\x3E\x56\x00\x56\x00" {
    ///     let mut next = decoder.push(byte);
    ///     while let Some(event) = next {
    ///         if let Event::Frame { frame, .. } = event {
    ///             ids.push(frame.id);
    ///         }
    ///         next = decoder.more();
    ///     }
    /// }
    /// assert_eq!(ids, [0x56]);
    /// ```
    #[inline]
    pub fn push(&mut self, byte: u8) -> Option<Event<'_>> {
        self.put(byte);
        if self.is_ready() { self.more() } else { None }
    }

    /// Adds one byte and leaves its processing to [`more`](Self::more), which must be called as long as the decoder [is
    /// ready](Self::is_ready).
    #[inline]
    pub(crate) fn put(&mut self, byte: u8) {
        self.pending.push(byte);
    }

    /// Whether there may be an event to report.
    #[inline]
    pub(crate) const fn is_ready(&self) -> bool {
        self.pending.lacks() == 0 && !self.pending.is_empty()
    }

    /// Payload of the frame that [`more`](Self::more) reported last; valid until the next byte.
    pub(crate) fn last_payload(&self, length: usize) -> &[u8] {
        self.pending.taken(HEADER, length)
    }

    /// Returns the next event that needs no further byte.
    pub fn more(&mut self) -> Option<Event<'_>> {
        loop {
            if !self.is_ready() {
                return None;
            }
            match measure(self.pending.as_slice(), self.versions) {
                Measure::Frame(header) => return Some(self.take_frame(header)),
                Measure::Skip { used, cause } => return Some(self.take_skipped(used, cause)),
                Measure::NeedMore { at_least } => self.pending.wait_for(at_least),
            }
        }
    }

    #[inline]
    fn next_from_chunk<'c>(&mut self, input: &mut &'c [u8]) -> Option<Event<'c>> {
        let chunk = *input;
        match measure(chunk, self.versions) {
            Measure::Frame(header) => {
                advance(input, header.frame_len());
                Some(Event::Frame { at: self.tally.frame(header.frame_len()), frame: header.frame(chunk) })
            }
            Measure::Skip { used, cause } => {
                advance(input, used);
                Some(Event::Skipped(self.tally.skip(used, cause)))
            }
            Measure::NeedMore { at_least } => {
                self.pending.wait_for(at_least);
                let copied = self.pending.fill(chunk);
                advance(input, copied);
                None
            }
        }
    }

    fn next_from_pending(&mut self, input: &mut &[u8]) -> Option<Event<'_>> {
        // Bytes copied from `input` are not used up before it is clear that the candidate needs them: if it is
        // refused, whatever hides behind its start byte may lie whole in the chunk.
        let mut copied = 0;
        loop {
            if self.pending.lacks() > 0 {
                copied += self.pending.fill(input.get(copied..).unwrap_or_default());
                if self.pending.lacks() > 0 {
                    advance(input, copied);
                    return None;
                }
            }
            match measure(self.pending.as_slice(), self.versions) {
                Measure::Frame(header) => {
                    advance(input, copied);
                    return Some(self.take_frame(header));
                }
                Measure::Skip { used, cause } => {
                    self.pending.give_back(copied);
                    return Some(self.take_skipped(used, cause));
                }
                Measure::NeedMore { at_least } => self.pending.wait_for(at_least),
            }
        }
    }

    fn take_frame(&mut self, header: Header) -> Event<'_> {
        let length = header.frame_len();
        let at = self.tally.frame(length);
        Event::Frame { at, frame: header.frame(self.pending.take(length)) }
    }

    fn take_skipped(&mut self, used: usize, cause: Cause) -> Event<'static> {
        self.pending.take(used);
        Event::Skipped(self.tally.skip(used, cause))
    }

    /// Returns the next event at the end of the stream, or `None` when all bytes are accounted for.
    ///
    /// An incomplete frame is skipped as [`Cause::Truncated`], one start byte at a time, so that frames hidden behind a
    /// false start byte are found. The decoder remains usable: offsets and counters continue.
    ///
    /// ```
    /// use sbgc_proto::frame::{Cause, Decoder, Event, Skipped, Versions};
    ///
    /// let mut decoder = Decoder::new(Versions::Both);
    /// // A false start that announces 9 bytes, and a frame behind it.
    /// let mut input = &b"\x3E\x01\x09\x0A\x3E\x56\x00\x56\x00"[..];
    /// assert_eq!(decoder.next(&mut input), None);
    ///
    /// let truncated = Skipped { at: 0, length: 1, cause: Cause::Truncated };
    /// assert_eq!(decoder.finish(), Some(Event::Skipped(truncated)));
    /// let noise = Skipped { at: 1, length: 3, cause: Cause::NoStartByte };
    /// assert_eq!(decoder.finish(), Some(Event::Skipped(noise)));
    /// assert!(matches!(decoder.finish(), Some(Event::Frame { at: 4, .. })));
    /// assert_eq!(decoder.finish(), None);
    /// ```
    pub fn finish(&mut self) -> Option<Event<'_>> {
        // Asked twice rather than kept: an event borrows the decoder.
        match self.skip_candidate() {
            Some(skipped) => Some(Event::Skipped(skipped)),
            None => self.more(),
        }
    }

    /// Abandons the incomplete frame and returns its skipped start byte.
    ///
    /// The bytes after it stay pending and are scanned again by the next call of [`next`](Self::next), which needs no
    /// new bytes for that. They may contain frames, and another incomplete candidate: call again to abandon that one,
    /// too.
    ///
    /// Returns `None` and changes nothing if no candidate is waiting for bytes: either nothing is pending, or `next`
    /// can report the pending bytes first.
    ///
    /// ```
    /// use sbgc_proto::frame::{Decoder, Event, Versions};
    ///
    /// let mut decoder = Decoder::new(Versions::Both);
    /// // A false start that announces 200 bytes, then a frame, then silence.
    /// let mut input = &b"\x24\x20\xC8\xE8\x3E\x56\x00\x56\x00"[..];
    /// assert_eq!(decoder.next(&mut input), None);
    ///
    /// assert_eq!(decoder.skip_candidate().map(|skipped| skipped.length), Some(1));
    /// let mut ids = [0; 1];
    /// while let Some(event) = decoder.next(&mut &[][..]) {
    ///     if let Event::Frame { frame, .. } = event {
    ///         ids[0] = frame.id;
    ///     }
    /// }
    /// assert_eq!(ids, [0x56]);
    /// ```
    pub fn skip_candidate(&mut self) -> Option<Skipped> {
        if self.pending.is_empty() {
            return None;
        }
        if self.pending.lacks() == 0
            && !matches!(measure(self.pending.as_slice(), self.versions), Measure::NeedMore { .. })
        {
            return None;
        }
        self.pending.take(1);
        Some(self.tally.skip(1, Cause::Truncated))
    }

    /// Number of bytes not yet reported by an event, at most 260 after [`next`](Self::next) returned `None`. If it did
    /// and this is not 0, a candidate is waiting for its bytes.
    pub const fn pending(&self) -> usize {
        self.pending.len()
    }

    /// Offset in the stream at which the next event will start.
    pub const fn position(&self) -> u64 {
        self.tally.bytes()
    }

    /// Counters since the start or the last [`reset`](Self::reset).
    ///
    /// Counters and event offsets are machine words internally: on 32-bit targets, they wrap to 0 after 4 GiB.
    pub const fn counters(&self) -> Counters {
        self.tally.counters()
    }

    /// Accepted versions.
    pub const fn versions(&self) -> Versions {
        self.versions
    }

    /// Accepts `versions` from the next byte that is not yet reported.
    pub const fn set_versions(&mut self, versions: Versions) {
        self.versions = versions;
        self.pending.look_again();
    }

    /// Discards pending bytes and counters and starts a new stream at offset 0.
    pub fn reset(&mut self) {
        *self = Self::new(self.versions);
    }
}

#[inline]
fn advance(input: &mut &[u8], count: usize) {
    *input = input.get(count..).unwrap_or_default();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_pieces_that_touch_are_joined() {
        let first = Skipped { at: 5, length: 2, cause: Cause::NoStartByte };
        let next = Skipped { at: 7, length: 3, ..first };
        assert_eq!(first.join(next), Some(Skipped { length: 5, ..first }));
        assert_eq!(first.join(Skipped { at: 8, ..next }), None);
        assert_eq!(first.join(Skipped { cause: Cause::Truncated, ..next }), None);
        assert_eq!(next.join(first), None);
    }
}
