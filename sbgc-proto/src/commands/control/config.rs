//! Configuration of control commands.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{Confirm, EulerOrder};
use crate::declare::flags;
use crate::units::JerkSlope;
use crate::wire::{PerAxis, Reserved};

/// Configures the handling of [`Control`](super::Control): timeout, port priorities, filters and confirmations.
///
/// A value of 0 leaves a setting unchanged, except that it disables the timeout. Nothing is stored: a restart or the
/// end of serial control, such as by [`Control::release`](super::Control::release), restores the defaults. The board
/// confirms the command when it has applied the settings.
#[message(CMD_CONTROL_CONFIG, outgoing, size = 41, since = "2.61", answer = Confirm)]
pub struct ControlConfig {
    /// Timeout after which serial control ends if no control command is received on any port.
    ///
    /// 0, the default after a start, disables the timeout. With a timeout set, repeat the command even if nothing
    /// changes.
    #[wire(unit = "ms")]
    pub timeout_ms: u16,
    /// Priority of UART1; 0 leaves it unchanged.
    ///
    /// After a start, all priorities are 0 and every port may control. Control commands are accepted only from a port
    /// whose priority is at least as high as that of all others.
    pub ch1_priority: u8,
    /// Priority of the port of the serial receiver, `RC_SERIAL`; 0 leaves it unchanged.
    pub ch2_priority: u8,
    /// Priority of UART2; 0 leaves it unchanged.
    pub ch3_priority: u8,
    /// Priority of USB and, in later firmware, UART3; 0 leaves it unchanged.
    pub ch4_priority: u8,
    /// Priority of the port that receives the command; 0 leaves it unchanged.
    pub this_ch_priority: u8,
    /// Filters and limits of each axis.
    #[wire(group)]
    pub axes: PerAxis<ControlAxisConfig>,
    /// Exponential curve of the signal in the mode `Rc`; 0 is linear.
    ///
    /// The default is the value of the parameters.
    #[wire(range = 0..=100)]
    pub rc_expo_rate: u8,
    /// Options: confirmations, servo mode and interpretation of the filters.
    pub flags: ControlConfigFlags,
    /// Order of Euler angles for the angles of control commands.
    #[wire(since = "2.72b0")]
    pub euler_order: ControlEulerOrder,
    pub reserved: Reserved<9>,
}

/// Filters and limits of one axis; 0 leaves each unchanged.
///
/// The filters smooth commands that are sent at a low rate.
#[record(size = 7)]
#[derive(Copy)]
pub struct ControlAxisConfig {
    /// Low-pass filter of the angle in the modes `Angle` and `SpeedAngle`. Off by default.
    #[wire(range = 0..=15)]
    pub angle_lpf: u8,
    /// Low-pass filter of the speed in the modes `Speed` and `SpeedAngle`. Off by default.
    #[wire(range = 0..=15)]
    pub speed_lpf: u8,
    /// Low-pass filter of the signal in the mode `Rc`. The default is the value of the parameters.
    ///
    /// The vendor's library allows values up to 255 and applies the filter in the mode `RcHighRes`, too.
    #[wire(range = 0..=15)]
    pub rc_lpf: u8,
    /// Acceleration limit; 0 leaves it unchanged.
    #[wire(unit = "deg/s^2", since = "2.70b1")]
    pub acc_limit: u16,
    /// Jerk slope: time in which an acceleration builds up; 0 leaves it unchanged, 1 disables it.
    #[wire(since = "2.70b8")]
    pub jerk_slope: JerkSlope,
    pub reserved: Reserved<1>,
}

flags! {
    /// Options of `CMD_CONTROL_CONFIG`. Spec: `CONTROL_CONFIG_FLAG`.
    pub struct ControlConfigFlags: u16 {
        /// Disables confirmations of control commands. Firmware 2.66b2+.
        const NO_CONFIRM "CONTROL_CONFIG_FLAG_NO_CONFIRM" = 1 << 0;
        /// Turns servo mode on. Firmware 2.72b0+.
        const SERVO_MODE_ENABLE = 1 << 1;
        /// Turns servo mode off. Firmware 2.72b0+.
        const SERVO_MODE_DISABLE = 1 << 2;
        /// The low-pass filters have an extended range. Firmware 2.72b3+.
        const LPF_EXT_RANGE = 1 << 3;
        /// The low-pass filters are given as frequencies in Hz. Firmware 2.74.1+; published in the vendor's Python
        /// library only.
        const LPF_FREQUENCY_HZ = 1 << 4;
    }
}

/// Order of Euler angles in control commands: the value used in the parameters plus 1. Spec: `EULER_ORDER`.
///
/// Convert from [`EulerOrder`], the type used in the parameters, with `from`.
#[open_enum(u8)]
pub enum ControlEulerOrder {
    /// Leaves the order unchanged.
    #[wire(spec = "NO_CHANGE")]
    Unchanged = 0,
    /// Pitch, roll, yaw.
    PitchRollYaw = 1,
    /// Roll, pitch, yaw.
    RollPitchYaw = 2,
    /// Pitch motor, roll, yaw motor.
    #[wire(spec = "PITCH_M_ROLL_YAW_M")]
    PitchMotorRollYawMotor = 3,
    /// Roll, pitch motor, yaw motor.
    #[wire(spec = "ROLL_PITCH_M_YAW_M")]
    RollPitchMotorYawMotor = 4,
    /// Yaw, roll, pitch.
    YawRollPitch = 5,
}

impl ControlEulerOrder {
    /// Order in the numbering of the parameters; `None` if it is unchanged.
    ///
    /// ```
    /// use sbgc_proto::commands::{ControlEulerOrder, EulerOrder};
    ///
    /// assert_eq!(ControlEulerOrder::YawRollPitch.order(), Some(EulerOrder::YawRollPitch));
    /// assert_eq!(ControlEulerOrder::from(EulerOrder::PitchRollYaw), ControlEulerOrder::PitchRollYaw);
    /// ```
    pub fn order(self) -> Option<EulerOrder> {
        self.raw().checked_sub(1).map(EulerOrder::from_raw)
    }
}

impl From<EulerOrder> for ControlEulerOrder {
    fn from(order: EulerOrder) -> Self {
        // Orders have four bits.
        Self::from_raw(order.raw().saturating_add(1))
    }
}
