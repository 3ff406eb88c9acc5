//! What a link has seen and done, in numbers.

use std::fmt;

use sbgc_proto::frame;

/// What became of everything that passed a link since it was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct LinkCounters {
    /// Frames and noise that came in.
    pub received: frame::Counters,
    /// Frames that were written.
    pub sent_frames: u64,
    /// Bytes that were written.
    pub sent_bytes: u64,
    /// Requests that ended without an answer.
    pub timeouts: u64,
    /// Reads that were sent again because their answer did not come.
    pub repeats: u64,
    /// Answers that nobody waited for any more.
    pub late: u64,
    /// Frames that neither answered a request nor went to a subscriber.
    pub unsolicited: u64,
    /// Set-points that a newer one replaced before they were sent.
    pub superseded: u64,
    /// Samples that slow subscribers lost.
    pub lost_samples: u64,
}

/// One line; what did not happen is left out.
impl fmt::Display for LinkCounters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let frame::Counters { no_start_byte, header_checksum, payload_checksum, truncated, .. } =
            self.received;
        write!(f, "{} frames sent ({} bytes), ", self.sent_frames, self.sent_bytes)?;
        write!(f, "{} received ({} bytes)", self.received.frames, self.received.frame_bytes)?;
        for (count, what) in [
            (no_start_byte, "bytes skipped between frames"),
            (header_checksum, "headers with a wrong checksum"),
            (payload_checksum, "payloads with a wrong checksum"),
            (truncated, "frames cut short"),
            (self.timeouts, "requests without an answer"),
            (self.repeats, "reads sent again"),
            (self.late, "late answers"),
            (self.unsolicited, "frames nobody asked for"),
            (self.superseded, "set-points replaced by newer ones"),
            (self.lost_samples, "samples lost"),
        ] {
            if count > 0 {
                write!(f, "; {count} {what}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_did_not_happen_is_left_out() {
        let received = frame::Counters { frames: 3, frame_bytes: 60, no_start_byte: 7, ..Default::default() };
        let counters =
            LinkCounters { received, sent_frames: 2, sent_bytes: 12, repeats: 1, ..Default::default() };
        assert_eq!(
            counters.to_string(),
            "2 frames sent (12 bytes), 3 received (60 bytes); 7 bytes skipped between frames; 1 reads sent again"
        );
    }
}
