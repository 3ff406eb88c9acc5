//! User data stored on the board.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::wire::Bytes;

/// Requests the user data.
#[message(CMD_READ_EXTERNAL_DATA, outgoing, size = 0, answer = ExternalData)]
pub struct ReadExternalData;

/// User data: 128 bytes of EEPROM that the board itself does not use.
#[message(CMD_READ_EXTERNAL_DATA, incoming, size = 128)]
pub struct ExternalData {
    /// User data.
    pub data: Bytes<128>,
}

/// Stores the user data in EEPROM.
///
/// Confirmed on success.
#[message(CMD_WRITE_EXTERNAL_DATA, outgoing, size = 128, answer = Confirm)]
pub struct WriteExternalData(pub ExternalData);
