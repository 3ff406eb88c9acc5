//! Motor power, motor synchronization and menu commands.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{Axis, Confirm, MenuCommand};
use crate::declare::flags;

/// Turns the motors on.
#[message(CMD_MOTORS_ON, outgoing, size = 0, answer = Confirm)]
pub struct MotorsOn;

/// Turns the motors off, without a choice of mode.
///
/// The only form before firmware 2.68b7. Whether later firmware still accepts it is undocumented: use [`MotorsOff`]
/// instead.
#[message(CMD_MOTORS_OFF, outgoing, form = "simple", size = 0, length = 0, answer = Confirm)]
pub struct MotorsOffSimple;

/// Turns the motors off.
#[message(CMD_MOTORS_OFF, outgoing, form = "extended", default, size = 1, since = "2.68b7", answer = Confirm)]
pub struct MotorsOff {
    /// How the motors are turned off.
    #[wire(since = "2.68b7")]
    pub mode: MotorsOffMode,
}

/// How motors are turned off. Spec: `MOTORS_OFF_MODE`.
#[open_enum(u8)]
pub enum MotorsOffMode {
    /// Immediately; the drivers go to high impedance, so the axes turn freely.
    Normal = 0,
    /// Immediately; the drivers go to low impedance, which brakes the axes.
    #[wire(spec = "BREAK")]
    Brake = 1,
    /// Gradually: power is reduced until the motors stop, then turned off. For unbalanced gimbals.
    SafeStop = 2,
}

/// Synchronizes motors that work in parallel on one axis.
#[message(CMD_SYNC_MOTORS, outgoing, size = 6, since = "2.70b9", answer = Confirm)]
pub struct SyncMotors {
    /// Axis whose motors are synchronized.
    pub axis: Axis,
    /// Power applied to the windings.
    pub power: u8,
    /// Duration, after which the motors are turned off.
    #[wire(unit = "ms")]
    pub time_ms: u16,
    /// Angle to turn by; 0 holds the position. The unit is not published.
    pub angle: u16,
}

/// Runs a menu command.
///
/// The confirmation is documented in the vendor's libraries only. [`MenuCommand::No`] is confirmed and has no other
/// effect.
#[message(CMD_EXECUTE_MENU, outgoing, form = "simple", default, size = 1, answer = Confirm)]
pub struct ExecuteMenu {
    /// Action to perform.
    pub cmd_id: MenuCommand,
}

/// Runs a menu command, with a choice of confirmations.
///
/// Confirmed at its start, at its end, both times or not at all, as selected by the flags.
#[message(CMD_EXECUTE_MENU, outgoing, form = "extended", size = 2, length = 2.., since = "2.73.8")]
pub struct ExecuteMenuExtended {
    /// Action to perform.
    pub cmd_id: MenuCommand,
    /// When the board confirms the command.
    pub flags: ExecuteMenuFlags,
}

flags! {
    /// When a menu command is confirmed. Spec: `EXECUTE_MENU_FLAG`.
    pub struct ExecuteMenuFlags: u8 {
        /// Confirms when the menu command starts. Firmware 2.73.8+.
        const CONFIRM = 1 << 0;
        /// Confirms when the menu command has finished. Firmware 2.73.8+.
        const CONFIRM_ON_FINISH = 1 << 1;
    }
}
