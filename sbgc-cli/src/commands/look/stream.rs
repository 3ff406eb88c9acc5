//! `sbgc stream`: live data.

use std::time::Duration;

use clap::Args;
use sbgc_host::streams::Item;
use sbgc_host::{Gimbal, StreamRequest};
use sbgc_proto::commands::{RealtimeDataCustom, RealtimeDataCustomFlags, StreamSource};
use serde_json::{Map, Value, json};
use tokio::time::timeout;

use crate::connect::with_board;
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::table::{Cell, Table};
use crate::{fields, text, values};

const EXAMPLES: &str = "Examples:
  sbgc stream
  sbgc stream --data imu_angles,gyro_data --interval 100Hz --json
  sbgc stream --interval 1s --count 60";

/// Show live data
///
/// Runs until interrupted, the output is closed, or --count samples were shown; then stops the stream.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Stream {
    /// Data to show: comma-separated CMD_REALTIME_DATA_CUSTOM flags
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "IMU_ANGLES,TARGET_ANGLES,TARGET_SPEED", value_parser = flag)]
    data: Vec<RealtimeDataCustomFlags>,

    /// Time between samples (20ms) or their rate (50Hz); 1ms is every cycle of the board, 0.8 ms
    #[arg(long, default_value = "100ms", value_parser = values::interval, value_name = "TIME")]
    interval: u16,

    /// Stop after N samples
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,
}

/// How long no sample may come before the board is asked whether it is there.
const SILENCE: Duration = Duration::from_secs(2);

fn flag(name: &str) -> Result<RealtimeDataCustomFlags, String> {
    let known = RealtimeDataCustomFlags::LABELS;
    match known.iter().find(|label| label.name.eq_ignore_ascii_case(name)) {
        Some(label) => {
            Ok(RealtimeDataCustomFlags::from_bits_retain(u32::try_from(label.value).unwrap_or_default()))
        }
        None => {
            let names: Vec<_> = known.iter().map(|label| label.name).collect();
            Err(format!(
                "{}; available: {}",
                text::unknown("data", name, names.iter().copied()),
                names.join(", ")
            ))
        }
    }
}

impl Stream {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        until_stopped(with_board(global, async |gimbal, _| self.show(&gimbal, output).await).await)
    }

    async fn show(&self, gimbal: &Gimbal, output: &mut Output) -> Result<(), Failure> {
        let flags = self.data.iter().copied().fold(RealtimeDataCustomFlags::empty(), |all, flag| all | flag);
        let request = StreamRequest::of(StreamSource::RealtimeDataCustom(flags), self.interval);
        let subscribe = async || {
            let samples = gimbal.subscribe(request).await?;
            Ok::<_, Failure>(samples.typed_with::<RealtimeDataCustom, _>(flags))
        };
        let mut samples = subscribe().await?;
        let silence = SILENCE.max(Duration::from_millis(self.interval.into()) * 5);
        let mut table = None;
        let mut left = self.count.unwrap_or(u64::MAX);
        while left > 0 {
            let Ok(sample) = timeout(silence, samples.next()).await else {
                // A board that was reset has forgotten the stream; one that is gone does not answer.
                gimbal.board_info().await?;
                tracing::info!("no samples for {} s, asking for them again", silence.as_secs());
                drop(samples);
                samples = subscribe().await?;
                continue;
            };
            let data = match sample {
                None => return Err(sbgc_host::Error::Disconnected.into()),
                Some(Item::Undecoded(error)) => return Err(sbgc_host::Error::from(error).into()),
                Some(Item::Lagged(lost)) => {
                    if output.is_json() {
                        output.object(&json!({ "lost": lost }))?;
                    } else {
                        output.line(format_args!("({lost} samples lost)"))?;
                    }
                    continue;
                }
                Some(Item::Message(data)) => data,
            };
            left -= 1;
            if output.is_json() {
                let mut object = Map::new();
                fields::add_to_object(&mut object, &data);
                output.object(&Value::Object(object))?;
            } else {
                let cells = Cell::of(&data);
                let table = match &table {
                    Some(table) => table,
                    None => {
                        let new = Table::for_cells(&cells);
                        new.header().iter().try_for_each(|line| output.line(line))?;
                        table.insert(new)
                    }
                };
                output.line(table.row(&cells))?;
            }
            output.flush()?;
        }
        Ok(())
    }
}
