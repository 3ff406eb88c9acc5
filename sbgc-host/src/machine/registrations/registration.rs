//! One data stream: what subscribers want of it, and what the board is known to do.

use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{DataStreamInterval, StreamConfig, Switch};
use sbgc_proto::units::StreamInterval;
use sbgc_proto::{CommandId, Message};

use crate::machine::queue::{Interruption, Queue};
use crate::machine::samples::Shape;

/// After this many requests without an answer nobody is left to unregister a stream at.
pub(super) const ROUNDS: u32 = 8;

/// Time to the first repetition of a request that was not confirmed; it doubles each time.
const BACK_OFF: Duration = Duration::from_millis(500);

/// The longest time to the next repetition.
const LONGEST_BACK_OFF: Duration = Duration::from_secs(5);

/// After so many intervals without a sample a stream has fallen silent.
const SILENT_INTERVALS: u32 = 3;

/// The shortest time that counts as silence.
const SHORTEST_SILENCE: Duration = Duration::from_millis(250);

/// A data stream that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StreamCall {
    /// The message and what distinguishes its samples.
    pub shape: Shape,
    /// Time between two messages, in milliseconds; at least 1.
    pub interval_ms: u16,
    /// Whether the interval counts samples of the IMU attitude instead.
    pub synced: bool,
    /// How many samples wait for the subscriber before the oldest is lost.
    pub capacity: usize,
}

impl StreamCall {
    /// Whether samples come at each interval, so that their absence tells something.
    pub(super) fn is_periodic(&self) -> bool {
        self.shape.is_periodic()
    }

    /// How long samples may fail to come.
    pub(super) fn silence(&self, latency: Duration) -> Duration {
        let interval = Duration::from_millis(self.interval_ms.into());
        let allowed = interval.saturating_mul(SILENT_INTERVALS).max(SHORTEST_SILENCE);
        allowed.saturating_add(latency.saturating_mul(2))
    }
}

/// What the board is known to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OnBoard {
    Absent,
    Running,
    Unknown,
}

/// What the board is asked to do at present.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    Nothing,
    Start,
    Stop,
}

/// Who gets the samples.
#[derive(Debug)]
pub(super) struct User {
    pub(super) number: u64,
    pub(super) queue: Arc<Queue>,
}

/// A stream: what is wanted of it, and what the board does.
#[derive(Debug)]
pub(super) struct Registration<W> {
    pub(super) number: u64,
    pub(super) call: StreamCall,
    pub(super) users: Vec<User>,
    /// Who waits for the confirmation.
    pub(super) waiting: Vec<W>,
    pub(super) on_board: OnBoard,
    pub(super) asked: Asked,
    /// How many requests in a row were not answered.
    pub(super) failures: u32,
    pub(super) not_before: Duration,
    /// Whether the board has ever confirmed it.
    pub(super) confirmed: bool,
    pub(super) last_sample: Duration,
    /// Since when the subscribers know that no samples come.
    pub(super) interrupted: Option<Duration>,
    /// When it is registered once more, whether or not it seems to run.
    pub(super) renew_at: Option<Duration>,
}

impl<W> Registration<W> {
    pub(super) fn interrupt(&mut self, now: Duration, interruption: Interruption) {
        if self.interrupted.is_none() && self.confirmed {
            self.interrupted = Some(now);
            self.users.iter().for_each(|user| user.queue.interrupted(interruption));
        }
    }

    pub(super) fn back_off(&mut self, now: Duration) {
        let exponent = self.failures.min(ROUNDS);
        self.failures = self.failures.saturating_add(1);
        let pause = BACK_OFF.saturating_mul(1 << exponent).min(LONGEST_BACK_OFF);
        self.not_before = now.saturating_add(pause);
    }

    pub(super) fn end(&mut self) {
        self.users.drain(..).for_each(|user| user.queue.end());
    }
}

/// The payload that registers a stream; with interval 0 the one that ends it.
pub(super) fn request(call: &StreamCall, interval_ms: u16) -> Bytes {
    let message = DataStreamInterval {
        cmd_id: CommandId::from_raw(call.shape.command),
        interval_ms: StreamInterval(interval_ms),
        config: StreamConfig(call.shape.config.into()),
        sync_to_data: if call.synced { Switch::On } else { Switch::Off },
        ..DataStreamInterval::default()
    };
    let mut buffer = [0; 32];
    let payload = message.encode(&mut buffer);
    debug_assert!(payload.is_ok(), "a message of fixed size fits");
    Bytes::copy_from_slice(payload.unwrap_or_default())
}
