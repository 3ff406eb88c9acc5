//! Error replies to commands that failed.

use sbgc_proto_macros::{message, open_enum};

use crate::wire::{Bytes, Fault, FromWire, Layout, Read, ToWire, Writer};
use crate::{CommandId, DecodeError, EncodeError, Message};

/// Error reply that does not name the command, as in older specifications.
///
/// Whether the firmware changed or the old documents were wrong is unknown, so the length decides: a payload of one or
/// five bytes starts with the error code; any other length is an [`Error`].
#[message(CMD_ERROR, incoming, form = "legacy", size = 1..=5, length = 1 | 5)]
#[derive(Copy)]
pub struct ErrorLegacy {
    /// Error code. [`FailureCode::from_raw`] interprets it for a particular command.
    pub error_code: ErrorCode,
    /// Additional bytes; their meaning depends on the error.
    pub error_data: Option<Bytes<4>>,
}

/// Error reply that names the command, as in newer documents.
///
/// Older documents describe [`ErrorLegacy`], which does not name the command.
#[message(CMD_ERROR, incoming, size = 2..=6)]
#[derive(Copy)]
pub struct Error {
    /// Command that failed.
    pub cmd_id: CommandId,
    /// Error code, from the list for this command.
    #[wire(context = *cmd_id)]
    pub error_code: FailureCode,
    /// Additional bytes, normally four; their meaning depends on the error.
    pub error_data: ErrorData,
}

impl Error {
    /// Spec name of the error, from the list for this command.
    ///
    /// ```
    /// use sbgc_proto::commands::Error;
    /// use sbgc_proto::Message;
    ///
    /// assert_eq!(Error::decode(&[53, 2, 0, 0, 0, 0])?.name(), Some("ERR_FILE_NOT_FOUND"));
    /// assert_eq!(Error::decode(&[22, 2, 0, 0, 0, 0])?.name(), Some("ERR_WRONG_PARAMS"));
    /// # Ok::<(), sbgc_proto::DecodeError>(())
    /// ```
    pub fn name(&self) -> Option<&'static str> {
        self.error_code.name()
    }
}

/// Contents of a `CMD_ERROR` in either form.
///
/// ```
/// use sbgc_proto::CommandId;
/// use sbgc_proto::commands::ErrorReport;
///
/// let report = ErrorReport::from_payload(&[53, 2, 0, 0, 0, 0])?;
/// assert_eq!((report.command, report.code), (Some(CommandId::ReadFile), 2));
/// assert_eq!(ErrorReport::from_payload(&[2, 0, 0, 0, 0])?.command, None);
/// # Ok::<(), sbgc_proto::DecodeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ErrorReport {
    /// Command that failed; `None` in the legacy form, which does not name it.
    pub command: Option<CommandId>,
    /// Error code. [`FailureCode::from_raw`] interprets it for a particular command.
    pub code: u8,
    /// Additional bytes; their meaning depends on the error.
    pub data: ErrorData,
}

impl ErrorReport {
    /// Decodes the payload of a `CMD_ERROR`, whose length selects the form.
    ///
    /// # Errors
    /// If the payload is empty.
    pub fn from_payload(payload: &[u8]) -> Result<Self, DecodeError> {
        if ErrorLegacy::accepts(payload.len()) {
            ErrorLegacy::decode(payload).map(Self::from)
        } else {
            Error::decode(payload).map(Self::from)
        }
    }
}

impl From<ErrorLegacy> for ErrorReport {
    fn from(error: ErrorLegacy) -> Self {
        let data = error.error_data.map_or_else(ErrorData::default, |data| ErrorData::new(&data.0));
        Self { command: None, code: error.error_code.raw(), data }
    }
}

impl From<Error> for ErrorReport {
    fn from(error: Error) -> Self {
        Self { command: Some(error.cmd_id), code: error.error_code.raw(), data: error.error_data }
    }
}

/// Error code as defined for the command that failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FailureCode {
    /// General code, used by most commands.
    General(ErrorCode),
    /// Code of file and EEPROM commands.
    Files(FsErrorCode),
    /// Code of `CMD_AUTO_PID2`.
    AutoPid2(AutoPid2Error),
}

impl FailureCode {
    /// Interprets `raw` as an error code of `command`.
    ///
    /// File and EEPROM commands (47, 48, 53, 54, 55) have a list of their own, and so has `CMD_AUTO_PID2` in the
    /// specification; codes beyond that short list are interpreted as general codes.
    pub fn from_raw(command: CommandId, raw: u8) -> Self {
        match command {
            CommandId::EepromWrite
            | CommandId::EepromRead
            | CommandId::ReadFile
            | CommandId::WriteFile
            | CommandId::FsClearAll => Self::Files(raw.into()),
            CommandId::AutoPid2 => match raw.into() {
                AutoPid2Error::Unknown(_) => Self::General(raw.into()),
                code => Self::AutoPid2(code),
            },
            _ => Self::General(raw.into()),
        }
    }

    /// Raw number on the wire.
    pub fn raw(self) -> u8 {
        match self {
            FailureCode::General(code) => code.raw(),
            FailureCode::Files(code) => code.raw(),
            FailureCode::AutoPid2(code) => code.raw(),
        }
    }

    /// Spec name; `None` for an unlisted code.
    pub fn name(self) -> Option<&'static str> {
        let labels = match self {
            FailureCode::General(_) => ErrorCode::LABELS,
            FailureCode::Files(_) => FsErrorCode::LABELS,
            FailureCode::AutoPid2(_) => AutoPid2Error::LABELS,
        };
        labels.iter().find(|label| label.value == i64::from(self.raw())).map(|label| label.name)
    }
}

impl Default for FailureCode {
    fn default() -> Self {
        FailureCode::General(ErrorCode::default())
    }
}

impl Layout for FailureCode {
    const MIN_LEN: usize = 1;
    const MAX_LEN: usize = 1;
}

impl<'a> FromWire<'a, CommandId> for FailureCode {
    fn read(input: &'a [u8], command: CommandId) -> Read<'a, Self> {
        u8::read(input, ()).map(|(rest, raw)| (rest, Self::from_raw(command, raw)))
    }
}

impl ToWire<CommandId> for FailureCode {
    fn write(&self, _command: CommandId, out: &mut Writer<'_>) -> Result<(), EncodeError> {
        self.raw().write((), out)
    }
}

/// Up to four additional bytes of an error, but not three: that payload would be interpreted as the legacy form.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ErrorData {
    length: u8,
    bytes: [u8; Self::MAX_LEN],
}

impl ErrorData {
    /// Creates error data from the first four of `bytes`.
    pub fn new(bytes: &[u8]) -> Self {
        let mut data = Self::default();
        for (place, byte) in data.bytes.iter_mut().zip(bytes) {
            *place = *byte;
            data.length += 1;
        }
        data
    }

    /// Payload bytes.
    pub fn as_bytes(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length)).unwrap_or(&self.bytes)
    }
}

impl core::fmt::Debug for ErrorData {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.as_bytes().iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl Layout for ErrorData {
    const MIN_LEN: usize = 0;
    const MAX_LEN: usize = 4;
}

impl<'a> FromWire<'a> for ErrorData {
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        let data = Self::new(input);
        match input.get(data.as_bytes().len()..) {
            Some(rest) => Ok((rest, data)),
            None => Fault::short(Self::MAX_LEN, input),
        }
    }
}

impl ToWire for ErrorData {
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        out.put(self.as_bytes())
    }
}

/// General error code. Spec: `ERROR_CODE`.
///
/// These are the common codes of newer documents; there may be others.
#[open_enum(u8, prefix = "ERR_")]
pub enum ErrorCode {
    /// No error.
    #[wire(spec = "NO_ERROR")]
    NoError = 0,
    /// Wrong command length.
    CmdSize = 1,
    /// Invalid parameter value.
    WrongParams = 2,
    /// Encryption or a licence check failed.
    Crypto = 4,
    /// Unknown command.
    UnknownCommand = 6,
    /// Not possible in the current state.
    WrongState = 8,
    /// Not supported by this board or firmware.
    NotSupported = 9,
    /// The operation failed.
    OperationFailed = 10,
    /// Temporarily not possible; try again.
    Temporary = 11,
}

/// Error of a file or EEPROM command. Spec: `FS_ERROR_CODE`, also called `FILE_ERR`.
#[open_enum(u8, prefix = "ERR_")]
pub enum FsErrorCode {
    /// No error.
    #[wire(spec = "NO_ERROR")]
    NoError = 0,
    /// EEPROM fault.
    EepromFault = 1,
    /// File not found.
    FileNotFound = 2,
    /// The file allocation table is damaged.
    Fat = 3,
    /// No free space.
    NoFreeSpace = 4,
    /// The file allocation table is full.
    FatIsFull = 5,
    /// Wrong file size.
    FileSize = 6,
    /// Wrong checksum.
    Crc = 7,
    /// A limit was reached.
    LimitReached = 8,
    /// The file is damaged.
    FileCorrupted = 9,
    /// Invalid parameter value.
    WrongParams = 10,
}

/// Reason why automatic PID tuning does not start. Spec: `AUTO_PID2_ERROR`, numbers without names.
#[open_enum(u8)]
pub enum AutoPid2Error {
    /// Reading the settings from EEPROM failed.
    ReadEepromFailed = 1,
    /// Tuning cannot run now.
    CannotRunNow = 2,
    /// Writing the settings to EEPROM failed.
    WriteEepromFailed = 3,
    /// Unknown action.
    UnknownAction = 4,
    /// Wrong command length.
    WrongCommandSize = 5,
}
