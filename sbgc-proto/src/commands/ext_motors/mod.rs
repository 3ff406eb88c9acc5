//! Auxiliary motors: up to seven motors in addition to those of the gimbal. Firmware 2.73+.

#[cfg(test)]
mod tests;

use sbgc_proto_macros::{bit_fields, message, open_enum, record};

use crate::declare::flags;
use crate::units::{Angle, ControlRate, FineAngle, MicroRate, MotorAccelerationLimit, MotorSpeedLimit};
use crate::wire::List;

flags! {
    /// Set of auxiliary motors, with a flag that requests a confirmation. Spec: `EXT_MOTORS`.
    pub struct ExtMotors: u8 {
        /// Motor 1.
        const MOTOR1 = 1 << 0;
        /// Motor 2.
        const MOTOR2 = 1 << 1;
        /// Motor 3.
        const MOTOR3 = 1 << 2;
        /// Motor 4.
        const MOTOR4 = 1 << 3;
        /// Motor 5.
        const MOTOR5 = 1 << 4;
        /// Motor 6.
        const MOTOR6 = 1 << 5;
        /// Motor 7.
        const MOTOR7 = 1 << 6;
        /// Requests a confirmation of the command. Ignored in state requests.
        const CONFIRM = 1 << 7;
    }
}

impl ExtMotors {
    /// Number of selected motors.
    pub const fn count(self) -> usize {
        // At most 7.
        (self.bits() & !Self::CONFIRM.bits()).count_ones() as usize
    }
}

/// Turns auxiliary motors on or off, or moves them to their home position.
///
/// Confirmed with [`ExtMotors::CONFIRM`].
#[message(CMD_EXT_MOTORS_ACTION, outgoing, size = 2..=255, since = "2.73.0")]
pub struct ExtMotorsAction<'a> {
    /// Motors the command applies to.
    pub for_motors: ExtMotors,
    /// Action to perform.
    pub action: ExtMotorAction,
    /// Arguments of the action; none is known to have any.
    pub args: &'a [u8],
}

/// Action of an auxiliary motor. Spec: `EXT_MOTOR_ACTION`.
#[open_enum(u8, prefix = "MOTOR_")]
pub enum ExtMotorAction {
    /// Turns the motor off and lets it turn freely.
    OffFloating = 1,
    /// Turns the motor off and brakes it.
    OffBrake = 2,
    /// Stops the motor gradually, then turns it off.
    OffSafe = 3,
    /// Turns the motor on.
    On = 4,
    /// Moves to the home position.
    #[wire(spec = "HOME_POSITION")]
    HomePosition = 5,
    /// Searches for the home position.
    #[wire(spec = "SEARCH_HOME")]
    SearchHome = 6,
}

/// Sends set-points to auxiliary motors.
///
/// Confirmed with [`ExtMotors::CONFIRM`]. Sources disagree on the number of set-points: here, there is one for each
/// selected motor, while the vendor's libraries send three or seven copies of one. To be safe, address one motor at a
/// time.
#[message(CMD_EXT_MOTORS_CONTROL, outgoing, size = 2..=58, since = "2.73.0")]
pub struct ExtMotorsControl {
    /// Motors the command applies to.
    pub for_motors: ExtMotors,
    /// Flags that select the fields of each set-point.
    pub data_set: ExtMotorsControlDataSet,
    /// Set-points, lowest motor number first.
    #[wire(group, count = for_motors.count(), context = *data_set)]
    pub motors: List<ExtMotorSetpoint, 7>,
}

/// Set-point of one motor. The [`ExtMotorControlMode`] of the motor determines the meaning of the values.
#[record(context(set: ExtMotorsControlDataSet))]
#[derive(Copy)]
pub struct ExtMotorSetpoint {
    /// Set-point in 2 bytes: torque (32767 is the maximum), speed in units of [`ControlRate`] or position in units of
    /// [`Angle`].
    ///
    /// The board keeps track of positions that continue beyond one turn.
    #[wire(when = !set.contains(ExtMotorsControlDataSet::SETPOINT_32BIT))]
    pub setpoint: Option<i16>,
    /// Set-point in 4 bytes: speed or position, but not torque. The units differ and are not published.
    #[wire(spec = "SETPOINT", flag = SETPOINT_32BIT)]
    pub setpoint_32bit: Option<i32>,
    /// Parameter in 2 bytes: in speed mode, an angle that replaces the computed one; in position mode, the maximum
    /// speed.
    #[wire(flag = PARAM1_16BIT)]
    pub param1: Option<i16>,
    /// Parameter in 4 bytes, with the same meaning.
    #[wire(spec = "PARAM1", when = set.has_long_param1())]
    pub param1_32bit: Option<i32>,
}

flags! {
    /// Selection of set-point fields. Spec: `EXT_MOTORS_CONTROL_DATA_SET`.
    pub struct ExtMotorsControlDataSet: u8 {
        /// The set-point has 4 bytes instead of 2.
        const SETPOINT_32BIT = 1 << 0;
        /// The 2-byte parameter is present.
        const PARAM1_16BIT = 1 << 1;
        /// The 4-byte parameter is present. Do not set it together with the 2-byte one, which takes precedence.
        const PARAM1_32BIT = 1 << 2;
    }
}

impl ExtMotorsControlDataSet {
    /// Whether the 4-byte parameter is present: its bit is set, and that of the 2-byte one is not.
    pub fn has_long_param1(self) -> bool {
        self.contains(Self::PARAM1_32BIT) && !self.contains(Self::PARAM1_16BIT)
    }
}

/// Configures the control of auxiliary motors until the next restart.
///
/// Confirmed with [`ExtMotors::CONFIRM`].
#[message(CMD_EXT_MOTORS_CONTROL_CONFIG, outgoing, size = 3..=12, since = "2.73.0", flags = data_set)]
#[derive(Copy)]
pub struct ExtMotorsControlConfig {
    /// Motors the command applies to.
    pub for_motors: ExtMotors,
    /// Flags that select the following fields.
    pub data_set: ExtMotorsControlConfigDataSet,
    /// Controlled quantity.
    #[wire(flag = MODE)]
    pub mode: Option<ExtMotorControlMode>,
    /// Maximum speed.
    #[wire(flag = MAX_SPEED)]
    pub max_speed: Option<MotorSpeedLimit>,
    /// Maximum acceleration in speed and position mode.
    #[wire(flag = MAX_ACCELERATION)]
    pub max_acceleration: Option<MotorAccelerationLimit>,
    /// Time in which the acceleration builds up, in speed and position mode.
    #[wire(unit = "ms", flag = JERK_SLOPE)]
    pub jerk_slope: Option<u16>,
    /// Maximum torque, relative to the maximum of the motor.
    #[wire(flag = MAX_TORQUE)]
    pub max_torque: Option<u16>,
}

flags! {
    /// Selection of auxiliary motor settings. Spec: `EXT_MOTORS_CONTROL_CONFIG_DATA_SET`.
    pub struct ExtMotorsControlConfigDataSet: u16 {
        /// Controlled quantity.
        const MODE = 1 << 0;
        /// Maximum speed.
        const MAX_SPEED = 1 << 1;
        /// Maximum acceleration.
        const MAX_ACCELERATION = 1 << 2;
        /// Time in which the acceleration builds up.
        const JERK_SLOPE = 1 << 3;
        /// Maximum torque.
        const MAX_TORQUE = 1 << 4;
    }
}

/// Controlled quantity of an auxiliary motor. Spec: `EXT_MOTOR_CONTROL_MODE`.
#[open_enum(u8)]
pub enum ExtMotorControlMode {
    /// Position.
    Position = 0,
    /// Speed.
    Speed = 1,
    /// Torque.
    Torque = 2,
}

/// Requests the state of auxiliary motors; each selected motor is reported in a message of its own.
#[message(CMD_EXT_MOTORS_STATE, outgoing, size = 5, since = "2.73.0", answer = ExtMotorsState, echo = [one_of(for_motors => motor_id), data_set])]
#[derive(Copy)]
pub struct ExtMotorsStateRequest {
    /// Motors the command applies to.
    pub for_motors: ExtMotors,
    /// Flags that select the fields of the answer.
    pub data_set: ExtMotorsStateDataSet,
}

/// State of one auxiliary motor.
///
/// Also available as a data stream, whose configuration is the payload of [`ExtMotorsStateRequest`].
#[message(CMD_EXT_MOTORS_STATE, incoming, size = 5..=50, since = "2.73.0", flags = data_set)]
#[derive(Copy)]
pub struct ExtMotorsState {
    /// Motor number, counted from 0.
    #[wire(range = 0..=6)]
    pub motor_id: u8,
    /// Flags that select the following fields.
    pub data_set: ExtMotorsStateDataSet,
    /// Controlled quantity.
    #[wire(flag = CONTROL_MODE)]
    pub control_mode: Option<ExtMotorControlMode>,
    /// Torque; 32767 is the maximum of the driver.
    #[wire(range = -32767..=32767, flag = TORQUE)]
    pub torque: Option<i16>,
    /// Target torque; 32767 is the maximum of the driver.
    #[wire(range = -32767..=32767, flag = TORQUE_SETPOINT)]
    pub torque_setpoint: Option<i16>,
    /// Speed.
    #[wire(flag = SPEED16)]
    pub speed16: Option<ControlRate>,
    /// Target speed.
    #[wire(flag = SPEED16_SETPOINT)]
    pub speed16_setpoint: Option<ControlRate>,
    /// Speed, at high resolution.
    #[wire(flag = SPEED32)]
    pub speed32: Option<MicroRate>,
    /// Target speed, at high resolution.
    #[wire(flag = SPEED32_SETPOINT)]
    pub speed32_setpoint: Option<MicroRate>,
    /// Position.
    #[wire(flag = ANGLE16)]
    pub angle16: Option<Angle>,
    /// Target position.
    #[wire(flag = ANGLE16_SETPOINT)]
    pub angle16_setpoint: Option<Angle>,
    /// Position, at high resolution.
    #[wire(flag = ANGLE32)]
    pub angle32: Option<FineAngle>,
    /// Target position, at high resolution.
    #[wire(flag = ANGLE32_SETPOINT)]
    pub angle32_setpoint: Option<FineAngle>,
    /// Motor state and pins.
    #[wire(flag = STATE_FLAGS)]
    pub state_flags: Option<ExtMotorStateFlags>,
    /// Maximum speed. The unit is not documented here; see [`ExtMotorsControlConfig::max_speed`].
    #[wire(flag = MAX_SPEED)]
    pub max_speed: Option<u16>,
    /// Maximum acceleration. The unit is not documented here; see [`ExtMotorsControlConfig::max_acceleration`].
    #[wire(flag = MAX_ACCELERATION)]
    pub max_acceleration: Option<u16>,
    /// Time in which the acceleration builds up. The unit is not documented here; see
    /// [`ExtMotorsControlConfig::jerk_slope`].
    #[wire(flag = JERK_SLOPE)]
    pub jerk_slope: Option<u16>,
    /// Maximum torque. The unit is not documented here; see [`ExtMotorsControlConfig::max_torque`].
    #[wire(flag = MAX_TORQUE)]
    pub max_torque: Option<u16>,
    /// Motor current.
    #[wire(unit = "mA", flag = CURRENT)]
    pub current: Option<u16>,
    /// Battery voltage.
    #[wire(unit = "mV", flag = BATTERY_VOLTAGE)]
    pub battery_voltage: Option<u16>,
    /// Temperature of the motor.
    #[wire(unit = "degC", flag = MOTOR_TEMPERATURE)]
    pub motor_temperature: Option<i8>,
    /// Temperature of the driver.
    #[wire(unit = "degC", flag = DRIVER_TEMPERATURE)]
    pub driver_temperature: Option<i8>,
}

flags! {
    /// Selection of state fields of an auxiliary motor. Spec: `EXT_MOTORS_STATE_DATA_SET`.
    pub struct ExtMotorsStateDataSet: u32 {
        /// Controlled quantity.
        const CONTROL_MODE = 1 << 0;
        /// Torque.
        const TORQUE = 1 << 1;
        /// Target torque.
        const TORQUE_SETPOINT = 1 << 2;
        /// Speed.
        const SPEED16 = 1 << 3;
        /// Target speed.
        const SPEED16_SETPOINT = 1 << 4;
        /// Speed, at high resolution.
        const SPEED32 = 1 << 5;
        /// Target speed, at high resolution.
        const SPEED32_SETPOINT = 1 << 6;
        /// Position.
        const ANGLE16 = 1 << 7;
        /// Target position.
        const ANGLE16_SETPOINT = 1 << 8;
        /// Position, at high resolution.
        const ANGLE32 = 1 << 9;
        /// Target position, at high resolution.
        const ANGLE32_SETPOINT = 1 << 10;
        /// Motor state and pins.
        const STATE_FLAGS = 1 << 11;
        /// Maximum speed.
        const MAX_SPEED = 1 << 12;
        /// Maximum acceleration.
        const MAX_ACCELERATION = 1 << 13;
        /// Time in which the acceleration builds up.
        const JERK_SLOPE = 1 << 14;
        /// Maximum torque.
        const MAX_TORQUE = 1 << 15;
        /// Motor current.
        const CURRENT = 1 << 16;
        /// Battery voltage.
        const BATTERY_VOLTAGE = 1 << 17;
        /// Temperature of the motor.
        const MOTOR_TEMPERATURE = 1 << 18;
        /// Temperature of the driver.
        const DRIVER_TEMPERATURE = 1 << 19;
    }
}

/// Power state and pins of an auxiliary motor. Spec: `EXT_MOTOR_STATE_FLAG`.
#[bit_fields(u16)]
pub struct ExtMotorStateFlags {
    /// Power state of the motor.
    #[wire(bits = 0..=1, spec = "MOTOR_STATE")]
    pub power: ExtMotorPower,
    /// Level of the index pin.
    #[wire(bits = 2, spec = "INDEX_PIN_STATE")]
    pub index_pin: bool,
}

/// Power state of an auxiliary motor: bits 0 and 1 of its state.
#[open_enum(u8)]
pub enum ExtMotorPower {
    /// Off, braked.
    OffBrake = 0,
    /// On.
    On = 1,
    /// Off, turning freely.
    OffFloating = 2,
    /// Stopping gradually before it turns off.
    OffSafeStop = 3,
}
