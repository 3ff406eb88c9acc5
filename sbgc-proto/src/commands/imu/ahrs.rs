//! Attitude as two vectors, given to the board or taken from it.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::wire::{Bytes, Float, PerXyz};

/// Sets the attitude of an IMU from an external source, or requests it.
///
/// Bit 0 of the mode selects set or get. To set, send it 20 to 50 times per second; there is no answer. For a request,
/// the vectors are ignored and [`AhrsHelper`] answers; this form is the safe one for that, and
/// [`AhrsHelperShortRequest`] the one that newer libraries send.
#[message(CMD_AHRS_HELPER, outgoing, form = "mode2u", default, size = 26, since = "2.69b5")]
pub struct AhrsHelperRequest {
    /// Action and sensor.
    pub mode: AhrsHelperMode,
    /// Unit vector that points down.
    #[wire(range = -1.0..=1.0)]
    pub z_vect: PerXyz<Float>,
    /// Unit vector that points North.
    #[wire(range = -1.0..=1.0)]
    pub h_vect: PerXyz<Float>,
}

/// Sets or requests the attitude of an IMU, with a one-byte mode, for firmware before 2.69b5.
///
/// All else is as with [`AhrsHelperRequest`].
#[message(CMD_AHRS_HELPER, outgoing, form = "mode1u", size = 25, length = 25)]
pub struct AhrsHelperLegacyRequest {
    /// Action and sensor.
    pub mode: AhrsHelperModeByte,
    /// Unit vector that points down.
    #[wire(range = -1.0..=1.0)]
    pub z_vect: PerXyz<Float>,
    /// Unit vector that points North.
    #[wire(range = -1.0..=1.0)]
    pub h_vect: PerXyz<Float>,
}

/// Requests the attitude of a sensor without sending vectors that are ignored.
///
/// The spec does not have it, but the vendor's libraries send it so. Firmware before 2.69b5 takes a mode of one byte,
/// later firmware one of two. Whether old firmware accepts this form is unknown; for it, use
/// [`AhrsHelperLegacyRequest`].
#[message(CMD_AHRS_HELPER, outgoing, form = "get_short", size = 1..=2, length = 1..=2, answer = AhrsHelper)]
pub struct AhrsHelperShortRequest {
    /// Sensor; must not be a mode that sets an attitude.
    pub mode: AhrsHelperModeByte,
    /// The high byte of the mode, zero.
    pub mode_high: Option<u8>,
}

/// The attitude of a sensor.
///
/// Comes as an answer or as a data stream.
#[message(CMD_AHRS_HELPER, incoming, size = 24)]
pub struct AhrsHelper {
    /// Unit vector that points down: the Z axis in normal position.
    #[wire(range = -1.0..=1.0)]
    pub z_vect: PerXyz<Float>,
    /// Unit vector that points North: the Y axis in normal position.
    #[wire(range = -1.0..=1.0)]
    pub h_vect: PerXyz<Float>,
}

/// The attitude of a sensor as it may come in a data stream.
///
/// The vendor's libraries expect 26 bytes there in place of 24, and neither what the two more are nor where they
/// stand is published. So these bytes stay as they came.
#[message(CMD_AHRS_HELPER, incoming, form = "stream", size = 26, length = 26)]
pub struct AhrsHelperStream {
    /// Payload bytes.
    pub data: Bytes<26>,
}

macro_rules! modes {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident: $integer:ident {
            $($(#[$part_attribute:meta])+ pub $part:ident: $ty:ty,)*
        }
    )*) => { $(
        $(#[doc = $doc])+
        #[bit_fields($integer)]
        pub struct $name {
            /// Whether an attitude is set; otherwise one is requested.
            #[wire(bits = 0)]
            pub set: bool,
            /// Whether the sensor on the frame is meant; else the one on the camera platform.
            #[wire(bits = 1)]
            pub frame_imu: bool,
            /// Use as a reference to correct the sensor by, with all internal references off; else as its attitude.
            #[wire(bits = 2)]
            pub use_as_reference: bool,
            /// Also translate from camera to frame or back, and use that as a reference. Wants known motor angles.
            #[wire(bits = 3)]
            pub translate: bool,
            /// Take the vertical only.
            #[wire(bits = 4)]
            pub z_only: bool,
            /// Take the heading only.
            #[wire(bits = 5)]
            pub h_only: bool,
            /// Translate the vertical only.
            #[wire(bits = 6, since = "2.69b5")]
            pub translate_z_only: bool,
            /// Translate the heading only.
            #[wire(bits = 7, since = "2.69b5")]
            pub translate_h_only: bool,
            $($(#[$part_attribute])+ pub $part: $ty,)*
        }

        impl $name {
            /// Requests the attitude of the IMU on the camera platform.
            pub const GET_MAIN: Self = Self(0);
            /// Sets the camera attitude in place of that of its IMU. The source is on the camera platform.
            pub const SET_CAMERA_ATTITUDE: Self = Self(1);
            /// Ask for the attitude of the sensor on the frame.
            pub const GET_FRAME: Self = Self(2);
            /// Sets the frame attitude, with or without a frame IMU. The source is on the frame.
            pub const SET_FRAME_ATTITUDE: Self = Self(3);
            /// A reference for the sensor on the camera platform, which corrects its gyroscope with the factor
            /// `GYRO_TRUST`. The source sits on the camera platform.
            pub const MAIN_REFERENCE: Self = Self(5);
            /// A reference for the sensor on the frame. The source sits on the frame.
            pub const FRAME_REFERENCE: Self = Self(7);
            /// The attitude of the frame, and translated a reference for the sensor on the camera platform. The source
            /// sits on the frame.
            pub const FRAME_ATTITUDE_AND_MAIN_REFERENCE: Self = Self(11);
            /// A reference for the sensor on the frame, and translated one for that on the camera platform. The source
            /// sits on the frame.
            pub const FRAME_REFERENCE_AND_MAIN_REFERENCE: Self = Self(15);
        }
    )* };
}

modes! {
    /// Use of an attitude. Spec: `AHRS_HELPER_MODE`.
    ///
    /// The constants are the combinations that the spec names; `z_only` and `h_only` can be added to those that give
    /// an attitude.
    ///
    /// ```
    /// use sbgc_proto::commands::AhrsHelperMode;
    ///
    /// let mode = AhrsHelperMode::MAIN_REFERENCE.with_h_only(true);
    /// assert_eq!(mode, AhrsHelperMode(0b10_0101));
    /// ```
    AhrsHelperMode: u16 {
        /// Location of the attitude source.
        #[wire(bits = 8..=9, since = "2.69b5")]
        pub location: AhrsHelperLocation,
        /// Do not correct by the internal sensors.
        #[wire(bits = 10, since = "2.70b1")]
        pub disable_internal_correction: bool,
    }
    /// Use of an attitude, in one byte. Spec: `AHRS_HELPER_MODE`.
    ///
    /// The low byte of an [`AhrsHelperMode`], which is what firmware before 2.69b5 has.
    AhrsHelperModeByte: u8 {}
}

impl From<AhrsHelperModeByte> for AhrsHelperMode {
    fn from(mode: AhrsHelperModeByte) -> Self {
        Self(mode.0.into())
    }
}

/// Location of an external attitude source: bits 8 and 9 of the mode.
#[open_enum(u8)]
pub enum AhrsHelperLocation {
    /// Location of the frame sensor.
    WithFrameImu = 0,
    /// On the frame.
    OnFrame = 1,
    /// Below the outer motor.
    BelowOuterMotor = 2,
}
