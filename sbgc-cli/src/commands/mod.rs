//! The subcommands, one file each, in folders by the groups in which `sbgc --help` lists them.

mod look;
mod motion;
mod parameters;
mod traffic;

use clap::Subcommand;

use crate::args::Arguments;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    #[command(flatten)]
    Look(look::Command),
    #[command(flatten)]
    Parameters(parameters::Command),
    #[command(flatten)]
    Motion(motion::Command),
    #[command(flatten)]
    Traffic(traffic::Command),
}

/// Carries out the command that was asked for.
pub(crate) async fn run(arguments: Arguments, output: &mut Output) -> Result<(), Failure> {
    let global = &arguments.global;
    match arguments.command {
        Command::Look(command) => command.run(global, output).await,
        Command::Parameters(command) => command.run(global, output).await,
        Command::Motion(command) => command.run(global, output).await,
        Command::Traffic(command) => command.run(global, output).await,
    }?;
    output.flush()?;
    Ok(())
}
