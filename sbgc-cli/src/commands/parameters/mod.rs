//! Parameters, profiles and adjustable variables.

mod adj;
mod arguments;
mod change;
mod document;
mod params;
mod profile;
mod show;
mod source;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Params(params::Params),
    Profile(profile::ProfileArgs),
    Adj(adj::Adj),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Params(command) => command.run(global, output).await,
            Command::Profile(command) => command.run(global, output).await,
            Command::Adj(command) => command.run(global, output).await,
        }
    }
}
