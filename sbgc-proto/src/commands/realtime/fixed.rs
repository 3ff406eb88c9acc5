//! Real-time data with a fixed layout.

use sbgc_proto_macros::{message, record};

use super::{CalibMode, RtDataFlags, SystemErrors, SystemStateFlags, SystemSubError};
use crate::commands::{ImuType, ProfileId};
use crate::units::{Acceleration, Angle, AttitudeError, SensorRate, Voltage};
use crate::wire::{PerAxis, PerXyz, Reserved};

/// Requests real-time data by the old command id.
///
/// The answer has a different id: [`RealtimeData3`].
#[message(CMD_REALTIME_DATA, outgoing, size = 0, answer = RealtimeData3)]
pub struct RealtimeDataRequest;

/// Requests sensors, errors, control signals, angles, battery and motor power.
#[message(CMD_REALTIME_DATA_3, outgoing, size = 0, answer = RealtimeData3)]
pub struct RealtimeData3Request;

/// Sensors, errors, control signals, angles, battery and motor power.
#[message(CMD_REALTIME_DATA_3, incoming, size = 63)]
#[derive(Copy)]
pub struct RealtimeData3 {
    /// Sensors of each axis.
    #[wire(group)]
    pub axes: PerAxis<SensorAxis>,
    /// Number of serial communication errors since the start.
    pub serial_err_cnt: u16,
    /// System errors.
    pub system_error: SystemErrors,
    /// Reason for the emergency stop of the motors.
    pub system_sub_error: SystemSubError,
    pub reserved: Reserved<3>,
    /// Control signal for ROLL: PWM, or analog scaled to the same range.
    #[wire(range = 1000..=2000)]
    pub rc_roll: i16,
    /// Control signal for PITCH, scaled like `rc_roll`.
    #[wire(range = 1000..=2000)]
    pub rc_pitch: i16,
    /// Control signal for YAW, scaled like `rc_roll`.
    #[wire(range = 1000..=2000)]
    pub rc_yaw: i16,
    /// Signal of the command channel, scaled like `rc_roll`.
    #[wire(range = 1000..=2000)]
    pub rc_cmd: i16,
    /// Signal of the flight controller for ROLL; may be 0 if the input is used for control or commands.
    #[wire(range = 1000..=2000)]
    pub ext_fc_roll: i16,
    /// Signal of the flight controller for PITCH; may be 0 if the input is used for control or commands.
    #[wire(range = 1000..=2000)]
    pub ext_fc_pitch: i16,
    /// Camera angles.
    pub imu_angle: PerAxis<Angle>,
    /// Frame attitude, if a frame IMU is present.
    pub frame_imu_angle: PerAxis<Angle>,
    /// Target camera angles.
    pub target_angle: PerAxis<Angle>,
    /// Cycle time of the firmware, normally 800.
    #[wire(unit = "us")]
    pub cycle_time: u16,
    /// Number of I2C bus errors since the start.
    pub i2c_error_count: u16,
    /// Obsolete; replaced by `system_error`.
    pub error_code: u8,
    /// Battery voltage.
    pub bat_level: Voltage,
    /// Motor power state.
    pub rt_data_flags: RtDataFlags,
    /// IMU that `imu_angle` and the sensor values refer to, as selected by [`SelectImu3`](crate::commands::SelectImu3).
    pub cur_imu: ImuType,
    /// Active profile.
    #[wire(range = 0..=4)]
    pub cur_profile: ProfileId,
    /// Power of each motor; 255 is the maximum.
    pub motor_power: PerAxis<u8>,
}

/// Sensors of one axis, with the calibrations applied.
#[record(size = 4)]
#[derive(Copy)]
pub struct SensorAxis {
    /// Acceleration.
    pub acc_data: Acceleration,
    /// Angular rate.
    pub gyro_data: SensorRate,
}

/// Requests [`RealtimeData3`] plus joint angles, balance, current, magnetometer, temperatures and motor output.
#[message(CMD_REALTIME_DATA_4, outgoing, size = 0, answer = RealtimeData4)]
pub struct RealtimeData4Request;

/// [`RealtimeData3`] plus joint angles, balance, current, magnetometer, temperatures and motor output.
#[message(CMD_REALTIME_DATA_4, incoming, size = 124)]
#[derive(Copy)]
pub struct RealtimeData4 {
    /// Fields of [`RealtimeData3`], in the first 63 bytes.
    #[wire(group)]
    pub realtime_data_3: RealtimeData3,
    /// Joint (stator–rotor) angles from encoders, the second IMU or another source; 0 is the normal position.
    ///
    /// Newer documents call them `FRAME_CAM_ANGLE`.
    pub stator_rotor_angle: PerAxis<Angle>,
    pub reserved_1: Reserved<1>,
    /// Balance error of each motor: 0 is perfectly balanced, 512 is full power.
    #[wire(range = -512..=512)]
    pub balance_error: PerAxis<i16>,
    /// Total current of the system.
    #[wire(unit = "mA")]
    pub current: u16,
    /// Magnetometer, each component calibrated to ±1000.
    #[wire(range = -1000..=1000)]
    pub mag_data: PerXyz<i16>,
    /// Temperature of the IMU.
    #[wire(unit = "degC", range = -127..=127)]
    pub imu_temperature: i8,
    /// Temperature of the frame IMU.
    #[wire(unit = "degC", range = -127..=127)]
    pub frame_imu_temperature: i8,
    /// Error of the estimated gravity of the active IMU against its reference.
    pub imu_g_err: AttitudeError,
    /// Error of the estimated heading of the active IMU against its reference.
    pub imu_h_err: AttitudeError,
    /// Motor output; 10000 is full power. Firmware for encoders only.
    #[wire(range = -10000..=10000, since = "2.61")]
    pub motor_out: PerAxis<i16>,
    /// Running calibration or automatic task. Reserved in older firmware.
    pub calib_mode: CalibMode,
    /// Error of the external sensor of a CAN IMU. Reserved in older firmware.
    pub can_imu_ext_sens_err: u8,
    /// Angle used for control: the IMU angle in inertial modes, the motor angle in modes relative to motors.
    #[wire(since = "2.72b0")]
    pub actual_angle: PerAxis<Angle>,
    /// System state flags.
    #[wire(since = "2.73")]
    pub system_state_flags: SystemStateFlags,
    pub reserved_2: Reserved<18>,
}
