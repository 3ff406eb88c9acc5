//! Telemetry of CAN motor drivers.

use sbgc_proto_macros::message;

use crate::DecodeError;
use crate::commands::selection::{decode_view, payload_len};
use crate::declare::flags;

flags! {
    /// Selection of telemetry fields of a CAN motor driver. Spec: `CAN_DRV_TELEMETRY_FLAGS`.
    pub struct CanDrvTelemetryFlags: u32 {
        /// State of the CAN bus.
        const CAN_BUS_FLAGS = 1 << 0;
        /// Number of CAN bus errors.
        const CAN_BUS_ERR_CNT = 1 << 1;
        /// Temperature of the driver board.
        const TEMP_BOARD = 1 << 2;
        /// Temperature of the motor.
        const TEMP_MOTOR = 1 << 3;
        /// Supply current of the driver.
        const AVG_CURRENT = 1 << 4;
        /// Supply voltage of the driver.
        const BUS_VOLTAGE = 1 << 5;
        /// Levels of the driver's pins.
        const PIN_STATE = 1 << 6;
        /// Current of each phase.
        const PHASE_CURRENT = 1 << 7;
        /// Number of encoder errors.
        const ENCODER_ERROR_CNT = 1 << 8;
        /// Currents along the q and d axes of the rotor.
        const IQ_ID_CURRENT = 1 << 9;
        /// Speed of the motor.
        const MOTOR_SPEED = 1 << 10;
        /// Error of the position loop.
        const PID_POS_ERR = 1 << 11;
        /// Error of the speed loop.
        const PID_SPEED_ERR = 1 << 12;
        /// Current set-point.
        const IQ_REF = 1 << 13;
        /// Error of the current loop.
        const PID_CURRENT_ERR = 1 << 14;
    }
}

impl CanDrvTelemetryFlags {
    /// Number of payload bytes of a [`CanDrvTelemetry`] with these flags.
    pub fn payload_len(self) -> usize {
        payload_len::<CanDrvTelemetry, _>(self)
    }
}

/// Telemetry of a CAN motor driver, sent as a data stream only.
///
/// The message does not identify its fields: decode it with the flags of the stream. Fields not selected are `None`.
/// The field widths are those of a third-party library, which quotes a newer specification.
#[message(
    CMD_CAN_DRV_TELEMETRY, incoming, size = 3..=35, since = "2.72b0", context(selection: CanDrvTelemetryFlags)
)]
#[derive(Copy)]
pub struct CanDrvTelemetry {
    /// Driver number.
    #[wire(range = 0..=6)]
    pub drv_id: u8,
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// State of the CAN bus; its flags are not published.
    #[wire(flag = CAN_BUS_FLAGS)]
    pub can_bus_flags: Option<u8>,
    /// Number of CAN bus errors.
    #[wire(flag = CAN_BUS_ERR_CNT)]
    pub can_bus_err_cnt: Option<u16>,
    /// Temperature of the driver board.
    #[wire(flag = TEMP_BOARD, unit = "degC")]
    pub temp_board: Option<i8>,
    /// Temperature of the motor.
    #[wire(flag = TEMP_MOTOR, unit = "degC")]
    pub temp_motor: Option<i8>,
    /// Average supply current of the driver.
    #[wire(flag = AVG_CURRENT, unit = "mA")]
    pub avg_current: Option<u16>,
    /// Supply voltage of the driver.
    #[wire(flag = BUS_VOLTAGE, unit = "mV")]
    pub bus_voltage: Option<u16>,
    /// Levels of the driver's pins.
    #[wire(flag = PIN_STATE)]
    pub pin_state: Option<CanDrvPins>,
    /// Current of each phase.
    #[wire(flag = PHASE_CURRENT, unit = "mA")]
    pub phase_current: Option<[i16; 3]>,
    /// Number of encoder errors.
    #[wire(flag = ENCODER_ERROR_CNT)]
    pub encoder_error_cnt: Option<u16>,
    /// Current along the q axis of the rotor, which produces torque.
    #[wire(flag = IQ_ID_CURRENT, unit = "mA")]
    pub iq_current: Option<i16>,
    /// Current along the d axis of the rotor.
    #[wire(flag = IQ_ID_CURRENT, unit = "mA")]
    pub id_current: Option<i16>,
    /// Speed of the motor.
    #[wire(flag = MOTOR_SPEED, unit = "rpm")]
    pub motor_speed: Option<i16>,
    /// Error of the position loop.
    #[wire(flag = PID_POS_ERR)]
    pub pid_pos_err: Option<i16>,
    /// Error of the speed loop.
    #[wire(flag = PID_SPEED_ERR)]
    pub pid_speed_err: Option<i16>,
    /// Set-point of the q current; 32768 is 100 %.
    #[wire(flag = IQ_REF)]
    pub iq_ref: Option<i16>,
    /// Error of the current loop.
    #[wire(flag = PID_CURRENT_ERR)]
    pub pid_current_err: Option<i16>,
}

/// Undecoded telemetry of a CAN motor driver (selection flags unknown).
#[message(CMD_CAN_DRV_TELEMETRY, incoming, size = 3..=255, since = "2.72b0")]
#[derive(Copy)]
pub struct CanDrvTelemetryView<'a> {
    /// Driver number.
    #[wire(range = 0..=6)]
    pub drv_id: u8,
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// Undecoded selected data.
    pub body: &'a [u8],
}

impl CanDrvTelemetryView<'_> {
    /// Decodes the data that `flags` select.
    ///
    /// # Errors
    /// If it has less than that.
    pub fn decode_as(&self, flags: CanDrvTelemetryFlags) -> Result<CanDrvTelemetry, DecodeError> {
        decode_view(self, flags)
    }
}

flags! {
    /// Levels of the pins of a CAN motor driver. Spec: `CAN_DRV_PIN_STATE`.
    pub struct CanDrvPins: u8 {
        /// Limit switch.
        const LIMIT = 1 << 0;
        /// Encoder index.
        const INDEX = 1 << 1;
        /// Emergency input.
        const EMERGENCY = 1 << 2;
        /// Auxiliary pin 1.
        const AUX1 = 1 << 3;
        /// Auxiliary pin 2.
        const AUX2 = 1 << 4;
        /// Auxiliary pin 3.
        const AUX3 = 1 << 5;
        /// Half bridges are enabled.
        const HALF_BRIDGE_ENABLE = 1 << 6;
        /// Chip select of the encoder.
        const ENCODER_SPI_CS = 1 << 7;
    }
}

#[cfg(test)]
mod tests {
    use super::CanDrvTelemetryFlags as Flags;
    use super::*;
    use crate::Message;

    /// Made by hand from the layout.
    #[test]
    fn telemetry_is_read_by_the_flags_of_its_stream() {
        let payload = [2, 0x34, 0xAD, 0x3B, 0x66, 0x45, 0x1F, 0x27, 0xF0, 0xB3, 0xA6, 0xE8, 0x03, 0x18, 0xFC];
        let flags = Flags::CAN_BUS_FLAGS | Flags::PIN_STATE | Flags::PHASE_CURRENT | Flags::IQ_ID_CURRENT;
        assert_eq!(flags.payload_len(), payload.len());
        let view = CanDrvTelemetryView::decode(&payload).unwrap();
        assert_eq!((view.drv_id, view.timestamp_ms, view.body.len()), (2, 0xAD34, 12));
        assert_eq!(view.encode(&mut [0; 255]), Ok(&payload[..]));
        let telemetry = view.decode_as(flags).unwrap();
        assert_eq!(telemetry.can_bus_flags, Some(0x3B));
        let pins =
            CanDrvPins::INDEX | CanDrvPins::EMERGENCY | CanDrvPins::AUX3 | CanDrvPins::HALF_BRIDGE_ENABLE;
        assert_eq!(telemetry.pin_state, Some(pins));
        assert_eq!(telemetry.phase_current, Some([8005, -4057, -22861]));
        assert_eq!((telemetry.iq_current, telemetry.id_current), (Some(1000), Some(-1000)));
        assert_eq!(telemetry.temp_board, None);
        assert_eq!(telemetry.encode_with(flags, &mut [0; 255]), Ok(&payload[..]));
        assert!(view.decode_as(flags | Flags::PID_CURRENT_ERR).is_err());
        assert_eq!(Flags::all().payload_len(), 35);
    }
}
