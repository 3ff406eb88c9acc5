//! What menu commands do: the actions that buttons, signals and hosts can start.

use sbgc_proto_macros::open_enum;

use crate::wire::bit_enums;

/// An action of the board, as in its menu. Spec: `MENU_CMD`.
///
/// It is run by `CMD_EXECUTE_MENU`, by the menu button, by the command channel, by trigger slots and at start. 42 and
/// up are missing in the copies of the specification that are around; they are those that all libraries have. The
/// specification prints 38 and up without `CMD_` in the name.
#[open_enum(u8)]
pub enum MenuCommand {
    /// Nothing.
    #[wire(spec = "MENU_CMD_NO")]
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
    #[wire(spec = "MENU_CMD_SWAP_PITCH_ROLL")]
    SwapPitchRoll = 4,
    /// Swaps YAW and ROLL of remote control.
    #[wire(spec = "MENU_CMD_SWAP_YAW_ROLL")]
    SwapYawRoll = 5,
    /// Calibrates the accelerometer.
    #[wire(spec = "MENU_CMD_CALIB_ACC")]
    CalibAcc = 6,
    /// Restarts the board.
    #[wire(spec = "MENU_CMD_RESET")]
    Reset = 7,
    /// Makes the present attitude the one that is taken at start, and saves it.
    #[wire(spec = "MENU_CMD_SET_ANGLE")]
    SetAngle = 8,
    /// Calibrates the gyroscope.
    #[wire(spec = "MENU_CMD_CALIB_GYRO")]
    CalibGyro = 9,
    /// Switches the motors on or off.
    #[wire(spec = "MENU_CMD_MOTOR_TOGGLE")]
    MotorToggle = 10,
    /// Switches the motors on.
    #[wire(spec = "MENU_CMD_MOTOR_ON")]
    MotorOn = 11,
    /// Switches the motors off.
    #[wire(spec = "MENU_CMD_MOTOR_OFF")]
    MotorOff = 12,
    /// Adapts to a frame that is upside down, or back.
    #[wire(spec = "MENU_CMD_FRAME_UPSIDE_DOWN")]
    FrameUpsideDown = 13,
    /// Activates the fourth profile.
    #[wire(spec = "MENU_CMD_PROFILE4")]
    Profile4 = 14,
    /// Activates the fifth profile.
    #[wire(spec = "MENU_CMD_PROFILE5")]
    Profile5 = 15,
    /// Tunes the PID controllers.
    #[wire(spec = "MENU_CMD_AUTO_PID")]
    AutoPid = 16,
    /// Points the camera down.
    #[wire(spec = "MENU_CMD_LOOK_DOWN")]
    LookDown = 17,
    /// Goes to the home position.
    #[wire(spec = "MENU_CMD_HOME_POSITION")]
    HomePosition = 18,
    /// Binds a Spektrum receiver.
    #[wire(spec = "MENU_CMD_RC_BIND")]
    RcBind = 19,
    /// Calibrates the gyroscope over temperature.
    #[wire(spec = "MENU_CMD_CALIB_GYRO_TEMP")]
    CalibGyroTemp = 20,
    /// Calibrates the accelerometer over temperature.
    #[wire(spec = "MENU_CMD_CALIB_ACC_TEMP")]
    CalibAccTemp = 21,
    /// Acts like a press of the menu button.
    #[wire(spec = "MENU_CMD_BUTTON_PRESS")]
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
    #[wire(spec = "MENU_CMD_CALIB_MAG")]
    CalibMag = 33,
    /// Levels ROLL and PITCH to the horizon.
    #[wire(spec = "MENU_CMD_LEVEL_ROLL_PITCH")]
    LevelRollPitch = 34,
    /// Turns YAW to the middle.
    #[wire(spec = "MENU_CMD_CENTER_YAW")]
    CenterYaw = 35,
    /// Turns back as many turns as untwist the cables.
    #[wire(spec = "MENU_CMD_UNTWIST_CABLES")]
    UntwistCables = 36,
    /// Makes the present attitude the one that is taken at start, without saving it.
    #[wire(spec = "MENU_CMD_SET_ANGLE_NO_SAVE")]
    SetAngleNoSave = 37,
    /// Goes to the home position by the shortest way.
    #[wire(spec = "MENU_CMD_HOME_POSITION_SHORTEST")]
    HomePositionShortest = 38,
    /// Turns YAW to the middle by the shortest way.
    #[wire(spec = "MENU_CMD_CENTER_YAW_SHORTEST")]
    CenterYawShortest = 39,
    /// Turns YAW by half a turn.
    #[wire(spec = "MENU_CMD_ROTATE_YAW_180")]
    RotateYaw180 = 40,
    /// Turns YAW by half a turn, relative to the frame.
    #[wire(spec = "MENU_CMD_ROTATE_YAW_180_FRAME_REL")]
    RotateYaw180FrameRel = 41,
    /// Switches YAW between forward and backward, relative to the frame.
    #[wire(spec = "MENU_CMD_SWITCH_YAW_180_FRAME_REL")]
    SwitchYaw180FrameRel = 42,
    /// Switches ROLL between level and a quarter turn.
    #[wire(spec = "MENU_CMD_SWITCH_POS_ROLL_90")]
    SwitchPosRoll90 = 43,
    /// Starts the motion of a time lapse.
    #[wire(spec = "MENU_CMD_START_TIMELAPSE")]
    StartTimelapse = 44,
    /// Calibrates the moments of inertia.
    #[wire(spec = "MENU_CMD_CALIB_MOMENTUM")]
    CalibMomentum = 45,
    /// Levels ROLL to the horizon.
    #[wire(spec = "MENU_CMD_LEVEL_ROLL")]
    LevelRoll = 46,
    /// Repeats the motion of a time lapse.
    #[wire(spec = "MENU_CMD_REPEAT_TIMELAPSE")]
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
    #[wire(spec = "MENU_CMD_LOAD_PROFILE_SET_BACKUP")]
    LoadProfileSetBackup = 53,
    /// Inverts remote control of ROLL.
    #[wire(spec = "MENU_CMD_INVERT_RC_ROLL")]
    InvertRcRoll = 54,
    /// Inverts remote control of PITCH.
    #[wire(spec = "MENU_CMD_INVERT_RC_PITCH")]
    InvertRcPitch = 55,
    /// Inverts remote control of YAW.
    #[wire(spec = "MENU_CMD_INVERT_RC_YAW")]
    InvertRcYaw = 56,
    /// Snaps to the nearest of the fixed positions.
    #[wire(spec = "MENU_CMD_SNAP_TO_FIXED_POSITION")]
    SnapToFixedPosition = 57,
    /// Sends the camera's event for recording or photo.
    #[wire(spec = "MENU_CMD_CAMERA_REC_PHOTO_EVENT")]
    CameraRecPhotoEvent = 58,
    /// Sends the camera's event for a photo.
    #[wire(spec = "MENU_CMD_CAMERA_PHOTO_EVENT")]
    CameraPhotoEvent = 59,
    /// Lets the motors come to rest, then switches them off.
    #[wire(spec = "MENU_CMD_MOTORS_SAFE_STOP")]
    MotorsSafeStop = 60,
    /// Calibrates the accelerometer by itself.
    #[wire(spec = "MENU_CMD_CALIB_ACC_AUTO")]
    CalibAccAuto = 61,
    /// Restarts the estimation of attitude.
    #[wire(spec = "MENU_CMD_RESET_IMU")]
    ResetImu = 62,
    /// Switches forced following on or off.
    #[wire(spec = "MENU_CMD_FORCED_FOLLOW_TOGGLE")]
    ForcedFollowToggle = 63,
    /// Tunes only the gain of the PID controllers.
    #[wire(spec = "MENU_CMD_AUTO_PID_GAIN_ONLY")]
    AutoPidGainOnly = 64,
    /// Levels PITCH to the horizon.
    #[wire(spec = "MENU_CMD_LEVEL_PITCH")]
    LevelPitch = 65,
    /// Switches the motors on, or safely off. Newer firmware.
    #[wire(spec = "MENU_CMD_MOTORS_SAFE_TOGGLE")]
    MotorsSafeToggle = 66,
    /// Takes the first step of a time lapse. Newer firmware.
    #[wire(spec = "MENU_CMD_TIMELAPSE_STEP1")]
    TimelapseStep1 = 67,
    /// Calibrates the external gyroscope in motion. Newer firmware.
    #[wire(spec = "MENU_CMD_EXT_GYRO_ONLINE_CALIB")]
    ExtGyroOnlineCalib = 68,
    /// Switches following off or on again. Newer firmware.
    #[wire(spec = "MENU_CMD_DISABLE_FOLLOW_TOGGLE")]
    DisableFollowToggle = 69,
    /// Makes the present position the home position. Newer firmware.
    #[wire(spec = "MENU_CMD_SET_CUR_POS_AS_HOME")]
    SetCurPosAsHome = 70,
    /// Stops the script that runs. Newer firmware.
    #[wire(spec = "MENU_CMD_STOP_SCRIPT")]
    StopScript = 71,
    /// Switches tripod mode off. Newer firmware.
    #[wire(spec = "MENU_CMD_TRIPOD_MODE_OFF")]
    TripodModeOff = 72,
    /// Switches tripod mode on. Newer firmware.
    #[wire(spec = "MENU_CMD_TRIPOD_MODE_ON")]
    TripodModeOn = 73,
    /// Makes the present signals the neutral point of remote control. Newer firmware.
    #[wire(spec = "MENU_CMD_SET_RC_TRIM")]
    SetRcTrim = 74,
    /// Goes to the home position of the motors. Newer firmware.
    #[wire(spec = "MENU_CMD_HOME_POSITION_MOTORS")]
    HomePositionMotors = 75,
    /// Goes to the retracted position. Newer firmware.
    #[wire(spec = "MENU_CMD_RETRACTED_POSITION")]
    RetractedPosition = 76,
    /// Switches the generator of camera shake off. Newer firmware.
    #[wire(spec = "MENU_CMD_SHAKE_GENERATOR_OFF")]
    ShakeGeneratorOff = 77,
    /// Switches the generator of camera shake on. Newer firmware.
    #[wire(spec = "MENU_CMD_SHAKE_GENERATOR_ON")]
    ShakeGeneratorOn = 78,
    /// Switches servo mode on. Newer firmware.
    #[wire(spec = "MENU_CMD_SERVO_MODE_ON")]
    ServoModeOn = 79,
    /// Switches servo mode off. Newer firmware.
    #[wire(spec = "MENU_CMD_SERVO_MODE_OFF")]
    ServoModeOff = 80,
    /// Switches servo mode on or off. Newer firmware.
    #[wire(spec = "MENU_CMD_SERVO_MODE_TOGGLE")]
    ServoModeToggle = 81,
}
bit_enums!(MenuCommand);
