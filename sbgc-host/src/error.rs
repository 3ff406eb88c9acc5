//! What can go wrong on the way to a board and back.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{FailureCode, FsErrorCode};
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, DecodeError, Direction, EncodeError};

use crate::foreign::Foreign;

/// [`std::result::Result`] with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Why something did not work.
///
/// A board that says no ([`Refused`](Self::Refused)) is another matter than one that cannot be reached.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The port failed.
    #[error("the port failed: {0}")]
    Io(#[from] io::Error),
    /// The port or the connection cannot be opened.
    #[error("cannot open {address}: {source}")]
    Open {
        /// The port or the address.
        address: String,
        /// Why.
        source: io::Error,
    },
    /// The port or the connection went away while something waited on it.
    #[error("the connection to the board was lost; check cable and power, then connect again")]
    Disconnected,
    /// No answer came in time.
    #[error(
        "{command}: no answer after {} ({attempts} {}); check power, cable, baud rate and parity",
        Rounded(*.after), if *attempts == 1 { "attempt" } else { "attempts" }
    )]
    Timeout {
        /// The spec's name of the command.
        command: &'static str,
        /// How long was waited in all.
        after: Duration,
        /// How often it was sent.
        attempts: u32,
    },
    /// The board answered that it does not do it.
    #[error("{command}: the board refused with error {code}{}{}", NameOf(*.name), DataOf(.data))]
    Refused {
        /// The spec's name of the command.
        command: &'static str,
        /// The error code.
        code: u8,
        /// The spec's name of the error code, where it has one.
        name: Option<&'static str>,
        /// What the board says besides; its meaning depends on the command.
        data: Bytes,
    },
    /// The answer is not the message that it should be.
    #[error("the answer cannot be read: {0}")]
    Decode(#[from] DecodeError),
    /// The message contradicts itself or is too long.
    #[error("the message cannot be written: {0}")]
    Encode(#[from] EncodeError),
    /// The frame would not fit the board's input buffer of 255 bytes, so the board would lose it.
    #[error(
        "{command}: a payload of {length} bytes does not fit the board's input buffer, {limit} bytes do; send less at once"
    )]
    PayloadTooLong {
        /// The spec's name of the command.
        command: &'static str,
        /// Bytes of the payload.
        length: usize,
        /// Bytes that would fit.
        limit: usize,
    },
    /// The link was closed from this side.
    #[error("the link is closed; connect again")]
    Closed,
    /// The same stream is running at another rate.
    #[error("{command}: this stream already runs at {running_ms} ms; use that interval or end the other one")]
    StreamInUse {
        /// The spec's name of the streamed command.
        command: &'static str,
        /// The interval at which it runs, in milliseconds.
        running_ms: u16,
    },
    /// A stream runs whose samples could be mistaken for those of this one, or for the answer to this request.
    #[error(
        "{command}: a stream runs whose samples nothing distinguishes from these; end it, choose fields of another length, or include the flags where the firmware has that"
    )]
    Indistinct {
        /// The spec's name of the command.
        command: &'static str,
    },
    /// As many streams run as a board registers.
    #[error("{maximum} data streams are running, which is the maximum; end one first")]
    TooManyStreams {
        /// How many can run.
        maximum: usize,
    },
    /// The gimbal did not reach its target in time. It may still be moving.
    #[error(
        "the target was not reached within {}; check that the motors are on and that nothing blocks them, or allow more time",
        Rounded(*.after)
    )]
    NotReached {
        /// How long was waited.
        after: Duration,
    },
    /// A value that cannot be sent.
    #[error("{what}: {value} is out of range; expected {minimum} to {maximum} {unit}")]
    OutOfRange {
        /// What the value is, such as "pitch angle".
        what: &'static str,
        /// The value; NaN and infinities are never in range.
        value: f64,
        /// Lowest value that can be sent.
        minimum: f64,
        /// Highest value that can be sent.
        maximum: f64,
        /// Unit of all three.
        unit: &'static str,
    },
    /// The firmware does not have this.
    #[error("{what} needs firmware {since} or later, the board has {firmware}; update the firmware")]
    TooOld {
        /// What was asked for.
        what: &'static str,
        /// The first firmware that has it.
        since: FirmwareVersion,
        /// The firmware of the board.
        firmware: FirmwareVersion,
    },
    /// Something else on this connection moves the gimbal: a control session or a calibration.
    #[error("the gimbal is controlled by another session or calibration on this connection; end that first")]
    ControlInUse,
    /// A value that is not a multiple of what it has to be.
    #[error("{what}: {value} is not a multiple of {step}")]
    Misaligned {
        /// What the value is, such as "EEPROM address".
        what: &'static str,
        /// The value.
        value: usize,
        /// What it has to be a multiple of.
        step: usize,
    },
    /// A file that cannot be written: an empty one, which would be deleted, or one that is too long.
    #[error(
        "file of {size} bytes cannot be written; expected 1 to {maximum} bytes (an empty write deletes a file)"
    )]
    FileSize {
        /// Its size in bytes.
        size: usize,
        /// Size of the longest file.
        maximum: usize,
    },
    /// A note of a melody that cannot be read.
    #[error(
        "unknown note \"{note}\"; expected a name such as C5 or F#5, a frequency such as 880Hz, or - for a pause"
    )]
    BadNote {
        /// The note.
        note: String,
    },
    /// A calibration needs the motors to be on or off, and they are not.
    #[error("the motors have to be {} for this; run `motors {}` first", OnOff(*.on), OnOff(*.on))]
    MotorsMustBe {
        /// Whether they have to be on.
        on: bool,
    },
    /// There is no script in the slot.
    #[error("script slot {slot} is empty; upload a script first")]
    EmptySlot {
        /// The slot, counted from 1.
        slot: u8,
    },
    /// The board sent another number of bytes than requested.
    #[error("{what}: expected {expected} bytes, got {got}")]
    WrongLength {
        /// What was read.
        what: &'static str,
        /// Bytes that were requested.
        expected: usize,
        /// Bytes that came.
        got: usize,
    },
    /// What was written was read back and is different.
    #[error("{what}: the board has other data at {at} than was written; write it again or restore a backup")]
    NotVerified {
        /// What was written.
        what: &'static str,
        /// Address or offset of the difference.
        at: u32,
    },
    /// The port is open, and nothing comes from it.
    #[error("no board answers on {address} ({}); check power and cable", TriedHint(.lines, *.version, *.after))]
    Silent {
        /// The port or the address.
        address: String,
        /// The settings of the serial line that were tried; empty where there is none.
        lines: Vec<(u32, bool)>,
        /// The number of the version that was tried, `None` for both.
        version: Option<u8>,
        /// How long was searched.
        after: Duration,
    },
    /// Something comes from the port, and it is not the protocol of these boards.
    #[error(
        "what talks on {address} is not a SimpleBGC32 board{}; first bytes:{}",
        ForeignHint(*.foreign),
        Hex(.first)
    )]
    OtherProtocol {
        /// The port or the address.
        address: String,
        /// What it is, if that is recognised.
        foreign: Option<Foreign>,
        /// The first bytes that came.
        first: Bytes,
    },
    /// There is no such port.
    #[error("there is no port {name}; {}", PortList(.available))]
    NoSuchPort {
        /// What was asked for.
        name: String,
        /// The ports that there are.
        available: Vec<String>,
    },
    /// The operating system does not let this user open the port.
    #[error("no permission to open {}{}", .path.display(), GroupHint(.group))]
    PermissionDenied {
        /// The device.
        path: PathBuf,
        /// The group whose members may open it, if there is one.
        group: Option<String>,
    },
    /// Another program has the port open.
    #[error("{} is in use by another program; close that first", .path.display())]
    PortBusy {
        /// The device.
        path: PathBuf,
    },
    /// No address of a board.
    #[error(
        "\"{address}\" is not the address of a board; expected a serial port (/dev/ttyUSB0, COM3), tcp://HOST:PORT, udp://HOST:PORT, sim or sim:FILE"
    )]
    BadAddress {
        /// What was given.
        address: String,
    },
    /// This build cannot open such a port.
    #[error("{address} needs the feature \"{feature}\", which this program was built without")]
    NotBuilt {
        /// What was asked for.
        address: String,
        /// The feature of this crate that is missing.
        feature: &'static str,
    },
}

impl Error {
    /// The error of the file system, where a command on files or on the EEPROM was refused.
    ///
    /// ```
    /// use sbgc_host::Error;
    /// use sbgc_host::proto::commands::FsErrorCode;
    ///
    /// let (command, name, data) = ("CMD_READ_FILE", Some("ERR_FILE_NOT_FOUND"), Default::default());
    /// let error = Error::Refused { command, code: 2, name, data };
    /// assert_eq!(error.file_error(), Some(FsErrorCode::FileNotFound));
    /// ```
    pub fn file_error(&self) -> Option<FsErrorCode> {
        let Error::Refused { command, code, .. } = self else { return None };
        let named = |id: &CommandId| id.spec_name(Direction::Outgoing) == Some(command);
        let id = (1..=u8::MAX).map(CommandId::from_raw).find(named)?;
        match FailureCode::from_raw(id, *code) {
            FailureCode::Files(code) => Some(code),
            _ => None,
        }
    }
}

/// A time as people say it.
struct Rounded(Duration);
struct TriedHint<'a>(&'a [(u32, bool)], Option<u8>, Duration);
struct ForeignHint(Option<Foreign>);
struct Hex<'a>(&'a [u8]);
struct OnOff(bool);
struct NameOf(Option<&'static str>);
struct DataOf<'a>(&'a Bytes);
struct PortList<'a>(&'a [String]);
struct GroupHint<'a>(&'a Option<String>);

impl std::fmt::Display for Rounded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0 < Duration::from_secs(1) {
            write!(f, "{} ms", self.0.as_millis())
        } else {
            let tenths = self.0.as_millis() / 100;
            match tenths % 10 {
                0 => write!(f, "{} s", tenths / 10),
                rest => write!(f, "{}.{rest} s", tenths / 10),
            }
        }
    }
}

impl std::fmt::Display for TriedHint<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(lines, version, after) = *self;
        f.write_str("tried ")?;
        for (index, (baud, even)) in lines.iter().enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}{baud}{}", if *even { " even parity" } else { "" })?;
        }
        if !lines.is_empty() {
            f.write_str(" baud, ")?;
        }
        match version {
            Some(version) => write!(f, "version {version}")?,
            None => f.write_str("versions 1 and 2")?,
        }
        write!(f, ", in {}", Rounded(after))
    }
}

impl std::fmt::Display for ForeignHint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(Foreign::Mavlink) => f.write_str(
                " but MAVLink; set the port of the board to the serial API, or choose another port",
            ),
            Some(foreign) => write!(f, ", it sends {foreign}"),
            None => Ok(()),
        }
    }
}

impl std::fmt::Display for Hex<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, " {byte:02x}"))
    }
}

impl std::fmt::Display for OnOff {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if self.0 { "on" } else { "off" })
    }
}

impl std::fmt::Display for NameOf {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.map_or(Ok(()), |name| write!(f, " ({name})"))
    }
}

impl std::fmt::Display for DataOf<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0.iter().all(|&byte| byte == 0) {
            return Ok(());
        }
        f.write_str(", data")?;
        self.0.iter().try_for_each(|byte| write!(f, " {byte:02x}"))
    }
}

impl std::fmt::Display for PortList<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Some((first, rest)) = self.0.split_first() else {
            return f.write_str("no serial port was found; check that the board is plugged in and powered");
        };
        write!(f, "available: {first}")?;
        rest.iter().try_for_each(|port| write!(f, ", {port}"))
    }
}

impl std::fmt::Display for GroupHint<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(group) => write!(f, "; members of the group {group} have it"),
            None => f.write_str("; only its owner has it"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_say_what_to_do() {
        let after = Duration::from_micros(1_504_297);
        let timeout = Error::Timeout { command: "CMD_BOARD_INFO", after, attempts: 3 };
        assert_eq!(
            timeout.to_string(),
            "CMD_BOARD_INFO: no answer after 1.5 s (3 attempts); check power, cable, baud rate and parity"
        );
        let refused = Error::Refused {
            command: "CMD_AUTO_PID2",
            code: 2,
            name: Some("ERR_WRONG_PARAMS"),
            data: Bytes::from_static(&[1, 0, 0, 0]),
        };
        assert_eq!(
            refused.to_string(),
            "CMD_AUTO_PID2: the board refused with error 2 (ERR_WRONG_PARAMS), data 01 00 00 00"
        );
        let late = Error::NotReached { after: Duration::from_secs(30) };
        assert!(late.to_string().contains("within 30 s;"));
        let missing = Error::NoSuchPort { name: "ttyUSB7".into(), available: Vec::new() };
        assert!(missing.to_string().ends_with("check that the board is plugged in and powered"));
        let denied = Error::PermissionDenied { path: "/dev/ttyUSB0".into(), group: Some("dialout".into()) };
        assert!(denied.to_string().contains("group dialout"));
    }
}
