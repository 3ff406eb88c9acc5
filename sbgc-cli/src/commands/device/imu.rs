//! `sbgc imu`: the inertial sensors.

use clap::{Args, Subcommand, ValueEnum};
use sbgc_proto::commands::{CalibInfoRequest, ExtImuDebugInfoRequest, ImuType, SelectImu3};
use sbgc_proto::reflect::{self, Describe, Leaf};
use serde_json::{Map, Value, json};

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, fields};

const EXAMPLES: &str = "Examples:
  sbgc imu info
  sbgc imu info frame --json
  sbgc imu select main";

/// Show and choose the inertial sensors
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Imu {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Show readings, temperature and calibrations of a sensor
    #[command(after_help = "Examples:
  sbgc imu info
  sbgc imu info frame --json")]
    Info {
        /// Sensor
        #[arg(value_enum, default_value_t = Sensor::Main)]
        sensor: Sensor,
    },
    /// Choose the sensor that calibrations and real-time data work on
    #[command(after_help = "Examples:
  sbgc imu select main
  sbgc imu select frame --json")]
    Select {
        /// Sensor
        #[arg(value_enum)]
        sensor: Sensor,
    },
    /// Show what the external sensor reports
    #[command(after_help = "Examples:
  sbgc imu external
  sbgc imu external --json")]
    External,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Sensor {
    /// On the camera platform
    Main,
    /// On the frame
    Frame,
}

impl Sensor {
    fn kind(self) -> (ImuType, &'static str) {
        match self {
            Sensor::Main => (ImuType::Main, "main"),
            Sensor::Frame => (ImuType::Frame, "frame"),
        }
    }
}

impl Imu {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| match self.what {
            What::Info { sensor } => {
                let request = CalibInfoRequest { imu_type: sensor.kind().0, ..CalibInfoRequest::default() };
                let info = gimbal.request(&request).await?;
                show(output, &info)
            }
            What::External => {
                let info = gimbal.request(&ExtImuDebugInfoRequest {}).await?;
                show(output, &info)
            }
            What::Select { sensor } => {
                let (imu_type, name) = sensor.kind();
                let command = SelectImu3 { imu_type };
                if global.dry_run {
                    return act::show(output, gimbal.version(), &command);
                }
                gimbal.send_checked(&command).await?;
                Ok(output.outcome("imu select", State::Accepted, json!({"imu": name}), "accepted")?)
            }
        })
        .await
    }
}

/// All fields of an answer.
fn show<M: Describe>(output: &mut Output, answer: &M) -> Result<(), Failure> {
    let mut object = Map::new();
    fields::add_to_object(&mut object, answer);
    if output.is_json() {
        return Ok(output.object(&Value::Object(object))?);
    }
    let mut lines = Vec::new();
    reflect::walk(answer, &mut |leaf: &Leaf<'_>| {
        if !leaf.field.reserved {
            lines.push((leaf.path.to_string(), fields::value_text(leaf)));
        }
    });
    let width = lines.iter().map(|(path, _)| path.len()).max().unwrap_or_default();
    for (path, value) in lines {
        output.line(format_args!("{path:<width$}  {value}"))?;
    }
    Ok(())
}
