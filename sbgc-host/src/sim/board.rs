//! The board: its line, its time, and what it does when.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::frame::Version;

use super::answers::{Packet, Reply};
use super::config::Config;
use super::line::{Line, LineCounters};
use super::machine::Machine;
use super::motion::Motion;

/// The board works through its queue once in this time.
pub const POLL: Duration = Duration::from_millis(8);

/// A simulated board, as plain state: it does no input or output and looks at no clock.
///
/// Time is given to it, counted from its start; going back does nothing. Whoever drives it gives it the host's bytes
/// with [`receive`](Self::receive), calls [`advance`](Self::advance) no later than [`next_event`](Self::next_event)
/// says, and then fetches what the board has sent with [`take_output`](Self::take_output).
///
/// ```
/// use std::time::Duration;
///
/// use sbgc_host::sim::{Board, Config};
///
/// let mut board = Board::new(Config::default());
/// let start = Duration::from_secs(1);
/// board.receive(start, &[0x3E, 86, 0, 86, 0]);
/// board.advance(start + Duration::from_millis(8));
/// assert_eq!(board.take_output()[..4], [0x3E, 86, 18, 104]);
/// ```
#[derive(Debug)]
pub struct Board {
    line: Line,
    machine: Machine,
    now: Duration,
    /// The version of the last command.
    version: Version,
    /// When it resets.
    reset_at: Option<Duration>,
    /// Until when it is deaf.
    booting_until: Duration,
    resets: u64,
}

impl Board {
    /// A board that has just started and listens.
    pub fn new(config: Config) -> Self {
        Self {
            line: Line::new(config.bit_rate),
            machine: Machine::new(config),
            now: Duration::ZERO,
            version: Version::V1,
            reset_at: None,
            booting_until: Duration::ZERO,
            resets: 0,
        }
    }

    /// Puts bytes of the host on the line at `now`.
    pub fn receive(&mut self, now: Duration, bytes: &[u8]) {
        self.advance(now);
        self.line.carry_in(self.now, bytes);
    }

    /// Bytes of the host that are still on the line. Who drives the board should not let them grow without bound.
    pub fn unreceived(&self) -> usize {
        self.line.coming()
    }

    /// Does everything that happens up to `now`, each thing at its time.
    pub fn advance(&mut self, now: Duration) {
        while let Some(time) = self.next_event().filter(|time| *time <= now) {
            self.now = time;
            self.machine.motion.advance(time);
            self.happen(time);
            self.line.carry_out(time);
        }
        self.now = self.now.max(now);
        self.machine.motion.advance(self.now);
        self.line.carry_out(self.now);
    }

    /// When something happens next that the host could notice; always later than the last
    /// [`advance`](Self::advance).
    pub fn next_event(&self) -> Option<Duration> {
        [
            self.line.next_out(),
            (self.line.is_busy() || self.machine.wants_poll()).then(|| next_multiple(self.now, POLL)),
            self.machine.streams.next(),
            self.reset_at,
        ]
        .into_iter()
        .flatten()
        .min()
        // Whatever is overdue happens a moment later, so that time goes on.
        .map(|time| time.max(self.now.saturating_add(Duration::from_nanos(1))))
    }

    /// What has arrived at the host since the last call.
    pub fn take_output(&mut self) -> Bytes {
        let output = self.line.take_gone();
        self.line.carry_out(self.now);
        output
    }

    /// What became of the messages so far.
    pub fn counters(&self) -> LineCounters {
        self.line.counters()
    }

    /// How often the board was reset.
    pub fn resets(&self) -> u64 {
        self.resets
    }

    /// How the camera stands and moves.
    pub fn motion(&self) -> &Motion {
        &self.machine.motion
    }

    fn happen(&mut self, time: Duration) {
        if self.reset_at.is_some_and(|at| at <= time) {
            self.reset(time);
        }
        for (version, sample) in self.machine.samples(time) {
            self.line.send_sample(time, version, sample.id.raw(), &sample.payload);
        }
        if is_multiple(time, POLL) {
            self.poll(time);
        }
    }

    fn poll(&mut self, time: Duration) {
        self.line.take_in(time, time < self.booting_until);
        while let Some(received) = self.line.next_command() {
            self.version = received.version;
            let replies = self.machine.answer(time, &received);
            let replies = replies.or_else(|refusal| refusal.replies(received.id.into()));
            for reply in replies.unwrap_or_default() {
                match reply {
                    Reply::Send(packet) => self.send(time, &packet),
                    Reply::Reset { after } => self.reset_at = Some(time.saturating_add(after)),
                }
            }
        }
        for packet in self.machine.poll(time) {
            self.send(time, &packet);
        }
    }

    fn send(&mut self, time: Duration, packet: &Packet) {
        self.line.send(time, self.version, packet.id.raw(), &packet.payload);
    }

    fn reset(&mut self, time: Duration) {
        self.reset_at = None;
        self.resets += 1;
        self.line.reset();
        self.machine.reset();
        self.version = Version::V1;
        self.booting_until = time.saturating_add(self.machine.config().boot);
    }
}

/// The first multiple of `step` after `time`.
fn next_multiple(time: Duration, step: Duration) -> Duration {
    let over = time.as_nanos().checked_rem(step.as_nanos()).unwrap_or_default();
    let over = Duration::from_nanos(u64::try_from(over).unwrap_or_default());
    time.saturating_sub(over).saturating_add(step)
}

fn is_multiple(time: Duration, step: Duration) -> bool {
    time.as_nanos().checked_rem(step.as_nanos()) == Some(0)
}
