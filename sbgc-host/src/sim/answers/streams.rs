//! Registrations of data streams, and their samples.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{ConfirmData, DataStreamInterval, StreamSource};
use sbgc_proto::frame::Version;

use super::{Packet, Refusal, Replies, confirm};
use crate::sim::machine::Machine;

impl Machine {
    pub(super) fn stream(
        &mut self,
        now: Duration,
        version: Version,
        request: &DataStreamInterval,
    ) -> Replies {
        let source = request.source().ok_or(Refusal::Parameters)?;
        // What cannot be sampled cannot be registered.
        self.sample(now, source)?;
        self.streams.register(now, version, source, request)?;
        confirm(CommandId::DataStreamInterval, ConfirmData::U8(0))
    }

    /// The samples that are due.
    pub(in crate::sim) fn samples(&mut self, now: Duration) -> Vec<(Version, Packet)> {
        let due = self.streams.due(now);
        due.into_iter()
            .filter_map(|(version, source)| Some((version, self.sample(now, source).ok()?)))
            .collect()
    }

    fn sample(&self, now: Duration, source: StreamSource) -> Result<Packet, Refusal> {
        match source {
            StreamSource::RealtimeData3 => self.realtime_3(),
            StreamSource::RealtimeData4 => self.realtime_4(),
            StreamSource::RealtimeDataCustom(flags) => self.realtime_custom(now, flags),
            _ => Err(Refusal::NotSupported),
        }
    }
}
