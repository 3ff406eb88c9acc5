//! `sbgc stream`: live data.

use clap::Args;
use sbgc_host::StreamRequest;
use sbgc_host::streams::Item;
use sbgc_proto::commands::{RealtimeDataCustom, RealtimeDataCustomFlags, StreamSource};
use serde_json::{Map, Value, json};

use crate::args::Global;
use crate::connect::connect;
use crate::failure::Failure;
use crate::fields;
use crate::output::Output;

#[derive(Args, Debug)]
pub(crate) struct Stream {
    /// What to show: names of CMD_REALTIME_DATA_CUSTOM flags
    #[arg(long, value_delimiter = ',', default_value = "IMU_ANGLES,TARGET_ANGLES,TARGET_SPEED", value_parser = flag)]
    data: Vec<RealtimeDataCustomFlags>,

    /// Time between samples in milliseconds; 1 is every cycle of the board, 0.8 ms
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u16).range(1..), value_name = "MS")]
    interval: u16,

    /// End after so many samples
    #[arg(long, value_name = "N")]
    count: Option<u64>,
}

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
        let flags = self.data.iter().copied().fold(RealtimeDataCustomFlags::empty(), |all, flag| all | flag);
        let (gimbal, _) = connect(global).await?;
        let request = StreamRequest::of(StreamSource::RealtimeDataCustom(flags), self.interval);
        let samples = gimbal.subscribe(request).await?;
        let mut samples = samples.typed_with::<RealtimeDataCustom, _>(flags);
        let mut left = self.count.unwrap_or(u64::MAX);
        while left > 0 {
            let sample = tokio::select! {
                sample = samples.next() => sample,
                // The stream is taken from the board before the program ends.
                _ = tokio::signal::ctrl_c() => None,
            };
            match sample {
                None => break,
                Some(Item::Lagged(lost)) if output.is_json() => output.object(&json!({ "lost": lost }))?,
                Some(Item::Lagged(lost)) => output.line(format_args!("({lost} samples lost)"))?,
                Some(Item::Undecoded(error)) => return Err(sbgc_host::Error::from(error).into()),
                Some(Item::Message(data)) => {
                    left -= 1;
                    if output.is_json() {
                        let mut object = Map::new();
                        fields::add_to_object(&mut object, &data);
                        output.object(&Value::Object(object))?;
                    } else {
                        output.line(fields::on_one_line(&data))?;
                    }
                }
            }
            output.flush()?;
        }
        drop(samples);
        gimbal.close().await;
        Ok(())
    }
}
