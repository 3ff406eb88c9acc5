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
mod incoming;
mod life;
mod load;
mod outbox;
mod outgoing;
mod pacer;
mod queue;
mod registrations;
mod samples;
mod session;
mod setup;
mod shown;

use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::frame::{Decoder, Version, Versions};

pub use call::{Call, Failure, Priority, Waiter};
pub use counters::LinkCounters;
pub use queue::{Interruption, Payload, Queue, Sample};
pub use registrations::{MAX_STREAMS, StreamCall};
pub use samples::Shape;
pub use setup::{Identity, LinkState, Setup, Trouble};

use load::Load;
use outbox::{Batch, Setpoints};
use pacer::Pacer;
use registrations::{Registrations, Told};
use session::Session;

/// How many commands that nobody waits for may wait to be sent.
pub const HIGH_WATER: usize = 32;

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
    /// Whether a frame of version 2 has come, to whomever: such a board takes nothing else until it restarts.
    heard_version_2: bool,
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
            heard_version_2: false,
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

    /// Whether the board has sent anything in version 2.
    pub const fn has_heard_version_2(&self) -> bool {
        self.heard_version_2
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
}

fn tell<W: Waiter>(told: Told<W>) {
    for (waiter, outcome) in told {
        waiter.tell(outcome);
    }
}
