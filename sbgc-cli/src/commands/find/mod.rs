//! Finding the board, and why it is not found.

mod detect;
mod doctor;
mod ports;
mod probe;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Ports(ports::Ports),
    Detect(detect::Detect),
    Doctor(doctor::Doctor),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Ports(command) => command.run(output),
            Command::Detect(command) => command.run(global, output).await,
            Command::Doctor(command) => command.run(global, output).await,
        }
    }
}
