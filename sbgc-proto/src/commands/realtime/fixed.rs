//! Real-time data of fixed layout.

use sbgc_proto_macros::{message, record};

use super::{CalibMode, RtDataFlags, SystemErrors, SystemStateFlags, SystemSubError};
use crate::commands::{ImuType, ProfileId};
use crate::units::{Acceleration, Angle, AttitudeError, SensorRate, Voltage};
use crate::wire::{PerAxis, PerXyz, Reserved};

/// Requests real-time data by the old id.
///
/// The answer has another: it is [`RealtimeData3`].
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
    /// Errors of the serial connection since the start.
    pub serial_err_cnt: u16,
    /// Errors of the system.
    pub system_error: SystemErrors,
    /// Reason for the emergency stop of the motors.
    pub system_sub_error: SystemSubError,
    pub reserved: Reserved<3>,
    /// Control signal for ROLL, PWM or analog brought to the same range.
    #[wire(range = 1000..=2000)]
    pub rc_roll: i16,
    /// Control signal for PITCH.
    #[wire(range = 1000..=2000)]
    pub rc_pitch: i16,
    /// Control signal for YAW.
    #[wire(range = 1000..=2000)]
    pub rc_yaw: i16,
    /// Signal of the command channel.
    #[wire(range = 1000..=2000)]
    pub rc_cmd: i16,
    /// Signal of the flight controller for ROLL. It may be 0 where the input serves for control or commands.
    #[wire(range = 1000..=2000)]
    pub ext_fc_roll: i16,
    /// Signal of the flight controller for PITCH. It may be 0 as that for ROLL may.
    #[wire(range = 1000..=2000)]
    pub ext_fc_pitch: i16,
    /// Camera angles.
    pub imu_angle: PerAxis<Angle>,
    /// Frame attitude, if the frame has an IMU.
    pub frame_imu_angle: PerAxis<Angle>,
    /// Target camera angles.
    pub target_angle: PerAxis<Angle>,
    /// Time that a cycle of the firmware takes; normally 800.
    #[wire(unit = "us")]
    pub cycle_time: u16,
    /// Errors of the I2C bus since the start.
    pub i2c_error_count: u16,
    /// Out of use; `system_error` took its place.
    pub error_code: u8,
    /// Voltage of the battery.
    pub bat_level: Voltage,
    /// Whether the motors are on.
    pub rt_data_flags: RtDataFlags,
    /// The IMU that `imu_angle` and the sensor values are of, as [`SelectImu3`](crate::commands::SelectImu3) chose it.
    pub cur_imu: ImuType,
    /// The active profile.
    #[wire(range = 0..=4)]
    pub cur_profile: ProfileId,
    /// Power of each motor, 255 at most.
    pub motor_power: PerAxis<u8>,
}

/// Sensors of one axis, with the calibrations applied.
#[record(size = 4)]
#[derive(Copy)]
pub struct SensorAxis {
    /// Accelerometer.
    pub acc_data: Acceleration,
    /// Gyroscope.
    pub gyro_data: SensorRate,
}

/// Requests all of [`RealtimeData3`], and joint angles, balance, current, magnetometer, temperatures and motor output.
#[message(CMD_REALTIME_DATA_4, outgoing, size = 0, answer = RealtimeData4)]
pub struct RealtimeData4Request;

/// All of [`RealtimeData3`], and joint angles, balance, current, magnetometer, temperatures and motor output.
#[message(CMD_REALTIME_DATA_4, incoming, size = 124)]
#[derive(Copy)]
pub struct RealtimeData4 {
    /// Fields of the shorter message, in the same first 63 bytes.
    #[wire(group)]
    pub realtime_data_3: RealtimeData3,
    /// Joint (stator–rotor) angles from encoders, the second IMU or otherwise; 0 is the normal position.
    ///
    /// Newer documents call it FRAME_CAM_ANGLE.
    pub stator_rotor_angle: PerAxis<Angle>,
    pub reserved_1: Reserved<1>,
    /// Balance error of each motor: 0 when balanced, 512 at full power.
    #[wire(range = -512..=512)]
    pub balance_error: PerAxis<i16>,
    /// Current of the whole system.
    #[wire(unit = "mA")]
    pub current: u16,
    /// Magnetometer, each component calibrated to ±1000.
    #[wire(range = -1000..=1000)]
    pub mag_data: PerXyz<i16>,
    /// Temperature of the IMU.
    #[wire(unit = "degC", range = -127..=127)]
    pub imu_temperature: i8,
    /// Temperature of the frame's IMU.
    #[wire(unit = "degC", range = -127..=127)]
    pub frame_imu_temperature: i8,
    /// Error of the estimated gravity of the active IMU against its reference.
    pub imu_g_err: AttitudeError,
    /// Error of the estimated heading of the active IMU against its reference.
    pub imu_h_err: AttitudeError,
    /// Motor output, 10000 at full power; firmware with encoders only.
    #[wire(range = -10000..=10000, since = "2.61")]
    pub motor_out: PerAxis<i16>,
    /// Running calibration or automatic task. Reserved in older firmware.
    pub calib_mode: CalibMode,
    /// Error of the sensor behind a CAN IMU. Reserved before newer firmware.
    pub can_imu_ext_sens_err: u8,
    /// The angle that control works on: that of the IMU in inertial modes, of the motor in modes relative to motors.
    #[wire(since = "2.72b0")]
    pub actual_angle: PerAxis<Angle>,
    /// System state flags.
    #[wire(since = "2.73")]
    pub system_state_flags: SystemStateFlags,
    pub reserved_2: Reserved<18>,
}
