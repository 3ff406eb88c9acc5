//! What the board is: identity, versions, features.

use sbgc_proto_macros::message;

use crate::units::{BoardVersion, FirmwareVersion};
use crate::wire::{Bytes, flags};

/// Asks what the board is.
#[message(CMD_BOARD_INFO, outgoing, form = "simple", size = 0, length = 0, answer = BoardInfo)]
pub struct BoardInfoRequest {}

/// Asks what the board is, and sets up the driver of the port that the request comes on.
#[message(CMD_BOARD_INFO, outgoing, form = "extended", size = 2..=255, answer = BoardInfo)]
pub struct BoardInfoExtendedRequest<'a> {
    /// On a UART the time between packets of 20 bytes, as Bluetooth Low Energy wants them; without meaning on USB.
    #[wire(unit = "ms")]
    pub cfg: u16,
    /// Not checked by the board. From firmware 2.73.6 on it may hold a password, behind its length byte.
    pub reserved: &'a [u8],
}

/// What the board is.
#[message(CMD_BOARD_INFO, incoming, size = 18)]
pub struct BoardInfo {
    /// Version of the board.
    pub board_ver: BoardVersion,
    /// Version of the firmware.
    pub firmware_ver: FirmwareVersion,
    /// What state the firmware is in.
    pub state_flags1: StateFlags1,
    /// What the board can do.
    pub board_features: BoardFeatures,
    /// How the board is connected.
    pub connection_flag: ConnectionFlags,
    /// Marks special builds.
    pub frw_extra_id: u32,
    /// More of what the board can do.
    #[wire(since = "2.70")]
    pub reserved: Bytes<7>,
}

flags! {
    /// What state the firmware is in. Spec: `STATE_FLAGS1`.
    pub struct StateFlags1: u8 {
        /// For internal use.
        const DEBUG_MODE = 1 << 0;
    }
}
flags! {
    /// What the board can do.
    pub struct BoardFeatures: u16 {
        /// Three axes.
        const BOARD_FEATURE_3AXIS = 1 << 0;
    }
}
flags! {
    /// How.
    pub struct ConnectionFlags: u8 {
        /// Over USB.
        const CONNECTION_USB = 1 << 0;
    }
}
