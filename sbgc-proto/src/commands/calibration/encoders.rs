//! Calibration of the encoders: where their zero is, and how they stand to the field of their motor.

use sbgc_proto_macros::{message, open_enum};

use crate::units::{Angle, SensorRate};
use crate::wire::{PerAxis, flags};

/// Makes the present position the zero of all encoders.
///
/// Put the gimbal into its normal position first; it does not move. Only boards with
/// [`BoardFeatures::ENCODERS`](crate::commands::BoardFeatures::ENCODERS) can. Whether the board confirms is not
/// settled: take a `CMD_CONFIRM` if it comes, and do not depend on it. The result is in
/// [`encoder_offset`](crate::commands::ParamsExt::encoder_offset) of the parameters.
#[message(CMD_ENCODERS_CALIB_OFFSET_4, outgoing, form = "simple", size = 0, length = 0)]
pub struct EncodersCalibOffset4Simple {}

/// Makes the present position the zero of one encoder or all.
///
/// All else is as with [`EncodersCalibOffset4Simple`].
#[message(CMD_ENCODERS_CALIB_OFFSET_4, outgoing, form = "extended", default, size = 1, since = "2.68b7")]
pub struct EncodersCalibOffset4 {
    /// Which encoder.
    pub for_motor: ForMotor,
}

/// Which motor. Spec: `FOR_MOTOR`.
#[open_enum(u8)]
pub enum ForMotor {
    /// Roll.
    Roll = 0,
    /// Pitch.
    Pitch = 1,
    /// Yaw.
    Yaw = 2,
    /// All of them.
    All = 255,
}

/// Finds how the encoders stand to the fields of their motors.
///
/// **The gimbal moves**, by 40 degrees: the motors should be on and nothing in its way. Only boards with
/// [`BoardFeatures::ENCODERS`](crate::commands::BoardFeatures::ENCODERS) can.
///
/// Whether the board confirms the end is not settled: take a `CMD_CONFIRM` if it comes, and do not depend on it. How
/// long it takes is not published. Failure shows in the [`SystemErrors`](crate::commands::SystemErrors) of the
/// real-time data, the result in [`encoder_fld_offset`](crate::commands::ParamsExt::encoder_fld_offset) of the
/// parameters.
#[message(CMD_ENCODERS_CALIB_FLD_OFFSET_4, outgoing, form = "simple", default, size = 0, length = 0)]
pub struct EncodersCalibFldOffset4Simple {}

/// Finds how the encoders stand to the fields of their motors, over a given range.
///
/// **The gimbal moves.** All else is as with [`EncodersCalibFldOffset4Simple`]. For firmware 2.70b8 to 2.71b0, of which
/// it is not known what longer forms it takes, this is the one to use.
#[message(
    CMD_ENCODERS_CALIB_FLD_OFFSET_4,
    outgoing,
    form = "extended",
    size = 6,
    length = 6,
    since = "2.62b6"
)]
pub struct EncodersCalibFldOffset4 {
    /// How far to move; the default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
}

/// Finds how the encoders stand to the fields of their motors, over a given range at a given speed.
///
/// **The gimbal moves.** All else is as with [`EncodersCalibFldOffset4Simple`].
#[message(
    CMD_ENCODERS_CALIB_FLD_OFFSET_4,
    outgoing,
    form = "extended_speed",
    size = 12,
    length = 12,
    since = "2.71b1"
)]
pub struct EncodersCalibFldOffset4Speed {
    /// How far to move; the default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
    /// How fast to move; the default is raw 100, about 6 degrees a second.
    pub calib_speed: PerAxis<SensorRate>,
}

/// Finds how the encoders stand to the fields of their motors, over a given range, at a given speed, with fewer checks.
///
/// **The gimbal moves.** All else is as with [`EncodersCalibFldOffset4Simple`]. The vendor's libraries have the flags
/// in firmware 2.70b8 already, before the speed that stands in front of them; what firmware between that and 2.71b1
/// expects is not settled.
#[message(CMD_ENCODERS_CALIB_FLD_OFFSET_4, outgoing, form = "extended_flags", size = 14, since = "2.71b1")]
pub struct EncodersCalibFldOffset4Flags {
    /// How far to move; the default is 40 degrees, raw 1820.
    #[wire(range = -16384..=16384)]
    pub calib_angle: PerAxis<Angle>,
    /// How fast to move; the default is raw 100, about 6 degrees a second.
    pub calib_speed: PerAxis<SensorRate>,
    /// What not to check.
    pub calib_flags: EncoderCalibFlags,
}

flags! {
    /// What a calibration of encoders does not check. Spec: `ENCODER_CALIB_FLAGS`.
    pub struct EncoderCalibFlags: u16 {
        /// Go on whatever the inertial sensor says.
        const IGNORE_IMU_CHECK = 1 << 0;
        /// Go on whatever the encoder says.
        const IGNORE_ENCODER_CHECK = 1 << 1;
    }
}
