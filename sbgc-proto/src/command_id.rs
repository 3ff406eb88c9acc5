//! The ids of all commands, with the spec's names.

use sbgc_proto_macros::open_enum;

use crate::text::equal;

/// Which way a message goes, seen from the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Direction {
    /// Host to controller.
    Outgoing,
    /// Controller to host.
    Incoming,
}

impl Direction {
    /// `outgoing` or `incoming`.
    pub const fn as_str(self) -> &'static str {
        match self {
            Direction::Outgoing => "outgoing",
            Direction::Incoming => "incoming",
        }
    }
}

/// The id of a command. Most mean the same in both directions; 67 does not.
#[open_enum(u8)]
pub enum CommandId {
    /// Ask for more board information.
    #[wire(spec = "CMD_BOARD_INFO_3")]
    BoardInfo3 = 20,
    /// Ask for configuration block 1 of one profile.
    #[wire(spec = "CMD_READ_PARAMS_3")]
    ReadParams3 = 21,
    /// Write configuration block 1 of one profile and save it to EEPROM.
    #[wire(spec = "CMD_WRITE_PARAMS_3")]
    WriteParams3 = 22,
    /// Request real-time data.
    #[wire(spec = "CMD_REALTIME_DATA_3")]
    RealtimeData3 = 23,
    /// Choose the IMU that calibration and real-time data work on.
    #[wire(spec = "CMD_SELECT_IMU_3")]
    SelectImu3 = 24,
    /// Request extended real-time data.
    #[wire(spec = "CMD_REALTIME_DATA_4")]
    RealtimeData4 = 25,
    /// Calibrate the offset of the encoders.
    #[wire(spec = "CMD_ENCODERS_CALIB_OFFSET_4")]
    EncodersCalibOffset4 = 26,
    /// Calibrate how the encoders stand to the fields of their motors; the gimbal moves.
    #[wire(spec = "CMD_ENCODERS_CALIB_FLD_OFFSET_4")]
    EncodersCalibFldOffset4 = 27,
    /// Ask for the profile names.
    #[wire(spec = "CMD_READ_PROFILE_NAMES")]
    ReadProfileNames = 28,
    /// Store the five profile names in EEPROM.
    #[wire(spec = "CMD_WRITE_PROFILE_NAMES")]
    WriteProfileNames = 29,
    /// Payload not published.
    #[wire(spec = "CMD_QUEUE_PARAMS_INFO_3")]
    QueueParamsInfo3 = 30,
    /// Change variables now, without saving to EEPROM.
    #[wire(spec = "CMD_SET_ADJ_VARS_VAL")]
    SetAdjVarsVal = 31,
    /// Save adjustable variables to EEPROM.
    #[wire(spec = "CMD_SAVE_PARAMS_3")]
    SaveParams3 = 32,
    /// Ask for configuration block 2 of one profile.
    #[wire(spec = "CMD_READ_PARAMS_EXT")]
    ReadParamsExt = 33,
    /// Write configuration block 2 of one profile and save it to EEPROM.
    #[wire(spec = "CMD_WRITE_PARAMS_EXT")]
    WriteParamsExt = 34,
    /// Start or stop automatic PID tuning, first version.
    #[wire(spec = "CMD_AUTO_PID")]
    AutoPid = 35,
    /// Put PWM on the servo outputs.
    #[wire(spec = "CMD_SERVO_OUT")]
    ServoOut = 36,
    /// Start a Bode test on one axis.
    #[wire(spec = "CMD_BODE_TEST_START_STOP")]
    BodeTestStartStop = 37,
    /// Samples of a running Bode test.
    #[wire(spec = "CMD_BODE_TEST_DATA")]
    BodeTestData = 38,
    /// Write to a register of an I2C device.
    #[wire(spec = "CMD_I2C_WRITE_REG_BUF")]
    I2cWriteRegBuf = 39,
    /// Read from a register of an I2C device.
    #[wire(spec = "CMD_I2C_READ_REG_BUF")]
    I2cReadRegBuf = 40,
    /// Store 128 bytes of user data in EEPROM.
    #[wire(spec = "CMD_WRITE_EXTERNAL_DATA")]
    WriteExternalData = 41,
    /// Ask for the user data.
    #[wire(spec = "CMD_READ_EXTERNAL_DATA")]
    ReadExternalData = 42,
    /// Ask for the mapping of inputs to adjustable variables.
    #[wire(spec = "CMD_READ_ADJ_VARS_CFG")]
    ReadAdjVarsCfg = 43,
    /// Store the mapping of inputs to adjustable variables.
    #[wire(spec = "CMD_WRITE_ADJ_VARS_CFG")]
    WriteAdjVarsCfg = 44,
    /// Set the 32 API virtual channels (API_VIRT_CHxx in the GUI).
    #[wire(spec = "CMD_API_VIRT_CH_CONTROL")]
    ApiVirtChControl = 45,
    /// Ask for the state of one trigger and one analog slot.
    #[wire(spec = "CMD_ADJ_VARS_STATE")]
    AdjVarsState = 46,
    /// Write a block of EEPROM.
    #[wire(spec = "CMD_EEPROM_WRITE")]
    EepromWrite = 47,
    /// Read a block of EEPROM.
    #[wire(spec = "CMD_EEPROM_READ")]
    EepromRead = 48,
    /// Ask for the progress and state of the IMU calibration.
    #[wire(spec = "CMD_CALIB_INFO")]
    CalibInfo = 49,
    /// Have the board sign 32 bytes with its secret keys.
    #[wire(spec = "CMD_SIGN_MESSAGE")]
    SignMessage = 50,
    /// Enter the bootloader.
    #[wire(spec = "CMD_BOOT_MODE_3")]
    BootMode3 = 51,
    /// Payload not published.
    #[wire(spec = "CMD_SYSTEM_STATE")]
    SystemState = 52,
    /// Read part of a file of the internal file system.
    #[wire(spec = "CMD_READ_FILE")]
    ReadFile = 53,
    /// Write part of a file.
    #[wire(spec = "CMD_WRITE_FILE")]
    WriteFile = 54,
    /// Delete all files of the internal file system.
    #[wire(spec = "CMD_FS_CLEAR_ALL")]
    FsClearAll = 55,
    /// Give the attitude of an IMU to the board, or ask for it.
    #[wire(spec = "CMD_AHRS_HELPER")]
    AhrsHelper = 56,
    /// Start or stop a user script.
    #[wire(spec = "CMD_RUN_SCRIPT")]
    RunScript = 57,
    /// Progress of a script started with debug information.
    #[wire(spec = "CMD_SCRIPT_DEBUG")]
    ScriptDebug = 58,
    /// Calibrate the magnetometer of an IMU.
    #[wire(spec = "CMD_CALIB_MAG")]
    CalibMag = 59,
    /// Payload not published.
    #[wire(spec = "CMD_UART_BYPASS")]
    UartBypass = 60,
    /// Request IMU angles, target angles and unwrapped joint angles.
    #[wire(spec = "CMD_GET_ANGLES_EXT")]
    GetAnglesExt = 61,
    /// Ask for configuration block 3 of one profile.
    #[wire(spec = "CMD_READ_PARAMS_EXT2")]
    ReadParamsExt2 = 62,
    /// Write configuration block 3 of one profile and save it to EEPROM.
    #[wire(spec = "CMD_WRITE_PARAMS_EXT2")]
    WriteParamsExt2 = 63,
    /// Ask for the current values of variables.
    #[wire(spec = "CMD_GET_ADJ_VARS_VAL")]
    GetAdjVarsVal = 64,
    /// Calibrate the accelerometer of an IMU.
    #[wire(spec = "CMD_CALIB_ACC")]
    CalibAcc = 65,
    /// Calibrate the internal voltage sensor against a measured voltage.
    #[wire(spec = "CMD_CALIB_BAT")]
    CalibBat = 66,
    /// Outgoing: move the gimbal. Incoming it is `CMD_CONFIRM`, [`Self::CONFIRM`].
    #[wire(spec = "CMD_CONTROL")]
    Control = 67,
    /// Old request for real-time data, answered by `CMD_REALTIME_DATA_3`.
    #[wire(spec = "CMD_REALTIME_DATA")]
    RealtimeData = 68,
    /// Run a menu command.
    #[wire(spec = "CMD_EXECUTE_MENU")]
    ExecuteMenu = 69,
    /// Reset a profile, or everything, to factory defaults.
    #[wire(spec = "CMD_USE_DEFAULTS")]
    UseDefaults = 70,
    /// Calibrate the EXT_FC gains.
    #[wire(spec = "CMD_CALIB_EXT_GAIN")]
    CalibExtGain = 71,
    /// Linear acceleration and inclination of the frame, to help the attitude estimation.
    #[wire(spec = "CMD_HELPER_DATA")]
    HelperData = 72,
    /// Request IMU angles, target angles and target speed.
    #[wire(spec = "CMD_GET_ANGLES")]
    GetAngles = 73,
    /// Payload not published.
    #[wire(spec = "CMD_CALIB_MOTOR_MAG_LINK")]
    CalibMotorMagLink = 74,
    /// Correct the zero bias of the gyroscope by hand.
    #[wire(spec = "CMD_GYRO_CORRECTION")]
    GyroCorrection = 75,
    /// Ask for the versions of the connected CAN devices.
    #[wire(spec = "CMD_MODULE_LIST")]
    ModuleList = 76,
    /// Turn the motors on.
    #[wire(spec = "CMD_MOTORS_ON")]
    MotorsOn = 77,
    /// Start flashing a CAN module.
    #[wire(spec = "CMD_MODULE_FLASH_START")]
    ModuleFlashStart = 78,
    /// Calibrate the follow offset at the present position.
    #[wire(spec = "CMD_CALIB_OFFSET")]
    CalibOffset = 79,
    /// Calibrate the number of motor poles and the direction of the motors; the gimbal moves.
    #[wire(spec = "CMD_CALIB_POLES")]
    CalibPoles = 80,
    /// Write a piece of module firmware.
    #[wire(spec = "CMD_MODULE_FLASH_WRITE")]
    ModuleFlashWrite = 81,
    /// Legacy request for the parameters of one profile.
    #[wire(spec = "CMD_READ_PARAMS")]
    ReadParams = 82,
    /// End flashing a CAN module.
    #[wire(spec = "CMD_MODULE_FLASH_FINISH")]
    ModuleFlashFinish = 83,
    /// Drive an output pin.
    #[wire(spec = "CMD_TRIGGER_PIN")]
    TriggerPin = 84,
    /// Make the board send a message at a fixed rate or on events.
    #[wire(spec = "CMD_DATA_STREAM_INTERVAL")]
    DataStreamInterval = 85,
    /// Ask for board and firmware version.
    #[wire(spec = "CMD_BOARD_INFO")]
    BoardInfo = 86,
    /// Legacy write of the CMD_READ_PARAMS block.
    #[wire(spec = "CMD_WRITE_PARAMS")]
    WriteParams = 87,
    /// Request a chosen set of real-time data.
    #[wire(spec = "CMD_REALTIME_DATA_CUSTOM")]
    RealtimeDataCustom = 88,
    /// Play a standard sound or a melody through motors or buzzer.
    #[wire(spec = "CMD_BEEP_SOUND")]
    BeepSound = 89,
    /// Set how CMD_CONTROL is handled: timeout, port priority, filters, confirmation.
    #[wire(spec = "CMD_CONTROL_CONFIG")]
    ControlConfig = 90,
    /// Calibrate the correction of the sensor misalignment.
    #[wire(spec = "CMD_CALIB_ORIENT_CORR")]
    CalibOrientCorr = 91,
    /// Payload not published.
    #[wire(spec = "CMD_COGGING_CALIB_INFO")]
    CoggingCalibInfo = 92,
    /// Calibrate or delete the correction of motor non-linearity (cogging).
    #[wire(spec = "CMD_CALIB_COGGING")]
    CalibCogging = 93,
    /// Refine the accelerometer calibration of the main IMU from an external reference vector (needs three
    /// encoders).
    #[wire(spec = "CMD_CALIB_ACC_EXT_REF")]
    CalibAccExtRef = 94,
    /// Save, clear or load a whole profile set.
    #[wire(spec = "CMD_PROFILE_SET")]
    ProfileSet = 95,
    /// Scan the CAN bus for devices.
    #[wire(spec = "CMD_CAN_DEVICE_SCAN")]
    CanDeviceScan = 96,
    /// Payload not published.
    #[wire(spec = "CMD_CAN_DRV_HARD_PARAMS")]
    CanDrvHardParams = 97,
    /// Payload not published.
    #[wire(spec = "CMD_CAN_DRV_STATE")]
    CanDrvState = 98,
    /// Payload not published.
    #[wire(spec = "CMD_CAN_DRV_CALIBRATE")]
    CanDrvCalibrate = 99,
    /// Read the chosen RC inputs.
    #[wire(spec = "CMD_READ_RC_INPUTS")]
    ReadRcInputs = 100,
    /// Payload not published.
    #[wire(spec = "CMD_REALTIME_DATA_CAN_DRV")]
    RealtimeDataCanDrv = 101,
    /// An event happened.
    #[wire(spec = "CMD_EVENT")]
    Event = 102,
    /// Calibrate the gyroscope of an IMU.
    #[wire(spec = "CMD_CALIB_GYRO")]
    CalibGyro = 103,
    /// Ask for configuration block 4 of one profile.
    #[wire(spec = "CMD_READ_PARAMS_EXT3")]
    ReadParamsExt3 = 104,
    /// Write configuration block 4 of one profile and save it to EEPROM.
    #[wire(spec = "CMD_WRITE_PARAMS_EXT3")]
    WriteParamsExt3 = 105,
    /// Ask what the external IMU tells.
    #[wire(spec = "CMD_EXT_IMU_DEBUG_INFO")]
    ExtImuDebugInfo = 106,
    /// Payload not published.
    #[wire(spec = "CMD_SET_DEVICE_ADDR")]
    SetDeviceAddr = 107,
    /// Start, stop or configure automatic PID tuning, second version.
    #[wire(spec = "CMD_AUTO_PID2")]
    AutoPid2 = 108,
    /// Turn the motors off.
    #[wire(spec = "CMD_MOTORS_OFF")]
    MotorsOff = 109,
    /// Pass a message on to the external IMU (Basecam GPS_IMU).
    #[wire(spec = "CMD_EXT_IMU_CMD")]
    ExtImuCmd = 110,
    /// Request the persistent state: statistics and maintenance data.
    #[wire(spec = "CMD_READ_STATE_VARS")]
    ReadStateVars = 111,
    /// Write the persistent state back.
    #[wire(spec = "CMD_WRITE_STATE_VARS")]
    WriteStateVars = 112,
    /// Payload not published.
    #[wire(spec = "CMD_SERIAL_PROXY")]
    SerialProxy = 113,
    /// Restart the board; from the board, that it is about to restart.
    #[wire(spec = "CMD_RESET")]
    Reset = 114,
    /// Payload not published.
    #[wire(spec = "CMD_IMU_ADVANCED_CALIB")]
    ImuAdvancedCalib = 115,
    /// Set the first n API virtual channels with finer steps.
    #[wire(spec = "CMD_API_VIRT_CH_HIGH_RES")]
    ApiVirtChHighRes = 116,
    /// Payload not published.
    #[wire(spec = "CMD_CALIB_ENCODER_LUT")]
    CalibEncoderLut = 117,
    /// Payload not published.
    #[wire(spec = "CMD_CALIB_ENCODER_LUT_RES")]
    CalibEncoderLutRes = 118,
    /// Bracket a series of CMD_WRITE_PARAMS_xx: 1 before, 0 after, so the controller restarts once.
    #[wire(spec = "CMD_WRITE_PARAMS_SET")]
    WriteParamsSet = 119,
    /// Payload not published.
    #[wire(spec = "CMD_CALIB_CUR_SENS")]
    CalibCurSens = 120,
    /// Move the gimbal; only some axes and values are sent.
    #[wire(spec = "CMD_CONTROL_EXT")]
    ControlExt = 121,
    /// Payload not published.
    #[wire(spec = "CMD_ENC_INT_CALIB")]
    EncIntCalib = 122,
    /// Align motors that work in parallel on one axis.
    #[wire(spec = "CMD_SYNC_MOTORS")]
    SyncMotors = 123,
    /// Payload not published.
    #[wire(spec = "CMD_EXT_LICENSE_INFO")]
    ExtLicenseInfo = 124,
    /// Payload not published.
    #[wire(spec = "CMD_VIBRATION_TEST_START_STOP")]
    VibrationTestStartStop = 125,
    /// Payload not published.
    #[wire(spec = "CMD_VIBRATION_TEST_DATA")]
    VibrationTestData = 126,
    /// Telemetry of a CAN motor driver.
    #[wire(spec = "CMD_CAN_DRV_TELEMETRY")]
    CanDrvTelemetry = 127,
    /// Switch auxiliary motors on or off, or move them home.
    #[wire(spec = "CMD_EXT_MOTORS_ACTION")]
    ExtMotorsAction = 128,
    /// Give set-points to the chosen auxiliary motors.
    #[wire(spec = "CMD_EXT_MOTORS_CONTROL")]
    ExtMotorsControl = 129,
    /// Set run-time parameters of the chosen auxiliary motors.
    #[wire(spec = "CMD_EXT_MOTORS_CONTROL_CONFIG")]
    ExtMotorsControlConfig = 130,
    /// Ask for the state of auxiliary motors.
    #[wire(spec = "CMD_EXT_MOTORS_STATE")]
    ExtMotorsState = 131,
    /// Ask for the list of adjustable variables from START_ID on.
    #[wire(spec = "CMD_ADJ_VARS_INFO")]
    AdjVarsInfo = 132,
    /// Put PWM on chosen servo outputs, also those of CAN drivers.
    #[wire(spec = "CMD_SERVO_OUT_EXT")]
    ServoOutExt = 133,
    /// Change variables now, with values as floats.
    #[wire(spec = "CMD_SET_ADJ_VARS_VAL_F")]
    SetAdjVarsValF = 134,
    /// Ask for the current values of variables as floats.
    #[wire(spec = "CMD_GET_ADJ_VARS_VAL_F")]
    GetAdjVarsValF = 135,
    /// Ask for the password protection settings.
    #[wire(spec = "CMD_PASS_PROTECT_READ")]
    PassProtectRead = 136,
    /// Set the password protection, with or without a new password.
    #[wire(spec = "CMD_PASS_PROTECT_WRITE")]
    PassProtectWrite = 137,
    /// Request a second set of real-time data.
    #[wire(spec = "CMD_REALTIME_DATA_CUSTOM2")]
    RealtimeDataCustom2 = 139,
    /// Control the attitude by quaternion.
    #[wire(spec = "CMD_CONTROL_QUAT")]
    ControlQuat = 140,
    /// Ask for the state of quaternion control.
    #[wire(spec = "CMD_CONTROL_QUAT_STATUS")]
    ControlQuatStatus = 141,
    /// Set motion profile and filters of quaternion control.
    #[wire(spec = "CMD_CONTROL_QUAT_CONFIG")]
    ControlQuatConfig = 142,
    /// Bridge two serial ports.
    #[wire(spec = "CMD_SET_TRANSP_PROXY")]
    SetTranspProxy = 143,
    /// Look for uDrv modules, find their IMU and give out ids.
    #[wire(spec = "CMD_UDRV_DEVICE_SCAN")]
    UdrvDeviceScan = 144,
    /// Pass a message on to the GPS_IMU sensor (extended family of boards).
    #[wire(spec = "CMD_EXT_SENS_CMD")]
    ExtSensCmd = 150,
    /// Send bytes to a serial port of some device over CAN.
    #[wire(spec = "CMD_TRANSPARENT_SAPI")]
    TransparentSapi = 151,
    /// Payload not published.
    #[wire(spec = "CMD_OBGC")]
    Obgc = 240,
    /// Make this port receive a copy of the traffic of the other ports, or stop.
    #[wire(spec = "CMD_SET_DEBUG_PORT")]
    SetDebugPort = 249,
    /// Payload not published.
    #[wire(spec = "CMD_MAVLINK_INFO")]
    MavlinkInfo = 250,
    /// Payload not published.
    #[wire(spec = "CMD_MAVLINK_DEBUG")]
    MavlinkDebug = 251,
    /// Request names and types of the debug variables.
    #[wire(spec = "CMD_DEBUG_VARS_INFO_3")]
    DebugVarsInfo3 = 253,
    /// Request the values of all debug variables.
    #[wire(spec = "CMD_DEBUG_VARS_3")]
    DebugVars3 = 254,
    /// A command failed.
    #[wire(spec = "CMD_ERROR")]
    Error = 255,
}

impl CommandId {
    /// Incoming: a command was accepted, or what it started is done. Outgoing the same number is `CMD_CONTROL`.
    ///
    /// Spec: `CMD_CONFIRM` = 67.
    pub const CONFIRM: CommandId = CommandId::Control;

    /// The spec's name, for example `CMD_BOARD_INFO`; `None` for an id that the spec does not have.
    pub fn spec_name(self, direction: Direction) -> Option<&'static str> {
        if self == Self::CONFIRM && direction == Direction::Incoming {
            return Some("CMD_CONFIRM");
        }
        let label = Self::LABELS.iter().find(|label| label.value == i64::from(self.raw()))?;
        Some(label.name)
    }

    /// The id that the spec calls `name`. For constants: a name that the spec does not have does not compile.
    #[expect(clippy::panic, reason = "it ends the compilation, not a program")]
    pub(crate) const fn of_spec_name(name: &str) -> Self {
        if equal(name, "CMD_CONFIRM") {
            return Self::CONFIRM;
        }
        let mut labels = Self::LABELS;
        while let Some((label, rest)) = labels.split_first() {
            if equal(label.name, name) {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "made from an u8"
                )]
                return Self::from_raw(label.value as u8);
            }
            labels = rest;
        }
        panic!("the spec has no command of this name")
    }
}

impl core::fmt::Display for CommandId {
    /// The spec's name of the outgoing command, or the number.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.spec_name(Direction::Outgoing) {
            Some(name) => f.write_str(name),
            None => write!(f, "command {}", self.raw()),
        }
    }
}
