//! Arguments that all subcommands share.

use std::time::Duration;

use clap::{Args, Parser, ValueEnum};

use crate::commands::Command;

/// Talk to SimpleBGC32 camera gimbals.
///
/// The port is a serial device, `tcp://HOST:PORT`, or `sim`, a simulated board inside the program.
#[derive(Debug, Parser)]
#[command(name = "sbgc", version, arg_required_else_help = true, propagate_version = true, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,

    #[command(flatten)]
    pub(crate) global: Global,
}

const EXIT_CODES: &str = "Examples:
  sbgc --port /dev/ttyUSB0 info
  sbgc --port tcp://gimbal.local:4001 control angle --pitch -30 --wait
  sbgc --port sim stream --json | head -3
  sbgc decode capture.bin

Without --port the only USB serial port is taken. Results go to standard output, all else to standard error.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 no answer from a board, \
    4 the board refused, 5 not carried out because it was not confirmed.";

#[derive(Args, Debug)]
#[command(next_help_heading = "Options of all commands")]
pub(crate) struct Global {
    /// Serial device (path or name), tcp://HOST:PORT, or sim
    #[arg(long, short, global = true, env = "SBGC_PORT", value_name = "PORT")]
    pub(crate) port: Option<String>,

    /// Bits a second of a serial port
    #[arg(long, global = true, default_value_t = 115_200, value_parser = clap::value_parser!(u32).range(300..=4_000_000), value_name = "BAUD")]
    pub(crate) baud: u32,

    /// Version of the framing
    #[arg(long, global = true, value_enum, default_value_t, value_name = "VERSION")]
    pub(crate) protocol: Protocol,

    /// How long to wait for an answer, in milliseconds
    #[arg(long, global = true, default_value_t = 500, value_parser = clap::value_parser!(u64).range(1..=600_000), value_name = "MS")]
    pub(crate) timeout: u64,

    /// Print JSON, one object a line
    #[arg(long, global = true)]
    pub(crate) json: bool,

    /// Say on standard error what passed the link, counted; twice for every frame
    #[arg(long, short, global = true, action = clap::ArgAction::Count)]
    pub(crate) verbose: u8,
}

impl Global {
    pub(crate) fn timeout(&self) -> Duration {
        Duration::from_millis(self.timeout)
    }
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum Protocol {
    /// Version 2, and version 1 for a board that does not answer it
    #[default]
    Auto,
    /// Version 1, for firmware before 2.68
    #[value(name = "1")]
    V1,
    /// Version 2
    #[value(name = "2")]
    V2,
}
