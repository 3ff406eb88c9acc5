//! Attitude control by quaternion. Firmware 2.73+.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::Confirm;
use crate::declare::flags;
use crate::units::{ControlRateLimit, PackedQuaternion, SensorRate};
use crate::wire::{Float, PerXyz};

/// Turns the camera to an attitude, or rotates it about any axis.
///
/// Requires [`BoardFeaturesExt2::QUAT_CONTROL`](crate::commands::BoardFeaturesExt2::QUAT_CONTROL). Confirmed with
/// [`ControlQuatFlags::CONFIRM`]; with [`ControlQuatFlags::AUTO_TASK`], a second confirmation with data 1 follows when
/// the target is reached.
///
/// Values that the mode does not use are omitted from the payload, as in the vendor's libraries, which never send a
/// packed attitude.
#[message(CMD_CONTROL_QUAT, outgoing, size = 2..=30, since = "2.73.0")]
#[derive(Copy)]
pub struct ControlQuat {
    /// Controlled quantity: attitude, speed or both.
    pub mode: ControlQuatMode,
    /// Options: confirmations and interpretation of the attitude.
    pub flags: ControlQuatFlags,
    /// Target attitude as a unit quaternion w, x, y, z.
    #[wire(when = mode.has_attitude() && !flags.contains(ControlQuatFlags::ATTITUDE_PACKED))]
    pub target_attitude: Option<[Float; 4]>,
    /// Target attitude as a packed quaternion.
    #[wire(when = mode.has_attitude() && flags.contains(ControlQuatFlags::ATTITUDE_PACKED))]
    pub target_attitude_packed: Option<PackedQuaternion>,
    /// Target speed as a rotation vector.
    #[wire(unit = "rad/s", when = mode.has_speed())]
    pub target_speed: Option<PerXyz<Float>>,
}

impl ControlQuat {
    /// Ends quaternion control.
    pub fn disable() -> Self {
        Self::default()
    }

    /// Turns to an attitude, a unit quaternion w, x, y, z.
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

    /// Rotates at a speed, a rotation vector in radians per second.
    pub fn speed(speed: PerXyz<f32>, flags: ControlQuatFlags) -> Self {
        let target_speed = Some(speed.map(Float::from));
        Self { mode: ControlQuatMode::Speed, flags, target_speed, ..Self::default() }
    }
}

/// Mode of quaternion control. Spec: `CONTROL_QUAT_MODE`.
#[open_enum(u8, prefix = "MODE_")]
pub enum ControlQuatMode {
    /// Ends quaternion control.
    Disabled = 0,
    /// Controls the speed, without an acceleration limit.
    Speed = 1,
    /// Controls the attitude, along the motion profile.
    Attitude = 2,
    /// Controls the attitude, given together with the speed at which it changes.
    SpeedAttitude = 5,
    /// Controls the speed, within the acceleration limit.
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
    /// Options of quaternion control. Spec: `CONTROL_QUAT_FLAG`.
    pub struct ControlQuatFlags: u8 {
        /// Confirms the command.
        const CONFIRM = 1 << 0;
        /// The attitude is a packed quaternion.
        const ATTITUDE_PACKED = 1 << 1;
        /// Limits the attitude to half a turn.
        const ATTITUDE_LIMITED_180 = 1 << 2;
        /// Removes rotation about axes that the gimbal does not have. Firmware 2.74.1+.
        const ATT_REMOVE_ABSENT_AXES = 1 << 3;
        /// Sends a second confirmation when the target is reached; gives up after 10 seconds.
        const AUTO_TASK = 1 << 6;
    }
}

flags! {
    /// Options of quaternion control in two bytes, as reported in its state. Spec: `CONTROL_QUAT_FLAG`.
    pub struct ControlQuatStatusFlags: u16 {
        /// Confirms the command.
        const CONFIRM = 1 << 0;
        /// The attitude is a packed quaternion.
        const ATTITUDE_PACKED = 1 << 1;
        /// Limits the attitude to half a turn.
        const ATTITUDE_LIMITED_180 = 1 << 2;
        /// Removes rotation about axes that the gimbal does not have. Firmware 2.74.1+.
        const ATT_REMOVE_ABSENT_AXES = 1 << 3;
        /// Sends a second confirmation when the target is reached.
        const AUTO_TASK = 1 << 6;
    }
}

/// Requests the state of quaternion control.
#[message(CMD_CONTROL_QUAT_STATUS, outgoing, size = 4, since = "2.73.0", answer = ControlQuatStatus, echo = data_set)]
#[derive(Copy)]
pub struct ControlQuatStatusRequest {
    /// Flags that select the fields of the answer.
    pub data_set: ControlQuatStatusDataSet,
}

/// State of quaternion control. Quaternions are w, x, y, z.
///
/// Sources disagree on two points: the vendor's Python library reads a two-byte data set instead of four bytes, and an
/// example of the vendor's C library uses twice the speed unit used here.
#[message(CMD_CONTROL_QUAT_STATUS, incoming, size = 4..=97, since = "2.73.0", flags = data_set)]
#[derive(Copy)]
pub struct ControlQuatStatus {
    /// Flags that select the following fields.
    pub data_set: ControlQuatStatusDataSet,
    /// Controlled quantity.
    #[wire(flag = MODE)]
    pub mode: Option<ControlQuatMode>,
    /// Flags of the last [`ControlQuat`], in two bytes here.
    #[wire(flag = MODE)]
    pub flags: Option<ControlQuatStatusFlags>,
    /// Commanded attitude.
    #[wire(flag = TARGET_ATTITUDE)]
    pub target_attitude: Option<[Float; 4]>,
    /// Current attitude set-point of the motion profile.
    #[wire(flag = SETPOINT_ATTITUDE)]
    pub setpoint_attitude: Option<[Float; 4]>,
    /// Actual attitude.
    #[wire(flag = ACTUAL_ATTITUDE)]
    pub actual_attitude: Option<[Float; 4]>,
    /// Commanded speed.
    #[wire(flag = TARGET_SPEED)]
    pub target_speed: Option<PerXyz<SensorRate>>,
    /// Current speed set-point of the motion profile.
    #[wire(flag = SETPOINT_SPEED)]
    pub setpoint_speed: Option<PerXyz<SensorRate>>,
    /// Actual speed.
    #[wire(flag = ACTUAL_SPEED)]
    pub actual_speed: Option<PerXyz<SensorRate>>,
    /// Commanded attitude, packed.
    #[wire(flag = TARGET_ATTITUDE_PACKED)]
    pub target_attitude_packed: Option<PackedQuaternion>,
    /// Current attitude set-point of the motion profile, packed.
    #[wire(flag = SETPOINT_ATTITUDE_PACKED)]
    pub setpoint_attitude_packed: Option<PackedQuaternion>,
    /// Actual attitude, packed.
    #[wire(flag = ACTUAL_ATTITUDE_PACKED)]
    pub actual_attitude_packed: Option<PackedQuaternion>,
}

flags! {
    /// Selection of state fields of quaternion control. Spec: `CONTROL_QUAT_STATUS_DATA_SET`.
    pub struct ControlQuatStatusDataSet: u32 {
        /// Mode and flags.
        const MODE = 1 << 0;
        /// Commanded attitude.
        const TARGET_ATTITUDE = 1 << 1;
        /// Current attitude set-point of the motion profile.
        const SETPOINT_ATTITUDE = 1 << 2;
        /// Actual attitude.
        const ACTUAL_ATTITUDE = 1 << 3;
        /// Commanded speed.
        const TARGET_SPEED = 1 << 4;
        /// Current speed set-point of the motion profile.
        const SETPOINT_SPEED = 1 << 5;
        /// Actual speed.
        const ACTUAL_SPEED = 1 << 6;
        /// Commanded attitude, packed.
        const TARGET_ATTITUDE_PACKED = 1 << 7;
        /// Current attitude set-point of the motion profile, packed.
        const SETPOINT_ATTITUDE_PACKED = 1 << 8;
        /// Actual attitude, packed.
        const ACTUAL_ATTITUDE_PACKED = 1 << 9;
    }
}

/// Configures the motion profile and the filters of quaternion control.
#[message(CMD_CONTROL_QUAT_CONFIG, outgoing, size = 2..=24, since = "2.73.0", answer = Confirm, flags = data_set)]
#[derive(Copy)]
pub struct ControlQuatConfig {
    /// Flags that select the following fields.
    pub data_set: ControlQuatConfigDataSet,
    /// Maximum speed.
    #[wire(flag = MAX_SPEED)]
    pub max_speed: Option<PerXyz<ControlRateLimit>>,
    /// Maximum acceleration; 0 disables the limit.
    #[wire(unit = "deg/s^2", flag = ACC_LIMIT)]
    pub acc_limit: Option<PerXyz<u16>>,
    /// Time in which the acceleration builds up; 0 means immediately.
    #[wire(unit = "ms", flag = JERK_SLOPE)]
    pub jerk_slope: Option<PerXyz<u16>>,
    /// Options of the motion profile.
    #[wire(flag = FLAGS)]
    pub flags: Option<ControlQuatConfigFlags>,
    /// Cut-off frequency of the attitude's low-pass filter; 0, the default, disables it.
    #[wire(unit = "Hz", flag = ATTITUDE_LPF_FREQ)]
    pub attitude_lpf_freq: Option<u8>,
    /// Cut-off frequency of the speed's low-pass filter; 0, the default, disables it.
    #[wire(unit = "Hz", flag = SPEED_LPF_FREQ)]
    pub speed_lpf_freq: Option<u8>,
}

flags! {
    /// Selection of quaternion control settings. Spec: `CONTROL_QUAT_CONFIG_DATA_SET`.
    pub struct ControlQuatConfigDataSet: u16 {
        /// Maximum speed.
        const MAX_SPEED = 1 << 0;
        /// Maximum acceleration.
        const ACC_LIMIT = 1 << 1;
        /// Time in which the acceleration builds up.
        const JERK_SLOPE = 1 << 2;
        /// Options of the motion profile.
        const FLAGS = 1 << 3;
        /// Low-pass filter of the attitude.
        const ATTITUDE_LPF_FREQ = 1 << 4;
        /// Low-pass filter of the speed.
        const SPEED_LPF_FREQ = 1 << 5;
    }
}

flags! {
    /// Options of the motion profile of quaternion control. Spec: `CONTROL_QUAT_CONFIG_FLAG`.
    pub struct ControlQuatConfigFlags: u16 {
        /// Each component has a motion profile of its own.
        const MOTION_PROFILE_SPLIT_XYZ = 1 << 0;
    }
}
