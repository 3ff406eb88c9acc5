//! What ends a command, the exit code for it, and what a person may do about it.

use std::io;
use std::process::ExitCode;

use thiserror::Error;

/// Why a command was not carried out.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// Something that the arguments name does not exist or does not fit.
    #[error("{0}")]
    Usage(String),

    /// Files and pipes.
    #[error("{place}: {source}")]
    File { place: String, source: io::Error },

    /// The program's own input and output.
    #[error(transparent)]
    Io(#[from] io::Error),

    /// The board, or the way to it.
    #[error(transparent)]
    Host(#[from] sbgc_host::Error),

    /// A capture that is not what it should be.
    #[error(transparent)]
    Capture(#[from] sbgc_host::capture::ReadError),
}

impl Failure {
    /// Prints the failure and returns the exit code.
    pub(crate) fn report(self) -> ExitCode {
        if let Failure::Io(error) = &self {
            // Whoever read the output has had enough.
            if error.kind() == io::ErrorKind::BrokenPipe {
                return ExitCode::SUCCESS;
            }
        }
        eprintln!("sbgc: {self}");
        if let Some(hint) = self.hint() {
            eprintln!("{hint}");
        }
        ExitCode::from(self.code())
    }

    fn code(&self) -> u8 {
        use sbgc_host::Error;
        match self {
            Failure::Usage(_) => 2,
            Failure::Host(Error::Timeout { .. }) => 3,
            Failure::Host(Error::Refused { .. }) => 4,
            _ => 1,
        }
    }

    fn hint(&self) -> Option<String> {
        use sbgc_host::Error;
        match self {
            Failure::Host(Error::Timeout { .. }) => Some(String::from(
                "Is the board powered, is this its port, and does nothing else hold the port? Try --baud with another \
                 rate, or --protocol 1 for firmware before 2.68; -vv shows every frame.",
            )),
            Failure::Host(Error::PermissionDenied { path, group }) => {
                Some(permission_hint(path, group.as_deref()))
            }
            _ => None,
        }
    }
}

fn permission_hint(path: &std::path::Path, group: Option<&str>) -> String {
    let join = match group {
        Some(group) => {
            format!("Join the group that owns it: sudo usermod -aG {group} $USER, then log in anew.\n")
        }
        None => String::new(),
    };
    let group = group.unwrap_or("dialout");
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let kernel = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    format!(
        "{join}Or let udev give it to everyone at the machine, with this line in /etc/udev/rules.d/60-sbgc.rules:\n\
         SUBSYSTEM==\"tty\", KERNEL==\"{kernel}[0-9]*\", GROUP=\"{group}\", MODE=\"0660\", TAG+=\"uaccess\"",
    )
}
