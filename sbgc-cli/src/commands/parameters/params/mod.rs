//! `sbgc params`: parameters of the board by name.

mod diff;
mod dump;
mod read;
mod restore;
mod set;

use clap::{Args, Subcommand};

pub(super) use self::set::settings;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc params get motors.pitch RC_MEMORY
  sbgc params set rc_memory.pitch=-30deg --yes
  sbgc params diff profile:1 profile:2";

/// Read, compare and write parameters
///
/// A parameter is named by its path (rc_memory.pitch), the specification's name (RC_MEMORY), an ending that no other
/// path has (pitch.poles), a beginning up to a dot (motors.pitch), or a pattern with * over the whole path (*lpf*).
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Params {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    List(read::List),
    Get(read::Get),
    Describe(read::Describe),
    Set(set::Set),
    Dump(dump::Dump),
    Diff(diff::Diff),
    Restore(restore::Restore),
}

impl Params {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::List(command) => command.run(global, output).await,
            What::Get(command) => command.run(global, output).await,
            What::Describe(command) => command.run(output),
            What::Set(command) => command.run(global, output).await,
            What::Dump(command) => command.run(global, output).await,
            What::Diff(command) => command.run(global, output).await,
            What::Restore(command) => command.run(global, output).await,
        }
    }
}
