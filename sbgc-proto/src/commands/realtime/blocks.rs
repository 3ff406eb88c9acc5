//! Groups of values that stand in chosen real-time data.

use sbgc_proto_macros::{open_enum, record};

use super::{CalibMode, CanErrFlags, MotorFlags, PowerState, SystemPowerFlags, SystemStateFlags};
use crate::units::{Angle, AttitudeError, LimitDistance, SensorRate, Voltage};
use crate::wire::{Float, PerAxis, Reserved, bit_enums, bit_fields};

/// What an external controller of the fourth axis' motor needs. Spec: `MOTOR4_CONTROL`.
#[record(size = 8, since = "2.68")]
#[derive(Copy)]
pub struct Motor4Control {
    /// Speed to be fed forward.
    pub ff_speed: SensorRate,
    /// How far the fourth axis is from its target.
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
    /// What the main IMU takes for reference.
    pub main_imu_ref_src: ImuRefSrc,
    /// What the frame IMU takes for reference.
    pub frame_imu_ref_src: ImuRefSrc,
    /// How far the main IMU's attitude is off its reference.
    pub main_imu_z_ref_err: AttitudeError,
    /// How far the main IMU's heading is off its reference.
    pub main_imu_h_ref_err: AttitudeError,
    /// How far the frame IMU's attitude is off its reference.
    pub frame_imu_z_ref_err: AttitudeError,
    /// How far the frame IMU's heading is off its reference.
    pub frame_imu_h_ref_err: AttitudeError,
    /// State of the external IMU.
    pub ext_imu_status: ExtImuState,
    /// Packets received from the external IMU; starts again after 65535.
    pub ext_imu_packets_received_cnt: u16,
    /// Packets from the external IMU that could not be read; starts again after 65535.
    pub ext_imu_parse_err_cnt: u16,
    /// How far the heading is off the external one.
    pub ext_corr_h_err: AttitudeError,
    /// How far the attitude is off the external one.
    pub ext_corr_z_err: AttitudeError,
    pub reserved: Reserved<13>,
}

bit_fields! {
    /// What an IMU takes for reference.
    pub struct ImuRefSrc: u8 {
        /// Reference of the attitude.
        0..=2 => attitude / with_attitude "ATTITUDE_REF": AhrsRefSrc,
        /// Reference of the heading.
        3..=5 => heading / with_heading "HEADING_REF": AhrsRefSrc,
        /// The internal sensor is connected and used; otherwise the attitude comes from outside.
        6..=6 => internal_sensor / with_internal_sensor "INTERNAL_SENSOR": bool,
        /// This IMU is being processed.
        7..=7 => enabled / with_enabled "ENABLED": bool,
    }
}

/// Where a reference of attitude or heading comes from. Spec: `AHRS_REF_SRC`.
#[open_enum(u8)]
pub enum AhrsRefSrc {
    /// There is none.
    #[wire(spec = "REF_NO")]
    No = 0,
    /// From the sensor's own accelerometer or magnetometer.
    #[wire(spec = "REF_INTERNAL")]
    Internal = 1,
    /// From outside.
    #[wire(spec = "REF_EXTERNAL")]
    External = 2,
    /// Translated from the other IMU through the joints.
    #[wire(spec = "REF_TRANSLATE")]
    Translate = 3,
}
bit_enums!(AhrsRefSrc, ExtImuStatus);

bit_fields! {
    /// State of the external IMU.
    pub struct ExtImuState: u8 {
        /// How it does.
        0..=2 => status / with_status "EXT_IMU_STATUS": ExtImuStatus,
        /// Its magnetometer is disturbed.
        6..=6 => bad_mag / with_bad_mag "STATUS_FLAG_BAD_MAG": bool,
        /// It has no satellites.
        7..=7 => no_gps_signal / with_no_gps_signal "STATUS_FLAG_NO_GPS_SIGNAL": bool,
    }
}

/// How the external IMU does; from `Bad` on it is a grade of its attitude. Spec: `EXT_IMU_STATUS`.
#[open_enum(u8)]
pub enum ExtImuStatus {
    /// It is switched off.
    #[wire(spec = "STATUS_DISABLED")]
    Disabled = 0,
    /// It is not connected.
    #[wire(spec = "STATUS_NOT_CONNECTED")]
    NotConnected = 1,
    /// Nothing is known of it yet.
    #[wire(spec = "STATUS_UNKNOWN")]
    NotKnown = 2,
    /// It has an error.
    #[wire(spec = "STATUS_ERROR")]
    Error = 3,
    /// Its attitude is bad.
    #[wire(spec = "STATUS_BAD")]
    Bad = 4,
    /// Its attitude is coarse.
    #[wire(spec = "STATUS_COARSE")]
    Coarse = 5,
    /// Its attitude is good.
    #[wire(spec = "STATUS_GOOD")]
    Good = 6,
    /// Its attitude is fine.
    #[wire(spec = "STATUS_FINE")]
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
    /// What is going on at the motors as a whole.
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
    /// What is going on there.
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
    /// What kinds of errors the CAN bus has had.
    pub can_err_flags: CanErrFlags,
}

/// What the system does. Spec: `SYSTEM_STATE`, a part of chosen real-time data; not the command of that name.
#[record(size = 13, since = "2.73")]
#[derive(Copy)]
pub struct SystemStateBlock {
    /// What state it is in.
    pub flags: SystemStateFlags,
    /// Which calibration or automatic task runs.
    pub calib_mode: CalibMode,
    pub reserved: Reserved<8>,
}

/// State of the main IMU. Spec: `MAIN_IMU_STATE`.
///
/// Published in the vendor's Python library only, without units or the names of flags.
#[record(size = 11)]
#[derive(Copy)]
pub struct MainImuState {
    /// How far gravity is off its reference, in a unit that is not published.
    pub g_ref_err: u8,
    /// How far the heading is off its reference, in a unit that is not published.
    pub h_ref_err: u8,
    /// Flags, whose meaning is not published.
    pub flags: u8,
    /// Error of the external sensor.
    pub ext_sens_err: u8,
    pub reserved: Reserved<7>,
}

/// How far a joint is from its software limits.
#[record(size = 4)]
#[derive(Copy)]
pub struct LimitDistances {
    /// Distance to the lower limit.
    pub sw_limit_dist_min: LimitDistance,
    /// Distance to the upper limit.
    pub sw_limit_dist_max: LimitDistance,
}
