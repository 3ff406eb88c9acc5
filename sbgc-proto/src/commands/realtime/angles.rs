//! Angles only, axis by axis.

use sbgc_proto_macros::{message, record};

use crate::units::{Angle, ControlRate, LongAngle};
use crate::wire::{PerAxis, Reserved};

/// Requests the angles and the target speed of all axes.
#[message(CMD_GET_ANGLES, outgoing, size = 0, answer = Angles)]
pub struct GetAngles;

/// Angles and target speed of all axes.
#[message(CMD_GET_ANGLES, incoming, size = 18)]
#[derive(Copy)]
pub struct Angles {
    /// Values of each axis.
    #[wire(group)]
    pub axes: PerAxis<AxisAngles>,
}

/// Angles and target speed of one axis.
#[record(size = 6)]
#[derive(Copy)]
pub struct AxisAngles {
    /// Camera angle from the IMU.
    pub imu_angle: Angle,
    /// Target angle.
    pub target_angle: Angle,
    /// Target speed, in twice the unit that [`RealtimeDataCustom`](super::RealtimeDataCustom) uses.
    pub target_speed: ControlRate,
}

/// Requests the angles of all axes, with joint angles counted over several turns.
#[message(CMD_GET_ANGLES_EXT, outgoing, size = 0, answer = AnglesExt)]
pub struct GetAnglesExt;

/// Angles of all axes, with joint angles counted over several turns.
#[message(CMD_GET_ANGLES_EXT, incoming, size = 54)]
#[derive(Copy)]
pub struct AnglesExt {
    /// Values of each axis.
    #[wire(group)]
    pub axes: PerAxis<AxisAnglesExt>,
}

/// Angles of one axis, with the joint angle counted over several turns.
#[record(size = 18)]
#[derive(Copy)]
pub struct AxisAnglesExt {
    /// Camera angle from the IMU.
    pub imu_angle: Angle,
    /// Target angle.
    pub target_angle: Angle,
    /// Joint (stator–rotor) angle; 0 is the normal position. It does not wrap after a full turn.
    ///
    /// Newer documents call it FRAME_CAM_ANGLE.
    pub stator_rotor_angle: LongAngle,
    pub reserved: Reserved<10>,
}
