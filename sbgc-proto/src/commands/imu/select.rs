//! Selection of the active IMU, and correction of gyroscope zero.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{CalibAction, CalibImu, Confirm, ImuType};
use crate::units::{CalibrationTime, GyroZero};
use crate::wire::PerXyz;

/// Selects the IMU for calibrations and real-time data.
///
/// The board ignores the command if that IMU is not connected. Sources disagree on whether it confirms: accept a
/// `CMD_CONFIRM`, but do not rely on one.
#[message(CMD_SELECT_IMU_3, outgoing, form = "simple", default, size = 1, length = 1)]
pub struct SelectImu3 {
    /// IMU to select.
    pub imu_type: ImuType,
}

/// Selects an IMU and calibrates it; or resets, copies, enables or disables its calibration. Newer firmware.
///
/// The vendor's libraries disagree on the length, 11 or 12 bytes with 7 or 8 reserved; both are supported here. Prefer
/// [`SelectImu3`] followed by [`CalibAcc`](crate::commands::CalibAcc), [`CalibGyro`](crate::commands::CalibGyro) or
/// [`CalibMag`](crate::commands::CalibMag), which have the same effect.
#[message(CMD_SELECT_IMU_3, outgoing, form = "extended", size = 11..=12, length = 11.., answer = Confirm)]
pub struct SelectImu3Extended<'a> {
    /// IMU to select.
    pub imu_type: CalibImu,
    /// Action to perform.
    pub action: CalibAction,
    /// Sampling time of the gyroscope; 0 for other sensors.
    pub time_ms: CalibrationTime,
    /// Reserved, 7 or 8 zero bytes.
    pub reserved: &'a [u8],
}

/// Corrects the zero of a gyroscope manually.
///
/// Not confirmed.
#[message(CMD_GYRO_CORRECTION, outgoing, size = 9)]
pub struct GyroCorrection {
    /// IMU to correct, numbered from 0, unlike in [`SelectImu3`]. One library uses 1 and 2 instead.
    pub imu_type: ImuIndex,
    /// Correction for the axes of the sensor.
    pub gyro_zero_corr: PerXyz<GyroZero>,
    /// Correction about the vertical axis, for heading drift only; the board distributes it over the sensor axes.
    pub gyro_zero_heading_corr: GyroZero,
}

/// IMU, numbered from 0. Spec: `IMU_INDEX0`.
///
/// Used by `CMD_GYRO_CORRECTION` and the data stream of `CMD_AHRS_HELPER`; all other commands use [`ImuType`].
#[open_enum(u8)]
pub enum ImuIndex {
    /// IMU on the camera platform.
    Main = 0,
    /// IMU on the frame.
    Frame = 1,
}
