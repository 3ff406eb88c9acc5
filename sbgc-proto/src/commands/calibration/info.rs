//! Progress of a sensor calibration.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{ImuType, Switch};
use crate::declare::flags;
use crate::units::Acceleration;
use crate::wire::{PerXyz, Reserved};

/// Requests the progress of a sensor calibration.
///
/// Send it periodically while [`CalibAcc`](crate::commands::CalibAcc), [`CalibGyro`](crate::commands::CalibGyro) or
/// [`CalibMag`](crate::commands::CalibMag) runs.
#[message(CMD_CALIB_INFO, outgoing, size = 12, answer = CalibInfo, echo = imu_type)]
pub struct CalibInfoRequest {
    /// IMU that is calibrated.
    pub imu_type: ImuType,
    pub reserved: Reserved<11>,
}

/// Progress of a sensor calibration, and the calibrations that already exist.
#[message(CMD_CALIB_INFO, incoming, size = 33)]
pub struct CalibInfo {
    /// Progress of the calibration.
    #[wire(unit = "%", range = 0..=100)]
    pub progress: u8,
    /// IMU that is calibrated.
    pub imu_type: ImuType,
    /// Calibrated acceleration.
    pub acc_data: PerXyz<Acceleration>,
    /// Amplitude of the gyroscope signal, which shows how much the IMU moves.
    pub gyro_abs_val: u16,
    /// Axis of the accelerometer to calibrate now.
    pub acc_cur_axis: AccAxis,
    /// Limits of the accelerometer that are calibrated.
    pub acc_limits_info: AccLimits,
    /// Temperature of the IMU.
    #[wire(unit = "degC", range = -127..=127)]
    pub imu_temp_cels: i8,
    /// Whether the gyroscope calibration over temperature is enabled.
    pub temp_calib_gyro_enabled: Switch,
    /// Minimum temperature at which the gyroscope is calibrated.
    #[wire(unit = "degC", range = -127..=127)]
    pub temp_calib_gyro_t_min_cels: i8,
    /// Maximum temperature at which the gyroscope is calibrated.
    #[wire(unit = "degC", range = -127..=127)]
    pub temp_calib_gyro_t_max_cels: i8,
    /// Whether the accelerometer calibration over temperature is enabled.
    pub temp_calib_acc_enabled: Switch,
    /// Number of calibrated temperatures for each limit of the accelerometer.
    ///
    /// The order is +X, +Y, +Z, -X, -Y, -Z, unlike that of `acc_limits_info`.
    #[wire(range = 0..=3)]
    pub temp_calib_acc_slot_num: [u8; 6],
    /// Minimum temperature at which the accelerometer is calibrated.
    #[wire(unit = "degC")]
    pub temp_calib_acc_t_min_cels: i8,
    /// Maximum temperature at which the accelerometer is calibrated.
    #[wire(unit = "degC")]
    pub temp_calib_acc_t_max_cels: i8,
    /// Length of the difference between the estimated heading vector and its reference, in hundredths of a unit vector.
    pub h_err_length: u8,
    pub reserved: Reserved<7>,
}

/// Axis of the accelerometer. Spec: `ACC_CUR_AXIS`.
///
/// One library names them after the gimbal axes: roll, pitch and yaw. The specification refers to the sensor, so they
/// are called X, Y and Z here.
#[open_enum(u8)]
pub enum AccAxis {
    /// X axis of the sensor.
    X = 0,
    /// Y axis of the sensor.
    Y = 1,
    /// Z axis of the sensor.
    Z = 2,
}

flags! {
    /// Limits of the accelerometer: each axis pointing up or down. Spec: `ACC_LIMITS`.
    pub struct AccLimits: u8 {
        /// Positive X.
        const PLUS_X = 1 << 0;
        /// Negative X.
        const MINUS_X = 1 << 1;
        /// Positive Y.
        const PLUS_Y = 1 << 2;
        /// Negative Y.
        const MINUS_Y = 1 << 3;
        /// Positive Z.
        const PLUS_Z = 1 << 4;
        /// Negative Z.
        const MINUS_Z = 1 << 5;
    }
}
