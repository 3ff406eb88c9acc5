//! What ends a command, the exit code for it, and what a person may do about it.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use sbgc_host::Error;
use sbgc_host::params::{NameError, ParamsError};
use serde_json::json;

use crate::signals::Signal;
use crate::{talk, text};

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

    /// No board on any of several ports.
    #[error("{0}")]
    NotFound(String),

    /// What a diagnosis has shown already stands for this exit code.
    #[error("problems were found")]
    Found(u8),

    /// The board, or the way to it.
    #[error(transparent)]
    Host(#[from] Error),

    /// Parameters, or what became of writing them.
    #[error(transparent)]
    Params(Box<ParamsError>),

    /// What was compared differs; that was printed, and nothing is wrong.
    #[error("there are differences")]
    Differs,

    /// A capture that is not what it should be.
    #[error(transparent)]
    Capture(#[from] sbgc_host::capture::ReadError),

    /// Nobody has said yes.
    #[error("{0}")]
    NotConfirmed(String),

    /// The program was asked to stop.
    #[error("stopped by {0}")]
    Signal(Signal),

    /// Anything else that was tried and did not work.
    #[error("{0}")]
    Failed(String),
}

impl Failure {
    /// Prints the failure and returns the exit code.
    pub(crate) fn report(self, json: bool) -> ExitCode {
        match &self {
            // Whoever read the output has had enough.
            Failure::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => return ExitCode::SUCCESS,
            // Who stops a program knows that it stopped.
            Failure::Signal(_) if !json => {}
            Failure::Differs | Failure::Found(_) => {}
            _ if json => {
                let (kind, message, code) = (self.kind(), self.to_string(), self.code());
                talk::say(text::json(&json!({"error": {"kind": kind, "message": message, "code": code}})));
            }
            _ => {
                talk::say(format_args!("sbgc: {}", text::escape_lines(&self.to_string())));
                if let Some(hint) = self.hint() {
                    talk::say(hint);
                }
            }
        }
        ExitCode::from(self.code())
    }

    /// The name under which programs know it.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Failure::Usage(_) => "usage",
            Failure::File { .. } => "file",
            Failure::Output(_) => "output",
            Failure::NotFound(_) => "no_answer",
            Failure::Host(error) => host(error).0,
            Failure::Params(error) => params(error).0,
            Failure::Capture(_) => "capture",
            Failure::NotConfirmed(_) => "not_confirmed",
            Failure::Signal(_) => "signal",
            Failure::Failed(_) | Failure::Differs | Failure::Found(_) => "failed",
        }
    }

    /// The exit code.
    pub(crate) fn code(&self) -> u8 {
        match self {
            Failure::Usage(_) => 2,
            Failure::NotFound(_) => 3,
            Failure::Host(error) => host(error).1,
            Failure::Params(error) => params(error).1,
            Failure::NotConfirmed(_) => 5,
            Failure::Found(code) => *code,
            Failure::Signal(signal) => signal.code(),
            _ => 1,
        }
    }

    /// What a person may do about it.
    pub(crate) fn hint(&self) -> Option<String> {
        match self {
            Failure::Host(Error::Silent { version, .. }) => {
                let general =
                    "`sbgc doctor` looks for the cause; --baud sets another rate, -vv shows every frame.";
                let of_version = match version {
                    Some(1) => {
                        "A board that has seen version 2 takes nothing else until it restarts: omit --protocol. "
                    }
                    Some(_) => "Firmware before 2.68 knows version 1 only: omit --protocol. ",
                    None => "",
                };
                Some(format!("{of_version}{general}"))
            }
            Failure::Host(Error::OtherProtocol { .. }) => Some(
                "The rate may be another one: --baud auto tries all. `sbgc doctor` looks for the cause."
                    .into(),
            ),
            Failure::Host(Error::PermissionDenied { path, group }) => permission_hint(path, group.as_deref()),
            _ => None,
        }
    }
}

/// Kind and exit code of what a board or the way to it says.
fn host(error: &Error) -> (&'static str, u8) {
    match error {
        // What was typed.
        Error::BadAddress { .. }
        | Error::OutOfRange { .. }
        | Error::Misaligned { .. }
        | Error::FileSize { .. }
        | Error::BadNote { .. } => ("usage", 2),
        Error::Timeout { .. } | Error::Silent { .. } | Error::OtherProtocol { .. } => ("no_answer", 3),
        Error::Refused { .. } => ("refused", 4),
        Error::Io(_)
        | Error::Open { .. }
        | Error::Disconnected
        | Error::NoSuchPort { .. }
        | Error::PermissionDenied { .. }
        | Error::PortBusy { .. }
        | Error::NotBuilt { .. } => ("port", 1),
        _ => ("failed", 1),
    }
}

/// Kind and exit code of what went wrong with parameters.
fn params(error: &ParamsError) -> (&'static str, u8) {
    match (error, error.host()) {
        (_, Some(cause)) => host(cause),
        (ParamsError::Name(_) | ParamsError::Value { .. } | ParamsError::NameTooLong(_), None) => {
            ("usage", 2)
        }
        _ => ("failed", 1),
    }
}

impl From<ParamsError> for Failure {
    fn from(error: ParamsError) -> Self {
        match error {
            ParamsError::Host(error) => Failure::Host(error),
            error => Failure::Params(Box::new(error)),
        }
    }
}

impl From<NameError> for Failure {
    fn from(error: NameError) -> Self {
        ParamsError::from(error).into()
    }
}

/// For commands that run until they are stopped: being stopped is their usual end.
pub(crate) fn until_stopped<T: Default>(result: Result<T, Failure>) -> Result<T, Failure> {
    match result {
        Err(Failure::Signal(signal)) if signal.is_ordinary() => Ok(T::default()),
        other => other,
    }
}

/// How to get access to a device; nothing for what is not a serial port of the machine.
pub(crate) fn permission_hint(path: &Path, group: Option<&str>) -> Option<String> {
    let device = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let name = device.file_name().unwrap_or_default().to_string_lossy();
    let join =
        group.map(|group| format!("To join the group: sudo usermod -aG {group} $USER, then log in again."));
    let kernel = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let udev = kernel.starts_with("tty").then(|| {
        let group = group.unwrap_or("dialout");
        format!(
            "{} udev grant access to the logged-in user, with this line in /etc/udev/rules.d/60-sbgc.rules:\n\
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
        assert!(hint.starts_with("To join the group: sudo usermod -aG dialout $USER"), "{hint}");
        assert!(hint.contains("Or let udev") && hint.contains("KERNEL==\"ttyUSB[0-9]*\""), "{hint}");
        let hint = permission_hint(Path::new("/dev/ttyACM0"), None).unwrap();
        assert!(hint.starts_with("Let udev") && hint.contains("GROUP=\"dialout\""), "{hint}");
        assert_eq!(permission_hint(Path::new("/dev/pts/0"), None), None);
    }

    #[test]
    fn exit_codes_and_kinds() {
        let timeout = Error::Timeout { command: "CMD_X", after: std::time::Duration::ZERO, attempts: 1 };
        for (failure, kind, code) in [
            (Failure::Usage(String::new()), "usage", 2),
            (Failure::Host(timeout), "no_answer", 3),
            (Failure::Host(Error::Disconnected), "port", 1),
            (Failure::NotConfirmed(String::new()), "not_confirmed", 5),
            (Failure::Output(io::ErrorKind::StorageFull.into()), "output", 1),
        ] {
            assert_eq!((failure.kind(), failure.code()), (kind, code));
        }
    }
}
