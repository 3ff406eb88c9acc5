//! Frames out of a stream that comes in chunks.

use super::counters::Tally;
use super::pending::Pending;
use super::scan::{Header, Measure, measure};
use super::{Cause, Counters, Frame, HEADER, Skipped, Versions};

/// What the [`Decoder`] found next in the stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Event<'a> {
    /// A frame.
    Frame {
        /// Where it starts, in bytes from the start of the stream.
        at: u64,
        /// The frame.
        frame: Frame<'a>,
    },
    /// Bytes that belong to no frame.
    Skipped(Skipped),
}

/// Finds frames in a stream that comes in chunks of any size.
///
/// It allocates nothing. A frame that lies whole in the caller's chunk is lent from there; only one that
/// straddles chunks is put together in the decoder's own buffer, which holds the longest frame. How the
/// stream is cut changes neither the frames nor what is skipped, only in how many pieces a run of noise is
/// reported (see [`Skipped::join`]).
///
/// Time is not its business. A start byte in noise may announce 255 bytes that never come, so a driver should
/// look at [`pending`](Self::pending) when [`next`](Self::next) has returned `None` and, after a gap too long
/// for one inside a frame, call [`skip_candidate`](Self::skip_candidate).
///
/// The work for one byte is bounded: it is checked as part of at most one candidate for each of the 260
/// bytes before it, and of one, as a rule.
///
/// # Borrowing
/// An event may point into the decoder, so it must be gone before the next call:
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
/// and so must the chunk stay while it lives:
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
    /// A decoder at the start of a stream.
    pub const fn new(versions: Versions) -> Self {
        Self { versions, pending: Pending::new(), tally: Tally::new() }
    }

    /// The next event, or `None` once `input` is used up.
    ///
    /// Moves `input` on past what was used: after an event the caller may stop, and goes on later with what
    /// `input` then holds. With an empty `input` it reports what is known without more bytes.
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

    /// Takes one byte, as an interrupt brings it, and returns the next event if one can be told.
    ///
    /// While a candidate lacks bytes this is a store and a comparison. There is room for the byte whatever was told
    /// before, but a byte that ends a false candidate may bring more than one event; [`more`](Self::more) has the rest.
    /// Whoever does not ask for it gets one more with each byte.
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

    /// Takes one byte and leaves the look at it to [`more`](Self::more), which has to be called as long as the decoder
    /// [is ready](Self::is_ready).
    #[inline]
    pub(crate) fn put(&mut self, byte: u8) {
        self.pending.push(byte);
    }

    /// Whether there may be something to tell.
    #[inline]
    pub(crate) const fn is_ready(&self) -> bool {
        self.pending.lacks() == 0 && !self.pending.is_empty()
    }

    /// The payload of a frame that [`more`](Self::more) told of last, until the next byte.
    pub(crate) fn last_payload(&self, length: usize) -> &[u8] {
        self.pending.taken(HEADER, length)
    }

    /// The next event that can be told without another byte.
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

    /// The next event at the end of the stream, or `None` once all bytes are accounted for.
    ///
    /// A frame without its end is skipped as [`Cause::Truncated`], one start byte a time, so that the frames
    /// that hide behind a false start byte come out. The decoder can be used on: offsets and counters go on.
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

    /// Gives up the frame whose bytes have stopped coming and says what was skipped: its start byte.
    ///
    /// What came after that byte stays pending and is looked at again by the next call of
    /// [`next`](Self::next), which needs no new bytes for it. There may be frames in it, and also the next
    /// candidate that waits, whose bytes may yet come: whoever wants to end that one too calls again.
    ///
    /// `None`, and nothing changes, if no candidate waits for bytes: nothing is pending, or what is pending
    /// can be told of by `next` first.
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

    /// Bytes taken from the input that no event has told of, at most 260 after [`next`](Self::next) returned
    /// `None`. If it did and this is not 0, a candidate waits for its bytes.
    pub const fn pending(&self) -> usize {
        self.pending.len()
    }

    /// Where the next event will start, in bytes from the start of the stream.
    pub const fn position(&self) -> u64 {
        self.tally.bytes()
    }

    /// What became of all bytes since the start or the last [`reset`](Self::reset).
    ///
    /// It counts in machine words: where they have 32 bits, so do the counters and the positions of events, and
    /// begin again at 0 after 4 GiB.
    pub const fn counters(&self) -> Counters {
        self.tally.counters()
    }

    /// The versions that are accepted.
    pub const fn versions(&self) -> Versions {
        self.versions
    }

    /// Accepts `versions` from the next byte on that no event has told of.
    pub const fn set_versions(&mut self, versions: Versions) {
        self.versions = versions;
        self.pending.look_again();
    }

    /// Forgets the pending bytes and the counters and starts a new stream at position 0.
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
