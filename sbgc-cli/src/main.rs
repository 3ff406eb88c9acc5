//! `sbgc`: parameters, control, data streams and captures of SimpleBGC32 gimbals from the command line.
//!
//! Each subcommand is a file of [`commands`]: its arguments and what it does with them. What the protocol means is
//! known to `sbgc-proto` and `sbgc-host` only; here are arguments, output and exit codes.

mod args;
mod commands;
mod connect;
mod failure;
mod fields;
mod output;
mod signals;
mod table;

use std::io::IsTerminal as _;
use std::process::ExitCode;

use clap::Parser as _;

use crate::args::Arguments;
use crate::failure::Failure;
use crate::output::Output;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    log_to_stderr(arguments.global.verbose);
    let mut output = Output::new(arguments.global.json);
    let result = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|source| Failure::File { place: String::from("starting up"), source })
        .and_then(|runtime| runtime.block_on(commands::run(arguments, &mut output)));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Talk goes to standard error, so that standard output holds data alone.
fn log_to_stderr(verbose: u8) {
    let level = match verbose {
        // What goes wrong is said when the command fails, and once is enough.
        0 => tracing::Level::ERROR,
        1 => tracing::Level::INFO,
        2 => tracing::Level::DEBUG,
        _ => tracing::Level::TRACE,
    };
    tracing_subscriber::fmt()
        .with_max_level(level)
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .with_target(false)
        .with_timer(tracing_subscriber::fmt::time::uptime())
        .init();
}
