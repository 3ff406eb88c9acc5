//! Block 1 of a profile's parameters: motors, RC control, follow mode, sensors and battery.

use sbgc_proto_macros::{message, record};

use super::{
    AdaptivePidAxes, AxisOrientation, BeeperModes, EulerConvention, FcMix, FollowMode, FrameImuPosition,
    GeneralFlags1, I2cSpeed, MenuCommand, MotorOutput, OrderOfAxes, ProfileFlags1, PwmFrequency, RcAxisMode,
    RcVirtMode, SerialSpeed, SkipGyroCalib, SpektrumMode,
};
use crate::commands::{Confirm, ImuType, ProfileId, RcSource, Switch};
use crate::units::{AccelerationLimit, Angle, GyroDeadband, PidTerm, ServoRate, VoltageThreshold};
use crate::wire::PerAxis;

/// Requests block 1 of a profile's parameters: motors, RC control, follow mode, sensors and battery.
#[message(CMD_READ_PARAMS_3, outgoing, size = 1, answer = Params3, echo = profile(profile_id))]
pub struct ReadParams3 {
    /// Profile to read; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes block 1 of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParams3`], change the required fields and send the others unchanged. To write
/// several blocks, bracket them with [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts only once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation. Some changes restart the
/// board about one second after the last block was written.
#[message(CMD_WRITE_PARAMS_3, outgoing, size = 134, answer = Confirm)]
pub struct WriteParams3(pub Params3);

/// Block 1 of a profile's parameters: motors, RC control, follow mode, sensors and battery.
#[message(CMD_READ_PARAMS_3, incoming, size = 134)]
pub struct Params3 {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    /// Motor and PID controller of each axis.
    #[wire(group)]
    pub motors: PerAxis<MotorTuning>,
    /// Acceleration limit of all axes; 0 disables it.
    ///
    /// Deprecated: firmware 2.60+ has a limit for each axis, `ACC_LIMITER` in [`ParamsExt2`](super::ParamsExt2).
    pub acc_limiter_all: AccelerationLimit,
    /// Gain of the flight controller signals in the stabilization, for ROLL and PITCH.
    ///
    /// The size of the whole block proves that there are two bytes; software that reads three pairs is wrong.
    #[wire(range = -127..=127)]
    pub ext_fc_gain: [i8; 2],
    /// RC control settings of each axis.
    #[wire(group)]
    pub rc: PerAxis<RcAxis>,
    /// Trust in the gyroscope relative to the accelerometer.
    pub gyro_trust: u8,
    /// Whether the controller uses a model of the motors.
    pub use_model: Switch,
    /// Switching frequency of the motor drivers.
    pub pwm_freq: PwmFrequency,
    /// Baud rate of the main port UART1, which is usually connected to the USB converter.
    ///
    /// The specification misspells the name as `SERIAL_SPPED`.
    pub serial_speed: SerialSpeed,
    /// Trim of the neutral point of RC control.
    #[wire(range = -127..=127)]
    pub rc_trim: PerAxis<i8>,
    /// Dead band around the neutral point of RC control. Applies to ROLL only if `RC_EXPO_DEADBAND_SPLIT` of
    /// [`ProfileFlags2`](super::ProfileFlags2) is set.
    pub rc_deadband: u8,
    /// Exponential curve of RC control around the neutral point.
    #[wire(unit = "%", range = 0..=100)]
    pub rc_expo_rate: u8,
    /// Input mode of the RC_ROLL pin.
    pub rc_virt_mode: RcVirtMode,
    /// Source of the control signal for ROLL.
    pub rc_map_roll: RcSource,
    /// Source of the control signal for PITCH.
    pub rc_map_pitch: RcSource,
    /// Source of the control signal for YAW.
    pub rc_map_yaw: RcSource,
    /// Source of the command channel, whose level selects `RC_CMD_LOW`, `RC_CMD_MID` or `RC_CMD_HIGH`.
    pub rc_map_cmd: RcSource,
    /// Source of the ROLL signal of the flight controller.
    pub rc_map_fc_roll: RcSource,
    /// Source of the PITCH signal of the flight controller.
    pub rc_map_fc_pitch: RcSource,
    /// Mixing of the flight controller's ROLL signal into RC control.
    pub rc_mix_fc_roll: FcMix,
    /// Mixing of the flight controller's PITCH signal into RC control.
    pub rc_mix_fc_pitch: FcMix,
    /// Follow mode of ROLL and PITCH.
    pub follow_mode: FollowMode,
    /// Dead band of follow mode: rotation of the frame before the camera follows.
    pub follow_deadband: u8,
    /// Exponential curve of follow mode.
    #[wire(unit = "%", range = 0..=100)]
    pub follow_expo_rate: u8,
    /// Offset of the neutral point of follow mode.
    ///
    /// Deprecated: replaced by `FOLLOW_OFFSET_EXT` in [`ParamsExt3`](super::ParamsExt3) in firmware 2.70+.
    #[wire(range = -127..=127)]
    pub follow_offset: PerAxis<i8>,
    /// Axis of the main IMU that points up.
    pub axis_top: AxisOrientation,
    /// Axis of the main IMU that points right.
    pub axis_right: AxisOrientation,
    /// Axis of the frame IMU that points up.
    pub frame_axis_top: AxisOrientation,
    /// Axis of the frame IMU that points right.
    pub frame_axis_right: AxisOrientation,
    /// Mounting position of the frame IMU.
    pub frame_imu_pos: FrameImuPosition,
    /// Dead band of the gyroscope.
    pub gyro_deadband: GyroDeadband,
    /// Sensitivity of the gyroscope. Deprecated.
    pub gyro_sens: u8,
    /// Clock speed of the sensor bus.
    pub i2c_speed_fast: I2cSpeed,
    /// Calibration of the gyroscope at start-up.
    pub skip_gyro_calib: SkipGyroCalib,
    /// Menu command for a low level of the command channel.
    pub rc_cmd_low: MenuCommand,
    /// Menu command for a middle level of the command channel.
    pub rc_cmd_mid: MenuCommand,
    /// Menu command for a high level of the command channel.
    pub rc_cmd_high: MenuCommand,
    /// Menu command for one press of the menu button.
    pub menu_cmd_1: MenuCommand,
    /// Menu command for two presses of the menu button.
    pub menu_cmd_2: MenuCommand,
    /// Menu command for three presses of the menu button.
    pub menu_cmd_3: MenuCommand,
    /// Menu command for four presses of the menu button.
    pub menu_cmd_4: MenuCommand,
    /// Menu command for five presses of the menu button.
    pub menu_cmd_5: MenuCommand,
    /// Menu command for a long press of the menu button.
    pub menu_cmd_long: MenuCommand,
    /// Motor output of each axis.
    pub motor_output: PerAxis<MotorOutput>,
    /// Battery voltage below which an alarm sounds; negative values disable the alarm.
    #[wire(range = -3000..=3000)]
    pub bat_threshold_alarm: VoltageThreshold,
    /// Battery voltage below which the motors are turned off; negative values disable this protection.
    #[wire(range = -3000..=3000)]
    pub bat_threshold_motors: VoltageThreshold,
    /// Voltage of the full battery, the reference for compensating motor power; negative values disable the
    /// compensation.
    #[wire(range = -3000..=3000)]
    pub bat_comp_ref: VoltageThreshold,
    /// Occasions on which the board beeps.
    pub beeper_modes: BeeperModes,
    /// Tilt angle from which ROLL is mixed into follow mode.
    #[wire(unit = "deg", range = 0..=90)]
    pub follow_roll_mix_start: u8,
    /// Range of tilt angles over which the ROLL mix grows to its maximum.
    #[wire(unit = "deg", range = 0..=90)]
    pub follow_roll_mix_range: u8,
    /// Additional power of each motor to regain lost synchronization.
    pub booster_power: PerAxis<u8>,
    /// Follow speed of each axis.
    pub follow_speed: PerAxis<u8>,
    /// Whether the frame angles are estimated from the motors.
    pub frame_angle_from_motors: Switch,
    /// Angle of each axis at start-up.
    ///
    /// The specification gives -36767 as the minimum, which does not fit into two bytes; presumably it means -32767.
    #[wire(range = -32767..=32767)]
    pub rc_memory: PerAxis<Angle>,
    /// Virtual channel routed to servo output 1, counted from 1; 0 for none.
    #[wire(range = 0..=32)]
    pub servo1_out: u8,
    /// Virtual channel routed to servo output 2, counted from 1; 0 for none.
    #[wire(range = 0..=32)]
    pub servo2_out: u8,
    /// Virtual channel routed to servo output 3, counted from 1; 0 for none.
    #[wire(range = 0..=32)]
    pub servo3_out: u8,
    /// Virtual channel routed to servo output 4, counted from 1; 0 for none.
    #[wire(range = 0..=32)]
    pub servo4_out: u8,
    /// Repetition rate of the servo outputs.
    #[wire(range = 5..=40)]
    pub servo_rate: ServoRate,
    /// Axes on which the controller reduces its gains automatically when they vibrate.
    pub adaptive_pid_enabled: AdaptivePidAxes,
    /// Vibration threshold of the adaptive controller.
    pub adaptive_pid_threshold: u8,
    /// Rate of the adaptive gain reduction.
    #[wire(range = 1..=255)]
    pub adaptive_pid_rate: u8,
    /// Recovery time of the adaptive gains.
    #[wire(range = 0..=10)]
    pub adaptive_pid_recovery_factor: u8,
    /// Low-pass filter of follow mode; the maximum is 255 if `LPF_EXTENDED_RANGE` of
    /// [`GeneralFlags2`](super::GeneralFlags2) is set.
    #[wire(range = 0..=15)]
    pub follow_lpf: PerAxis<u8>,
    /// Settings shared by all profiles.
    pub general_flags1: GeneralFlags1,
    /// Settings of this profile.
    pub profile_flags1: ProfileFlags1,
    /// Protocol of a Spektrum receiver.
    pub spektrum_mode: SpektrumMode,
    /// Order of the hardware axes.
    pub order_of_axes: OrderOfAxes,
    /// Convention of Euler angles for the camera attitude and its target.
    pub euler_order: EulerConvention,
    /// Currently selected IMU.
    pub cur_imu: ImuType,
    /// Currently active profile.
    #[wire(range = 0..=4)]
    pub cur_profile_id: ProfileId,
}

/// Motor and PID controller of one axis.
#[record(size = 6)]
#[derive(Copy)]
pub struct MotorTuning {
    /// Proportional term of the controller.
    pub p: PidTerm,
    /// Integral term of the controller. Displayed divided by 100 before firmware 2.73.1.
    pub i: PidTerm,
    /// Derivative term of the controller, which damps it.
    pub d: PidTerm,
    /// Motor power; 255 is the maximum.
    pub power: u8,
    /// Whether the motor direction is inverted. [`CalibPoles`](crate::commands::CalibPoles) detects it.
    pub invert: Switch,
    /// Number of magnetic poles of the motor. [`CalibPoles`](crate::commands::CalibPoles) detects it.
    pub poles: u8,
}

/// RC control settings of one axis.
#[record(size = 8)]
#[derive(Copy)]
pub struct RcAxis {
    /// Minimum angle of RC control.
    #[wire(unit = "deg", range = -720..=720)]
    pub rc_min_angle: i16,
    /// Maximum angle of RC control.
    #[wire(unit = "deg", range = -720..=720)]
    pub rc_max_angle: i16,
    /// Interpretation of the signal, and whether it is inverted.
    pub rc_mode: RcAxisMode,
    /// Low-pass filter of the signal; the maximum is 255 if `LPF_EXTENDED_RANGE` of
    /// [`GeneralFlags2`](super::GeneralFlags2) is set.
    #[wire(range = 0..=15)]
    pub rc_lpf: u8,
    /// Speed of RC control.
    pub rc_speed: u8,
    /// Follow rate: for ROLL and PITCH, the rate at which they follow the flight controller; for YAW, any value except
    /// 0 follows the motor.
    ///
    /// Signed, although the type column of the specification differs.
    #[wire(range = -127..=127)]
    pub rc_follow: i8,
}
