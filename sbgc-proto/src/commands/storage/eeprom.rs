//! The EEPROM as plain memory, in pages of 64 bytes.

use sbgc_proto_macros::message;

use crate::commands::Confirm;

/// Asks for a block of 64, 128 or 192 bytes of the EEPROM.
#[message(CMD_EEPROM_READ, outgoing, size = 6, answer = EepromRead<'answer>, echo = addr)]
pub struct EepromReadRequest {
    /// Where the block starts: a multiple of 64.
    #[wire(unit = "byte")]
    pub addr: u32,
    /// How long it is: 64, 128 or 192, since it must be a multiple of 64 and less than 256.
    #[wire(unit = "byte", range = 64..=192)]
    pub size: u16,
}

/// A block of the EEPROM.
#[message(CMD_EEPROM_READ, incoming, size = 4..=255)]
pub struct EepromRead<'a> {
    /// Where the block starts, as the request had it.
    #[wire(unit = "byte")]
    pub addr: u32,
    /// The block, as long as the request wanted it.
    pub data: &'a [u8],
}

/// Writes a block to the EEPROM.
///
/// **Nothing checks what is written**: a wrong block destroys settings and calibrations, so read and keep what was
/// there. On success the board confirms with [`addr`](Self::addr) as the data of the confirmation. How many bytes of it
/// the confirmation carries, one to four, is not settled; compare as many as have come.
#[message(CMD_EEPROM_WRITE, outgoing, size = 4..=255, answer = Confirm, echo = number(addr => data))]
pub struct EepromWrite<'a> {
    /// Where the block starts: a multiple of 64.
    #[wire(unit = "byte")]
    pub addr: u32,
    /// The block. The specification allows any size; the vendor's programs write 64, 128 or 192 bytes, and so should
    /// everybody.
    pub data: &'a [u8],
}
