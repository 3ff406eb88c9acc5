//! Attitude as two vectors, sent to or requested from the board.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::wire::{Bytes, Float, PerXyz};

/// Sets the attitude of an IMU from an external source, or requests it.
///
/// Bit 0 of the mode selects between set and get. To set an attitude, send it 20 to 50 times per second; there is no
/// answer. In a request, the vectors are ignored and the board answers with [`AhrsHelper`]. All firmware understands
/// requests in this form; newer libraries send [`AhrsHelperShortRequest`] instead.
#[message(CMD_AHRS_HELPER, outgoing, form = "mode2u", default, size = 26, since = "2.69b5")]
pub struct AhrsHelperRequest {
    /// Action, IMU and options.
    pub mode: AhrsHelperMode,
    /// Unit vector pointing down.
    #[wire(range = -1.0..=1.0)]
    pub z_vect: PerXyz<Float>,
    /// Unit vector pointing North.
    #[wire(range = -1.0..=1.0)]
    pub h_vect: PerXyz<Float>,
}

/// Sets or requests the attitude of an IMU, with a one-byte mode (firmware before 2.69b5).
///
/// Otherwise like [`AhrsHelperRequest`].
#[message(CMD_AHRS_HELPER, outgoing, form = "mode1u", size = 25, length = 25)]
pub struct AhrsHelperLegacyRequest {
    /// Action, IMU and options.
    pub mode: AhrsHelperModeByte,
    /// Unit vector pointing down.
    #[wire(range = -1.0..=1.0)]
    pub z_vect: PerXyz<Float>,
    /// Unit vector pointing North.
    #[wire(range = -1.0..=1.0)]
    pub h_vect: PerXyz<Float>,
}

/// Requests the attitude of an IMU without sending unused vectors.
///
/// The specification does not define this form, but the vendor's libraries send it. Firmware before 2.69b5 expects a
/// one-byte mode, later firmware a two-byte mode. Whether old firmware accepts this form is unknown; use
/// [`AhrsHelperLegacyRequest`] for it.
#[message(CMD_AHRS_HELPER, outgoing, form = "get_short", size = 1..=2, length = 1..=2, answer = AhrsHelper)]
pub struct AhrsHelperShortRequest {
    /// IMU to report; must not be a mode that sets an attitude.
    pub mode: AhrsHelperModeByte,
    /// High byte of the mode, zero.
    pub mode_high: Option<u8>,
}

/// Attitude of an IMU.
///
/// Sent as an answer or as a data stream.
#[message(CMD_AHRS_HELPER, incoming, size = 24)]
pub struct AhrsHelper {
    /// Unit vector pointing down: the Z axis in the normal position.
    #[wire(range = -1.0..=1.0)]
    pub z_vect: PerXyz<Float>,
    /// Unit vector pointing North: the Y axis in the normal position.
    #[wire(range = -1.0..=1.0)]
    pub h_vect: PerXyz<Float>,
}

/// Attitude of an IMU in a data stream, in the layout that the vendor's libraries expect.
///
/// It has 26 bytes instead of 24. The meaning and position of the two additional bytes are not published, so the bytes
/// are kept raw.
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
            /// Whether to set an attitude; otherwise it is requested.
            #[wire(bits = 0)]
            pub set: bool,
            /// Whether the message refers to the frame IMU; otherwise to the IMU on the camera platform.
            #[wire(bits = 1)]
            pub frame_imu: bool,
            /// Whether to use the attitude as a reference that corrects the IMU, with all internal references disabled;
            /// otherwise it replaces the attitude of the IMU.
            #[wire(bits = 2)]
            pub use_as_reference: bool,
            /// Whether to translate the attitude to the other IMU as well, as a reference for it. Requires known motor
            /// angles.
            #[wire(bits = 3)]
            pub translate: bool,
            /// Whether to use the vertical only.
            #[wire(bits = 4)]
            pub z_only: bool,
            /// Whether to use the heading only.
            #[wire(bits = 5)]
            pub h_only: bool,
            /// Whether to translate the vertical only.
            #[wire(bits = 6, since = "2.69b5")]
            pub translate_z_only: bool,
            /// Whether to translate the heading only.
            #[wire(bits = 7, since = "2.69b5")]
            pub translate_h_only: bool,
            $($(#[$part_attribute])+ pub $part: $ty,)*
        }

        impl $name {
            /// Requests the attitude of the IMU on the camera platform.
            pub const GET_MAIN: Self = Self(0);
            /// Replaces the attitude of the IMU on the camera platform. The source is on the camera platform.
            pub const SET_CAMERA_ATTITUDE: Self = Self(1);
            /// Requests the attitude of the frame IMU.
            pub const GET_FRAME: Self = Self(2);
            /// Sets the attitude of the frame, with or without a frame IMU. The source is on the frame.
            pub const SET_FRAME_ATTITUDE: Self = Self(3);
            /// Sets a reference for the IMU on the camera platform, which corrects its gyroscope with the factor
            /// `GYRO_TRUST`. The source is on the camera platform.
            pub const MAIN_REFERENCE: Self = Self(5);
            /// Sets a reference for the frame IMU. The source is on the frame.
            pub const FRAME_REFERENCE: Self = Self(7);
            /// Sets the attitude of the frame and, translated, a reference for the IMU on the camera platform. The
            /// source is on the frame.
            pub const FRAME_ATTITUDE_AND_MAIN_REFERENCE: Self = Self(11);
            /// Sets a reference for the frame IMU and, translated, one for the IMU on the camera platform. The source
            /// is on the frame.
            pub const FRAME_REFERENCE_AND_MAIN_REFERENCE: Self = Self(15);
        }
    )* };
}

modes! {
    /// Use of an external attitude. Spec: `AHRS_HELPER_MODE`.
    ///
    /// The constants are the combinations named in the specification; `z_only` and `h_only` can be added to those that
    /// set an attitude or reference.
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
        /// Whether to disable corrections by the internal sensors.
        #[wire(bits = 10, since = "2.70b1")]
        pub disable_internal_correction: bool,
    }
    /// Use of an external attitude, in one byte. Spec: `AHRS_HELPER_MODE`.
    ///
    /// This is the low byte of an [`AhrsHelperMode`], as used by firmware before 2.69b5.
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
    /// At the location of the frame IMU.
    WithFrameImu = 0,
    /// On the frame.
    OnFrame = 1,
    /// Below the outer motor.
    BelowOuterMotor = 2,
}
