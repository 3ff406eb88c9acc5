//! States and errors that the real-time data report.

use sbgc_proto_macros::open_enum;

use crate::wire::flags;

flags! {
    /// What is wrong with the system; nothing set: all is well. Spec: `SYSTEM_ERROR`.
    pub struct SystemErrors: u16 {
        /// No IMU answers.
        const NO_SENSOR "ERR_NO_SENSOR" = 1 << 0;
        /// The accelerometer is not calibrated.
        const CALIB_ACC "ERR_CALIB_ACC" = 1 << 1;
        /// The power of the motors is not set.
        const SET_POWER "ERR_SET_POWER" = 1 << 2;
        /// The motor poles are not calibrated.
        const CALIB_POLES "ERR_CALIB_POLES" = 1 << 3;
        /// A protection has acted.
        const PROTECTION "ERR_PROTECTION" = 1 << 4;
        /// The serial connection has errors.
        const SERIAL "ERR_SERIAL" = 1 << 5;
        /// The battery is below the level of alarm.
        const LOW_BAT1 "ERR_LOW_BAT1" = 1 << 6;
        /// The battery is below the level at which the motors stop.
        const LOW_BAT2 "ERR_LOW_BAT2" = 1 << 7;
        /// The version of the GUI does not match the firmware.
        const GUI_VERSION "ERR_GUI_VERSION" = 1 << 8;
        /// Motors miss steps.
        const MISS_STEPS "ERR_MISS_STEPS" = 1 << 9;
        /// A system error.
        const SYSTEM "ERR_SYSTEM" = 1 << 10;
        /// The motors were stopped in an emergency; [`SystemSubError`] tells why.
        const EMERGENCY_STOP "ERR_EMERGENCY_STOP" = 1 << 11;
    }
}

/// Why the motors were stopped in an emergency; 0 is no reason. Spec: `SYSTEM_SUB_ERROR`.
#[open_enum(u8)]
pub enum SystemSubError {
    /// Too many I2C errors.
    #[wire(spec = "SUB_ERR_I2C_ERRORS")]
    I2cErrors = 1,
    /// Motor driver too hot.
    #[wire(spec = "SUB_ERR_DRV_OTW")]
    DrvOtw = 2,
    /// Motor driver fault: undervoltage, overcurrent or short circuit.
    #[wire(spec = "SUB_ERR_DRV_FAULT")]
    DrvFault = 3,
    /// Encoder and IMU angles do not match.
    #[wire(spec = "SUB_ERR_ENCODER_IMU_ANGLE")]
    EncoderImuAngle = 4,
    /// Automatic calibration caused a serious fault.
    #[wire(spec = "SUB_ERR_CALIBRATION_FAILED")]
    CalibrationFailed = 5,
    /// Stack damaged.
    #[wire(spec = "SUB_ERR_INTERNAL_SYSTEM_ERROR")]
    InternalSystemError = 6,
    /// Estimated encoder scale is far from the configured one.
    #[wire(spec = "SUB_ERR_ENCODER_CALIB_BAD_SCALE")]
    EncoderCalibBadScale = 7,
    /// MCU or power board too hot.
    #[wire(spec = "SUB_ERR_OVER_TEMPERATURE")]
    OverTemperature = 8,
    /// Number of motor poles or inversion is wrong.
    #[wire(spec = "SUB_ERR_BAD_MOTOR_POLES_INVERT")]
    BadMotorPolesInvert = 9,
    /// Out of memory.
    #[wire(spec = "SUB_ERR_NOT_ENOUGH_MEMORY")]
    NotEnoughMemory = 10,
    /// IMU sensor lost.
    #[wire(spec = "SUB_ERR_IMU_SENSOR_NOT_RESPONDING")]
    ImuSensorNotResponding = 11,
    /// CAN hardware error on the board.
    #[wire(spec = "SUB_ERR_CAN_HARD")]
    CanHard = 12,
    /// Motor overheat protection.
    #[wire(spec = "SUB_ERR_MOTOR_OVERHEAT_PROTECTION")]
    MotorOverheatProtection = 13,
    /// Motor locked during an automatic task.
    #[wire(spec = "SUB_ERR_MOTOR_IS_LOCKED")]
    MotorIsLocked = 14,
    /// Gyroscope and accelerometer disagree too much: corrupted data or wrong conditions of use.
    #[wire(spec = "SUB_ERR_BAD_IMU_HEALTH")]
    BadImuHealth = 15,
    /// Endless reset loop.
    #[wire(spec = "SUB_ERR_INFINITE_RESET")]
    InfiniteReset = 16,
    /// Encoder angle not found, or outside the soft limits.
    #[wire(spec = "SUB_ERR_WRONG_INITIAL_POSITION")]
    WrongInitialPosition = 17,
    /// Motors fully loaded for too long.
    #[wire(spec = "SUB_ERR_MOTOR_LOAD_TIME_EXCEEDED")]
    MotorLoadTimeExceeded = 18,
    /// CAN driver: hardware short-circuit protection.
    #[wire(spec = "SUB_ERR_CAN_DRV_OVERCURRENT")]
    CanDrvOvercurrent = 19,
    /// CAN driver: undervoltage.
    #[wire(spec = "SUB_ERR_CAN_DRV_UNDERVOLTAGE")]
    CanDrvUndervoltage = 20,
    /// CAN driver: external emergency input.
    #[wire(spec = "SUB_ERR_CAN_DRV_EMERGENCY_PIN")]
    CanDrvEmergencyPin = 21,
    /// CAN driver: FOC algorithm took too long.
    #[wire(spec = "SUB_ERR_CAN_DRV_FOC_DURATION")]
    CanDrvFocDuration = 22,
    /// CAN driver too hot.
    #[wire(spec = "SUB_ERR_CAN_DRV_MCU_OVERHEAT")]
    CanDrvMcuOverheat = 23,
    /// CAN driver: motor too hot.
    #[wire(spec = "SUB_ERR_CAN_DRV_MOTOR_OVERHEAT")]
    CanDrvMotorOverheat = 24,
    /// CAN driver: motor current above its limit.
    #[wire(spec = "SUB_ERR_CAN_DRV_OVERCURRENT_SOFT")]
    CanDrvOvercurrentSoft = 25,
    /// CAN driver: several errors.
    #[wire(spec = "SUB_ERR_CAN_DRV_SEVERAL")]
    CanDrvSeveral = 26,
    /// CAN bus errors at the slave controller.
    #[wire(spec = "SUB_ERR_CAN_EXT_BUS_OFF")]
    CanExtBusOff = 27,
    /// CAN bus errors at the main controller.
    #[wire(spec = "SUB_ERR_CAN_INT_BUS_OFF")]
    CanIntBusOff = 28,
    /// No answer from the encoder at start.
    #[wire(spec = "SUB_ERR_ENCODER_NOT_FOUND")]
    EncoderNotFound = 29,
    /// CAN driver lost.
    #[wire(spec = "SUB_ERR_CAN_DRV_NOT_RESPONDING")]
    CanDrvNotResponding = 30,
    /// CAN driver parameters wrong.
    #[wire(spec = "SUB_ERR_CAN_DRV_WRONG_PARAMS")]
    CanDrvWrongParams = 31,
    /// Overcurrent at the main controller, or short circuit found at start.
    #[wire(spec = "SUB_ERR_OVERCURRENT")]
    Overcurrent = 32,
    /// Undervoltage, or fault of the supply protection controller.
    #[wire(spec = "SUB_ERR_UNSAFE_VOLTAGE")]
    UnsafeVoltage = 33,
    /// Battery voltage higher than expected at start.
    #[wire(spec = "SUB_ERR_WRONG_FULL_BAT_VOLTAGE_PARAM")]
    WrongFullBatVoltageParam = 34,
    /// Parameters in EEPROM corrupted, backup not usable.
    #[wire(spec = "SUB_ERR_EEPROM_PARAMS_CORRUPTED")]
    EepromParamsCorrupted = 35,
    /// Encoder type not supported.
    #[wire(spec = "SUB_ERR_ENCODER_UNSUPPORTED_TYPE")]
    EncoderUnsupportedType = 36,
    /// External IMU type not supported by CAN IMU firmware.
    #[wire(spec = "SUB_ERR_EXT_IMU_UNSUPPORTED_TYPE")]
    ExtImuUnsupportedType = 37,
    /// External IMU behind CAN IMU lost.
    #[wire(spec = "SUB_ERR_EXT_IMU_SENSOR_NOT_RESPONDING")]
    ExtImuSensorNotResponding = 38,
    /// External IMU self test failed, or it differs too much from the internal one.
    #[wire(spec = "SUB_ERR_EXT_IMU_WRONG_PARAMS")]
    ExtImuWrongParams = 39,
    /// External motor driver failed to start.
    #[wire(spec = "SUB_ERR_DRIVER_INIT")]
    DriverInit = 40,
    /// Internal: variable read or write out of bounds.
    #[wire(spec = "SUB_ERR_EEPROM_VARS_OUT_OF_BORDERS")]
    EepromVarsOutOfBorders = 41,
    /// Reset by the watchdog.
    #[wire(spec = "SUB_ERR_IWDG_RESET")]
    IwdgReset = 42,
    /// No ADC samples.
    #[wire(spec = "SUB_ERR_ADC_WAIT")]
    AdcWait = 43,
    /// Calibration needs the motors powered.
    #[wire(spec = "SUB_ERR_CALIB_MOTOR_OFF")]
    CalibMotorOff = 44,
    /// Timeout.
    #[wire(spec = "SUB_ERR_TIMEOUT")]
    Timeout = 45,
    /// CAN driver: RL calibration failed.
    #[wire(spec = "SUB_ERR_CAN_DRV_CALIB_UNEXPECTED_RES")]
    CanDrvCalibUnexpectedRes = 46,
    /// Magnetometer lost.
    #[wire(spec = "SUB_ERR_MAG_SENSOR_NOT_RESPONDING")]
    MagSensorNotResponding = 47,
    /// CAN driver: motor too fast.
    #[wire(spec = "SUB_ERR_CAN_DRV_OVERSPEED")]
    CanDrvOverspeed = 48,
    /// Encoder self calibration failed.
    #[wire(spec = "SUB_ERR_ENC_SELF_CALIB_FAILED")]
    EncSelfCalibFailed = 49,
    /// CAN module firmware does not match the board's.
    #[wire(spec = "SUB_ERR_CAN_VERSION_MISMATCH")]
    CanVersionMismatch = 50,
    /// Serial-over-CAN cannot be set up with these parameters.
    #[wire(spec = "SUB_ERR_CAN_SERIAL_INIT")]
    CanSerialInit = 51,
    /// Serial-over-CAN conflict.
    #[wire(spec = "SUB_ERR_CAN_SERIAL_CONFLICT")]
    CanSerialConflict = 52,
    /// CAN driver answers but did not start up.
    #[wire(spec = "SUB_ERR_CAN_DRV_INIT_STAGE")]
    CanDrvInitStage = 53,
    /// No fresh encoder data.
    #[wire(spec = "SUB_ERR_ENCODER_DATA_TIMEOUT")]
    EncoderDataTimeout = 54,
    /// Another CAN device lost.
    #[wire(spec = "SUB_ERR_CAN_CONNECTION_LOST")]
    CanConnectionLost = 55,
    /// Quartz oscillator did not start.
    #[wire(spec = "SUB_ERR_HSE_START_FAIL")]
    HseStartFail = 56,
    /// Frame IMU lost.
    #[wire(spec = "SUB_ERR_FRAME_IMU_SENSOR_NOT_RESPONDING")]
    FrameImuSensorNotResponding = 57,
    /// Parameters changed at run time, cannot be written.
    #[wire(spec = "SUB_ERR_PARAMETERS_MODIFIED")]
    ParametersModified = 58,
    /// Calibration possible in the normal position only (frame is inverted).
    #[wire(spec = "SUB_ERR_NOT_NORMAL_POSITION")]
    NotNormalPosition = 59,
    /// More CAN drivers than licensed.
    #[wire(spec = "SUB_ERR_CAN_DRV_LIMIT_EXCEED")]
    CanDrvLimitExceed = 60,
}

flags! {
    /// Whether the motors are on. Spec: `RT_DATA_FLAGS`.
    pub struct RtDataFlags: u8 {
        /// The motors are on.
        const MOTORS_ON = 1 << 0;
    }
}

flags! {
    /// What state the system is in. The first five are those of the board information. Spec: `SYSTEM_STATE_FLAGS`.
    pub struct SystemStateFlags: u32 {
        /// The board is in debug mode.
        const DEBUG_MODE = 1 << 0;
        /// The frame is upside down.
        const IS_FRAME_INVERTED = 1 << 1;
        /// The first step of the start is done.
        const INIT_STEP1_DONE = 1 << 2;
        /// The second step of the start is done.
        const INIT_STEP2_DONE = 1 << 3;
        /// The automatic routine of the start is done.
        const STARTUP_AUTO_ROUTINE_DONE = 1 << 4;
        /// The power manager works.
        const POWER_MANAGER_ENABLED = 1 << 5;
        /// The shake generator works.
        const SHAKE_GEN_ENABLED = 1 << 8;
        /// Servo mode is on.
        const SERVO_MODE_ENABLED = 1 << 9;
        /// ROLL follows the frame.
        const FOLLOW_MODE_ROLL = 1 << 10;
        /// PITCH follows the frame.
        const FOLLOW_MODE_PITCH = 1 << 11;
        /// YAW follows the frame.
        const FOLLOW_MODE_YAW = 1 << 12;
        /// Tripod mode is on.
        const TRIPOD_MODE_ENABLED = 1 << 13;
        /// The gimbal is in its retracted position.
        const RETRACTED_POSITION = 1 << 14;
    }
}

/// Which calibration or automatic task runs. Spec: `CALIB_MODE`.
#[open_enum(u8)]
pub enum CalibMode {
    /// None.
    None = 0,
    /// Calibration of the external flight controller's gain.
    ExtGain = 1,
    /// Sets an angle by hand and saves it.
    SetAngleAndSave = 2,
    /// Calibration of motor poles.
    Poles = 3,
    /// Calibration of the accelerometer.
    Acc = 4,
    /// Calibration of the gyroscope.
    Gyro = 5,
    /// Calibration of the encoders' offset.
    EncoderOffset = 6,
    /// Calibration of the encoders' electrical field offset.
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
    /// Sets an angle by hand.
    SetAngle = 13,
    /// System identification.
    SystemIdent = 14,
    /// Calibration of the link between motors and magnetometer.
    MotorMagLink = 15,
    /// Search for mechanical limits.
    SearchLimits = 16,
    /// Moves to the position of operation.
    SetOperationPos = 17,
    /// Correction of the IMU's orientation.
    ImuOrientationCorr = 18,
    /// Timelapse.
    Timelapse = 19,
    /// Momentum.
    Momentum = 20,
    /// Momentum, automatic.
    MomentumAuto = 21,
    /// Calibration of motor cogging.
    Cogging = 22,
    /// Calibration of the accelerometer by an external reference.
    AccExtRef = 23,
    /// Safe stop.
    SafeStop = 24,
    /// Calibration of the accelerometer on a sphere.
    AccSphere = 25,
    /// Alignment of the gyroscope's axes.
    GyroAxesAlignment = 26,
    /// Calibration of the external IMU's gyroscope.
    ExtImuGyro = 27,
    /// Alignment of the external IMU.
    ExtImuAlign = 28,
    /// Calibration of accelerometer and gyroscope in many positions.
    AccGyroMultipoint = 34,
    /// Calibration of an encoder's lookup table.
    EncoderLut = 35,
    /// Writes parameters.
    WriteParams = 36,
    /// Calibration of current sensors.
    CurSens = 37,
    /// Moves the motors to their home position.
    MoveHomeMotors = 38,
    /// Calibration inside the encoder.
    EncoderInt = 39,
    /// Vibration test.
    VibrationTest = 40,
    /// Moves to the retracted position.
    RetractedPosition = 41,
    /// Moves to the retracted position under remote control.
    RetractedPositionRcControl = 42,
}

/// Whether the motors have power. Spec: `POWER_STATE`.
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
    /// Off for a while.
    OffTemporary = 2,
    /// Off, parking.
    OffParking = 3,
    /// On, in a safe stop.
    OnSafeStop = 4,
}

flags! {
    /// What is going on at one motor. Spec: `MOTOR_FLAGS`.
    pub struct MotorFlags: u16 {
        /// It is beyond a software limit.
        const SW_LIMIT_VIOLATED = 1 << 0;
        /// Its current is beyond the limit.
        const CURRENT_EXCEEDS_LIMIT = 1 << 1;
        /// Its driver is on.
        const DRIVER_ENABLED = 1 << 2;
    }
}

flags! {
    /// What is going on at the motors as a whole. Spec: `SYSTEM_POWER_FLAGS`.
    pub struct SystemPowerFlags: u16 {
        /// A motor is beyond a software limit.
        const SW_LIMIT_VIOLATED = 1 << 0;
        /// Something is getting too hot.
        const OVERHEAT_WARNING = 1 << 1;
        /// A driver warns that it is too hot. Newer firmware.
        const DRIVER_OTW = 1 << 2;
        /// A driver has a fault. Newer firmware.
        const DRIVER_FAULT = 1 << 3;
    }
}

flags! {
    /// Errors of the CAN bus. Spec: `CAN_ERR_FLAGS`.
    pub struct CanErrFlags: u8 {
        /// The controller warned of errors.
        const WARN_IRQ "ERR_WARN_IRQ" = 1 << 0;
        /// The controller went passive.
        const PASSIVE_IRQ "ERR_PASSIVE_IRQ" = 1 << 1;
        /// The controller left the bus.
        const BUS_OFF_IRQ = 1 << 2;
    }
}
