//! Encoding of frames.

use core::fmt;

use super::checksum::{crc16, header_sum, payload_sum};
use super::{HEADER, MAX_PAYLOAD, Version};

/// Reason why a frame cannot be encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum EncodeFrameError {
    /// Invalid command id 0; a receiver would reject the frame.
    ZeroId,
    /// The payload is longer than [`MAX_PAYLOAD`].
    PayloadTooLong {
        /// Length of the payload in bytes.
        length: usize,
    },
    /// The frame does not fit into the free part of the output.
    BufferTooSmall {
        /// Length of the frame in bytes.
        needed: usize,
        /// Number of free bytes.
        got: usize,
    },
}

impl fmt::Display for EncodeFrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ZeroId => f.write_str("invalid command id 0; ids range from 1 to 255"),
            Self::PayloadTooLong { length } => {
                write!(f, "a payload of {length} bytes does not fit a frame, which takes {MAX_PAYLOAD}")
            }
            Self::BufferTooSmall { needed, got } => {
                write!(f, "a frame of {needed} bytes does not fit the {got} bytes left for it")
            }
        }
    }
}

impl core::error::Error for EncodeFrameError {}

/// Encodes one frame at the start of `out` and returns it.
///
/// # Errors
/// If the id is 0, the payload is longer than [`MAX_PAYLOAD`] or `out` is too small.
///
/// ```
/// use sbgc_proto::frame::{EncodeFrameError, MAX_FRAME, Version, encode_into};
///
/// let mut out = [0; MAX_FRAME];
/// assert_eq!(encode_into(Version::V2, 82, &[1], &mut out)?, [0x24, 82, 1, 83, 1, 0x12, 0x3D]);
/// assert_eq!(
///     encode_into(Version::V2, 82, &[1], &mut out[..6]),
///     Err(EncodeFrameError::BufferTooSmall { needed: 7, got: 6 })
/// );
/// # Ok::<(), EncodeFrameError>(())
/// ```
pub fn encode_into<'o>(
    version: Version,
    id: u8,
    payload: &[u8],
    out: &'o mut [u8],
) -> Result<&'o [u8], EncodeFrameError> {
    let (size, got) = (payload.len(), out.len());
    check_id(id)?;
    check_payload(size)?;
    if got < version.frame_len(size) {
        return Err(too_small(version, size, got));
    }
    if let Some(place) = out.get_mut(HEADER..HEADER + size) {
        place.copy_from_slice(payload);
    }
    close(version, id, size, out)
}

/// Encodes one frame whose payload `write` writes in place, so that it is never copied.
///
/// `write` receives the part of `out` that is available for the payload, at most [`MAX_PAYLOAD`] bytes with unspecified
/// content, and returns the length of the payload.
///
/// # Errors
/// If `write` fails, the id is 0, `out` is too small for an empty frame, or `write` returns a length greater than that
/// of its buffer. The content of `out` is unspecified in that case.
///
/// ```
/// use sbgc_proto::frame::{EncodeFrameError, MAX_FRAME, Version, encode_with};
///
/// let mut out = [0; MAX_FRAME];
/// let frame = encode_with(Version::V1, 82, &mut out, |payload| {
///     payload[0] = 1;
///     Ok::<_, EncodeFrameError>(1)
/// })?;
/// assert_eq!(frame, [0x3E, 82, 1, 83, 1, 1]);
/// # Ok::<(), EncodeFrameError>(())
/// ```
pub fn encode_with<E: From<EncodeFrameError>>(
    version: Version,
    id: u8,
    out: &mut [u8],
    write: impl FnOnce(&mut [u8]) -> Result<usize, E>,
) -> Result<&[u8], E> {
    check_id(id)?;
    let got = out.len();
    let room = got.checked_sub(version.overhead()).ok_or(too_small(version, 0, got))?;
    let area = out.get_mut(HEADER..HEADER + room.min(MAX_PAYLOAD)).ok_or(too_small(version, 0, got))?;
    let size = write(area)?;
    Ok(close(version, id, size, out)?)
}

/// Appends one frame to `out`, which is unchanged on errors.
///
/// # Errors
/// If the id is 0, the payload is longer than [`MAX_PAYLOAD`], or `out` has not enough space.
///
/// ```
/// use sbgc_proto::frame::{Version, append};
///
/// let mut batch = heapless::Vec::<u8, 64>::new();
/// append(Version::V1, 86, &[], &mut batch)?;
/// append(Version::V1, 25, &[], &mut batch)?;
/// assert_eq!(batch, [0x3E, 86, 0, 86, 0, 0x3E, 25, 0, 25, 0]);
/// # Ok::<(), sbgc_proto::frame::EncodeFrameError>(())
/// ```
pub fn append<const N: usize>(
    version: Version,
    id: u8,
    payload: &[u8],
    out: &mut heapless::Vec<u8, N>,
) -> Result<(), EncodeFrameError> {
    check_payload(payload.len())?;
    let before = out.len();
    let too_small = too_small(version, payload.len(), N - before);
    out.resize(before + version.frame_len(payload.len()), 0).map_err(|_| too_small)?;
    let written = match out.get_mut(before..) {
        Some(place) => encode_into(version, id, payload, place).map(drop),
        None => Err(too_small),
    };
    if written.is_err() {
        out.truncate(before);
    }
    written
}

/// Puts header and check around the `size` bytes of payload that stand in `out`.
fn close(version: Version, id: u8, size: usize, out: &mut [u8]) -> Result<&[u8], EncodeFrameError> {
    let size_byte = check_payload(size)?;
    let too_small = too_small(version, size, out.len());
    let frame = out.get_mut(..version.frame_len(size)).ok_or(too_small)?;
    let (covered, check) = frame.split_at_mut_checked(HEADER + size).ok_or(too_small)?;
    if let Some(header) = covered.first_chunk_mut::<HEADER>() {
        *header = [version.start_byte(), id, size_byte, header_sum(id, size_byte)];
    }
    match check {
        [sum] => *sum = payload_sum(covered.get(HEADER..).unwrap_or_default()),
        // The CRC leaves out the start byte.
        _ => check.copy_from_slice(&crc16(covered.get(1..).unwrap_or_default()).to_le_bytes()),
    }
    Ok(frame)
}

const fn check_id(id: u8) -> Result<(), EncodeFrameError> {
    if id == 0 { Err(EncodeFrameError::ZeroId) } else { Ok(()) }
}

fn check_payload(length: usize) -> Result<u8, EncodeFrameError> {
    u8::try_from(length).map_err(|_| EncodeFrameError::PayloadTooLong { length })
}

const fn too_small(version: Version, payload: usize, got: usize) -> EncodeFrameError {
    EncodeFrameError::BufferTooSmall { needed: version.frame_len(payload), got }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::MAX_FRAME;

    const VERSIONS: [Version; 2] = [Version::V1, Version::V2];

    #[test]
    fn the_output_must_hold_the_whole_frame() {
        for version in VERSIONS {
            for size in [0, 1, 249, 250, 255] {
                let payload = vec![7; size];
                let needed = version.frame_len(size);
                for got in 0..=MAX_FRAME + 3 {
                    let mut out = vec![0xAA; got];
                    let result = encode_into(version, 9, &payload, &mut out).map(<[u8]>::len);
                    if got < needed {
                        assert_eq!(result, Err(EncodeFrameError::BufferTooSmall { needed, got }));
                    } else {
                        assert_eq!(result, Ok(needed));
                        assert!(out[needed..].iter().all(|&byte| byte == 0xAA), "wrote past the frame");
                    }
                }
            }
        }
    }

    #[test]
    fn refuses_what_no_receiver_takes() {
        let mut out = [0; 600];
        for version in VERSIONS {
            assert_eq!(encode_into(version, 0, &[], &mut out), Err(EncodeFrameError::ZeroId));
            let long = encode_into(version, 1, &[0; 256], &mut out);
            assert_eq!(long, Err(EncodeFrameError::PayloadTooLong { length: 256 }));
        }
    }

    #[test]
    fn a_writer_is_given_all_the_room_and_cannot_claim_more() {
        for version in VERSIONS {
            for got in version.overhead()..300 {
                let room = (got - version.overhead()).min(MAX_PAYLOAD);
                let mut out = vec![0; got];
                let result = encode_with(version, 1, &mut out, |area| {
                    assert_eq!(area.len(), room);
                    Ok::<_, EncodeFrameError>(room + 1)
                });
                let expected = if room == MAX_PAYLOAD {
                    EncodeFrameError::PayloadTooLong { length: 256 }
                } else {
                    EncodeFrameError::BufferTooSmall { needed: got + 1, got }
                };
                assert_eq!(result, Err(expected));
            }
        }
    }

    #[test]
    fn a_writer_may_fail_with_its_own_error() {
        #[derive(Debug, PartialEq)]
        struct Mine(Option<EncodeFrameError>);
        impl From<EncodeFrameError> for Mine {
            fn from(error: EncodeFrameError) -> Self {
                Self(Some(error))
            }
        }
        let mut out = [0; 8];
        let failed = encode_with(Version::V1, 1, &mut out, |_| Err(Mine(None)));
        assert_eq!(failed, Err(Mine(None)));
        let failed = encode_with(Version::V1, 0, &mut out, |_| Err(Mine(None)));
        assert_eq!(failed, Err(Mine(Some(EncodeFrameError::ZeroId))));
    }

    #[test]
    fn a_failed_append_leaves_the_output_alone() {
        let mut out = heapless::Vec::<u8, 8>::from_slice(&[1, 2, 3]).unwrap();
        let full = append(Version::V1, 1, &[9], &mut out);
        assert_eq!(full, Err(EncodeFrameError::BufferTooSmall { needed: 6, got: 5 }));
        assert_eq!(append(Version::V1, 0, &[], &mut out), Err(EncodeFrameError::ZeroId));
        let long = append(Version::V1, 1, &[0; 256], &mut out);
        assert_eq!(long, Err(EncodeFrameError::PayloadTooLong { length: 256 }));
        assert_eq!(out, [1, 2, 3]);
        append(Version::V1, 1, &[], &mut out).unwrap();
        assert_eq!(out, [1, 2, 3, b'>', 1, 0, 1, 0]);
    }

    #[test]
    fn errors_name_the_limits() {
        let texts = [
            EncodeFrameError::ZeroId,
            EncodeFrameError::PayloadTooLong { length: 256 },
            EncodeFrameError::BufferTooSmall { needed: 7, got: 6 },
        ]
        .map(|error| error.to_string());
        assert_eq!(texts[0], "invalid command id 0; ids range from 1 to 255");
        assert_eq!(texts[1], "a payload of 256 bytes does not fit a frame, which takes 255");
        assert_eq!(texts[2], "a frame of 7 bytes does not fit the 6 bytes left for it");
    }
}
