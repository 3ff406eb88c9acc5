//! `sbgc control speed` and `rc`: motion that is kept up until it is ended.

use std::time::Duration;

use clap::Args;
use sbgc_host::{ControlSession, Setpoint};
use sbgc_proto::wire::PerAxis;

use super::limits::rate;
use super::own::{End, members, own};
use crate::connect::with_board_to_the_end;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, values};

const SPEED_EXAMPLES: &str = "Examples:
  sbgc control speed --yaw 15 --for 2s
  sbgc control speed --pitch -2.5 --roll 1deg/s --for 500ms --json";

const RC_EXAMPLES: &str = "Examples:
  sbgc control rc --pitch 100 --for 2s
  sbgc control rc --yaw -250 --for 500ms --json";

/// Turn at speeds; omitted axes are left unchanged
///
/// Runs until interrupted, or for the time of --for. Then the axes stop, and control goes back to the board.
#[derive(Args, Debug)]
#[command(after_help = SPEED_EXAMPLES)]
pub(super) struct Speed {
    #[command(flatten)]
    speeds: Speeds,

    /// Time after which the axes stop [default: until interrupted]
    #[arg(long = "for", value_name = "TIME", value_parser = values::seconds)]
    time: Option<Duration>,
}

#[derive(Args, Debug)]
#[group(id = "speeds", required = true, multiple = true)]
struct Speeds {
    /// Speed of ROLL in degrees per second
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = rate)]
    roll: Option<f32>,

    /// Speed of PITCH in degrees per second
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = rate)]
    pitch: Option<f32>,

    /// Speed of YAW in degrees per second
    #[arg(long, allow_hyphen_values = true, value_name = "DEG/S", value_parser = rate)]
    yaw: Option<f32>,
}

/// Replace the sticks of the radio control
///
/// The board's RC settings determine what a signal does. Runs until interrupted, or for the time of --for.
/// Then the axes stop, and control goes back to the board.
#[derive(Args, Debug)]
#[command(after_help = RC_EXAMPLES)]
pub(super) struct Rc {
    #[command(flatten)]
    signals: Signals,

    /// Time after which the axes stop [default: until interrupted]
    #[arg(long = "for", value_name = "TIME", value_parser = values::seconds)]
    time: Option<Duration>,
}

#[derive(Args, Debug)]
#[group(id = "signals", required = true, multiple = true)]
struct Signals {
    /// Signal for ROLL, -500 to 500
    #[arg(long, allow_hyphen_values = true, value_name = "SIGNAL", value_parser = signal)]
    roll: Option<f32>,

    /// Signal for PITCH, -500 to 500
    #[arg(long, allow_hyphen_values = true, value_name = "SIGNAL", value_parser = signal)]
    pitch: Option<f32>,

    /// Signal for YAW, -500 to 500
    #[arg(long, allow_hyphen_values = true, value_name = "SIGNAL", value_parser = signal)]
    yaw: Option<f32>,
}

fn signal(text: &str) -> Result<f32, String> {
    let value: f32 = text.trim().parse().map_err(|_| format!("expected a number, got \"{text}\""))?;
    let range = -500.0..=500.0;
    if range.contains(&value) {
        Ok(value)
    } else {
        Err(format!("{text} is out of range; expected -500 to 500"))
    }
}

impl Speed {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let Speeds { roll, pitch, yaw } = self.speeds;
        let speeds = PerAxis { roll, pitch, yaw };
        keep_up(global, output, "control speed", Setpoint::speeds(speeds)?, speeds, self.time).await
    }
}

impl Rc {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let Signals { roll, pitch, yaw } = self.signals;
        let signals = PerAxis { roll, pitch, yaw };
        keep_up(global, output, "control rc", Setpoint::rc(signals)?, signals, self.time).await
    }
}

async fn keep_up(
    global: &Global,
    output: &mut Output,
    command: &str,
    setpoint: Setpoint,
    values: PerAxis<Option<f32>>,
    time: Option<Duration>,
) -> Result<(), Failure> {
    with_board_to_the_end(global, async |gimbal, info| {
        if global.dry_run {
            let (id, payload) = setpoint.frame(info.firmware_ver)?;
            return act::show_payload(output, gimbal.version(), id, &payload);
        }
        let work = async |session: &ControlSession| {
            session.apply(setpoint).await?;
            match time {
                Some(time) => tokio::time::sleep(time).await,
                None => std::future::pending().await,
            }
            Ok(End::Stop)
        };
        let ended = own(&gimbal, output, work).await;
        let state = match &ended {
            Ok(()) => State::Done,
            Err(Failure::Signal(_)) => State::Stopped,
            Err(_) => return ended,
        };
        output.outcome(command, state, members(values), state.as_str())?;
        ended
    })
    .await
}
