//! `sbgc stream`: live data.

use std::time::Duration;

use clap::Args;
use sbgc_host::Gimbal;
use tokio::time::timeout;

use crate::connect::with_followed_board;
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::samples::Printer;
use crate::sampling::{Next, Sampling, Selection};
use crate::{talk, values};

const EXAMPLES: &str = "Examples:
  sbgc stream --count 10
  sbgc stream custom --data IMU_ANGLES,GYRO_DATA --interval 100Hz --for 2s
  sbgc stream realtime3 --fields bat_level,imu_angle.pitch --csv --count 5";

/// Show live data
///
/// Runs until interrupted, the output is closed, or --count or --for is reached; then stops the stream. Goes on with a
/// board that was reset, or unplugged for less than 10 seconds. timestamp_ms
/// comes first: the board's own time, or the time since the start where a message has none.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Stream {
    #[command(flatten)]
    selection: Selection,

    /// Stop after N samples
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,

    /// Stop after this time
    #[arg(long = "for", value_name = "TIME", value_parser = values::seconds)]
    time: Option<Duration>,

    /// Show these fields only, by their JSON keys, in this order
    #[arg(long, value_name = "KEYS", value_delimiter = ',')]
    fields: Vec<String>,

    /// Print CSV: a line with the keys, then plain numbers
    #[arg(long)]
    csv: bool,
}

impl Stream {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        if self.csv && output.is_json() {
            return Err(Failure::Usage(String::from("--csv cannot be used with --json")));
        }
        self.selection.source()?;
        let limit = self.time.unwrap_or(Duration::MAX);
        until_stopped(
            with_followed_board(global, async |gimbal, _| {
                timeout(limit, self.show(&gimbal, output)).await.unwrap_or(Ok(()))
            })
            .await,
        )
    }

    async fn show(&self, gimbal: &Gimbal, output: &mut Output) -> Result<(), Failure> {
        let source = self.selection.source()?;
        let mut sampling = Sampling::start(gimbal, source, self.selection.interval).await?;
        let mut printer = Printer::new(self.fields.clone(), self.csv);
        let mut left = self.count.unwrap_or(u64::MAX);
        while left > 0 {
            match sampling.next().await? {
                Next::Lost(lost) => talk::say(format_args!("{lost} samples lost")),
                Next::Said(what) if output.is_json() => tracing::info!("{what}"),
                Next::Said(what) => talk::say(what),
                Next::Sample(payload, time) => {
                    left -= 1;
                    printer.print(output, &sampling.read(&payload)?, time)?;
                }
            }
        }
        Ok(())
    }
}
