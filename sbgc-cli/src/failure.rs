//! What ends a command, the exit code for it, and what a person may do about it.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use sbgc_host::Error;

use crate::args::Protocol;

/// Why a command was not carried out.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Something that the arguments name does not exist or does not fit.
    #[error("{0}")]
    Usage(String),

    /// Files and pipes.
    #[error("{place}: {source}")]
    File { place: String, source: io::Error },

    /// What the program prints.
    #[error("standard output: {0}")]
    Output(#[from] io::Error),

    /// Nobody answers.
    #[error("no board found on {place}, {} tried: {source}", versions(*.protocol))]
    NoBoard { place: String, protocol: Protocol, source: Error },

    /// The board, or the way to it.
    #[error(transparent)]
    Host(#[from] Error),

    /// A capture that is not what it should be.
    #[error(transparent)]
    Capture(#[from] sbgc_host::capture::ReadError),
}

fn versions(protocol: Protocol) -> &'static str {
    match protocol {
        Protocol::Auto => "versions 2 and 1",
        Protocol::V1 => "version 1",
        Protocol::V2 => "version 2",
    }
}

impl Failure {
    /// Prints the failure and returns the exit code.
    pub(crate) fn report(self) -> ExitCode {
        if let Failure::Output(error) = &self {
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
        match self {
            Failure::Usage(_) => 2,
            Failure::NoBoard { .. } | Failure::Host(Error::Timeout { .. }) => 3,
            Failure::Host(Error::Refused { .. }) => 4,
            _ => 1,
        }
    }

    fn hint(&self) -> Option<String> {
        match self {
            Failure::NoBoard { protocol, .. } => {
                let version = match protocol {
                    Protocol::Auto => "",
                    Protocol::V1 => {
                        "A board that has seen version 2 takes nothing else until it restarts: leave out --protocol. "
                    }
                    Protocol::V2 => "Firmware before 2.68 knows version 1 only: leave out --protocol. ",
                };
                Some(format!("{version}Another rate is set with --baud; -vv shows every frame."))
            }
            Failure::Host(Error::PermissionDenied { path, group }) => permission_hint(path, group.as_deref()),
            _ => None,
        }
    }
}

/// How to get access to a device; nothing for what is no serial port of the machine.
fn permission_hint(path: &Path, group: Option<&str>) -> Option<String> {
    let device = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let name = device.file_name().unwrap_or_default().to_string_lossy();
    let join = group.map(|group| format!("Join it: sudo usermod -aG {group} $USER, then log in anew."));
    let kernel = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let udev = kernel.starts_with("tty").then(|| {
        let group = group.unwrap_or("dialout");
        format!(
            "{} udev give it to whoever sits at the machine, with this line in /etc/udev/rules.d/60-sbgc.rules:\n\
             SUBSYSTEM==\"tty\", KERNEL==\"{kernel}[0-9]*\", GROUP=\"{group}\", MODE=\"0660\", TAG+=\"uaccess\"",
            if join.is_some() { "Or let" } else { "Let" },
        )
    });
    let lines: Vec<_> = join.into_iter().chain(udev).collect();
    (!lines.is_empty()).then(|| lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn access_is_explained_for_serial_ports() {
        let hint = permission_hint(Path::new("/dev/ttyUSB7"), Some("dialout")).unwrap();
        assert!(hint.starts_with("Join it: sudo usermod -aG dialout $USER"), "{hint}");
        assert!(hint.contains("Or let udev") && hint.contains("KERNEL==\"ttyUSB[0-9]*\""), "{hint}");
        let hint = permission_hint(Path::new("/dev/ttyACM0"), None).unwrap();
        assert!(hint.starts_with("Let udev") && hint.contains("GROUP=\"dialout\""), "{hint}");
        assert_eq!(permission_hint(Path::new("/dev/pts/0"), None), None);
    }
}
