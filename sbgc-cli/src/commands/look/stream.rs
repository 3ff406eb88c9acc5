//! `sbgc stream`: live data.

use std::time::Duration;

use clap::Args;
use sbgc_host::streams::Item;
use sbgc_host::{Gimbal, StreamRequest};
use sbgc_proto::commands::{RealtimeDataCustom, RealtimeDataCustomFlags, StreamSource};
use serde_json::{Map, Value, json};
use tokio::time::timeout;

use crate::args::Global;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::fields;
use crate::output::Output;
use crate::signals::stopped;
use crate::table::{Cell, Table};

pub(super) const EXAMPLES: &str = "Examples:
  sbgc stream
  sbgc stream --data imu_angles,gyro_data --interval 10 --json
  sbgc stream --data SYSTEM_POWER_STATE --interval 1000 --count 60";

#[derive(Args, Debug)]
pub(crate) struct Stream {
    /// What to show: names of CMD_REALTIME_DATA_CUSTOM flags, with commas between
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "IMU_ANGLES,TARGET_ANGLES,TARGET_SPEED", value_parser = flag)]
    data: Vec<RealtimeDataCustomFlags>,

    /// Time between samples in milliseconds, at most 65535; 1 is every cycle of the board, 0.8 ms
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u16).range(1..), value_name = "MS")]
    interval: u16,

    /// End after so many samples
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
            Err(format!("no such data; there are {}", names.join(", ")))
        }
    }
}

impl Stream {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| {
            tokio::select! {
                biased;
                // The stream is taken from the board before the program ends.
                () = stopped() => Ok(()),
                shown = self.show(&gimbal, output) => shown,
            }
        })
        .await
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
