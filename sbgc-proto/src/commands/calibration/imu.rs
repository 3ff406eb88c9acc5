//! Calibration of accelerometers, gyroscopes and magnetometers.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::units::CalibrationTime;
use crate::wire::Reserved;

/// Starts the regular calibration of the accelerometer.
///
/// Applies to the active IMU, which [`SelectImu3`](crate::commands::SelectImu3) selects. According to the
/// specification, the board confirms the start and the end, but the vendor's libraries do not wait for a confirmation
/// of this form. Prefer [`CalibAcc`], which selects the IMU itself and is always confirmed.
#[message(CMD_CALIB_ACC, outgoing, form = "simple", size = 0, length = 0)]
pub struct CalibAccSimple;

/// Calibrates the accelerometer of an IMU; or resets, copies, enables or disables its calibration.
///
/// If the parameters are valid, the board confirms immediately, and again at the end of the calibration. The motors do
/// not move: hold the IMU still; to calibrate all limits, repeat with each axis pointing up and down in turn.
/// Meanwhile, [`CalibInfo`](crate::commands::CalibInfo) reports the progress, the current axis and the limits already
/// calibrated. The duration depends on the person who turns the IMU.
///
/// Actions that restart the board probably end with `CMD_RESET` instead of the second confirmation. The menu commands
/// `MENU_CMD_CALIB_ACC` and `MENU_CMD_CALIB_ACC_TEMP` start the same calibrations.
#[message(CMD_CALIB_ACC, outgoing, form = "extended", default, size = 12, answer = Confirm)]
pub struct CalibAcc(pub ImuCalibration);

/// Starts the regular calibration of the gyroscope.
///
/// Applies to the active IMU, which [`SelectImu3`](crate::commands::SelectImu3) selects. According to the
/// specification, the board confirms the start and the end, but the vendor's libraries do not wait for a confirmation
/// of this form. Prefer [`CalibGyro`], which selects the IMU itself and is always confirmed.
#[message(CMD_CALIB_GYRO, outgoing, form = "simple", size = 0, length = 0)]
pub struct CalibGyroSimple;

/// Calibrates the gyroscope of an IMU; or resets, copies, enables or disables its calibration.
///
/// If the parameters are valid, the board confirms immediately, and again at the end of the calibration: after about 4
/// s, unless another time was requested. Hold the IMU still during that time. Meanwhile,
/// [`CalibInfo`](crate::commands::CalibInfo) reports the progress and the amplitude of the gyroscope signal, which
/// shows movements that would spoil the result.
///
/// Actions that restart the board probably end with `CMD_RESET` instead of the second confirmation. The menu commands
/// `MENU_CMD_CALIB_GYRO` and `MENU_CMD_CALIB_GYRO_TEMP` start the same calibrations.
#[message(CMD_CALIB_GYRO, outgoing, form = "extended", default, size = 12, answer = Confirm)]
pub struct CalibGyro(pub ImuCalibration);

/// Starts the regular calibration of the magnetometer.
///
/// Applies to the active IMU, which [`SelectImu3`](crate::commands::SelectImu3) selects. According to the
/// specification, the board confirms the start and the end, but the vendor's libraries do not wait for a confirmation
/// of this form. Prefer [`CalibMag`], which selects the IMU itself and is always confirmed.
#[message(CMD_CALIB_MAG, outgoing, form = "simple", size = 0, length = 0)]
pub struct CalibMagSimple;

/// Calibrates the magnetometer of an IMU; or resets, copies, enables or disables its calibration.
///
/// If the parameters are valid, the board confirms immediately, and again at the end of the calibration. The motors do
/// not move: turn the IMU by hand in all directions as described in the user manual, for as long as that takes.
/// Meanwhile, [`CalibInfo`](crate::commands::CalibInfo) reports the progress and the heading error. Requires a
/// magnetometer.
///
/// Actions that restart the board probably end with `CMD_RESET` instead of the second confirmation. The menu command
/// `MENU_CMD_CALIB_MAG` starts the same calibration.
#[message(CMD_CALIB_MAG, outgoing, form = "extended", default, size = 12, answer = Confirm)]
pub struct CalibMag(pub ImuCalibration);

/// Calibration action for one IMU.
#[record(size = 12)]
pub struct ImuCalibration {
    /// IMU to calibrate.
    pub imu_idx: CalibImu,
    /// Action to perform.
    pub action: CalibAction,
    /// Sampling time of the gyroscope; 0 means about 4 s.
    ///
    /// Use 0 for the other sensors and for older firmware, where these bytes are reserved.
    pub time_ms: CalibrationTime,
    pub reserved: Reserved<8>,
}

/// IMU to calibrate. Spec: `CALIB_IMU_IDX`.
#[open_enum(u8)]
pub enum CalibImu {
    /// Active IMU.
    Current = 0,
    /// IMU on the camera platform.
    Main = 1,
    /// IMU on the frame.
    Frame = 2,
}

/// Calibration action. Spec: `CALIB_ACTION`.
///
/// The specification describes the actions but does not name them.
#[open_enum(u8)]
pub enum CalibAction {
    /// Runs a regular calibration.
    Regular = 1,
    /// Resets all calibrations and restarts the board.
    ResetAllAndRestart = 2,
    /// Runs a calibration over temperature.
    Temperature = 3,
    /// Enables the calibration over temperature, if there is one, and restarts the board.
    EnableTempCalibAndRestart = 4,
    /// Disables the calibration over temperature, keeps its data, and restarts the board.
    DisableTempCalibAndRestart = 5,
    /// Copies the calibration from the sensor's EEPROM to the board's, which restores the factory calibration.
    CopySensorEepromToMain = 6,
    /// Copies the calibration from the board's EEPROM to the sensor's.
    CopyMainEepromToSensor = 7,
}
