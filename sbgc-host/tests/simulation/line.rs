//! Dice, and a line with faults.

use std::collections::VecDeque;
use std::time::Duration;

/// Numbers that look random and are the same each time (xorshift64*).
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        // Seeds that are near each other must not begin alike, and zero would stay zero.
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x1234_5678_9ABC_DEF1)
    }

    pub(crate) fn roll(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 16
    }

    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.roll() % limit.max(1)
    }

    pub(crate) fn percent(&mut self, percent: u64) -> bool {
        self.below(100) < percent
    }

    pub(crate) fn millis(&mut self, below: u64) -> Duration {
        Duration::from_millis(self.below(below))
    }
}

/// Bytes on their way.
pub(crate) struct Piece {
    pub(crate) due: Duration,
    /// When they were put on the line.
    pub(crate) sent: Duration,
    pub(crate) bytes: Vec<u8>,
}

/// One direction of the line. What is sent first arrives first.
#[derive(Default)]
pub(crate) struct Line {
    pub(crate) pieces: VecDeque<Piece>,
}

impl Line {
    /// Puts bytes on the line, which damages or drops one piece in so many percent.
    pub(crate) fn send(
        &mut self,
        now: Duration,
        delay: Duration,
        bytes: &[u8],
        faults: u64,
        dice: &mut Dice,
    ) {
        let mut bytes = bytes.to_vec();
        if dice.percent(faults) {
            match dice.below(2) {
                0 => {
                    let at = usize::try_from(dice.below(bytes.len() as u64)).unwrap();
                    bytes[at] ^= 1 << dice.below(8);
                }
                _ => return,
            }
        }
        let due = self.pieces.back().map_or(Duration::ZERO, |piece| piece.due).max(now + delay);
        self.pieces.push_back(Piece { due, sent: now, bytes });
    }

    pub(crate) fn next(&self) -> Option<Duration> {
        self.pieces.front().map(|piece| piece.due)
    }

    pub(crate) fn take(&mut self, now: Duration) -> Option<Piece> {
        if self.next()? <= now { self.pieces.pop_front() } else { None }
    }
}
