//! Which sensor commands work on, and the zero of its gyroscope.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{CalibAction, CalibImu, Confirm, ImuType};
use crate::units::{CalibrationTime, GyroZero};
use crate::wire::PerXyz;

/// Chooses the sensor that calibrations and real-time data work on.
///
/// The board ignores it when that sensor is not connected. Whether it confirms is not settled: take a `CMD_CONFIRM` if
/// it comes, do not depend on it.
#[message(CMD_SELECT_IMU_3, outgoing, form = "simple", default, size = 1, length = 1)]
pub struct SelectImu3 {
    /// Which sensor.
    pub imu_type: ImuType,
}

/// Chooses a sensor and calibrates it, or resets, copies or switches its calibration, in newer firmware.
///
/// The vendor's libraries disagree on the length, 11 or 12 bytes, which leaves 7 or 8 bytes reserved; both are taken.
/// Better use [`SelectImu3`] with [`CalibAcc`](crate::commands::CalibAcc), [`CalibGyro`](crate::commands::CalibGyro) or
/// [`CalibMag`](crate::commands::CalibMag), which do the same.
#[message(CMD_SELECT_IMU_3, outgoing, form = "extended", size = 11..=12, length = 11.., answer = Confirm)]
pub struct SelectImu3Extended<'a> {
    /// Which sensor.
    pub imu_type: CalibImu,
    /// What to do.
    pub action: CalibAction,
    /// How long to take samples, for the gyroscope only.
    pub time_ms: CalibrationTime,
    /// Kept for later, 7 or 8 zero bytes.
    pub reserved: &'a [u8],
}

/// Corrects the zero of a gyroscope by hand.
///
/// Neither confirmed nor answered.
#[message(CMD_GYRO_CORRECTION, outgoing, size = 9)]
pub struct GyroCorrection {
    /// Which sensor, counted from 0, unlike in [`SelectImu3`]. One library has 1 and 2 here; that is not followed.
    pub imu_type: ImuIndex,
    /// Offset of the sensor's own axes.
    pub gyro_zero_corr: PerXyz<GyroZero>,
    /// Offset about the vertical, to correct the heading only; the board spreads it over the axes.
    pub gyro_zero_heading_corr: GyroZero,
}

/// Which inertial measurement unit, counted from 0. Spec: `IMU_INDEX0`.
///
/// `CMD_GYRO_CORRECTION` and the data stream of `CMD_AHRS_HELPER` count so; all else has [`ImuType`].
#[open_enum(u8)]
pub enum ImuIndex {
    /// The one on the camera platform.
    Main = 0,
    /// The one on the frame.
    Frame = 1,
}
