//! What the board says to commands that change something: confirmations and errors.

use sbgc_proto_macros::{message, open_enum};

use crate::wire::{Fault, FromWire, Layout, Read, ToWire, U24, Writer};
use crate::{CommandId, EncodeError};

/// A command was accepted, or what it started is done.
///
/// Calibrations are confirmed twice, when they start and when they end. `CMD_CONTROL` is confirmed at once, and with
/// `AUTO_TASK` again when all targets are reached. A command that fails is answered by [`Error`] instead, or by
/// nothing.
///
/// Whether some commands are confirmed at all is not settled: the specification is silent about several calibrations of
/// encoders and motors, `CMD_USE_DEFAULTS` and `CMD_RUN_SCRIPT`, and libraries differ. Take a confirmation of these if
/// it comes, and do not depend on it. The page of each command says what holds for it.
#[message(CMD_CONFIRM, incoming, size = 1..=5)]
#[derive(Copy)]
pub struct Confirm {
    /// The command that is confirmed.
    pub cmd_id: CommandId,
    /// More about it, where the command says so.
    ///
    /// `CMD_CONTROL`: 1 when the target is reached. `CMD_CALIB_COGGING`: 255 at the end. `CMD_WRITE_FILE` and
    /// `CMD_FS_CLEAR_ALL`: a [`FsErrorCode`], for these are confirmed when they fail, too. `CMD_EEPROM_WRITE`: the
    /// address, in a width that is not settled. `CMD_TRIGGER_PIN`, firmware 2.74.3 and later, for inputs: the pin in
    /// the low byte and its signed state in the next. Zero or nothing with all others.
    pub data: ConfirmData,
}

/// The number in a confirmation, in the width that it came in.
///
/// The specification has one or two bytes. No bytes at all have been seen from boards, and newer hosts accept up to
/// four.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ConfirmData {
    /// No bytes.
    #[default]
    None,
    /// One byte.
    U8(u8),
    /// Two bytes.
    U16(u16),
    /// Three bytes.
    U24(U24),
    /// Four bytes.
    U32(u32),
}

impl ConfirmData {
    /// The number, 0 where there are no bytes.
    pub fn value(self) -> u32 {
        match self {
            ConfirmData::None => 0,
            ConfirmData::U8(value) => value.into(),
            ConfirmData::U16(value) => value.into(),
            ConfirmData::U24(value) => value.get(),
            ConfirmData::U32(value) => value,
        }
    }
}

impl Layout for ConfirmData {
    const MIN_LEN: usize = 0;
    const MAX_LEN: usize = 4;
}

impl<'a> FromWire<'a> for ConfirmData {
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        match input {
            [] => Ok((input, ConfirmData::None)),
            [_] => u8::read(input, ()).map(|(rest, value)| (rest, ConfirmData::U8(value))),
            [_, _] => u16::read(input, ()).map(|(rest, value)| (rest, ConfirmData::U16(value))),
            [_, _, _] => U24::read(input, ()).map(|(rest, value)| (rest, ConfirmData::U24(value))),
            [_, _, _, _, ..] => u32::read(input, ()).map(|(rest, value)| (rest, ConfirmData::U32(value))),
        }
    }
}

impl ToWire for ConfirmData {
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        match self {
            ConfirmData::None => Ok(()),
            ConfirmData::U8(value) => value.write((), out),
            ConfirmData::U16(value) => value.write((), out),
            ConfirmData::U24(value) => value.write((), out),
            ConfirmData::U32(value) => value.write((), out),
        }
    }
}

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
    pub error_data: Option<crate::wire::Bytes<4>>,
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

#[cfg(feature = "reflect")]
mod reflection {
    use super::{ConfirmData, ErrorCode, ErrorData, FailureCode, U24};
    use crate::reflect::{
        Assign, AssignError, Describe, FieldInfo, Input, Place, Raw, Shape, Steps, Visitor,
    };

    impl Describe for ConfirmData {
        const SHAPE: Shape = u32::SHAPE;

        fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
            match self {
                ConfirmData::None => 0,
                ConfirmData::U8(value) => value.walk(place, visitor),
                ConfirmData::U16(value) => value.walk(place, visitor),
                ConfirmData::U24(value) => value.walk(place, visitor),
                ConfirmData::U32(value) => value.walk(place, visitor),
            }
        }
    }

    /// Stays as wide as it is where the value fits, and becomes as wide as it must otherwise.
    impl<'a> Assign<'a> for ConfirmData {
        fn assign(
            &mut self,
            path: Steps<'_>,
            value: Input<'a>,
            field: &'static FieldInfo,
        ) -> Result<(), AssignError> {
            let mut number = 0_u32;
            number.assign(path, value, field)?;
            // Hex digits tell the width too.
            if let Input::Text(text) = value {
                *self = match text.trim().strip_prefix("0x").map(str::len) {
                    Some(3..=4) => ConfirmData::U16(0),
                    Some(5..=6) => ConfirmData::U24(U24::default()),
                    Some(7..) => ConfirmData::U32(0),
                    _ => *self,
                };
            }
            let (bytes, halves) = (u8::try_from(number), u16::try_from(number));
            *self = match (*self, bytes, halves, U24::try_from(number)) {
                (ConfirmData::None | ConfirmData::U8(_), Ok(byte), _, _) => ConfirmData::U8(byte),
                (ConfirmData::None | ConfirmData::U8(_) | ConfirmData::U16(_), _, Ok(half), _) => {
                    ConfirmData::U16(half)
                }
                (ConfirmData::U32(_), ..) | (_, _, _, Err(_)) => ConfirmData::U32(number),
                (_, _, _, Ok(number)) => ConfirmData::U24(number),
            };
            Ok(())
        }
    }

    impl Describe for FailureCode {
        const SHAPE: Shape = ErrorCode::SHAPE;

        fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
            match self {
                FailureCode::General(code) => code.walk(place, visitor),
                FailureCode::Files(code) => code.walk(place, visitor),
                FailureCode::AutoPid2(code) => code.walk(place, visitor),
            }
        }
    }

    /// Takes the names of the list that it has now.
    impl<'a> Assign<'a> for FailureCode {
        fn assign(
            &mut self,
            path: Steps<'_>,
            value: Input<'a>,
            field: &'static FieldInfo,
        ) -> Result<(), AssignError> {
            match self {
                FailureCode::General(code) => code.assign(path, value, field),
                FailureCode::Files(code) => code.assign(path, value, field),
                FailureCode::AutoPid2(code) => code.assign(path, value, field),
            }
        }
    }

    impl Describe for ErrorData {
        const SHAPE: Shape = Shape::Bytes { least: 0, most: 4 };

        fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
            let bytes = self.as_bytes();
            place.leaf(bytes.len(), None, Raw::Bytes(bytes), visitor)
        }
    }

    impl<'a> Assign<'a> for ErrorData {
        fn assign(
            &mut self,
            path: Steps<'_>,
            value: Input<'a>,
            _: &'static FieldInfo,
        ) -> Result<(), AssignError> {
            path.end()?;
            let (bytes, _) = value.bytes()?;
            let data = Self::new(bytes);
            if data.as_bytes() != bytes {
                return Err(AssignError::Length { expected: 4, got: bytes.len() });
            }
            *self = data;
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::Bytes;
    use crate::{DecodeError, Message};

    fn check<M: for<'a> FromWire<'a> + ToWire + Message>(payload: &[u8]) -> M {
        let message = M::decode(payload).unwrap();
        assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
        message
    }

    /// Made by hand from the layout.
    #[test]
    fn a_confirmation_keeps_the_width_of_its_data() {
        let params = CommandId::WriteParams3;
        let data = |payload| check::<Confirm>(payload).data;
        assert_eq!(check::<Confirm>(&[22]), Confirm { cmd_id: params, data: ConfirmData::None });
        assert_eq!(data(&[22, 0]), ConfirmData::U8(0));
        assert_eq!(data(&[22, 0, 1]), ConfirmData::U16(256));
        assert_eq!(data(&[22, 0, 1, 0]), ConfirmData::U24(256.try_into().unwrap()));
        assert_eq!(data(&[22, 0, 1, 0, 0]), ConfirmData::U32(256));
        assert_eq!(data(&[22, 0, 1, 0]).value(), 256);
        assert_eq!(Confirm::decode_prefix(&[22, 0, 1, 0, 0, 9]).unwrap().1, [9]);
        assert_eq!(
            Confirm::decode(&[]),
            Err(DecodeError::TooShort { command: "CMD_CONFIRM", needed: 1, got: 0 })
        );
    }

    /// Made by hand from the layout.
    #[test]
    fn the_length_of_an_error_tells_its_form() {
        let legacy = check::<ErrorLegacy>(&[6, 1, 2, 3, 4]);
        assert_eq!(legacy.error_code, ErrorCode::UnknownCommand);
        assert_eq!(legacy.error_data, Some(Bytes([1, 2, 3, 4])));
        assert_eq!(check::<ErrorLegacy>(&[6]).error_data, None);
        let full = check::<Error>(&[22, 2, 1, 2, 3, 4]);
        assert_eq!(full.cmd_id, CommandId::WriteParams3);
        assert_eq!(full.error_code, FailureCode::General(ErrorCode::WrongParams));
        assert_eq!(full.error_data.as_bytes(), [1, 2, 3, 4]);
        for length in 2..=4 {
            check::<Error>(&[22, 2, 1, 2][..length]);
        }
        assert!([1, 5].into_iter().all(ErrorLegacy::accepts));
        assert!([0, 2, 3, 4, 6, 7].into_iter().all(|length| !ErrorLegacy::accepts(length)));
        assert!(Error::decode(&[22]).is_err());
    }

    #[test]
    fn the_command_chooses_the_list_of_codes() {
        let name = |command: CommandId, raw| FailureCode::of(command, raw).name();
        assert_eq!(name(CommandId::WriteFile, 4), Some("ERR_NO_FREE_SPACE"));
        assert_eq!(name(CommandId::Control, 4), Some("ERR_CRYPTO"));
        assert_eq!(name(CommandId::AutoPid2, 4), Some("UNKNOWN_ACTION"));
        assert_eq!(name(CommandId::AutoPid2, 9), Some("ERR_NOT_SUPPORTED"));
        assert_eq!(name(CommandId::Control, 99), None);
        for raw in 0..=255 {
            for command in (0..=255).map(CommandId::from_raw) {
                assert_eq!(FailureCode::of(command, raw).raw(), raw);
            }
        }
    }

    #[cfg(feature = "reflect")]
    #[test]
    fn fields_show_the_width_and_the_list() {
        use crate::reflect::{Input, Leaf, set, walk};

        let mut shown = Vec::new();
        walk(&check::<Confirm>(&[22, 0, 1, 0]), &mut |leaf: &Leaf<'_>| {
            shown.push(format!("{}@{} {} {:?}", leaf.path, leaf.offset, leaf.type_name(), leaf.raw));
        });
        walk(&check::<Error>(&[54, 4]), &mut |leaf: &Leaf<'_>| {
            shown.push(leaf.label().map(|label| label.to_string()).unwrap_or_default());
        });
        assert_eq!(
            shown,
            ["cmd_id@0 u8 Number(22)", "data@1 u24 Number(256)", "CMD_WRITE_FILE", "ERR_NO_FREE_SPACE", ""]
        );

        let mut data = ConfirmData::None;
        for (value, expected) in [
            (7, ConfirmData::U8(7)),
            (700, ConfirmData::U16(700)),
            (7, ConfirmData::U16(7)),
            (0x1_0000, ConfirmData::U24(0x1_0000.try_into().unwrap())),
            (0x100_0000, ConfirmData::U32(0x100_0000)),
            (1, ConfirmData::U32(1)),
        ] {
            set(&mut data, "", Input::Raw(value)).unwrap();
            assert_eq!(data, expected);
        }
        set(&mut data, "", Input::Text("0x0016")).unwrap();
        assert_eq!(data, ConfirmData::U16(22));
    }
}
