//! Calibration of the encoders: zero position and alignment with the motor field.

use sbgc_proto_macros::{message, open_enum};

use crate::declare::flags;
use crate::units::{Angle, SensorRate};
use crate::wire::PerAxis;

/// Sets the zero of all encoders to the current position.
///
/// Put the gimbal into its normal position first; it does not move. Requires
/// [`BoardFeatures::ENCODERS`](crate::commands::BoardFeatures::ENCODERS). Whether the board confirms is unknown: accept
/// a `CMD_CONFIRM`, but do not rely on one. The result is stored in the parameter
/// [`encoder_offset`](crate::commands::ParamsExt::encoder_offset).
#[message(CMD_ENCODERS_CALIB_OFFSET_4, outgoing, form = "simple", size = 0, length = 0)]
pub struct EncodersCalibOffset4Simple;

/// Sets the zero of one encoder, or of all, to the current position.
///
/// Otherwise like [`EncodersCalibOffset4Simple`].
#[message(CMD_ENCODERS_CALIB_OFFSET_4, outgoing, form = "extended", default, size = 1, since = "2.68b7")]
pub struct EncodersCalibOffset4 {
    /// Encoder to calibrate.
    pub for_motor: ForMotor,
}

/// One motor or all motors. Spec: `FOR_MOTOR`.
#[open_enum(u8)]
pub enum ForMotor {
    /// Roll.
    Roll = 0,
    /// Pitch.
    Pitch = 1,
    /// Yaw.
    Yaw = 2,
    /// All motors.
    All = 255,
}

/// Calibrates the encoders against the magnetic fields of their motors.
///
/// **The gimbal moves**, by 40 degrees: turn the motors on and keep the area clear. Requires
/// [`BoardFeatures::ENCODERS`](crate::commands::BoardFeatures::ENCODERS).
///
/// Sources disagree on whether the board confirms the end: accept a `CMD_CONFIRM`, but do not rely on one. The duration
/// is not published. Failures are reported in the [`SystemErrors`](crate::commands::SystemErrors) of the real-time
/// data; the result is stored in the parameter [`encoder_fld_offset`](crate::commands::ParamsExt::encoder_fld_offset).
#[message(CMD_ENCODERS_CALIB_FLD_OFFSET_4, outgoing, form = "simple", default, size = 0, length = 0)]
pub struct EncodersCalibFldOffset4Simple;

/// Calibrates the encoders against the magnetic fields of their motors, over a given range.
///
/// **The gimbal moves.** Otherwise like [`EncodersCalibFldOffset4Simple`]. Use this form for firmware 2.70b8 to 2.71b0,
/// whose longer forms are unknown.
#[message(
    CMD_ENCODERS_CALIB_FLD_OFFSET_4,
    outgoing,
    form = "extended",
    size = 6,
    length = 6,
    since = "2.62b6"
)]
pub struct EncodersCalibFldOffset4 {
    /// Angle of the test motion. The default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
}

/// Calibrates the encoders against the magnetic fields of their motors, over a given range and at a given speed.
///
/// **The gimbal moves.** Otherwise like [`EncodersCalibFldOffset4Simple`].
#[message(
    CMD_ENCODERS_CALIB_FLD_OFFSET_4,
    outgoing,
    form = "extended_speed",
    size = 12,
    length = 12,
    since = "2.71b1"
)]
pub struct EncodersCalibFldOffset4Speed {
    /// Angle of the test motion. The default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
    /// Speed of the test motion. The default is about 6 degrees per second, raw 100.
    pub calib_speed: PerAxis<SensorRate>,
}

/// Calibrates the encoders against the magnetic fields of their motors, over a given range and at a given speed,
/// optionally skipping checks.
///
/// **The gimbal moves.** Otherwise like [`EncodersCalibFldOffset4Simple`]. In the vendor's libraries, the flags exist
/// from firmware 2.70b8 on, earlier than the speed field that precedes them; what firmware between 2.70b8 and 2.71b1
/// expects is unknown.
#[message(CMD_ENCODERS_CALIB_FLD_OFFSET_4, outgoing, form = "extended_flags", size = 14, since = "2.71b1")]
pub struct EncodersCalibFldOffset4Flags {
    /// Angle of the test motion. The default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
    /// Speed of the test motion. The default is about 6 degrees per second, raw 100.
    pub calib_speed: PerAxis<SensorRate>,
    /// Checks to skip.
    pub calib_flags: EncoderCalibFlags,
}

flags! {
    /// Checks that an encoder calibration skips. Spec: `ENCODER_CALIB_FLAGS`.
    pub struct EncoderCalibFlags: u16 {
        /// Skips the check against the IMU.
        const IGNORE_IMU_CHECK = 1 << 0;
        /// Skips the check of the encoder.
        const IGNORE_ENCODER_CHECK = 1 << 1;
    }
}
