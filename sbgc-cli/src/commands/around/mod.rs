//! The tool itself: its settings, completions for shells, its manual.

mod completions;
mod config;
mod man;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Config(config::Config),
    Completions(completions::Completions),
    Man(man::Man),
}

impl Command {
    #[allow(clippy::unused_async, reason = "groups are alike")]
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Config(command) => command.run(global, output),
            Command::Completions(command) => command.run(output),
            Command::Man(command) => command.run(global, output),
        }
    }
}
