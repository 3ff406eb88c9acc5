//! Control of the attitude as a whole, by quaternion. All of it is known from newer documents only.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::Confirm;
use crate::units::{ControlRateLimit, SensorRate};
use crate::wire::{Bytes, Float, PerXyz, flags};

/// Turns the camera to an attitude, or at a speed about any axis.
///
/// The board must have [`BoardFeaturesExt2::QUAT_CONTROL`](crate::commands::BoardFeaturesExt2::QUAT_CONTROL). It confirms
/// the command with [`ControlQuatFlags::CONFIRM`], and once more, with data 1, when the target is reached, with
/// [`ControlQuatFlags::AUTO_TASK`].
///
/// What the mode does not use is left out of the payload. One source is not sure of that; two of the vendor's libraries
/// do so, but send no packed attitude.
#[message(CMD_CONTROL_QUAT, outgoing, size = 2..=30, since = "2.73.0")]
#[derive(Copy)]
pub struct ControlQuat {
    /// What is controlled.
    pub mode: ControlQuatMode,
    /// How.
    pub flags: ControlQuatFlags,
    /// The attitude as w, x, y, z, of length 1.
    #[wire(when = mode.has_attitude() && !flags.contains(ControlQuatFlags::ATTITUDE_PACKED))]
    pub target_attitude: Option<[Float; 4]>,
    /// The attitude, packed.
    #[wire(when = mode.has_attitude() && flags.contains(ControlQuatFlags::ATTITUDE_PACKED))]
    pub target_attitude_packed: Option<PackedQuaternion>,
    /// The speed as a rotation vector.
    #[wire(unit = "rad/s", when = mode.has_speed())]
    pub target_speed: Option<PerXyz<Float>>,
}

impl ControlQuat {
    /// Stops this kind of control.
    pub fn disable() -> Self {
        Self::default()
    }

    /// To an attitude w, x, y, z of length 1.
    pub fn attitude(attitude: [f32; 4], flags: ControlQuatFlags) -> Self {
        let packed = flags.contains(ControlQuatFlags::ATTITUDE_PACKED);
        Self {
            mode: ControlQuatMode::Attitude,
            flags,
            target_attitude: (!packed).then_some(attitude.map(Float::from)),
            target_attitude_packed: packed.then(|| PackedQuaternion::pack(attitude)),
            target_speed: None,
        }
    }

    /// At a speed, a rotation vector in radians a second.
    pub fn speed(speed: PerXyz<f32>, flags: ControlQuatFlags) -> Self {
        let target_speed = Some(speed.map(Float::from));
        Self { mode: ControlQuatMode::Speed, flags, target_speed, ..Self::default() }
    }
}

/// What control by quaternion controls. Spec: `CONTROL_QUAT_MODE`.
#[open_enum(u8)]
pub enum ControlQuatMode {
    /// Nothing: this kind of control ends.
    #[wire(spec = "MODE_DISABLED")]
    Disabled = 0,
    /// The speed, at once.
    #[wire(spec = "MODE_SPEED")]
    Speed = 1,
    /// The attitude, along the motion profile.
    #[wire(spec = "MODE_ATTITUDE")]
    Attitude = 2,
    /// The attitude and the speed at which it changes.
    #[wire(spec = "MODE_SPEED_ATTITUDE")]
    SpeedAttitude = 5,
    /// The speed, within the limit of acceleration.
    #[wire(spec = "MODE_SPEED_LIMITED")]
    SpeedLimited = 9,
}

impl ControlQuatMode {
    /// Whether the attitude is sent in this mode.
    pub const fn has_attitude(self) -> bool {
        matches!(self, Self::Attitude | Self::SpeedAttitude)
    }

    /// Whether the speed is sent in this mode.
    pub const fn has_speed(self) -> bool {
        matches!(self, Self::Speed | Self::SpeedAttitude | Self::SpeedLimited)
    }
}

flags! {
    /// How the attitude is controlled. Spec: `CONTROL_QUAT_FLAG`.
    pub struct ControlQuatFlags: u8 {
        /// The command is confirmed.
        const CONFIRM = 1 << 0;
        /// The attitude is packed.
        const ATTITUDE_PACKED = 1 << 1;
        /// The attitude is limited to half a turn.
        const ATTITUDE_LIMITED_180 = 1 << 2;
        /// Rotation about axes that the gimbal does not have is left out. Firmware 2.74.1 and later.
        const ATT_REMOVE_ABSENT_AXES = 1 << 3;
        /// The command is confirmed once more when the target is reached; given up after 10 seconds.
        const AUTO_TASK = 1 << 6;
    }
}

flags! {
    /// [`ControlQuatFlags`] in two bytes, as the state has them. Spec: `CONTROL_QUAT_FLAG`.
    pub struct ControlQuatStatusFlags: u16 {
        /// The command is confirmed.
        const CONFIRM = 1 << 0;
        /// The attitude is packed.
        const ATTITUDE_PACKED = 1 << 1;
        /// The attitude is limited to half a turn.
        const ATTITUDE_LIMITED_180 = 1 << 2;
        /// Rotation about axes that the gimbal does not have is left out. Firmware 2.74.1 and later.
        const ATT_REMOVE_ABSENT_AXES = 1 << 3;
        /// The command is confirmed once more when the target is reached.
        const AUTO_TASK = 1 << 6;
    }
}

/// Asks for the state of control by quaternion.
#[message(CMD_CONTROL_QUAT_STATUS, outgoing, size = 4, since = "2.73.0", answer = ControlQuatStatus)]
#[derive(Copy)]
pub struct ControlQuatStatusRequest {
    /// What is asked for.
    pub data_set: ControlQuatStatusDataSet,
}

/// The state of control by quaternion.
///
/// Quaternions are w, x, y, z. One source has two bytes in place of the four of the data set; here are those of the
/// others. For the speeds one source has the unit that is taken here, an example of another twice that.
#[message(CMD_CONTROL_QUAT_STATUS, incoming, size = 4..=97, since = "2.73.0")]
#[derive(Copy)]
pub struct ControlQuatStatus {
    /// What follows.
    pub data_set: ControlQuatStatusDataSet,
    /// What is controlled.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::MODE))]
    pub mode: Option<ControlQuatMode>,
    /// How; in two bytes here.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::MODE))]
    pub flags: Option<ControlQuatStatusFlags>,
    /// The attitude that was commanded.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::TARGET_ATTITUDE))]
    pub target_attitude: Option<[Float; 4]>,
    /// The attitude that the motion profile asks for now.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::SETPOINT_ATTITUDE))]
    pub setpoint_attitude: Option<[Float; 4]>,
    /// The attitude as it is.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::ACTUAL_ATTITUDE))]
    pub actual_attitude: Option<[Float; 4]>,
    /// The speed that was commanded.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::TARGET_SPEED))]
    pub target_speed: Option<PerXyz<SensorRate>>,
    /// The speed that the motion profile asks for now.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::SETPOINT_SPEED))]
    pub setpoint_speed: Option<PerXyz<SensorRate>>,
    /// The speed as it is.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::ACTUAL_SPEED))]
    pub actual_speed: Option<PerXyz<SensorRate>>,
    /// The attitude that was commanded, packed.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::TARGET_ATTITUDE_PACKED))]
    pub target_attitude_packed: Option<PackedQuaternion>,
    /// The attitude that the motion profile asks for now, packed.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::SETPOINT_ATTITUDE_PACKED))]
    pub setpoint_attitude_packed: Option<PackedQuaternion>,
    /// The attitude as it is, packed.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::ACTUAL_ATTITUDE_PACKED))]
    pub actual_attitude_packed: Option<PackedQuaternion>,
}

flags! {
    /// Parts of the state of control by quaternion. Spec: `CONTROL_QUAT_STATUS_DATA_SET`.
    pub struct ControlQuatStatusDataSet: u32 {
        /// Mode and flags.
        const MODE = 1 << 0;
        /// Commanded attitude.
        const TARGET_ATTITUDE = 1 << 1;
        /// Attitude of the motion profile.
        const SETPOINT_ATTITUDE = 1 << 2;
        /// Attitude as it is.
        const ACTUAL_ATTITUDE = 1 << 3;
        /// Commanded speed.
        const TARGET_SPEED = 1 << 4;
        /// Speed of the motion profile.
        const SETPOINT_SPEED = 1 << 5;
        /// Speed as it is.
        const ACTUAL_SPEED = 1 << 6;
        /// Commanded attitude, packed.
        const TARGET_ATTITUDE_PACKED = 1 << 7;
        /// Attitude of the motion profile, packed.
        const SETPOINT_ATTITUDE_PACKED = 1 << 8;
        /// Attitude as it is, packed.
        const ACTUAL_ATTITUDE_PACKED = 1 << 9;
    }
}

/// Sets the motion profile and the filters of control by quaternion.
#[message(CMD_CONTROL_QUAT_CONFIG, outgoing, size = 2..=24, since = "2.73.0", answer = Confirm)]
#[derive(Copy)]
pub struct ControlQuatConfig {
    /// What follows.
    pub data_set: ControlQuatConfigDataSet,
    /// Greatest speed.
    #[wire(when = data_set.contains(ControlQuatConfigDataSet::MAX_SPEED))]
    pub max_speed: Option<PerXyz<ControlRateLimit>>,
    /// Greatest acceleration; 0 is no limit.
    #[wire(unit = "deg/s^2", when = data_set.contains(ControlQuatConfigDataSet::ACC_LIMIT))]
    pub acc_limit: Option<PerXyz<u16>>,
    /// Time in which an acceleration builds up; 0 is at once.
    #[wire(unit = "ms", when = data_set.contains(ControlQuatConfigDataSet::JERK_SLOPE))]
    pub jerk_slope: Option<PerXyz<u16>>,
    /// How the motion profile works.
    #[wire(when = data_set.contains(ControlQuatConfigDataSet::FLAGS))]
    pub flags: Option<ControlQuatConfigFlags>,
    /// Cutoff of the low-pass filter of the attitude; 0, the default, is none.
    #[wire(unit = "Hz", when = data_set.contains(ControlQuatConfigDataSet::ATTITUDE_LPF_FREQ))]
    pub attitude_lpf_freq: Option<u8>,
    /// Cutoff of the low-pass filter of the speed; 0, the default, is none.
    #[wire(unit = "Hz", when = data_set.contains(ControlQuatConfigDataSet::SPEED_LPF_FREQ))]
    pub speed_lpf_freq: Option<u8>,
}

flags! {
    /// Settings of control by quaternion. Spec: `CONTROL_QUAT_CONFIG_DATA_SET`.
    pub struct ControlQuatConfigDataSet: u16 {
        /// Greatest speed.
        const MAX_SPEED = 1 << 0;
        /// Greatest acceleration.
        const ACC_LIMIT = 1 << 1;
        /// Time in which an acceleration builds up.
        const JERK_SLOPE = 1 << 2;
        /// Flags.
        const FLAGS = 1 << 3;
        /// Filter of the attitude.
        const ATTITUDE_LPF_FREQ = 1 << 4;
        /// Filter of the speed.
        const SPEED_LPF_FREQ = 1 << 5;
    }
}

flags! {
    /// How the motion profile of control by quaternion works. Spec: `CONTROL_QUAT_CONFIG_FLAG`.
    pub struct ControlQuatConfigFlags: u16 {
        /// Each component has a profile of its own.
        const MOTION_PROFILE_SPLIT_XYZ = 1 << 0;
    }
}

/// A quaternion of length 1 in 64 bits: its largest component is left out and follows from the others. Spec:
/// `QUAT_PACKED`.
///
/// The three others have 20 bits each from bit 0 on, the last of them the sign; bits 60 and 61 say which is left out,
/// bit 62 is its sign. That is from comments in one of the vendor's libraries; that the components are counted in the
/// order w, x, y, z is taken from the quaternions that are not packed. Neither is confirmed by a second source.
#[record]
#[derive(Copy)]
pub struct PackedQuaternion(pub Bytes<8>);

impl PackedQuaternion {
    /// Steps of a component: the greatest of those that are kept is the square root of 1/2.
    const STEPS: f64 = 741_453.785_975_902_9;

    /// The quaternion w, x, y, z.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_precision_loss,
        reason = "a float holds the 19 bits of a component"
    )]
    pub fn unpack(self) -> [f32; 4] {
        let bits = u64::from_le_bytes(self.0.0);
        let signed = |value: f64, negative: u64| if negative == 0 { value } else { -value };
        let mut squares = 0.0;
        let mut kept = [0, 20, 40].into_iter().map(|shift| {
            let value = (bits >> shift & 0x7_FFFF) as f64 / Self::STEPS;
            squares += value * value;
            signed(value, bits >> shift & 0x8_0000) as f32
        });
        let largest = bits >> 60 & 3;
        let quaternion = [0, 1, 2, 3].map(|index| if index == largest { None } else { kept.next() });
        let left_out = signed(square_root(1.0 - squares), bits >> 62 & 1) as f32;
        quaternion.map(|component| component.unwrap_or(left_out))
    }

    /// Packs a quaternion w, x, y, z of length 1.
    #[must_use]
    pub fn pack(quaternion: [f32; 4]) -> Self {
        let mut largest = (0, 0.0_f32);
        for (index, component) in (0_u64..).zip(quaternion) {
            if component.abs() > largest.1.abs() {
                largest = (index, component);
            }
        }
        let mut bits = largest.0 << 60 | u64::from(largest.1 < 0.0) << 62;
        let mut shift = 0;
        for (index, component) in (0_u64..).zip(quaternion) {
            if index != largest.0 {
                let steps = f64::from(component.abs()) * Self::STEPS + 0.5;
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the cast rounds, and saturates what is not of length 1"
                )]
                let magnitude = (steps as u64).min(0x7_FFFF);
                bits |= (magnitude | u64::from(component < 0.0) << 19) << shift;
                shift += 20;
            }
        }
        Self(Bytes(bits.to_le_bytes()))
    }
}

/// The square root of a number from 1/4 to 1, which is what is left for the largest of four components; 0 for less than
/// nothing.
fn square_root(square: f64) -> f64 {
    if square <= 0.0 {
        return 0.0;
    }
    // Newton's method doubles the digits each time.
    (0..6).fold(1.0, |root, _| f64::midpoint(root, square / root))
}
