//! Samples as messages.

use std::marker::PhantomData;
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use futures_core::Stream;
use sbgc_proto::wire::FromWire;
use sbgc_proto::{DecodeError, Message};

use super::{Interruption, Sample, Subscription};

/// What a typed stream yields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item<M> {
    /// A message.
    Message(M),
    /// So many samples were lost here, because they were not taken in time.
    Lagged(u64),
    /// The stream has stopped. The driver registers it again until it [resumes](Self::Resumed) or the subscription
    /// ends.
    Interrupted(Interruption),
    /// The stream is back after so much time without samples.
    Resumed(Duration),
    /// A sample that has not the length of what was chosen: the firmware does not know all of it, or something else on
    /// the port has the board send other data. The stream goes on.
    WrongLength {
        /// Bytes of what was chosen.
        expected: usize,
        /// Bytes that came.
        got: usize,
    },
    /// A sample that is not such a message. The stream goes on.
    Undecoded(DecodeError),
}

/// Samples of a [`Subscription`] as messages.
///
/// `C` is what must be known besides the payload to read it, `()` for most messages.
#[derive(Debug)]
pub struct TypedStream<M, C = ()> {
    samples: Subscription,
    context: C,
    /// How many bytes each sample has, where that is known.
    length: Option<usize>,
    message: PhantomData<fn() -> M>,
}

impl<M, C> TypedStream<M, C> {
    pub(super) fn new(samples: Subscription, context: C) -> Self {
        let length = samples.length;
        Self { samples, context, length, message: PhantomData }
    }
}

impl<M, C> TypedStream<M, C>
where
    M: Message + for<'a> FromWire<'a, C>,
    C: Copy,
{
    /// The next message; `None` when the link has ended.
    pub async fn next(&mut self) -> Option<Item<M>> {
        let sample = self.samples.next().await?;
        Some(read(&sample, self.length, self.context))
    }
}

impl<M, C> Stream for TypedStream<M, C>
where
    M: Message + for<'a> FromWire<'a, C>,
    C: Copy + Unpin,
{
    type Item = Item<M>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Item<M>>> {
        let (length, known) = (self.length, self.context);
        Pin::new(&mut self.samples)
            .poll_next(context)
            .map(|sample| sample.map(|sample| read(&sample, length, known)))
    }
}

fn read<M, C>(sample: &Sample, length: Option<usize>, context: C) -> Item<M>
where
    M: Message + for<'a> FromWire<'a, C>,
{
    match sample {
        Sample::Payload(payload) if length.is_some_and(|length| length != payload.len()) => {
            Item::WrongLength { expected: length.unwrap_or_default(), got: payload.len() }
        }
        Sample::Payload(payload) => match M::decode_with(payload, context) {
            Ok((message, _)) => Item::Message(message),
            Err(error) => Item::Undecoded(error),
        },
        Sample::Lagged(count) => Item::Lagged(*count),
        Sample::Interrupted(interruption) => Item::Interrupted(*interruption),
        Sample::Resumed(after) => Item::Resumed(*after),
    }
}
