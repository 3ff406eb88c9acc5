//! Signatures and passwords.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::declare::flags;
use crate::wire::{Bytes, Reserved, Text};

/// Requests a signature of a message by the secret keys of the board.
#[message(CMD_SIGN_MESSAGE, outgoing, size = 33, answer = SignMessage)]
pub struct SignMessageRequest {
    /// Key set to sign with.
    pub sign_type: u8,
    /// Message to sign; pad shorter messages with zeros.
    pub message: Bytes<32>,
}

/// Signature of a message.
#[message(CMD_SIGN_MESSAGE, incoming, size = 32)]
pub struct SignMessage {
    /// Signature.
    pub signature: Bytes<32>,
}

/// Requests the functions protected by the password.
#[message(CMD_PASS_PROTECT_READ, outgoing, size = 0, since = "2.73.6", answer = PassProtectRead)]
pub struct PassProtectReadRequest;

/// Functions protected by the password.
///
/// Published in the vendor's Python library only.
#[message(CMD_PASS_PROTECT_READ, incoming, size = 8, since = "2.73.6")]
pub struct PassProtectRead {
    /// Protected functions.
    pub flags: PassProtectFlags,
    pub reserved: Reserved<4>,
}

/// Sets the functions protected by the password, and the password.
///
/// Confirmed on success. Published in the vendor's Python library only.
#[message(CMD_PASS_PROTECT_WRITE, outgoing, size = 9..=41, since = "2.73.6", answer = Confirm)]
pub struct PassProtectWrite<'a> {
    /// Functions to protect.
    pub flags: PassProtectFlags,
    pub reserved: Reserved<4>,
    /// New password, at most 32 bytes; if empty, the current password is kept.
    pub new_password: Text<'a>,
}

flags! {
    /// Functions protected by the password. Spec: `PASS_PROTECT_FLAG`.
    pub struct PassProtectFlags: u32 {
        /// The parameters are encrypted.
        const ENCRYPT_PARAMS = 1 << 1;
        /// Named SILENT; its effect is not published.
        const SILENT = 1 << 2;
        /// Channel 1 is protected.
        const CHANNEL_1_ENABLED = 1 << 4;
        /// Channel 2 is protected.
        const CHANNEL_2_ENABLED = 1 << 5;
        /// Channel 3 is protected.
        const CHANNEL_3_ENABLED = 1 << 6;
        /// Channel 4 is protected.
        const CHANNEL_4_ENABLED = 1 << 7;
        /// Channel 5 is protected.
        const CHANNEL_5_ENABLED = 1 << 8;
        /// Channel 6 is protected.
        const CHANNEL_6_ENABLED = 1 << 9;
        /// Channel 1 may control the gimbal although it is protected.
        const CHANNEL_1_ALLOW_CONTROL = 1 << 10;
        /// Channel 2 may control the gimbal although it is protected.
        const CHANNEL_2_ALLOW_CONTROL = 1 << 11;
        /// Channel 3 may control the gimbal although it is protected.
        const CHANNEL_3_ALLOW_CONTROL = 1 << 12;
        /// Channel 4 may control the gimbal although it is protected.
        const CHANNEL_4_ALLOW_CONTROL = 1 << 13;
        /// Channel 5 may control the gimbal although it is protected.
        const CHANNEL_5_ALLOW_CONTROL = 1 << 14;
        /// Channel 6 may control the gimbal although it is protected.
        const CHANNEL_6_ALLOW_CONTROL = 1 << 15;
    }
}
