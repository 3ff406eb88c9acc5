//! Restart, bootloader, and bridging of serial ports.

use sbgc_proto_macros::message;

use crate::commands::Switch;
use crate::declare::flags;

/// Restarts the board immediately.
///
/// Not confirmed.
#[message(CMD_RESET, outgoing, form = "simple", size = 0, length = 0)]
pub struct ResetRequest;

/// Restarts the board after a delay, optionally with a notice.
///
/// With [`ResetFlags::CONFIRM`], the board sends [`Reset`] before it restarts; otherwise nothing is sent.
#[message(CMD_RESET, outgoing, form = "extended", default, size = 3)]
pub struct ResetExtendedRequest {
    /// Restart options.
    #[wire(spec = "CONFIRM")]
    pub flags: ResetFlags,
    /// Time between the notice and the restart, which lets the host close the port.
    #[wire(unit = "ms")]
    pub delay_ms: u16,
}

flags! {
    /// Restart options. Spec: `RESET_FLAG`.
    ///
    /// Older firmware interprets the byte as a boolean; 0 and 1 have the same effect there.
    pub struct ResetFlags: u8 {
        /// Sends [`Reset`] before the restart.
        const CONFIRM = 1 << 0;
        /// Restores the state after the restart. Newer firmware.
        const BACKUP_STATE = 1 << 1;
    }
}

/// Notice that the board is about to restart.
///
/// The restart follows after one second, or after the delay of the [`ResetExtendedRequest`] that caused it.
#[message(CMD_RESET, incoming, size = 0)]
pub struct Reset;

/// Enters the bootloader immediately.
///
/// Not confirmed.
///
/// Data sent to the port afterwards can confuse the bootloader.
#[message(CMD_BOOT_MODE_3, outgoing, form = "simple", size = 0, length = 0)]
pub struct BootMode3;

/// Enters the bootloader after a delay, optionally with a notice.
///
/// According to the specification the notice is [`Reset`]; one of the vendor's libraries waits for a confirmation
/// instead, another for nothing. Accept either, but do not rely on them.
#[message(CMD_BOOT_MODE_3, outgoing, form = "extended", default, size = 3)]
pub struct BootMode3Extended {
    /// Whether a notice is sent.
    pub confirm: Switch,
    /// Time between the notice and the start of the bootloader, which lets the host close the port.
    #[wire(unit = "ms")]
    pub delay_ms: u16,
}

/// Connects two serial ports of the board transparently; they then no longer speak this protocol.
///
/// Not confirmed on success; a failure is answered by `CMD_ERROR`. Published in the vendor's Python library only.
#[message(CMD_SET_TRANSP_PROXY, outgoing, size = 2, since = "2.74.5")]
pub struct SetTranspProxy {
    /// First port: 0 is the port that receives the command, 1 and above are numbered ports.
    pub port1: u8,
    /// Second port; must differ from the first.
    pub port2: u8,
}
