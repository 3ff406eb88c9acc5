//! Motors on, off and in step, and the menu.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{Axis, Confirm, MenuCommand};
use crate::declare::flags;

/// Turns the motors on.
#[message(CMD_MOTORS_ON, outgoing, size = 0, answer = Confirm)]
pub struct MotorsOn;

/// Switches the motors off, without a choice of how.
///
/// The only form before firmware 2.68b7. Whether later firmware still accepts it is undocumented: send [`MotorsOff`]
/// there.
#[message(CMD_MOTORS_OFF, outgoing, form = "simple", size = 0, length = 0, answer = Confirm)]
pub struct MotorsOffSimple;

/// Turns the motors off.
#[message(CMD_MOTORS_OFF, outgoing, form = "extended", default, size = 1, since = "2.68b7", answer = Confirm)]
pub struct MotorsOff {
    /// Switch-off mode.
    #[wire(since = "2.68b7")]
    pub mode: MotorsOffMode,
}

/// Switch-off mode of the motors. Spec: `MOTORS_OFF_MODE`.
#[open_enum(u8)]
pub enum MotorsOffMode {
    /// At once, and the axes turn freely: the drivers are left in high impedance.
    Normal = 0,
    /// At once, and the axes are braked: the drivers are left in low impedance.
    #[wire(spec = "BREAK")]
    Brake = 1,
    /// For a gimbal out of balance: with less and less power until the motors stand still, then wholly.
    SafeStop = 2,
}

/// Synchronizes motors that work in parallel on one axis.
#[message(CMD_SYNC_MOTORS, outgoing, size = 6, since = "2.70b9", answer = Confirm)]
pub struct SyncMotors {
    /// The axis.
    pub axis: Axis,
    /// Power in the windings.
    pub power: u8,
    /// For how long; then the motors are switched off.
    #[wire(unit = "ms")]
    pub time_ms: u16,
    /// By what angle to turn, 0 to hold. The unit is not published.
    pub angle: u16,
}

/// Runs a menu command.
///
/// That it is confirmed is known from the vendor's libraries. [`MenuCommand::No`] does nothing but be confirmed.
#[message(CMD_EXECUTE_MENU, outgoing, form = "simple", default, size = 1, answer = Confirm)]
pub struct ExecuteMenu {
    /// Action to perform.
    pub cmd_id: MenuCommand,
}

/// Runs a menu command, and chooses when that is confirmed.
///
/// Confirmed at the start, at the end, both times or not at all, as the flags select.
#[message(CMD_EXECUTE_MENU, outgoing, form = "extended", size = 2, length = 2.., since = "2.73.8")]
pub struct ExecuteMenuExtended {
    /// Action to perform.
    pub cmd_id: MenuCommand,
    /// When to confirm it.
    pub flags: ExecuteMenuFlags,
}

flags! {
    /// When a menu command is confirmed. Spec: `EXECUTE_MENU_FLAG`.
    pub struct ExecuteMenuFlags: u8 {
        /// At its start. Firmware 2.73.8+.
        const CONFIRM = 1 << 0;
        /// At its end. Firmware 2.73.8+.
        const CONFIRM_ON_FINISH = 1 << 1;
    }
}
