//! Calibrations that need next to nothing said: of gains, follow offset, poles, battery and misalignment.

use sbgc_proto_macros::message;

use crate::commands::Confirm;
use crate::units::Voltage;
use crate::wire::Reserved;

/// Calibrates the gains of the external flight controller's signals.
///
/// Whether a `CMD_CONFIRM` comes at its end is not settled: take it if it comes, do not depend on it. No source says
/// how long it takes; nothing says that the gimbal moves. The result is in `EXT_FC_GAIN` of the parameters.
#[message(CMD_CALIB_EXT_GAIN, outgoing, size = 0)]
pub struct CalibExtGain {}

/// Makes the present position the offset of follow mode.
///
/// Put the gimbal into the wanted position before. The gimbal does not move. Whether a `CMD_CONFIRM` comes is not
/// settled: take it if it comes, do not depend on it. The result is in `FOLLOW_OFFSET` of the parameters.
#[message(CMD_CALIB_OFFSET, outgoing, size = 0)]
pub struct CalibOffset {}

/// Finds the number of poles of the motors and the direction they turn in.
///
/// The gimbal moves. The motors should be on, the gimbal free to move and untouched. Whether a `CMD_CONFIRM` comes at its end is not
/// settled: take it if it comes, do not depend on it; no source says how long it takes. Failure shows in the system
/// error of the real-time data, as `ERR_CALIB_POLES` or an emergency stop. The result is in `POLES` and `INVERT` of the
/// parameters.
#[message(CMD_CALIB_POLES, outgoing, size = 0)]
pub struct CalibPoles {}

/// Calibrates the board's voltage sensor against a voltage that was measured.
///
/// The board must be powered by its battery or supply and not by USB alone. Confirmed once. The gimbal does not move.
#[message(CMD_CALIB_BAT, outgoing, size = 2, answer = Confirm)]
pub struct CalibBat {
    /// The measured voltage of the battery.
    pub actual_voltage: Voltage,
}

/// Starts the calibration that corrects for a misaligned sensor.
///
/// One `CMD_CONFIRM` comes at once. When it is done, no source says after how long, the board sends
/// `CMD_READ_PARAMS_EXT2` without being asked, with the result in `IMU_ORIENTATION_CORR`. The motors should be off and
/// the joint between the inner and the middle motor fixed.
#[message(CMD_CALIB_ORIENT_CORR, outgoing, size = 16, since = "2.61", answer = Confirm)]
pub struct CalibOrientCorr {
    pub reserved: Reserved<16>,
}
