//! `sbgc control`: moving the gimbal.

use std::time::Duration;

use clap::{Args, Subcommand};
use sbgc_proto::commands::Control as ControlCommand;
use sbgc_proto::units::{Angle, ControlRate};
use sbgc_proto::wire::PerAxis;
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, values};

const EXAMPLES: &str = "Examples:
  sbgc control angle --pitch -30 --wait
  sbgc control angle --roll 0 --pitch 10deg --yaw -45 --speed 20";

/// Move the gimbal
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Control {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Move to angles; omitted axes are left unchanged
    ///
    /// Prints "accepted" once the board confirms, or "reached" with --wait.
    #[command(after_help = EXAMPLES)]
    Angle(ToAngle),
}

#[derive(Args, Debug)]
#[group(id = "axes", required = true, multiple = true)]
struct Target {
    /// Angle of ROLL in degrees
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = values::angle)]
    roll: Option<Angle>,

    /// Angle of PITCH in degrees
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = values::angle)]
    pitch: Option<Angle>,

    /// Angle of YAW in degrees
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = values::angle)]
    yaw: Option<Angle>,
}

#[derive(Args, Debug)]
struct ToAngle {
    #[command(flatten)]
    target: Target,

    /// Speed in degrees per second [default: the board's setting]
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = speed)]
    speed: Option<ControlRate>,

    /// Wait until the angles are reached
    #[arg(long)]
    wait: bool,

    /// Time to wait for that
    #[arg(long, requires = "wait", default_value = "30s", value_parser = values::seconds, value_name = "TIME")]
    patience: Duration,
}

fn speed(text: &str) -> Result<ControlRate, String> {
    match values::rate(text) {
        Ok(rate) if rate.0 > 0 => Ok(rate),
        Err(error) if !error.contains("out of range") => Err(error),
        _ => Err(format!("{text} is out of range; expected 0.13 to 4000 degrees per second")),
    }
}

impl Control {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Angle(command) => command.run(global, output).await,
        }
    }
}

impl ToAngle {
    async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let Target { roll, pitch, yaw } = self.target;
        let target = PerAxis { roll, pitch, yaw };
        let speed = self.speed.unwrap_or_default();
        with_board(global, async |gimbal, _| {
            if self.wait && !global.dry_run {
                gimbal.move_to(target, speed, self.patience).await?;
            } else {
                let control = ControlCommand::some_angles(target, speed);
                if act::confirm(global, output, &gimbal, &control).await?.is_none() {
                    return Ok(());
                }
            }
            let state = if self.wait { State::Reached } else { State::Accepted };
            let degrees = |angle: Option<Angle>| angle.map(Angle::degrees);
            let own = json!({"roll": degrees(roll), "pitch": degrees(pitch), "yaw": degrees(yaw)});
            output.outcome("control angle", state, own, state.as_str())?;
            Ok(())
        })
        .await
    }
}
