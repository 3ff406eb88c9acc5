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
    ///
    /// Fields that are 0 are left out of the text; --json has all of them.
    Info(info::Info),
    /// Show where the gimbal points
    Angles(angles::Angles),
    /// Move the gimbal
    Control(control::Control),
    /// Switch the motors
    Motors(motors::Motors),
    /// Show live data
    ///
    /// Runs until it is interrupted, the output is closed or --count is reached; the stream is then taken from the board.
    #[command(after_help = stream::EXAMPLES)]
    Stream(stream::Stream),
    /// Read parameters
    #[command(after_help = params::EXAMPLES)]
    Params(params::Params),
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
