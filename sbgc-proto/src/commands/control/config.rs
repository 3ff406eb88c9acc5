//! How control commands are handled.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::units::JerkSlope;
use crate::wire::{PerAxis, Reserved, flags};

/// Sets how [`Control`](super::Control) is handled: timeout, priorities of the ports, filters, confirmations.
///
/// A field of 0 leaves that setting as it is, but for the timeout. All of it is forgotten at a restart and when serial
/// control ends. It is confirmed on success.
#[message(CMD_CONTROL_CONFIG, outgoing, size = 41, since = "2.61", answer = Confirm)]
pub struct ControlConfig {
    /// Serial control ends when no control command comes on any port for this long; 0 is no timeout, the default.
    #[wire(unit = "ms")]
    pub timeout_ms: u16,
    /// Priority of UART1.
    ///
    /// All priorities are 0 at the start. A control command is taken only from a port with a priority as high as that
    /// of the others, or higher.
    pub ch1_priority: u8,
    /// Priority of the port of the serial receiver, `RC_SERIAL`.
    pub ch2_priority: u8,
    /// Priority of UART2.
    pub ch3_priority: u8,
    /// Priority of USB; later firmware counts UART3 here too.
    pub ch4_priority: u8,
    /// Priority of the port on which this command comes.
    pub this_ch_priority: u8,
    /// Filters and limits of each axis.
    pub axes: PerAxis<ControlAxisConfig>,
    /// Exponential curve of the signal in the mode `Rc`. The default is that of the settings.
    #[wire(range = 0..=100)]
    pub rc_expo_rate: u8,
    /// What else is to be changed.
    pub flags: ControlConfigFlags,
    /// Order of the Euler angles.
    #[wire(since = "2.72b0")]
    pub euler_order: ControlEulerOrder,
    /// Kept as it came; zero in a new message.
    pub reserved: Reserved<9>,
}

/// Filters and limits of one axis. 0 leaves each as it is.
#[record(size = 7)]
#[derive(Copy)]
pub struct ControlAxisConfig {
    /// Low-pass filter of the angle in the modes `Angle` and `SpeedAngle`. The default is none.
    #[wire(range = 0..=15)]
    pub angle_lpf: u8,
    /// Low-pass filter of the speed in the modes `Speed` and `SpeedAngle`. The default is none.
    #[wire(range = 0..=15)]
    pub speed_lpf: u8,
    /// Low-pass filter of the signal in the mode `Rc`. The default is that of the settings.
    ///
    /// Newer firmware may take values up to 255 and use it in the mode `RcHighRes` too.
    #[wire(range = 0..=15)]
    pub rc_lpf: u8,
    /// Limit of acceleration.
    #[wire(unit = "deg/s^2", since = "2.70b1")]
    pub acc_limit: u16,
    /// Time in which an acceleration builds up.
    #[wire(since = "2.70b8")]
    pub jerk_slope: JerkSlope,
    /// Kept as it came; zero in a new message.
    pub reserved: Reserved<1>,
}

flags! {
    /// What a `CMD_CONTROL_CONFIG` changes besides. Spec: `CONTROL_CONFIG_FLAG`.
    pub struct ControlConfigFlags: u16 {
        /// Control commands are not confirmed. Firmware 2.66b2 and later.
        const NO_CONFIRM "CONTROL_CONFIG_FLAG_NO_CONFIRM" = 1 << 0;
        /// Switches servo mode on. Firmware 2.72b0 and later.
        const SERVO_MODE_ENABLE = 1 << 1;
        /// Switches servo mode off. Firmware 2.72b0 and later.
        const SERVO_MODE_DISABLE = 1 << 2;
        /// The low-pass filters have an extended range. Firmware 2.72b3 and later.
        const LPF_EXT_RANGE = 1 << 3;
        /// The low-pass filters are given as frequencies in Hz. Firmware 2.74.1 and later; in one source only.
        const LPF_FREQUENCY_HZ = 1 << 4;
    }
}

/// The order of the Euler angles for control: that of the parameters plus 1. Spec: `EULER_ORDER`.
///
/// The two-axis orders have the names of newer firmware.
#[open_enum(u8)]
pub enum ControlEulerOrder {
    /// Not changed.
    #[wire(spec = "NO_CHANGE")]
    Unchanged = 0,
    /// Pitch, roll, yaw.
    PitchRollYaw = 1,
    /// Roll, pitch, yaw.
    RollPitchYaw = 2,
    /// Pitch of the motor, roll, yaw of the motor.
    #[wire(spec = "PITCH_M_ROLL_YAW_M")]
    PitchMotorRollYawMotor = 3,
    /// Roll, pitch of the motor, yaw of the motor.
    #[wire(spec = "ROLL_PITCH_M_YAW_M")]
    RollPitchMotorYawMotor = 4,
    /// Yaw, roll, pitch.
    YawRollPitch = 5,
}
