//! How control commands are handled.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{Confirm, EulerOrder};
use crate::declare::flags;
use crate::units::JerkSlope;
use crate::wire::{PerAxis, Reserved};

/// Sets how [`Control`](super::Control) is handled: timeout, priorities of the ports, filters, confirmations.
///
/// A field of 0 leaves that setting unchanged, but disables the timeout. Nothing is stored: a restart and
/// the end of serial control, as by [`Control::release`](super::Control::release), bring the defaults back. The board
/// confirms the command when it has taken the settings.
#[message(CMD_CONTROL_CONFIG, outgoing, size = 41, since = "2.61", answer = Confirm)]
pub struct ControlConfig {
    /// Serial control ends when no control command comes on any port for this long.
    ///
    /// 0, the default after a start, disables it. With a timeout, repeat the command even when nothing changes.
    #[wire(unit = "ms")]
    pub timeout_ms: u16,
    /// Priority of UART1; 0 leaves it unchanged.
    ///
    /// After a start all priorities are 0 and every port may control. From then on a control command is taken only from
    /// a port whose priority is at least as high as that of all others.
    pub ch1_priority: u8,
    /// Priority of the port of the serial receiver, `RC_SERIAL`; 0 leaves it unchanged.
    pub ch2_priority: u8,
    /// Priority of UART2; 0 leaves it unchanged.
    pub ch3_priority: u8,
    /// Priority of USB, in later firmware also of UART3; 0 leaves it unchanged.
    pub ch4_priority: u8,
    /// Priority of the receiving port; 0 leaves it unchanged.
    pub this_ch_priority: u8,
    /// Filters and limits of each axis.
    #[wire(group)]
    pub axes: PerAxis<ControlAxisConfig>,
    /// Exponential curve of the signal around neutral in mode `Rc`; 0 is linear.
    ///
    /// The default is that of the parameters.
    #[wire(range = 0..=100)]
    pub rc_expo_rate: u8,
    /// Confirmations, servo mode, and how the filters above are meant.
    pub flags: ControlConfigFlags,
    /// Order of the Euler angles in which angles are given.
    #[wire(since = "2.72b0")]
    pub euler_order: ControlEulerOrder,
    pub reserved: Reserved<9>,
}

/// Filters and limits of one axis; 0 leaves each unchanged.
///
/// The filters smooth commands that come at a low rate.
#[record(size = 7)]
#[derive(Copy)]
pub struct ControlAxisConfig {
    /// Low-pass filter of the angle in the modes `Angle` and `SpeedAngle`. The default is none.
    #[wire(range = 0..=15)]
    pub angle_lpf: u8,
    /// Low-pass filter of the speed in the modes `Speed` and `SpeedAngle`. The default is none.
    #[wire(range = 0..=15)]
    pub speed_lpf: u8,
    /// Low-pass filter of the signal in the mode `Rc`. The default is that of the parameters.
    ///
    /// The vendor's library allows values up to 255, and has it act in the mode `RcHighRes` too.
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
    /// Further options of `CMD_CONTROL_CONFIG`. Spec: `CONTROL_CONFIG_FLAG`.
    pub struct ControlConfigFlags: u16 {
        /// Control commands are no longer confirmed. Firmware 2.66b2+.
        const NO_CONFIRM "CONTROL_CONFIG_FLAG_NO_CONFIRM" = 1 << 0;
        /// Switches servo mode on. Firmware 2.72b0+.
        const SERVO_MODE_ENABLE = 1 << 1;
        /// Switches servo mode off. Firmware 2.72b0+.
        const SERVO_MODE_DISABLE = 1 << 2;
        /// The low-pass filters have an extended range. Firmware 2.72b3+.
        const LPF_EXT_RANGE = 1 << 3;
        /// The low-pass filters are given as frequencies in Hz. Firmware 2.74.1+; published in
        /// the vendor's Python library only.
        const LPF_FREQUENCY_HZ = 1 << 4;
    }
}

/// The order of the Euler angles for control: that of the parameters plus 1. Spec: `EULER_ORDER`.
///
/// [`EulerOrder`] is that of the parameters, and becomes this one by `from`.
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

impl ControlEulerOrder {
    /// The order, `None` where it is not changed.
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
