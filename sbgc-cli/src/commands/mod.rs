//! The subcommands, one file each: arguments and what is done with them.

mod angles;
mod control;
mod decode;
mod encode;
mod info;
mod motors;
mod params;
mod sim;
mod stream;

use clap::Subcommand;

use crate::args::Arguments;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Show what the board is: versions, features, ids
    Info(info::Info),
    /// Show where the gimbal points
    Angles(angles::Angles),
    /// Move the gimbal
    Control(control::Control),
    /// Switch the motors
    Motors(motors::Motors),
    /// Show live data
    Stream(stream::Stream),
    /// Read parameters
    Params(params::Params),
    /// Explain captured traffic
    Decode(decode::Decode),
    /// Make a frame from a command's name and fields
    Encode(encode::Encode),
    /// Serve a simulated board
    Sim(sim::Sim),
}

/// Carries out the command that was asked for.
pub(crate) async fn run(arguments: Arguments, output: &mut Output) -> Result<(), Failure> {
    let global = &arguments.global;
    match arguments.command {
        Command::Info(command) => command.run(global, output).await,
        Command::Angles(command) => command.run(global, output).await,
        Command::Control(command) => command.run(global, output).await,
        Command::Motors(command) => command.run(global, output).await,
        Command::Stream(command) => command.run(global, output).await,
        Command::Params(command) => command.run(global, output).await,
        Command::Decode(command) => command.run(output),
        Command::Encode(command) => command.run(global, output),
        Command::Sim(command) => command.run(output).await,
    }?;
    output.flush()?;
    Ok(())
}
