//! Motion of the frame, which helps the board to estimate attitude.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::units::{Acceleration, Angle, FrameHeading, SensorRate};
use crate::wire::{PerXyz, Reserved};

/// Says how the frame moves, so that the estimate of attitude does not suffer from it.
///
/// For the acceleration alone, all else zero, 10 to 20 times per second are enough, for the board filters it strongly.
/// With the angular speed it should come up to 125 times per second. Neither confirmed nor answered.
///
/// To test on the bench, set the parameter ACC LPF to 5 to 10 Hz and watch `IMU_G_ERR` of the real-time data: without
/// this command shaking the gimbal raises it, with correct accelerations it stays near zero, however the frame is
/// turned and however the camera stands to it. At rest and when tilted slowly the acceleration must be near zero.
#[message(CMD_HELPER_DATA, outgoing, form = "extended", default, size = 20, since = "2.60")]
pub struct HelperData {
    /// Linear acceleration of the frame, without gravity, in the system that `flags` chooses.
    pub frame_acc: PerXyz<Acceleration>,
    /// Roll of the outer frame; zero when not known.
    pub frame_angle_roll: Angle,
    /// Pitch of the outer frame; zero when not known.
    pub frame_angle_pitch: Angle,
    /// Coordinate system and the values to use.
    pub flags: HelperDataFlags,
    /// Angular speed of the frame; zero when not known. Helps where there is neither encoder nor sensor on the frame.
    pub frame_speed: PerXyz<SensorRate>,
    /// Heading of the frame against North, from -180 to 180 or from 0 to 360 degrees; ignored without its flag.
    ///
    /// The first one sets the yaw angle, later ones only correct the drift of the gyroscope. If the frame is fixed one
    /// is enough, if it moves 10 to 50 per second are needed. Older firmware has these bytes reserved.
    #[wire(range = -16384..=16384, since = "2.62b7")]
    pub frame_heading: FrameHeading,
    pub reserved: Reserved<1>,
}

/// Says how the frame moves, to firmware before 2.60: acceleration and inclination.
///
/// For firmware before 2.60. All else is as with [`HelperData`]. The system of coordinates is the ground, rotated with
/// the camera.
#[message(CMD_HELPER_DATA, outgoing, form = "legacy", size = 10, length = 10)]
pub struct HelperDataLegacy {
    /// Linear acceleration of the frame, without gravity.
    pub frame_acc: PerXyz<Acceleration>,
    /// Roll of the outer frame; zero when not known.
    pub frame_angle_roll: Angle,
    /// Pitch of the outer frame; zero when not known.
    pub frame_angle_pitch: Angle,
}

/// Interpretation of the frame motion. Spec: `HELPER_DATA_FLAGS`.
#[bit_fields(u8)]
pub struct HelperDataFlags {
    /// System of coordinates of the vectors.
    #[wire(bits = 0..=2, spec = "HELPER_COORD_SYS")]
    pub coord_sys: HelperCoordSys,
    /// Angles are Euler angles in the order roll, pitch, yaw.
    #[wire(bits = 6, since = "2.70b7")]
    pub euler_order_roll_pitch_yaw: bool,
    /// The heading is to be used.
    #[wire(bits = 7, since = "2.62b7")]
    pub use_frame_heading: bool,
}

/// A system of coordinates for motion of the frame. Spec: `HELPER_COORD_SYS`.
#[open_enum(u8, prefix = "COORD_SYS_")]
pub enum HelperCoordSys {
    /// The ground, rotated about the vertical with the camera: X right, Y forward, Z down.
    GroundYawRotated = 1,
    /// The ground: X East, Y North, Z down.
    ///
    /// Needs a magnetometer, or encoders and the heading of the frame.
    Ground = 2,
    /// The outer frame: X right, Y forward, Z down.
    ///
    /// Needs a sensor on the frame and an encoder on yaw in regular firmware, three encoders in the one for encoders.
    Frame = 3,
}
