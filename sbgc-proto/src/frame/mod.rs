//! Framing of both protocol versions: bytes to frames and back.
//!
//! ```text
//!            0       1    2      3            4            4+N
//!  V1  0x3E '>'   | id | N | id + N | payload, N bytes | sum of the payload
//!  V2  0x24 '$'   | id | N | id + N | payload, N bytes | CRC16, low byte first
//!                 '---------- covered by the CRC ----------'
//!
//!  bytes ──► Decoder ──► Event::Frame, Event::Skipped         chunks of any size
//!               └─ scan ── one candidate, judged               pure, one slice
//!                    └─ checksum
//!  id, payload ──► encode_into, encode_with, append ──► bytes
//! ```
//!
//! This module defines the layout of a frame, its checks and the resynchronization after noise. It knows neither
//! messages nor time nor ports.
//!
//! # Decoding
//!
//! ```
//! use sbgc_proto::frame::{Cause, Decoder, Event, Frame, Skipped, Version, Versions};
//!
//! let mut decoder = Decoder::new(Versions::Both);
//! let mut seen = 0;
//! // Noise, then "read profile 2" in version 2, cut in the middle by the reader's buffer.
//! for mut chunk in [&b"\xFF\x24\x52\x01"[..], b"\x53\x01\x12\x3D"] {
//!     while let Some(event) = decoder.next(&mut chunk) {
//!         match event {
//!             Event::Skipped(skipped) => {
//!                 assert_eq!(skipped, Skipped { at: 0, length: 1, cause: Cause::NoStartByte });
//!             }
//!             Event::Frame { at, frame } => {
//!                 assert_eq!((at, frame), (1, Frame { version: Version::V2, id: 82, payload: &[1] }));
//!                 seen += 1;
//!             }
//!         }
//!     }
//! }
//! assert_eq!(seen, 1);
//! ```
//!
//! # Encoding
//!
//! ```
//! use sbgc_proto::frame::{self, Version};
//!
//! let mut out = [0; frame::MAX_FRAME];
//! let bytes = frame::encode_into(Version::V1, 82, &[1], &mut out)?;
//! assert_eq!(bytes, [0x3E, 82, 1, 83, 1, 1]);
//! # Ok::<(), frame::EncodeFrameError>(())
//! ```

pub mod checksum;
mod counters;
mod decoder;
mod encode;
mod pending;
mod scan;

pub use counters::Counters;
pub use decoder::{Decoder, Event};
pub use encode::{EncodeFrameError, append, encode_into, encode_with};
pub use scan::{Cause, Scan, Skipped, scan};

/// Maximum payload length in bytes.
pub const MAX_PAYLOAD: usize = 255;

/// Maximum frame length in bytes: version 2 with a payload of [`MAX_PAYLOAD`] bytes.
pub const MAX_FRAME: usize = Version::V2.frame_len(MAX_PAYLOAD);

/// Size of the input buffer of a board in bytes.
///
/// The board loses a frame that does not fit into the free part of the buffer, so no frame to a board should be longer
/// than this. See [`Version::safe_payload`].
pub const BOARD_BUFFER: usize = 255;

/// Start byte, id, size and header checksum.
const HEADER: usize = 4;

/// Protocol version of a frame.
///
/// A board accepts both versions until it receives the first valid frame of version 2; from then on, it accepts only
/// version 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Version {
    /// Version 1: the payload is checked by the sum of its bytes. Supported by all firmware.
    V1,
    /// Version 2: header and payload are checked by a CRC16. Firmware 2.68b0+.
    V2,
}

impl Version {
    /// Version number: 1 or 2.
    pub const fn number(self) -> u8 {
        match self {
            Self::V1 => 1,
            Self::V2 => 2,
        }
    }

    /// Start byte of frames of this version.
    pub const fn start_byte(self) -> u8 {
        match self {
            Self::V1 => b'>',
            Self::V2 => b'$',
        }
    }

    /// Returns the version whose frames start with `byte`, if there is one.
    pub const fn from_start_byte(byte: u8) -> Option<Self> {
        match byte {
            b'>' => Some(Self::V1),
            b'$' => Some(Self::V2),
            _ => None,
        }
    }

    /// Number of bytes in a frame besides the payload: 5 or 6.
    pub const fn overhead(self) -> usize {
        match self {
            Self::V1 => HEADER + 1,
            Self::V2 => HEADER + 2,
        }
    }

    /// Length in bytes of a frame with a payload of `payload` bytes.
    pub const fn frame_len(self, payload: usize) -> usize {
        self.overhead() + payload
    }

    /// Maximum payload length in bytes whose frame fits into the [input buffer of a board](BOARD_BUFFER): 250 in
    /// version 1, 249 in version 2.
    ///
    /// Encoders do not enforce it, because frames from a board, or between programs, may be longer.
    pub const fn safe_payload(self) -> usize {
        BOARD_BUFFER - self.overhead()
    }
}

/// Versions that a decoder accepts. The start byte of any other version counts as noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Versions {
    /// Both versions.
    #[default]
    Both,
    /// Only this version.
    Only(Version),
}

impl Versions {
    /// Whether frames of `version` are accepted.
    pub const fn accepts(self, version: Version) -> bool {
        match (self, version) {
            (Self::Both, _)
            | (Self::Only(Version::V1), Version::V1)
            | (Self::Only(Version::V2), Version::V2) => true,
            (Self::Only(_), _) => false,
        }
    }

    /// Returns the accepted version whose frames start with `byte`, if there is one.
    const fn of_start_byte(self, byte: u8) -> Option<Version> {
        match Version::from_start_byte(byte) {
            Some(version) if self.accepts(version) => Some(version),
            _ => None,
        }
    }
}

/// Valid frame, with the version and the payload bytes that it had on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Frame<'a> {
    /// Protocol version.
    pub version: Version,
    /// Command id, 1 to 255.
    pub id: u8,
    /// Payload, 0 to 255 bytes.
    pub payload: &'a [u8],
}

impl Frame<'_> {
    /// Length in bytes of the whole frame on the wire.
    pub const fn encoded_len(&self) -> usize {
        self.version.frame_len(self.payload.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths() {
        assert_eq!(MAX_FRAME, 261);
        assert_eq!((Version::V1.overhead(), Version::V2.overhead()), (5, 6));
        assert_eq!((Version::V1.safe_payload(), Version::V2.safe_payload()), (250, 249));
        assert_eq!(Frame { version: Version::V2, id: 1, payload: &[0; 3] }.encoded_len(), 9);
    }

    #[test]
    fn start_bytes() {
        for version in [Version::V1, Version::V2] {
            assert_eq!(Version::from_start_byte(version.start_byte()), Some(version));
            assert_eq!(Versions::Only(version).of_start_byte(version.start_byte()), Some(version));
        }
        assert_eq!((0..=255).filter(|&byte| Version::from_start_byte(byte).is_some()).count(), 2);
        assert_eq!(Versions::Only(Version::V2).of_start_byte(b'>'), None);
        assert_eq!(Versions::Only(Version::V1).of_start_byte(b'$'), None);
    }
}
