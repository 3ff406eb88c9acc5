//! `sbgc man`: the manual.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc man
  sbgc man stream
  sbgc man --dir ./man1

Read a page with `sbgc man stream | man -l -`.";

/// Print the manual in roff
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Man {
    /// Command to print the page of, such as `stream` or `params get` [default: sbgc itself]
    #[arg(value_name = "COMMAND")]
    path: Vec<String>,

    /// Write the pages of all commands into this directory
    #[arg(long, value_name = "DIR", conflicts_with = "path")]
    dir: Option<PathBuf>,
}

impl Man {
    pub(crate) fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let mut interface = (global.interface)().mut_args(|argument| argument.hide(false));
        if let Some(directory) = &self.dir {
            fs::create_dir_all(directory).map_err(|source| failed(directory, source))?;
            return write_all(interface, "sbgc", directory, true);
        }
        let mut name = String::from("sbgc");
        for part in &self.path {
            let names: Vec<_> = interface.get_subcommands().map(clap::Command::get_name).collect();
            let unknown = crate::text::unknown("command", part, names);
            interface = interface.find_subcommand(part).cloned().ok_or(Failure::Usage(unknown))?;
            name = format!("{name}-{part}");
        }
        clap_mangen::Man::new(named(interface, &name)).render(output.writer())?;
        Ok(())
    }
}

fn named(command: clap::Command, name: &str) -> clap::Command {
    let words = name.replace('-', " ");
    command.name(name.to_owned()).bin_name(words).version(env!("CARGO_PKG_VERSION"))
}

fn write_all(command: clap::Command, name: &str, directory: &Path, top: bool) -> Result<(), Failure> {
    for part in command.get_subcommands() {
        write_all(part.clone(), &format!("{name}-{}", part.get_name()), directory, false)?;
    }
    let path = directory.join(format!("{name}.1"));
    let page = if top { command } else { named(command, name) };
    let mut bytes = Vec::new();
    clap_mangen::Man::new(page).render(&mut bytes)?;
    fs::write(&path, bytes).map_err(|source| failed(&path, source))
}

fn failed(path: &Path, source: std::io::Error) -> Failure {
    Failure::File { place: path.display().to_string(), source }
}
