//! Calibration of the encoders: where their zero is, and how they stand to the field of their motor.

use sbgc_proto_macros::{message, open_enum};

use crate::declare::flags;
use crate::units::{Angle, SensorRate};
use crate::wire::PerAxis;

/// Makes the current position the zero of all encoders.
///
/// Put the gimbal into its normal position first; it does not move. Only boards with
/// [`BoardFeatures::ENCODERS`](crate::commands::BoardFeatures::ENCODERS) can. Whether the board confirms is not
/// unknown: accept a `CMD_CONFIRM`, but do not rely on one. The result is in
/// [`encoder_offset`](crate::commands::ParamsExt::encoder_offset) of the parameters.
#[message(CMD_ENCODERS_CALIB_OFFSET_4, outgoing, form = "simple", size = 0, length = 0)]
pub struct EncodersCalibOffset4Simple;

/// Makes the current position the zero of one encoder or of all.
///
/// Otherwise like [`EncodersCalibOffset4Simple`].
#[message(CMD_ENCODERS_CALIB_OFFSET_4, outgoing, form = "extended", default, size = 1, since = "2.68b7")]
pub struct EncodersCalibOffset4 {
    /// Encoder to calibrate.
    pub for_motor: ForMotor,
}

/// Motor or all motors. Spec: `FOR_MOTOR`.
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

/// Calibrates the encoders against the fields of their motors.
///
/// **The gimbal moves**, by 40 degrees: the motors should be on and nothing in its way. Only boards with
/// [`BoardFeatures::ENCODERS`](crate::commands::BoardFeatures::ENCODERS) can.
///
/// Sources disagree on whether the board confirms the end: accept a `CMD_CONFIRM`, but do not rely on one. How
/// long it takes is not published. Failure shows in the [`SystemErrors`](crate::commands::SystemErrors) of the
/// real-time data, the result in [`encoder_fld_offset`](crate::commands::ParamsExt::encoder_fld_offset) of the
/// parameters.
#[message(CMD_ENCODERS_CALIB_FLD_OFFSET_4, outgoing, form = "simple", default, size = 0, length = 0)]
pub struct EncodersCalibFldOffset4Simple;

/// Calibrates the encoders against the fields of their motors, over a given range.
///
/// **The gimbal moves.** Otherwise like [`EncodersCalibFldOffset4Simple`]. For firmware 2.70b8 to 2.71b0, whose longer
/// forms are unknown, use this one.
#[message(
    CMD_ENCODERS_CALIB_FLD_OFFSET_4,
    outgoing,
    form = "extended",
    size = 6,
    length = 6,
    since = "2.62b6"
)]
pub struct EncodersCalibFldOffset4 {
    /// Angle of the test motion; the default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
}

/// Calibrates the encoders against the fields of their motors, over a given range at a given speed.
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
    /// Angle of the test motion; the default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
    /// Speed of the test motion; the default is raw 100, about 6 degrees per second.
    pub calib_speed: PerAxis<SensorRate>,
}

/// Calibrates the encoders against the fields of their motors, over a given range at a given speed, with fewer checks.
///
/// **The gimbal moves.** All else is as with [`EncodersCalibFldOffset4Simple`]. The vendor's libraries have the flags
/// in firmware 2.70b8 already, before the speed that stands in front of them; what firmware between that and 2.71b1
/// expects is unknown.
#[message(CMD_ENCODERS_CALIB_FLD_OFFSET_4, outgoing, form = "extended_flags", size = 14, since = "2.71b1")]
pub struct EncodersCalibFldOffset4Flags {
    /// Angle of the test motion; the default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
    /// Speed of the test motion; the default is raw 100, about 6 degrees per second.
    pub calib_speed: PerAxis<SensorRate>,
    /// Checks to skip.
    pub calib_flags: EncoderCalibFlags,
}

flags! {
    /// Checks that an encoder calibration skips. Spec: `ENCODER_CALIB_FLAGS`.
    pub struct EncoderCalibFlags: u16 {
        /// Ignore the IMU check.
        const IGNORE_IMU_CHECK = 1 << 0;
        /// Ignore the encoder check.
        const IGNORE_ENCODER_CHECK = 1 << 1;
    }
}
