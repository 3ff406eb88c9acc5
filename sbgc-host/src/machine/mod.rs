//! The driver without I/O: who waits for what, what goes out when, and which streams run.
//!
//! ```text
//!   receive(now, bytes) ──► frames ──► session ──► whoever asked       session        who waits for what until when
//!                              └─────► queues ───► subscribers         registrations  streams wanted and running
//!   request, send, set, ... ─► session, set-points, registrations      outbox         set-points, and the batch that
//!   pending(now), written ◄─── batch ◄── pacer                                        the port is taking
//!   next_wake(now) ◄────────── deadlines                               pacer, load    how much the board can take
//! ```
//!
//! [`Machine`] does no input or output and looks at no clock. Time is given to it, counted from any start; going back
//! does nothing good. Whoever drives it gives it the bytes that come, writes those that it wants to send, and calls it
//! again when it says. All rules of the driver live here, so that each can be tested call by call.
//!
//! ```
//! use std::time::Duration;
//!
//! use bytes::Bytes;
//! use sbgc_host::machine::{Failure, Machine, Setup, Waiter};
//!
//! struct Nobody;
//!
//! impl Waiter for Nobody {
//!     fn is_gone(&self) -> bool {
//!         true
//!     }
//!     fn tell(self, _: Result<Bytes, Failure>) {}
//! }
//!
//! let mut machine = Machine::<Nobody>::new(Setup::default());
//! let now = Duration::ZERO;
//! machine.set(now, 67, Bytes::from_static(&[0; 15])).unwrap();
//! assert_eq!(machine.pending(now).len(), 21);
//! machine.written(now, 21);
//! // The board reads its input each 8 ms.
//! machine.set(now, 67, Bytes::from_static(&[0; 15])).unwrap();
//! assert!(machine.pending(now).is_empty());
//! assert_eq!(machine.next_wake(now), Some(Duration::from_millis(8)));
//! ```

mod call;
mod counters;
mod load;
mod outbox;
mod pacer;
mod queue;
mod registrations;
mod samples;
mod session;

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::frame::{Decoder, Event, Frame, Version, Versions};
use sbgc_proto::{CommandId, Direction, Expected};

pub use call::{Call, Failure, Priority, Waiter};
pub use counters::LinkCounters;
pub use queue::{Interruption, Payload, Queue, Sample};
pub use registrations::{MAX_STREAMS, StreamCall};
pub use samples::Shape;

use load::Load;
use outbox::{Batch, Kind, Setpoints};
use pacer::Pacer;
use registrations::{Registrations, StreamChange, Told};
use session::{Session, Verdict};

/// How many commands that nobody waits for may wait to be sent.
pub const HIGH_WATER: usize = 32;

/// How long what is left to be sent may take when the link ends, at least.
const FLUSH: Duration = Duration::from_secs(1);

/// The same at most, on a link with much latency.
const LONGEST_FLUSH: Duration = Duration::from_secs(5);

/// While the board hangs, so many bytes of its input buffer are kept for what is urgent,
const KEPT_FOR_URGENT: usize = 32;

/// and so many for that and for set-points.
const KEPT_FOR_MOTION: usize = 64;

/// Whether the port is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LinkState {
    /// It is.
    Open,
    /// It went away or fell silent, and is being opened again. Requests fail at once meanwhile.
    Reconnecting,
    /// It went away for good.
    Lost,
    /// After it was opened again, another board answered than before. It is left alone.
    Replaced,
    /// It was closed from this side.
    Closed,
}

/// How a machine is set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setup {
    /// The version in which frames go out at first.
    pub version: Version,
    /// Bits per second of the serial line; `None` where that is unknown or there is none.
    pub baud: Option<u32>,
    /// How long the bytes of one frame may stop coming before it is given up.
    pub gap: Duration,
    /// How long an attempt to register a stream may take.
    pub timeout: Duration,
    /// How often a stream is registered before that has failed.
    pub attempts: u32,
}

impl Default for Setup {
    fn default() -> Self {
        let (gap, timeout) = (Duration::from_millis(100), Duration::from_millis(500));
        Self { version: Version::V2, baud: None, gap, timeout, attempts: 3 }
    }
}

/// What tells one board from another: the front of the answer to a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The request, which has no payload and is answered under its own id.
    pub command: u8,
    /// The front of the answer; empty for a board that has no identity.
    pub front: Bytes,
}

/// Why the port has to be closed and opened again, or left alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// The board does not answer.
    Silent,
    /// Another board answers.
    Replaced,
}

/// Who waits for an answer.
#[derive(Debug)]
enum Who<W> {
    Caller(W),
    /// Like a caller; the version of the answer is kept.
    Probe(W),
    /// The machine itself, after the port was opened again.
    Identity,
    /// A registration; whether it is to end.
    Stream {
        number: u64,
        stop: bool,
    },
}

impl<W: Waiter> Who<W> {
    fn is_gone(&self) -> bool {
        match self {
            Who::Caller(waiter) | Who::Probe(waiter) => waiter.is_gone(),
            Who::Stream { .. } | Who::Identity => false,
        }
    }
}

/// Who gets frames as they come.
#[derive(Debug)]
struct Listener {
    number: u64,
    queue: Arc<Queue>,
    /// The frames to hear; `None` for those that nobody asked for.
    command: Option<u8>,
}

/// The driver. `W` is who waits for an answer.
#[derive(Debug)]
pub struct Machine<W> {
    setup: Setup,
    state: LinkState,
    version: Version,
    decoder: Decoder,
    last_read: Duration,
    session: Session<Who<W>>,
    registrations: Registrations<W>,
    setpoints: Setpoints,
    batch: Batch,
    pacer: Pacer,
    load: Load,
    /// Whether something waits until the board has room for it.
    held_up: bool,
    listeners: Vec<Listener>,
    next_listener: u64,
    counters: LinkCounters,
    /// Until when the rest may be sent, once the link is to end.
    ending: Option<Duration>,
    identity: Option<Identity>,
    trouble: Option<Trouble>,
}

impl<W: Waiter> Machine<W> {
    /// A machine on an open port.
    pub fn new(setup: Setup) -> Self {
        Self {
            state: LinkState::Open,
            version: setup.version,
            decoder: Decoder::new(Versions::Both),
            last_read: Duration::ZERO,
            session: Session::new(Who::is_gone),
            registrations: Registrations::default(),
            setpoints: Setpoints::default(),
            batch: Batch::default(),
            pacer: Pacer::new(setup.baud, Duration::ZERO),
            load: Load::new(setup.baud),
            held_up: false,
            listeners: Vec::new(),
            next_listener: 0,
            counters: LinkCounters::default(),
            ending: None,
            identity: None,
            trouble: None,
            setup,
        }
    }

    /// Whether the port is there.
    pub const fn state(&self) -> LinkState {
        self.state
    }

    /// The version in which frames go out.
    pub const fn version(&self) -> Version {
        self.version
    }

    /// Sends frames in this version from now on.
    pub const fn set_version(&mut self, version: Version) {
        self.version = version;
    }

    /// What passed the link so far.
    pub fn counters(&self) -> LinkCounters {
        LinkCounters {
            received: self.decoder.counters(),
            timeouts: self.session.timeouts(),
            repeats: self.session.repeats(),
            ..self.counters
        }
    }

    /// Whether a command may be handed over for which nobody waits, or enough of them wait already.
    pub fn has_room(&self) -> bool {
        self.session.queued_unawaited() < HIGH_WATER
    }

    /// Sends a request and tells `waiter` the outcome.
    pub fn request(&mut self, now: Duration, mut call: Call, waiter: W) {
        match self.check_open() {
            Ok(()) => {
                call.shape = Shape::of_request(call.command, &call.payload)
                    .filter(|shape| self.registrations.has(shape.command));
                if call.shape.is_some_and(|shape| self.registrations.is_confusing(&shape)) {
                    waiter.tell(Err(Failure::Indistinct));
                    return;
                }
                let who = if call.probe.is_some() { Who::Probe(waiter) } else { Who::Caller(waiter) };
                self.session.request(now, call, who);
            }
            Err(failure) => waiter.tell(Err(failure)),
        }
    }

    /// Sends a command without waiting for an answer, after those that were to be sent before it.
    ///
    /// # Errors
    /// If the link has ended.
    pub fn send(&mut self, now: Duration, command: u8, payload: Bytes) -> Result<(), Failure> {
        self.check_open()?;
        self.session.send(now, command, payload, Priority::Normal);
        Ok(())
    }

    /// Sends a command before everything else that waits. A set-point of the same command is not sent any more.
    ///
    /// # Errors
    /// If the link has ended.
    pub fn send_now(&mut self, now: Duration, command: u8, payload: Bytes) -> Result<(), Failure> {
        self.check_open()?;
        self.withdraw_setpoint(command);
        self.session.send(now, command, payload, Priority::Urgent);
        Ok(())
    }

    /// Sends a set-point in place of an older one of the same command that the port has not yet taken.
    ///
    /// # Errors
    /// If the link has ended.
    pub fn set(&mut self, _now: Duration, command: u8, payload: Bytes) -> Result<(), Failure> {
        self.check_open()?;
        self.withdraw_setpoint(command);
        self.setpoints.put(command, payload);
        Ok(())
    }

    fn withdraw_setpoint(&mut self, command: u8) {
        let mut superseded = self.setpoints.remove(command);
        if let Some(number) = self.batch.withdraw_setpoint(command) {
            self.session.withdrawn(number);
            superseded = true;
        }
        self.counters.superseded += u64::from(superseded);
    }

    /// Has frames with this id put into the queue that is returned; without an id those that are neither the answer to a
    /// request nor a sample.
    pub fn listen(&mut self, command: Option<u8>, capacity: usize) -> (u64, Arc<Queue>) {
        let (number, queue) = self.queue(capacity);
        if self.is_over() {
            queue.end();
        } else {
            self.listeners.push(Listener { number, queue: Arc::clone(&queue), command });
        }
        (number, queue)
    }

    /// Has the board send a stream into the queue that is returned, and tells `waiter` when that is confirmed.
    pub fn subscribe(&mut self, call: StreamCall, waiter: W) -> (u64, Arc<Queue>) {
        let (number, queue) = self.queue(call.capacity);
        match self.check_open() {
            Ok(()) => tell(self.registrations.add(call, number, Arc::clone(&queue), waiter)),
            Err(failure) => {
                queue.end();
                waiter.tell(Err(failure));
            }
        }
        (number, queue)
    }

    fn queue(&mut self, capacity: usize) -> (u64, Arc<Queue>) {
        let number = self.next_listener;
        self.next_listener = number.wrapping_add(1);
        (number, Arc::new(Queue::new(capacity)))
    }

    /// The listener or subscriber with this number has left.
    pub fn leave(&mut self, number: u64) {
        self.listeners.retain(|listener| listener.number != number);
        self.registrations.leave(number);
    }

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

    const fn is_over(&self) -> bool {
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

    fn identified(&mut self, now: Duration, outcome: Result<Bytes, Failure>) {
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

    fn check_open(&self) -> Result<(), Failure> {
        match self.state {
            LinkState::Open if self.ending.is_none() => Ok(()),
            LinkState::Open | LinkState::Closed => Err(Failure::Closed),
            _ => Err(Failure::Disconnected),
        }
    }

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
    fn end_candidates(&mut self, now: Duration) {
        while self.decoder.skip_candidate().is_some() {
            self.decode(now, &[]);
        }
    }

    fn on_frame(&mut self, now: Duration, frame: Frame<'_>) {
        tracing::debug!("received {}", Shown(Direction::Incoming, frame.version, frame.id, frame.payload));
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

    fn settle(&mut self, now: Duration, waiting: Who<W>, outcome: Result<Bytes, Failure>) {
        match waiting {
            Who::Caller(waiter) | Who::Probe(waiter) => waiter.tell(outcome),
            Who::Identity => self.identified(now, outcome),
            Who::Stream { number, stop } => {
                tell(self.registrations.settle(now, number, stop, outcome.map(drop)));
            }
        }
    }

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
                (session::Outgoing { number, command, payload, version: None }, Kind::Setpoint(command))
            } else if let Some(outgoing) =
                room(&self.batch, KEPT_FOR_MOTION).and_then(|room| self.session.next_to_send(now, room))
            {
                (outgoing, Kind::Other)
            } else {
                self.held_up = in_use > 0;
                break;
            };
            let session::Outgoing { number, command, payload, version: other } = outgoing;
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

fn tell<W: Waiter>(told: Told<W>) {
    for (waiter, outcome) in told {
        waiter.tell(outcome);
    }
}

/// A frame as the log shows it: its name, and its payload in hex.
struct Shown<'a>(Direction, Version, u8, &'a [u8]);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(direction, version, id, payload) = *self;
        let name = CommandId::from_raw(id).spec_name(direction).unwrap_or("unknown command");
        let bytes = if payload.len() == 1 { "byte" } else { "bytes" };
        write!(f, "{name} ({id}), version {}, {} {bytes}", version.number(), payload.len())?;
        if !payload.is_empty() {
            f.write_str(": ")?;
        }
        payload.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_shown_with_name_and_payload() {
        let shown = |direction, id, payload: &[u8]| Shown(direction, Version::V2, id, payload).to_string();
        assert_eq!(shown(Direction::Outgoing, 86, &[]), "CMD_BOARD_INFO (86), version 2, 0 bytes");
        assert_eq!(
            shown(Direction::Incoming, 67, &[0x5D, 0xFF]),
            "CMD_CONFIRM (67), version 2, 2 bytes: 5dff"
        );
        assert_eq!(shown(Direction::Incoming, 200, &[1]), "unknown command (200), version 2, 1 byte: 01");
    }
}
