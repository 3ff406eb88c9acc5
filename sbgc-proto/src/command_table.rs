//! The one table of all commands: id, the spec's name, and the message types of both directions.
//!
//! From it follow [`CommandId`](crate::CommandId), [`OutgoingCommand`](crate::OutgoingCommand),
//! [`IncomingCommand`](crate::IncomingCommand), and the table in the documentation of [`commands`](crate::commands).
//!
//! A command is one entry: its summary, the variant of `CommandId` with its number, the spec's name, and the types of
//! its messages. Where a direction has several forms they stand in the order in which they are tried: the first whose
//! `length` includes the payload's is taken. The form to build unless another is asked for is marked `default` where
//! it is declared.

/// Hands the table to the macro called `$then`.
macro_rules! with_commands {
    ($then:ident) => {
        $then! {
            /// Ask for more board information.
            BoardInfo3 = 20, "CMD_BOARD_INFO_3", outgoing(BoardInfo3Request), incoming(BoardInfo3);
            /// Ask for configuration block 1 of one profile.
            ReadParams3 = 21, "CMD_READ_PARAMS_3", outgoing(ReadParams3), incoming(Params3);
            /// Write configuration block 1 of one profile and save it to EEPROM.
            WriteParams3 = 22, "CMD_WRITE_PARAMS_3", outgoing(WriteParams3), incoming();
            /// Request real-time data.
            RealtimeData3 = 23, "CMD_REALTIME_DATA_3", outgoing(RealtimeData3Request), incoming(RealtimeData3);
            /// Choose the IMU that calibration and real-time data work on.
            SelectImu3 = 24, "CMD_SELECT_IMU_3", outgoing(SelectImu3, SelectImu3Extended<'a>), incoming();
            /// Request extended real-time data.
            RealtimeData4 = 25, "CMD_REALTIME_DATA_4", outgoing(RealtimeData4Request), incoming(RealtimeData4);
            /// Calibrate the offset of the encoders.
            EncodersCalibOffset4 = 26, "CMD_ENCODERS_CALIB_OFFSET_4", outgoing(EncodersCalibOffset4Simple, EncodersCalibOffset4), incoming();
            /// Calibrate how the encoders stand to the fields of their motors; the gimbal moves.
            EncodersCalibFldOffset4 = 27, "CMD_ENCODERS_CALIB_FLD_OFFSET_4", outgoing(EncodersCalibFldOffset4Simple, EncodersCalibFldOffset4, EncodersCalibFldOffset4Speed, EncodersCalibFldOffset4Flags), incoming();
            /// Ask for the profile names.
            ReadProfileNames = 28, "CMD_READ_PROFILE_NAMES", outgoing(ReadProfileNames), incoming(ProfileNames);
            /// Store the five profile names in EEPROM.
            WriteProfileNames = 29, "CMD_WRITE_PROFILE_NAMES", outgoing(WriteProfileNames), incoming();
            /// Payload not published.
            QueueParamsInfo3 = 30, "CMD_QUEUE_PARAMS_INFO_3", outgoing(QueueParamsInfo3Request<'a>), incoming(QueueParamsInfo3<'a>);
            /// Change variables now, without saving to EEPROM.
            SetAdjVarsVal = 31, "CMD_SET_ADJ_VARS_VAL", outgoing(SetAdjVarsVal), incoming(AdjVarsVal);
            /// Save adjustable variables to EEPROM.
            SaveParams3 = 32, "CMD_SAVE_PARAMS_3", outgoing(SaveParams3, SaveParams3Extended), incoming();
            /// Ask for configuration block 2 of one profile.
            ReadParamsExt = 33, "CMD_READ_PARAMS_EXT", outgoing(ReadParamsExt), incoming(ParamsExt);
            /// Write configuration block 2 of one profile and save it to EEPROM.
            WriteParamsExt = 34, "CMD_WRITE_PARAMS_EXT", outgoing(WriteParamsExt), incoming();
            /// Start or stop automatic PID tuning, first version.
            AutoPid = 35, "CMD_AUTO_PID", outgoing(AutoPidRequest), incoming(AutoPid);
            /// Put PWM on the servo outputs.
            ServoOut = 36, "CMD_SERVO_OUT", outgoing(ServoOut), incoming();
            /// Start a Bode test on one axis.
            BodeTestStartStop = 37, "CMD_BODE_TEST_START_STOP", outgoing(BodeTestStartStopRequest), incoming(BodeTestStartStop);
            /// Samples of a running Bode test.
            BodeTestData = 38, "CMD_BODE_TEST_DATA", outgoing(), incoming(BodeTestData);
            /// Write to a register of an I2C device.
            I2cWriteRegBuf = 39, "CMD_I2C_WRITE_REG_BUF", outgoing(I2cWriteRegBuf<'a>), incoming();
            /// Read from a register of an I2C device.
            I2cReadRegBuf = 40, "CMD_I2C_READ_REG_BUF", outgoing(I2cReadRegBufRequest), incoming(I2cReadRegBuf<'a>);
            /// Store 128 bytes of user data in EEPROM.
            WriteExternalData = 41, "CMD_WRITE_EXTERNAL_DATA", outgoing(WriteExternalData), incoming();
            /// Ask for the user data.
            ReadExternalData = 42, "CMD_READ_EXTERNAL_DATA", outgoing(ReadExternalData), incoming(ExternalData);
            /// Ask for the mapping of inputs to adjustable variables.
            ReadAdjVarsCfg = 43, "CMD_READ_ADJ_VARS_CFG", outgoing(ReadAdjVarsCfg), incoming(AdjVarsCfg);
            /// Store the mapping of inputs to adjustable variables.
            WriteAdjVarsCfg = 44, "CMD_WRITE_ADJ_VARS_CFG", outgoing(WriteAdjVarsCfg), incoming();
            /// Set the 32 API virtual channels (API_VIRT_CHxx in the GUI).
            ApiVirtChControl = 45, "CMD_API_VIRT_CH_CONTROL", outgoing(ApiVirtChControl, ApiVirtChControlVariable), incoming();
            /// Ask for the state of one trigger and one analog slot.
            AdjVarsState = 46, "CMD_ADJ_VARS_STATE", outgoing(AdjVarsStateRequest, AdjVarsStateLegacyRequest), incoming(AdjVarsState);
            /// Write a block of EEPROM.
            EepromWrite = 47, "CMD_EEPROM_WRITE", outgoing(EepromWrite<'a>), incoming();
            /// Read a block of EEPROM.
            EepromRead = 48, "CMD_EEPROM_READ", outgoing(EepromReadRequest), incoming(EepromRead<'a>);
            /// Ask for the progress and state of the IMU calibration.
            CalibInfo = 49, "CMD_CALIB_INFO", outgoing(CalibInfoRequest), incoming(CalibInfo);
            /// Have the board sign 32 bytes with its secret keys.
            SignMessage = 50, "CMD_SIGN_MESSAGE", outgoing(SignMessageRequest), incoming(SignMessage);
            /// Enter the bootloader.
            BootMode3 = 51, "CMD_BOOT_MODE_3", outgoing(BootMode3, BootMode3Extended), incoming();
            /// Payload not published.
            SystemState = 52, "CMD_SYSTEM_STATE", outgoing(SystemStateRequest<'a>), incoming(SystemState<'a>);
            /// Read part of a file of the internal file system.
            ReadFile = 53, "CMD_READ_FILE", outgoing(ReadFile), incoming(FilePart<'a>, FilePartError);
            /// Write part of a file.
            WriteFile = 54, "CMD_WRITE_FILE", outgoing(WriteFile<'a>, WriteFileDelete), incoming();
            /// Delete all files of the internal file system.
            FsClearAll = 55, "CMD_FS_CLEAR_ALL", outgoing(FsClearAll), incoming();
            /// Give the attitude of an IMU to the board, or ask for it.
            AhrsHelper = 56, "CMD_AHRS_HELPER", outgoing(AhrsHelperLegacyRequest, AhrsHelperShortRequest, AhrsHelperRequest), incoming(AhrsHelperStream, AhrsHelper);
            /// Start or stop a user script.
            RunScript = 57, "CMD_RUN_SCRIPT", outgoing(RunScript), incoming();
            /// Progress of a script started with debug information.
            ScriptDebug = 58, "CMD_SCRIPT_DEBUG", outgoing(), incoming(ScriptDebug);
            /// Calibrate the magnetometer of an IMU.
            CalibMag = 59, "CMD_CALIB_MAG", outgoing(CalibMagSimple, CalibMag), incoming();
            /// Payload not published.
            UartBypass = 60, "CMD_UART_BYPASS", outgoing(UartBypassRequest<'a>), incoming(UartBypass<'a>);
            /// Request IMU angles, target angles and unwrapped joint angles.
            GetAnglesExt = 61, "CMD_GET_ANGLES_EXT", outgoing(GetAnglesExt), incoming(AnglesExt);
            /// Ask for configuration block 3 of one profile.
            ReadParamsExt2 = 62, "CMD_READ_PARAMS_EXT2", outgoing(ReadParamsExt2), incoming(ParamsExt2);
            /// Write configuration block 3 of one profile and save it to EEPROM.
            WriteParamsExt2 = 63, "CMD_WRITE_PARAMS_EXT2", outgoing(WriteParamsExt2), incoming();
            /// Ask for the current values of variables.
            GetAdjVarsVal = 64, "CMD_GET_ADJ_VARS_VAL", outgoing(GetAdjVarsVal), incoming();
            /// Calibrate the accelerometer of an IMU.
            CalibAcc = 65, "CMD_CALIB_ACC", outgoing(CalibAccSimple, CalibAcc), incoming();
            /// Calibrate the internal voltage sensor against a measured voltage.
            CalibBat = 66, "CMD_CALIB_BAT", outgoing(CalibBat), incoming();
            /// Outgoing: move the gimbal. Incoming it is `CMD_CONFIRM`, [`Self::CONFIRM`].
            Control = 67, "CMD_CONTROL", outgoing(ControlLegacy, Control), incoming(Confirm);
            /// Old request for real-time data, answered by `CMD_REALTIME_DATA_3`.
            RealtimeData = 68, "CMD_REALTIME_DATA", outgoing(RealtimeDataRequest), incoming();
            /// Run a menu command.
            ExecuteMenu = 69, "CMD_EXECUTE_MENU", outgoing(ExecuteMenuExtended, ExecuteMenu), incoming();
            /// Reset a profile, or everything, to factory defaults.
            UseDefaults = 70, "CMD_USE_DEFAULTS", outgoing(UseDefaults), incoming();
            /// Calibrate the EXT_FC gains.
            CalibExtGain = 71, "CMD_CALIB_EXT_GAIN", outgoing(CalibExtGain), incoming();
            /// Linear acceleration and inclination of the frame, to help the attitude estimation.
            HelperData = 72, "CMD_HELPER_DATA", outgoing(HelperDataLegacy, HelperData), incoming();
            /// Request IMU angles, target angles and target speed.
            GetAngles = 73, "CMD_GET_ANGLES", outgoing(GetAngles), incoming(Angles);
            /// Payload not published.
            CalibMotorMagLink = 74, "CMD_CALIB_MOTOR_MAG_LINK", outgoing(CalibMotorMagLinkRequest<'a>), incoming(CalibMotorMagLink<'a>);
            /// Correct the zero bias of the gyroscope by hand.
            GyroCorrection = 75, "CMD_GYRO_CORRECTION", outgoing(GyroCorrection), incoming();
            /// Ask for the versions of the connected CAN devices.
            ModuleList = 76, "CMD_MODULE_LIST", outgoing(ModuleListRequest), incoming(ModuleList);
            /// Turn the motors on.
            MotorsOn = 77, "CMD_MOTORS_ON", outgoing(MotorsOn), incoming();
            /// Start flashing a CAN module.
            ModuleFlashStart = 78, "CMD_MODULE_FLASH_START", outgoing(ModuleFlashStart), incoming();
            /// Calibrate the follow offset at the present position.
            CalibOffset = 79, "CMD_CALIB_OFFSET", outgoing(CalibOffset), incoming();
            /// Calibrate the number of motor poles and the direction of the motors; the gimbal moves.
            CalibPoles = 80, "CMD_CALIB_POLES", outgoing(CalibPoles), incoming();
            /// Write a piece of module firmware.
            ModuleFlashWrite = 81, "CMD_MODULE_FLASH_WRITE", outgoing(ModuleFlashWrite<'a>), incoming();
            /// Legacy request for the parameters of one profile.
            ReadParams = 82, "CMD_READ_PARAMS", outgoing(ReadParams), incoming(Params<'a>);
            /// End flashing a CAN module.
            ModuleFlashFinish = 83, "CMD_MODULE_FLASH_FINISH", outgoing(ModuleFlashFinish), incoming();
            /// Drive an output pin.
            TriggerPin = 84, "CMD_TRIGGER_PIN", outgoing(TriggerPin), incoming();
            /// Make the board send a message at a fixed rate or on events.
            DataStreamInterval = 85, "CMD_DATA_STREAM_INTERVAL", outgoing(DataStreamInterval), incoming();
            /// Ask for board and firmware version.
            BoardInfo = 86, "CMD_BOARD_INFO", outgoing(BoardInfoRequest, BoardInfoExtendedRequest<'a>), incoming(BoardInfo);
            /// Legacy write of the CMD_READ_PARAMS block.
            WriteParams = 87, "CMD_WRITE_PARAMS", outgoing(WriteParams<'a>), incoming();
            /// Request a chosen set of real-time data.
            RealtimeDataCustom = 88, "CMD_REALTIME_DATA_CUSTOM", outgoing(RealtimeDataCustomRequest), incoming(RealtimeDataCustomView<'a>);
            /// Play a standard sound or a melody through motors or buzzer.
            BeepSound = 89, "CMD_BEEP_SOUND", outgoing(BeepSound), incoming();
            /// Set how CMD_CONTROL is handled: timeout, port priority, filters, confirmation.
            ControlConfig = 90, "CMD_CONTROL_CONFIG", outgoing(ControlConfig), incoming();
            /// Calibrate the correction of the sensor misalignment.
            CalibOrientCorr = 91, "CMD_CALIB_ORIENT_CORR", outgoing(CalibOrientCorr), incoming();
            /// Payload not published.
            CoggingCalibInfo = 92, "CMD_COGGING_CALIB_INFO", outgoing(CoggingCalibInfoRequest<'a>), incoming(CoggingCalibInfo<'a>);
            /// Calibrate or delete the correction of motor non-linearity (cogging).
            CalibCogging = 93, "CMD_CALIB_COGGING", outgoing(CalibCogging), incoming();
            /// Refine the accelerometer calibration of the main IMU from an external reference vector (needs three
            /// encoders).
            CalibAccExtRef = 94, "CMD_CALIB_ACC_EXT_REF", outgoing(CalibAccExtRef), incoming();
            /// Save, clear or load a whole profile set.
            ProfileSet = 95, "CMD_PROFILE_SET", outgoing(ProfileSet), incoming();
            /// Scan the CAN bus for devices.
            CanDeviceScan = 96, "CMD_CAN_DEVICE_SCAN", outgoing(CanDeviceScanRequest), incoming(CanDeviceScan);
            /// Payload not published.
            CanDrvHardParams = 97, "CMD_CAN_DRV_HARD_PARAMS", outgoing(CanDrvHardParamsRequest<'a>), incoming(CanDrvHardParams<'a>);
            /// Payload not published.
            CanDrvState = 98, "CMD_CAN_DRV_STATE", outgoing(CanDrvStateRequest<'a>), incoming(CanDrvState<'a>);
            /// Payload not published.
            CanDrvCalibrate = 99, "CMD_CAN_DRV_CALIBRATE", outgoing(CanDrvCalibrateRequest<'a>), incoming(CanDrvCalibrate<'a>);
            /// Read the chosen RC inputs.
            ReadRcInputs = 100, "CMD_READ_RC_INPUTS", outgoing(ReadRcInputs), incoming(RcInputs);
            /// Payload not published.
            RealtimeDataCanDrv = 101, "CMD_REALTIME_DATA_CAN_DRV", outgoing(RealtimeDataCanDrvRequest<'a>), incoming(RealtimeDataCanDrv<'a>);
            /// An event happened.
            Event = 102, "CMD_EVENT", outgoing(), incoming(Event<'a>);
            /// Calibrate the gyroscope of an IMU.
            CalibGyro = 103, "CMD_CALIB_GYRO", outgoing(CalibGyroSimple, CalibGyro), incoming();
            /// Ask for configuration block 4 of one profile.
            ReadParamsExt3 = 104, "CMD_READ_PARAMS_EXT3", outgoing(ReadParamsExt3), incoming(ParamsExt3);
            /// Write configuration block 4 of one profile and save it to EEPROM.
            WriteParamsExt3 = 105, "CMD_WRITE_PARAMS_EXT3", outgoing(WriteParamsExt3), incoming();
            /// Ask what the external IMU tells.
            ExtImuDebugInfo = 106, "CMD_EXT_IMU_DEBUG_INFO", outgoing(ExtImuDebugInfoRequest), incoming(ExtImuDebugInfo);
            /// Payload not published.
            SetDeviceAddr = 107, "CMD_SET_DEVICE_ADDR", outgoing(SetDeviceAddrRequest<'a>), incoming(SetDeviceAddr<'a>);
            /// Start, stop or configure automatic PID tuning, second version.
            AutoPid2 = 108, "CMD_AUTO_PID2", outgoing(AutoPid2SimpleRequest, AutoPid2Request), incoming(AutoPid2<'a>);
            /// Turn the motors off.
            MotorsOff = 109, "CMD_MOTORS_OFF", outgoing(MotorsOffSimple, MotorsOff), incoming();
            /// Pass a message on to the external IMU (Basecam GPS_IMU).
            ExtImuCmd = 110, "CMD_EXT_IMU_CMD", outgoing(ExtImuCmdRequest<'a>), incoming(ExtImuCmd<'a>);
            /// Request the persistent state: statistics and maintenance data.
            ReadStateVars = 111, "CMD_READ_STATE_VARS", outgoing(ReadStateVars), incoming(StateVars);
            /// Write the persistent state back.
            WriteStateVars = 112, "CMD_WRITE_STATE_VARS", outgoing(WriteStateVars), incoming();
            /// Payload not published.
            SerialProxy = 113, "CMD_SERIAL_PROXY", outgoing(SerialProxyRequest<'a>), incoming(SerialProxy<'a>);
            /// Restart the board; from the board, that it is about to restart.
            Reset = 114, "CMD_RESET", outgoing(ResetRequest, ResetExtendedRequest), incoming(Reset);
            /// Payload not published.
            ImuAdvancedCalib = 115, "CMD_IMU_ADVANCED_CALIB", outgoing(ImuAdvancedCalibRequest<'a>), incoming(ImuAdvancedCalib<'a>);
            /// Set the first n API virtual channels with finer steps.
            ApiVirtChHighRes = 116, "CMD_API_VIRT_CH_HIGH_RES", outgoing(ApiVirtChHighRes), incoming();
            /// Payload not published.
            CalibEncoderLut = 117, "CMD_CALIB_ENCODER_LUT", outgoing(CalibEncoderLutRequest<'a>), incoming(CalibEncoderLut<'a>);
            /// Payload not published.
            CalibEncoderLutRes = 118, "CMD_CALIB_ENCODER_LUT_RES", outgoing(CalibEncoderLutResRequest<'a>), incoming(CalibEncoderLutRes<'a>);
            /// Bracket a series of CMD_WRITE_PARAMS_xx: 1 before, 0 after, so the controller restarts once.
            WriteParamsSet = 119, "CMD_WRITE_PARAMS_SET", outgoing(WriteParamsSet), incoming();
            /// Payload not published.
            CalibCurSens = 120, "CMD_CALIB_CUR_SENS", outgoing(CalibCurSensRequest<'a>), incoming(CalibCurSens<'a>);
            /// Move the gimbal; only some axes and values are sent.
            ControlExt = 121, "CMD_CONTROL_EXT", outgoing(ControlExt), incoming();
            /// Payload not published.
            EncIntCalib = 122, "CMD_ENC_INT_CALIB", outgoing(EncIntCalibRequest<'a>), incoming(EncIntCalib<'a>);
            /// Align motors that work in parallel on one axis.
            SyncMotors = 123, "CMD_SYNC_MOTORS", outgoing(SyncMotors), incoming();
            /// Payload not published.
            ExtLicenseInfo = 124, "CMD_EXT_LICENSE_INFO", outgoing(ExtLicenseInfoRequest<'a>), incoming(ExtLicenseInfo<'a>);
            /// Payload not published.
            VibrationTestStartStop = 125, "CMD_VIBRATION_TEST_START_STOP", outgoing(VibrationTestStartStopRequest<'a>), incoming(VibrationTestStartStop<'a>);
            /// Payload not published.
            VibrationTestData = 126, "CMD_VIBRATION_TEST_DATA", outgoing(VibrationTestDataRequest<'a>), incoming(VibrationTestData<'a>);
            /// Telemetry of a CAN motor driver.
            CanDrvTelemetry = 127, "CMD_CAN_DRV_TELEMETRY", outgoing(), incoming(CanDrvTelemetryView<'a>);
            /// Switch auxiliary motors on or off, or move them home.
            ExtMotorsAction = 128, "CMD_EXT_MOTORS_ACTION", outgoing(ExtMotorsAction<'a>), incoming();
            /// Give set-points to the chosen auxiliary motors.
            ExtMotorsControl = 129, "CMD_EXT_MOTORS_CONTROL", outgoing(ExtMotorsControl), incoming();
            /// Set run-time parameters of the chosen auxiliary motors.
            ExtMotorsControlConfig = 130, "CMD_EXT_MOTORS_CONTROL_CONFIG", outgoing(ExtMotorsControlConfig), incoming();
            /// Ask for the state of auxiliary motors.
            ExtMotorsState = 131, "CMD_EXT_MOTORS_STATE", outgoing(ExtMotorsStateRequest), incoming(ExtMotorsState);
            /// Ask for the list of adjustable variables from START_ID on.
            AdjVarsInfo = 132, "CMD_ADJ_VARS_INFO", outgoing(AdjVarsInfoRequest), incoming(AdjVarsInfo<'a>);
            /// Put PWM on chosen servo outputs, also those of CAN drivers.
            ServoOutExt = 133, "CMD_SERVO_OUT_EXT", outgoing(ServoOutExt), incoming();
            /// Change variables now, with values as floats.
            SetAdjVarsValF = 134, "CMD_SET_ADJ_VARS_VAL_F", outgoing(SetAdjVarsValF), incoming(AdjVarsValF);
            /// Ask for the current values of variables as floats.
            GetAdjVarsValF = 135, "CMD_GET_ADJ_VARS_VAL_F", outgoing(GetAdjVarsValF), incoming();
            /// Ask for the password protection settings.
            PassProtectRead = 136, "CMD_PASS_PROTECT_READ", outgoing(PassProtectReadRequest), incoming(PassProtectRead);
            /// Set the password protection, with or without a new password.
            PassProtectWrite = 137, "CMD_PASS_PROTECT_WRITE", outgoing(PassProtectWrite<'a>), incoming();
            /// Request a second set of real-time data.
            RealtimeDataCustom2 = 139, "CMD_REALTIME_DATA_CUSTOM2", outgoing(RealtimeDataCustom2Request), incoming(RealtimeDataCustom2View<'a>);
            /// Control the attitude by quaternion.
            ControlQuat = 140, "CMD_CONTROL_QUAT", outgoing(ControlQuat), incoming();
            /// Ask for the state of quaternion control.
            ControlQuatStatus = 141, "CMD_CONTROL_QUAT_STATUS", outgoing(ControlQuatStatusRequest), incoming(ControlQuatStatus);
            /// Set motion profile and filters of quaternion control.
            ControlQuatConfig = 142, "CMD_CONTROL_QUAT_CONFIG", outgoing(ControlQuatConfig), incoming();
            /// Bridge two serial ports.
            SetTranspProxy = 143, "CMD_SET_TRANSP_PROXY", outgoing(SetTranspProxy), incoming();
            /// Look for uDrv modules, find their IMU and give out ids.
            UdrvDeviceScan = 144, "CMD_UDRV_DEVICE_SCAN", outgoing(UdrvDeviceScan), incoming();
            /// Pass a message on to the GPS_IMU sensor (extended family of boards).
            ExtSensCmd = 150, "CMD_EXT_SENS_CMD", outgoing(ExtSensCmdRequest<'a>), incoming(ExtSensCmd<'a>);
            /// Send bytes to a serial port of some device over CAN.
            TransparentSapi = 151, "CMD_TRANSPARENT_SAPI", outgoing(TransparentSapiRequest<'a>), incoming(TransparentSapi<'a>);
            /// Payload not published.
            Obgc = 240, "CMD_OBGC", outgoing(ObgcRequest<'a>), incoming(Obgc<'a>);
            /// Make this port receive a copy of the traffic of the other ports, or stop.
            SetDebugPort = 249, "CMD_SET_DEBUG_PORT", outgoing(SetDebugPortRequest), incoming(SetDebugPort<'a>);
            /// Payload not published.
            MavlinkInfo = 250, "CMD_MAVLINK_INFO", outgoing(MavlinkInfoRequest<'a>), incoming(MavlinkInfo<'a>);
            /// Payload not published.
            MavlinkDebug = 251, "CMD_MAVLINK_DEBUG", outgoing(MavlinkDebugRequest<'a>), incoming(MavlinkDebug<'a>);
            /// Request names and types of the debug variables.
            DebugVarsInfo3 = 253, "CMD_DEBUG_VARS_INFO_3", outgoing(DebugVarsInfo3Request, DebugVarsInfo3ExtendedRequest), incoming(DebugVarsInfo3<'a>);
            /// Request the values of all debug variables.
            DebugVars3 = 254, "CMD_DEBUG_VARS_3", outgoing(DebugVars3Request, DebugVars3ExtendedRequest), incoming(DebugVars3<'a>);
            /// A command failed.
            Error = 255, "CMD_ERROR", outgoing(), incoming(ErrorLegacy, Error);
        }
    };
}
pub(crate) use with_commands;
