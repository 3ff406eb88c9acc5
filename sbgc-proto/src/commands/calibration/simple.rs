//! Calibrations with few or no parameters: gains, follow offset, motor poles, battery voltage and IMU misalignment.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::units::Voltage;
use crate::wire::Reserved;

/// Calibrates the gains of the signals from an external flight controller.
///
/// Sources disagree on whether the board confirms the end: accept a `CMD_CONFIRM`, but do not rely on one. The
/// duration, and whether the gimbal moves, are not published. The result is stored in the parameter
/// [`ext_fc_gain`](crate::commands::Params3::ext_fc_gain).
#[message(CMD_CALIB_EXT_GAIN, outgoing, size = 0)]
pub struct CalibExtGain;

/// Sets the offset of follow mode to the current position.
///
/// Put the gimbal into the desired position first; it does not move. Sources disagree on whether the board confirms:
/// accept a `CMD_CONFIRM`, but do not rely on one. The result is stored in the parameter
/// [`follow_offset`](crate::commands::Params3::follow_offset).
#[message(CMD_CALIB_OFFSET, outgoing, size = 0)]
pub struct CalibOffset;

/// Calibrates the number of motor poles and the direction of the motors.
///
/// **The gimbal moves.** Turn the motors on, make sure that the gimbal can move freely, and do not touch it.
///
/// Sources disagree on whether the board confirms the end: accept a `CMD_CONFIRM`, but do not rely on one. The duration
/// is not published. Failures are reported in the real-time data, as
/// [`SystemErrors::CALIB_POLES`](crate::commands::SystemErrors::CALIB_POLES) or as an emergency stop. The result,
/// number of poles and direction, is stored in [`MotorTuning`](crate::commands::MotorTuning).
#[message(CMD_CALIB_POLES, outgoing, size = 0)]
pub struct CalibPoles;

/// Calibrates the voltage sensor of the board against a measured voltage.
///
/// The board must be powered by its battery or supply, not by USB alone. The gimbal does not move. Confirmed once.
#[message(CMD_CALIB_BAT, outgoing, size = 2, answer = Confirm)]
pub struct CalibBat {
    /// Measured battery voltage.
    pub actual_voltage: Voltage,
}

/// Starts the calibration that corrects a misaligned IMU.
///
/// First turn the motors off and lock the joint between the inner and the middle motor. The board confirms immediately.
/// At the end, after an unpublished time, it sends [`ParamsExt2`](crate::commands::ParamsExt2) unsolicited, with the
/// result in [`imu_orientation_corr`](crate::commands::ParamsExt2::imu_orientation_corr).
#[message(CMD_CALIB_ORIENT_CORR, outgoing, size = 16, since = "2.61", answer = Confirm)]
pub struct CalibOrientCorr {
    pub reserved: Reserved<16>,
}
