//! When the next bytes may go out.
//!
//! A board reads its input each 8 ms and has room for 255 bytes; what does not fit is lost, message by message. So
//! bytes go out in batches of at most that size, each at least 8 ms after the one before it, and never faster than
//! the line carries them, for what waits in the driver's own buffers cannot be taken back.

use std::time::Duration;

/// How often a board reads its input.
pub(super) const BOARD_CYCLE: Duration = Duration::from_millis(8);

/// Start bit, data and stop bit. A parity bit would make it 11, which nobody notices at this granularity.
pub(super) const BITS_PER_BYTE: u64 = 10;

/// Says when the next batch may go out.
#[derive(Debug)]
pub(super) struct Pacer {
    baud: Option<u32>,
    /// When the batch that is being written was begun.
    begun: Duration,
    not_before: Duration,
}

impl Pacer {
    /// For a line of so many bits per second; `None` where the bytes do not pass a serial line that is known.
    pub(super) fn new(baud: Option<u32>, now: Duration) -> Self {
        Self { baud, begun: now, not_before: now }
    }

    /// When the next batch may be begun.
    pub(super) fn not_before(&self) -> Duration {
        self.not_before
    }

    pub(super) fn begin(&mut self, now: Duration) {
        self.begun = now;
    }

    /// A batch of `length` bytes is written.
    pub(super) fn end(&mut self, now: Duration, length: usize) {
        let on_the_line = match self.baud {
            Some(baud) => {
                let bits = (length as u64).saturating_mul(BITS_PER_BYTE);
                let nanos = bits.saturating_mul(1_000_000_000).div_ceil(u64::from(baud.max(1)));
                Duration::from_nanos(nanos)
            }
            None => Duration::ZERO,
        };
        self.not_before = self.begun.saturating_add(on_the_line).max(now.saturating_add(BOARD_CYCLE));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_batches_keep_to_the_cycle_of_the_board() {
        let start = Duration::from_secs(1);
        let mut pacer = Pacer::new(Some(115_200), start);
        assert_eq!(pacer.not_before(), start);
        pacer.begin(start);
        pacer.end(start, 7);
        assert_eq!(pacer.not_before(), start + Duration::from_millis(8));
    }

    #[test]
    fn large_batches_keep_to_the_line() {
        let start = Duration::from_secs(1);
        let mut pacer = Pacer::new(Some(9600), start);
        pacer.begin(start);
        pacer.end(start, 240);
        assert_eq!(pacer.not_before(), start + Duration::from_millis(250));
    }

    #[test]
    fn a_write_that_was_held_up_counts_from_its_end() {
        let start = Duration::from_secs(1);
        let mut pacer = Pacer::new(None, start);
        pacer.begin(start);
        pacer.end(start + Duration::from_millis(30), 255);
        assert_eq!(pacer.not_before(), start + Duration::from_millis(38));
    }
}
