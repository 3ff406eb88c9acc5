//! Restarting the board, into its firmware or into its bootloader, and giving up a port.

use sbgc_proto_macros::message;

use crate::commands::Switch;
use crate::wire::flags;

/// Restarts the board at once.
///
/// It is not confirmed.
#[message(CMD_RESET, outgoing, form = "simple", size = 0, length = 0)]
pub struct ResetRequest {}

/// Restarts the board after a delay, with a notice before.
///
/// With [`ResetFlags::CONFIRM`] the board sends [`Reset`] first; it confirms nothing otherwise.
#[message(CMD_RESET, outgoing, form = "extended", default, size = 3)]
pub struct ResetExtendedRequest {
    /// Whether there is a notice, and what is kept.
    #[wire(spec = "CONFIRM")]
    pub flags: ResetFlags,
    /// Time between the notice and the restart, for the host to close the port.
    #[wire(unit = "ms")]
    pub delay_ms: u16,
}

flags! {
    /// How the board restarts. Spec: `RESET_FLAG`.
    ///
    /// Older firmware takes the byte for a switch, with the same meaning of 0 and 1.
    pub struct ResetFlags: u8 {
        /// It sends a notice first.
        const CONFIRM = 1 << 0;
        /// It keeps its state and has it back after the restart. Newer firmware.
        const BACKUP_STATE = 1 << 1;
    }
}

/// The board is about to restart.
///
/// It does so a second later, or after the delay of the [`ResetExtendedRequest`] that asked for it.
#[message(CMD_RESET, incoming, size = 0)]
pub struct Reset {}

/// Enters the bootloader at once.
///
/// It is not confirmed.
///
/// Anything else that is sent to the port afterwards can confuse the bootloader.
#[message(CMD_BOOT_MODE_3, outgoing, form = "simple", size = 0, length = 0)]
pub struct BootMode3 {}

/// Enters the bootloader after a delay, with a notice before.
///
/// The spec has [`Reset`] as the notice; one of the vendor's libraries waits for a confirmation instead, another for
/// nothing. Take either, and need none.
#[message(CMD_BOOT_MODE_3, outgoing, form = "extended", default, size = 3)]
pub struct BootMode3Extended {
    /// Whether there is a notice.
    pub confirm: Switch,
    /// Time between the notice and the bootloader, for the host to close the port.
    #[wire(unit = "ms")]
    pub delay_ms: u16,
}

/// Connects two serial ports of the board, which from then on carry anything and no longer this protocol.
///
/// Success is not answered, failure is with `CMD_ERROR`. Published in the vendor's Python library only.
#[message(CMD_SET_TRANSP_PROXY, outgoing, size = 2, since = "2.74.5")]
pub struct SetTranspProxy {
    /// One port: 0 for the one on which this comes, 1 and up for the others.
    pub port1: u8,
    /// The other port; it must not be the same.
    pub port2: u8,
}
