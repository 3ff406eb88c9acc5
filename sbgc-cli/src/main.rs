//! `sbgc`: parameters, control, data streams and captures of SimpleBGC32 gimbals from the command line.
//!
//! Each command is a file of [`commands`]: its arguments, one call of `sbgc-host`, what to print. What the protocol
//! means is known to `sbgc-proto` and `sbgc-host` only. Modules use those before them in this list only:
//!
//! ```text
//! talk · text · values · places · signals · failure  standard error, text, numbers with units, what ends a command
//! config_file · options                              the common options and where their values come from
//! output · files · progress                          printing, whole files, bars
//! act · connect                                      asking, dry run; a gimbal that responds
//! fields · table · sampling · samples                messages as text, JSON and columns; data streams
//! commands                                           one file each, in folders by group
//! cli · main                                         the command line as a whole
//! ```

mod act;
mod cli;
mod commands;
mod config_file;
mod connect;
mod failure;
mod fields;
mod files;
mod line;
mod options;
mod output;
mod places;
mod progress;
mod samples;
mod sampling;
mod signals;
mod table;
mod talk;
mod text;
mod values;

use std::io::IsTerminal as _;
use std::process::ExitCode;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

fn main() -> ExitCode {
    // A shell asks for completions by running the program with this variable.
    if std::env::var_os("COMPLETE").is_some() {
        clap_complete::CompleteEnv::with_factory(cli::interface).complete();
    }
    let (command, global) = match cli::parse() {
        Ok(parsed) => parsed,
        Err(code) => return code,
    };
    signals::install();
    log_to_stderr(&global);
    let mut output = Output::new(&global);
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let result = match runtime {
        Ok(runtime) => {
            let result = runtime.block_on(command.run(&global, &mut output));
            // Nothing that reads a terminal or a file holds up the end.
            runtime.shutdown_background();
            result
        }
        Err(source) => Err(Failure::File { place: String::from("starting up"), source }),
    };
    let flushed = output.flush();
    match result.and_then(|()| flushed.map_err(Failure::Output)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(global.json),
    }
}

/// Diagnostics go to standard error, so that standard output holds data alone.
fn log_to_stderr(global: &Global) {
    let level = match global.verbose {
        // What goes wrong is said when the command fails, and once is enough.
        0 => tracing::Level::ERROR,
        1 => tracing::Level::INFO,
        2 => tracing::Level::DEBUG,
        _ => tracing::Level::TRACE,
    };
    tracing_subscriber::fmt()
        .with_max_level(level)
        .with_writer(|| talk::Talk)
        .with_ansi(global.color.is_on(std::io::stderr().is_terminal()))
        .with_target(false)
        .with_timer(tracing_subscriber::fmt::time::uptime())
        .log_internal_errors(false)
        .init();
}
