//! Frames on tokio's buffers.
//!
//! [`Codec`] puts [`sbgc_proto::frame::scan`] behind the traits of `tokio_util`, so that framing is written once
//! only. It knows no time: whoever reads ends a frame whose bytes stop coming with [`Codec::end_candidate`].

use std::io;

use bytes::{Buf, Bytes, BytesMut};
use sbgc_proto::frame::{self, Cause, Counters, Scan, Version, Versions};
use tokio_util::codec::{Decoder, Encoder};

/// One frame that owns its payload.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The version it came in or goes out in.
    pub version: Version,
    /// Command id, 1..=255.
    pub id: u8,
    /// The payload, at most 255 bytes.
    pub payload: Bytes,
}

/// What a stream of bytes consists of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Item {
    /// A frame.
    Frame(Frame),
    /// Bytes that belong to no frame.
    Noise {
        /// Why they are none.
        cause: Cause,
        /// How many.
        length: usize,
    },
}

/// Turns bytes into frames and back.
///
/// Noise is an item like any other. Only the stream itself can fail, and decoding never does.
///
/// ```
/// use bytes::BytesMut;
/// use sbgc_host::link::codec::{Codec, Item};
/// use tokio_util::codec::Decoder;
///
/// let mut codec = Codec::default();
/// let mut buffer = BytesMut::from(&b"\xFF\x3E\x56\x00\x56\x00"[..]);
/// assert!(matches!(codec.decode(&mut buffer)?, Some(Item::Noise { length: 1, .. })));
/// assert!(matches!(codec.decode(&mut buffer)?, Some(Item::Frame(frame)) if frame.id == 86));
/// assert!(codec.decode(&mut buffer)?.is_none());
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Codec {
    versions: Versions,
    counters: Counters,
}

impl Codec {
    /// A codec that takes frames of `versions`.
    pub fn new(versions: Versions) -> Self {
        Self { versions, counters: Counters::default() }
    }

    /// What became of all bytes so far.
    pub const fn counters(&self) -> Counters {
        self.counters
    }

    /// Gives up the frame at the front of `source` whose bytes have stopped coming: skips its start byte.
    ///
    /// What follows is decoded as usual by the next call of [`decode`](Decoder::decode). `None` if no candidate
    /// waits there.
    pub fn end_candidate(&mut self, source: &mut BytesMut) -> Option<Item> {
        let waits = !source.is_empty() && matches!(frame::scan(source, self.versions), Scan::NeedMore { .. });
        waits.then(|| self.skip(source, 1, Cause::Truncated))
    }

    /// The next item, if one is complete.
    pub fn take(&mut self, source: &mut BytesMut) -> Option<Item> {
        let (used, version, id) = match frame::scan(source, self.versions) {
            Scan::Frame { frame, used } => (used, frame.version, frame.id),
            Scan::Skip { used, cause } => return Some(self.skip(source, used, cause)),
            Scan::NeedMore { at_least } => {
                source.reserve(at_least.saturating_sub(source.len()));
                return None;
            }
        };
        self.counters.frames += 1;
        self.counters.frame_bytes += used as u64;
        let mut payload = source.split_to(used);
        // Start byte, id, size and header checksum stand before the payload, the rest of the overhead after it.
        let length = used.saturating_sub(version.overhead());
        payload.advance(HEADER.min(used));
        payload.truncate(length);
        Some(Item::Frame(Frame { version, id, payload: payload.freeze() }))
    }

    fn skip(&mut self, source: &mut BytesMut, length: usize, cause: Cause) -> Item {
        source.advance(length.min(source.len()));
        let counter = match cause {
            Cause::NoStartByte => &mut self.counters.no_start_byte,
            Cause::HeaderChecksum => &mut self.counters.header_checksum,
            Cause::PayloadChecksum => &mut self.counters.payload_checksum,
            Cause::Truncated => &mut self.counters.truncated,
        };
        *counter += length as u64;
        Item::Noise { cause, length }
    }
}

/// Bytes before the payload.
const HEADER: usize = 4;

impl Decoder for Codec {
    type Item = Item;
    type Error = io::Error;

    fn decode(&mut self, source: &mut BytesMut) -> io::Result<Option<Item>> {
        Ok(self.take(source))
    }

    fn decode_eof(&mut self, source: &mut BytesMut) -> io::Result<Option<Item>> {
        Ok(self.take(source).or_else(|| self.end_candidate(source)))
    }
}

impl Encoder<Frame> for Codec {
    type Error = io::Error;

    fn encode(&mut self, frame: Frame, out: &mut BytesMut) -> io::Result<()> {
        append(frame.version, frame.id, &frame.payload, out)
            .map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error))
    }
}

/// Appends one frame to `out`, which is left as it was on an error.
pub(crate) fn append(
    version: Version,
    id: u8,
    payload: &[u8],
    out: &mut BytesMut,
) -> Result<(), frame::EncodeFrameError> {
    let mut buffer = [0; frame::MAX_FRAME];
    out.extend_from_slice(frame::encode_into(version, id, payload, &mut buffer)?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(codec: &mut Codec, source: &mut BytesMut) -> Vec<Item> {
        std::iter::from_fn(|| codec.take(source)).collect()
    }

    fn frame(version: Version, id: u8, payload: &'static [u8]) -> Frame {
        Frame { version, id, payload: Bytes::from_static(payload) }
    }

    #[test]
    fn what_is_encoded_is_decoded_however_it_is_cut() {
        let frames = [
            frame(Version::V1, 86, b""),
            frame(Version::V2, 82, b"\x01"),
            frame(Version::V2, 255, &[0x24; 255]),
        ];
        let mut bytes = BytesMut::new();
        for frame in &frames {
            Codec::default().encode(frame.clone(), &mut bytes).unwrap();
        }
        for chunk in 1..bytes.len() {
            let (mut codec, mut source, mut items) = (Codec::default(), BytesMut::new(), Vec::new());
            for part in bytes.chunks(chunk) {
                source.extend_from_slice(part);
                items.extend(all(&mut codec, &mut source));
            }
            assert_eq!(items, frames.clone().map(Item::Frame), "chunks of {chunk}");
            assert_eq!(codec.counters().bytes(), bytes.len() as u64);
        }
    }

    #[test]
    fn noise_is_an_item_and_is_counted() {
        let mut source = BytesMut::from(&b"abc\x3E\x52\x01\x54\x3E\x56\x00\x56\x00"[..]);
        let mut codec = Codec::default();
        let items = all(&mut codec, &mut source);
        assert_eq!(items.len(), 4);
        assert_eq!(items[0], Item::Noise { cause: Cause::NoStartByte, length: 3 });
        assert_eq!(items[1], Item::Noise { cause: Cause::HeaderChecksum, length: 1 });
        assert_eq!(items[3], Item::Frame(frame(Version::V1, 86, b"")));
        assert_eq!((codec.counters().skipped(), codec.counters().frames), (7, 1));
    }

    #[test]
    fn a_frame_behind_a_false_start_comes_out_once_the_candidate_is_ended() {
        let mut source = BytesMut::from(&b"\x24\x20\xC8\xE8\x3E\x56\x00\x56\x00"[..]);
        let mut codec = Codec::default();
        assert_eq!(codec.take(&mut source), None);
        let ended = codec.end_candidate(&mut source);
        assert_eq!(ended, Some(Item::Noise { cause: Cause::Truncated, length: 1 }));
        let items = all(&mut codec, &mut source);
        assert_eq!(items[1], Item::Frame(frame(Version::V1, 86, b"")));
        assert_eq!(codec.end_candidate(&mut source), None);
    }

    #[test]
    fn the_end_of_the_stream_ends_all_candidates() {
        let mut source = BytesMut::from(&b"\x24\x20\xC8\xE8\x3E\x56\x00\x56\x00\x3E\x56"[..]);
        let mut codec = Codec::default();
        let mut frames = 0;
        while let Some(item) = codec.decode_eof(&mut source).unwrap() {
            frames += usize::from(matches!(item, Item::Frame(_)));
        }
        assert_eq!((frames, source.len(), codec.counters().bytes()), (1, 0, 11));
    }

    #[test]
    fn an_encoding_error_leaves_the_output_alone() {
        let mut out = BytesMut::from(&b"x"[..]);
        assert!(Codec::default().encode(frame(Version::V1, 0, b""), &mut out).is_err());
        assert_eq!(&out[..], b"x");
    }
}
