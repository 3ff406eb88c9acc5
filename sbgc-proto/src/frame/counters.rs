//! Counters of frames and skipped bytes.

use super::{Cause, Skipped};

/// Counters of a decoder: frames, and skipped bytes by cause.
///
/// [`bytes`](Self::bytes) plus [`Decoder::pending`](super::Decoder::pending) is the number of bytes given to the
/// decoder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Counters {
    /// Number of frames.
    pub frames: u64,
    /// Bytes in those frames.
    pub frame_bytes: u64,
    /// Bytes skipped for [`Cause::NoStartByte`].
    pub no_start_byte: u64,
    /// Bytes skipped for [`Cause::HeaderChecksum`], one for each rejected header.
    pub header_checksum: u64,
    /// Bytes skipped for [`Cause::PayloadChecksum`], one for each rejected payload.
    pub payload_checksum: u64,
    /// Bytes skipped for [`Cause::Truncated`], one for each abandoned frame.
    pub truncated: u64,
}

impl Counters {
    /// Bytes skipped for `cause`.
    pub const fn skipped_for(&self, cause: Cause) -> u64 {
        match cause {
            Cause::NoStartByte => self.no_start_byte,
            Cause::HeaderChecksum => self.header_checksum,
            Cause::PayloadChecksum => self.payload_checksum,
            Cause::Truncated => self.truncated,
        }
    }

    /// Bytes skipped for any cause.
    pub const fn skipped(&self) -> u64 {
        self.no_start_byte + self.header_checksum + self.payload_checksum + self.truncated
    }

    /// Bytes in frames plus bytes skipped.
    pub const fn bytes(&self) -> u64 {
        self.frame_bytes + self.skipped()
    }
}

/// [`Counters`] as a decoder keeps them: in machine words, and the sum of all bytes instead of those in frames.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    bytes: usize,
    frames: usize,
    skipped: [usize; Cause::ALL.len()],
}

impl Tally {
    pub(super) const fn new() -> Self {
        Self { bytes: 0, frames: 0, skipped: [0; Cause::ALL.len()] }
    }

    /// All bytes so far.
    pub(super) const fn bytes(&self) -> u64 {
        self.bytes as u64
    }

    /// Counts a frame of `length` bytes and says where it started.
    #[inline]
    pub(super) const fn frame(&mut self, length: usize) -> u64 {
        let at = self.bytes();
        self.bytes = self.bytes.wrapping_add(length);
        self.frames = self.frames.wrapping_add(1);
        at
    }

    #[inline]
    pub(super) fn skip(&mut self, length: usize, cause: Cause) -> Skipped {
        let at = self.bytes();
        self.bytes = self.bytes.wrapping_add(length);
        if let Some(skipped) = self.skipped.get_mut(cause as usize) {
            *skipped = skipped.wrapping_add(length);
        }
        Skipped { at, length, cause }
    }

    pub(super) const fn counters(&self) -> Counters {
        // In the order of `Cause`.
        let [no_start_byte, header_checksum, payload_checksum, truncated] = self.skipped;
        let frame_bytes = self
            .bytes
            .wrapping_sub(no_start_byte)
            .wrapping_sub(header_checksum)
            .wrapping_sub(payload_checksum)
            .wrapping_sub(truncated);
        Counters {
            frames: self.frames as u64,
            frame_bytes: frame_bytes as u64,
            no_start_byte: no_start_byte as u64,
            header_checksum: header_checksum as u64,
            payload_checksum: payload_checksum as u64,
            truncated: truncated as u64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_cause_has_its_counter() {
        let mut tally = Tally::new();
        assert_eq!(tally.frame(10), 0);
        for (index, cause) in Cause::ALL.into_iter().enumerate() {
            let at = tally.bytes();
            assert_eq!(tally.skip(index + 1, cause), Skipped { at, length: index + 1, cause });
        }
        let counters = tally.counters();
        assert_eq!(Cause::ALL.map(|cause| counters.skipped_for(cause)), [1, 2, 3, 4]);
        assert_eq!((counters.frames, counters.frame_bytes, counters.bytes()), (1, 10, 20));
    }
}
