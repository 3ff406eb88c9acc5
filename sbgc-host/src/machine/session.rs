//! Who waits for what, until when: the one table of requests in flight.
//!
//! # Rules
//! - A request ends by its deadline, which counts from the call: however long it waits for its turn or for the port.
//! - A frame belongs to the oldest command on its way whose answer it can be. Two requests that one frame could
//!   answer are not on their way together: the second waits for the first. Others overtake it.
//! - Only requests that were given several attempts are sent again. Whoever makes a request decides that.
//! - A request that ended without its answer leaves a tombstone. For a grace period, which follows the latency of the
//!   link, the tombstone takes the late answer, and holds back requests that the late answer could be taken for.
//! - [`Urgent`](Priority::Urgent) commands are held back by nothing. Answers that nothing distinguishes are counted
//!   off in the order in which their commands were sent.
//!
//! Two commands whose answers have the same bytes, such as two confirmations of one command, can be told apart only by
//! that order and by the grace period. If an answer is lost and another takes more than twice the latency measured so
//! far, the one can be taken for the other.

mod entry;
mod sending;

use std::collections::VecDeque;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::{CommandId, Expected};

use super::call::{Call, Failure, Priority};
pub(super) use entry::{Expired, Outgoing, Verdict};
use entry::{Queued, Sent};

/// How long an answer may be late, at least.
pub(super) const GRACE: Duration = Duration::from_millis(250);

/// How long answers may take as long as none has come.
const UNKNOWN_LATENCY: Duration = Duration::from_millis(500);

/// How long an answer may be late, at most.
const LONGEST_GRACE: Duration = Duration::from_secs(10);

/// The table. `W` is who waits.
#[derive(Debug)]
pub(super) struct Session<W> {
    queued: VecDeque<Queued<W>>,
    sent: VecDeque<Sent<W>>,
    next_number: u64,
    /// The longest time that answers took of late; `None` before the first.
    latency: Option<Duration>,
    timeouts: u64,
    repeats: u64,
    /// The command that was answered last.
    answered: Option<u64>,
    is_gone: fn(&W) -> bool,
}

impl<W> Session<W> {
    /// An empty table. `is_gone` reports whether nobody waits any more.
    pub(super) fn new(is_gone: fn(&W) -> bool) -> Self {
        Self {
            queued: VecDeque::new(),
            sent: VecDeque::new(),
            next_number: 0,
            latency: None,
            timeouts: 0,
            repeats: 0,
            answered: None,
            is_gone,
        }
    }

    /// How many requests and commands wait to be sent.
    pub(super) fn queued(&self) -> usize {
        self.queued.len()
    }

    /// How many commands wait to be sent that nobody waits for.
    pub(super) fn queued_unawaited(&self) -> usize {
        self.queued.iter().filter(|queued| queued.waiter.is_none()).count()
    }

    /// Whether somebody waits for an answer.
    pub(super) fn is_waiting(&self) -> bool {
        self.sent.iter().any(|entry| entry.waiter.is_some())
            || self.queued.iter().any(|queued| queued.waiter.is_some())
    }

    /// Whether there is something to send.
    pub(super) fn wants_to_send(&self, now: Duration) -> bool {
        self.sent.iter().any(|entry| entry.again) || self.eligible(now).is_some()
    }

    /// How many requests ended without an answer.
    pub(super) const fn timeouts(&self) -> u64 {
        self.timeouts
    }

    /// How often commands were sent again.
    pub(super) const fn repeats(&self) -> u64 {
        self.repeats
    }

    /// The longest time that answers took of late.
    pub(super) fn latency(&self) -> Duration {
        self.latency.unwrap_or(UNKNOWN_LATENCY)
    }

    /// The same; zero before the first answer.
    pub(super) fn known_latency(&self) -> Duration {
        self.latency.unwrap_or_default()
    }

    /// Takes a request.
    pub(super) fn request(&mut self, now: Duration, call: Call, waiter: W) {
        let deadline = now.saturating_add(call.allowed());
        let number = self.number();
        self.queued.push_back(Queued { number, call, waiter: Some(waiter), called: now, deadline });
    }

    /// Takes a command whose answer, if there is one, nobody waits for.
    pub(super) fn send(&mut self, now: Duration, command: u8, payload: Bytes, priority: Priority) {
        let number = self.number();
        let call = unawaited(command, payload, priority);
        self.queued.push_back(Queued { number, call, waiter: None, called: now, deadline: Duration::MAX });
    }

    /// A command is sent past this table: its confirmation must not be taken for that of another. Returns its number.
    pub(super) fn sent_unawaited(&mut self, now: Duration, command: u8) -> u64 {
        let number = self.number();
        let call = unawaited(command, Bytes::new(), Priority::Normal);
        self.hand_out(now, Queued { number, call, waiter: None, called: now, deadline: Duration::MAX });
        number
    }

    fn number(&mut self) -> u64 {
        self.next_number = self.next_number.wrapping_add(1);
        self.next_number
    }

    /// The number of the command that the last frame has answered, told once.
    pub(super) fn take_answered(&mut self) -> Option<u64> {
        self.answered.take()
    }

    /// A frame came.
    pub(super) fn on_frame(&mut self, now: Duration, id: u8, payload: &[u8]) -> Verdict<W> {
        if id == CommandId::Error.raw() {
            return self.on_error(now, payload);
        }
        let answered = self
            .sent
            .iter()
            .position(|entry| entry.expects(now) && entry.call.is_answered_by(id.into(), payload));
        match answered {
            Some(index) => self.answer(now, self.repeated(index), Ok(payload)),
            None => Verdict::Unsolicited,
        }
    }

    /// Where a request stands that repeats this one, if this one has ended without its answer. What does no harm when it
    /// is repeated is as good answered late, unless something else was asked in between.
    fn repeated(&self, index: usize) -> usize {
        let Some(ended) = self.sent.get(index).filter(|entry| entry.waiter.is_none() && entry.awaited) else {
            return index;
        };
        if ended.call.priority != Priority::Serial {
            return index;
        }
        let later = self.sent.iter().enumerate().skip(index + 1);
        let mut related = later.filter(|(_, entry)| entry.call.expected.overlaps(&ended.call.expected));
        let same = |entry: &Sent<W>| {
            (entry.call.command, &entry.call.payload) == (ended.call.command, &ended.call.payload)
        };
        let found = related.find(|(_, entry)| !same(entry) || entry.waiter.is_some());
        found.filter(|(_, entry)| same(entry) && entry.written).map_or(index, |(repeat, _)| repeat)
    }

    /// The board rejected something: the command that it names or, in the form without a name, the oldest.
    fn on_error(&mut self, now: Duration, payload: &[u8]) -> Verdict<W> {
        let (command, code, data) = match payload {
            [] => return Verdict::Unsolicited,
            [code] | [code, _, _, _, _] => (None, *code, payload.get(1..)),
            [command, code, ..] => (Some(*command), *code, payload.get(2..)),
        };
        let mut candidates = self.sent.iter().enumerate().filter(|(_, entry)| entry.expects(now));
        // Without a name, it may be the answer to a command that nobody waits for, and then nobody is told.
        if command.is_none() && candidates.clone().any(|(_, entry)| !entry.awaited) {
            return Verdict::Unawaited;
        }
        let refused =
            candidates.find(|(_, entry)| command.is_none_or(|command| entry.call.command == command));
        match refused.map(|(index, _)| index) {
            Some(index) => {
                let data = Bytes::copy_from_slice(data.unwrap_or_default());
                self.answer(now, index, Err(Failure::Refused { code, data }))
            }
            None => Verdict::Unsolicited,
        }
    }

    fn answer(&mut self, now: Duration, index: usize, outcome: Result<&[u8], Failure>) -> Verdict<W> {
        let Some(entry) = self.sent.get(index) else { return Verdict::Unsolicited };
        self.answered = Some(entry.number);
        // Of a command that was sent twice nobody knows which of the two was answered, so it took this at most.
        let since = if entry.waiter.is_some() { entry.first_out } else { entry.handed_out };
        let took = now.saturating_sub(since);
        let latency = self.latency.unwrap_or(took);
        self.latency = Some(took.max(latency.saturating_sub(latency.saturating_sub(took) / 8)));
        let grace = self.grace();
        let Some(entry) = self.sent.get_mut(index) else { return Verdict::Unsolicited };
        entry.answers = entry.answers.saturating_sub(1);
        let awaited = entry.awaited;
        let waiter = entry.waiter.take();
        if waiter.is_some() {
            // A repeat that is not yet sent will not be.
            if entry.again {
                entry.again = false;
            }
            entry.until = now.saturating_add(GRACE).max(entry.handed_out.saturating_add(grace));
        }
        if entry.answers == 0 {
            self.sent.remove(index);
        }
        match waiter {
            Some(waiter) if !(self.is_gone)(&waiter) => {
                Verdict::Answer(waiter, outcome.map(Bytes::copy_from_slice))
            }
            _ if awaited => Verdict::Late,
            _ => Verdict::Unawaited,
        }
    }

    /// How long after it was sent a command may be answered.
    fn grace(&self) -> Duration {
        self.latency().saturating_mul(2).clamp(GRACE, LONGEST_GRACE)
    }

    /// When [`on_deadline`](Self::on_deadline) must be called, or [`next_to_send`](Self::next_to_send) may have
    /// something new.
    pub(super) fn next_deadline(&self, now: Duration) -> Option<Duration> {
        let waiting = self.sent.iter().filter(|entry| entry.waiter.is_some());
        let answers = waiting.map(|entry| if entry.again { entry.deadline } else { entry.until });
        let queued = self.queued.iter().filter(|queued| queued.waiter.is_some());
        let calls = queued.clone().map(|queued| queued.deadline);
        let releases = queued.filter_map(|queued| self.release(now, queued)).filter(|release| *release > now);
        answers.chain(calls).chain(releases).min().filter(|deadline| *deadline != Duration::MAX)
    }

    /// Time has passed. Returns a request that ended without its answer; call it until it returns `None`.
    pub(super) fn on_deadline(&mut self, now: Duration) -> Option<Expired<W>> {
        let is_gone = self.is_gone;
        let late = self.queued.iter().position(|queued| queued.waiter.is_some() && queued.deadline <= now);
        if let Some(queued) = late.and_then(|index| self.queued.remove(index)) {
            let after = now.saturating_sub(queued.called);
            let waiter = queued.waiter.filter(|waiter| !is_gone(waiter));
            self.timeouts += u64::from(waiter.is_some());
            return Some(Expired {
                number: queued.number,
                waiter,
                failure: Failure::Timeout { after, attempts: 0 },
            });
        }
        let grace = self.grace();
        for entry in &mut self.sent {
            let Some(waiter) = &entry.waiter else { continue };
            let gone = is_gone(waiter);
            let over = entry.deadline <= now || (!entry.again && entry.until <= now);
            // Whoever left need not wait, but then the frame should not go out either.
            let useless = gone && !entry.written;
            if !over && !useless {
                continue;
            }
            if !gone && entry.times < entry.call.times() && entry.deadline > now {
                entry.again = true;
                continue;
            }
            let waiter = entry.waiter.take().filter(|_| !gone);
            entry.again = false;
            entry.until = now.saturating_add(GRACE).max(entry.handed_out.saturating_add(grace));
            self.timeouts += u64::from(waiter.is_some());
            let after = now.saturating_sub(entry.called);
            let failure = Failure::Timeout { after, attempts: entry.times };
            return Some(Expired { number: entry.number, waiter, failure });
        }
        None
    }

    /// Gives up a request: it is not repeated, and not sent if that was still to come. Returns its number if it was
    /// handed out, for it may be on its way to the port.
    pub(super) fn give_up(&mut self, now: Duration, is_it: impl Fn(&W) -> bool) -> Option<u64> {
        self.queued.retain(|queued| !queued.waiter.as_ref().is_some_and(&is_it));
        let grace = self.grace();
        let entry = self.sent.iter_mut().find(|entry| entry.waiter.as_ref().is_some_and(&is_it))?;
        entry.waiter = None;
        entry.again = false;
        entry.until = now.saturating_add(GRACE).max(entry.handed_out.saturating_add(grace));
        Some(entry.number)
    }

    /// The port is gone: nothing is on its way any more and nothing will be sent. Returns who waited.
    pub(super) fn on_disconnect(&mut self) -> Vec<W> {
        let waiting = self.dismiss();
        self.queued.clear();
        self.sent.clear();
        waiting
    }

    /// Gives up all requests, but not the commands that nobody waits for. Returns who waited.
    pub(super) fn dismiss(&mut self) -> Vec<W> {
        let mut waiting: Vec<W> = self.sent.iter_mut().filter_map(|entry| entry.waiter.take()).collect();
        self.sent.iter_mut().for_each(|entry| entry.again = false);
        for queued in std::mem::take(&mut self.queued) {
            match queued.waiter {
                Some(waiter) => waiting.push(waiter),
                None => self.queued.push_back(queued),
            }
        }
        waiting
    }
}

fn unawaited(command: u8, payload: Bytes, priority: Priority) -> Call {
    let expected = Expected::confirmation(command.into());
    Call {
        command,
        payload,
        expected,
        shape: None,
        timeout: Duration::ZERO,
        attempts: 1,
        priority,
        probe: None,
    }
}

#[cfg(test)]
mod tests;
