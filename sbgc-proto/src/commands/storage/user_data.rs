//! Bytes that the board keeps for whoever is connected to it.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::wire::Bytes;

/// Requests the user's data.
#[message(CMD_READ_EXTERNAL_DATA, outgoing, size = 0, answer = ExternalData)]
pub struct ReadExternalData;

/// The user's data: bytes in the EEPROM that the board itself does not use.
#[message(CMD_READ_EXTERNAL_DATA, incoming, size = 128)]
pub struct ExternalData {
    /// The data.
    pub data: Bytes<128>,
}

/// Stores the user's data in the EEPROM.
///
/// The board confirms it.
#[message(CMD_WRITE_EXTERNAL_DATA, outgoing, size = 128, answer = Confirm)]
pub struct WriteExternalData(pub ExternalData);
