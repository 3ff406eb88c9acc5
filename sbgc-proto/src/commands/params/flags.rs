//! Flag sets in the parameter blocks.

use crate::declare::flags;

flags! {
    /// Settings shared by all profiles, set 1. Spec: `GENERAL_FLAGS1`.
    pub struct GeneralFlags1: u16 {
        /// Activates the last used profile at start-up.
        const REMEMBER_LAST_USED_PROFILE = 1 << 0;
        /// Detects an upside-down frame automatically.
        const UPSIDE_DOWN_AUTO = 1 << 1;
        /// Swaps the main and the frame IMU.
        const SWAP_FRAME_MAIN_IMU = 1 << 2;
        /// Shows the profile number by blinking of the LED.
        const BLINK_PROFILE = 1 << 3;
        /// Stops the motors on severe errors.
        const EMERGENCY_STOP = 1 << 4;
        /// The magnetometer is on the frame.
        const MAGNETOMETER_POS_FRAME = 1 << 5;
        /// Uses the frame IMU for feed-forward control.
        const FRAME_IMU_FF = 1 << 6;
        /// Stops the motors on overheating.
        const OVERHEAT_STOP_MOTORS = 1 << 7;
        /// Centers YAW at start-up.
        const CENTER_YAW_AT_STARTUP = 1 << 8;
        /// Swaps the ports RC_SERIAL and UART B.
        const SWAP_RC_SERIAL_UART_B = 1 << 9;
        /// Enables this protocol on UART B.
        const UART_B_SERIAL_API = 1 << 10;
        /// Shows the battery level by blinking of the LED.
        const BLINK_BAT_LEVEL = 1 << 11;
        /// Adapts the trust in the gyroscope automatically.
        const ADAPTIVE_GYRO_TRUST = 1 << 12;
        /// The frame is upside down. Firmware 2.66+.
        const IS_UPSIDE_DOWN = 1 << 13;
        /// Enables this protocol on UART 3. Newer firmware.
        const UART_3_SERIAL_API = 1 << 14;
        /// Inverts RC control if the frame is upside down. Newer firmware.
        const FRAME_INV_RC_INV = 1 << 15;
    }
}

flags! {
    /// Settings of one profile, set 1. Spec: `PROFILE_FLAGS1`.
    ///
    /// The meaning of bit 3 is not published.
    pub struct ProfileFlags1: u16 {
        /// Detects automatically whether analog input 1 is connected.
        const ADC1_AUTO_DETECTION = 1 << 0;
        /// Detects automatically whether analog input 2 is connected.
        const ADC2_AUTO_DETECTION = 1 << 1;
        /// Detects automatically whether analog input 3 is connected.
        const ADC3_AUTO_DETECTION = 1 << 2;
        /// Uses the frame IMU for follow mode.
        const FOLLOW_USE_FRAME_IMU = 1 << 4;
        /// Detects the briefcase position automatically.
        const BRIEFCASE_AUTO_DETECTION = 1 << 5;
        /// Rotates the camera automatically if the frame is upside down.
        const UPSIDE_DOWN_AUTO_ROTATE = 1 << 6;
        /// Corrects the offset of follow mode while it is locked.
        const FOLLOW_LOCK_OFFSET_CORRECTION = 1 << 7;
        /// Moves to the neutral position at start-up.
        const START_NEUTRAL_POSITION = 1 << 8;
        /// Turns follow mode off while the menu button is held.
        const MENU_BUTTON_DISABLE_FOLLOW = 1 << 9;
        /// The frame is fixed during a time lapse.
        const TIMELAPSE_FRAME_FIXED = 1 << 10;
        /// Keeps the mixing rate of RC control.
        const RC_KEEP_MIX_RATE = 1 << 11;
        /// Keeps the current position when RC control is initialized.
        const RC_KEEP_CUR_POS_ON_INIT = 1 << 12;
        /// Allows unlimited rotation of the outer motor. Firmware 2.66+.
        const OUTER_MOTOR_LIMIT_FREE_ROTATION = 1 << 13;
        /// Selects the order of Euler angles automatically. Firmware 2.67b1+.
        ///
        /// A newer list calls this bit `GIMBAL_LOCK_SMOOTH_TRANSITION`; it may have been renamed.
        const EULER_ORDER_AUTO = 1 << 14;
        /// Operates the camera upside down. Newer firmware.
        const CAM_UPSIDE_DOWN_WORKING = 1 << 15;
    }
}

flags! {
    /// Enabled filters of an axis. Spec: `FILTERS_EN`.
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
    /// Settings shared by all profiles, set 2. Spec: `GENERAL_FLAGS2`.
    pub struct GeneralFlags2: u16 {
        /// Searches for the limit of ROLL at start-up.
        const SEARCH_LIMIT_ROLL = 1 << 0;
        /// Searches for the limit of PITCH at start-up.
        const SEARCH_LIMIT_PITCH = 1 << 1;
        /// Searches for the limit of YAW at start-up.
        const SEARCH_LIMIT_YAW = 1 << 2;
        /// Calibrates the moments of inertia at start-up. Firmware 2.62b7+.
        const AUTO_CALIBRATE_MOMENTUM = 1 << 3;
        /// Uses the moments of inertia for feed-forward control. Firmware 2.62b7+.
        const USE_MOMENTUM_FEED_FORWARD = 1 << 4;
        /// Leaves the motors off at start-up. Firmware 2.62b7+.
        const MOTORS_OFF_AT_STARTUP = 1 << 5;
        /// The flight controller is below the outer motor or, with `FC_BELOW_MIDDLE`, on the camera platform. Firmware
        /// 2.62b7+.
        const FC_BELOW_OUTER = 1 << 6;
        /// Disables the check of encoder limits. Firmware 2.66+.
        const DO_NOT_CHECK_ENCODER_LIMITS = 1 << 7;
        /// Saves the backup profile set automatically. Firmware 2.66+.
        const AUTO_SAVE_BACKUP_SLOT = 1 << 8;
        /// The flight controller is below the middle motor or, with `FC_BELOW_OUTER`, on the camera platform. Firmware
        /// 2.66+.
        const FC_BELOW_MIDDLE = 1 << 9;
        /// The ambient temperature is unknown. Firmware 2.67b2+.
        const ENVIRONMENT_TEMP_UNKNOWN = 1 << 10;
        /// Extends the range of the low-pass filters of RC control and follow mode from 0–15 to 0–255. Newer firmware.
        const LPF_EXTENDED_RANGE = 1 << 11;
        /// Saves system statistics. Newer firmware.
        const SAVE_SYSTEM_STAT = 1 << 12;
        /// Disables the accelerometer. Newer firmware.
        const DISABLE_ACC = 1 << 13;
        /// Disables power management. Newer firmware.
        const DISABLE_POWER_MANAGER = 1 << 14;
        /// Allows the on-board IMU to be used as the main IMU. Newer firmware; formerly `ALLOW_FRAME_IMU_AS_MAIN`.
        const ALLOW_ONBOARD_IMU_AS_MAIN = 1 << 15;
    }
}

flags! {
    /// Soft limits that make up the parking position. Spec: `PARKING_POS_CFG`.
    pub struct ParkingPosition: u8 {
        /// Negative limit of ROLL.
        const ROLL_NEGATIVE = 1 << 0;
        /// Positive limit of ROLL.
        const ROLL_POSITIVE = 1 << 1;
        /// Negative limit of PITCH.
        const PITCH_NEGATIVE = 1 << 2;
        /// Positive limit of PITCH.
        const PITCH_POSITIVE = 1 << 3;
        /// Negative limit of YAW.
        const YAW_NEGATIVE = 1 << 4;
        /// Positive limit of YAW.
        const YAW_POSITIVE = 1 << 5;
    }
}

flags! {
    /// Options of automatic PID tuning. Spec: `AUTO_PID_CFG`.
    ///
    /// The specification lists bits 0, 1 and 3 only; the others are those of newer documents.
    pub struct AutoPidFlags: u8, prefix "AUTO_PID_CFG_" {
        /// Tunes ROLL.
        const ROLL = 1 << 0;
        /// Tunes PITCH.
        const PITCH = 1 << 1;
        /// Tunes YAW.
        const YAW = 1 << 2;
        /// Reports the progress.
        const SEND_GUI = 1 << 3;
        /// Starts from the current values.
        const KEEP_CURRENT = 1 << 4;
        /// Tunes the low-pass filters, too.
        const TUNE_LPF_FREQ = 1 << 5;
        /// Saves the result to all profiles.
        const ALL_PROFILES = 1 << 6;
    }
}

flags! {
    /// Settings shared by all profiles, set 3. Spec: `GENERAL_FLAGS3`.
    ///
    /// Newer firmware. Only the names are published; the descriptions are inferred from them.
    pub struct GeneralFlags3: u32 {
        /// Enables the lookup table of the ROLL encoder.
        const ENC_LUT_EN_ROLL = 1 << 0;
        /// Enables the lookup table of the PITCH encoder.
        const ENC_LUT_EN_PITCH = 1 << 1;
        /// Enables the lookup table of the YAW encoder.
        const ENC_LUT_EN_YAW = 1 << 2;
        /// Interprets YAW in MAVLink commands as absolute.
        const MAVLINK_YAW_ABSOLUTE = 1 << 3;
        /// Uses the external sensor as the reference.
        const EXT_SENS_AS_REFERENCE = 1 << 4;
        /// Disables Bluetooth.
        const DISABLE_BT = 1 << 5;
        /// Allows recovery of a lost sensor.
        const ALLOW_SENSOR_RECOVERY = 1 << 6;
        /// Uses the alternative pins of UART2.
        const UART2_ALT = 1 << 7;
        /// Allows ROLL to pass its soft limits.
        const PASS_LIMIT_ROLL = 1 << 8;
        /// Allows PITCH to pass its soft limits.
        const PASS_LIMIT_PITCH = 1 << 9;
        /// Allows YAW to pass its soft limits.
        const PASS_LIMIT_YAW = 1 << 10;
        /// Does not push ROLL against its soft limits.
        const DONT_PUSH_SOFT_LIMITS_ROLL = 1 << 11;
        /// Does not push PITCH against its soft limits.
        const DONT_PUSH_SOFT_LIMITS_PITCH = 1 << 12;
        /// Does not push YAW against its soft limits.
        const DONT_PUSH_SOFT_LIMITS_YAW = 1 << 13;
        /// Turns tripod mode on automatically.
        const TRIPOD_MODE_AUTO = 1 << 14;
        /// Calibrates the gyroscope continuously in tripod mode.
        const TRIPOD_MODE_GYRO_ONLINE_CALIB = 1 << 15;
        /// Turns the motors off in the retracted position.
        const RETRACTED_POSITION_MOTORS_OFF = 1 << 16;
        /// Enables the thermostat of the CAN IMU.
        const CAN_IMU_THERMOSTAT_ENABLE = 1 << 17;
        /// Moves to the retracted position by the shortest way.
        const RETRACTED_POSITION_SHORTEST = 1 << 18;
        /// Allows RC control to leave the retracted position.
        const RETRACTED_POSITION_RC_CONTROL = 1 << 19;
        /// Extends the range of acceleration limits.
        const ACC_LIMIT_EXT_RANGE = 1 << 20;
        /// Moves ROLL by the shortest way.
        const MOVE_SHORT_PATH_ROLL = 1 << 21;
        /// Moves PITCH by the shortest way.
        const MOVE_SHORT_PATH_PITCH = 1 << 22;
        /// Moves YAW by the shortest way.
        const MOVE_SHORT_PATH_YAW = 1 << 23;
        /// Adapts the soft limits of the middle motor to an inverted frame.
        const FRAME_INV_SOFT_LIMIT_MIDDLE = 1 << 24;
        /// Adapts the soft limits of the outer motor to an inverted frame.
        const FRAME_INV_SOFT_LIMIT_OUTER = 1 << 25;
        /// Outputs a duty cycle on servo output 1 of the CAN IMU.
        const CAN_IMU_SERVO1_DUTY_MODE = 1 << 26;
        /// Outputs a duty cycle on servo output 2 of the CAN IMU.
        const CAN_IMU_SERVO2_DUTY_MODE = 1 << 27;
    }
}

flags! {
    /// Settings shared by all profiles, set 4. Spec: `GENERAL_FLAGS4`.
    ///
    /// Newer firmware. Only the names are published; the descriptions are inferred from them.
    pub struct GeneralFlags4: u32 {
        /// Limits acceleration according to the moment of inertia.
        const ACC_LIMIT_BY_MOMENTUM = 1 << 0;
        /// Calibrates the moments of inertia in the normal position.
        const CALIB_MOMENTUM_IN_NORMAL_POS = 1 << 1;
        /// First bit of `EULER_INVERSE_INIT_MASK`: initializes Euler angles by the middle axis.
        const EULER_MIDDLE_AXIS = 1 << 2;
        /// Second bit of `EULER_INVERSE_INIT_MASK`: initializes Euler angles to match the rotation of the motors.
        const EULER_MATCH_MOTOR_ROTATION = 1 << 3;
    }
}

flags! {
    /// Settings of one profile, set 2. Spec: `PROFILE_FLAGS2`.
    ///
    /// Newer firmware. Only the names are published; the descriptions are inferred from them.
    pub struct ProfileFlags2: u16 {
        /// Disables follow mode on PITCH.
        const FOLLOW_PITCH_DISABLED = 1 << 0;
        /// Prefers low angles of ROLL.
        const LOW_ANGLE_PRIOR_ROLL = 1 << 1;
        /// Prefers low angles of PITCH.
        const LOW_ANGLE_PRIOR_PITCH = 1 << 2;
        /// Prefers low angles of YAW.
        const LOW_ANGLE_PRIOR_YAW = 1 << 3;
        /// Enables tripod mode for the heading.
        const HEADING_TRIPOD_MODE = 1 << 4;
        /// Disables the ROLL motor.
        const MOT_ROLL_DISABLED = 1 << 5;
        /// Disables the PITCH motor.
        const MOT_PITCH_DISABLED = 1 << 6;
        /// Disables the YAW motor.
        const MOT_YAW_DISABLED = 1 << 7;
        /// Outputs a duty cycle on servo output 1.
        const RC_OUT_DUTY1 = 1 << 8;
        /// Outputs a duty cycle on servo output 2.
        const RC_OUT_DUTY2 = 1 << 9;
        /// Outputs a duty cycle on servo output 3.
        const RC_OUT_DUTY3 = 1 << 10;
        /// Outputs a duty cycle on servo output 4.
        const RC_OUT_DUTY4 = 1 << 11;
        /// Turns follow mode off at start-up.
        const DISABLE_FOLLOW_STARTUP = 1 << 12;
        /// Enables servo mode.
        const SERVO_MODE = 1 << 13;
        /// Uses a separate dead band and exponential curve of RC control for each axis.
        const RC_EXPO_DEADBAND_SPLIT = 1 << 14;
    }
}

flags! {
    /// Settings of one profile, set 3. Spec: `PROFILE_FLAGS3`.
    ///
    /// Newer firmware. Only the names are published; the descriptions are inferred from them.
    pub struct ProfileFlags3: u32 {
        /// Sets the acceleration limit of ROLL automatically.
        const ACC_LIMIT_AUTO_R = 1 << 0;
        /// Sets the acceleration limit of PITCH automatically.
        const ACC_LIMIT_AUTO_P = 1 << 1;
        /// Sets the acceleration limit of YAW automatically.
        const ACC_LIMIT_AUTO_Y = 1 << 2;
        /// Enables the shake generator.
        const SHAKE_GENERATOR_ENABLED = 1 << 3;
        /// Corrects errors of ROLL by the long way, too.
        const ERR_CORR_LONG_R = 1 << 4;
        /// Corrects errors of PITCH by the long way, too.
        const ERR_CORR_LONG_P = 1 << 5;
        /// Corrects errors of YAW by the long way, too.
        const ERR_CORR_LONG_Y = 1 << 6;
    }
}

flags! {
    /// Options of an external IMU. Spec: `EXT_IMU_FLAGS`.
    ///
    /// Bit 0 is not published.
    pub struct ExtImuFlags: u16, prefix "EXT_IMU_FLAG_" {
        /// Compensates for accelerations only.
        const ACC_COMP_ONLY = 1 << 1;
        /// Replaces the internal IMU.
        const REPLACE = 1 << 2;
        /// Corrects the attitude.
        const Z = 1 << 3;
        /// Corrects the heading.
        const H = 1 << 4;
        /// Updates the mounting orientation if the frame is upside down.
        const FRAME_UPSIDE_DOWN_UPDATE = 1 << 5;
        /// Serves as the frame IMU.
        const AS_FRAME_IMU = 1 << 6;
        /// Corrects the gyroscope. Firmware 2.68b7+.
        const GYRO_CORR = 1 << 7;
    }
}
