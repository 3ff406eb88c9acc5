//! What a link has seen and done, in numbers.

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
