//! How a calibration of a sensor is going.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{ImuType, Switch};
use crate::declare::flags;
use crate::units::Acceleration;
use crate::wire::{PerXyz, Reserved};

/// Asks how the calibration of a sensor is going.
///
/// To be sent periodically while [`CalibAcc`](crate::commands::CalibAcc), [`CalibGyro`](crate::commands::CalibGyro)
/// or [`CalibMag`](crate::commands::CalibMag) runs.
#[message(CMD_CALIB_INFO, outgoing, size = 12, answer = CalibInfo, echo = imu_type)]
pub struct CalibInfoRequest {
    /// Sensor to use.
    pub imu_type: ImuType,
    pub reserved: Reserved<11>,
}

/// Progress of a sensor calibration, and what is calibrated already.
#[message(CMD_CALIB_INFO, incoming, size = 33)]
pub struct CalibInfo {
    /// Progress of the calibration.
    #[wire(unit = "%", range = 0..=100)]
    pub progress: u8,
    /// Sensor to use.
    pub imu_type: ImuType,
    /// Accelerometer, calibrated.
    pub acc_data: PerXyz<Acceleration>,
    /// Amplitude of the gyroscope's signal: how much the sensor is moved.
    pub gyro_abs_val: u16,
    /// The axis of the accelerometer that is to be calibrated now.
    pub acc_cur_axis: AccAxis,
    /// The limits of the accelerometer that are calibrated.
    pub acc_limits_info: AccLimits,
    /// Temperature of the sensor.
    #[wire(unit = "degC", range = -127..=127)]
    pub imu_temp_cels: i8,
    /// Whether the gyroscope's calibration over temperature is in use.
    pub temp_calib_gyro_enabled: Switch,
    /// Lowest temperature at which the gyroscope is calibrated.
    #[wire(unit = "degC", range = -127..=127)]
    pub temp_calib_gyro_t_min_cels: i8,
    /// Highest temperature at which the gyroscope is calibrated.
    #[wire(unit = "degC", range = -127..=127)]
    pub temp_calib_gyro_t_max_cels: i8,
    /// Whether the accelerometer's calibration over temperature is in use.
    pub temp_calib_acc_enabled: Switch,
    /// Number of calibrated temperatures for each limit of the accelerometer.
    ///
    /// In the order +X, +Y, +Z, -X, -Y, -Z, which is not the order of `acc_limits_info`.
    #[wire(range = 0..=3)]
    pub temp_calib_acc_slot_num: [u8; 6],
    /// Lowest temperature at which the accelerometer is calibrated.
    #[wire(unit = "degC")]
    pub temp_calib_acc_t_min_cels: i8,
    /// Highest temperature at which the accelerometer is calibrated.
    #[wire(unit = "degC")]
    pub temp_calib_acc_t_max_cels: i8,
    /// Length of the difference between the estimated heading vector and its reference; 100 is the length of a whole
    /// unit vector.
    pub h_err_length: u8,
    pub reserved: Reserved<7>,
}

/// An axis of the accelerometer. Spec: `ACC_CUR_AXIS`.
///
/// One library calls them by the axes of the gimbal, roll, pitch and yaw. The spec speaks of the sensor, so these are
/// X, Y and Z.
#[open_enum(u8)]
pub enum AccAxis {
    /// The sensor's X.
    X = 0,
    /// The sensor's Y.
    Y = 1,
    /// The sensor's Z.
    Z = 2,
}

flags! {
    /// Limits of the accelerometer: an axis pointing up or down. Spec: `ACC_LIMITS`.
    pub struct AccLimits: u8 {
        /// X, positive.
        const PLUS_X = 1 << 0;
        /// X, negative.
        const MINUS_X = 1 << 1;
        /// Y, positive.
        const PLUS_Y = 1 << 2;
        /// Y, negative.
        const MINUS_Y = 1 << 3;
        /// Z, positive.
        const PLUS_Z = 1 << 4;
        /// Z, negative.
        const MINUS_Z = 1 << 5;
    }
}
