//! Values of what the board does by itself: actions at start, snapping to positions, step signals, stabilized axes.

use sbgc_proto_macros::open_enum;

use super::{MenuCommand, SerialSpeed};
use crate::commands::TriggerPinId;
use crate::declare::{bit_enums, bit_fields};

bit_fields! {
    /// An action that is started by a signal when the board starts.
    pub struct StartupAction: u8 {
        /// Action to perform.
        0..=6 => action / with_action "ACTION": MenuCommand,
        /// Whether the menu button must be pressed for it.
        7 => button_pressed / with_button_pressed "MENU_BUTTON_PRESSED": bool,
    }
}

bit_fields! {
    /// Fixed positions of an axis.
    pub struct ForcePosition: u8 {
        /// The angle between two positions.
        0..=2 => snap / with_snap "SNAP": SnapAngle,
        /// Whether a press of the button starts it.
        4 => on_button_press / with_on_button_press "FORCE_POSITION_FLAG_BUTTON_PRESS": bool,
        /// Whether it is done at start.
        5 => on_startup / with_on_startup "FORCE_POSITION_FLAG_STARTUP": bool,
        /// Whether it goes beyond the soft limits.
        6 => ignores_limits / with_ignores_limits "FORCE_POSITION_FLAG_IGNORE_LIMITS": bool,
        /// Whether the position is adjusted finely afterwards.
        7 => fine_adjust / with_fine_adjust "FORCE_POSITION_FLAG_FINE_ADJUST": bool,
    }
}

/// The angle between two fixed positions. Spec: `FORCE_POSITION_SNAP`.
///
/// The specification lists the angles; that the numbers are indexes into that list is from the vendor's library.
#[open_enum(u8)]
pub enum SnapAngle {
    /// One position only, at 0 degrees.
    #[wire(spec = "SNAP_0")]
    Degrees0 = 0,
    /// 45 degrees.
    #[wire(spec = "SNAP_45")]
    Degrees45 = 1,
    /// 90 degrees.
    #[wire(spec = "SNAP_90")]
    Degrees90 = 2,
    /// 180 degrees.
    #[wire(spec = "SNAP_180")]
    Degrees180 = 3,
}
bit_enums!(SnapAngle);

bit_fields! {
    /// Step signal: button presses converted to a signal of several steps.
    pub struct StepSignalConfig: u8 {
        /// The number of steps.
        0..=2 => steps / with_steps "STEPS": StepCount,
        /// Whether the menu button must be pressed.
        3 => button_pressed / with_button_pressed "MENU_BUTTON_PRESSED": bool,
        /// Whether the signal begins with zero.
        5 => starts_at_zero / with_starts_at_zero "INITIAL_VALUE_ZERO": bool,
        /// Change of the source that counts as a step.
        6..=7 => mode / with_mode "MODE": StepSignalMode,
    }
}

/// The number of steps of a step signal. Spec: `STEP_SIGNAL_STEPS`.
///
/// The specification lists the numbers of steps; that these are indexes into that list is from the vendor's library.
#[open_enum(u8)]
pub enum StepCount {
    /// 2 steps.
    #[wire(spec = "STEPS_2")]
    Steps2 = 0,
    /// 3 steps.
    #[wire(spec = "STEPS_3")]
    Steps3 = 1,
    /// 5 steps.
    #[wire(spec = "STEPS_5")]
    Steps5 = 2,
    /// 10 steps.
    #[wire(spec = "STEPS_10")]
    Steps10 = 3,
    /// 15 steps.
    #[wire(spec = "STEPS_15")]
    Steps15 = 4,
    /// 25 steps.
    #[wire(spec = "STEPS_25")]
    Steps25 = 5,
    /// 50 steps.
    #[wire(spec = "STEPS_50")]
    Steps50 = 6,
    /// 100 steps.
    #[wire(spec = "STEPS_100")]
    Steps100 = 7,
}
bit_enums!(StepCount);

/// Change of the source that counts as a step. Spec: `STEP_SIGNAL_MODE`.
#[open_enum(u8, prefix = "MODE_LEVEL_")]
pub enum StepSignalMode {
    /// Falling.
    Low = 0,
    /// Rising.
    High = 1,
    /// Rising and falling.
    LowHigh = 2,
}
bit_enums!(StepSignalMode);

bit_fields! {
    /// Euler axis stabilized by a motor.
    pub struct StabilizedAxis: u8 {
        /// The axis that it is assigned to.
        0..=1 => axis / with_axis "STAB_AXIS": StabAxis,
        /// Whether ROLL may be chosen when it matches best.
        2 => auto_roll / with_auto_roll "AUTO_ROLL": bool,
        /// Whether PITCH may be chosen when it matches best.
        3 => auto_pitch / with_auto_pitch "AUTO_PITCH": bool,
        /// Whether YAW may be chosen when it matches best.
        4 => auto_yaw / with_auto_yaw "AUTO_YAW": bool,
    }
}

/// The Euler axis that a motor is assigned to. Spec: `STAB_AXIS`.
#[open_enum(u8)]
pub enum StabAxis {
    /// The motor's own.
    Default = 0,
    /// ROLL.
    Roll = 1,
    /// PITCH.
    Pitch = 2,
    /// YAW.
    Yaw = 3,
}
bit_enums!(StabAxis);

bit_fields! {
    /// Options of a MavLink channel.
    pub struct MavConfig: u8 {
        /// Speed of the port.
        0..=2 => baud / with_baud "FLAG_BAUD_MASK": SerialSpeed,
        /// Whether bytes have even parity.
        3 => parity_even / with_parity_even "FLAG_PARITY_EVEN": bool,
        /// Whether heartbeats are sent.
        4 => heartbeat / with_heartbeat "FLAG_HEARTBEAT": bool,
        /// Whether the vendor's program gets debug messages.
        5 => debug / with_debug "FLAG_DEBUG": bool,
        /// Whether the values of remote control are used.
        6 => rc / with_rc "FLAG_RC": bool,
    }
}

/// A port to which another device is connected. Spec: `MAV_SRC`, `EXT_IMU_PORT`.
#[open_enum(u8)]
pub enum DevicePort {
    /// None.
    Disabled = 0,
    /// UART1.
    #[wire(spec = "UART1")]
    Uart1 = 1,
    /// The port of the serial receiver.
    RcSerial = 2,
    /// UART2.
    #[wire(spec = "UART2")]
    Uart2 = 3,
    /// The virtual port of USB.
    #[wire(spec = "USB_VCP")]
    UsbVcp = 4,
}

/// Axes controlled by a MavLink device. Spec: `MAV_CTRL_MODE`.
#[open_enum(u8)]
pub enum MavControlMode {
    /// None.
    Disabled = 0,
    /// ROLL and PITCH.
    RollPitch = 1,
    /// All axes.
    AllAxes = 2,
}

bit_fields! {
    /// Interrupt condition of a pin, and the pin.
    ///
    /// The pin has five bits: the buzzer and the power of the Spektrum connector cannot be expressed.
    pub struct InterruptConfig: u16 {
        /// The pin; 0 is none.
        0..=4 => pin / with_pin "PIN": TriggerPinId,
        /// Whether an emergency stop signals.
        5 => on_emergency_stop / with_on_emergency_stop "ON_EMERGENCY_STOP": bool,
        /// Whether reaching the parking position signals.
        6 => on_parking_position / with_on_parking_position "ON_PARKING_POSITION": bool,
    }
}
