//! Looking at the board.

mod angles;
mod info;
mod stream;

use clap::Subcommand;

use crate::args::Global;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Show what the board is: versions, features, ids
    ///
    /// Fields that are 0 are left out of the text; --json has all of them.
    Info(info::Info),
    /// Show where the gimbal points
    Angles(angles::Angles),
    /// Show live data
    ///
    /// Runs until it is interrupted, the output is closed or --count is reached; the stream is then taken from the board.
    #[command(after_help = stream::EXAMPLES)]
    Stream(stream::Stream),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Info(command) => command.run(global, output).await,
            Command::Angles(command) => command.run(global, output).await,
            Command::Stream(command) => command.run(global, output).await,
        }
    }
}
