//! Calibrations whose ids are known and whose payloads are not.
//!
//! Nor is it known which way they go, so each is here in both directions, its bytes as they came.

use sbgc_proto_macros::message;

macro_rules! unpublished {
    ($($command:ident: $outgoing:ident, $incoming:ident, $what:literal;)*) => { $(
        #[doc = concat!($what, "; payload not published.")]
        #[message($command, outgoing, size = 0..=255)]
        pub struct $outgoing<'a> {
            /// The payload.
            pub data: &'a [u8],
        }

        #[doc = concat!($what, "; payload not published.")]
        #[message($command, incoming, size = 0..=255)]
        pub struct $incoming<'a> {
            /// The payload.
            pub data: &'a [u8],
        }
    )* };
}

unpublished! {
    CMD_CALIB_MOTOR_MAG_LINK: CalibMotorMagLinkRequest, CalibMotorMagLink,
        "Calibrates the magnetic linkage of the motors";
    CMD_COGGING_CALIB_INFO: CoggingCalibInfoRequest, CoggingCalibInfo,
        "By its name, how a calibration of cogging is going";
    CMD_IMU_ADVANCED_CALIB: ImuAdvancedCalibRequest, ImuAdvancedCalib,
        "Advanced calibration of an inertial sensor";
    CMD_CALIB_ENCODER_LUT: CalibEncoderLutRequest, CalibEncoderLut,
        "Calibrates the look-up table of an encoder";
    CMD_CALIB_ENCODER_LUT_RES: CalibEncoderLutResRequest, CalibEncoderLutRes,
        "By its name, the result of calibrating the look-up table of an encoder";
    CMD_CALIB_CUR_SENS: CalibCurSensRequest, CalibCurSens,
        "Calibrates the current sensors";
    CMD_ENC_INT_CALIB: EncIntCalibRequest, EncIntCalib,
        "By its name, an internal calibration of an encoder";
}
