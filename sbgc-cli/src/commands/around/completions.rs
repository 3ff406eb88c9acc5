//! `sbgc completions`: what shells complete.

use clap::{Args, ValueEnum};
use clap_complete::env::Shells;

use crate::failure::Failure;
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc completions bash
  sbgc completions zsh > ~/.sbgc.zsh
  sbgc completions fish

Load them with `source <(sbgc completions bash)`, for example in ~/.bashrc.";

/// Print completions for a shell
///
/// The shell asks sbgc for candidates, so ports are those that are plugged in and names are those of this version.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Completions {
    /// Shell
    #[arg(value_enum)]
    shell: Shell,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Shell {
    Bash,
    Elvish,
    Fish,
    #[value(name = "powershell")]
    Pwsh,
    Zsh,
}

impl Completions {
    pub(crate) fn run(self, output: &mut Output) -> Result<(), Failure> {
        let name =
            self.shell.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
        let shells = Shells::builtins();
        let completer = shells
            .completer(&name)
            .ok_or_else(|| Failure::Failed(format!("no completions for {name} in this build")))?;
        completer.write_registration("COMPLETE", "sbgc", "sbgc", "sbgc", output.writer())?;
        Ok(())
    }
}
