//! Types of the hardware settings: motor outputs, ports, buses and buzzer.

use crate::declare::flags;
use sbgc_proto_macros::open_enum;

/// Switching frequency of the motor drivers. Spec: `PWM_FREQ`.
#[open_enum(u8, prefix = "PWM_FREQ_")]
pub enum PwmFrequency {
    /// Low frequency: audible, minimum losses.
    Low = 0,
    /// High frequency: barely audible.
    High = 1,
    /// Ultrasonic frequency: maximum losses.
    UltraHigh = 2,
}

/// Motor output of an axis. Spec: `MOTOR_OUTPUT`.
#[open_enum(u8)]
pub enum MotorOutput {
    /// None; the axis has no motor.
    Disabled = 0,
    /// Motor output ROLL of the board.
    Roll = 1,
    /// Motor output PITCH of the board.
    Pitch = 2,
    /// Motor output YAW of the board.
    Yaw = 3,
    /// External driver 1 on the I2C bus.
    #[wire(spec = "I2C_DRV1")]
    I2cDriver1 = 4,
    /// External driver 2 on the I2C bus.
    #[wire(spec = "I2C_DRV2")]
    I2cDriver2 = 5,
    /// External driver 3 on the I2C bus.
    #[wire(spec = "I2C_DRV3")]
    I2cDriver3 = 6,
    /// External driver 4 on the I2C bus.
    #[wire(spec = "I2C_DRV4")]
    I2cDriver4 = 7,
}

/// Baud rate of a serial port. Spec: `SERIAL_SPEED`.
#[open_enum(u8)]
pub enum SerialSpeed {
    /// 115200 bits per second.
    #[wire(spec = "115200")]
    Baud115200 = 0,
    /// 57600 bits per second.
    #[wire(spec = "57600")]
    Baud57600 = 1,
    /// 38400 bits per second.
    #[wire(spec = "38400")]
    Baud38400 = 2,
    /// 19200 bits per second.
    #[wire(spec = "19200")]
    Baud19200 = 3,
    /// 9600 bits per second.
    #[wire(spec = "9600")]
    Baud9600 = 4,
    /// 256000 bits per second.
    #[wire(spec = "256000")]
    Baud256000 = 5,
}

impl SerialSpeed {
    /// Baud rate in bits per second; `None` for an unknown value.
    ///
    /// ```
    /// use sbgc_proto::commands::SerialSpeed;
    ///
    /// assert_eq!(SerialSpeed::default().bits_per_second(), Some(115_200));
    /// ```
    pub const fn bits_per_second(self) -> Option<u32> {
        match self {
            Self::Baud115200 => Some(115_200),
            Self::Baud57600 => Some(57_600),
            Self::Baud38400 => Some(38_400),
            Self::Baud19200 => Some(19_200),
            Self::Baud9600 => Some(9_600),
            Self::Baud256000 => Some(256_000),
            Self::Unknown(_) => None,
        }
    }
}

/// Clock speed of the sensor bus. Spec: `I2C_SPEED_FAST`.
#[open_enum(u8)]
pub enum I2cSpeed {
    /// 400 kHz, for long cables.
    #[wire(spec = "I2C_400KHZ")]
    Khz400 = 0,
    /// 800 kHz.
    #[wire(spec = "I2C_800KHZ")]
    Khz800 = 1,
}

/// Calibration of the gyroscope at start-up. Spec: `SKIP_GYRO_CALIB`.
#[open_enum(u8, prefix = "SKIP_")]
pub enum SkipGyroCalib {
    /// Never skipped: the board waits until it is at rest.
    #[wire(spec = "DO_NOT_SKIP")]
    Never = 0,
    /// Always skipped.
    Always = 1,
    /// Skipped if the board moves.
    #[wire(spec = "TRY_TO_CALIBRATE")]
    InMotion = 2,
}

flags! {
    /// Axes on which the controller reduces its gains automatically when they vibrate. Spec: `ADAPTIVE_PID_ENABLED`.
    pub struct AdaptivePidAxes: u8, prefix "EN_" {
        /// ROLL.
        const ROLL = 1 << 0;
        /// PITCH.
        const PITCH = 1 << 1;
        /// YAW.
        const YAW = 1 << 2;
    }
}

flags! {
    /// Occasions on which the board beeps. Spec: `BEEPER_MODES`.
    ///
    /// Bits 4 to 6 are published in the vendor's library only. Newer firmware.
    pub struct BeeperModes: u8, prefix "BEEPER_MODE_" {
        /// Beeps during calibrations.
        const CALIBRATE = 1 << 0;
        /// Beeps when a command is executed.
        const CONFIRM = 1 << 1;
        /// Beeps on errors.
        const ERROR = 1 << 2;
        /// Beeps when the battery is low.
        const ALARM = 1 << 3;
        /// Beeps on each button press.
        const CLICK = 1 << 4;
        /// Beeps when a task is complete.
        const COMPLETE = 1 << 5;
        /// Beeps at start-up.
        const INTRO = 1 << 6;
        /// Uses the motors instead of the buzzer.
        const BY_MOTORS "BEEP_BY_MOTORS" = 1 << 7;
    }
}
