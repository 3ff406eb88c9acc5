//! Block 2 of a profile's parameters: filters, encoders and magnetometer.

use sbgc_proto_macros::{message, record};

use super::{AxisOrientation, EncoderConfig, EncoderSelection, FiltersEnabled};
use crate::commands::{Confirm, ProfileId};
use crate::units::{
    Angle, CoarseAngle, FastFilterFrequency, GearRatio, Gearing, NotchFrequency, ShortTime,
    SlowFilterFrequency,
};
use crate::wire::{PerAxis, Reserved};

/// Requests block 2 of a profile's parameters: filters, encoders and magnetometer.
#[message(CMD_READ_PARAMS_EXT, outgoing, size = 1, answer = ParamsExt, echo = profile(profile_id))]
pub struct ReadParamsExt {
    /// Profile to read; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes block 2 of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParamsExt`], change the required fields and send the others unchanged. To write
/// several blocks, bracket them with [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts only once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_WRITE_PARAMS_EXT, outgoing, size = 104, answer = Confirm)]
pub struct WriteParamsExt(pub ParamsExt);

/// Block 2 of a profile's parameters: filters, encoders and magnetometer.
///
/// The specification's table lists one notch filter for each axis, 92 bytes in total. In fact there are three for each
/// axis, which gives the 104 bytes of the vendor's library.
#[message(CMD_READ_PARAMS_EXT, incoming, size = 104)]
pub struct ParamsExt {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    /// Notch filters of each axis.
    #[wire(group)]
    pub notch_filters: PerAxis<NotchFilters>,
    /// Cut-off frequency (-3 dB) of the low-pass filter of each axis.
    #[wire(unit = "Hz", range = 0..=1000)]
    pub lpf_freq: PerAxis<u16>,
    /// Enabled filters of each axis.
    pub filters_en: PerAxis<FiltersEnabled>,
    /// Encoder reading in the neutral position of the motor.
    pub encoder_offset: PerAxis<Angle>,
    /// Angle between the zero of the encoder and the magnetic field of the motor.
    pub encoder_fld_offset: PerAxis<Angle>,
    /// Holding time of the motor when the field offset is set manually.
    pub encoder_manual_set_time: PerAxis<ShortTime>,
    /// Heating factor of the motor temperature model.
    pub motor_heating_factor: PerAxis<u8>,
    /// Cooling factor of the motor temperature model.
    pub motor_cooling_factor: PerAxis<u8>,
    pub reserved: Reserved<2>,
    /// Inner dead band of follow mode.
    pub follow_inside_deadband: u8,
    /// Strength of the magnetic link between rotor and stator of the motor.
    ///
    /// Deprecated: replaced by `MOTOR_MAG_LINK_FINE` in [`ParamsExt2`](super::ParamsExt2).
    pub motor_mag_link: PerAxis<u8>,
    /// Gearing of the motor.
    pub motor_gearing: PerAxis<Gearing>,
    /// Lower limit of the motor angle.
    ///
    /// Deprecated: replaced by `FRAME_CAM_ANGLE_MIN` in [`ParamsExt2`](super::ParamsExt2) in firmware 2.61+.
    #[wire(range = -127..=127)]
    pub encoder_limit_min: PerAxis<CoarseAngle>,
    /// Upper limit of the motor angle.
    ///
    /// Deprecated: replaced by `FRAME_CAM_ANGLE_MAX` in [`ParamsExt2`](super::ParamsExt2) in firmware 2.61+.
    #[wire(range = -127..=127)]
    pub encoder_limit_max: PerAxis<CoarseAngle>,
    /// Depth of the first notch filter of each axis; a negative value makes it a peak filter.
    #[wire(unit = "dB", range = -100..=100)]
    pub notch1_gain: PerAxis<i8>,
    /// Depth of the second notch filter of each axis; a negative value makes it a peak filter.
    #[wire(unit = "dB", range = -100..=100)]
    pub notch2_gain: PerAxis<i8>,
    /// Depth of the third notch filter of each axis; a negative value makes it a peak filter.
    #[wire(unit = "dB", range = -100..=100)]
    pub notch3_gain: PerAxis<i8>,
    /// Volume of the buzzer.
    pub beeper_volume: u8,
    /// Gear ratio between the encoder and its axis.
    pub encoder_gear_ratio: PerAxis<GearRatio>,
    /// Model of the encoder, and its options.
    pub encoder_type: PerAxis<EncoderSelection>,
    /// Options for reading the encoder.
    pub encoder_cfg: PerAxis<EncoderConfig>,
    /// Proportional term of the outer loop, which controls the angle.
    pub outer_p: PerAxis<u8>,
    /// Integral term of the outer loop, according to the vendor's library. Newer specifications may reserve these
    /// bytes.
    pub outer_i: PerAxis<u8>,
    /// Axis of the magnetometer that points up.
    pub mag_axis_top: AxisOrientation,
    /// Axis of the magnetometer that points right.
    pub mag_axis_right: AxisOrientation,
    /// Trust in the magnetometer.
    pub mag_trust: u8,
    /// Declination of the magnetic field.
    #[wire(unit = "deg", range = -90..=90)]
    pub mag_declination: i8,
    /// Cut-off frequency of the low-pass filter of the accelerometer.
    #[wire(range = 0..=1000)]
    pub acc_lpf_freq: SlowFilterFrequency,
    /// Cut-off frequency of the low-pass filter of the D term.
    #[wire(range = 0..=60)]
    pub d_term_lpf_freq: PerAxis<FastFilterFrequency>,
}

/// Three notch filters of an axis.
#[record(size = 6)]
#[derive(Copy)]
pub struct NotchFilters {
    /// Center frequencies.
    pub notch_freq: [NotchFrequency; 3],
    /// Widths between the -3 dB points.
    #[wire(unit = "Hz")]
    pub notch_width: [u8; 3],
}
