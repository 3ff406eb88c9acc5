//! Streams of each kind, as typed messages.

use std::future::poll_fn;
use std::task::Poll;
use std::time::Duration;

use sbgc_proto::commands::{
    AhrsHelper, BoardEvent, EventId, EventTypes, ImuIndex, RealtimeDataCustom, RealtimeDataCustomFlags,
    StreamSource,
};
use sbgc_proto::wire::FromWire;
use sbgc_proto::{CommandId, Message};

use super::{Interruption, Sample, StreamRequest, Subscription, TypedStream};
use crate::error::Result;
use crate::gimbal::Gimbal;

impl Gimbal {
    /// Has the board send a message of one kind, such as [`RealtimeData4`](sbgc_proto::commands::RealtimeData4), at
    /// this interval.
    ///
    /// Intervals are whole milliseconds from 1 to 65535; others are rounded.
    ///
    /// # Errors
    /// If the board does not confirm the stream, or it cannot run beside the others.
    pub async fn stream<M>(&self, interval: Duration) -> Result<TypedStream<M>>
    where
        M: Message + for<'a> FromWire<'a>,
    {
        Ok(self.subscribe(StreamRequest::new(M::ID, milliseconds(interval))).await?.typed())
    }

    /// Has the board send these fields of real-time data at this interval. Samples that have not exactly these fields
    /// are told apart by their length.
    ///
    /// # Errors
    /// If the board does not confirm the stream, or it cannot run beside the others.
    pub async fn stream_custom(
        &self,
        fields: RealtimeDataCustomFlags,
        interval: Duration,
    ) -> Result<TypedStream<RealtimeDataCustom, RealtimeDataCustomFlags>> {
        let source = StreamSource::RealtimeDataCustom(fields);
        let request = StreamRequest::of(source, milliseconds(interval));
        Ok(self.subscribe(request).await?.typed_with(fields))
    }

    /// Has the board send the attitude of an IMU at this interval.
    ///
    /// # Errors
    /// If the board does not confirm the stream, or it cannot run beside the others.
    pub async fn ahrs(&self, imu: ImuIndex, interval: Duration) -> Result<TypedStream<AhrsHelper>> {
        let request = StreamRequest::of(StreamSource::AhrsHelper(imu), milliseconds(interval));
        Ok(self.subscribe(request).await?.typed())
    }

    /// Has the board report events of these kinds.
    ///
    /// Each kind takes one of the board's ten streams.
    ///
    /// # Errors
    /// If the board does not confirm one of them.
    pub async fn events(&self, kinds: &[EventId]) -> Result<EventStream> {
        let mut streams = Vec::with_capacity(kinds.len());
        for &event_id in kinds {
            let source = StreamSource::Event { event_id, event_type: EventTypes::all() };
            streams.push(self.subscribe(StreamRequest::of(source, HOLD_MS)).await?);
        }
        Ok(EventStream { streams })
    }
}

/// How often an event that lasts is reported.
const HOLD_MS: u16 = 100;

/// Events as they happen.
#[derive(Debug)]
pub struct EventStream {
    streams: Vec<Subscription>,
}

/// What an event stream yields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Happening {
    /// An event.
    Event {
        /// Event kind.
        kind: EventId,
        /// Event phase.
        phase: EventTypes,
        /// Event parameter.
        param: u16,
    },
    /// So many events were lost here, because they were not taken in time.
    Lagged(u64),
    /// Events are not reported for now. The driver registers the stream again.
    Interrupted(Interruption),
    /// Events are reported again after so much time.
    Resumed(Duration),
}

impl EventStream {
    /// The next event; `None` when the link has ended.
    pub async fn next(&mut self) -> Option<Happening> {
        loop {
            let sample = poll_fn(|context| {
                let mut ended = true;
                for stream in &self.streams {
                    match stream.poll_sample(context) {
                        Poll::Ready(Some(sample)) => return Poll::Ready(Some(sample)),
                        Poll::Ready(None) => {}
                        Poll::Pending => ended = false,
                    }
                }
                if ended { Poll::Ready(None) } else { Poll::Pending }
            });
            match sample.await? {
                Sample::Payload(payload) => {
                    if let Ok(event) = BoardEvent::decode(&payload) {
                        let BoardEvent { event_id: kind, event_type: phase, param1: param, .. } = event;
                        return Some(Happening::Event { kind, phase, param });
                    }
                    tracing::debug!("{} with an unknown layout", CommandId::Event.raw());
                }
                Sample::Lagged(count) => return Some(Happening::Lagged(count)),
                Sample::Interrupted(interruption) => return Some(Happening::Interrupted(interruption)),
                Sample::Resumed(after) => return Some(Happening::Resumed(after)),
            }
        }
    }
}

/// An interval as the board has it.
fn milliseconds(interval: Duration) -> u16 {
    let rounded = interval.saturating_add(Duration::from_micros(500)).as_millis();
    u16::try_from(rounded).unwrap_or(u16::MAX).max(1)
}
