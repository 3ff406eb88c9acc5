//! Looking at the board.

mod angles;
mod debug_vars;
mod events;
mod info;
mod monitor;
mod plot;
mod stream;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Info(info::Info),
    Angles(angles::Angles),
    Stream(stream::Stream),
    Events(events::Events),
    DebugVars(debug_vars::DebugVars),
    Monitor(monitor::Monitor),
    Plot(plot::Plot),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Info(command) => command.run(global, output).await,
            Command::Angles(command) => command.run(global, output).await,
            Command::Stream(command) => command.run(global, output).await,
            Command::Events(command) => command.run(global, output).await,
            Command::DebugVars(command) => command.run(global, output).await,
            Command::Monitor(command) => command.run(global).await,
            Command::Plot(command) => command.run(),
        }
    }
}
