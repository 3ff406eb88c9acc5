//! The sets of flags in the blocks of parameters.

use crate::wire::flags;

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
        /// The frame is upside down. Firmware 2.66 and later.
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
    /// No source lists bit 3.
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
        /// The outer motor may turn without end. Firmware 2.66 and later.
        const OUTER_MOTOR_LIMIT_FREE_ROTATION = 1 << 13;
        /// The order of Euler angles is chosen by itself. Firmware 2.67b1 and later.
        ///
        /// One newer source calls this bit `GIMBAL_LOCK_SMOOTH_TRANSITION`; perhaps it was renamed.
        const EULER_ORDER_AUTO = 1 << 14;
        /// The camera works upside down. Newer firmware, in one source only.
        const CAM_UPSIDE_DOWN_WORKING = 1 << 15;
    }
}

flags! {
    /// The filters of an axis that are in use. Spec: `FILTERS_EN`.
    pub struct FiltersEnabled: u8 {
        /// First notch filter.
        const NOTCH1 "EN_NOTCH1" = 1 << 0;
        /// Second notch filter.
        const NOTCH2 "EN_NOTCH2" = 1 << 1;
        /// Third notch filter.
        const NOTCH3 "EN_NOTCH3" = 1 << 2;
        /// Low-pass filter.
        const LPF "EN_LPF" = 1 << 3;
    }
}
