//! Recognises MAVLink, which is what a board's port speaks when it is set up for it.

/// Start bytes of both versions, and how many bytes a frame has besides its payload.
const FORMS: [(u8, usize); 2] = [(0xFE, 8), (0xFD, 12)];

/// Whether a whole MAVLink frame is in the bytes, followed by the start of another.
pub(super) fn is_in(bytes: &[u8]) -> bool {
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
        assert!(!is_in(&frame));
        assert!(is_in(&[&[7, 7][..], &frame, &frame].concat()));
        assert!(!is_in(&[0xFE; 3]) && !is_in(&[]));
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
        assert!(is_in(&frame));
        frame[9] ^= 1;
        assert!(!is_in(&frame));
    }
}
