//! Registrations of data streams, their samples, and events.

use std::time::Duration;

use sbgc_proto::commands::{
    AhrsHelperStream, CanDrvTelemetry, CanDrvTelemetryFlags, DataStreamInterval, ImuIndex, StreamSource,
};
use sbgc_proto::wire::Bytes;
use sbgc_proto::{CommandId, OutgoingCommand};

use super::{can, ext_motors, imu, realtime};
use crate::sim::machine::{Call, Machine};
use crate::sim::reply::{Packet, Refusal, Replies, done};
use crate::sim::streams::Destination;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    match command {
        OutgoingCommand::DataStreamInterval(request) => Some(register(machine, call, request)),
        _ => None,
    }
}

fn register(machine: &mut Machine, call: &Call<'_>, request: &DataStreamInterval) -> Replies {
    let source = request.source().ok_or(Refusal::Parameters)?;
    // What cannot be sampled cannot be registered.
    if !matches!(source, StreamSource::Event { .. }) {
        sample(machine, call.now, source)?;
    }
    let to = Destination { port: call.port, version: call.version };
    let in_cycles = machine.config().has("2.70b1");
    machine.streams.register(call.now, to, source, request, in_cycles)?;
    done(CommandId::DataStreamInterval)
}

/// A sample or an event for a port.
#[derive(Debug)]
pub(in crate::sim) struct Sample {
    pub(in crate::sim) to: Destination,
    pub(in crate::sim) packet: Packet,
    /// Whether it may be left out where there is no room for it; an event may not.
    pub(in crate::sim) optional: bool,
}

/// The samples that are due, and the events that have happened.
pub(in crate::sim) fn samples(machine: &mut Machine, now: Duration) -> Vec<Sample> {
    let mut samples = Vec::new();
    for event in std::mem::take(&mut machine.events) {
        for to in machine.streams.told_of(event) {
            if let Ok(packet) = Packet::of(&event.message()) {
                samples.push(Sample { to, packet, optional: false });
            }
        }
    }
    for (to, source) in machine.streams.due(now) {
        for packet in sample(machine, now, source).unwrap_or_default() {
            samples.push(Sample { to, packet, optional: true });
        }
    }
    samples
}

fn sample(machine: &mut Machine, now: Duration, source: StreamSource) -> Result<Vec<Packet>, Refusal> {
    let packet = match source {
        StreamSource::RealtimeData3 => realtime::data_3_packet(machine, now)?,
        StreamSource::RealtimeData4 => realtime::data_4_packet(machine, now)?,
        StreamSource::RealtimeDataCustom(flags) => realtime::custom_packet(machine, now, flags)?,
        StreamSource::RealtimeDataCustom2(flags) if machine.config().has("2.74.2") => {
            realtime::custom_2_packet(machine, now, flags)?
        }
        StreamSource::AhrsHelper(index) => attitude(machine, index)?,
        StreamSource::CanDrvTelemetry { flags, drv_id } if machine.config().has("2.72b0") => {
            telemetry(machine, now, flags, drv_id)?
        }
        StreamSource::ExtMotorsState { for_motors, data_set } if machine.config().has("2.73.0") => {
            return Ok(ext_motors::states(machine, now, for_motors, data_set));
        }
        _ => return Err(Refusal::Parameters),
    };
    Ok(vec![packet])
}

/// The stream has two bytes more than the answer; what they mean is not published, here they follow the vectors.
fn attitude(machine: &Machine, index: ImuIndex) -> Result<Packet, Refusal> {
    let frame = match index {
        ImuIndex::Main => false,
        ImuIndex::Frame => true,
        _ => return Err(Refusal::Parameters),
    };
    let vectors = Packet::of(&imu::attitude(machine, frame))?;
    if !machine.config().has("2.69b5") {
        return Ok(vectors);
    }
    let mut data = [0; 26];
    for (place, byte) in data.iter_mut().zip(vectors.payload) {
        *place = byte;
    }
    Packet::of(&AhrsHelperStream { data: Bytes(data) })
}

fn telemetry(
    machine: &Machine,
    now: Duration,
    flags: CanDrvTelemetryFlags,
    driver: u8,
) -> Result<Packet, Refusal> {
    let data: CanDrvTelemetry = can::telemetry(machine, now, flags, driver).ok_or(Refusal::Parameters)?;
    Packet::with(&data, flags)
}
