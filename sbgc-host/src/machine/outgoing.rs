//! What goes out to the board, and when something is to be done.

use std::time::Duration;

use sbgc_proto::{CommandId, Direction, Expected};

use super::call::{Call, Priority, Waiter};
use super::outbox::{Batch, Kind};
use super::registrations::StreamChange;
use super::session::Outgoing;
use super::setup::LinkState;
use super::shown::Shown;
use super::{Machine, Who};

/// While the board hangs, so many bytes of its input buffer are kept for what is urgent,
const KEPT_FOR_URGENT: usize = 32;

/// and so many for that and for set-points.
const KEPT_FOR_MOTION: usize = 64;

impl<W: Waiter> Machine<W> {
    /// Does what is to be done at this time.
    fn advance(&mut self, now: Duration) {
        while let Some(expired) = self.session.on_deadline(now) {
            if self.batch.withdraw(expired.number) {
                self.session.withdrawn(expired.number);
            }
            if let Some(waiter) = expired.waiter {
                self.settle(now, waiter, Err(expired.failure));
            }
        }
        if self.decoder.pending() > 0 && now >= self.last_read.saturating_add(self.setup.gap) {
            self.end_candidates(now);
        }
        if self.state != LinkState::Open {
            return;
        }
        self.registrations.check(now, self.session.latency());
        while let Some(StreamChange { number, payload, stop, overtakes }) =
            self.registrations.next_request(now)
        {
            if overtakes {
                // Else it would be repeated after what takes it back.
                let is_start =
                    |who: &Who<W>| matches!(who, Who::Stream { number: of, stop: false } if *of == number);
                let begun = self.session.give_up(now, is_start);
                if let Some(start) = begun.filter(|start| self.batch.withdraw(*start)) {
                    self.session.withdrawn(start);
                }
            }
            let command = CommandId::DataStreamInterval.raw();
            let (timeout, attempts) = (self.setup.timeout, self.setup.attempts.max(1));
            // Confirmations of two of them have the same bytes, so each waits for the other. What takes a start back
            // follows that at once, and at the end there is no time to wait.
            let hurried = overtakes || (stop && self.is_ending());
            let priority = if hurried { Priority::Ordered } else { Priority::Serial };
            // Asking twice for a stream updates it, so this may be repeated.
            let call = Call {
                command,
                payload,
                expected: Expected::confirmation(CommandId::DataStreamInterval),
                shape: None,
                timeout,
                attempts,
                priority,
                probe: None,
            };
            self.session.request(now, call, Who::Stream { number, stop });
        }
    }

    /// Does what is to be done at this time, and returns the bytes that may go out now.
    ///
    /// They may be others the next time: what the port has not taken is put together anew, so that it is the newest.
    pub fn pending(&mut self, now: Duration) -> &[u8] {
        self.advance(now);
        // The rest of a batch that the port had begun with may have been taken back.
        if let Some(length) = self.batch.finish() {
            self.pacer.end(now, length);
        }
        self.held_up = false;
        if now >= self.pacer.not_before() {
            let begins = self.batch.is_empty();
            self.fill(now);
            if begins && !self.batch.is_empty() {
                self.pacer.begin(now);
            }
        }
        self.batch.pending()
    }

    fn fill(&mut self, now: Duration) {
        let (version, in_use) = (self.version, self.load.in_use(now));
        loop {
            let room =
                |batch: &Batch, kept: usize| batch.room(version, if in_use > 0 { in_use + kept } else { 0 });
            let (outgoing, kind) = if let Some(urgent) =
                room(&self.batch, 0).and_then(|room| self.session.next_urgent(now, room))
            {
                (urgent, Kind::Urgent)
            } else if let Some((command, payload)) =
                room(&self.batch, KEPT_FOR_URGENT).and_then(|room| self.setpoints.take(room))
            {
                let number = self.session.sent_unawaited(now, command);
                (Outgoing { number, command, payload, version: None }, Kind::Setpoint(command))
            } else if let Some(outgoing) =
                room(&self.batch, KEPT_FOR_MOTION).and_then(|room| self.session.next_to_send(now, room))
            {
                (outgoing, Kind::Other)
            } else {
                self.held_up = in_use > 0;
                break;
            };
            let Outgoing { number, command, payload, version: other } = outgoing;
            let version = other.unwrap_or(version);
            match self.batch.add(version, number, (command, &payload), kind) {
                Ok(()) => {
                    tracing::debug!("sent {}", Shown(Direction::Outgoing, version, command, &payload));
                    self.counters.sent_frames += 1;
                }
                // The handle has checked both id and length.
                Err(error) => tracing::error!(%error, command, "a frame cannot be sent"),
            }
        }
    }

    /// The port took so many of the [`pending`](Self::pending) bytes.
    pub fn written(&mut self, now: Duration, count: usize) {
        self.counters.sent_bytes += count as u64;
        self.batch.take(count);
        while let Some((number, length)) = self.batch.next_written() {
            let answers = self.session.written(now, number);
            self.load.written(now, number, length, answers, !self.registrations.is_empty());
        }
        if let Some(length) = self.batch.finish() {
            self.pacer.end(now, length);
        }
    }

    /// When something is to be done even if nothing happens; to be asked after [`pending`](Self::pending).
    pub fn next_wake(&self, now: Duration) -> Option<Duration> {
        if self.is_over() {
            return None;
        }
        let gap = (self.decoder.pending() > 0).then(|| self.last_read.saturating_add(self.setup.gap));
        let wants = self.batch.is_empty() && (self.session.wants_to_send(now) || !self.setpoints.is_empty());
        let room = self.load.next_release(now).filter(|_| self.held_up);
        let send = wants.then(|| self.pacer.not_before().max(room.unwrap_or_default()));
        let streams = (self.state == LinkState::Open)
            .then(|| self.registrations.next_wake(now, self.session.latency()))
            .flatten();
        [self.session.next_deadline(now), gap, send, streams, self.ending].into_iter().flatten().min()
    }
}
