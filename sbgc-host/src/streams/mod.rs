//! Data streams: messages that the board sends on its own, as [`Stream`]s.
//!
//! The board has ten registrations for all its ports together. Equal requests share one, and it is given back when
//! the last subscriber leaves. Each subscriber has a queue of its own that loses its oldest samples when it is full;
//! a slow one disturbs nobody.
//!
//! What a sample means is for its message to say; what keeps the registrations is in [`link`](crate::link).

pub(crate) mod queue;
mod typed;

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use bytes::Bytes;
use futures_core::Stream;
use sbgc_proto::CommandId;
use sbgc_proto::commands::{DataStreamInterval, StreamConfig, StreamSource};
use sbgc_proto::units::StreamInterval;
use tokio::sync::oneshot;

pub use queue::Sample;
pub use typed::{Item, TypedStream};

use crate::gimbal::{encode, explain, name_of};
use crate::link::shared::{Command, StreamCall, StreamFailure};
use crate::{Error, Gimbal, Result};
use queue::Queue;

/// How many samples a queue holds unless asked otherwise.
const CAPACITY: usize = 64;

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
    /// What is to be sent, as the message has it: selection flags, the IMU, the event.
    pub config: [u8; 8],
    /// How many payload bytes a sample has, where samples of several configurations can be told apart by that only.
    pub length: Option<usize>,
    /// How many samples wait for a slow subscriber before the oldest is lost.
    pub capacity: usize,
}

impl StreamRequest {
    /// A message without configuration.
    pub const fn new(command: CommandId, interval_ms: u16) -> Self {
        Self { command, interval_ms, config: [0; 8], length: None, capacity: CAPACITY }
    }

    /// What `source` describes, with its configuration and length.
    pub fn of(source: StreamSource, interval_ms: u16) -> Self {
        let length = match source {
            StreamSource::RealtimeDataCustom(flags) => Some(flags.payload_len()),
            StreamSource::RealtimeDataCustom2(flags) => Some(flags.payload_len()),
            StreamSource::CanDrvTelemetry { flags, .. } => Some(flags.payload_len()),
            _ => None,
        };
        Self { config: source.config().0.0, length, ..Self::new(source.cmd_id(), interval_ms) }
    }

    /// The registration of the stream; with interval 0 its end.
    fn registration(&self, interval_ms: u16) -> Result<Bytes> {
        let message = DataStreamInterval {
            cmd_id: self.command,
            interval_ms: StreamInterval(interval_ms),
            config: StreamConfig(self.config.into()),
            ..DataStreamInterval::default()
        };
        encode(&message)
    }
}

/// Samples as they come. Ends when the link does.
///
/// Dropping it unsubscribes.
#[derive(Debug)]
pub struct Subscription {
    queue: Option<Arc<Queue>>,
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
        self.queue.as_ref().map_or(Poll::Ready(None), |queue| queue.poll(context))
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
        if let Some(queue) = self.queue.take() {
            self.gimbal.shared.remove_listener(&queue);
            // The task looks for registrations without users, so the last one must be gone before it is called.
            drop(queue);
            self.gimbal.shared.bell.notify_one();
        }
    }
}

impl Gimbal {
    /// Has the board send a message again and again.
    ///
    /// Returns when the board has confirmed it. An equal request that runs already is shared; the same stream at
    /// another interval is refused, for it would change that of the others.
    pub async fn subscribe(&self, request: StreamRequest) -> Result<Subscription> {
        let interval_ms = request.interval_ms.max(1);
        let command = CommandId::DataStreamInterval;
        // Asking twice for a stream updates it, so this write may be repeated.
        let attempts = self.options.attempts.max(1);
        let start =
            self.make_call(command, request.registration(interval_ms)?, CommandId::CONFIRM, attempts)?;
        let subscription = self.attach(request.command, request.length, request.capacity);
        let user = subscription.queue.as_ref().map(Arc::downgrade).unwrap_or_default();
        let (reply, outcome) = oneshot::channel();
        let wanted = StreamCall { start, stop: request.registration(0)?, user, reply };
        self.commands.send(Command::Stream(wanted)).await.map_err(|_| self.gone())?;
        match outcome.await.map_err(|_| self.gone())? {
            Ok(()) => Ok(subscription),
            Err(StreamFailure::Failed(failure)) => Err(explain(command, failure)),
            Err(StreamFailure::Running(payload)) => Err(Error::StreamInUse {
                command: name_of(request.command),
                running_ms: payload
                    .get(1..3)
                    .and_then(|bytes| bytes.first_chunk())
                    .map_or(0, |&bytes| u16::from_le_bytes(bytes)),
                asked_ms: interval_ms,
            }),
        }
    }

    /// All frames with this id that come from now on, whoever asked for them, answers included.
    ///
    /// Nothing is sent to the board.
    pub fn listen(&self, command: CommandId) -> Subscription {
        self.attach(command, None, CAPACITY)
    }

    fn attach(&self, command: CommandId, length: Option<usize>, capacity: usize) -> Subscription {
        let queue = Arc::new(Queue::new(command.raw(), length, capacity));
        self.shared.add_listener(Arc::clone(&queue));
        Subscription { queue: Some(queue), gimbal: self.clone() }
    }
}
