//! Calibrating and tuning.

mod calibrate;
mod runner;
mod tune;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Calibrate(calibrate::Calibrate),
    Tune(tune::Tune),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Calibrate(command) => command.run(global, output).await,
            Command::Tune(command) => command.run(global, output).await,
        }
    }
}
