//! What else may talk on a port: protocols that are recognised by how they look.

use std::fmt;

/// A protocol that is not that of these boards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Foreign {
    /// MAVLink, which a board's port speaks when it is set up for it.
    Mavlink,
    /// Position data of a GPS receiver.
    Nmea,
    /// Readable text, as a console sends it.
    Text,
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Foreign::Mavlink => "MAVLink",
            Foreign::Nmea => "NMEA position data",
            Foreign::Text => "text, as a console does",
        })
    }
}

/// How many bytes make sure that they are text.
const ENOUGH: usize = 16;

/// Recognises what talks on a port by the first bytes that came from it.
///
/// ```
/// use sbgc_host::connect::{Foreign, recognise};
///
/// assert_eq!(recognise(b"\r\nraspberrypi login: "), Some(Foreign::Text));
/// assert_eq!(recognise(&[0x3E, 86, 0, 86, 0]), None);
/// ```
pub fn recognise(bytes: &[u8]) -> Option<Foreign> {
    let printable =
        || bytes.iter().filter(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace()).count();
    if is_mavlink(bytes) {
        Some(Foreign::Mavlink)
    } else if bytes.windows(3).any(|bytes| matches!(bytes, b"$GP" | b"$GN" | b"$GL")) {
        Some(Foreign::Nmea)
    } else if bytes.len() >= ENOUGH && printable() * 20 >= bytes.len() * 19 {
        Some(Foreign::Text)
    } else {
        None
    }
}

/// Start bytes of both versions, and the number of bytes of a frame besides its payload.
const FORMS: [(u8, usize); 2] = [(0xFE, 8), (0xFD, 12)];

/// Whether a whole MAVLink frame is in the bytes, followed by the start of another.
fn is_mavlink(bytes: &[u8]) -> bool {
    (0..bytes.len()).any(|at| {
        let rest = bytes.get(at..).unwrap_or_default();
        FORMS.iter().any(|&(start, overhead)| match rest {
            [first, length, ..] if *first == start => {
                let end = usize::from(*length) + overhead;
                rest.get(end) == Some(&start) || (rest.len() == end && is_heartbeat(rest, start))
            }
            _ => false,
        })
    })
}

/// Whether a frame is the message with id 0, which everything that speaks MAVLink sends each second.
fn is_heartbeat(frame: &[u8], start: u8) -> bool {
    /// What the checksum begins with for that message, after its bytes.
    const EXTRA: u8 = 50;
    let id: &[u8] = if start == 0xFE { &[0] } else { &[0, 0, 0] };
    let at = if start == 0xFE { 5 } else { 7 };
    let (Some(body), Some(checksum)) = (frame.get(1..frame.len().saturating_sub(2)), frame.last_chunk::<2>())
    else {
        return false;
    };
    let crc = body.iter().chain(&[EXTRA]).fold(0xFFFF_u16, |crc, &byte| {
        let [low, _] = crc.to_le_bytes();
        let mixed = byte ^ low;
        let mixed = mixed ^ (mixed << 4);
        let wide = u16::from(mixed);
        (crc >> 8) ^ (wide << 8) ^ (wide << 3) ^ (wide >> 4)
    });
    frame.get(at..at + id.len()) == Some(id) && crc == u16::from_le_bytes(*checksum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A heartbeat of version 1 as a flight controller sends it.
    const HEARTBEAT: [u8; 17] = [0xFE, 9, 0x4E, 1, 1, 0, 0, 0, 0, 0, 2, 3, 0x51, 3, 3, 0x1D, 0x6B];

    #[test]
    fn frames_that_follow_each_other() {
        let frame = [&[0xFD, 3, 0, 0, 1, 1, 1, 30, 0, 0, 9, 9, 9, 1, 2][..]].concat();
        assert!(!is_mavlink(&frame));
        assert!(is_mavlink(&[&[7, 7][..], &frame, &frame].concat()));
        assert!(!is_mavlink(&[0xFE; 3]) && !is_mavlink(&[]));
    }

    #[test]
    fn a_single_heartbeat() {
        let mut frame = HEARTBEAT;
        let body = &frame[1..15];
        let crc = body.iter().chain(&[50]).fold(0xFFFF_u16, |crc, &byte| {
            (0..8).fold(
                crc ^ u16::from(byte),
                |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0x8408 } else { crc >> 1 },
            )
        });
        frame[15..].copy_from_slice(&crc.to_le_bytes());
        assert!(is_mavlink(&frame));
        frame[9] ^= 1;
        assert!(!is_mavlink(&frame));
    }

    #[test]
    fn other_protocols_are_recognised() {
        let nmea = b"$GPGGA,092750.000,5321.6802,N,00630.3372,W,1,8,1.03,61.7,M,55.2,M,,*76\r\n";
        assert_eq!(recognise(nmea), Some(Foreign::Nmea));
        assert_eq!(recognise(b"\r\nraspberrypi login: "), Some(Foreign::Text));
        assert_eq!(recognise(&HEARTBEAT.repeat(3)), Some(Foreign::Mavlink));
        assert_eq!(recognise(&[]), None);
        let garbage: Vec<u8> = (0..200_u8).map(|byte| byte.wrapping_mul(73) | 0x80).collect();
        assert_eq!(recognise(&garbage), None);
    }
}
