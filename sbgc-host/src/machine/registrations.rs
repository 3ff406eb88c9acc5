//! The data streams that run on the board for this link.
//!
//! A board has ten registrations for all its ports together, so equal requests share one, and one that nobody uses any
//! more is unregistered. What subscribers want and what the board is known to do are kept apart: a request is made
//! whenever they differ, one at a time for each stream, until the board has confirmed it.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{DataStreamInterval, StreamConfig};
use sbgc_proto::units::StreamInterval;
use sbgc_proto::{CommandId, Message};

use super::call::Failure;

/// After this many requests without an answer nobody is left to unregister a stream at.
const ROUNDS: u32 = 8;

/// Time to the first repetition of a request to unregister that was not confirmed; it doubles each time.
const BACK_OFF: Duration = Duration::from_millis(500);

/// A data stream that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StreamCall {
    /// The message.
    pub command: u8,
    /// Time between two messages, in milliseconds; at least 1.
    pub interval_ms: u16,
    /// Configuration of the stream.
    pub config: [u8; 8],
    /// How many payload bytes a sample has, where this distinguishes samples.
    pub length: Option<usize>,
    /// How many samples wait for the subscriber before the oldest is lost.
    pub capacity: usize,
}

/// What the board is known to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OnBoard {
    Absent,
    Running,
    Unknown,
}

/// What the board is asked to do at present.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Nothing,
    Start,
    Stop,
}

#[derive(Debug)]
struct Registration<W> {
    number: u64,
    call: StreamCall,
    users: Vec<u64>,
    /// Who waits for the confirmation.
    waiting: Vec<W>,
    on_board: OnBoard,
    asked: Asked,
    /// How many requests in a row were not answered.
    failures: u32,
    not_before: Duration,
}

/// All of them. `W` is who waits for a stream to be confirmed.
#[derive(Debug)]
pub(super) struct Registrations<W> {
    list: Vec<Registration<W>>,
    next_number: u64,
}

impl<W> Default for Registrations<W> {
    fn default() -> Self {
        Self { list: Vec::new(), next_number: 0 }
    }
}

/// Who is to be told what.
pub(super) type Told<W> = Vec<(W, Result<Bytes, Failure>)>;

impl<W> Registrations<W> {
    /// Adds a subscriber. Returns who is to be told at once.
    pub(super) fn add(&mut self, call: StreamCall, user: u64, waiter: W) -> Told<W> {
        let same = |other: &&mut Registration<W>| {
            (other.call.command, other.call.config) == (call.command, call.config)
        };
        if let Some(found) = self.list.iter_mut().find(same) {
            if found.users.is_empty() {
                // It is on its way out, so it may as well come back at another interval.
                found.call = call;
                if found.on_board == OnBoard::Running {
                    found.on_board = OnBoard::Unknown;
                }
                found.not_before = Duration::ZERO;
                found.failures = 0;
            } else if found.call.interval_ms != call.interval_ms {
                return vec![(waiter, Err(Failure::StreamInUse { running_ms: found.call.interval_ms }))];
            }
            found.users.push(user);
            if found.on_board == OnBoard::Running && found.asked == Asked::Nothing {
                return vec![(waiter, Ok(Bytes::new()))];
            }
            found.waiting.push(waiter);
            return Vec::new();
        }
        let number = self.next_number;
        self.next_number = number.wrapping_add(1);
        self.list.push(Registration {
            number,
            call,
            users: vec![user],
            waiting: vec![waiter],
            on_board: OnBoard::Absent,
            asked: Asked::Nothing,
            failures: 0,
            not_before: Duration::ZERO,
        });
        Vec::new()
    }

    /// A subscriber has left.
    pub(super) fn leave(&mut self, user: u64) {
        for registration in &mut self.list {
            registration.users.retain(|other| *other != user);
        }
    }

    /// Nobody uses any of them any more. Returns who waited.
    pub(super) fn clear(&mut self) -> Vec<W> {
        self.list.iter_mut().for_each(|registration| {
            registration.users.clear();
            registration.not_before = Duration::ZERO;
        });
        self.list.iter_mut().flat_map(|registration| registration.waiting.drain(..)).collect()
    }

    /// Whether nothing is left to be done: no stream runs, and none is asked for.
    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The next request to the board: number of the registration, payload, whether it may follow at once what was
    /// sent before it. Call it until there is none.
    pub(super) fn next_request(&mut self, now: Duration) -> Option<(u64, Bytes, bool)> {
        self.list.retain(|registration| {
            let idle = registration.asked == Asked::Nothing && registration.on_board == OnBoard::Absent;
            !(idle && registration.users.is_empty())
        });
        self.list.iter_mut().find_map(|registration| {
            let wanted = !registration.users.is_empty();
            let stop = match (registration.asked, wanted, registration.on_board) {
                // Whoever asked for it has left: it ends as soon as it has begun.
                (Asked::Start, false, _) => true,
                (Asked::Nothing, false, _) if now >= registration.not_before => true,
                (Asked::Nothing, true, OnBoard::Absent | OnBoard::Unknown)
                    if now >= registration.not_before =>
                {
                    false
                }
                _ => return None,
            };
            registration.asked = if stop { Asked::Stop } else { Asked::Start };
            let interval_ms = if stop { 0 } else { registration.call.interval_ms };
            Some((registration.number, request(&registration.call, interval_ms), stop))
        })
    }

    /// The board answered, or did not. `stop` says which request it was. Returns who is to be told.
    pub(super) fn settle(
        &mut self,
        now: Duration,
        number: u64,
        stop: bool,
        outcome: Result<(), Failure>,
    ) -> Told<W> {
        let Some(found) = self.list.iter_mut().find(|registration| registration.number == number) else {
            return Vec::new();
        };
        if stop != (found.asked == Asked::Stop) {
            // A start that was overtaken by the stop that follows it.
            return Vec::new();
        }
        found.asked = Asked::Nothing;
        match outcome {
            Ok(()) => {
                found.failures = 0;
                found.on_board = if stop { OnBoard::Absent } else { OnBoard::Running };
                if stop { Vec::new() } else { tell(&mut found.waiting, &Ok(Bytes::new())) }
            }
            Err(failure) => {
                found.on_board = match failure {
                    Failure::Refused { .. } => OnBoard::Absent,
                    _ if stop && found.failures >= ROUNDS => OnBoard::Absent,
                    // Perhaps only the confirmation was lost.
                    _ => OnBoard::Unknown,
                };
                if stop {
                    found.failures += 1;
                    let exponent = found.failures.saturating_sub(1).min(ROUNDS);
                    found.not_before = now.saturating_add(BACK_OFF.saturating_mul(1 << exponent));
                    Vec::new()
                } else {
                    found.users.clear();
                    tell(&mut found.waiting, &Err(failure))
                }
            }
        }
    }

    /// The board is gone, and all registrations with it. Returns who waited for one.
    pub(super) fn on_lost(&mut self) -> Vec<W> {
        self.list.drain(..).flat_map(|registration| registration.waiting).collect()
    }

    /// When [`next_request`](Self::next_request) may have something new.
    pub(super) fn next_wake(&self, now: Duration) -> Option<Duration> {
        let due = self.list.iter().filter(|registration| {
            registration.asked == Asked::Nothing
                && (registration.users.is_empty() || registration.on_board != OnBoard::Running)
        });
        due.map(|registration| registration.not_before).filter(|time| *time > now).min()
    }
}

fn tell<W>(waiting: &mut Vec<W>, outcome: &Result<Bytes, Failure>) -> Told<W> {
    waiting.drain(..).map(|waiter| (waiter, outcome.clone())).collect()
}

/// The payload that registers a stream; with interval 0 the one that ends it.
fn request(call: &StreamCall, interval_ms: u16) -> Bytes {
    let message = DataStreamInterval {
        cmd_id: CommandId::from_raw(call.command),
        interval_ms: StreamInterval(interval_ms),
        config: StreamConfig(call.config.into()),
        ..DataStreamInterval::default()
    };
    let mut buffer = [0; 32];
    let payload = message.encode(&mut buffer);
    debug_assert!(payload.is_ok(), "a message of fixed size fits");
    Bytes::copy_from_slice(payload.unwrap_or_default())
}
