//! Calibration of accelerometer, gyroscope and magnetometer.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::units::CalibrationTime;
use crate::wire::Reserved;

/// Starts the regular calibration of the accelerometer.
///
/// It works on the active sensor, the one that [`SelectImu3`](crate::commands::SelectImu3) chose last. By the
/// specification the board confirms it at the start and at the end, but the vendor's libraries wait for nothing after
/// this form: prefer [`CalibAcc`], which selects the sensor and is always confirmed.
#[message(CMD_CALIB_ACC, outgoing, form = "simple", size = 0, length = 0)]
pub struct CalibAccSimple;

/// Calibrates the accelerometer of a chosen sensor, or resets, copies or switches its calibration.
///
/// If the parameters are valid the board confirms at once, and again when the calibration has ended. The motors do not
/// move: hold the sensor still, for a calibration of all limits with each axis up and down in turn.
/// Meanwhile [`CalibInfo`](crate::commands::CalibInfo) shows the progress, the axis that is looked at and the limits
/// that are done. How long it takes depends on the person who turns the sensor.
///
/// Actions that restart the board probably end with `CMD_RESET` in place of the second confirmation. The menu commands
/// `MENU_CMD_CALIB_ACC` and `MENU_CMD_CALIB_ACC_TEMP` start the same.
#[message(CMD_CALIB_ACC, outgoing, form = "extended", default, size = 12, answer = Confirm)]
pub struct CalibAcc(pub ImuCalibration);

/// Starts the regular calibration of the gyroscope.
///
/// It works on the active sensor, the one that [`SelectImu3`](crate::commands::SelectImu3) chose last. By the
/// specification the board confirms it at the start and at the end, but the vendor's libraries wait for nothing after
/// this form: prefer [`CalibGyro`], which selects the sensor and is always confirmed.
#[message(CMD_CALIB_GYRO, outgoing, form = "simple", size = 0, length = 0)]
pub struct CalibGyroSimple;

/// Calibrates the gyroscope of a chosen sensor, or resets, copies or switches its calibration.
///
/// If the parameters are valid the board confirms at once, and again when the calibration has ended, after
/// about 4 s unless another time was requested. Hold the sensor still meanwhile.
/// Meanwhile [`CalibInfo`](crate::commands::CalibInfo) shows the progress, and in the amplitude of the gyroscope any
/// movement that spoils the result.
///
/// Actions that restart the board probably end with `CMD_RESET` in place of the second confirmation. The menu commands
/// `MENU_CMD_CALIB_GYRO` and `MENU_CMD_CALIB_GYRO_TEMP` start the same.
#[message(CMD_CALIB_GYRO, outgoing, form = "extended", default, size = 12, answer = Confirm)]
pub struct CalibGyro(pub ImuCalibration);

/// Starts the regular calibration of the magnetometer.
///
/// It works on the active sensor, the one that [`SelectImu3`](crate::commands::SelectImu3) chose last. By the
/// specification the board confirms it at the start and at the end, but the vendor's libraries wait for nothing after
/// this form: prefer [`CalibMag`], which selects the sensor and is always confirmed.
#[message(CMD_CALIB_MAG, outgoing, form = "simple", size = 0, length = 0)]
pub struct CalibMagSimple;

/// Calibrates the magnetometer of a chosen sensor, or resets, copies or switches its calibration.
///
/// If the parameters are valid the board confirms at once, and again when the calibration has ended. The motors do not
/// move: a person turns the sensor in all directions as described in the user manual, and how long that takes is up to
/// them. Meanwhile [`CalibInfo`](crate::commands::CalibInfo) shows the progress and the error of the heading. Requires
/// a magnetometer.
///
/// Actions that restart the board probably end with `CMD_RESET` in place of the second confirmation. The menu command
/// `MENU_CMD_CALIB_MAG` starts the same.
#[message(CMD_CALIB_MAG, outgoing, form = "extended", default, size = 12, answer = Confirm)]
pub struct CalibMag(pub ImuCalibration);

/// Calibration action for one sensor.
#[record(size = 12)]
pub struct ImuCalibration {
    /// Sensor to use.
    pub imu_idx: CalibImu,
    /// Action to perform.
    pub action: CalibAction,
    /// Sampling time, gyroscope only.
    ///
    /// Zero, which is about 4 s, is right for the other sensors and for older firmware, where these bytes are reserved.
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
/// The spec describes these and gives them no names.
#[open_enum(u8)]
pub enum CalibAction {
    /// Calibrate.
    Regular = 1,
    /// Reset all calibrations and restart the board.
    ResetAllAndRestart = 2,
    /// Calibrate over temperature.
    Temperature = 3,
    /// Use the calibration over temperature, if there is one, and restart the board.
    EnableTempCalibAndRestart = 4,
    /// Leave the calibration over temperature unused but in memory, and restart the board.
    DisableTempCalibAndRestart = 5,
    /// Copy the calibration from the sensor's EEPROM to the board's: back to the calibration of the factory.
    CopySensorEepromToMain = 6,
    /// Copy the calibration from the board's EEPROM to the sensor's.
    CopyMainEepromToSensor = 7,
}
