//! States and errors reported in real-time data.

use crate::declare::flags;
use sbgc_proto_macros::open_enum;

flags! {
    /// System errors; empty if there are none. Spec: `SYSTEM_ERROR`.
    pub struct SystemErrors: u16, prefix "ERR_" {
        /// No IMU responds.
        const NO_SENSOR = 1 << 0;
        /// The accelerometer is not calibrated.
        const CALIB_ACC = 1 << 1;
        /// Motor power is not set.
        const SET_POWER = 1 << 2;
        /// The motor poles are not calibrated.
        const CALIB_POLES = 1 << 3;
        /// A protection was triggered.
        const PROTECTION = 1 << 4;
        /// Serial communication errors.
        const SERIAL = 1 << 5;
        /// Battery voltage is below the alarm level.
        const LOW_BAT1 = 1 << 6;
        /// Battery voltage is below the level at which the motors are turned off.
        const LOW_BAT2 = 1 << 7;
        /// The GUI version does not match the firmware.
        const GUI_VERSION = 1 << 8;
        /// Motors lose steps.
        const MISS_STEPS = 1 << 9;
        /// System error.
        const SYSTEM = 1 << 10;
        /// Emergency stop of the motors; see [`SystemSubError`] for the reason.
        const EMERGENCY_STOP = 1 << 11;
    }
}

/// Reason for an emergency stop of the motors; 0 means none. Spec: `SYSTEM_SUB_ERROR`.
#[open_enum(u8, prefix = "SUB_ERR_")]
pub enum SystemSubError {
    /// Too many I2C errors.
    I2cErrors = 1,
    /// Motor driver too hot.
    DrvOtw = 2,
    /// Motor driver fault: undervoltage, overcurrent or short circuit.
    DrvFault = 3,
    /// Encoder and IMU angles do not match.
    EncoderImuAngle = 4,
    /// Automatic calibration caused a serious fault.
    CalibrationFailed = 5,
    /// Stack damaged.
    InternalSystemError = 6,
    /// Estimated encoder scale is far from the configured one.
    EncoderCalibBadScale = 7,
    /// MCU or power board too hot.
    OverTemperature = 8,
    /// Number of motor poles or inversion is wrong.
    BadMotorPolesInvert = 9,
    /// Out of memory.
    NotEnoughMemory = 10,
    /// IMU sensor lost.
    ImuSensorNotResponding = 11,
    /// CAN hardware error on the board.
    CanHard = 12,
    /// Motor overheat protection.
    MotorOverheatProtection = 13,
    /// Motor locked during an automatic task.
    MotorIsLocked = 14,
    /// Gyroscope and accelerometer disagree too much: corrupted data or wrong conditions of use.
    BadImuHealth = 15,
    /// Endless reset loop.
    InfiniteReset = 16,
    /// Encoder angle not found, or outside the soft limits.
    WrongInitialPosition = 17,
    /// Motors fully loaded for too long.
    MotorLoadTimeExceeded = 18,
    /// CAN driver: hardware short-circuit protection.
    CanDrvOvercurrent = 19,
    /// CAN driver: undervoltage.
    CanDrvUndervoltage = 20,
    /// CAN driver: external emergency input.
    CanDrvEmergencyPin = 21,
    /// CAN driver: FOC algorithm took too long.
    CanDrvFocDuration = 22,
    /// CAN driver too hot.
    CanDrvMcuOverheat = 23,
    /// CAN driver: motor too hot.
    CanDrvMotorOverheat = 24,
    /// CAN driver: motor current above its limit.
    CanDrvOvercurrentSoft = 25,
    /// CAN driver: several errors.
    CanDrvSeveral = 26,
    /// CAN bus errors at the slave controller.
    CanExtBusOff = 27,
    /// CAN bus errors at the main controller.
    CanIntBusOff = 28,
    /// No answer from the encoder at start.
    EncoderNotFound = 29,
    /// CAN driver lost.
    CanDrvNotResponding = 30,
    /// CAN driver parameters wrong.
    CanDrvWrongParams = 31,
    /// Overcurrent at the main controller, or short circuit found at start.
    Overcurrent = 32,
    /// Undervoltage, or fault of the supply protection controller.
    UnsafeVoltage = 33,
    /// Battery voltage higher than expected at start.
    WrongFullBatVoltageParam = 34,
    /// Parameters in EEPROM corrupted, backup not usable.
    EepromParamsCorrupted = 35,
    /// Encoder type not supported.
    EncoderUnsupportedType = 36,
    /// External IMU type not supported by CAN IMU firmware.
    ExtImuUnsupportedType = 37,
    /// External IMU behind CAN IMU lost.
    ExtImuSensorNotResponding = 38,
    /// External IMU self test failed, or it differs too much from the internal one.
    ExtImuWrongParams = 39,
    /// External motor driver failed to start.
    DriverInit = 40,
    /// Internal: variable read or write out of bounds.
    EepromVarsOutOfBorders = 41,
    /// Reset by the watchdog.
    IwdgReset = 42,
    /// No ADC samples.
    AdcWait = 43,
    /// Calibration needs the motors powered.
    CalibMotorOff = 44,
    /// Timeout.
    Timeout = 45,
    /// CAN driver: RL calibration failed.
    CanDrvCalibUnexpectedRes = 46,
    /// Magnetometer lost.
    MagSensorNotResponding = 47,
    /// CAN driver: motor too fast.
    CanDrvOverspeed = 48,
    /// Encoder self calibration failed.
    EncSelfCalibFailed = 49,
    /// CAN module firmware does not match the board's.
    CanVersionMismatch = 50,
    /// Serial-over-CAN cannot be set up with these parameters.
    CanSerialInit = 51,
    /// Serial-over-CAN conflict.
    CanSerialConflict = 52,
    /// CAN driver answers but did not start up.
    CanDrvInitStage = 53,
    /// No fresh encoder data.
    EncoderDataTimeout = 54,
    /// Another CAN device lost.
    CanConnectionLost = 55,
    /// Quartz oscillator did not start.
    HseStartFail = 56,
    /// Frame IMU lost.
    FrameImuSensorNotResponding = 57,
    /// Parameters changed at run time, cannot be written.
    ParametersModified = 58,
    /// Calibration possible in the normal position only (frame is inverted).
    NotNormalPosition = 59,
    /// More CAN drivers than licensed.
    CanDrvLimitExceed = 60,
}

flags! {
    /// Motor power state. Spec: `RT_DATA_FLAGS`.
    pub struct RtDataFlags: u8 {
        /// The motors are on.
        const MOTORS_ON = 1 << 0;
    }
}

flags! {
    /// System state flags; the first five equal those of the board information. Spec: `SYSTEM_STATE_FLAGS`.
    pub struct SystemStateFlags: u32 {
        /// The board is in debug mode.
        const DEBUG_MODE = 1 << 0;
        /// The frame is upside down.
        const IS_FRAME_INVERTED = 1 << 1;
        /// The first step of the start-up is done.
        const INIT_STEP1_DONE = 1 << 2;
        /// The second step of the start-up is done.
        const INIT_STEP2_DONE = 1 << 3;
        /// The automatic start-up routine is done.
        const STARTUP_AUTO_ROUTINE_DONE = 1 << 4;
        /// Power management is enabled.
        const POWER_MANAGER_ENABLED = 1 << 5;
        /// The shake generator is enabled.
        const SHAKE_GEN_ENABLED = 1 << 8;
        /// Servo mode is on.
        const SERVO_MODE_ENABLED = 1 << 9;
        /// Follow mode is on for ROLL.
        const FOLLOW_MODE_ROLL = 1 << 10;
        /// Follow mode is on for PITCH.
        const FOLLOW_MODE_PITCH = 1 << 11;
        /// Follow mode is on for YAW.
        const FOLLOW_MODE_YAW = 1 << 12;
        /// Tripod mode is on.
        const TRIPOD_MODE_ENABLED = 1 << 13;
        /// The gimbal is in its retracted position.
        const RETRACTED_POSITION = 1 << 14;
    }
}

/// Running calibration or automatic task. Spec: `CALIB_MODE`.
#[open_enum(u8)]
pub enum CalibMode {
    /// No calibration or task.
    None = 0,
    /// Calibration of the gains of an external flight controller.
    ExtGain = 1,
    /// Setting an angle by hand and saving it.
    SetAngleAndSave = 2,
    /// Calibration of motor poles.
    Poles = 3,
    /// Calibration of the accelerometer.
    Acc = 4,
    /// Calibration of the gyroscope.
    Gyro = 5,
    /// Calibration of the encoder offset.
    EncoderOffset = 6,
    /// Calibration of the encoder field offset.
    EncoderFldOffset = 7,
    /// Automatic PID tuning.
    AutoPid = 8,
    /// Bode test.
    BodeTest = 9,
    /// Temperature calibration of the gyroscope.
    GyroTemp = 10,
    /// Temperature calibration of the accelerometer.
    AccTemp = 11,
    /// Calibration of the magnetometer.
    Mag = 12,
    /// Setting an angle by hand.
    SetAngle = 13,
    /// System identification.
    SystemIdent = 14,
    /// Calibration of the link between motors and magnetometer.
    MotorMagLink = 15,
    /// Search for mechanical limits.
    SearchLimits = 16,
    /// Moving to the operating position.
    SetOperationPos = 17,
    /// Correction of the IMU orientation.
    ImuOrientationCorr = 18,
    /// Time-lapse motion.
    Timelapse = 19,
    /// Estimation of moments of inertia.
    Momentum = 20,
    /// Automatic estimation of moments of inertia.
    MomentumAuto = 21,
    /// Calibration of motor cogging.
    Cogging = 22,
    /// Calibration of the accelerometer against an external reference.
    AccExtRef = 23,
    /// Safe stop.
    SafeStop = 24,
    /// Calibration of the accelerometer on a sphere.
    AccSphere = 25,
    /// Alignment of the gyroscope axes.
    GyroAxesAlignment = 26,
    /// Calibration of the gyroscope of the external IMU.
    ExtImuGyro = 27,
    /// Alignment of the external IMU.
    ExtImuAlign = 28,
    /// Calibration of accelerometer and gyroscope in many positions.
    AccGyroMultipoint = 34,
    /// Calibration of the lookup table of an encoder.
    EncoderLut = 35,
    /// Writing parameters.
    WriteParams = 36,
    /// Calibration of current sensors.
    CurSens = 37,
    /// Moving motors to their home position.
    MoveHomeMotors = 38,
    /// Internal calibration of an encoder.
    EncoderInt = 39,
    /// Vibration test.
    VibrationTest = 40,
    /// Moving to the retracted position.
    RetractedPosition = 41,
    /// Moving to the retracted position under RC control.
    RetractedPositionRcControl = 42,
}

/// State of motor power. Spec: `POWER_STATE`.
#[open_enum(i8)]
pub enum PowerState {
    /// On, from the backup supply.
    OnFromBackup = -2,
    /// Starting.
    Startup = -1,
    /// Off.
    Off = 0,
    /// On.
    On = 1,
    /// Temporarily off.
    OffTemporary = 2,
    /// Off, parked.
    OffParking = 3,
    /// On, in a safe stop.
    OnSafeStop = 4,
}

flags! {
    /// State flags of one motor. Spec: `MOTOR_FLAGS`.
    pub struct MotorFlags: u16 {
        /// The motor is beyond a software limit.
        const SW_LIMIT_VIOLATED = 1 << 0;
        /// The motor current exceeds its limit.
        const CURRENT_EXCEEDS_LIMIT = 1 << 1;
        /// The motor driver is on.
        const DRIVER_ENABLED = 1 << 2;
    }
}

flags! {
    /// State of the motor power system. Spec: `SYSTEM_POWER_FLAGS`.
    pub struct SystemPowerFlags: u16 {
        /// A motor is beyond a software limit.
        const SW_LIMIT_VIOLATED = 1 << 0;
        /// A component is overheating.
        const OVERHEAT_WARNING = 1 << 1;
        /// A motor driver reports an over-temperature warning. Newer firmware.
        const DRIVER_OTW = 1 << 2;
        /// A motor driver reports a fault. Newer firmware.
        const DRIVER_FAULT = 1 << 3;
    }
}

flags! {
    /// CAN bus errors. Spec: `CAN_ERR_FLAGS`.
    pub struct CanErrFlags: u8, prefix "ERR_" {
        /// The CAN controller reached the error warning level.
        const WARN_IRQ = 1 << 0;
        /// The CAN controller entered the error passive state.
        const PASSIVE_IRQ = 1 << 1;
        /// The CAN controller entered the bus-off state.
        const BUS_OFF_IRQ "BUS_OFF_IRQ" = 1 << 2;
    }
}
