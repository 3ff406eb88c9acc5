//! The sets of flags in the blocks of parameters.

use crate::declare::flags;

flags! {
    /// Settings that all profiles share, first set. Spec: `GENERAL_FLAGS1`.
    pub struct GeneralFlags1: u16 {
        /// The profile that was active last is active at the next start.
        const REMEMBER_LAST_USED_PROFILE = 1 << 0;
        /// The frame may be turned upside down; the board notices by itself.
        const UPSIDE_DOWN_AUTO = 1 << 1;
        /// Main and frame IMU change places.
        const SWAP_FRAME_MAIN_IMU = 1 << 2;
        /// The LED blinks the number of the profile.
        const BLINK_PROFILE = 1 << 3;
        /// A severe error stops the motors.
        const EMERGENCY_STOP = 1 << 4;
        /// The magnetometer is on the frame.
        const MAGNETOMETER_POS_FRAME = 1 << 5;
        /// The frame IMU feeds forward.
        const FRAME_IMU_FF = 1 << 6;
        /// Overheating stops the motors.
        const OVERHEAT_STOP_MOTORS = 1 << 7;
        /// YAW goes to the middle at start.
        const CENTER_YAW_AT_STARTUP = 1 << 8;
        /// The serial receiver and UART B change places.
        const SWAP_RC_SERIAL_UART_B = 1 << 9;
        /// UART B speaks this protocol.
        const UART_B_SERIAL_API = 1 << 10;
        /// The LED blinks the level of the battery.
        const BLINK_BAT_LEVEL = 1 << 11;
        /// The trust in the gyroscope adapts itself.
        const ADAPTIVE_GYRO_TRUST = 1 << 12;
        /// The frame is upside down. Firmware 2.66+.
        const IS_UPSIDE_DOWN = 1 << 13;
        /// UART 3 speaks this protocol. Newer firmware.
        const UART_3_SERIAL_API = 1 << 14;
        /// Remote control is inverted when the frame is. Newer firmware.
        const FRAME_INV_RC_INV = 1 << 15;
    }
}

flags! {
    /// Settings of a profile, first set. Spec: `PROFILE_FLAGS1`.
    ///
    /// Bit 3 has no published meaning.
    pub struct ProfileFlags1: u16 {
        /// Analog input 1 finds out by itself whether something is connected.
        const ADC1_AUTO_DETECTION = 1 << 0;
        /// Analog input 2 finds out by itself whether something is connected.
        const ADC2_AUTO_DETECTION = 1 << 1;
        /// Analog input 3 finds out by itself whether something is connected.
        const ADC3_AUTO_DETECTION = 1 << 2;
        /// Follow mode uses the frame IMU.
        const FOLLOW_USE_FRAME_IMU = 1 << 4;
        /// Being carried like a briefcase is noticed.
        const BRIEFCASE_AUTO_DETECTION = 1 << 5;
        /// The camera turns by itself when the frame is upside down.
        const UPSIDE_DOWN_AUTO_ROTATE = 1 << 6;
        /// The offset of follow mode is corrected while following is locked.
        const FOLLOW_LOCK_OFFSET_CORRECTION = 1 << 7;
        /// The neutral position is taken at start.
        const START_NEUTRAL_POSITION = 1 << 8;
        /// Holding the menu button switches following off.
        const MENU_BUTTON_DISABLE_FOLLOW = 1 << 9;
        /// The frame does not move during a time lapse.
        const TIMELAPSE_FRAME_FIXED = 1 << 10;
        /// The rate of the remote control's mix is kept.
        const RC_KEEP_MIX_RATE = 1 << 11;
        /// The present position is kept when remote control starts.
        const RC_KEEP_CUR_POS_ON_INIT = 1 << 12;
        /// The outer motor may turn without end. Firmware 2.66+.
        const OUTER_MOTOR_LIMIT_FREE_ROTATION = 1 << 13;
        /// The order of Euler angles is chosen by itself. Firmware 2.67b1+.
        ///
        /// A newer list calls this bit `GIMBAL_LOCK_SMOOTH_TRANSITION`; perhaps it was renamed.
        const EULER_ORDER_AUTO = 1 << 14;
        /// The camera works upside down. Newer firmware.
        const CAM_UPSIDE_DOWN_WORKING = 1 << 15;
    }
}

flags! {
    /// The filters of an axis that are in use. Spec: `FILTERS_EN`.
    pub struct FiltersEnabled: u8, prefix "EN_" {
        /// First notch filter.
        const NOTCH1 = 1 << 0;
        /// Second notch filter.
        const NOTCH2 = 1 << 1;
        /// Third notch filter.
        const NOTCH3 = 1 << 2;
        /// Low-pass filter.
        const LPF = 1 << 3;
    }
}

flags! {
    /// Settings that all profiles share, second set. Spec: `GENERAL_FLAGS2`.
    pub struct GeneralFlags2: u16 {
        /// The limit of ROLL is searched at start.
        const SEARCH_LIMIT_ROLL = 1 << 0;
        /// The limit of PITCH is searched at start.
        const SEARCH_LIMIT_PITCH = 1 << 1;
        /// The limit of YAW is searched at start.
        const SEARCH_LIMIT_YAW = 1 << 2;
        /// The moments of inertia are calibrated at start. Firmware 2.62b7+.
        const AUTO_CALIBRATE_MOMENTUM = 1 << 3;
        /// The moments of inertia feed forward. Firmware 2.62b7+.
        const USE_MOMENTUM_FEED_FORWARD = 1 << 4;
        /// The motors stay off at start. Firmware 2.62b7+.
        const MOTORS_OFF_AT_STARTUP = 1 << 5;
        /// The flight controller is below the outer motor; with `FC_BELOW_MIDDLE` too, it is on the camera platform.
        /// Firmware 2.62b7+.
        const FC_BELOW_OUTER = 1 << 6;
        /// The limits of the encoders are not checked. Firmware 2.66+.
        const DO_NOT_CHECK_ENCODER_LIMITS = 1 << 7;
        /// The backup of the profiles is kept by itself. Firmware 2.66+.
        const AUTO_SAVE_BACKUP_SLOT = 1 << 8;
        /// The flight controller is below the middle motor; with `FC_BELOW_OUTER` too, it is on the camera platform.
        /// Firmware 2.66+.
        const FC_BELOW_MIDDLE = 1 << 9;
        /// The ambient temperature is unknown. Firmware 2.67b2+.
        const ENVIRONMENT_TEMP_UNKNOWN = 1 << 10;
        /// Low-pass filters of control and following go from 0 to 255 instead of 15. Newer firmware.
        const LPF_EXTENDED_RANGE = 1 << 11;
        /// Statistics of the system are saved. Newer firmware.
        const SAVE_SYSTEM_STAT = 1 << 12;
        /// The accelerometer is not used. Newer firmware.
        const DISABLE_ACC = 1 << 13;
        /// The power manager is not used. Newer firmware.
        const DISABLE_POWER_MANAGER = 1 << 14;
        /// The IMU on the board may be the main one. Newer firmware; a former name is `ALLOW_FRAME_IMU_AS_MAIN`.
        const ALLOW_ONBOARD_IMU_AS_MAIN = 1 << 15;
    }
}

flags! {
    /// The soft limits of which the parking position is made. Spec: `PARKING_POS_CFG`.
    pub struct ParkingPosition: u8 {
        /// The negative limit of ROLL.
        const ROLL_NEGATIVE = 1 << 0;
        /// The positive limit of ROLL.
        const ROLL_POSITIVE = 1 << 1;
        /// The negative limit of PITCH.
        const PITCH_NEGATIVE = 1 << 2;
        /// The positive limit of PITCH.
        const PITCH_POSITIVE = 1 << 3;
        /// The negative limit of YAW.
        const YAW_NEGATIVE = 1 << 4;
        /// The positive limit of YAW.
        const YAW_POSITIVE = 1 << 5;
    }
}

flags! {
    /// Options of automatic PID tuning. Spec: `AUTO_PID_CFG`.
    ///
    /// The specification shows bits 0, 1 and 3 only; the others are those of newer documents.
    pub struct AutoPidFlags: u8, prefix "AUTO_PID_CFG_" {
        /// It tunes ROLL.
        const ROLL = 1 << 0;
        /// It tunes PITCH.
        const PITCH = 1 << 1;
        /// It tunes YAW.
        const YAW = 1 << 2;
        /// It reports its progress.
        const SEND_GUI = 1 << 3;
        /// It begins with the present values.
        const KEEP_CURRENT = 1 << 4;
        /// It tunes the low-pass filters too.
        const TUNE_LPF_FREQ = 1 << 5;
        /// It stores its result in all profiles.
        const ALL_PROFILES = 1 << 6;
    }
}

flags! {
    /// Settings that all profiles share, third set. Spec: `GENERAL_FLAGS3`.
    ///
    /// All are of newer firmware and published by name only; what they do is read from their names.
    pub struct GeneralFlags3: u32 {
        /// The table that corrects the encoder of ROLL is in use.
        const ENC_LUT_EN_ROLL = 1 << 0;
        /// The table that corrects the encoder of PITCH is in use.
        const ENC_LUT_EN_PITCH = 1 << 1;
        /// The table that corrects the encoder of YAW is in use.
        const ENC_LUT_EN_YAW = 1 << 2;
        /// YAW of MavLink commands is absolute.
        const MAVLINK_YAW_ABSOLUTE = 1 << 3;
        /// The external sensor is the reference.
        const EXT_SENS_AS_REFERENCE = 1 << 4;
        /// Bluetooth is off.
        const DISABLE_BT = 1 << 5;
        /// A sensor that was lost may come back.
        const ALLOW_SENSOR_RECOVERY = 1 << 6;
        /// UART2 is on its other pins.
        const UART2_ALT = 1 << 7;
        /// ROLL may pass its soft limits.
        const PASS_LIMIT_ROLL = 1 << 8;
        /// PITCH may pass its soft limits.
        const PASS_LIMIT_PITCH = 1 << 9;
        /// YAW may pass its soft limits.
        const PASS_LIMIT_YAW = 1 << 10;
        /// ROLL is not pushed against its soft limits.
        const DONT_PUSH_SOFT_LIMITS_ROLL = 1 << 11;
        /// PITCH is not pushed against its soft limits.
        const DONT_PUSH_SOFT_LIMITS_PITCH = 1 << 12;
        /// YAW is not pushed against its soft limits.
        const DONT_PUSH_SOFT_LIMITS_YAW = 1 << 13;
        /// Tripod mode switches itself on.
        const TRIPOD_MODE_AUTO = 1 << 14;
        /// In tripod mode the gyroscope is calibrated all the time.
        const TRIPOD_MODE_GYRO_ONLINE_CALIB = 1 << 15;
        /// In the retracted position the motors are off.
        const RETRACTED_POSITION_MOTORS_OFF = 1 << 16;
        /// The thermostat of the IMU on the CAN bus is on.
        const CAN_IMU_THERMOSTAT_ENABLE = 1 << 17;
        /// The retracted position is reached by the shortest way.
        const RETRACTED_POSITION_SHORTEST = 1 << 18;
        /// Remote control can leave the retracted position.
        const RETRACTED_POSITION_RC_CONTROL = 1 << 19;
        /// Limits of acceleration have their extended range.
        const ACC_LIMIT_EXT_RANGE = 1 << 20;
        /// ROLL moves by the shortest way.
        const MOVE_SHORT_PATH_ROLL = 1 << 21;
        /// PITCH moves by the shortest way.
        const MOVE_SHORT_PATH_PITCH = 1 << 22;
        /// YAW moves by the shortest way.
        const MOVE_SHORT_PATH_YAW = 1 << 23;
        /// The soft limits of the middle motor go with an inverted frame.
        const FRAME_INV_SOFT_LIMIT_MIDDLE = 1 << 24;
        /// The soft limits of the outer motor go with an inverted frame.
        const FRAME_INV_SOFT_LIMIT_OUTER = 1 << 25;
        /// Servo output 1 of the IMU on the CAN bus puts out a duty cycle.
        const CAN_IMU_SERVO1_DUTY_MODE = 1 << 26;
        /// Servo output 2 of the IMU on the CAN bus puts out a duty cycle.
        const CAN_IMU_SERVO2_DUTY_MODE = 1 << 27;
    }
}

flags! {
    /// Settings that all profiles share, fourth set. Spec: `GENERAL_FLAGS4`.
    ///
    /// All are of newer firmware and published by name only; what they do is read from their names.
    pub struct GeneralFlags4: u32 {
        /// Acceleration is limited by the moment of inertia.
        const ACC_LIMIT_BY_MOMENTUM = 1 << 0;
        /// The moments of inertia are calibrated in the normal position.
        const CALIB_MOMENTUM_IN_NORMAL_POS = 1 << 1;
        /// One half of `EULER_INVERSE_INIT_MASK`: Euler angles begin by the middle axis.
        const EULER_MIDDLE_AXIS = 1 << 2;
        /// The other half: Euler angles begin so that they match the rotation of the motors.
        const EULER_MATCH_MOTOR_ROTATION = 1 << 3;
    }
}

flags! {
    /// Settings of a profile, second set. Spec: `PROFILE_FLAGS2`.
    ///
    /// All are of newer firmware and published by name only; what they do is read from their names.
    pub struct ProfileFlags2: u16 {
        /// PITCH does not follow.
        const FOLLOW_PITCH_DISABLED = 1 << 0;
        /// A low angle of ROLL has priority.
        const LOW_ANGLE_PRIOR_ROLL = 1 << 1;
        /// A low angle of PITCH has priority.
        const LOW_ANGLE_PRIOR_PITCH = 1 << 2;
        /// A low angle of YAW has priority.
        const LOW_ANGLE_PRIOR_YAW = 1 << 3;
        /// Tripod mode for the heading.
        const HEADING_TRIPOD_MODE = 1 << 4;
        /// The motor of ROLL is off.
        const MOT_ROLL_DISABLED = 1 << 5;
        /// The motor of PITCH is off.
        const MOT_PITCH_DISABLED = 1 << 6;
        /// The motor of YAW is off.
        const MOT_YAW_DISABLED = 1 << 7;
        /// Servo output 1 puts out a duty cycle.
        const RC_OUT_DUTY1 = 1 << 8;
        /// Servo output 2 puts out a duty cycle.
        const RC_OUT_DUTY2 = 1 << 9;
        /// Servo output 3 puts out a duty cycle.
        const RC_OUT_DUTY3 = 1 << 10;
        /// Servo output 4 puts out a duty cycle.
        const RC_OUT_DUTY4 = 1 << 11;
        /// Following is off at start.
        const DISABLE_FOLLOW_STARTUP = 1 << 12;
        /// Servo mode is on.
        const SERVO_MODE = 1 << 13;
        /// Each axis has its own dead band and exponential rate of remote control.
        const RC_EXPO_DEADBAND_SPLIT = 1 << 14;
    }
}

flags! {
    /// Settings of a profile, third set. Spec: `PROFILE_FLAGS3`.
    ///
    /// All are of newer firmware and published by name only; what they do is read from their names.
    pub struct ProfileFlags3: u32 {
        /// The limit of acceleration of ROLL sets itself.
        const ACC_LIMIT_AUTO_R = 1 << 0;
        /// The limit of acceleration of PITCH sets itself.
        const ACC_LIMIT_AUTO_P = 1 << 1;
        /// The limit of acceleration of YAW sets itself.
        const ACC_LIMIT_AUTO_Y = 1 << 2;
        /// The shake generator is on.
        const SHAKE_GENERATOR_ENABLED = 1 << 3;
        /// The error of ROLL is corrected by the long way too.
        const ERR_CORR_LONG_R = 1 << 4;
        /// The error of PITCH is corrected by the long way too.
        const ERR_CORR_LONG_P = 1 << 5;
        /// The error of YAW is corrected by the long way too.
        const ERR_CORR_LONG_Y = 1 << 6;
    }
}

flags! {
    /// Options of an external IMU. Spec: `EXT_IMU_FLAGS`. Bit 0 is not listed.
    pub struct ExtImuFlags: u16, prefix "EXT_IMU_FLAG_" {
        /// Only to compensate accelerations.
        const ACC_COMP_ONLY = 1 << 1;
        /// It replaces the board's own IMU.
        const REPLACE = 1 << 2;
        /// It corrects the attitude.
        const Z = 1 << 3;
        /// It corrects the heading.
        const H = 1 << 4;
        /// Its mounting is updated when the frame is upside down.
        const FRAME_UPSIDE_DOWN_UPDATE = 1 << 5;
        /// It is the frame IMU.
        const AS_FRAME_IMU = 1 << 6;
        /// It corrects the gyroscope. Firmware 2.68b7+.
        const GYRO_CORR = 1 << 7;
    }
}
