//! Motion.

mod control;
mod motors;

use clap::Subcommand;

use crate::args::Global;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Move the gimbal
    Control(control::Control),
    /// Switch the motors
    Motors(motors::Motors),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Control(command) => command.run(global, output).await,
            Command::Motors(command) => command.run(global, output).await,
        }
    }
}
