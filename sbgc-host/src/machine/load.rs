//! How much of the board's input buffer what was sent may still take.
//!
//! A board carries out its commands in order, and hangs as long as an answer does not fit its output buffer. What comes
//! meanwhile stays in its input buffer, whatever the pace: twenty reads with long answers fit one batch, and the line
//! needs a third of a second for their answers. So what was sent is counted until the board has surely gone on to it:
//! an answer shows that all before it is done, and without one it takes no longer than the line needs for the longest
//! answers.

use std::collections::VecDeque;
use std::time::Duration;

use sbgc_proto::frame::BOARD_BUFFER;

use super::pacer::{BITS_PER_BYTE, BOARD_CYCLE};

/// The bit rate where none is known: that of almost all boards.
const USUAL_BAUD: u32 = 115_200;

/// What a confirmation takes of the output buffer, with its frame.
const CONFIRMATION: usize = 16;

/// The size of the output buffer, which the longest answers fill.
const OUTPUT: usize = BOARD_BUFFER;

/// How much the answer to a command takes of the output buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answers {
    /// A confirmation or nothing.
    Shortly,
    /// Anything else; how long it is becomes clear only when it comes.
    AtLength,
}

/// A command that the board may not have carried out yet.
#[derive(Debug)]
struct Waiting {
    number: u64,
    length: usize,
    answers: Answers,
    /// When the board gets to it if nothing is before it.
    ready: Duration,
    /// When the board gets to it at the latest.
    taken_up: Duration,
}

/// The commands on their way, as the board's buffers feel them.
#[derive(Debug)]
pub(super) struct Load {
    /// `None` where bytes to the board take no time.
    line: Option<Duration>,
    byte_time: Duration,
    /// When the line has carried all that was written.
    line_free: Duration,
    /// When the last answer is in the output buffer, at the latest.
    placed: Duration,
    /// When the last answer has left the output buffer, at the latest.
    drained: Duration,
    waiting: VecDeque<Waiting>,
}

impl Load {
    /// Of a line of so many bits per second.
    pub(super) fn new(baud: Option<u32>) -> Self {
        let byte_time =
            |baud: u32| Duration::from_nanos((BITS_PER_BYTE * 1_000_000_000).div_ceil(baud.max(1).into()));
        Self {
            line: baud.map(byte_time),
            byte_time: byte_time(baud.unwrap_or(USUAL_BAUD)),
            line_free: Duration::ZERO,
            placed: Duration::ZERO,
            drained: Duration::ZERO,
            waiting: VecDeque::new(),
        }
    }

    /// A command of `length` bytes was written. `streams` says whether samples may fill the output buffer.
    pub(super) fn written(
        &mut self,
        now: Duration,
        number: u64,
        length: usize,
        answers: Answers,
        streams: bool,
    ) {
        self.prune(now);
        let on_the_line = self.line.map_or(Duration::ZERO, |byte_time| times(byte_time, length));
        self.line_free = self.line_free.max(now).saturating_add(on_the_line);
        let ready = self.line_free.saturating_add(BOARD_CYCLE);
        let mut waiting = Waiting { number, length, answers, ready, taken_up: ready };
        self.place(&mut waiting, streams);
        self.waiting.push_back(waiting);
    }

    /// A command was answered, so all before it are done as well.
    pub(super) fn answered(&mut self, now: Duration, number: u64, streams: bool) {
        let Some(index) = self.waiting.iter().position(|waiting| waiting.number == number) else { return };
        self.waiting.drain(..=index);
        // The answer has left the buffer, and whatever went before it.
        (self.placed, self.drained) = (now, now);
        for mut waiting in std::mem::take(&mut self.waiting) {
            self.place(&mut waiting, streams);
            self.waiting.push_back(waiting);
        }
    }

    /// When the board gets to a command, and when its answer has room, at the latest.
    fn place(&mut self, waiting: &mut Waiting, streams: bool) {
        let size = match waiting.answers {
            Answers::Shortly => CONFIRMATION,
            Answers::AtLength => OUTPUT,
        };
        let times = |count| times(self.byte_time, count);
        waiting.taken_up = waiting.ready.max(self.placed);
        let full = waiting.taken_up.saturating_add(times(OUTPUT));
        let drained = if streams { self.drained.max(full) } else { self.drained };
        let fits = drained.saturating_add(times(size)).saturating_sub(times(OUTPUT));
        self.placed = waiting.taken_up.max(fits);
        self.drained = drained.max(self.placed).saturating_add(times(size));
    }

    fn prune(&mut self, now: Duration) {
        while self.waiting.front().is_some_and(|waiting| waiting.taken_up <= now) {
            self.waiting.pop_front();
        }
    }

    /// Those that the board is kept from. That it reads its input in cycles is not counted: the pacer sees to that.
    fn kept(&self, now: Duration) -> impl Iterator<Item = &Waiting> {
        self.waiting.iter().filter(move |waiting| waiting.taken_up > now.max(waiting.ready))
    }

    /// How many bytes may wait in the input buffer because the board hangs.
    pub(super) fn in_use(&self, now: Duration) -> usize {
        self.kept(now).map(|waiting| waiting.length).sum()
    }

    /// When there may be fewer of them without an answer.
    pub(super) fn next_release(&self, now: Duration) -> Option<Duration> {
        self.kept(now).map(|waiting| waiting.taken_up).min()
    }
}

fn times(byte_time: Duration, count: usize) -> Duration {
    byte_time.saturating_mul(u32::try_from(count).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: Duration = Duration::from_secs(1);
    const MS: fn(u64) -> Duration = Duration::from_millis;

    #[test]
    fn long_answers_keep_the_board_from_what_follows() {
        let mut load = Load::new(Some(115_200));
        for number in 0..10 {
            load.written(START, number, 12, Answers::AtLength, false);
        }
        // The first answer has room at once and the second once that has gone, 22 ms later; the others wait.
        assert_eq!(load.in_use(START), 8 * 12);
        assert_eq!(load.in_use(START + MS(8 + 10 + 23)), 7 * 12);
        // An answer shows that what came before it is done, too.
        load.answered(START + MS(30), 4, false);
        assert_eq!(load.in_use(START + MS(30)), 3 * 12);
        load.answered(START + MS(31), 9, false);
        assert_eq!((load.in_use(START + MS(31)), load.next_release(START + MS(31))), (0, None));
    }

    #[test]
    fn without_answers_the_board_has_gone_on_after_the_time_of_the_longest() {
        let mut load = Load::new(None);
        for number in 0..4 {
            load.written(START, number, 6, Answers::AtLength, true);
        }
        let mut now = START;
        let mut uses = vec![load.in_use(now)];
        while let Some(release) = load.next_release(now) {
            now = release;
            uses.push(load.in_use(now));
        }
        assert_eq!(uses, [18, 12, 6, 0]);
        assert!(now < START + MS(8 + 3 * 23), "{now:?}");
    }

    #[test]
    fn confirmations_of_set_points_keep_the_board_from_nothing() {
        let mut load = Load::new(Some(115_200));
        for number in 0..100 {
            let now = START + MS(number * 8);
            load.written(now, number, 21, Answers::Shortly, true);
            assert_eq!(load.in_use(now + MS(8)), 0);
        }
    }
}
