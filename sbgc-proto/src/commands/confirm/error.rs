//! What the board says to a command that failed.

use sbgc_proto_macros::{message, open_enum};

use crate::wire::{Bytes, Fault, FromWire, Layout, Read, ToWire, Writer};
use crate::{CommandId, DecodeError, EncodeError, Message};

/// A command failed: why, but not which one.
///
/// The form of older specifications.
///
/// Whether the firmware changed or the old documents were wrong is not settled, so the length decides: with one or
/// five bytes the payload begins with the error code, with any other number it is an [`Error`].
#[message(CMD_ERROR, incoming, form = "legacy", size = 1..=5, length = 1 | 5)]
#[derive(Copy)]
pub struct ErrorLegacy {
    /// Why. [`FailureCode::of`] gives it its meaning, for those who know which command failed.
    pub error_code: ErrorCode,
    /// Depends on the error.
    pub error_data: Option<Bytes<4>>,
}

/// A command failed: which one, and why.
///
/// The form of newer documents. Older ones have [`ErrorLegacy`], which does not name the command.
#[message(CMD_ERROR, incoming, size = 2..=6)]
#[derive(Copy)]
pub struct Error {
    /// The command that failed.
    pub cmd_id: CommandId,
    /// Why. The list of codes depends on the command.
    #[wire(context = *cmd_id)]
    pub error_code: FailureCode,
    /// Depends on the error; normally four bytes.
    pub error_data: ErrorData,
}

impl Error {
    /// The spec's name of the error, from the list that belongs to the command.
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

/// What a `CMD_ERROR` reports, in whichever form it came.
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
    /// Error code. [`FailureCode::of`] gives its meaning for the command.
    pub code: u8,
    /// Additional bytes, which depend on the error.
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

/// An error code as the command that failed means it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FailureCode {
    /// Of most commands.
    General(ErrorCode),
    /// Of commands that work on files and on the EEPROM.
    Files(FsErrorCode),
    /// Of `CMD_AUTO_PID2`.
    AutoPid2(AutoPid2Error),
}

impl FailureCode {
    /// What `raw` means when it comes from `command`.
    ///
    /// Files and EEPROM (commands 47, 48, 53, 54, 55) have a list of their own, and so has `CMD_AUTO_PID2` in the
    /// specification; codes beyond that short list are taken as general ones.
    pub fn of(command: CommandId, raw: u8) -> Self {
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

    /// The number on the wire.
    pub fn raw(self) -> u8 {
        match self {
            FailureCode::General(code) => code.raw(),
            FailureCode::Files(code) => code.raw(),
            FailureCode::AutoPid2(code) => code.raw(),
        }
    }

    /// The spec's name, `None` for a code that the list does not have.
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
        u8::read(input, ()).map(|(rest, raw)| (rest, Self::of(command, raw)))
    }
}

impl ToWire<CommandId> for FailureCode {
    fn write(&self, _command: CommandId, out: &mut Writer<'_>) -> Result<(), EncodeError> {
        self.raw().write((), out)
    }
}

/// Up to four bytes that say more about an error. Not three: that payload would be taken for the legacy form.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ErrorData {
    length: u8,
    bytes: [u8; Self::MAX_LEN],
}

impl ErrorData {
    /// The first four of `bytes`.
    pub fn new(bytes: &[u8]) -> Self {
        let mut data = Self::default();
        for (place, byte) in data.bytes.iter_mut().zip(bytes) {
            *place = *byte;
            data.length += 1;
        }
        data
    }

    /// The bytes.
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

/// Why a command failed. Spec: `ERROR_CODE`.
///
/// These are the usual codes of newer documents; there may be others.
#[open_enum(u8)]
pub enum ErrorCode {
    /// Nothing failed.
    NoError = 0,
    /// The command has a wrong length.
    #[wire(spec = "ERR_CMD_SIZE")]
    CmdSize = 1,
    /// A parameter has a value that it cannot have.
    #[wire(spec = "ERR_WRONG_PARAMS")]
    WrongParams = 2,
    /// Encryption or a licence check failed.
    #[wire(spec = "ERR_CRYPTO")]
    Crypto = 4,
    /// The board does not know the command.
    #[wire(spec = "ERR_UNKNOWN_COMMAND")]
    UnknownCommand = 6,
    /// The board is in a state in which it cannot do that.
    #[wire(spec = "ERR_WRONG_STATE")]
    WrongState = 8,
    /// This board or firmware cannot do that.
    #[wire(spec = "ERR_NOT_SUPPORTED")]
    NotSupported = 9,
    /// It was tried and failed.
    #[wire(spec = "ERR_OPERATION_FAILED")]
    OperationFailed = 10,
    /// It cannot be done just now; try again.
    #[wire(spec = "ERR_TEMPORARY")]
    Temporary = 11,
}

/// Why a command on files or on the EEPROM failed. Spec: `FS_ERROR_CODE`, also called `FILE_ERR`.
#[open_enum(u8)]
pub enum FsErrorCode {
    /// Nothing failed.
    NoError = 0,
    /// The EEPROM does not work.
    #[wire(spec = "ERR_EEPROM_FAULT")]
    EepromFault = 1,
    /// There is no such file.
    #[wire(spec = "ERR_FILE_NOT_FOUND")]
    FileNotFound = 2,
    /// The file allocation table is damaged.
    #[wire(spec = "ERR_FAT")]
    Fat = 3,
    /// There is no space left.
    #[wire(spec = "ERR_NO_FREE_SPACE")]
    NoFreeSpace = 4,
    /// There are as many files as there can be.
    #[wire(spec = "ERR_FAT_IS_FULL")]
    FatIsFull = 5,
    /// The file has a wrong size.
    #[wire(spec = "ERR_FILE_SIZE")]
    FileSize = 6,
    /// A checksum is wrong.
    #[wire(spec = "ERR_CRC")]
    Crc = 7,
    /// A limit is reached.
    #[wire(spec = "ERR_LIMIT_REACHED")]
    LimitReached = 8,
    /// The file is damaged.
    #[wire(spec = "ERR_FILE_CORRUPTED")]
    FileCorrupted = 9,
    /// A parameter has a value that it cannot have.
    #[wire(spec = "ERR_WRONG_PARAMS")]
    WrongParams = 10,
}

/// Why automatic PID tuning does not start. Spec: `AUTO_PID2_ERROR`; the specification numbers them without names.
#[open_enum(u8)]
pub enum AutoPid2Error {
    /// The settings cannot be read from the EEPROM.
    ReadEepromFailed = 1,
    /// Tuning cannot run now.
    CannotRunNow = 2,
    /// The settings cannot be written to the EEPROM.
    WriteEepromFailed = 3,
    /// There is no such action.
    UnknownAction = 4,
    /// The command has a wrong length.
    WrongCommandSize = 5,
}
