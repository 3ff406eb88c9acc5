//! What comes from the board, and to whom it goes.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::frame::{Event, Frame, Version};
use sbgc_proto::{CommandId, Direction};

use super::call::{Failure, Waiter};
use super::session::Verdict;
use super::shown::Shown;
use super::{Listener, Machine, Who, tell};

impl<W: Waiter> Machine<W> {
    /// Bytes came.
    pub fn receive(&mut self, now: Duration, bytes: &[u8]) {
        self.last_read = now;
        self.decode(now, bytes);
    }

    fn decode(&mut self, now: Duration, mut bytes: &[u8]) {
        // The decoder lends its frames, so it is taken out while they are handed on.
        let mut decoder = std::mem::take(&mut self.decoder);
        while let Some(event) = decoder.next(&mut bytes) {
            match event {
                Event::Frame { frame, .. } => self.on_frame(now, frame),
                Event::Skipped(skipped) => {
                    tracing::debug!("skipped {} bytes: {}", skipped.length, skipped.cause);
                }
            }
        }
        self.decoder = decoder;
    }

    /// Gives up all frames whose bytes have stopped coming.
    pub(super) fn end_candidates(&mut self, now: Duration) {
        while self.decoder.skip_candidate().is_some() {
            self.decode(now, &[]);
        }
    }

    fn on_frame(&mut self, now: Duration, frame: Frame<'_>) {
        tracing::debug!("received {}", Shown(Direction::Incoming, frame.version, frame.id, frame.payload));
        self.heard_version_2 |= frame.version == Version::V2;
        if frame.id == CommandId::Reset.raw() {
            tracing::warn!("the board is being reset");
            self.registrations.on_reset(now);
        }
        let verdict = self.session.on_frame(now, frame.id, frame.payload);
        if let Some(number) = self.session.take_answered() {
            self.load.answered(now, number, !self.registrations.is_empty());
        }
        // Subscribers get it, too, whether or not it is an answer, and before the one who waits for that goes on.
        let taken = self.publish(now, frame, &verdict);
        match verdict {
            Verdict::Answer(waiting, outcome) => {
                if matches!(waiting, Who::Probe(_)) {
                    self.version = frame.version;
                }
                self.settle(now, waiting, outcome);
            }
            Verdict::Late => self.counters.late += 1,
            Verdict::Unsolicited => self.counters.unsolicited += u64::from(!taken),
            Verdict::Unawaited => {}
        }
    }

    /// Hands a frame to all who listen. Returns whether there was anybody.
    fn publish(&mut self, now: Duration, frame: Frame<'_>, verdict: &Verdict<Who<W>>) -> bool {
        let Frame { id: command, payload, .. } = frame;
        let answers = !matches!(verdict, Verdict::Unsolicited);
        let sampled = self.registrations.on_frame(now, command, payload, answers);
        let stray = sampled.is_none() && matches!(verdict, Verdict::Unsolicited | Verdict::Unawaited);
        let hears = |listener: &&Listener| listener.command.map_or(stray, |wanted| wanted == command);
        let mut lost = sampled.unwrap_or_default();
        let mut taken = sampled.is_some();
        for listener in self.listeners.iter().filter(hears) {
            taken = true;
            lost += u64::from(listener.queue.push(command, payload));
        }
        self.counters.lost_samples += lost;
        taken
    }

    pub(super) fn settle(&mut self, now: Duration, waiting: Who<W>, outcome: Result<Bytes, Failure>) {
        match waiting {
            Who::Caller(waiter) | Who::Probe(waiter) => waiter.tell(outcome),
            Who::Identity => self.identified(now, outcome),
            Who::Stream { number, stop } => {
                tell(self.registrations.settle(now, number, stop, outcome.map(drop)));
            }
        }
    }
}
