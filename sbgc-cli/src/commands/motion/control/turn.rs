//! `sbgc control angle`, `speed-angle` and `home`: moves to angles.

use std::time::Duration;

use clap::Args;
use sbgc_host::{Gimbal, Setpoint};
use sbgc_proto::wire::PerAxis;

use super::limits::{angle, speed};
use super::own::{End, members, own};
use crate::connect::with_board_to_the_end;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, signals, values};

const ANGLE_EXAMPLES: &str = "Examples:
  sbgc control angle --pitch -30 --wait
  sbgc control angle --roll 0 --pitch 10deg --yaw -45 --speed 20";

const SPEED_ANGLE_EXAMPLES: &str = "Examples:
  sbgc control speed-angle --yaw 20 --speed 10
  sbgc control speed-angle --pitch -15 --yaw 5 --speed 30";

const HOME_EXAMPLES: &str = "Examples:
  sbgc control home
  sbgc control home --speed 20 --wait --json";

/// Move to angles; omitted axes are left unchanged
///
/// Prints "accepted" once the board confirms the move, which it then completes; with --wait, "reached" on arrival.
#[derive(Args, Debug)]
#[command(after_help = ANGLE_EXAMPLES)]
pub(super) struct ToAngle {
    #[command(flatten)]
    target: Target,

    /// Speed in degrees per second [default: the board's setting]
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = speed)]
    speed: Option<f32>,

    #[command(flatten)]
    wait: Wait,
}

/// Move to angles at a given speed, corrected to the angle on the way
///
/// Uses the mode SPEED_ANGLE. Prints "accepted" once the board confirms the move; with --wait, "reached" on arrival.
#[derive(Args, Debug)]
#[command(after_help = SPEED_ANGLE_EXAMPLES)]
pub(super) struct SpeedAngle {
    #[command(flatten)]
    target: Target,

    /// Speed in degrees per second; its direction follows from the angle
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = speed)]
    speed: f32,

    #[command(flatten)]
    wait: Wait,
}

/// Move to the home position: level, and yaw to the center
///
/// Prints "accepted" once the board confirms the move, which it then completes; with --wait, "reached" on arrival.
#[derive(Args, Debug)]
#[command(after_help = HOME_EXAMPLES)]
pub(super) struct Home {
    /// Speed in degrees per second [default: the board's setting]
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = speed)]
    speed: Option<f32>,

    #[command(flatten)]
    wait: Wait,
}

#[derive(Args, Debug)]
#[group(id = "axes", required = true, multiple = true)]
struct Target {
    /// Angle of ROLL in degrees
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = angle)]
    roll: Option<f32>,

    /// Angle of PITCH in degrees
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = angle)]
    pitch: Option<f32>,

    /// Angle of YAW in degrees
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = angle)]
    yaw: Option<f32>,
}

#[derive(Args, Debug)]
struct Wait {
    /// Wait for arrival; if anything ends the tool before, the axes stop
    #[arg(long)]
    wait: bool,

    /// Time to wait for arrival
    #[arg(long, requires = "wait", default_value = "30s", value_parser = values::seconds, value_name = "TIME")]
    patience: Duration,
}

impl Target {
    fn axes(&self) -> PerAxis<Option<f32>> {
        PerAxis { roll: self.roll, pitch: self.pitch, yaw: self.yaw }
    }
}

impl ToAngle {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let target = self.target.axes();
        let setpoint = Setpoint::angles(target, self.speed)?;
        let make = async |_: &Gimbal| Ok(setpoint);
        self.wait.carry_out(global, output, "control angle", target, make).await
    }
}

impl SpeedAngle {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let target = self.target.axes();
        let make =
            async |gimbal: &Gimbal| Ok(Setpoint::speed_angle(target, self.speed, &gimbal.angles().await?)?);
        self.wait.carry_out(global, output, "control speed-angle", target, make).await
    }
}

impl Home {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let setpoint = Setpoint::home(self.speed)?;
        let make = async |_: &Gimbal| Ok(setpoint);
        self.wait.carry_out(global, output, "control home", [Some(0.0); 3].into(), make).await
    }
}

impl Wait {
    async fn carry_out(
        self,
        global: &Global,
        output: &mut Output,
        command: &str,
        target: PerAxis<Option<f32>>,
        make: impl AsyncFnOnce(&Gimbal) -> Result<Setpoint, Failure>,
    ) -> Result<(), Failure> {
        with_board_to_the_end(global, async |gimbal, info| {
            let setpoint = make(&gimbal).await?;
            if global.dry_run {
                for frame in setpoint.hand_over_frames(info.firmware_ver)? {
                    act::show_payload(output, gimbal.version(), frame.0, &frame.1)?;
                }
                return Ok(());
            }
            let state = if self.wait {
                let work = async |session: &sbgc_host::ControlSession| {
                    session.move_to(setpoint, self.patience).await?;
                    Ok(End::Hold)
                };
                own(&gimbal, output, work).await?;
                State::Reached
            } else {
                tokio::select! {
                    biased;
                    signal = signals::stopped() => return Err(Failure::Signal(signal)),
                    handed = gimbal.hand_over(setpoint, info.firmware_ver) => handed?,
                }
                State::Accepted
            };
            output.outcome(command, state, members(target), state.as_str())?;
            Ok(())
        })
        .await
    }
}
