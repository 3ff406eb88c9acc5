//! Traffic.

mod decode;
mod encode;
mod sim;

use clap::Subcommand;

use crate::args::Global;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Explain captured traffic
    ///
    /// Shows each frame with all its fields, and each run of bytes that are no frame with the cause. What comes through a
    /// pipe is shown as it comes. Answers that only their request explains are read with what was seen before.
    #[command(after_help = decode::EXAMPLES)]
    Decode(decode::Decode),
    /// Make a frame from a command's name and fields
    #[command(after_help = encode::EXAMPLES)]
    Encode(encode::Encode),
    /// Serve a simulated board
    ///
    /// The first line of the output is the port for other programs; it runs until it is stopped.
    #[command(after_help = sim::EXAMPLES)]
    Sim(sim::Sim),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Decode(command) => command.run(output),
            Command::Encode(command) => command.run(global, output),
            Command::Sim(command) => command.run(output).await,
        }
    }
}
