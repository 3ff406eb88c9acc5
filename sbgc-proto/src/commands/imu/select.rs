//! Which sensor commands work on, and the zero of its gyroscope.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{CalibAction, CalibImu, Confirm, ImuType};
use crate::units::{CalibrationTime, GyroZero};
use crate::wire::PerXyz;

/// Selects the IMU for calibrations and real-time data.
///
/// The board ignores it if that sensor is not connected. Sources disagree on whether it confirms: accept a
/// `CMD_CONFIRM`, but do not rely on one.
#[message(CMD_SELECT_IMU_3, outgoing, form = "simple", default, size = 1, length = 1)]
pub struct SelectImu3 {
    /// Sensor to use.
    pub imu_type: ImuType,
}

/// Selects an IMU and calibrates it, or resets, copies or switches its calibration. Newer firmware.
///
/// The vendor's libraries disagree on the length, 11 or 12 bytes, which leaves 7 or 8 bytes reserved; both are taken.
/// Prefer [`SelectImu3`] with [`CalibAcc`](crate::commands::CalibAcc), [`CalibGyro`](crate::commands::CalibGyro) or
/// [`CalibMag`](crate::commands::CalibMag), which do the same.
#[message(CMD_SELECT_IMU_3, outgoing, form = "extended", size = 11..=12, length = 11.., answer = Confirm)]
pub struct SelectImu3Extended<'a> {
    /// Sensor to use.
    pub imu_type: CalibImu,
    /// Action to perform.
    pub action: CalibAction,
    /// Sampling time, gyroscope only.
    pub time_ms: CalibrationTime,
    /// Reserved, 7 or 8 zero bytes.
    pub reserved: &'a [u8],
}

/// Corrects the zero of a gyroscope by hand.
///
/// Neither confirmed nor answered.
#[message(CMD_GYRO_CORRECTION, outgoing, size = 9)]
pub struct GyroCorrection {
    /// Sensor, counted from 0, unlike in [`SelectImu3`]. One library uses 1 and 2 here, which is not followed.
    pub imu_type: ImuIndex,
    /// Offset of the sensor's own axes.
    pub gyro_zero_corr: PerXyz<GyroZero>,
    /// Offset about the vertical, to correct the heading only; the board spreads it over the axes.
    pub gyro_zero_heading_corr: GyroZero,
}

/// IMU, counted from 0. Spec: `IMU_INDEX0`.
///
/// `CMD_GYRO_CORRECTION` and the data stream of `CMD_AHRS_HELPER` count so; all else has [`ImuType`].
#[open_enum(u8)]
pub enum ImuIndex {
    /// IMU on the camera platform.
    Main = 0,
    /// IMU on the frame.
    Frame = 1,
}
