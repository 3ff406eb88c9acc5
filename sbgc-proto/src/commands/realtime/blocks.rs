//! Records within custom real-time data.

use sbgc_proto_macros::{bit_fields, open_enum, record};

use super::{CalibMode, CanErrFlags, MotorFlags, PowerState, SystemPowerFlags, SystemStateFlags};

use crate::units::{Angle, AttitudeError, LimitDistance, SensorRate, Voltage};
use crate::wire::{Float, PerAxis, Reserved};

/// Data for an external controller of a fourth axis. Spec: `MOTOR4_CONTROL`.
#[record(size = 8, since = "2.68")]
#[derive(Copy)]
pub struct Motor4Control {
    /// Feed-forward speed.
    pub ff_speed: SensorRate,
    /// Angle error of the fourth axis.
    pub angle_error: Angle,
    /// Output of the internal PID controller for `angle_error`, with `ff_speed` mixed in, multiplied by the parameter
    /// "scale factor".
    pub pid_out: Float,
}

/// State of the attitude and heading reference system. Spec: `AHRS_DEBUG_INFO`.
///
/// The specification's table lacks the last row, but the total of 26 bytes is certain.
#[record(size = 26, since = "2.66")]
#[derive(Copy)]
pub struct AhrsDebugInfo {
    /// Reference source of the main IMU.
    pub main_imu_ref_src: ImuRefSrc,
    /// Reference source of the frame IMU.
    pub frame_imu_ref_src: ImuRefSrc,
    /// Attitude error of the main IMU against its reference.
    pub main_imu_z_ref_err: AttitudeError,
    /// Heading error of the main IMU against its reference.
    pub main_imu_h_ref_err: AttitudeError,
    /// Attitude error of the frame IMU against its reference.
    pub frame_imu_z_ref_err: AttitudeError,
    /// Heading error of the frame IMU against its reference.
    pub frame_imu_h_ref_err: AttitudeError,
    /// State of the external IMU.
    pub ext_imu_status: ExtImuState,
    /// Number of packets received from the external IMU, wrapping after 65535.
    pub ext_imu_packets_received_cnt: u16,
    /// Number of packets from the external IMU that could not be parsed, wrapping after 65535.
    pub ext_imu_parse_err_cnt: u16,
    /// Heading error against the external reference.
    pub ext_corr_h_err: AttitudeError,
    /// Attitude error against the external reference.
    pub ext_corr_z_err: AttitudeError,
    pub reserved: Reserved<13>,
}

/// Reference source of an IMU.
#[bit_fields(u8)]
pub struct ImuRefSrc {
    /// Source of the attitude reference.
    #[wire(bits = 0..=2, spec = "ATTITUDE_REF")]
    pub attitude: AhrsRefSrc,
    /// Source of the heading reference.
    #[wire(bits = 3..=5, spec = "HEADING_REF")]
    pub heading: AhrsRefSrc,
    /// The internal sensor is connected and in use; otherwise the attitude comes from an external source.
    #[wire(bits = 6)]
    pub internal_sensor: bool,
    /// The IMU is being processed.
    #[wire(bits = 7)]
    pub enabled: bool,
}

/// Source of an attitude or heading reference. Spec: `AHRS_REF_SRC`.
#[open_enum(u8, prefix = "REF_")]
pub enum AhrsRefSrc {
    /// No reference.
    No = 0,
    /// Own accelerometer or magnetometer of the sensor.
    Internal = 1,
    /// External source.
    External = 2,
    /// Derived from the other IMU through the joint angles.
    Translate = 3,
}

/// State of the external IMU.
#[bit_fields(u8)]
pub struct ExtImuState {
    /// Status of the external IMU.
    #[wire(bits = 0..=2, spec = "EXT_IMU_STATUS")]
    pub status: ExtImuStatus,
    /// The magnetometer of the external IMU is disturbed.
    #[wire(bits = 6, spec = "STATUS_FLAG_BAD_MAG")]
    pub bad_mag: bool,
    /// The external IMU receives no satellite signal.
    #[wire(bits = 7, spec = "STATUS_FLAG_NO_GPS_SIGNAL")]
    pub no_gps_signal: bool,
}

/// Status of the external IMU; `Bad` and above rate the quality of its attitude. Spec: `EXT_IMU_STATUS`.
#[open_enum(u8, prefix = "STATUS_")]
pub enum ExtImuStatus {
    /// Turned off.
    Disabled = 0,
    /// Not connected.
    NotConnected = 1,
    /// Not known yet.
    #[wire(spec = "STATUS_UNKNOWN")]
    NotKnown = 2,
    /// Error.
    Error = 3,
    /// Attitude of bad quality.
    Bad = 4,
    /// Attitude of coarse quality.
    Coarse = 5,
    /// Attitude of good quality.
    Good = 6,
    /// Attitude of fine quality.
    Fine = 7,
}

/// Power and state of the motors. Spec: `SYSTEM_POWER_STATE`.
#[record(size = 46, since = "2.70b6")]
#[derive(Copy)]
pub struct SystemPowerState {
    /// Power and state of each motor.
    #[wire(group)]
    pub axes: PerAxis<MotorPower>,
    /// State of motor power.
    pub system_power_state: PowerState,
    /// Battery voltage.
    pub battery_voltage: Voltage,
    /// Total current of the system.
    #[wire(unit = "mA")]
    pub total_current: u16,
    /// State of the motor power system.
    pub system_flags: SystemPowerFlags,
}

/// Power and state of one motor.
#[record(size = 13)]
#[derive(Copy)]
pub struct MotorPower {
    /// Motor output; 10000 is full power.
    #[wire(range = -10000..=10000)]
    pub mot_power: i16,
    /// Motor current.
    #[wire(unit = "mA")]
    pub mot_current: u16,
    /// Motor temperature.
    #[wire(unit = "degC")]
    pub mot_temp: i8,
    /// System state flags.
    pub mot_flags: MotorFlags,
    pub mot_reserved: Reserved<6>,
}

/// Communication errors since the start. Spec: `COMM_ERRORS`.
#[record(size = 7, since = "2.72b0")]
#[derive(Copy)]
pub struct CommErrors {
    /// Number of I2C bus errors.
    pub i2c_errors: u16,
    /// Number of serial port errors.
    pub serial_errors: u16,
    /// Number of CAN bus errors.
    pub can_errors: u16,
    /// Kinds of CAN bus errors that occurred.
    pub can_err_flags: CanErrFlags,
}

/// System state in custom real-time data. Spec: `SYSTEM_STATE`, not to be confused with the command of that name.
#[record(size = 13, since = "2.73")]
#[derive(Copy)]
pub struct SystemStateBlock {
    /// System state flags.
    pub flags: SystemStateFlags,
    /// Running calibration or automatic task.
    pub calib_mode: CalibMode,
    pub reserved: Reserved<8>,
}

/// State of the main IMU. Spec: `MAIN_IMU_STATE`.
///
/// Published in the vendor's Python library only, without units or the names of flags.
#[record(size = 11)]
#[derive(Copy)]
pub struct MainImuState {
    /// Gravity error against its reference. The unit is not published.
    pub g_ref_err: u8,
    /// Heading error against its reference. The unit is not published.
    pub h_ref_err: u8,
    /// Flags. Their meaning is not published.
    pub flags: u8,
    /// Error of the external sensor.
    pub ext_sens_err: u8,
    pub reserved: Reserved<7>,
}

/// Distance of a joint to its software limits.
#[record(size = 4)]
#[derive(Copy)]
pub struct LimitDistances {
    /// Distance to the lower limit.
    pub sw_limit_dist_min: LimitDistance,
    /// Distance to the upper limit.
    pub sw_limit_dist_max: LimitDistance,
}
