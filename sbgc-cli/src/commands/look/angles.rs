//! `sbgc angles`: where the gimbal points.

use clap::Args;
use serde_json::{Map, Value};

use crate::connect::with_board;
use crate::failure::Failure;
use crate::fields;
use crate::options::Global;
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc angles
  sbgc angles --json";

/// Show current and target angles
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Angles {}

impl Angles {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let angles = with_board(global, async |gimbal, _| Ok(gimbal.angles().await?)).await?;
        if output.is_json() {
            let mut object = Map::new();
            fields::add_to_object(&mut object, &angles);
            output.object(&Value::Object(object))?;
            return Ok(());
        }
        output.line(format_args!("{:<6}{:>12}{:>12}{:>16}", "axis", "angle", "target", "target speed"))?;
        let axes = angles.axes;
        for (name, axis) in [("ROLL", axes.roll), ("PITCH", axes.pitch), ("YAW", axes.yaw)] {
            output.line(format_args!(
                "{name:<6}{:>8.2} deg{:>8.2} deg{:>10.2} deg/s",
                axis.imu_angle.degrees(),
                axis.target_angle.degrees(),
                axis.target_speed.degrees_per_second(),
            ))?;
        }
        Ok(())
    }
}
