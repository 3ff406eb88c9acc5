//! The life of the link: its end, its loss, and that the same board is found again.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::Expected;

use super::call::{Call, Failure, Priority, Waiter};
use super::load::Load;
use super::pacer::Pacer;
use super::queue::Interruption;
use super::setup::{Identity, LinkState, Trouble};
use super::{Machine, Who, tell};

/// How long what is left to be sent may take when the link ends, at least.
const FLUSH: Duration = Duration::from_secs(1);

/// The same at most, on a link with much latency.
const LONGEST_FLUSH: Duration = Duration::from_secs(5);

impl<W: Waiter> Machine<W> {
    /// Ends the link: nothing new is taken and nobody waits any more; what was to be sent is sent, streams are
    /// unregistered. [`is_done`](Self::is_done) tells when.
    pub fn close(&mut self, now: Duration) {
        if self.is_over() || self.ending.is_some() {
            return;
        }
        let flush = self.session.known_latency().saturating_mul(4).clamp(FLUSH, LONGEST_FLUSH);
        self.ending = Some(now.saturating_add(flush));
        for waiting in self.session.dismiss() {
            self.settle(now, waiting, Err(Failure::Closed));
        }
        let waiting = self.registrations.clear();
        tell(waiting.into_iter().map(|waiter| (waiter, Err(Failure::Closed))).collect());
    }

    /// Whether the link was closed and nothing is left to be done on the port.
    pub fn is_done(&self, now: Duration) -> bool {
        let idle = self.batch.is_empty()
            && self.session.queued() == 0
            && self.setpoints.is_empty()
            && self.registrations.is_empty()
            && !self.session.is_waiting();
        self.ending.is_some_and(|until| idle || now >= until || self.state == LinkState::Reconnecting)
    }

    /// Whether the link was closed from this side.
    pub const fn is_ending(&self) -> bool {
        self.ending.is_some()
    }

    pub(super) const fn is_over(&self) -> bool {
        !matches!(self.state, LinkState::Open | LinkState::Reconnecting)
    }

    /// Keeps who the board is, so that the link can go on with the same one after it was lost.
    pub fn set_identity(&mut self, identity: Identity) {
        self.identity = Some(identity);
    }

    /// Whether the link can go on after the port was lost.
    pub fn can_go_on(&self) -> bool {
        self.identity.is_some() && self.ending.is_none() && self.trouble != Some(Trouble::Replaced)
    }

    /// The port is gone, and is going to be opened again. What came before that still counts.
    pub fn down(&mut self, now: Duration) {
        self.end_candidates(now);
        if self.is_over() {
            return;
        }
        self.state = LinkState::Reconnecting;
        self.trouble = None;
        self.release(&Failure::Disconnected);
        self.registrations.on_interruption(now, Interruption::Lost);
    }

    /// The port is open again. Nothing goes on before the board has told who it is.
    pub fn up(&mut self, now: Duration) {
        self.pacer = Pacer::new(self.setup.baud, now);
        self.load = Load::new(self.setup.baud);
        let Some(Identity { command, .. }) = self.identity else { return };
        let (timeout, attempts) = (self.setup.timeout, self.setup.attempts);
        let (expected, priority) = (Expected::any(command.into()), Priority::Normal);
        let payload = Bytes::new();
        let call = Call { command, payload, expected, shape: None, timeout, attempts, priority, probe: None };
        self.session.request(now, call, Who::Identity);
    }

    /// Why the port is to be given back, if it is.
    pub const fn trouble(&self) -> Option<Trouble> {
        self.trouble
    }

    pub(super) fn identified(&mut self, now: Duration, outcome: Result<Bytes, Failure>) {
        let front = self.identity.as_ref().map(|identity| identity.front.clone()).unwrap_or_default();
        self.trouble = match outcome {
            Ok(answer) if answer.starts_with(&front) => {
                self.state = LinkState::Open;
                self.registrations.on_interruption(now, Interruption::Lost);
                None
            }
            Ok(_) => Some(Trouble::Replaced),
            Err(_) => Some(Trouble::Silent),
        };
    }

    /// The port was given back after [`close`](Self::close).
    pub fn closed_port(&mut self) {
        self.end(LinkState::Closed, &Failure::Closed);
    }

    /// The port is gone. What came before that still counts.
    pub fn lost(&mut self, now: Duration) {
        self.end_candidates(now);
        let replaced = self.trouble == Some(Trouble::Replaced);
        let state = if replaced { LinkState::Replaced } else { LinkState::Lost };
        self.end(state, &Failure::Disconnected);
    }

    fn end(&mut self, state: LinkState, failure: &Failure) {
        if self.is_over() {
            return;
        }
        // Before anybody learns that an answer will not come.
        self.state = state;
        self.release(failure);
        let waiting = self.registrations.on_lost();
        tell(waiting.into_iter().map(|waiter| (waiter, Err(failure.clone()))).collect());
        self.listeners.drain(..).for_each(|listener| listener.queue.end());
    }

    /// Nothing is on its way any more.
    fn release(&mut self, failure: &Failure) {
        self.setpoints.clear();
        self.batch.clear();
        for waiting in self.session.on_disconnect() {
            if let Who::Caller(waiter) | Who::Probe(waiter) = waiting {
                waiter.tell(Err(failure.clone()));
            }
        }
    }

    pub(super) fn check_open(&self) -> Result<(), Failure> {
        match self.state {
            LinkState::Open if self.ending.is_none() => Ok(()),
            LinkState::Open | LinkState::Closed => Err(Failure::Closed),
            _ => Err(Failure::Disconnected),
        }
    }
}
