//! `sbgc control`: moving the gimbal.

use std::time::Duration;

use clap::{Args, Subcommand};
use sbgc_proto::OutOfRange;
use sbgc_proto::commands::Control as ControlCommand;
use sbgc_proto::units::{Angle, ControlRate};
use sbgc_proto::wire::PerAxis;

use crate::args::Global;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Args, Debug)]
pub(crate) struct Control {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Turn to angles; axes that are not named are left to themselves
    ///
    /// Says "accepted" as soon as the board has taken the command, with --wait "reached" when the gimbal is there.
    Angle(ToAngle),
}

#[derive(Args, Debug)]
#[group(id = "axes", required = true, multiple = true)]
struct Target {
    /// Angle of ROLL in degrees
    #[arg(long, allow_negative_numbers = true, value_name = "DEG", value_parser = angle)]
    roll: Option<Angle>,

    /// Angle of PITCH in degrees
    #[arg(long, allow_negative_numbers = true, value_name = "DEG", value_parser = angle)]
    pitch: Option<Angle>,

    /// Angle of YAW in degrees
    #[arg(long, allow_negative_numbers = true, value_name = "DEG", value_parser = angle)]
    yaw: Option<Angle>,
}

#[derive(Args, Debug)]
struct ToAngle {
    #[command(flatten)]
    target: Target,

    /// Speed in degrees a second; the board's own setting when left out
    #[arg(long, allow_negative_numbers = true, value_name = "DEG/S", value_parser = speed)]
    speed: Option<ControlRate>,

    /// Wait until the angles are reached
    #[arg(long)]
    wait: bool,

    /// How long to wait for that, in seconds
    #[arg(long, requires = "wait", default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=86_400), value_name = "S")]
    patience: u64,
}

fn number(text: &str, unit: &str) -> Result<f32, String> {
    text.parse().map_err(|_| format!("not a number; {unit} are wanted"))
}

fn angle(text: &str) -> Result<Angle, String> {
    Angle::try_from_degrees(number(text, "degrees")?)
        .map_err(|OutOfRange| String::from("out of range; -720 to 719.97 degrees can be sent"))
}

fn speed(text: &str) -> Result<ControlRate, String> {
    match ControlRate::try_from_degrees_per_second(number(text, "degrees a second")?) {
        Ok(rate) if rate.0 > 0 => Ok(rate),
        _ => Err(String::from("out of range; 0.13 to 4000 degrees a second can be sent")),
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
            if self.wait {
                gimbal.move_to(target, speed, Duration::from_secs(self.patience)).await?;
            } else {
                gimbal.confirm(&ControlCommand::some_angles(target, speed)).await?;
            }
            Ok(())
        })
        .await?;
        let word = if self.wait { "reached" } else { "accepted" };
        if output.is_json() {
            let degrees = |angle: Option<Angle>| angle.map(Angle::degrees);
            output.object(&serde_json::json!({
                "state": word, "roll": degrees(roll), "pitch": degrees(pitch), "yaw": degrees(yaw),
            }))?;
        } else {
            output.line(word)?;
        }
        Ok(())
    }
}
