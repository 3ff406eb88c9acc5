//! Motion control by axis that sends selected axes and values only.

use sbgc_proto_macros::{message, record};

use super::ControlMode;
use crate::commands::Confirm;
use crate::declare::flags;
use crate::units::{Angle, ControlRate, FineRate};
use crate::wire::PerAxis;

/// Moves the gimbal, sending selected axes and values only.
///
/// Confirmed like [`Control`](super::Control), whose rules for modes, speeds and angles apply here, too.
///
/// Sources disagree on how 4-byte values are selected. Here, as in the vendor's libraries, their bit replaces that of
/// the 2-byte value, and an axis is present if any of its five bits is set. A third-party library sets the 2-byte bit
/// as well; its other bit then widens the value. With 2-byte values only, all sources agree.
///
/// ```
/// use sbgc_proto::Message;
/// use sbgc_proto::commands::{ControlExt, ControlExtAxis, ControlMode};
/// use sbgc_proto::units::Angle;
/// use sbgc_proto::wire::PerAxis;
///
/// let yaw = ControlExtAxis {
///     control_mode: ControlMode::ANGLE,
///     angle: Some(Angle::from_degrees(45.0)),
///     ..ControlExtAxis::default()
/// };
/// let control = ControlExt::new(PerAxis { yaw: Some(yaw), ..PerAxis::default() });
/// assert_eq!(control.encode(&mut [0; 32])?, [0, 8, 2, 0, 0, 8]);
/// # Ok::<(), sbgc_proto::EncodeError>(())
/// ```
#[message(CMD_CONTROL_EXT, outgoing, size = 2..=32, since = "2.68", answer = Confirm)]
#[derive(Copy)]
pub struct ControlExt {
    /// Flags that select the values of each axis.
    pub data_set: ControlExtDataSet,
    /// Set-point of the ROLL axis.
    #[wire(group, when = !data_set.axes().roll.is_empty(), context = data_set.axes().roll)]
    pub roll: Option<ControlExtAxis>,
    /// Set-point of the PITCH axis.
    #[wire(group, when = !data_set.axes().pitch.is_empty(), context = data_set.axes().pitch)]
    pub pitch: Option<ControlExtAxis>,
    /// Set-point of the YAW axis.
    #[wire(group, when = !data_set.axes().yaw.is_empty(), context = data_set.axes().yaw)]
    pub yaw: Option<ControlExtAxis>,
}

impl ControlExt {
    /// Creates a command for these axes; the selection of values follows from those that are present.
    ///
    /// An axis without speed and angle is omitted, because it cannot be sent.
    pub fn new(axes: PerAxis<Option<ControlExtAxis>>) -> Self {
        let sets = axes.map(|axis| axis.map(|axis| axis.data_set()).unwrap_or_default());
        let sent = |axis: Option<ControlExtAxis>| axis.filter(|axis| !axis.data_set().is_empty());
        Self {
            data_set: ControlExtDataSet::of_axes(sets),
            roll: sent(axes.roll),
            pitch: sent(axes.pitch),
            yaw: sent(axes.yaw),
        }
    }
}

/// Set-point of one axis.
#[record(context(set: ControlExtAxisSet))]
#[derive(Copy)]
pub struct ControlExtAxis {
    /// Control mode of the axis.
    pub control_mode: ControlMode,
    /// Further options of the control mode.
    pub mode_flags: ControlExtModeFlags,
    /// Speed, as in [`ControlAxis`](super::ControlAxis).
    #[wire(flag = SPEED)]
    pub speed: Option<ControlRate>,
    /// Speed in 4 bytes, at a higher resolution.
    #[wire(spec = "SPEED", since = "2.72b0", when = set.has_long_speed())]
    pub speed_32bit: Option<FineRate>,
    /// Angle, as in [`ControlAxis`](super::ControlAxis).
    #[wire(flag = ANGLE)]
    pub angle: Option<Angle>,
    /// Angle in 4 bytes, raw.
    ///
    /// The step is unknown: "increased resolution" suggests 2^20 per turn, while a comment in the vendor's C library
    /// gives 2^14, as for the 2-byte angle.
    #[wire(spec = "ANGLE", when = set.has_long_angle())]
    pub angle_32bit: Option<i32>,
}

impl ControlExtAxis {
    /// The set of values that are there; where a value is there twice, the short one.
    fn data_set(&self) -> ControlExtAxisSet {
        let mut set = ControlExtAxisSet::empty();
        set.set(ControlExtAxisSet::SPEED, self.speed.is_some());
        set.set(ControlExtAxisSet::SPEED_32BIT, self.speed_32bit.is_some() && self.speed.is_none());
        set.set(ControlExtAxisSet::ANGLE, self.angle.is_some());
        set.set(ControlExtAxisSet::ANGLE_32BIT, self.angle_32bit.is_some() && self.angle.is_none());
        set
    }
}

flags! {
    /// Selected values of all axes, five bits per axis. Spec: `CONTROL_EXT_DATA_SET`.
    pub struct ControlExtDataSet: u16 {
        /// Speed of ROLL.
        const ROLL_SPEED = 1 << 0;
        /// Angle of ROLL.
        const ROLL_ANGLE = 1 << 1;
        /// Angle of ROLL in 4 bytes.
        const ROLL_ANGLE_32BIT = 1 << 2;
        /// Speed of ROLL in 4 bytes. Firmware 2.72b0+.
        const ROLL_SPEED_32BIT = 1 << 3;
        /// Speed of PITCH.
        const PITCH_SPEED = 1 << 5;
        /// Angle of PITCH.
        const PITCH_ANGLE = 1 << 6;
        /// Angle of PITCH in 4 bytes.
        const PITCH_ANGLE_32BIT = 1 << 7;
        /// Speed of PITCH in 4 bytes. Firmware 2.72b0+.
        const PITCH_SPEED_32BIT = 1 << 8;
        /// Speed of YAW.
        const YAW_SPEED = 1 << 10;
        /// Angle of YAW.
        const YAW_ANGLE = 1 << 11;
        /// Angle of YAW in 4 bytes.
        const YAW_ANGLE_32BIT = 1 << 12;
        /// Speed of YAW in 4 bytes. Firmware 2.72b0+.
        const YAW_SPEED_32BIT = 1 << 13;
    }
}

impl ControlExtDataSet {
    /// Selected values of each axis.
    pub fn axes(self) -> PerAxis<ControlExtAxisSet> {
        PerAxis { roll: 0, pitch: 5, yaw: 10 }.map(|shift| {
            let [bits, _] = (self.bits() >> shift & 0x1F).to_le_bytes();
            ControlExtAxisSet::from_bits_retain(bits)
        })
    }

    /// Combines the selected values of each axis.
    #[must_use]
    pub fn of_axes(axes: PerAxis<ControlExtAxisSet>) -> Self {
        let [roll, pitch, yaw] = axes.map(|set| u16::from(set.bits() & 0x1F)).into_array();
        Self::from_bits_retain(roll | pitch << 5 | yaw << 10)
    }
}

flags! {
    /// Selected values of one axis: its five bits of [`ControlExtDataSet`].
    pub struct ControlExtAxisSet: u8 {
        /// Speed.
        const SPEED = 1 << 0;
        /// Angle.
        const ANGLE = 1 << 1;
        /// Angle in 4 bytes.
        const ANGLE_32BIT = 1 << 2;
        /// Speed in 4 bytes. Firmware 2.72b0+.
        const SPEED_32BIT = 1 << 3;
    }
}

impl ControlExtAxisSet {
    /// Whether the speed has 4 bytes: its bit is set, and that of the 2-byte speed is not.
    pub fn has_long_speed(self) -> bool {
        self.contains(Self::SPEED_32BIT) && !self.contains(Self::SPEED)
    }

    /// Whether the angle has 4 bytes: its bit is set, and that of the 2-byte angle is not.
    pub fn has_long_angle(self) -> bool {
        self.contains(Self::ANGLE_32BIT) && !self.contains(Self::ANGLE)
    }
}

flags! {
    /// Further control options of an axis. Spec: `CONTROL_EXT_MODE_FLAG`.
    pub struct ControlExtModeFlags: u8 {
        /// Disables the correction of angle errors.
        const DISABLE_ANGLE_ERR_CORR = 1 << 0;
    }
}
