//! The EEPROM as plain memory, in pages of 64 bytes.

use sbgc_proto_macros::message;

use crate::commands::Confirm;

/// Requests a block of 64, 128 or 192 bytes of the EEPROM.
#[message(CMD_EEPROM_READ, outgoing, size = 6, answer = EepromRead<'answer>, echo = addr)]
pub struct EepromReadRequest {
    /// Start address of the block: a multiple of 64.
    #[wire(unit = "byte")]
    pub addr: u32,
    /// Size of the block: 64, 128 or 192, a multiple of 64 below 256.
    #[wire(unit = "byte", range = 64..=192)]
    pub size: u16,
}

/// Block of the EEPROM.
#[message(CMD_EEPROM_READ, incoming, size = 4..=255)]
pub struct EepromRead<'a> {
    /// Start address of the block, as requested.
    #[wire(unit = "byte")]
    pub addr: u32,
    /// Contents of the block, in the requested size.
    pub data: &'a [u8],
}

/// Writes a block to the EEPROM.
///
/// **Nothing checks what is written**: a wrong block destroys settings and calibrations, so read and keep what was
/// there before. On success the board confirms with [`addr`](Self::addr) as data. How many bytes of it
/// the confirmation carries, one to four, is unknown; [`Expected`](crate::Expected) compares as many as there are.
#[message(CMD_EEPROM_WRITE, outgoing, size = 4..=255, answer = Confirm, echo = number(addr => data))]
pub struct EepromWrite<'a> {
    /// Start address of the block: a multiple of 64.
    #[wire(unit = "byte")]
    pub addr: u32,
    /// Contents to write. The specification allows any size; the vendor's programs write 64, 128 or 192 bytes, which is
    /// recommended.
    pub data: &'a [u8],
}
