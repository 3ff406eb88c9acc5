//! Parameters.

mod params;

use clap::Subcommand;

use crate::args::Global;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Read parameters
    #[command(after_help = params::EXAMPLES)]
    Params(params::Params),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Params(command) => command.run(global, output).await,
        }
    }
}
