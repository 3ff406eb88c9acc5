//! Restarting the board into its firmware or bootloader, and bridging ports.

use sbgc_proto_macros::message;

use crate::commands::Switch;
use crate::declare::flags;

/// Restarts the board immediately.
///
/// Not confirmed.
#[message(CMD_RESET, outgoing, form = "simple", size = 0, length = 0)]
pub struct ResetRequest;

/// Restarts the board after a delay, with a notice before.
///
/// With [`ResetFlags::CONFIRM`] the board sends [`Reset`] first; it confirms nothing otherwise.
#[message(CMD_RESET, outgoing, form = "extended", default, size = 3)]
pub struct ResetExtendedRequest {
    /// Whether a notice is sent, and what is kept.
    #[wire(spec = "CONFIRM")]
    pub flags: ResetFlags,
    /// Time between the notice and the restart, for the host to close the port.
    #[wire(unit = "ms")]
    pub delay_ms: u16,
}

flags! {
    /// Restart options. Spec: `RESET_FLAG`.
    ///
    /// Older firmware takes the byte for a switch, with the same meaning of 0 and 1.
    pub struct ResetFlags: u8 {
        /// Sends a notice first.
        const CONFIRM = 1 << 0;
        /// Restores the state after the restart. Newer firmware.
        const BACKUP_STATE = 1 << 1;
    }
}

/// The board is about to restart.
///
/// It does so a second later, or after the delay of the [`ResetExtendedRequest`] that asked for it.
#[message(CMD_RESET, incoming, size = 0)]
pub struct Reset;

/// Enters the bootloader immediately.
///
/// Not confirmed.
///
/// Data sent to the port afterwards can confuse the bootloader.
#[message(CMD_BOOT_MODE_3, outgoing, form = "simple", size = 0, length = 0)]
pub struct BootMode3;

/// Enters the bootloader after a delay, with a notice before.
///
/// The spec has [`Reset`] as the notice; one of the vendor's libraries waits for a confirmation instead, another for
/// nothing. Accept either, but do not rely on one.
#[message(CMD_BOOT_MODE_3, outgoing, form = "extended", default, size = 3)]
pub struct BootMode3Extended {
    /// Whether a notice is sent.
    pub confirm: Switch,
    /// Time between the notice and the bootloader, for the host to close the port.
    #[wire(unit = "ms")]
    pub delay_ms: u16,
}

/// Connects two serial ports of the board, which from then on carry anything and no longer this protocol.
///
/// Success is not answered, failure with `CMD_ERROR`. Published in the vendor's Python library only.
#[message(CMD_SET_TRANSP_PROXY, outgoing, size = 2, since = "2.74.5")]
pub struct SetTranspProxy {
    /// First port: 0 for the receiving port, 1 and up for the others.
    pub port1: u8,
    /// Second port; must differ from the first.
    pub port2: u8,
}
