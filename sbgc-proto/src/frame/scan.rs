//! Stateless framing: examines the start of a slice.

use core::fmt;

use super::checksum::{crc16, header_sum, payload_sum};
use super::{Frame, HEADER, Version, Versions};

/// Reason why bytes were skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cause {
    /// The bytes are not start bytes of an accepted version.
    NoStartByte,
    /// A start byte followed by a header with a wrong checksum or id 0.
    HeaderChecksum,
    /// A start byte followed by a valid header, but with a wrong payload checksum or CRC.
    PayloadChecksum,
    /// A start byte whose frame was abandoned before it was complete.
    Truncated,
}

impl Cause {
    /// All causes.
    pub const ALL: [Self; 4] =
        [Self::NoStartByte, Self::HeaderChecksum, Self::PayloadChecksum, Self::Truncated];

    /// Name for machine-readable output, such as `no_start_byte`.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::NoStartByte => "no_start_byte",
            Self::HeaderChecksum => "header_checksum",
            Self::PayloadChecksum => "payload_checksum",
            Self::Truncated => "truncated",
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

/// Bytes that belong to no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Skipped {
    /// Offset of the first byte in the stream.
    pub at: u64,
    /// Number of bytes, at least 1.
    pub length: usize,
    /// Reason why they were skipped.
    pub cause: Cause,
}

impl Skipped {
    /// Joins this run with `next`, if `next` follows without a gap and has the same cause.
    ///
    /// The decoder reports skipped bytes immediately, so a run of noise that is split into chunks is reported in
    /// several pieces. Joining them hides the chunk boundaries.
    pub fn join(self, next: Self) -> Option<Self> {
        let adjacent = self.at.checked_add(self.length as u64) == Some(next.at) && self.cause == next.cause;
        adjacent.then(|| Self { length: self.length.saturating_add(next.length), ..self })
    }
}

/// Result of [`scan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scan<'a> {
    /// A complete frame.
    Frame {
        /// Frame.
        frame: Frame<'a>,
        /// Number of bytes used.
        used: usize,
    },
    /// Bytes that belong to no frame.
    Skip {
        /// Number of bytes to skip, at least 1.
        used: usize,
        /// Reason to skip them.
        cause: Cause,
    },
    /// A candidate for a frame, with too few bytes for a decision.
    NeedMore {
        /// Slice length required for the next decision; greater than the current one, and at most
        /// [`MAX_FRAME`](super::MAX_FRAME).
        at_least: usize,
    },
}

/// Examines the start of `buf`.
///
/// A candidate is rejected as early as possible: for id 0 after 2 bytes, for its header checksum after 4. Id 0 is not a
/// command, and all checks of a run of zeros are zero, so zero-filled payload bytes after a start byte would be
/// mistaken for a frame. Only the start byte of a rejected candidate is skipped, because an intact frame may start at
/// any byte after it. Bytes before the next start byte are skipped as one run.
///
/// ```
/// use sbgc_proto::frame::{Cause, Scan, Versions, scan};
///
/// // A stray start byte in front of a frame.
/// let bytes = [b'>', b'>', 82, 1, 83, 1, 1];
/// assert_eq!(scan(&bytes, Versions::Both), Scan::Skip { used: 1, cause: Cause::HeaderChecksum });
/// assert!(matches!(scan(&bytes[1..], Versions::Both), Scan::Frame { used: 6, .. }));
/// assert_eq!(scan(&bytes[1..5], Versions::Both), Scan::NeedMore { at_least: 6 });
/// ```
pub fn scan(buf: &[u8], versions: Versions) -> Scan<'_> {
    match measure(buf, versions) {
        Measure::Frame(header) => Scan::Frame { frame: header.frame(buf), used: header.frame_len() },
        Measure::Skip { used, cause } => Scan::Skip { used, cause },
        Measure::NeedMore { at_least } => Scan::NeedMore { at_least },
    }
}

/// [`Scan`] without a borrow, so that the decoder can change its buffer once it knows the answer.
pub(super) enum Measure {
    Frame(Header),
    Skip { used: usize, cause: Cause },
    NeedMore { at_least: usize },
}

/// The header of a frame that was found intact.
#[derive(Clone, Copy)]
pub(super) struct Header {
    version: Version,
    id: u8,
    size: u8,
}

impl Header {
    pub(super) const fn frame_len(self) -> usize {
        self.version.frame_len(self.size as usize)
    }

    /// The frame at the start of `bytes`, which are those that were measured.
    pub(super) fn frame(self, bytes: &[u8]) -> Frame<'_> {
        let end = HEADER + usize::from(self.size);
        Frame { version: self.version, id: self.id, payload: bytes.get(HEADER..end).unwrap_or_default() }
    }
}

/// Judges what stands at the start of `buf`.
#[inline]
pub(super) fn measure(buf: &[u8], versions: Versions) -> Measure {
    let refuse = |cause| Measure::Skip { used: 1, cause };
    let Some((&start, rest)) = buf.split_first() else {
        return Measure::NeedMore { at_least: 1 };
    };
    let Some(version) = versions.of_start_byte(start) else {
        return Measure::Skip { used: noise(buf, versions), cause: Cause::NoStartByte };
    };
    let (id, size, sum, body) = match *rest {
        [] => return Measure::NeedMore { at_least: 2 },
        [0, ..] => return refuse(Cause::HeaderChecksum),
        [_] | [_, _] => return Measure::NeedMore { at_least: HEADER },
        [id, size, sum, ref body @ ..] => (id, size, sum, body),
    };
    if sum != header_sum(id, size) {
        return refuse(Cause::HeaderChecksum);
    }
    let header = Header { version, id, size };
    let intact = match (version, body.split_at_checked(usize::from(size))) {
        (Version::V1, Some((payload, &[sum, ..]))) => sum == payload_sum(payload),
        (Version::V2, Some((_, &[low, high, ..]))) => {
            // The CRC starts at the id, right after the start byte.
            let covered = rest.get(..HEADER - 1 + usize::from(size)).unwrap_or_default();
            u16::from_le_bytes([low, high]) == crc16(covered)
        }
        _ => return Measure::NeedMore { at_least: header.frame_len() },
    };
    if intact { Measure::Frame(header) } else { refuse(Cause::PayloadChecksum) }
}

/// How many bytes stand before the next start byte.
fn noise(buf: &[u8], versions: Versions) -> usize {
    buf.iter().position(|&byte| versions.of_start_byte(byte).is_some()).unwrap_or(buf.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    const V1: [u8; 6] = [b'>', 82, 1, 83, 1, 1];
    const V2: [u8; 7] = [b'$', 82, 1, 83, 1, 0x12, 0x3D];

    #[test]
    fn decides_as_early_as_it_can() {
        let needs = [1, 2, 4, 4, 7, 7, 7];
        for (end, at_least) in needs.into_iter().enumerate() {
            assert_eq!(scan(&V2[..end], Versions::Both), Scan::NeedMore { at_least });
        }
        let bad = Scan::Skip { used: 1, cause: Cause::HeaderChecksum };
        assert_eq!(scan(b">\0", Versions::Both), bad);
        assert_eq!(scan(&[b'$', 82, 255, 83], Versions::Both), bad);
    }

    #[test]
    fn refuses_zeros() {
        for zeros in 1..20 {
            for start in [b'>', b'$'] {
                let mut bytes = vec![0; zeros + 1];
                bytes[0] = start;
                let found = scan(&bytes, Versions::Both);
                assert_eq!(found, Scan::Skip { used: 1, cause: Cause::HeaderChecksum });
            }
        }
    }

    #[test]
    fn skips_noise_up_to_a_start_byte_it_accepts() {
        let skip = |used| Scan::Skip { used, cause: Cause::NoStartByte };
        assert_eq!(scan(b"abc", Versions::Both), skip(3));
        assert_eq!(scan(b"ab>$", Versions::Both), skip(2));
        assert_eq!(scan(b"ab>$", Versions::Only(Version::V2)), skip(3));
        assert_eq!(scan(&V1, Versions::Only(Version::V2)), skip(6));
        assert_eq!(scan(&V2, Versions::Only(Version::V1)), skip(7));
    }

    #[test]
    fn any_flipped_bit_is_refused() {
        for frame in [&V1[..], &V2[..]] {
            for bit in 0..frame.len() * 8 {
                let mut bytes = frame.to_vec();
                bytes[bit / 8] ^= 1 << (bit % 8);
                // The flip may change the start byte or the size, but must never leave a frame.
                assert!(!matches!(scan(&bytes, Versions::Both), Scan::Frame { .. }), "bit {bit}");
            }
        }
    }

    #[test]
    fn names_of_causes() {
        let names = Cause::ALL.map(Cause::as_str);
        assert_eq!(names, ["no_start_byte", "header_checksum", "payload_checksum", "truncated"]);
        assert_eq!(format!("{:>10}", Cause::Truncated), " truncated");
    }
}
