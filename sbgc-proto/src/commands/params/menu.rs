//! Menu commands: actions that buttons, signals and hosts can run.

use sbgc_proto_macros::open_enum;

/// Menu command of the board. Spec: `MENU_CMD`.
///
/// Menu commands are run by `CMD_EXECUTE_MENU`, the menu button, the command channel, trigger slots and start-up
/// actions. Values 42 and above are missing in available copies of the specification, but all libraries agree on them.
/// The specification gives the names of 38 and above without `CMD_`.
#[open_enum(u8, prefix = "MENU_CMD_")]
pub enum MenuCommand {
    /// No action.
    No = 0,
    /// Activates profile 1.
    #[wire(spec = "MENU_CMD_PROFILE1")]
    Profile1 = 1,
    /// Activates profile 2.
    #[wire(spec = "MENU_CMD_PROFILE2")]
    Profile2 = 2,
    /// Activates profile 3.
    #[wire(spec = "MENU_CMD_PROFILE3")]
    Profile3 = 3,
    /// Swaps PITCH and ROLL of RC control.
    SwapPitchRoll = 4,
    /// Swaps YAW and ROLL of RC control.
    SwapYawRoll = 5,
    /// Calibrates the accelerometer.
    CalibAcc = 6,
    /// Restarts the board.
    Reset = 7,
    /// Sets the start-up attitude to the current attitude, and saves it.
    SetAngle = 8,
    /// Calibrates the gyroscope.
    CalibGyro = 9,
    /// Toggles motor power.
    MotorToggle = 10,
    /// Turns the motors on.
    MotorOn = 11,
    /// Turns the motors off.
    MotorOff = 12,
    /// Toggles the upside-down frame configuration.
    FrameUpsideDown = 13,
    /// Activates profile 4.
    #[wire(spec = "MENU_CMD_PROFILE4")]
    Profile4 = 14,
    /// Activates profile 5.
    #[wire(spec = "MENU_CMD_PROFILE5")]
    Profile5 = 15,
    /// Starts automatic PID tuning.
    AutoPid = 16,
    /// Points the camera down.
    LookDown = 17,
    /// Moves to the home position.
    HomePosition = 18,
    /// Binds a Spektrum receiver.
    RcBind = 19,
    /// Calibrates the gyroscope over temperature.
    CalibGyroTemp = 20,
    /// Calibrates the accelerometer over temperature.
    CalibAccTemp = 21,
    /// Acts as a press of the menu button.
    ButtonPress = 22,
    /// Runs the script in slot 1.
    #[wire(spec = "MENU_CMD_RUN_SCRIPT1")]
    RunScript1 = 23,
    /// Runs the script in slot 2.
    #[wire(spec = "MENU_CMD_RUN_SCRIPT2")]
    RunScript2 = 24,
    /// Runs the script in slot 3.
    #[wire(spec = "MENU_CMD_RUN_SCRIPT3")]
    RunScript3 = 25,
    /// Runs the script in slot 4.
    #[wire(spec = "MENU_CMD_RUN_SCRIPT4")]
    RunScript4 = 26,
    /// Runs the script in slot 5.
    #[wire(spec = "MENU_CMD_RUN_SCRIPT5")]
    RunScript5 = 27,
    /// Calibrates the magnetometer.
    CalibMag = 33,
    /// Levels ROLL and PITCH to the horizon.
    LevelRollPitch = 34,
    /// Centers YAW.
    CenterYaw = 35,
    /// Turns back by whole turns to untwist the cables.
    UntwistCables = 36,
    /// Sets the start-up attitude to the current attitude, without saving it.
    SetAngleNoSave = 37,
    /// Moves to the home position by the shortest way.
    HomePositionShortest = 38,
    /// Centers YAW by the shortest way.
    CenterYawShortest = 39,
    /// Rotates YAW by 180 degrees.
    RotateYaw180 = 40,
    /// Rotates YAW by 180 degrees relative to the frame.
    RotateYaw180FrameRel = 41,
    /// Toggles YAW between forward and backward relative to the frame.
    SwitchYaw180FrameRel = 42,
    /// Toggles ROLL between level and 90 degrees.
    SwitchPosRoll90 = 43,
    /// Starts a time-lapse motion.
    StartTimelapse = 44,
    /// Calibrates the moments of inertia.
    CalibMomentum = 45,
    /// Levels ROLL to the horizon.
    LevelRoll = 46,
    /// Repeats a time-lapse motion.
    RepeatTimelapse = 47,
    /// Loads profile set 1.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET1")]
    LoadProfileSet1 = 48,
    /// Loads profile set 2.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET2")]
    LoadProfileSet2 = 49,
    /// Loads profile set 3.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET3")]
    LoadProfileSet3 = 50,
    /// Loads profile set 4.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET4")]
    LoadProfileSet4 = 51,
    /// Loads profile set 5.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET5")]
    LoadProfileSet5 = 52,
    /// Loads the backup profile set.
    LoadProfileSetBackup = 53,
    /// Inverts RC control of ROLL.
    InvertRcRoll = 54,
    /// Inverts RC control of PITCH.
    InvertRcPitch = 55,
    /// Inverts RC control of YAW.
    InvertRcYaw = 56,
    /// Snaps to the nearest fixed position.
    SnapToFixedPosition = 57,
    /// Sends the camera event "Rec/Photo".
    CameraRecPhotoEvent = 58,
    /// Sends the camera event "Photo".
    CameraPhotoEvent = 59,
    /// Stops the motors gradually, then turns them off.
    MotorsSafeStop = 60,
    /// Calibrates the accelerometer automatically.
    CalibAccAuto = 61,
    /// Resets the attitude estimation.
    ResetImu = 62,
    /// Toggles forced follow mode.
    ForcedFollowToggle = 63,
    /// Starts automatic tuning of the PID gain only.
    AutoPidGainOnly = 64,
    /// Levels PITCH to the horizon.
    LevelPitch = 65,
    /// Toggles motor power, with a safe stop. Newer firmware.
    MotorsSafeToggle = 66,
    /// Performs step 1 of a time lapse. Newer firmware.
    #[wire(spec = "MENU_CMD_TIMELAPSE_STEP1")]
    TimelapseStep1 = 67,
    /// Calibrates the external gyroscope in motion. Newer firmware.
    ExtGyroOnlineCalib = 68,
    /// Toggles the suspension of follow mode. Newer firmware.
    DisableFollowToggle = 69,
    /// Sets the home position to the current position. Newer firmware.
    SetCurPosAsHome = 70,
    /// Stops the running script. Newer firmware.
    StopScript = 71,
    /// Turns tripod mode off. Newer firmware.
    TripodModeOff = 72,
    /// Turns tripod mode on. Newer firmware.
    TripodModeOn = 73,
    /// Sets the neutral point of RC control to the current signals. Newer firmware.
    SetRcTrim = 74,
    /// Moves to the home position of the motors. Newer firmware.
    HomePositionMotors = 75,
    /// Moves to the retracted position. Newer firmware.
    RetractedPosition = 76,
    /// Turns the shake generator off. Newer firmware.
    ShakeGeneratorOff = 77,
    /// Turns the shake generator on. Newer firmware.
    ShakeGeneratorOn = 78,
    /// Turns servo mode on. Newer firmware.
    ServoModeOn = 79,
    /// Turns servo mode off. Newer firmware.
    ServoModeOff = 80,
    /// Toggles servo mode. Newer firmware.
    ServoModeToggle = 81,
}
