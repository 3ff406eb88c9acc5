//! Values of the board's hardware: motor outputs, ports, buses, the beeper.

use crate::declare::flags;
use sbgc_proto_macros::open_enum;

/// Switching frequency of the motor drivers. Spec: `PWM_FREQ`.
#[open_enum(u8, prefix = "PWM_FREQ_")]
pub enum PwmFrequency {
    /// Low: audible, minimum losses.
    Low = 0,
    /// High: hardly audible.
    High = 1,
    /// Ultrasonic, maximum losses.
    UltraHigh = 2,
}

/// Motor output of an axis. Spec: `MOTOR_OUTPUT`.
#[open_enum(u8)]
pub enum MotorOutput {
    /// None: the axis has no motor.
    Disabled = 0,
    /// The board's own output for ROLL.
    Roll = 1,
    /// The board's own output for PITCH.
    Pitch = 2,
    /// The board's own output for YAW.
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

/// Speed of a serial port. Spec: `SERIAL_SPEED`.
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
    /// Bits per second; `None` for an unknown speed.
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

/// Speed of the bus to the sensors. Spec: `I2C_SPEED_FAST`.
#[open_enum(u8)]
pub enum I2cSpeed {
    /// 400 kHz, for long cables.
    #[wire(spec = "I2C_400KHZ")]
    Khz400 = 0,
    /// 800 kHz.
    #[wire(spec = "I2C_800KHZ")]
    Khz800 = 1,
}

/// Whether the gyroscope is calibrated at start. Spec: `SKIP_GYRO_CALIB`.
#[open_enum(u8, prefix = "SKIP_")]
pub enum SkipGyroCalib {
    /// Always calibrated: the board waits until it is at rest.
    #[wire(spec = "DO_NOT_SKIP")]
    Never = 0,
    /// Never calibrated.
    Always = 1,
    /// Calibrated if the board is at rest, left as it was if it moves.
    #[wire(spec = "TRY_TO_CALIBRATE")]
    InMotion = 2,
}

flags! {
    /// Axes whose controller lowers its gains by itself when they vibrate. Spec: `ADAPTIVE_PID_ENABLED`.
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
    /// When the board beeps, and how. Spec: `BEEPER_MODES`.
    ///
    /// Bits 4 to 6 are those of the vendor's library, newer firmware.
    pub struct BeeperModes: u8, prefix "BEEPER_MODE_" {
        /// While it calibrates.
        const CALIBRATE = 1 << 0;
        /// When a command is carried out.
        const CONFIRM = 1 << 1;
        /// At an error.
        const ERROR = 1 << 2;
        /// When the battery is low.
        const ALARM = 1 << 3;
        /// At each press of a button.
        const CLICK = 1 << 4;
        /// When a task is complete.
        const COMPLETE = 1 << 5;
        /// At start.
        const INTRO = 1 << 6;
        /// The motors sound instead of the buzzer.
        const BY_MOTORS "BEEP_BY_MOTORS" = 1 << 7;
    }
}
