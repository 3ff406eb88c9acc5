//! What motor drivers on the CAN bus report.

use sbgc_proto_macros::message;

use self::CanDrvTelemetryFlags as Flags;
use super::realtime::decode_view;
use crate::DecodeError;
use crate::wire::{FromWire, Layout, flags};

flags! {
    /// What telemetry of a CAN motor driver holds. Spec: `CAN_DRV_TELEMETRY_FLAGS`.
    pub struct CanDrvTelemetryFlags: u32 {
        /// State of the CAN bus.
        const CAN_BUS_FLAGS = 1 << 0;
        /// Errors of the CAN bus.
        const CAN_BUS_ERR_CNT = 1 << 1;
        /// Temperature of the board.
        const TEMP_BOARD = 1 << 2;
        /// Temperature of the motor.
        const TEMP_MOTOR = 1 << 3;
        /// Current that the driver takes.
        const AVG_CURRENT = 1 << 4;
        /// Voltage that the driver gets.
        const BUS_VOLTAGE = 1 << 5;
        /// Levels of its pins.
        const PIN_STATE = 1 << 6;
        /// Current of each phase.
        const PHASE_CURRENT = 1 << 7;
        /// Errors of the encoder.
        const ENCODER_ERROR_CNT = 1 << 8;
        /// Currents along the rotor and across.
        const IQ_ID_CURRENT = 1 << 9;
        /// Speed of the motor.
        const MOTOR_SPEED = 1 << 10;
        /// Error of the position loop.
        const PID_POS_ERR = 1 << 11;
        /// Error of the speed loop.
        const PID_SPEED_ERR = 1 << 12;
        /// Current that the loops ask for.
        const IQ_REF = 1 << 13;
        /// Error of the current loop.
        const PID_CURRENT_ERR = 1 << 14;
    }
}

impl CanDrvTelemetryFlags {
    /// How many bytes a message has: those of [`CanDrvTelemetry`] with these flags.
    pub fn payload_len(self) -> usize {
        const ZEROS: &[u8] = &[0; <CanDrvTelemetry as Layout>::MAX_LEN];
        let rest = CanDrvTelemetry::read(ZEROS, self).map_or(0, |(rest, _)| rest.len());
        ZEROS.len() - rest
    }
}

/// Telemetry of a motor driver on the CAN bus, sent as a data stream only.
///
/// The message does not say what it holds: read it with the flags of the stream. The fields that were not chosen are
/// `None`. The widths of the fields are those that a third-party library
/// takes from a newer specification.
#[message(
    CMD_CAN_DRV_TELEMETRY, incoming, size = 3..=35, since = "2.72b0", context(selection: CanDrvTelemetryFlags)
)]
#[derive(Copy)]
pub struct CanDrvTelemetry {
    /// Which driver.
    #[wire(range = 0..=6)]
    pub drv_id: u8,
    /// The board's time, which starts again after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// State of the CAN bus; its flags are not published.
    #[wire(when = selection.contains(Flags::CAN_BUS_FLAGS))]
    pub can_bus_flags: Option<u8>,
    /// Errors of the CAN bus.
    #[wire(when = selection.contains(Flags::CAN_BUS_ERR_CNT))]
    pub can_bus_err_cnt: Option<u16>,
    /// Temperature of the board.
    #[wire(when = selection.contains(Flags::TEMP_BOARD), unit = "degC")]
    pub temp_board: Option<i8>,
    /// Temperature of the motor.
    #[wire(when = selection.contains(Flags::TEMP_MOTOR), unit = "degC")]
    pub temp_motor: Option<i8>,
    /// Current that the driver takes, averaged.
    #[wire(when = selection.contains(Flags::AVG_CURRENT), unit = "mA")]
    pub avg_current: Option<u16>,
    /// Voltage that the driver gets.
    #[wire(when = selection.contains(Flags::BUS_VOLTAGE), unit = "mV")]
    pub bus_voltage: Option<u16>,
    /// Levels of its pins.
    #[wire(when = selection.contains(Flags::PIN_STATE))]
    pub pin_state: Option<CanDrvPins>,
    /// Current of each phase.
    #[wire(when = selection.contains(Flags::PHASE_CURRENT), unit = "mA")]
    pub phase_current: Option<[i16; 3]>,
    /// Errors of the encoder.
    #[wire(when = selection.contains(Flags::ENCODER_ERROR_CNT))]
    pub encoder_error_cnt: Option<u16>,
    /// Current across the rotor, which makes torque.
    #[wire(when = selection.contains(Flags::IQ_ID_CURRENT), unit = "mA")]
    pub iq_current: Option<i16>,
    /// Current along the rotor.
    #[wire(when = selection.contains(Flags::IQ_ID_CURRENT), unit = "mA")]
    pub id_current: Option<i16>,
    /// Speed of the motor.
    #[wire(when = selection.contains(Flags::MOTOR_SPEED), unit = "rpm")]
    pub motor_speed: Option<i16>,
    /// Error of the position loop.
    #[wire(when = selection.contains(Flags::PID_POS_ERR))]
    pub pid_pos_err: Option<i16>,
    /// Error of the speed loop.
    #[wire(when = selection.contains(Flags::PID_SPEED_ERR))]
    pub pid_speed_err: Option<i16>,
    /// Current that the loops ask for; 32768 would be all there is.
    #[wire(when = selection.contains(Flags::IQ_REF))]
    pub iq_ref: Option<i16>,
    /// Error of the current loop.
    #[wire(when = selection.contains(Flags::PID_CURRENT_ERR))]
    pub pid_current_err: Option<i16>,
}

/// Telemetry of a motor driver on the CAN bus, of which the choice is not known.
#[message(CMD_CAN_DRV_TELEMETRY, incoming, size = 3..=255, since = "2.72b0")]
#[derive(Copy)]
pub struct CanDrvTelemetryView<'a> {
    /// Which driver.
    #[wire(range = 0..=6)]
    pub drv_id: u8,
    /// The board's time, which starts again after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// The chosen data.
    pub body: &'a [u8],
}

impl CanDrvTelemetryView<'_> {
    /// Reads the data that `flags` choose.
    ///
    /// # Errors
    /// When it has less than that.
    pub fn decode_as(&self, flags: CanDrvTelemetryFlags) -> Result<CanDrvTelemetry, DecodeError> {
        decode_view(self, flags)
    }
}

flags! {
    /// Levels of the pins of a CAN motor driver. Spec: `CAN_DRV_PIN_STATE`.
    pub struct CanDrvPins: u8 {
        /// Limit switch.
        const LIMIT = 1 << 0;
        /// Index of the encoder.
        const INDEX = 1 << 1;
        /// Emergency input.
        const EMERGENCY = 1 << 2;
        /// Auxiliary pin 1.
        const AUX1 = 1 << 3;
        /// Auxiliary pin 2.
        const AUX2 = 1 << 4;
        /// Auxiliary pin 3.
        const AUX3 = 1 << 5;
        /// The half bridges are on.
        const HALF_BRIDGE_ENABLE = 1 << 6;
        /// The encoder is selected.
        const ENCODER_SPI_CS = 1 << 7;
    }
}

#[cfg(test)]
mod tests {
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
