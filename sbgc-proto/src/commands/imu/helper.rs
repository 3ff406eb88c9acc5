//! Motion of the frame, which supports the attitude estimation.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::units::{Acceleration, Angle, FrameHeading, SensorRate};
use crate::wire::{PerXyz, Reserved};

/// Reports the motion of the frame, so that the attitude estimation can compensate for it.
///
/// For the acceleration only, with all other fields zero, a rate of 10 to 20 Hz is sufficient, because the board
/// filters it strongly. With the angular rate, send it at up to 125 Hz. Not confirmed.
///
/// For a test on the bench, set the parameter ACC LPF to 5 to 10 Hz and watch `IMU_G_ERR` in the real-time data.
/// Without this command, shaking the gimbal raises it; with correct accelerations, it stays near zero regardless of the
/// orientation of frame and camera. At rest and when tilted slowly, the acceleration must be near zero.
#[message(CMD_HELPER_DATA, outgoing, form = "extended", default, size = 20, since = "2.60")]
pub struct HelperData {
    /// Linear acceleration of the frame without gravity, in the coordinate system selected by `flags`.
    pub frame_acc: PerXyz<Acceleration>,
    /// Roll of the outer frame; 0 if unknown.
    pub frame_angle_roll: Angle,
    /// Pitch of the outer frame; 0 if unknown.
    pub frame_angle_pitch: Angle,
    /// Coordinate system and the values to use.
    pub flags: HelperDataFlags,
    /// Angular rate of the frame; 0 if unknown. Useful without encoders and frame IMU.
    pub frame_speed: PerXyz<SensorRate>,
    /// Heading of the frame relative to North, -180 to 180 or 0 to 360 degrees; ignored without its flag.
    ///
    /// The first value sets the yaw angle, later ones only correct the drift of the gyroscope. One value is sufficient
    /// for a fixed frame; a moving frame requires 10 to 50 per second. Reserved in older firmware.
    #[wire(range = -16384..=16384, since = "2.62b7")]
    pub frame_heading: FrameHeading,
    pub reserved: Reserved<1>,
}

/// Reports the motion of the frame: acceleration and inclination (firmware before 2.60).
///
/// Otherwise like [`HelperData`]. The coordinate system is [`HelperCoordSys::GroundYawRotated`].
#[message(CMD_HELPER_DATA, outgoing, form = "legacy", size = 10, length = 10)]
pub struct HelperDataLegacy {
    /// Linear acceleration of the frame without gravity.
    pub frame_acc: PerXyz<Acceleration>,
    /// Roll of the outer frame; 0 if unknown.
    pub frame_angle_roll: Angle,
    /// Pitch of the outer frame; 0 if unknown.
    pub frame_angle_pitch: Angle,
}

/// Interpretation of the frame motion. Spec: `HELPER_DATA_FLAGS`.
#[bit_fields(u8)]
pub struct HelperDataFlags {
    /// Coordinate system of the vectors.
    #[wire(bits = 0..=2, spec = "HELPER_COORD_SYS")]
    pub coord_sys: HelperCoordSys,
    /// Whether the angles are Euler angles in the order roll, pitch, yaw.
    #[wire(bits = 6, since = "2.70b7")]
    pub euler_order_roll_pitch_yaw: bool,
    /// Whether to use the heading.
    #[wire(bits = 7, since = "2.62b7")]
    pub use_frame_heading: bool,
}

/// Coordinate system for the motion of the frame. Spec: `HELPER_COORD_SYS`.
#[open_enum(u8, prefix = "COORD_SYS_")]
pub enum HelperCoordSys {
    /// Ground system, rotated about the vertical with the camera: X right, Y forward, Z down.
    GroundYawRotated = 1,
    /// Ground system: X East, Y North, Z down.
    ///
    /// Requires a magnetometer, or encoders and the heading of the frame.
    Ground = 2,
    /// System of the outer frame: X right, Y forward, Z down.
    ///
    /// Requires a frame IMU and a yaw encoder in regular firmware, or three encoders in firmware for encoders.
    Frame = 3,
}
