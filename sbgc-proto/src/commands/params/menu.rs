//! What menu commands do: the actions that buttons, signals and hosts can start.

use sbgc_proto_macros::open_enum;

/// An action of the board, as in its menu. Spec: `MENU_CMD`.
///
/// It is run by `CMD_EXECUTE_MENU`, by the menu button, by the command channel, by trigger slots and at start. 42 and
/// up are missing in the copies of the specification that are around; they are those that all libraries have. The
/// specification prints 38 and up without `CMD_` in the name.
#[open_enum(u8, prefix = "MENU_CMD_")]
pub enum MenuCommand {
    /// Nothing.
    No = 0,
    /// Activates the first profile.
    #[wire(spec = "MENU_CMD_PROFILE1")]
    Profile1 = 1,
    /// Activates the second profile.
    #[wire(spec = "MENU_CMD_PROFILE2")]
    Profile2 = 2,
    /// Activates the third profile.
    #[wire(spec = "MENU_CMD_PROFILE3")]
    Profile3 = 3,
    /// Swaps PITCH and ROLL of remote control.
    SwapPitchRoll = 4,
    /// Swaps YAW and ROLL of remote control.
    SwapYawRoll = 5,
    /// Calibrates the accelerometer.
    CalibAcc = 6,
    /// Restarts the board.
    Reset = 7,
    /// Makes the present attitude the one that is taken at start, and saves it.
    SetAngle = 8,
    /// Calibrates the gyroscope.
    CalibGyro = 9,
    /// Switches the motors on or off.
    MotorToggle = 10,
    /// Turns the motors on.
    MotorOn = 11,
    /// Turns the motors off.
    MotorOff = 12,
    /// Adapts to a frame that is upside down, or back.
    FrameUpsideDown = 13,
    /// Activates the fourth profile.
    #[wire(spec = "MENU_CMD_PROFILE4")]
    Profile4 = 14,
    /// Activates the fifth profile.
    #[wire(spec = "MENU_CMD_PROFILE5")]
    Profile5 = 15,
    /// Tunes the PID controllers.
    AutoPid = 16,
    /// Points the camera down.
    LookDown = 17,
    /// Goes to the home position.
    HomePosition = 18,
    /// Binds a Spektrum receiver.
    RcBind = 19,
    /// Calibrates the gyroscope over temperature.
    CalibGyroTemp = 20,
    /// Calibrates the accelerometer over temperature.
    CalibAccTemp = 21,
    /// Acts like a press of the menu button.
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
    /// Turns YAW to the middle.
    CenterYaw = 35,
    /// Turns back as many turns as untwist the cables.
    UntwistCables = 36,
    /// Makes the present attitude the one that is taken at start, without saving it.
    SetAngleNoSave = 37,
    /// Goes to the home position by the shortest way.
    HomePositionShortest = 38,
    /// Turns YAW to the middle by the shortest way.
    CenterYawShortest = 39,
    /// Turns YAW by half a turn.
    RotateYaw180 = 40,
    /// Turns YAW by half a turn, relative to the frame.
    RotateYaw180FrameRel = 41,
    /// Switches YAW between forward and backward, relative to the frame.
    SwitchYaw180FrameRel = 42,
    /// Switches ROLL between level and a quarter turn.
    SwitchPosRoll90 = 43,
    /// Starts the motion of a time lapse.
    StartTimelapse = 44,
    /// Calibrates the moments of inertia.
    CalibMomentum = 45,
    /// Levels ROLL to the horizon.
    LevelRoll = 46,
    /// Repeats the motion of a time lapse.
    RepeatTimelapse = 47,
    /// Loads the first set of profiles.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET1")]
    LoadProfileSet1 = 48,
    /// Loads the second set of profiles.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET2")]
    LoadProfileSet2 = 49,
    /// Loads the third set of profiles.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET3")]
    LoadProfileSet3 = 50,
    /// Loads the fourth set of profiles.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET4")]
    LoadProfileSet4 = 51,
    /// Loads the fifth set of profiles.
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET5")]
    LoadProfileSet5 = 52,
    /// Loads the backup of the profiles.
    LoadProfileSetBackup = 53,
    /// Inverts remote control of ROLL.
    InvertRcRoll = 54,
    /// Inverts remote control of PITCH.
    InvertRcPitch = 55,
    /// Inverts remote control of YAW.
    InvertRcYaw = 56,
    /// Snaps to the nearest of the fixed positions.
    SnapToFixedPosition = 57,
    /// Sends the camera's event for recording or photo.
    CameraRecPhotoEvent = 58,
    /// Sends the camera's event for a photo.
    CameraPhotoEvent = 59,
    /// Lets the motors come to rest, then switches them off.
    MotorsSafeStop = 60,
    /// Calibrates the accelerometer by itself.
    CalibAccAuto = 61,
    /// Restarts the estimation of attitude.
    ResetImu = 62,
    /// Switches forced following on or off.
    ForcedFollowToggle = 63,
    /// Tunes only the gain of the PID controllers.
    AutoPidGainOnly = 64,
    /// Levels PITCH to the horizon.
    LevelPitch = 65,
    /// Switches the motors on, or safely off. Newer firmware.
    MotorsSafeToggle = 66,
    /// Takes the first step of a time lapse. Newer firmware.
    #[wire(spec = "MENU_CMD_TIMELAPSE_STEP1")]
    TimelapseStep1 = 67,
    /// Calibrates the external gyroscope in motion. Newer firmware.
    ExtGyroOnlineCalib = 68,
    /// Switches following off or on again. Newer firmware.
    DisableFollowToggle = 69,
    /// Makes the present position the home position. Newer firmware.
    SetCurPosAsHome = 70,
    /// Stops the script that runs. Newer firmware.
    StopScript = 71,
    /// Switches tripod mode off. Newer firmware.
    TripodModeOff = 72,
    /// Switches tripod mode on. Newer firmware.
    TripodModeOn = 73,
    /// Makes the present signals the neutral point of remote control. Newer firmware.
    SetRcTrim = 74,
    /// Goes to the home position of the motors. Newer firmware.
    HomePositionMotors = 75,
    /// Goes to the retracted position. Newer firmware.
    RetractedPosition = 76,
    /// Switches the generator of camera shake off. Newer firmware.
    ShakeGeneratorOff = 77,
    /// Switches the generator of camera shake on. Newer firmware.
    ShakeGeneratorOn = 78,
    /// Switches servo mode on. Newer firmware.
    ServoModeOn = 79,
    /// Switches servo mode off. Newer firmware.
    ServoModeOff = 80,
    /// Switches servo mode on or off. Newer firmware.
    ServoModeToggle = 81,
}
