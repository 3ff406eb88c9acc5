//! Types of the settings for automated functions: start-up actions, fixed positions, step signals and stabilized axes.

use sbgc_proto_macros::{bit_fields, open_enum};

use super::{MenuCommand, SerialSpeed};
use crate::commands::TriggerPinId;

/// Action that a signal triggers at start-up.
#[bit_fields(u8)]
pub struct StartupAction {
    /// Action to perform.
    #[wire(bits = 0..=6)]
    pub action: MenuCommand,
    /// Whether the menu button must be pressed.
    #[wire(bits = 7, spec = "MENU_BUTTON_PRESSED")]
    pub button_pressed: bool,
}

/// Fixed positions of an axis.
#[bit_fields(u8)]
pub struct ForcePosition {
    /// Angle between two positions.
    #[wire(bits = 0..=2)]
    pub snap: SnapAngle,
    /// Whether a button press moves the axis to the position.
    #[wire(bits = 4, spec = "FORCE_POSITION_FLAG_BUTTON_PRESS")]
    pub on_button_press: bool,
    /// Whether the axis moves to the position at start-up.
    #[wire(bits = 5, spec = "FORCE_POSITION_FLAG_STARTUP")]
    pub on_startup: bool,
    /// Whether the motion ignores the soft limits.
    #[wire(bits = 6, spec = "FORCE_POSITION_FLAG_IGNORE_LIMITS")]
    pub ignores_limits: bool,
    /// Whether the position can be fine-adjusted afterwards.
    #[wire(bits = 7, spec = "FORCE_POSITION_FLAG_FINE_ADJUST")]
    pub fine_adjust: bool,
}

/// Angle between two fixed positions. Spec: `FORCE_POSITION_SNAP`.
///
/// The specification lists the angles; according to the vendor's library, the numbers are indexes into that list.
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

/// Step signal: conversion of button presses to a signal with several steps.
#[bit_fields(u8)]
pub struct StepSignalConfig {
    /// Number of steps.
    #[wire(bits = 0..=2)]
    pub steps: StepCount,
    /// Whether the menu button must be pressed.
    #[wire(bits = 3, spec = "MENU_BUTTON_PRESSED")]
    pub button_pressed: bool,
    /// Whether the signal starts at zero.
    #[wire(bits = 5, spec = "INITIAL_VALUE_ZERO")]
    pub starts_at_zero: bool,
    /// Change of the source signal that counts as a step.
    #[wire(bits = 6..=7)]
    pub mode: StepSignalMode,
}

/// Number of steps of a step signal. Spec: `STEP_SIGNAL_STEPS`.
///
/// The specification lists the numbers of steps; according to the vendor's library, the values are indexes into that
/// list.
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

/// Change of the source signal that counts as a step. Spec: `STEP_SIGNAL_MODE`.
#[open_enum(u8, prefix = "MODE_LEVEL_")]
pub enum StepSignalMode {
    /// Falling edge.
    Low = 0,
    /// Rising edge.
    High = 1,
    /// Rising and falling edges.
    LowHigh = 2,
}

/// Euler axis stabilized by a motor.
#[bit_fields(u8)]
pub struct StabilizedAxis {
    /// Axis that the motor is assigned to.
    #[wire(bits = 0..=1, spec = "STAB_AXIS")]
    pub axis: StabAxis,
    /// Whether ROLL is selected automatically if it matches best.
    #[wire(bits = 2)]
    pub auto_roll: bool,
    /// Whether PITCH is selected automatically if it matches best.
    #[wire(bits = 3)]
    pub auto_pitch: bool,
    /// Whether YAW is selected automatically if it matches best.
    #[wire(bits = 4)]
    pub auto_yaw: bool,
}

/// Euler axis that a motor is assigned to. Spec: `STAB_AXIS`.
#[open_enum(u8)]
pub enum StabAxis {
    /// The own axis of the motor.
    Default = 0,
    /// ROLL.
    Roll = 1,
    /// PITCH.
    Pitch = 2,
    /// YAW.
    Yaw = 3,
}

/// Options of a MAVLink channel.
#[bit_fields(u8)]
pub struct MavConfig {
    /// Baud rate of the port.
    #[wire(bits = 0..=2, spec = "FLAG_BAUD_MASK")]
    pub baud: SerialSpeed,
    /// Whether even parity is used.
    #[wire(bits = 3, spec = "FLAG_PARITY_EVEN")]
    pub parity_even: bool,
    /// Whether heartbeats are sent.
    #[wire(bits = 4, spec = "FLAG_HEARTBEAT")]
    pub heartbeat: bool,
    /// Whether debug messages are sent to the vendor's GUI.
    #[wire(bits = 5, spec = "FLAG_DEBUG")]
    pub debug: bool,
    /// Whether RC values are used.
    #[wire(bits = 6, spec = "FLAG_RC")]
    pub rc: bool,
}

/// Port that another device is connected to. Spec: `MAV_SRC`, `EXT_IMU_PORT`.
#[open_enum(u8)]
pub enum DevicePort {
    /// None.
    Disabled = 0,
    /// UART1.
    #[wire(spec = "UART1")]
    Uart1 = 1,
    /// Serial receiver port.
    RcSerial = 2,
    /// UART2.
    #[wire(spec = "UART2")]
    Uart2 = 3,
    /// USB virtual port.
    #[wire(spec = "USB_VCP")]
    UsbVcp = 4,
}

/// Axes controlled by a MAVLink device. Spec: `MAV_CTRL_MODE`.
#[open_enum(u8)]
pub enum MavControlMode {
    /// None.
    Disabled = 0,
    /// ROLL and PITCH.
    RollPitch = 1,
    /// All axes.
    AllAxes = 2,
}

/// Pin that signals interrupts, and the conditions.
///
/// The pin has five bits, so the buzzer and the power of the Spektrum connector cannot be expressed.
#[bit_fields(u16)]
pub struct InterruptConfig {
    /// Pin; 0 for none.
    #[wire(bits = 0..=4)]
    pub pin: TriggerPinId,
    /// Whether an emergency stop is signalled.
    #[wire(bits = 5)]
    pub on_emergency_stop: bool,
    /// Whether reaching the parking position is signalled.
    #[wire(bits = 6)]
    pub on_parking_position: bool,
}
