//! The one table of all commands: id, the spec's name, and the message types of both directions.
//!
//! From it follow [`CommandId`](crate::CommandId), [`OutgoingCommand`](crate::OutgoingCommand),
//! [`IncomingCommand`](crate::IncomingCommand), and the table in the documentation of [`commands`](crate::commands).
//!
//! A command is one entry: its summary, the variant of `CommandId` with its number, the spec's name where that is not
//! `CMD_` and the variant's name in capitals, and the types of its messages. Where a direction has several forms they
//! stand in the order in which they are tried: the first whose `length` includes the payload's is taken. The form to
//! build unless another is asked for is marked `default` where it is declared.

/// Hands the table to the macro called `$then`.
macro_rules! with_commands {
    ($then:ident) => {
        $then! {
            /// Requests more board information.
            BoardInfo3 = 20, outgoing(BoardInfo3Request), incoming(BoardInfo3);
            /// Requests configuration block 1 of one profile.
            ReadParams3 = 21, outgoing(ReadParams3), incoming(Params3);
            /// Writes configuration block 1 of one profile and saves it to EEPROM.
            WriteParams3 = 22, outgoing(WriteParams3), incoming();
            /// Requests real-time data.
            RealtimeData3 = 23, outgoing(RealtimeData3Request), incoming(RealtimeData3);
            /// Selects the IMU that calibration and real-time data work on.
            SelectImu3 = 24, outgoing(SelectImu3, SelectImu3Extended<'a>), incoming();
            /// Requests extended real-time data.
            RealtimeData4 = 25, outgoing(RealtimeData4Request), incoming(RealtimeData4);
            /// Calibrates the offset of the encoders.
            EncodersCalibOffset4 = 26, outgoing(EncodersCalibOffset4Simple, EncodersCalibOffset4), incoming();
            /// Calibrates the encoders against the fields of their motors; the gimbal moves.
            EncodersCalibFldOffset4 = 27, outgoing(EncodersCalibFldOffset4Simple, EncodersCalibFldOffset4, EncodersCalibFldOffset4Speed, EncodersCalibFldOffset4Flags), incoming();
            /// Requests the profile names.
            ReadProfileNames = 28, outgoing(ReadProfileNames), incoming(ProfileNames);
            /// Stores the five profile names in EEPROM.
            WriteProfileNames = 29, outgoing(WriteProfileNames), incoming();
            /// Payload not published.
            QueueParamsInfo3 = 30, outgoing(QueueParamsInfo3Request<'a>), incoming(QueueParamsInfo3<'a>);
            /// Changes adjustable variables immediately, without saving to EEPROM.
            SetAdjVarsVal = 31, outgoing(SetAdjVarsVal), incoming(AdjVarsVal);
            /// Saves adjustable variables to EEPROM.
            SaveParams3 = 32, outgoing(SaveParams3, SaveParams3Extended), incoming();
            /// Requests configuration block 2 of one profile.
            ReadParamsExt = 33, outgoing(ReadParamsExt), incoming(ParamsExt);
            /// Writes configuration block 2 of one profile and saves it to EEPROM.
            WriteParamsExt = 34, outgoing(WriteParamsExt), incoming();
            /// Starts or stops automatic PID tuning, first version.
            AutoPid = 35, outgoing(AutoPidRequest), incoming(AutoPid);
            /// Sets the PWM of the servo outputs.
            ServoOut = 36, outgoing(ServoOut), incoming();
            /// Starts a Bode test on one axis.
            BodeTestStartStop = 37, outgoing(BodeTestStartStopRequest), incoming(BodeTestStartStop);
            /// Samples of a running Bode test.
            BodeTestData = 38, outgoing(), incoming(BodeTestData);
            /// Writes to a register of an I2C device.
            I2cWriteRegBuf = 39, outgoing(I2cWriteRegBuf<'a>), incoming();
            /// Reads from a register of an I2C device.
            I2cReadRegBuf = 40, outgoing(I2cReadRegBufRequest), incoming(I2cReadRegBuf<'a>);
            /// Stores 128 bytes of user data in EEPROM.
            WriteExternalData = 41, outgoing(WriteExternalData), incoming();
            /// Requests the user data.
            ReadExternalData = 42, outgoing(ReadExternalData), incoming(ExternalData);
            /// Requests the mapping of inputs to adjustable variables.
            ReadAdjVarsCfg = 43, outgoing(ReadAdjVarsCfg), incoming(AdjVarsCfg);
            /// Stores the mapping of inputs to adjustable variables.
            WriteAdjVarsCfg = 44, outgoing(WriteAdjVarsCfg), incoming();
            /// Sets the 32 API virtual channels (API_VIRT_CHxx in the GUI).
            ApiVirtChControl = 45, outgoing(ApiVirtChControl, ApiVirtChControlVariable), incoming();
            /// Requests the state of one trigger and one analog slot.
            AdjVarsState = 46, outgoing(AdjVarsStateRequest, AdjVarsStateLegacyRequest), incoming(AdjVarsState);
            /// Writes a block of EEPROM.
            EepromWrite = 47, outgoing(EepromWrite<'a>), incoming();
            /// Reads a block of EEPROM.
            EepromRead = 48, outgoing(EepromReadRequest), incoming(EepromRead<'a>);
            /// Requests the progress and state of the IMU calibration.
            CalibInfo = 49, outgoing(CalibInfoRequest), incoming(CalibInfo);
            /// Requests a signature of 32 bytes by the secret keys of the board.
            SignMessage = 50, outgoing(SignMessageRequest), incoming(SignMessage);
            /// Enters the bootloader.
            BootMode3 = 51, outgoing(BootMode3, BootMode3Extended), incoming();
            /// Payload not published.
            SystemState = 52, outgoing(SystemStateRequest<'a>), incoming(SystemState<'a>);
            /// Reads part of a file of the internal file system.
            ReadFile = 53, outgoing(ReadFile), incoming(FilePart<'a>, FilePartError);
            /// Writes part of a file.
            WriteFile = 54, outgoing(WriteFile<'a>, WriteFileDelete), incoming();
            /// Deletes all files of the internal file system.
            FsClearAll = 55, outgoing(FsClearAll), incoming();
            /// Sets or requests the attitude of an IMU.
            AhrsHelper = 56, outgoing(AhrsHelperLegacyRequest, AhrsHelperShortRequest, AhrsHelperRequest), incoming(AhrsHelperStream, AhrsHelper);
            /// Starts or stops a user script.
            RunScript = 57, outgoing(RunScript), incoming();
            /// Progress of a script started with debug information.
            ScriptDebug = 58, outgoing(), incoming(ScriptDebug);
            /// Calibrates the magnetometer of an IMU.
            CalibMag = 59, outgoing(CalibMagSimple, CalibMag), incoming();
            /// Payload not published.
            UartBypass = 60, outgoing(UartBypassRequest<'a>), incoming(UartBypass<'a>);
            /// Requests IMU angles, target angles and unwrapped joint angles.
            GetAnglesExt = 61, outgoing(GetAnglesExt), incoming(AnglesExt);
            /// Requests configuration block 3 of one profile.
            ReadParamsExt2 = 62 as "CMD_READ_PARAMS_EXT2", outgoing(ReadParamsExt2), incoming(ParamsExt2);
            /// Writes configuration block 3 of one profile and saves it to EEPROM.
            WriteParamsExt2 = 63 as "CMD_WRITE_PARAMS_EXT2", outgoing(WriteParamsExt2), incoming();
            /// Requests the current values of variables.
            GetAdjVarsVal = 64, outgoing(GetAdjVarsVal), incoming();
            /// Calibrates the accelerometer of an IMU.
            CalibAcc = 65, outgoing(CalibAccSimple, CalibAcc), incoming();
            /// Calibrates the internal voltage sensor against a measured voltage.
            CalibBat = 66, outgoing(CalibBat), incoming();
            /// Outgoing: moves the gimbal. Incoming, it is `CMD_CONFIRM`, [`Self::CONFIRM`].
            Control = 67, outgoing(ControlLegacy, Control), incoming(Confirm);
            /// Legacy request for real-time data, answered by `CMD_REALTIME_DATA_3`.
            RealtimeData = 68, outgoing(RealtimeDataRequest), incoming();
            /// Runs a menu command.
            ExecuteMenu = 69, outgoing(ExecuteMenuExtended, ExecuteMenu), incoming();
            /// Resets a profile, or everything, to factory defaults.
            UseDefaults = 70, outgoing(UseDefaults), incoming();
            /// Calibrates the EXT_FC gains.
            CalibExtGain = 71, outgoing(CalibExtGain), incoming();
            /// Linear acceleration and inclination of the frame, to help the attitude estimation.
            HelperData = 72, outgoing(HelperDataLegacy, HelperData), incoming();
            /// Requests IMU angles, target angles and target speed.
            GetAngles = 73, outgoing(GetAngles), incoming(Angles);
            /// Payload not published.
            CalibMotorMagLink = 74, outgoing(CalibMotorMagLinkRequest<'a>), incoming(CalibMotorMagLink<'a>);
            /// Corrects the zero of the gyroscope manually.
            GyroCorrection = 75, outgoing(GyroCorrection), incoming();
            /// Requests the versions of the connected CAN devices.
            ModuleList = 76, outgoing(ModuleListRequest), incoming(ModuleList);
            /// Turns the motors on.
            MotorsOn = 77, outgoing(MotorsOn), incoming();
            /// Starts a firmware update of a CAN module.
            ModuleFlashStart = 78, outgoing(ModuleFlashStart), incoming();
            /// Calibrates the follow offset at the current position.
            CalibOffset = 79, outgoing(CalibOffset), incoming();
            /// Calibrates the number of motor poles and the direction of the motors; the gimbal moves.
            CalibPoles = 80, outgoing(CalibPoles), incoming();
            /// Writes one packet of module firmware.
            ModuleFlashWrite = 81, outgoing(ModuleFlashWrite<'a>), incoming();
            /// Legacy request for the parameters of one profile.
            ReadParams = 82, outgoing(ReadParams), incoming(Params<'a>);
            /// Finishes a firmware update of a CAN module.
            ModuleFlashFinish = 83, outgoing(ModuleFlashFinish), incoming();
            /// Sets the state of a pin.
            TriggerPin = 84, outgoing(TriggerPin), incoming();
            /// Registers, changes or stops a data stream.
            DataStreamInterval = 85, outgoing(DataStreamInterval), incoming();
            /// Requests board and firmware version.
            BoardInfo = 86, outgoing(BoardInfoRequest, BoardInfoExtendedRequest<'a>), incoming(BoardInfo);
            /// Legacy write of the CMD_READ_PARAMS block.
            WriteParams = 87, outgoing(WriteParams<'a>), incoming();
            /// Requests a selected set of real-time data.
            RealtimeDataCustom = 88, outgoing(RealtimeDataCustomRequest), incoming(RealtimeDataCustomView<'a>);
            /// Plays a standard sound or a melody through motors or buzzer.
            BeepSound = 89, outgoing(BeepSound), incoming();
            /// Configures the handling of CMD_CONTROL: timeout, port priorities, filters and confirmations.
            ControlConfig = 90, outgoing(ControlConfig), incoming();
            /// Calibrates the correction of the sensor misalignment.
            CalibOrientCorr = 91, outgoing(CalibOrientCorr), incoming();
            /// Payload not published.
            CoggingCalibInfo = 92, outgoing(CoggingCalibInfoRequest<'a>), incoming(CoggingCalibInfo<'a>);
            /// Calibrates or deletes the correction of motor non-linearity (cogging).
            CalibCogging = 93, outgoing(CalibCogging), incoming();
            /// Refines the accelerometer calibration of the main IMU with an external reference (requires three
            /// encoders).
            CalibAccExtRef = 94, outgoing(CalibAccExtRef), incoming();
            /// Saves, clears or loads a whole profile set.
            ProfileSet = 95, outgoing(ProfileSet), incoming();
            /// Scans the CAN bus for devices.
            CanDeviceScan = 96, outgoing(CanDeviceScanRequest), incoming(CanDeviceScan);
            /// Payload not published.
            CanDrvHardParams = 97, outgoing(CanDrvHardParamsRequest<'a>), incoming(CanDrvHardParams<'a>);
            /// Payload not published.
            CanDrvState = 98, outgoing(CanDrvStateRequest<'a>), incoming(CanDrvState<'a>);
            /// Payload not published.
            CanDrvCalibrate = 99, outgoing(CanDrvCalibrateRequest<'a>), incoming(CanDrvCalibrate<'a>);
            /// Reads the selected RC inputs.
            ReadRcInputs = 100, outgoing(ReadRcInputs), incoming(RcInputs);
            /// Payload not published.
            RealtimeDataCanDrv = 101, outgoing(RealtimeDataCanDrvRequest<'a>), incoming(RealtimeDataCanDrv<'a>);
            /// Reports an event.
            Event = 102, outgoing(), incoming(BoardEvent<'a>);
            /// Calibrates the gyroscope of an IMU.
            CalibGyro = 103, outgoing(CalibGyroSimple, CalibGyro), incoming();
            /// Requests configuration block 4 of one profile.
            ReadParamsExt3 = 104 as "CMD_READ_PARAMS_EXT3", outgoing(ReadParamsExt3), incoming(ParamsExt3);
            /// Writes configuration block 4 of one profile and saves it to EEPROM.
            WriteParamsExt3 = 105 as "CMD_WRITE_PARAMS_EXT3", outgoing(WriteParamsExt3), incoming();
            /// Requests debug information of the external IMU.
            ExtImuDebugInfo = 106, outgoing(ExtImuDebugInfoRequest), incoming(ExtImuDebugInfo);
            /// Payload not published.
            SetDeviceAddr = 107, outgoing(SetDeviceAddrRequest<'a>), incoming(SetDeviceAddr<'a>);
            /// Starts, stops or configures automatic PID tuning, second version.
            AutoPid2 = 108 as "CMD_AUTO_PID2", outgoing(AutoPid2SimpleRequest, AutoPid2Request), incoming(AutoPid2<'a>);
            /// Turns the motors off.
            MotorsOff = 109, outgoing(MotorsOffSimple, MotorsOff), incoming();
            /// Forwards a message to the external IMU (Basecam GPS_IMU).
            ExtImuCmd = 110, outgoing(ExtImuCmdRequest<'a>), incoming(ExtImuCmd<'a>);
            /// Requests the persistent state: statistics and maintenance data.
            ReadStateVars = 111, outgoing(ReadStateVars), incoming(StateVars);
            /// Writes the persistent state back.
            WriteStateVars = 112, outgoing(WriteStateVars), incoming();
            /// Payload not published.
            SerialProxy = 113, outgoing(SerialProxyRequest<'a>), incoming(SerialProxy<'a>);
            /// Restarts the board; incoming, announces a restart.
            Reset = 114, outgoing(ResetRequest, ResetExtendedRequest), incoming(Reset);
            /// Payload not published.
            ImuAdvancedCalib = 115, outgoing(ImuAdvancedCalibRequest<'a>), incoming(ImuAdvancedCalib<'a>);
            /// Sets API virtual channels at high resolution, starting with the first.
            ApiVirtChHighRes = 116, outgoing(ApiVirtChHighRes), incoming();
            /// Payload not published.
            CalibEncoderLut = 117, outgoing(CalibEncoderLutRequest<'a>), incoming(CalibEncoderLut<'a>);
            /// Payload not published.
            CalibEncoderLutRes = 118, outgoing(CalibEncoderLutResRequest<'a>), incoming(CalibEncoderLutRes<'a>);
            /// Starts or finishes a series of CMD_WRITE_PARAMS_xx, so that the board restarts only once.
            WriteParamsSet = 119, outgoing(WriteParamsSet), incoming();
            /// Payload not published.
            CalibCurSens = 120, outgoing(CalibCurSensRequest<'a>), incoming(CalibCurSens<'a>);
            /// Moves the gimbal, with selected axes and values only.
            ControlExt = 121, outgoing(ControlExt), incoming();
            /// Payload not published.
            EncIntCalib = 122, outgoing(EncIntCalibRequest<'a>), incoming(EncIntCalib<'a>);
            /// Synchronizes motors that work in parallel on one axis.
            SyncMotors = 123, outgoing(SyncMotors), incoming();
            /// Payload not published.
            ExtLicenseInfo = 124, outgoing(ExtLicenseInfoRequest<'a>), incoming(ExtLicenseInfo<'a>);
            /// Payload not published.
            VibrationTestStartStop = 125, outgoing(VibrationTestStartStopRequest<'a>), incoming(VibrationTestStartStop<'a>);
            /// Payload not published.
            VibrationTestData = 126, outgoing(VibrationTestDataRequest<'a>), incoming(VibrationTestData<'a>);
            /// Telemetry of a CAN motor driver.
            CanDrvTelemetry = 127, outgoing(), incoming(CanDrvTelemetryView<'a>);
            /// Turns auxiliary motors on or off, or moves them home.
            ExtMotorsAction = 128, outgoing(ExtMotorsAction<'a>), incoming();
            /// Sends set-points to selected auxiliary motors.
            ExtMotorsControl = 129, outgoing(ExtMotorsControl), incoming();
            /// Sets run-time parameters of the selected auxiliary motors.
            ExtMotorsControlConfig = 130, outgoing(ExtMotorsControlConfig), incoming();
            /// Requests the state of auxiliary motors.
            ExtMotorsState = 131, outgoing(ExtMotorsStateRequest), incoming(ExtMotorsState);
            /// Requests the list of adjustable variables starting at START_ID.
            AdjVarsInfo = 132, outgoing(AdjVarsInfoRequest), incoming(AdjVarsInfo<'a>);
            /// Sets the PWM of selected servo outputs, including those of CAN drivers.
            ServoOutExt = 133, outgoing(ServoOutExt), incoming();
            /// Changes adjustable variables immediately, with float values, without saving to EEPROM.
            SetAdjVarsValF = 134, outgoing(SetAdjVarsValF), incoming(AdjVarsValF);
            /// Requests the current values of variables as floats.
            GetAdjVarsValF = 135, outgoing(GetAdjVarsValF), incoming();
            /// Requests the password protection settings.
            PassProtectRead = 136, outgoing(PassProtectReadRequest), incoming(PassProtectRead);
            /// Sets the password protection, with or without a new password.
            PassProtectWrite = 137, outgoing(PassProtectWrite<'a>), incoming();
            /// Requests a second set of real-time data.
            RealtimeDataCustom2 = 139 as "CMD_REALTIME_DATA_CUSTOM2", outgoing(RealtimeDataCustom2Request), incoming(RealtimeDataCustom2View<'a>);
            /// Turns the camera to an attitude, or rotates it about any axis.
            ControlQuat = 140, outgoing(ControlQuat), incoming();
            /// Requests the state of quaternion control.
            ControlQuatStatus = 141, outgoing(ControlQuatStatusRequest), incoming(ControlQuatStatus);
            /// Configures the motion profile and the filters of quaternion control.
            ControlQuatConfig = 142, outgoing(ControlQuatConfig), incoming();
            /// Bridges two serial ports.
            SetTranspProxy = 143, outgoing(SetTranspProxy), incoming();
            /// Scans the CAN bus for uDrv modules, locates their IMUs and assigns ids.
            UdrvDeviceScan = 144, outgoing(UdrvDeviceScan), incoming();
            /// Forwards a message to the GPS_IMU sensor (extended family of boards).
            ExtSensCmd = 150, outgoing(ExtSensCmdRequest<'a>), incoming(ExtSensCmd<'a>);
            /// Sends bytes to a serial port of a device.
            TransparentSapi = 151, outgoing(TransparentSapiRequest<'a>), incoming(TransparentSapi<'a>);
            /// Payload not published.
            Obgc = 240, outgoing(ObgcRequest<'a>), incoming(Obgc<'a>);
            /// Starts or stops sending copies of the messages on other ports.
            SetDebugPort = 249, outgoing(SetDebugPortRequest), incoming(SetDebugPort<'a>);
            /// Payload not published.
            MavlinkInfo = 250, outgoing(MavlinkInfoRequest<'a>), incoming(MavlinkInfo<'a>);
            /// Payload not published.
            MavlinkDebug = 251, outgoing(MavlinkDebugRequest<'a>), incoming(MavlinkDebug<'a>);
            /// Requests names and types of the debug variables.
            DebugVarsInfo3 = 253, outgoing(DebugVarsInfo3Request, DebugVarsInfo3ExtendedRequest), incoming(DebugVarsInfo3<'a>);
            /// Requests the values of all debug variables.
            DebugVars3 = 254, outgoing(DebugVars3Request, DebugVars3ExtendedRequest), incoming(DebugVars3<'a>);
            /// Reports a failed command.
            Error = 255, outgoing(), incoming(ErrorLegacy, Error);
        }
    };
}
pub(crate) use with_commands;
