//! The commands, one file each, in folders by the groups in which `sbgc --help` lists them.
//!
//! A new command is a file in its group's folder and a variant of the group's `Command`:
//!
//! ```ignore
//! //! `sbgc blink`: lets a lamp of the board blink.
//!
//! pub(super) const EXAMPLES: &str = "Examples:        // two or three, each works as printed with --port sim
//!   sbgc blink
//!   sbgc blink --for 2s --json";
//!
//! /// Blink a lamp of the board                       // one line, imperative; the list of commands shows it
//! #[derive(Args, Debug)]
//! #[command(after_help = EXAMPLES)]
//! pub(crate) struct Blink {
//!     /// Time to blink
//!     #[arg(long = "for", value_name = "TIME", value_parser = values::seconds, default_value = "1s")]
//!     time: Duration,
//! }
//!
//! impl Blink {
//!     pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
//!         with_board(global, async |gimbal, _info| {
//!             // Prints the frame with --dry-run. What is dangerous calls `act::ask` first, unless it is a dry run.
//!             if act::confirm(global, output, &gimbal, &Command { .. }).await?.is_some() {
//!                 output.outcome("blink", State::Done, json!({"times": 2}), "blinked twice")?;
//!             }
//!             Ok(())
//!         })
//!         .await
//!     }
//! }
//! ```
//!
//! - Data goes to [`Output`], everything else to [`talk::say`](crate::talk::say), never to `println!` or `eprintln!`,
//!   which panic when nobody can read them. Text from a board goes through [`text::escape`](crate::text::escape).
//! - Numbers are read by [`values`](crate::values), with `allow_hyphen_values` where they may be negative. A name that
//!   is none gets [`text::unknown`](crate::text::unknown) in a [`Failure::Usage`].
//! - A signal drops the work in `with_board`; then streams are unregistered and the port is closed. Where being
//!   stopped is the usual end, the result goes through [`until_stopped`](crate::failure::until_stopped). Work that
//!   has more to clean up uses `with_board_to_the_end`, and work without a board that reads or computes for long runs
//!   in [`signals::blocking`](crate::signals::blocking).

mod around;
mod calibration;
mod device;
mod find;
mod look;
mod motion;
mod parameters;
mod storage;
mod traffic;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    #[command(flatten)]
    Find(find::Command),
    #[command(flatten)]
    Look(look::Command),
    #[command(flatten)]
    Parameters(parameters::Command),
    #[command(flatten)]
    Motion(motion::Command),
    #[command(flatten)]
    Calibration(calibration::Command),
    #[command(flatten)]
    Storage(storage::Command),
    #[command(flatten)]
    Device(device::Command),
    #[command(flatten)]
    Traffic(traffic::Command),
    #[command(flatten)]
    Around(around::Command),
}

impl Command {
    /// Carries out the command.
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Find(command) => command.run(global, output).await,
            Command::Look(command) => command.run(global, output).await,
            Command::Parameters(command) => command.run(global, output).await,
            Command::Motion(command) => command.run(global, output).await,
            Command::Calibration(command) => command.run(global, output).await,
            Command::Storage(command) => command.run(global, output).await,
            Command::Device(command) => command.run(global, output).await,
            Command::Traffic(command) => command.run(global, output).await,
            Command::Around(command) => command.run(global, output).await,
        }
    }
}

/// The groups as help lists them: a word for each, and its commands.
pub(crate) fn groups() -> [(&'static str, clap::Command); 9] {
    let empty = || clap::Command::new("sbgc");
    [
        ("Find", find::Command::augment_subcommands(empty())),
        ("Look", look::Command::augment_subcommands(empty())),
        ("Parameters", parameters::Command::augment_subcommands(empty())),
        ("Motion", motion::Command::augment_subcommands(empty())),
        ("Calibrate", calibration::Command::augment_subcommands(empty())),
        ("Storage", storage::Command::augment_subcommands(empty())),
        ("Device", device::Command::augment_subcommands(empty())),
        ("Traffic", traffic::Command::augment_subcommands(empty())),
        ("Around", around::Command::augment_subcommands(empty())),
    ]
}
