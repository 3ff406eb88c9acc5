//! Data streams: messages that the board sends on its own, as [`Stream`]s.
//!
//! The board has ten registrations for all its ports together. Equal requests share one, and it is given back when
//! the last subscriber leaves. Each subscriber has a queue of its own that loses its oldest samples when it is full;
//! a slow one disturbs nobody.
//!
//! What a sample means is for its message to say; what keeps the registrations is in [`machine`](crate::machine).

mod kinds;
mod typed;

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use futures_core::Stream;
use sbgc_proto::CommandId;
use sbgc_proto::commands::StreamSource;
use tokio::sync::oneshot;

pub use crate::machine::{Interruption, Payload, Sample};
pub use kinds::{EventStream, Happening};
pub use typed::{Item, TypedStream};

use crate::error::Result;
use crate::gimbal::{Gimbal, explain};
use crate::machine::{Queue, Shape, StreamCall};

/// How many samples a queue holds for those who listen: more than a second of anything that a board sends.
const CAPACITY: usize = 2048;

/// How many samples a queue holds at least.
const MIN_CAPACITY: usize = 64;

/// How many samples a board sends in a second at the shortest interval.
const FASTEST: usize = 1250;

/// A message that the board is to send again and again.
///
/// ```
/// use sbgc_host::StreamRequest;
/// use sbgc_proto::CommandId;
///
/// let request = StreamRequest { config: [1, 0, 0, 0, 0, 0, 0, 0], ..StreamRequest::new(CommandId::AhrsHelper, 20) };
/// assert_eq!(request.interval_ms, 20);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StreamRequest {
    /// The message.
    pub command: CommandId,
    /// Time between two, in milliseconds. 1 is each cycle of the board, 0.8 ms; 0 counts as 1.
    pub interval_ms: u16,
    /// Whether `interval_ms` counts samples of the IMU attitude instead, with which the messages are then synchronized.
    /// Firmware 2.70+.
    pub synced: bool,
    /// What is to be sent, as the message has it: selection flags, the IMU, the event.
    pub config: [u8; 8],
    /// How many samples wait for a slow subscriber before the oldest is lost.
    pub capacity: usize,
}

impl StreamRequest {
    /// A message without configuration.
    ///
    /// The queue holds what comes in a second.
    pub const fn new(command: CommandId, interval_ms: u16) -> Self {
        let interval = if interval_ms == 0 { 1 } else { interval_ms as usize };
        let capacity = MIN_CAPACITY + FASTEST / interval;
        Self { command, interval_ms, synced: false, config: [0; 8], capacity }
    }

    /// What `source` describes, with its configuration.
    pub fn of(source: StreamSource, interval_ms: u16) -> Self {
        Self { config: source.config().0.0, ..Self::new(source.cmd_id(), interval_ms) }
    }

    fn call(&self) -> StreamCall {
        StreamCall {
            shape: Shape::new(self.command, self.config),
            interval_ms: self.interval_ms.max(1),
            synced: self.synced,
            capacity: self.capacity,
        }
    }
}

/// Samples as they come. Ends when the link does.
///
/// Dropping it unsubscribes.
#[derive(Debug)]
pub struct Subscription {
    queue: Arc<Queue>,
    number: u64,
    /// How many bytes each sample has, where that is known.
    length: Option<usize>,
    gimbal: Gimbal,
}

impl Subscription {
    /// The next sample; `None` when the link has ended.
    pub async fn next(&mut self) -> Option<Sample> {
        std::future::poll_fn(|context| self.poll_sample(context)).await
    }

    /// The same samples as messages.
    pub fn typed<M>(self) -> TypedStream<M> {
        TypedStream::new(self, ())
    }

    /// The same samples as messages that are read with a context, such as the flags that chose their fields.
    pub fn typed_with<M, C>(self, context: C) -> TypedStream<M, C> {
        TypedStream::new(self, context)
    }

    fn poll_sample(&self, context: &mut Context<'_>) -> Poll<Option<Sample>> {
        self.queue.poll(context)
    }
}

impl Stream for Subscription {
    type Item = Sample;

    fn poll_next(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Sample>> {
        self.poll_sample(context)
    }
}

impl Drop for Subscription {
    fn drop(&mut self) {
        self.gimbal.link().call(|machine, _| machine.leave(self.number));
    }
}

impl Gimbal {
    /// Has the board send a message again and again.
    ///
    /// Returns when the board has confirmed it. An equal request that runs already is shared; the same stream at
    /// another interval is refused, for it would change that of the others.
    pub async fn subscribe(&self, request: StreamRequest) -> Result<Subscription> {
        let (reply, outcome) = oneshot::channel();
        let call = request.call();
        let (number, queue) = self.link().call(|machine, _| machine.subscribe(call, reply));
        // From here on, whoever gives up unsubscribes.
        let subscription = Subscription { queue, number, length: call.shape.length(), gimbal: self.clone() };
        match outcome.await.map_err(|_| self.gone())? {
            Ok(_) => Ok(subscription),
            Err(failure) => Err(explain(request.command, failure)),
        }
    }

    /// All frames with this id that come from now on, whoever asked for them, answers included.
    ///
    /// Nothing is sent to the board.
    pub fn listen(&self, command: CommandId) -> Subscription {
        let (number, queue) = self.link().call(|machine, _| machine.listen(Some(command.raw()), CAPACITY));
        Subscription { queue, number, length: None, gimbal: self.clone() }
    }

    /// All frames that come from now on and are neither the answer to a request nor a sample of a stream: notices, traces
    /// of scripts, confirmations of commands that were sent without waiting. Their payloads say which
    /// [command](Payload::command) they are.
    ///
    /// Nothing is sent to the board.
    pub fn listen_unsolicited(&self) -> Subscription {
        let (number, queue) = self.link().call(|machine, _| machine.listen(None, CAPACITY));
        Subscription { queue, number, length: None, gimbal: self.clone() }
    }
}
