//! Framing as the rules say it, slow and obvious, which the decoder is compared with.
//!
//! It shares nothing with the crate but the names of versions and causes: bytes are judged where they stand in the
//! whole stream, and the CRC goes bit by bit.

use sbgc_proto::frame::{Cause, Event, Skipped, Version, Versions};

/// An event that owns its bytes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Seen {
    Frame { at: u64, version: Version, id: u8, payload: Vec<u8> },
    Skipped(Skipped),
}

impl Seen {
    pub(crate) fn length(&self) -> u64 {
        match self {
            Self::Frame { version, payload, .. } => version.frame_len(payload.len()) as u64,
            Self::Skipped(skipped) => skipped.length as u64,
        }
    }
}

impl From<Event<'_>> for Seen {
    fn from(event: Event<'_>) -> Self {
        match event {
            Event::Frame { at, frame } => {
                Self::Frame { at, version: frame.version, id: frame.id, payload: frame.payload.to_vec() }
            }
            Event::Skipped(skipped) => Self::Skipped(skipped),
        }
    }
}

/// Keeps what was seen, joined with the piece before where only a cut parts them.
pub(crate) fn push(seen: &mut Vec<Seen>, next: impl Into<Seen>) {
    let next = next.into();
    if let (Some(Seen::Skipped(last)), Seen::Skipped(next)) = (seen.last_mut(), &next)
        && let Some(joined) = last.join(*next)
    {
        *last = joined;
        return;
    }
    seen.push(next);
}

/// All of a stream that ends here.
pub(crate) fn decode(stream: &[u8], versions: Versions) -> Vec<Seen> {
    let (mut seen, mut at) = (Vec::new(), 0);
    while at < stream.len() {
        let next = judge(stream, at, versions);
        at += usize::try_from(next.length()).unwrap();
        push(&mut seen, next);
    }
    seen
}

/// What starts at one byte of the stream.
fn judge(stream: &[u8], at: usize, versions: Versions) -> Seen {
    let byte = |offset: usize| stream.get(at + offset).copied();
    let skip = |cause| Seen::Skipped(Skipped { at: at as u64, length: 1, cause });
    let version = match byte(0) {
        Some(0x3E) if versions != Versions::Only(Version::V2) => Version::V1,
        Some(0x24) if versions != Versions::Only(Version::V1) => Version::V2,
        _ => return skip(Cause::NoStartByte),
    };
    if byte(1) == Some(0) {
        return skip(Cause::HeaderChecksum);
    }
    let (Some(id), Some(size), Some(sum)) = (byte(1), byte(2), byte(3)) else {
        return skip(Cause::Truncated);
    };
    if (u32::from(id) + u32::from(size)) % 256 != u32::from(sum) {
        return skip(Cause::HeaderChecksum);
    }
    let end = at + 4 + usize::from(size);
    let checks = if version == Version::V1 { 1 } else { 2 };
    if stream.len() < end + checks {
        return skip(Cause::Truncated);
    }
    let (payload, check) = (&stream[at + 4..end], &stream[end..end + checks]);
    let intact = match version {
        Version::V1 => payload.iter().map(|&byte| u32::from(byte)).sum::<u32>() % 256 == u32::from(check[0]),
        Version::V2 => crc(&stream[at + 1..end]) == u16::from(check[0]) + 256 * u16::from(check[1]),
    };
    if intact {
        Seen::Frame { at: at as u64, version, id, payload: payload.to_vec() }
    } else {
        skip(Cause::PayloadChecksum)
    }
}

/// The CRC as the specification's C code has it: one bit a time, the lowest first.
fn crc(bytes: &[u8]) -> u16 {
    let mut register = 0_u16;
    for &byte in bytes {
        for bit in 0..8 {
            let data = byte >> bit & 1 == 1;
            let top = register >> 15 == 1;
            register <<= 1;
            if data != top {
                register ^= 0x8005;
            }
        }
    }
    register
}
