//! The first block of a profile's parameters: motors, remote control, follow mode, sensors, battery.

use sbgc_proto_macros::{message, record};

use super::{
    AdaptivePidAxes, AxisOrientation, BeeperModes, EulerConvention, FcMix, FollowMode, FrameImuPosition,
    GeneralFlags1, I2cSpeed, MenuCommand, MotorOutput, OrderOfAxes, ProfileFlags1, PwmFrequency, RcAxisMode,
    RcVirtMode, SerialSpeed, SkipGyroCalib, SpektrumMode,
};
use crate::commands::{Confirm, ImuType, ProfileId, RcSource, Switch};
use crate::units::{AccelerationLimit, Angle, GyroDeadband, PidTerm, ServoRate, VoltageThreshold};
use crate::wire::PerAxis;

/// Requests the first block of a profile's parameters: motors, remote control, follow mode, sensors, battery.
#[message(CMD_READ_PARAMS_3, outgoing, size = 1, answer = Params3, echo = profile(profile_id))]
pub struct ReadParams3 {
    /// Profile; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes the first block of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParams3`], change what is to be changed and send all the rest as it came. Several
/// blocks are best written between the two [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation. Some changes make the
/// board restart about a second after the last block was written.
#[message(CMD_WRITE_PARAMS_3, outgoing, size = 134, answer = Confirm)]
pub struct WriteParams3(pub Params3);

/// The first block of a profile's parameters: motors, remote control, follow mode, sensors, battery.
#[message(CMD_READ_PARAMS_3, incoming, size = 134)]
pub struct Params3 {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    /// Motor and controller of each axis.
    #[wire(group)]
    pub motors: PerAxis<MotorTuning>,
    /// Limit of acceleration for all axes, 0 for none.
    ///
    /// Deprecated: with firmware 2.60+ `ACC_LIMITER` in [`ParamsExt2`](super::ParamsExt2) has one for each axis.
    pub acc_limiter_all: AccelerationLimit,
    /// Gain of the flight controller's signals in the stabilization, for ROLL and for PITCH.
    ///
    /// There are two bytes, as the size of the whole block proves; software that reads three pairs is wrong.
    #[wire(range = -127..=127)]
    pub ext_fc_gain: [i8; 2],
    /// Remote control settings of each axis.
    #[wire(group)]
    pub rc: PerAxis<RcAxis>,
    /// Trust in the gyroscope relative to the accelerometer.
    pub gyro_trust: u8,
    /// Whether the controller uses a model of the motors.
    pub use_model: Switch,
    /// Switching frequency of the motor drivers.
    pub pwm_freq: PwmFrequency,
    /// Speed of the main port UART1, to which the USB converter is usually connected.
    ///
    /// The specification misspells it `SERIAL_SPPED`.
    pub serial_speed: SerialSpeed,
    /// Trim of the remote control's neutral point.
    #[wire(range = -127..=127)]
    pub rc_trim: PerAxis<i8>,
    /// Dead band around the neutral point of remote control; of ROLL alone where the axes are split, see
    /// `RC_EXPO_DEADBAND_SPLIT` in [`ProfileFlags2`](super::ProfileFlags2).
    pub rc_deadband: u8,
    /// Exponential curve of remote control around neutral, in percent.
    #[wire(unit = "%", range = 0..=100)]
    pub rc_expo_rate: u8,
    /// Input mode of the RC_ROLL pin.
    pub rc_virt_mode: RcVirtMode,
    /// Source of the control signal of ROLL.
    pub rc_map_roll: RcSource,
    /// Source of the control signal of PITCH.
    pub rc_map_pitch: RcSource,
    /// Source of the control signal of YAW.
    pub rc_map_yaw: RcSource,
    /// Source of the command channel, whose level runs `RC_CMD_LOW`, `_MID` and `_HIGH`.
    pub rc_map_cmd: RcSource,
    /// Source of the flight controller's ROLL signal.
    pub rc_map_fc_roll: RcSource,
    /// Source of the flight controller's PITCH signal.
    pub rc_map_fc_pitch: RcSource,
    /// Mixing of the flight controller's ROLL signal into remote control.
    pub rc_mix_fc_roll: FcMix,
    /// Mixing of the flight controller's PITCH signal into remote control.
    pub rc_mix_fc_pitch: FcMix,
    /// Follow mode of ROLL and PITCH.
    pub follow_mode: FollowMode,
    /// Dead band: rotation of the frame before the camera follows.
    pub follow_deadband: u8,
    /// Exponential curve of following, in percent.
    #[wire(unit = "%", range = 0..=100)]
    pub follow_expo_rate: u8,
    /// Offset of the neutral point in follow mode.
    ///
    /// Deprecated: with firmware 2.70+ `FOLLOW_OFFSET_EXT` in [`ParamsExt3`](super::ParamsExt3) replaces it.
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
    /// Speed of the bus to the sensors.
    pub i2c_speed_fast: I2cSpeed,
    /// Whether the gyroscope is calibrated at start.
    pub skip_gyro_calib: SkipGyroCalib,
    /// Action of the command channel at a low signal.
    pub rc_cmd_low: MenuCommand,
    /// Action of the command channel at a middle signal.
    pub rc_cmd_mid: MenuCommand,
    /// Action of the command channel at a high signal.
    pub rc_cmd_high: MenuCommand,
    /// Action of one press of the menu button.
    pub menu_cmd_1: MenuCommand,
    /// Action of two presses of the menu button.
    pub menu_cmd_2: MenuCommand,
    /// Action of three presses of the menu button.
    pub menu_cmd_3: MenuCommand,
    /// Action of four presses of the menu button.
    pub menu_cmd_4: MenuCommand,
    /// Action of five presses of the menu button.
    pub menu_cmd_5: MenuCommand,
    /// Action of a long press of the menu button.
    pub menu_cmd_long: MenuCommand,
    /// Motor output of each axis.
    pub motor_output: PerAxis<MotorOutput>,
    /// Battery voltage below which an alarm sounds. Negative: never.
    #[wire(range = -3000..=3000)]
    pub bat_threshold_alarm: VoltageThreshold,
    /// Below this battery voltage the motors stop. Negative: never.
    #[wire(range = -3000..=3000)]
    pub bat_threshold_motors: VoltageThreshold,
    /// Voltage of the full battery, from which the power of the motors is compensated. Negative: not at all.
    #[wire(range = -3000..=3000)]
    pub bat_comp_ref: VoltageThreshold,
    /// When the board beeps, and how.
    pub beeper_modes: BeeperModes,
    /// From which tilt on ROLL begins to be mixed into following.
    #[wire(unit = "deg", range = 0..=90)]
    pub follow_roll_mix_start: u8,
    /// Over how many degrees that mix grows to its full.
    #[wire(unit = "deg", range = 0..=90)]
    pub follow_roll_mix_range: u8,
    /// Power that is added to each motor to catch up when it loses synchronization.
    pub booster_power: PerAxis<u8>,
    /// Follow speed of each axis.
    pub follow_speed: PerAxis<u8>,
    /// Whether the frame's angles are estimated from the motors.
    pub frame_angle_from_motors: Switch,
    /// The angle that each axis takes at start.
    ///
    /// The specification prints -36767 as the minimum, which two bytes cannot hold; -32767 is meant.
    #[wire(range = -32767..=32767)]
    pub rc_memory: PerAxis<Angle>,
    /// Virtual channel that is put out on servo output 1, from 1 on; 0 for none.
    #[wire(range = 0..=32)]
    pub servo1_out: u8,
    /// Virtual channel that is put out on servo output 2, from 1 on; 0 for none.
    #[wire(range = 0..=32)]
    pub servo2_out: u8,
    /// Virtual channel that is put out on servo output 3, from 1 on; 0 for none.
    #[wire(range = 0..=32)]
    pub servo3_out: u8,
    /// Virtual channel that is put out on servo output 4, from 1 on; 0 for none.
    #[wire(range = 0..=32)]
    pub servo4_out: u8,
    /// Repetition rate of the servo outputs.
    #[wire(range = 5..=40)]
    pub servo_rate: ServoRate,
    /// On which axes the controller lowers its gains by itself when they vibrate.
    pub adaptive_pid_enabled: AdaptivePidAxes,
    /// Vibration threshold.
    pub adaptive_pid_threshold: u8,
    /// Rate of the gain reduction.
    #[wire(range = 1..=255)]
    pub adaptive_pid_rate: u8,
    /// Recovery time.
    #[wire(range = 0..=10)]
    pub adaptive_pid_recovery_factor: u8,
    /// Low-pass filter of following; 255 is the maximum where `LPF_EXTENDED_RANGE` of
    /// [`GeneralFlags2`](super::GeneralFlags2) is set.
    #[wire(range = 0..=15)]
    pub follow_lpf: PerAxis<u8>,
    /// Settings that all profiles share.
    pub general_flags1: GeneralFlags1,
    /// Settings of this profile.
    pub profile_flags1: ProfileFlags1,
    /// Protocol of a Spektrum receiver.
    pub spektrum_mode: SpektrumMode,
    /// Order of the hardware axes.
    pub order_of_axes: OrderOfAxes,
    /// In which Euler angles the camera's attitude and its target are expressed.
    pub euler_order: EulerConvention,
    /// The IMU that is selected now.
    pub cur_imu: ImuType,
    /// The profile that is active now.
    #[wire(range = 0..=4)]
    pub cur_profile_id: ProfileId,
}

/// Motor and controller of one axis.
#[record(size = 6)]
#[derive(Copy)]
pub struct MotorTuning {
    /// Response of the controller to an error.
    pub p: PidTerm,
    /// Integral term of the controller. Displayed divided by 100 before firmware 2.73.1.
    pub i: PidTerm,
    /// Damping of the controller.
    pub d: PidTerm,
    /// Power of the motor; 255 is the maximum.
    pub power: u8,
    /// Whether the motor turns the other way. [`CalibPoles`](crate::commands::CalibPoles) finds it.
    pub invert: Switch,
    /// Number of the motor's magnetic poles. [`CalibPoles`](crate::commands::CalibPoles) finds it.
    pub poles: u8,
}

/// Remote control settings of one axis.
#[record(size = 8)]
#[derive(Copy)]
pub struct RcAxis {
    /// Minimum angle of remote control.
    #[wire(unit = "deg", range = -720..=720)]
    pub rc_min_angle: i16,
    /// Maximum angle of remote control.
    #[wire(unit = "deg", range = -720..=720)]
    pub rc_max_angle: i16,
    /// Meaning of the signal, and whether it is inverted.
    pub rc_mode: RcAxisMode,
    /// Low-pass filter of the signal; 255 is the maximum where `LPF_EXTENDED_RANGE` of
    /// [`GeneralFlags2`](super::GeneralFlags2) is set.
    #[wire(range = 0..=15)]
    pub rc_lpf: u8,
    /// Speed of the axis.
    pub rc_speed: u8,
    /// For ROLL and PITCH the rate at which they follow the flight controller; for YAW, all but zero follows the
    /// motor.
    ///
    /// Signed, although the specification's type column differs.
    #[wire(range = -127..=127)]
    pub rc_follow: i8,
}
