//! Control of the attitude as a whole, by quaternion: firmware 2.73 and later.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{Confirm, PackedQuaternion};
use crate::units::{ControlRateLimit, SensorRate};
use crate::wire::{Float, PerXyz, flags};

/// Turns the camera to an attitude, or at a speed about any axis.
///
/// The board must have [`BoardFeaturesExt2::QUAT_CONTROL`](crate::commands::BoardFeaturesExt2::QUAT_CONTROL). It
/// confirms the command with [`ControlQuatFlags::CONFIRM`], and once more, with data 1, when the target is reached,
/// with [`ControlQuatFlags::AUTO_TASK`].
///
/// What the mode does not use is left out of the payload, as the vendor's libraries do; they never send a packed
/// attitude.
#[message(CMD_CONTROL_QUAT, outgoing, size = 2..=30, since = "2.73.0")]
#[derive(Copy)]
pub struct ControlQuat {
    /// Whether the attitude is controlled, the speed, or both.
    pub mode: ControlQuatMode,
    /// How the command is confirmed, and how the attitude is meant.
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
#[message(CMD_CONTROL_QUAT_STATUS, outgoing, size = 4, since = "2.73.0", answer = ControlQuatStatus, echo = data_set)]
#[derive(Copy)]
pub struct ControlQuatStatusRequest {
    /// Which parts the answer shall have.
    pub data_set: ControlQuatStatusDataSet,
}

/// The state of control by quaternion.
///
/// Quaternions are w, x, y, z.
///
/// Two things are not settled: the vendor's Python library reads two bytes of data set in place of these four, and an
/// example of the vendor's C library takes the steps of the speeds for twice of what they are here.
#[message(CMD_CONTROL_QUAT_STATUS, incoming, size = 4..=97, since = "2.73.0")]
#[derive(Copy)]
pub struct ControlQuatStatus {
    /// What follows.
    pub data_set: ControlQuatStatusDataSet,
    /// What is controlled.
    #[wire(when = data_set.contains(ControlQuatStatusDataSet::MODE))]
    pub mode: Option<ControlQuatMode>,
    /// The flags of the last [`ControlQuat`], in two bytes here.
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
