//! Calibrations with few parameters: gains, follow offset, poles, battery and misalignment.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::units::Voltage;
use crate::wire::Reserved;

/// Calibrates the gains of the external flight controller's signals.
///
/// Sources disagree on whether the board confirms the end: accept a `CMD_CONFIRM`, but do not rely on one.
/// Neither how long it takes is published, nor whether the gimbal moves. The result is in
/// [`ext_fc_gain`](crate::commands::Params3::ext_fc_gain) of the parameters.
#[message(CMD_CALIB_EXT_GAIN, outgoing, size = 0)]
pub struct CalibExtGain;

/// Makes the current position the offset of follow mode.
///
/// Put the gimbal into the desired position first; it does not move. Sources disagree on whether the board confirms:
/// accept a `CMD_CONFIRM`, but do not rely on one. The result is in
/// [`follow_offset`](crate::commands::Params3::follow_offset) of the parameters.
#[message(CMD_CALIB_OFFSET, outgoing, size = 0)]
pub struct CalibOffset;

/// Calibrates the number of motor poles and the direction of the motors.
///
/// **The gimbal moves.** The motors should be on, the gimbal free to move and untouched.
///
/// Sources disagree on whether the board confirms the end: accept a `CMD_CONFIRM`, but do not rely on one. How
/// long it takes is not published. Failure shows in the real-time data, as
/// [`SystemErrors::CALIB_POLES`](crate::commands::SystemErrors::CALIB_POLES) or as an emergency stop; the result is in
/// [`MotorTuning`](crate::commands::MotorTuning), as number of poles and direction.
#[message(CMD_CALIB_POLES, outgoing, size = 0)]
pub struct CalibPoles;

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
