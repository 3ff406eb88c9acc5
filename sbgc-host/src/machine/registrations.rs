//! The data streams that run on the board for this link.
//!
//! A board has ten registrations for all its ports together, so equal requests share one, and one that nobody uses any
//! more is unregistered. What subscribers want and what the board is known to do are kept apart: a request is made
//! whenever they differ, one at a time for each stream, until the board has confirmed it.

mod registration;

use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;

use super::call::Failure;
use super::queue::{Interruption, Queue};
use super::samples::Shape;
pub use registration::StreamCall;
use registration::{Asked, OnBoard, ROUNDS, Registration, User, request};

/// How many streams a board registers, over all its ports.
pub const MAX_STREAMS: usize = 10;

/// How long after its notice a board is reset, as a rule, and some time for its start.
const RESET: Duration = Duration::from_millis(1500);

/// How long after a notice of a reset streams that are not periodic are registered once more, for nothing else would
/// show that the reset came later.
const LATE_RESET: Duration = Duration::from_secs(15);

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

/// A request to the board to start or end a stream.
#[derive(Debug)]
pub(super) struct StreamChange {
    /// Number of the registration.
    pub(super) number: u64,
    pub(super) payload: Bytes,
    /// Whether it ends the stream.
    pub(super) stop: bool,
    /// Whether it ends a stream whose start is not confirmed yet.
    pub(super) overtakes: bool,
}

/// Who is to be told what.
pub(super) type Told<W> = Vec<(W, Result<Bytes, Failure>)>;

impl<W> Registrations<W> {
    /// Adds a subscriber. Returns who is to be told at once.
    pub(super) fn add(&mut self, call: StreamCall, number: u64, queue: Arc<Queue>, waiter: W) -> Told<W> {
        let user = User { number, queue };
        let confused = |other: &Registration<W>| {
            !other.users.is_empty() && !other.call.shape.is_distinct_from(&call.shape)
        };
        if self.list.iter().any(confused) {
            user.queue.end();
            return vec![(waiter, Err(Failure::Indistinct))];
        }
        let same = |other: &&mut Registration<W>| {
            (other.call.shape.command, other.call.shape.config) == (call.shape.command, call.shape.config)
        };
        if let Some(found) = self.list.iter_mut().find(same) {
            if found.users.is_empty() {
                // It is on its way out, so it may as well come back at another interval.
                found.call = call;
                if found.on_board == OnBoard::Running {
                    found.on_board = OnBoard::Unknown;
                }
                (found.not_before, found.failures) = (Duration::ZERO, 0);
                (found.confirmed, found.interrupted) = (false, None);
            } else if (found.call.interval_ms, found.call.synced) != (call.interval_ms, call.synced) {
                user.queue.end();
                return vec![(waiter, Err(Failure::StreamInUse { running_ms: found.call.interval_ms }))];
            }
            found.users.push(user);
            if found.confirmed {
                return vec![(waiter, Ok(Bytes::new()))];
            }
            found.waiting.push(waiter);
            return Vec::new();
        }
        if self.list.iter().filter(|other| !other.users.is_empty()).count() >= MAX_STREAMS {
            user.queue.end();
            return vec![(waiter, Err(Failure::TooManyStreams))];
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
            confirmed: false,
            last_sample: Duration::ZERO,
            interrupted: None,
            renew_at: None,
        });
        Vec::new()
    }

    /// Whether the answer to a request could be mistaken for a sample of a stream that runs.
    pub(super) fn is_confusing(&self, shape: &Shape) -> bool {
        self.list
            .iter()
            .any(|other| other.on_board != OnBoard::Absent && !other.call.shape.is_distinct_from(shape))
    }

    /// Whether a stream of this command runs.
    pub(super) fn has(&self, command: u8) -> bool {
        self.list.iter().any(|other| other.call.shape.command == command && other.on_board != OnBoard::Absent)
    }

    /// A frame came, which was or was not an answer. Returns how many samples were lost for it, if it is a sample.
    pub(super) fn on_frame(
        &mut self,
        now: Duration,
        command: u8,
        payload: &[u8],
        answers: bool,
    ) -> Option<u64> {
        let alone = self.list.iter().filter(|other| other.call.shape.command == command).count() == 1;
        let mut lost = None;
        for found in self.list.iter_mut().filter(|other| other.call.shape.command == command) {
            let shape = &found.call.shape;
            if !(shape.fits(payload) || (alone && !answers && shape.admits(payload))) {
                continue;
            }
            if let Some(since) = found.interrupted.take() {
                let after = now.saturating_sub(since);
                found.users.iter().for_each(|user| user.queue.resumed(after));
            }
            found.last_sample = now;
            if found.on_board == OnBoard::Running {
                found.failures = 0;
            }
            for user in &found.users {
                *lost.get_or_insert(0) += u64::from(user.queue.push(command, payload));
            }
        }
        lost
    }

    /// The board is about to be reset, which ends all streams.
    pub(super) fn on_reset(&mut self, now: Duration) {
        for found in &mut self.list {
            found.on_board = if found.users.is_empty() { OnBoard::Absent } else { OnBoard::Unknown };
            found.not_before = now.saturating_add(RESET);
            found.renew_at = Some(now.saturating_add(LATE_RESET)).filter(|_| !found.call.is_periodic());
            found.interrupt(now, Interruption::Reset);
        }
    }

    /// The link is gone for a while, or another one is there. What runs on the board is unknown.
    pub(super) fn on_interruption(&mut self, now: Duration, interruption: Interruption) {
        for found in &mut self.list {
            (found.on_board, found.asked) = (OnBoard::Unknown, Asked::Nothing);
            (found.not_before, found.failures) = (now, 0);
            found.interrupt(now, interruption);
        }
    }

    /// Notices streams that have fallen silent.
    pub(super) fn check(&mut self, now: Duration, latency: Duration) {
        let mut silent = false;
        for found in &mut self.list {
            let running = found.on_board == OnBoard::Running && found.asked == Asked::Nothing;
            let due = found.last_sample.saturating_add(found.call.silence(latency)) <= now;
            if running && found.call.is_periodic() && !found.users.is_empty() && due {
                found.on_board = OnBoard::Unknown;
                found.back_off(now);
                if found.failures == 1 {
                    found.not_before = now;
                }
                found.interrupt(now, Interruption::Silent);
                silent = true;
            }
            if found.renew_at.is_some_and(|at| at <= now) {
                found.renew_at = None;
                found.on_board = OnBoard::Unknown;
            }
        }
        // Perhaps the board was reset, which ends those as well of which nobody knows when a sample should come.
        if silent {
            for found in self.list.iter_mut().filter(|found| !found.call.is_periodic()) {
                if found.on_board == OnBoard::Running {
                    found.on_board = OnBoard::Unknown;
                }
            }
        }
    }

    /// A subscriber has left.
    pub(super) fn leave(&mut self, user: u64) {
        for registration in &mut self.list {
            registration.users.retain(|other| other.number != user);
        }
    }

    /// Nobody uses any of them any more. Returns who waited.
    pub(super) fn clear(&mut self) -> Vec<W> {
        self.list.iter_mut().for_each(|registration| {
            registration.end();
            registration.not_before = Duration::ZERO;
        });
        self.list.iter_mut().flat_map(|registration| registration.waiting.drain(..)).collect()
    }

    /// Whether nothing is left to be done: no stream runs, and none is asked for.
    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The next request to the board. Call it until there is none.
    pub(super) fn next_request(&mut self, now: Duration) -> Option<StreamChange> {
        self.list.retain(|registration| {
            let idle = registration.asked == Asked::Nothing && registration.on_board == OnBoard::Absent;
            !(idle && registration.users.is_empty())
        });
        // A stream that cannot be told from one that is on its way out has to wait until that has ended.
        let ending = self.list.iter().filter(|other| other.users.is_empty());
        let ending: Vec<Shape> = ending.map(|other| other.call.shape).collect();
        self.list.iter_mut().find_map(|registration| {
            let wanted = !registration.users.is_empty();
            let stop = match (registration.asked, wanted, registration.on_board) {
                // Whoever asked for it has left: it ends as soon as it has begun.
                (Asked::Start, false, _) => true,
                (Asked::Nothing, false, _) if now >= registration.not_before => true,
                (Asked::Nothing, true, OnBoard::Absent | OnBoard::Unknown)
                    if now >= registration.not_before
                        && ending.iter().all(|other| other.is_distinct_from(&registration.call.shape)) =>
                {
                    false
                }
                _ => return None,
            };
            let overtakes = registration.asked == Asked::Start;
            registration.asked = if stop { Asked::Stop } else { Asked::Start };
            let interval_ms = if stop { 0 } else { registration.call.interval_ms };
            let (number, payload) = (registration.number, request(&registration.call, interval_ms));
            Some(StreamChange { number, payload, stop, overtakes })
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
            Ok(()) if stop => {
                found.on_board = OnBoard::Absent;
                Vec::new()
            }
            Ok(()) => {
                (found.on_board, found.confirmed, found.last_sample) = (OnBoard::Running, true, now);
                if !found.call.is_periodic() {
                    found.failures = 0;
                    // Nothing else would show that the stream is back.
                    if let Some(since) = found.interrupted.take() {
                        let after = now.saturating_sub(since);
                        found.users.iter().for_each(|user| user.queue.resumed(after));
                    }
                }
                tell(&mut found.waiting, &Ok(Bytes::new()))
            }
            Err(failure) => {
                found.on_board = match failure {
                    Failure::Refused { .. } => OnBoard::Absent,
                    _ if stop && found.failures >= ROUNDS => OnBoard::Absent,
                    // Perhaps only the confirmation was lost.
                    _ => OnBoard::Unknown,
                };
                let refused = matches!(failure, Failure::Refused { .. });
                if !stop && (refused || !found.confirmed) {
                    if refused {
                        found.interrupted = None;
                        found.interrupt(now, Interruption::Refused);
                    }
                    found.end();
                    return tell(&mut found.waiting, &Err(failure));
                }
                found.back_off(now);
                Vec::new()
            }
        }
    }

    /// The board is gone, and all registrations with it. Returns who waited for one.
    pub(super) fn on_lost(&mut self) -> Vec<W> {
        self.list.iter_mut().for_each(Registration::end);
        self.list.drain(..).flat_map(|registration| registration.waiting).collect()
    }

    /// When there is something to be done.
    pub(super) fn next_wake(&self, now: Duration, latency: Duration) -> Option<Duration> {
        let idle = self.list.iter().filter(|registration| registration.asked == Asked::Nothing);
        let due = idle.clone().filter(|registration| {
            registration.users.is_empty() || registration.on_board != OnBoard::Running
        });
        let due = due.map(|registration| registration.not_before);
        let silent = idle.clone().filter(|registration| {
            let running = registration.on_board == OnBoard::Running && !registration.users.is_empty();
            running && registration.call.is_periodic()
        });
        let silent = silent.map(|found| found.last_sample.saturating_add(found.call.silence(latency)));
        let renewals = idle.filter_map(|registration| registration.renew_at);
        due.chain(silent).chain(renewals).filter(|time| *time > now).min()
    }
}

fn tell<W>(waiting: &mut Vec<W>, outcome: &Result<Bytes, Failure>) -> Told<W> {
    waiting.drain(..).map(|waiter| (waiter, outcome.clone())).collect()
}
