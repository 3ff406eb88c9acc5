//! Calibrations that need next to nothing said: of gains, follow offset, poles, battery and misalignment.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::units::Voltage;
use crate::wire::Reserved;

/// Calibrates the gains of the external flight controller's signals.
///
/// Whether the board confirms the end is not settled: take a `CMD_CONFIRM` if it comes, and do not depend on it.
/// Neither how long it takes is published, nor whether the gimbal moves. The result is in
/// [`ext_fc_gain`](crate::commands::Params3::ext_fc_gain) of the parameters.
#[message(CMD_CALIB_EXT_GAIN, outgoing, size = 0)]
pub struct CalibExtGain {}

/// Makes the present position the offset of follow mode.
///
/// Put the gimbal into the wanted position first; it does not move. Whether the board confirms is not settled: take a
/// `CMD_CONFIRM` if it comes, and do not depend on it. The result is in
/// [`follow_offset`](crate::commands::Params3::follow_offset) of the parameters.
#[message(CMD_CALIB_OFFSET, outgoing, size = 0)]
pub struct CalibOffset {}

/// Finds the number of poles of the motors and the direction they turn in.
///
/// **The gimbal moves.** The motors should be on, the gimbal free to move and untouched.
///
/// Whether the board confirms the end is not settled: take a `CMD_CONFIRM` if it comes, and do not depend on it. How
/// long it takes is not published. Failure shows in the real-time data, as
/// [`SystemErrors::CALIB_POLES`](crate::commands::SystemErrors::CALIB_POLES) or as an emergency stop; the result is in
/// [`MotorTuning`](crate::commands::MotorTuning), as number of poles and direction.
#[message(CMD_CALIB_POLES, outgoing, size = 0)]
pub struct CalibPoles {}

/// Calibrates the board's voltage sensor against a voltage that was measured.
///
/// The board must be powered by its battery or supply and not by USB alone. The gimbal does not move. The board
/// confirms once.
#[message(CMD_CALIB_BAT, outgoing, size = 2, answer = Confirm)]
pub struct CalibBat {
    /// The measured voltage of the battery.
    pub actual_voltage: Voltage,
}

/// Starts the calibration that corrects for a misaligned sensor.
///
/// Switch the motors off and fix the joint between the inner and the middle motor first. The board confirms at once.
/// When it is done, after a time that is not published, it sends [`ParamsExt2`](crate::commands::ParamsExt2) without
/// being asked, with the result in [`imu_orientation_corr`](crate::commands::ParamsExt2::imu_orientation_corr).
#[message(CMD_CALIB_ORIENT_CORR, outgoing, size = 16, since = "2.61", answer = Confirm)]
pub struct CalibOrientCorr {
    pub reserved: Reserved<16>,
}
