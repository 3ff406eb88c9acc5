//! Choosing what the board shall stream, and reading what it sends.

use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use sbgc_host::capture::{Interpreted, Interpreter};
use sbgc_host::streams::Sample;
use sbgc_host::{Gimbal, StreamRequest, Subscription};
use sbgc_proto::commands::{
    CanDrvTelemetryFlags, DataStreamInterval, ExtMotors, ExtMotorsStateDataSet, ImuIndex,
    RealtimeDataCustom2Flags, RealtimeDataCustomFlags, StreamSource,
};
use sbgc_proto::frame::MAX_PAYLOAD;
use sbgc_proto::units::StreamInterval;
use sbgc_proto::wire::Label;
use sbgc_proto::{Direction, Message as _};
use tokio::time::timeout;

use crate::connect::FOLLOWED;
use crate::failure::Failure;
use crate::{text, values};

/// What to stream, as `stream` and `record` take it.
#[derive(Args, Clone, Debug)]
pub(crate) struct Selection {
    /// Kind of data; attitude has angles, targets and speeds [default: attitude, with --data custom]
    #[arg(value_enum)]
    kind: Option<Kind>,

    /// Data of custom, custom2, can-drv or ext-motors: comma-separated flags, such as IMU_ANGLES,GYRO_DATA
    #[arg(long, value_name = "NAMES", value_delimiter = ',', add = ArgValueCandidates::new(candidates))]
    data: Vec<String>,

    /// CAN motor driver of can-drv, or motors of ext-motors as a bit mask
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    device: u8,

    /// Interval (20ms) or rate (50Hz); 1ms stands for every board cycle (0.8 ms)
    #[arg(long, default_value = "100ms", value_parser = values::interval, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) interval: u16,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    Attitude,
    Custom,
    Custom2,
    Realtime3,
    Realtime4,
    Ahrs,
    CanDrv,
    ExtMotors,
}

/// What `attitude` consists of.
const ATTITUDE: RealtimeDataCustomFlags = RealtimeDataCustomFlags::IMU_ANGLES
    .union(RealtimeDataCustomFlags::TARGET_ANGLES)
    .union(RealtimeDataCustomFlags::TARGET_SPEED);

impl Selection {
    /// The stream that was chosen.
    pub(crate) fn source(&self) -> Result<StreamSource, Failure> {
        let kind = self.kind.unwrap_or(if self.data.is_empty() { Kind::Attitude } else { Kind::Custom });
        let takes_data = matches!(kind, Kind::Custom | Kind::Custom2 | Kind::CanDrv | Kind::ExtMotors);
        if takes_data == self.data.is_empty() {
            let name = kind.to_possible_value();
            let name = name.as_ref().map_or("", |value| value.get_name());
            return Err(Failure::Usage(if takes_data {
                format!("{name} needs --data; available: {}", names(kind.labels()).join(", "))
            } else {
                format!("{name} takes no --data; use `custom --data NAMES`")
            }));
        }
        let bits = self.bits(kind.labels())?;
        Ok(match kind {
            Kind::Attitude => StreamSource::RealtimeDataCustom(ATTITUDE),
            Kind::Custom => StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::from_bits_retain(bits)),
            Kind::Custom2 => {
                StreamSource::RealtimeDataCustom2(RealtimeDataCustom2Flags::from_bits_retain(bits))
            }
            Kind::Realtime3 => StreamSource::RealtimeData3,
            Kind::Realtime4 => StreamSource::RealtimeData4,
            Kind::Ahrs => StreamSource::AhrsHelper(ImuIndex::Main),
            Kind::CanDrv => StreamSource::CanDrvTelemetry {
                flags: CanDrvTelemetryFlags::from_bits_retain(bits),
                drv_id: self.device,
            },
            Kind::ExtMotors => StreamSource::ExtMotorsState {
                for_motors: ExtMotors::from_bits_retain(self.device),
                data_set: ExtMotorsStateDataSet::from_bits_retain(bits),
            },
        })
    }

    fn bits(&self, labels: &[Label]) -> Result<u32, Failure> {
        let mut bits = 0;
        for name in &self.data {
            let known = names(labels);
            let Some(label) = labels.iter().find(|label| label.name.eq_ignore_ascii_case(name.trim())) else {
                let unknown = text::unknown("data", name, known.iter().copied());
                return Err(Failure::Usage(format!("--data: {unknown} Available: {}", known.join(", "))));
            };
            bits |= u32::try_from(label.value).unwrap_or_default();
        }
        Ok(bits)
    }
}

impl Kind {
    fn labels(self) -> &'static [Label] {
        match self {
            Kind::Custom => RealtimeDataCustomFlags::LABELS,
            Kind::Custom2 => RealtimeDataCustom2Flags::LABELS,
            Kind::CanDrv => CanDrvTelemetryFlags::LABELS,
            Kind::ExtMotors => ExtMotorsStateDataSet::LABELS,
            Kind::Attitude | Kind::Realtime3 | Kind::Realtime4 | Kind::Ahrs => &[],
        }
    }
}

/// What a shell completes for data.
fn candidates() -> Vec<CompletionCandidate> {
    let labels = Kind::value_variants().iter().flat_map(|kind| names(kind.labels()));
    let mut all: Vec<&str> = labels.collect();
    all.sort_unstable();
    all.dedup();
    all.into_iter().map(CompletionCandidate::new).collect()
}

fn names(labels: &[Label]) -> Vec<&'static str> {
    labels.iter().map(|label| label.name).collect()
}

/// A stream that runs, with what is needed to read its samples.
pub(crate) struct Sampling {
    gimbal: Gimbal,
    request: StreamRequest,
    samples: Subscription,
    interpreter: Interpreter,
    silence: Duration,
    began: Instant,
    /// Since when nothing comes.
    quiet: Option<Instant>,
}

/// How long no sample may come before the board is asked whether it is there.
const SILENCE: Duration = Duration::from_secs(2);

/// What a stream brings.
pub(crate) enum Next {
    /// The payload of a sample, and the time since the start.
    Sample(Vec<u8>, Duration),
    /// So many samples were lost before this point.
    Lost(u64),
    /// The stream was interrupted, or goes on.
    Said(String),
}

impl Sampling {
    /// Registers the stream.
    pub(crate) async fn start(gimbal: &Gimbal, source: StreamSource, interval: u16) -> Result<Self, Failure> {
        let request = StreamRequest::of(source, interval);
        let samples = gimbal.subscribe(request).await?;
        let mut interpreter = Interpreter::new(None);
        // What the samples hold is known from the registration.
        let registration = DataStreamInterval::new(source, StreamInterval(interval));
        let mut buffer = [0; MAX_PAYLOAD];
        let payload = registration.encode(&mut buffer).map_err(sbgc_host::Error::from)?;
        let id = DataStreamInterval::ID.raw();
        interpreter.interpret(Some(Direction::Outgoing), id, payload).map_err(sbgc_host::Error::from)?;
        Ok(Self {
            gimbal: gimbal.clone(),
            request,
            samples,
            interpreter,
            silence: SILENCE.max(Duration::from_millis(interval.into()) * 5),
            began: Instant::now(),
            quiet: None,
        })
    }

    /// Waits for the next sample, also for that of a board that was reset or unplugged and comes back.
    pub(crate) async fn next(&mut self) -> Result<Next, Failure> {
        loop {
            let Ok(sample) = timeout(self.silence, self.samples.next()).await else {
                self.look_after().await?;
                continue;
            };
            self.quiet = None;
            return Ok(match sample {
                Some(Sample::Interrupted(why)) => Next::Said(format!("stream interrupted: {why}")),
                Some(Sample::Resumed(after)) => {
                    Next::Said(format!("stream resumed after {:.1} s", after.as_secs_f64()))
                }
                None => return Err(sbgc_host::Error::Disconnected.into()),
                Some(Sample::Lagged(lost)) => Next::Lost(lost),
                Some(Sample::Payload(payload)) => Next::Sample(payload.to_vec(), self.began.elapsed()),
            });
        }
    }

    /// Nothing comes: asks whether the board is there. The driver registers the stream again once it is.
    async fn look_after(&mut self) -> Result<(), Failure> {
        let since = *self.quiet.get_or_insert_with(Instant::now);
        let Err(error) = self.gimbal.board_info().await else {
            self.quiet = None;
            return Ok(());
        };
        // Where the port is gone, the driver knows when to give up.
        if self.gimbal.is_reconnecting() || since.elapsed() < FOLLOWED {
            return Ok(());
        }
        Err(error.into())
    }

    /// Reads the payload of a sample.
    pub(crate) fn read<'p>(&mut self, payload: &'p [u8]) -> Result<Interpreted<'p>, Failure> {
        let id = self.request.command.raw();
        let read = self.interpreter.interpret(Some(Direction::Incoming), id, payload);
        Ok(read.map_err(sbgc_host::Error::from)?)
    }
}
