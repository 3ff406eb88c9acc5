//! Which frame goes out next, and what holds the others back.

use std::time::Duration;

use sbgc_proto::CommandId;

use super::entry::{Outgoing, Queued, Sent};
use super::{GRACE, Session};
use crate::machine::call::Priority;
use crate::machine::load::Answers;

impl<W> Session<W> {
    /// The next frame that overtakes everything. `None` if there is none, or if its payload is longer than `room`.
    pub(in crate::machine) fn next_urgent(&mut self, now: Duration, room: usize) -> Option<Outgoing> {
        let is_gone = self.is_gone;
        self.queued.retain(|queued| !queued.waiter.as_ref().is_some_and(is_gone));
        let index = self.queued.iter().position(|queued| queued.call.priority == Priority::Urgent)?;
        self.take(now, index, room)
    }

    /// The next frame that may be sent. `None` if there is none, if all must wait, or if its payload is longer than
    /// `room`.
    pub(in crate::machine) fn next_to_send(&mut self, now: Duration, room: usize) -> Option<Outgoing> {
        if let Some(entry) = self.sent.iter_mut().find(|entry| entry.again) {
            if entry.call.payload.len() > room {
                return None;
            }
            entry.again = false;
            entry.written = false;
            entry.times = entry.times.saturating_add(1);
            entry.answers = entry.answers.saturating_add(1);
            entry.handed_out = now;
            entry.until = now.saturating_add(entry.call.patience(entry.times)).min(entry.deadline);
            self.repeats += 1;
            let (command, payload) = (entry.call.command, entry.call.payload.clone());
            let version = entry.call.version(entry.times);
            return Some(Outgoing { number: entry.number, command, payload, version });
        }
        self.prune(now);
        let index = self.eligible(now)?;
        self.take(now, index, room)
    }

    fn take(&mut self, now: Duration, index: usize, room: usize) -> Option<Outgoing> {
        if self.queued.get(index)?.call.payload.len() > room {
            return None;
        }
        let queued = self.queued.remove(index)?;
        let (number, command, payload) = (queued.number, queued.call.command, queued.call.payload.clone());
        let version = queued.call.version(1);
        self.hand_out(now, queued);
        Some(Outgoing { number, command, payload, version })
    }

    pub(super) fn hand_out(&mut self, now: Duration, queued: Queued<W>) {
        let Queued { number, call, waiter, called, deadline } = queued;
        let until = match waiter {
            Some(_) => now.saturating_add(call.patience(1)).min(deadline),
            None => now.saturating_add(self.grace()),
        };
        self.sent.push_back(Sent {
            number,
            call,
            awaited: waiter.is_some(),
            waiter,
            called,
            deadline,
            until,
            handed_out: now,
            first_out: now,
            times: 1,
            answers: 1,
            again: false,
            written: false,
        });
    }

    /// The port has taken a frame. Returns how the board answers it.
    pub(in crate::machine) fn written(&mut self, now: Duration, number: u64) -> Answers {
        let grace = self.grace();
        let mut answers = Answers::Shortly;
        if let Some(entry) = self.sent.iter_mut().find(|entry| entry.number == number) {
            if entry.call.expected.answer() != CommandId::CONFIRM {
                answers = Answers::AtLength;
            }
            entry.written = true;
            if entry.times == 1 {
                entry.first_out = now;
            }
            entry.handed_out = now;
            entry.until = match entry.waiter {
                Some(_) => now.saturating_add(entry.call.patience(entry.times)).min(entry.deadline),
                None => now.saturating_add(grace),
            };
        }
        answers
    }

    /// A frame was taken back before the port took it.
    pub(in crate::machine) fn withdrawn(&mut self, number: u64) {
        if let Some(index) = self.sent.iter().position(|entry| entry.number == number)
            && let Some(entry) = self.sent.get_mut(index)
        {
            entry.answers = entry.answers.saturating_sub(1);
            if entry.answers == 0 && entry.waiter.is_none() {
                self.sent.remove(index);
            }
        }
    }

    fn prune(&mut self, now: Duration) {
        let is_gone = self.is_gone;
        self.queued.retain(|queued| !queued.waiter.as_ref().is_some_and(is_gone));
        self.sent.retain(|entry| entry.waiter.is_some() || !entry.written || now < entry.until);
    }

    /// Place in the queue of the next one that may be sent.
    pub(super) fn eligible(&self, now: Duration) -> Option<usize> {
        let urgent = self.queued.iter().position(|queued| queued.call.priority == Priority::Urgent);
        urgent.or_else(|| (0..self.queued.len()).find(|&index| self.may_go(now, index)))
    }

    fn may_go(&self, now: Duration, index: usize) -> bool {
        let Some(queued) = self.queued.get(index) else { return false };
        if queued.waiter.is_none() {
            return true;
        }
        let expected = &queued.call.expected;
        let first = !self.queued.iter().take(index).any(|earlier| earlier.call.expected.overlaps(expected));
        let awaited = |entry: &Sent<W>| entry.waiter.is_some() && entry.call.expected.overlaps(expected);
        let free = match queued.call.priority {
            Priority::Urgent | Priority::Ordered => true,
            Priority::Serial => !self.sent.iter().any(awaited),
            Priority::Normal => self.release(now, queued).is_none_or(|release| release <= now),
        };
        first && free
    }

    /// Until when commands on their way hold back a request; for ever as long as somebody waits for one of them.
    pub(super) fn release(&self, now: Duration, queued: &Queued<W>) -> Option<Duration> {
        let overlapping =
            self.sent.iter().filter(|entry| entry.call.expected.overlaps(&queued.call.expected));
        overlapping
            .map(|entry| match (&entry.waiter, entry.awaited) {
                (Some(_), _) => Duration::MAX,
                (None, _) if !entry.written => entry.until.max(now.saturating_add(GRACE)),
                (None, true) => entry.until,
                // Such commands may go on and on; those that waited make way for this one first.
                (None, false) => entry.until.min(queued.called.saturating_add(GRACE)),
            })
            .max()
    }
}
