//! Groups of values that stand in chosen real-time data.

use sbgc_proto_macros::{bit_fields, open_enum, record};

use super::{CalibMode, CanErrFlags, MotorFlags, PowerState, SystemPowerFlags, SystemStateFlags};

use crate::units::{Angle, AttitudeError, LimitDistance, SensorRate, Voltage};
use crate::wire::{Float, PerAxis, Reserved};

/// Data for an external controller of a fourth axis. Spec: `MOTOR4_CONTROL`.
#[record(size = 8, since = "2.68")]
#[derive(Copy)]
pub struct Motor4Control {
    /// Speed to be fed forward.
    pub ff_speed: SensorRate,
    /// Angle error of the fourth axis.
    pub angle_error: Angle,
    /// Output of the internal PID over `angle_error` with `ff_speed` mixed in, times the parameter "scale factor".
    pub pid_out: Float,
}

/// State of the attitude and heading reference system. Spec: `AHRS_DEBUG_INFO`.
///
/// The specification's table lacks the last row; 26 bytes in all are certain.
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
    /// Packets received from the external IMU; starts again after 65535.
    pub ext_imu_packets_received_cnt: u16,
    /// Packets from the external IMU that could not be read; starts again after 65535.
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
    /// Reference of the attitude.
    #[wire(bits = 0..=2, spec = "ATTITUDE_REF")]
    pub attitude: AhrsRefSrc,
    /// Reference of the heading.
    #[wire(bits = 3..=5, spec = "HEADING_REF")]
    pub heading: AhrsRefSrc,
    /// The internal sensor is connected and used; otherwise the attitude comes from outside.
    #[wire(bits = 6)]
    pub internal_sensor: bool,
    /// This IMU is being processed.
    #[wire(bits = 7)]
    pub enabled: bool,
}

/// Source of an attitude or heading reference. Spec: `AHRS_REF_SRC`.
#[open_enum(u8, prefix = "REF_")]
pub enum AhrsRefSrc {
    /// There is none.
    No = 0,
    /// From the sensor's own accelerometer or magnetometer.
    Internal = 1,
    /// From outside.
    External = 2,
    /// Translated from the other IMU through the joints.
    Translate = 3,
}

/// State of the external IMU.
#[bit_fields(u8)]
pub struct ExtImuState {
    /// Status of the external IMU.
    #[wire(bits = 0..=2, spec = "EXT_IMU_STATUS")]
    pub status: ExtImuStatus,
    /// Its magnetometer is disturbed.
    #[wire(bits = 6, spec = "STATUS_FLAG_BAD_MAG")]
    pub bad_mag: bool,
    /// It has no satellites.
    #[wire(bits = 7, spec = "STATUS_FLAG_NO_GPS_SIGNAL")]
    pub no_gps_signal: bool,
}

/// Status of the external IMU; from `Bad` on it grades its attitude. Spec: `EXT_IMU_STATUS`.
#[open_enum(u8, prefix = "STATUS_")]
pub enum ExtImuStatus {
    /// It is switched off.
    Disabled = 0,
    /// It is not connected.
    NotConnected = 1,
    /// Nothing is known of it yet.
    #[wire(spec = "STATUS_UNKNOWN")]
    NotKnown = 2,
    /// It has an error.
    Error = 3,
    /// Its attitude is bad.
    Bad = 4,
    /// Its attitude is coarse.
    Coarse = 5,
    /// Its attitude is good.
    Good = 6,
    /// Its attitude is fine.
    Fine = 7,
}

/// Power and state of the motors. Spec: `SYSTEM_POWER_STATE`.
#[record(size = 46, since = "2.70b6")]
#[derive(Copy)]
pub struct SystemPowerState {
    /// Each motor.
    #[wire(group)]
    pub axes: PerAxis<MotorPower>,
    /// Whether the motors have power.
    pub system_power_state: PowerState,
    /// Voltage of the battery.
    pub battery_voltage: Voltage,
    /// Current of the whole system.
    #[wire(unit = "mA")]
    pub total_current: u16,
    /// State of the motor power system.
    pub system_flags: SystemPowerFlags,
}

/// Power and state of one motor.
#[record(size = 13)]
#[derive(Copy)]
pub struct MotorPower {
    /// Its output, 10000 at full power.
    #[wire(range = -10000..=10000)]
    pub mot_power: i16,
    /// Its current.
    #[wire(unit = "mA")]
    pub mot_current: u16,
    /// Its temperature.
    #[wire(unit = "degC")]
    pub mot_temp: i8,
    /// State of the motor.
    pub mot_flags: MotorFlags,
    pub mot_reserved: Reserved<6>,
}

/// Errors of communication since the start. Spec: `COMM_ERRORS`.
#[record(size = 7, since = "2.72b0")]
#[derive(Copy)]
pub struct CommErrors {
    /// Errors of the I2C bus.
    pub i2c_errors: u16,
    /// Errors of the serial ports.
    pub serial_errors: u16,
    /// Errors of the CAN bus.
    pub can_errors: u16,
    /// Kinds of CAN bus errors seen.
    pub can_err_flags: CanErrFlags,
}

/// System state. Spec: `SYSTEM_STATE`, a part of custom real-time data; not the command of that name.
#[record(size = 13, since = "2.73")]
#[derive(Copy)]
pub struct SystemStateBlock {
    /// State of the motor.
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
    /// Gravity error against its reference, in an unpublished unit.
    pub g_ref_err: u8,
    /// Heading error against its reference, in an unpublished unit.
    pub h_ref_err: u8,
    /// Flags, whose meaning is not published.
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
