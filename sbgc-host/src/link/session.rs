//! Who waits for what, until when: the one table of requests in flight.
//!
//! A plain state machine. It does no I/O, keeps no clock and never waits; the [task](super) tells it what happens and
//! when, and carries out what it says.
//!
//! # Rules
//! - An answer belongs to the oldest request in flight whose [`Key`] it matches. Two requests that one frame could
//!   answer are never in flight together: the second waits for the first. Others overtake it.
//! - The time for an answer counts from when the request was handed out to be sent.
//! - Only requests that were given several attempts are sent again. Whoever makes a request decides that; writes have
//!   one.
//! - A request that ended without its answer leaves a grave. For a grace period it swallows the answer if that still
//!   comes, and holds back requests that the late answer could be taken for.

use std::collections::VecDeque;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::CommandId;
use tokio::time::Instant;

pub use super::key::Key;

/// How long an answer that is late may still come.
pub const GRACE: Duration = Duration::from_millis(250);

/// Who waits for an answer.
pub trait Waiter {
    /// Whether nobody waits any more.
    fn is_gone(&self) -> bool;
}

/// A command that has an answer.
#[derive(Clone, Debug)]
pub struct Call {
    /// Its id.
    pub command: u8,
    /// Its payload.
    pub payload: Bytes,
    /// What will answer it.
    pub key: Key,
    /// How long an answer may take.
    pub timeout: Duration,
    /// How often it may be sent; 1 for everything but reads.
    pub attempts: u32,
}

/// A frame to be sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outgoing {
    /// Command id.
    pub command: u8,
    /// Payload.
    pub payload: Bytes,
}

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// None came.
    Timeout {
        /// How long was waited in all.
        after: Duration,
        /// How often it was sent.
        attempts: u32,
    },
    /// The board answered that it does not do it.
    Refused {
        /// The error code.
        code: u8,
        /// What the board says besides.
        data: Bytes,
    },
    /// The port went away.
    Disconnected,
    /// The link was closed from this side.
    Closed,
}

/// What a frame was.
#[derive(Debug, PartialEq, Eq)]
pub enum Verdict<W> {
    /// The answer to a request, to be handed over.
    Answer(W, Result<Bytes, Failure>),
    /// An answer that came too late.
    Late,
    /// The answer to a command that was sent without waiting for it.
    Unawaited,
    /// None of these.
    Unsolicited,
}

#[derive(Debug)]
struct Queued<W> {
    call: Call,
    /// `None` for a command whose answer nobody waits for.
    waiter: Option<W>,
    /// Until when the graves of unawaited commands may hold it back.
    hold: Instant,
}

#[derive(Debug)]
struct InFlight<W> {
    call: Call,
    waiter: W,
    first_sent: Instant,
    deadline: Instant,
    /// How often it was sent.
    sent: u32,
    /// Whether it waits to be sent again.
    again: bool,
}

#[derive(Debug)]
struct Grave {
    key: Key,
    command: u8,
    /// How many answers may still come.
    answers: u32,
    until: Instant,
    /// Whether anybody had ever waited for it.
    awaited: bool,
}

/// The table. `W` is who waits.
#[derive(Debug)]
pub struct Session<W> {
    queued: VecDeque<Queued<W>>,
    in_flight: VecDeque<InFlight<W>>,
    graves: Vec<Grave>,
    timeouts: u64,
    repeats: u64,
}

impl<W> Default for Session<W> {
    fn default() -> Self {
        Self {
            queued: VecDeque::new(),
            in_flight: VecDeque::new(),
            graves: Vec::new(),
            timeouts: 0,
            repeats: 0,
        }
    }
}

impl<W: Waiter> Session<W> {
    /// How many requests and commands wait to be sent.
    pub fn queued(&self) -> usize {
        self.queued.len()
    }

    /// Whether there is something to send.
    pub fn wants_to_send(&self, now: Instant) -> bool {
        self.in_flight.iter().any(|entry| entry.again) || self.eligible(now).is_some()
    }

    /// How many requests ended without an answer.
    pub const fn timeouts(&self) -> u64 {
        self.timeouts
    }

    /// How often reads were sent again.
    pub const fn repeats(&self) -> u64 {
        self.repeats
    }

    /// Takes a request.
    pub fn request(&mut self, now: Instant, call: Call, waiter: W) {
        self.queued.push_back(Queued { call, waiter: Some(waiter), hold: now + GRACE });
    }

    /// Takes a command whose answer, if there is one, nobody waits for.
    pub fn send(&mut self, now: Instant, command: u8, payload: Bytes) {
        let key = Key::confirmation(command);
        let call = Call { command, payload, key, timeout: Duration::ZERO, attempts: 1 };
        self.queued.push_back(Queued { call, waiter: None, hold: now });
    }

    /// A command was sent past this table: its confirmation must not be taken for that of another.
    pub fn sent_unawaited(&mut self, now: Instant, command: u8) {
        self.bury(now, Key::confirmation(command), command, 1, false);
    }

    /// The next frame that may be sent, and starts its time. `None` if there is none, if all must wait, or if its
    /// payload is longer than `room`.
    pub fn next_to_send(&mut self, now: Instant, room: usize) -> Option<Outgoing> {
        if let Some(entry) = self.in_flight.iter_mut().find(|entry| entry.again) {
            if entry.call.payload.len() > room {
                return None;
            }
            entry.again = false;
            entry.sent = entry.sent.saturating_add(1);
            entry.deadline = now + entry.call.timeout;
            self.repeats += 1;
            return Some(Outgoing { command: entry.call.command, payload: entry.call.payload.clone() });
        }
        self.queued.retain(|queued| queued.waiter.as_ref().is_none_or(|waiter| !waiter.is_gone()));
        self.graves.retain(|grave| grave.until > now);
        let index = self.eligible(now)?;
        if self.queued.get(index)?.call.payload.len() > room {
            return None;
        }
        let Queued { call, waiter, .. } = self.queued.remove(index)?;
        let outgoing = Outgoing { command: call.command, payload: call.payload.clone() };
        match waiter {
            Some(waiter) => {
                // Whatever held it back that long has had its time.
                self.graves.retain(|grave| !grave.key.overlaps(&call.key));
                let deadline = now + call.timeout;
                let (first_sent, sent, again) = (now, 1, false);
                self.in_flight.push_back(InFlight { call, waiter, first_sent, deadline, sent, again });
            }
            None => self.sent_unawaited(now, call.command),
        }
        Some(outgoing)
    }

    /// Place in the queue of the next one that may be sent.
    fn eligible(&self, now: Instant) -> Option<usize> {
        (0..self.queued.len()).find(|&index| self.may_go(now, index))
    }

    fn may_go(&self, now: Instant, index: usize) -> bool {
        let Some(queued) = self.queued.get(index) else { return false };
        if queued.waiter.is_none() {
            return true;
        }
        let key = &queued.call.key;
        let first = !self.queued.iter().take(index).any(|earlier| earlier.call.key.overlaps(key));
        let alone = !self.in_flight.iter().any(|entry| entry.call.key.overlaps(key));
        first && alone && self.release(queued).is_none_or(|release| release <= now)
    }

    /// Until when graves hold back a request.
    fn release(&self, queued: &Queued<W>) -> Option<Instant> {
        let graves = self.graves.iter().filter(|grave| grave.key.overlaps(&queued.call.key));
        // Unawaited commands may go on and on; those that waited make way for this one first.
        graves.map(|grave| if grave.awaited { grave.until } else { grave.until.min(queued.hold) }).max()
    }

    /// A frame came.
    pub fn on_frame(&mut self, now: Instant, id: u8, payload: &Bytes) -> Verdict<W> {
        if id == CommandId::Error.raw() {
            return self.on_error(now, payload);
        }
        let answered = self.in_flight.iter().position(|entry| entry.call.key.matches(id, payload));
        match answered {
            Some(index) => self.complete(now, index, Ok(payload.clone())),
            None => self.exhume(now, |grave| grave.key.matches(id, payload)),
        }
    }

    /// The board refused something: the command that it names or, in the form without a name, the oldest.
    fn on_error(&mut self, now: Instant, payload: &Bytes) -> Verdict<W> {
        let (command, code, data) = match **payload {
            [] => return Verdict::Unsolicited,
            [code] | [code, _, _, _, _] => (None, code, payload.slice(1..)),
            [command, code, ..] => (Some(command), code, payload.slice(2..)),
        };
        let refused = self
            .in_flight
            .iter()
            .position(|entry| command.is_none_or(|command| entry.call.command == command));
        match refused {
            Some(index) => self.complete(now, index, Err(Failure::Refused { code, data })),
            None => self.exhume(now, |grave| command.is_none_or(|command| grave.command == command)),
        }
    }

    fn complete(&mut self, now: Instant, index: usize, outcome: Result<Bytes, Failure>) -> Verdict<W> {
        let Some(entry) = self.in_flight.remove(index) else { return Verdict::Unsolicited };
        // It was sent several times, so as many answers may come.
        if entry.sent > 1 {
            self.bury(now, entry.call.key, entry.call.command, entry.sent - 1, true);
        }
        if entry.waiter.is_gone() { Verdict::Late } else { Verdict::Answer(entry.waiter, outcome) }
    }

    fn bury(&mut self, now: Instant, key: Key, command: u8, answers: u32, awaited: bool) {
        let until = now + GRACE;
        let same = |grave: &&mut Grave| (grave.key, grave.command, grave.awaited) == (key, command, awaited);
        match self.graves.iter_mut().find(same) {
            Some(grave) => {
                grave.answers = grave.answers.saturating_add(answers);
                grave.until = until;
            }
            None => self.graves.push(Grave { key, command, answers, until, awaited }),
        }
    }

    fn exhume(&mut self, now: Instant, is_it: impl Fn(&Grave) -> bool) -> Verdict<W> {
        self.graves.retain(|grave| grave.until > now);
        let Some(index) = self.graves.iter().position(is_it) else { return Verdict::Unsolicited };
        let Some(grave) = self.graves.get_mut(index) else { return Verdict::Unsolicited };
        let awaited = grave.awaited;
        grave.answers = grave.answers.saturating_sub(1);
        if grave.answers == 0 {
            self.graves.swap_remove(index);
        }
        if awaited { Verdict::Late } else { Verdict::Unawaited }
    }

    /// When [`on_deadline`](Self::on_deadline) must be called, or [`next_to_send`](Self::next_to_send) may have
    /// something new.
    pub fn next_deadline(&self, now: Instant) -> Option<Instant> {
        let answers = self.in_flight.iter().filter(|entry| !entry.again).map(|entry| entry.deadline);
        let awaited = self.queued.iter().filter(|queued| queued.waiter.is_some());
        let releases = awaited.filter_map(|queued| self.release(queued));
        answers.chain(releases.filter(|&release| release > now)).min()
    }

    /// Time has passed. Returns who waited in vain; call it until it returns `None`.
    pub fn on_deadline(&mut self, now: Instant) -> Option<(W, Failure)> {
        self.graves.retain(|grave| grave.until > now);
        loop {
            let index = self.in_flight.iter().position(|entry| !entry.again && entry.deadline <= now)?;
            if let Some(entry) = self.in_flight.get_mut(index)
                && entry.sent < entry.call.attempts
                && !entry.waiter.is_gone()
            {
                entry.again = true;
                continue;
            }
            let entry = self.in_flight.remove(index)?;
            self.bury(now, entry.call.key, entry.call.command, entry.sent, true);
            if entry.waiter.is_gone() {
                continue;
            }
            self.timeouts += 1;
            let after = now.saturating_duration_since(entry.first_sent);
            return Some((entry.waiter, Failure::Timeout { after, attempts: entry.sent }));
        }
    }

    /// The port is gone: nothing is in flight any more and nothing will be sent. Returns who waited.
    pub fn on_disconnect(&mut self) -> Vec<W> {
        let waiting = self.dismiss();
        self.queued.clear();
        waiting
    }

    /// Gives up all requests, but not the commands that nobody waits for. Returns who waited.
    pub fn dismiss(&mut self) -> Vec<W> {
        self.graves.clear();
        let mut waiting: Vec<W> = self.in_flight.drain(..).map(|entry| entry.waiter).collect();
        for queued in std::mem::take(&mut self.queued) {
            match queued.waiter {
                Some(waiter) => waiting.push(waiter),
                None => self.queued.push_back(queued),
            }
        }
        waiting
    }
}

#[cfg(test)]
#[path = "session_tests.rs"]
mod tests;
