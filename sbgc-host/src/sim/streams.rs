//! The messages that the board sends by itself, each at its own rate.
//!
//! Real: ten registrations over all ports, each known by its port, its command and all bytes of its configuration;
//! registered again, it gets the new interval; interval 1 is every control cycle of 0.8 ms. A sample is taken in the
//! first cycle at or after its time, and the times are whole intervals after the registration, so that the average is
//! exact. A sample that finds no room in the output buffer is skipped. Events are sent once, when they happen.
//!
//! Where the protocol leaves it open: the first sample comes one interval after the registration; an eleventh
//! registration is refused as an operation that failed; one that is not there is removed with success.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{DataStreamInterval, StreamConfig, StreamSource, Switch};
use sbgc_proto::frame::Version;

use super::events::Happened;
use super::motion::CYCLE;
use super::reply::Refusal;

/// How many streams there can be.
const MOST: usize = 10;

/// Where samples go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Destination {
    pub(super) port: u8,
    pub(super) version: Version,
}

#[derive(Debug)]
struct Stream {
    key: (u8, CommandId, StreamConfig),
    source: StreamSource,
    to: Destination,
    interval: Duration,
    /// When the next sample is wanted.
    due: Duration,
}

impl Stream {
    fn is_of_events(&self) -> bool {
        matches!(self.source, StreamSource::Event { .. })
    }

    /// The cycle in which the next sample is taken.
    fn cycle(&self) -> Duration {
        let over = self.due.as_nanos().checked_rem(CYCLE.as_nanos()).unwrap_or_default();
        let over = Duration::from_nanos(u64::try_from(over).unwrap_or_default());
        if over.is_zero() { self.due } else { self.due.saturating_sub(over).saturating_add(CYCLE) }
    }
}

#[derive(Debug, Default)]
pub(super) struct Streams(Vec<Stream>);

impl Streams {
    pub(super) fn register(
        &mut self,
        now: Duration,
        to: Destination,
        source: StreamSource,
        request: &DataStreamInterval,
        in_cycles: bool,
    ) -> Result<(), Refusal> {
        let key = (to.port, request.cmd_id, request.config);
        let interval = match (request.interval_ms.0, request.sync_to_data) {
            (0, _) => {
                self.0.retain(|stream| stream.key != key);
                return Ok(());
            }
            (cycles, Switch::On) if in_cycles => CYCLE.saturating_mul(cycles.into()),
            (1, _) => CYCLE,
            (milliseconds, _) => Duration::from_millis(milliseconds.into()),
        };
        let due = now.saturating_add(interval);
        let full = self.0.len() >= MOST;
        match self.0.iter_mut().find(|stream| stream.key == key) {
            Some(stream) => *stream = Stream { key, source, to, interval, due },
            None if full => return Err(Refusal::Failed),
            None => self.0.push(Stream { key, source, to, interval, due }),
        }
        Ok(())
    }

    /// Forgets the streams of a port.
    pub(super) fn drop_port(&mut self, port: u8) {
        self.0.retain(|stream| stream.to.port != port);
    }

    /// When the next sample is taken.
    pub(super) fn next(&self) -> Option<Duration> {
        self.0.iter().filter(|stream| !stream.is_of_events()).map(Stream::cycle).min()
    }

    /// What is to be sampled now.
    pub(super) fn due(&mut self, now: Duration) -> Vec<(Destination, StreamSource)> {
        let mut due = Vec::new();
        for stream in self.0.iter_mut().filter(|stream| !stream.is_of_events()) {
            if stream.cycle() <= now {
                stream.due = stream.due.saturating_add(stream.interval);
                due.push((stream.to, stream.source));
            }
        }
        due
    }

    /// Who wants to know of an event.
    pub(super) fn told_of(&self, event: Happened) -> Vec<Destination> {
        let wants = |stream: &&Stream| match stream.source {
            StreamSource::Event { event_id, event_type } => event.concerns(event_id, event_type),
            _ => false,
        };
        self.0.iter().filter(wants).map(|stream| stream.to).collect()
    }
}
