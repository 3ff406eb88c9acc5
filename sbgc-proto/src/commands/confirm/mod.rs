//! Replies to commands: confirmations and errors.

mod error;
#[cfg(feature = "reflect")]
mod reflection;
#[cfg(test)]
mod tests;

use sbgc_proto_macros::message;

pub use error::*;

use crate::wire::{FromWire, Layout, Read, ToWire, U24, Writer};
use crate::{CommandId, EncodeError};

/// Confirms that a command was accepted or has finished.
///
/// Calibrations are confirmed twice: when they start and when they end. `CMD_CONTROL` is confirmed immediately and,
/// with `AUTO_TASK`, again when all targets are reached. A command that fails is answered by [`Error`], or not at all.
///
/// For some commands it is unknown whether they are confirmed: the specification does not cover several calibrations of
/// encoders and motors, `CMD_USE_DEFAULTS` and `CMD_RUN_SCRIPT`, and libraries differ. For these, accept a
/// confirmation, but do not rely on one. See the page of each command.
#[message(CMD_CONFIRM, incoming, size = 1..=5)]
#[derive(Copy)]
pub struct Confirm {
    /// Confirmed command.
    pub cmd_id: CommandId,
    /// Data of the confirmation, if the command defines any; otherwise zero or absent.
    ///
    /// - `CMD_CONTROL`: 1 when the target is reached.
    /// - `CMD_CALIB_COGGING`: 255 at the end.
    /// - `CMD_WRITE_FILE` and `CMD_FS_CLEAR_ALL`: an [`FsErrorCode`], because these are confirmed on failure, too.
    /// - `CMD_EEPROM_WRITE`: the address, in an unknown width.
    /// - `CMD_TRIGGER_PIN` for inputs, firmware 2.74.3+: the pin in the low byte and its signed state in the next.
    pub data: ConfirmData,
}

/// Data of a confirmation, in the width in which it was received.
///
/// The specification defines one or two bytes. Boards have been observed to send none, and newer hosts accept up to
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
    /// Value as a number; 0 if there are no bytes.
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
