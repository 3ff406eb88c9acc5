//! Commands of which only the id and the name are published. Their payloads are kept as raw bytes.
//!
//! Their direction is not published either, so there is a message for each direction.

use sbgc_proto_macros::message;

macro_rules! unpublished {
    ($($command:ident: $outgoing:ident, $incoming:ident, $what:literal;)*) => { $(
        #[doc = concat!("To the board: ", $what, ". The payload is not published.")]
        #[message($command, outgoing, form = "undocumented", default, size = 0..=255)]
        #[derive(Copy)]
        pub struct $outgoing<'a> {
            /// Payload bytes.
            pub data: &'a [u8],
        }

        #[doc = concat!("From the board: ", $what, ". The payload is not published.")]
        #[message($command, incoming, form = "undocumented", default, size = 0..=255)]
        #[derive(Copy)]
        pub struct $incoming<'a> {
            /// Payload bytes.
            pub data: &'a [u8],
        }
    )* };
}

unpublished! {
    CMD_QUEUE_PARAMS_INFO_3: QueueParamsInfo3Request, QueueParamsInfo3, "a queue of parameters, by its name";
    CMD_SYSTEM_STATE: SystemStateRequest, SystemState, "the state of the system";
    CMD_UART_BYPASS: UartBypassRequest, UartBypass, "bytes passed through to another serial port";
    CMD_CALIB_MOTOR_MAG_LINK: CalibMotorMagLinkRequest, CalibMotorMagLink,
        "calibration of the magnetic linkage of the motors";
    CMD_COGGING_CALIB_INFO: CoggingCalibInfoRequest, CoggingCalibInfo, "how a calibration of cogging is going";
    CMD_CAN_DRV_HARD_PARAMS: CanDrvHardParamsRequest, CanDrvHardParams,
        "hardware parameters of a motor driver on the CAN bus";
    CMD_CAN_DRV_STATE: CanDrvStateRequest, CanDrvState, "the state of a motor driver on the CAN bus";
    CMD_CAN_DRV_CALIBRATE: CanDrvCalibrateRequest, CanDrvCalibrate,
        "calibration of a motor driver on the CAN bus";
    CMD_REALTIME_DATA_CAN_DRV: RealtimeDataCanDrvRequest, RealtimeDataCanDrv,
        "real-time data of a motor driver on the CAN bus";
    CMD_SET_DEVICE_ADDR: SetDeviceAddrRequest, SetDeviceAddr, "the address of a device";
    CMD_SERIAL_PROXY: SerialProxyRequest, SerialProxy, "a board that stands between two serial ports";
    CMD_IMU_ADVANCED_CALIB: ImuAdvancedCalibRequest, ImuAdvancedCalib,
        "advanced calibration of an inertial sensor";
    CMD_CALIB_ENCODER_LUT: CalibEncoderLutRequest, CalibEncoderLut,
        "calibration of the look-up table of an encoder";
    CMD_CALIB_ENCODER_LUT_RES: CalibEncoderLutResRequest, CalibEncoderLutRes,
        "the result of a calibration of the look-up table of an encoder, by its name";
    CMD_CALIB_CUR_SENS: CalibCurSensRequest, CalibCurSens, "calibration of the current sensors";
    CMD_ENC_INT_CALIB: EncIntCalibRequest, EncIntCalib, "internal calibration of encoders, by its name";
    CMD_EXT_LICENSE_INFO: ExtLicenseInfoRequest, ExtLicenseInfo, "the license of additional functions";
    CMD_VIBRATION_TEST_START_STOP: VibrationTestStartStopRequest, VibrationTestStartStop,
        "start and end of a vibration test";
    CMD_VIBRATION_TEST_DATA: VibrationTestDataRequest, VibrationTestData, "data of a vibration test";
    CMD_OBGC: ObgcRequest, Obgc, "boards with the OpenBGC firmware";
    CMD_MAVLINK_INFO: MavlinkInfoRequest, MavlinkInfo, "the connection by MAVLink";
    CMD_MAVLINK_DEBUG: MavlinkDebugRequest, MavlinkDebug, "search for faults in MAVLink";
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Message;

    #[test]
    fn payloads_of_any_length_stay_as_they_are() {
        for payload in [&[][..], &[1, 2], &[7; 255]] {
            let message = VibrationTestData::decode(payload).unwrap();
            assert_eq!(message, VibrationTestData { data: payload });
            assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
        }
    }
}
