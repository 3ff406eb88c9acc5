//! `sbgc control`: moving the gimbal.
//!
//! Moves that are handed over are in [`turn`], together with the same moves when they are waited for; motion that is
//! kept up is in [`drive`], and by keys in [`jog`]. What both share, owning the motion until something ends it, is in [`own`].

mod drive;
mod jog;
mod limits;
mod own;
mod stop;
mod turn;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use clap::{Args, Subcommand};

const EXAMPLES: &str = "Examples:
  sbgc control angle --pitch -30 --wait
  sbgc control speed --yaw 15 --for 2s
  sbgc control stop";

/// Move the gimbal
///
/// `angle`, `speed-angle` and `home` hand the move over to the board, which completes it. With --wait, and with
/// `speed`, `rc` and `jog`, the tool owns the motion: however it ends, the axes that it moved stop. If it is
/// killed, the board's own time-out stops them after one second.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Control {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Angle(turn::ToAngle),
    Speed(drive::Speed),
    SpeedAngle(turn::SpeedAngle),
    Rc(drive::Rc),
    Home(turn::Home),
    Stop(stop::Stop),
    Jog(jog::Jog),
}

impl Control {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Angle(command) => command.run(global, output).await,
            What::Speed(command) => command.run(global, output).await,
            What::SpeedAngle(command) => command.run(global, output).await,
            What::Rc(command) => command.run(global, output).await,
            What::Home(command) => command.run(global, output).await,
            What::Stop(command) => command.run(global, output).await,
            What::Jog(command) => command.run(global, output).await,
        }
    }
}
