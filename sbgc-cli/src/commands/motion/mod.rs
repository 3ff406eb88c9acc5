//! Motion.

mod control;
mod menu;
mod motors;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Control(control::Control),
    Motors(motors::Motors),
    Menu(menu::Menu),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Control(command) => command.run(global, output).await,
            Command::Motors(command) => command.run(global, output).await,
            Command::Menu(command) => command.run(global, output).await,
        }
    }
}
