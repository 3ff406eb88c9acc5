//! Messages that the board sends unsolicited: data streams and events.

use sbgc_proto_macros::{message, open_enum, record};

use crate::commands::{
    AhrsHelperModeByte, CanDrvTelemetryFlags, Confirm, ExtMotors, ExtMotorsStateDataSet, ImuIndex,
    RealtimeDataCustom2Flags, RealtimeDataCustom2Request, RealtimeDataCustomFlags, RealtimeDataCustomRequest,
    Switch,
};
use crate::declare::flags;
use crate::units::StreamInterval;
use crate::wire::{Bytes, Reserved};
use crate::{CommandId, Message};

/// Registers, changes or stops a data stream: a message that the board sends periodically or on events.
///
/// Each port has its own streams, identified by command and configuration; all ports together can have ten. Registering
/// the same command and configuration again changes the interval; an interval of 0 stops the stream. If the port is too
/// slow, messages are skipped. The board confirms registrations and changes.
///
/// Registrations are not stored: repeat them after a restart of the board.
///
/// ```
/// use sbgc_proto::commands::{DataStreamInterval, RealtimeDataCustomFlags, StreamSource};
/// use sbgc_proto::units::StreamInterval;
///
/// let source = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::IMU_ANGLES);
/// let request = DataStreamInterval::new(source, StreamInterval(100));
/// assert_eq!(request.source(), Some(source));
/// ```
#[message(CMD_DATA_STREAM_INTERVAL, outgoing, size = 21, since = "2.60", answer = Confirm)]
#[derive(Copy)]
pub struct DataStreamInterval {
    /// Command to send; [`StreamSource`] lists those that can be streamed.
    pub cmd_id: CommandId,
    /// Interval between messages, accurate to ±1 ms and exact on average; 0 stops the stream.
    ///
    /// Events are sent when they occur, with any interval except 0; the interval applies to repeated messages while
    /// something is held.
    pub interval_ms: StreamInterval,
    /// Configuration of the stream, with a layout that depends on the command.
    pub config: StreamConfig,
    /// Whether to synchronize the stream with IMU samples; the interval is then a number of samples.
    #[wire(since = "2.70b1")]
    pub sync_to_data: Switch,
    pub reserved: Reserved<9>,
}

impl DataStreamInterval {
    /// Creates a registration of `source`.
    pub fn new(source: StreamSource, interval_ms: StreamInterval) -> Self {
        Self { cmd_id: source.cmd_id(), interval_ms, config: source.config(), ..Self::default() }
    }

    /// Whether both registrations refer to the same stream of a port, so that the second changes or stops the first.
    ///
    /// Streams are identified by the command and all bytes of the configuration.
    pub fn is_same_stream(&self, other: &Self) -> bool {
        (self.cmd_id, self.config) == (other.cmd_id, other.config)
    }

    /// Returns the message that stops this stream.
    #[must_use]
    pub fn to_stop(&self) -> Self {
        Self { cmd_id: self.cmd_id, config: self.config, ..Self::default() }
    }

    /// Stream source; `None` if the command cannot be streamed.
    pub fn source(&self) -> Option<StreamSource> {
        StreamSource::from_config(self.cmd_id, self.config)
    }
}

/// Configuration of a data stream. All bytes count for its identity, even those that the command does not use.
#[record(size = 8)]
#[derive(Copy, Hash)]
pub struct StreamConfig(pub Bytes<8>);

impl StreamConfig {
    fn new<const N: usize>(bytes: [u8; N]) -> Self {
        let mut config = Self::default();
        config.0.0.iter_mut().zip(bytes).for_each(|(place, byte)| *place = byte);
        config
    }
}

/// Source of a data stream: a command and its typed configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum StreamSource {
    /// [`RealtimeData3`](super::RealtimeData3).
    RealtimeData3,
    /// [`RealtimeData4`](super::RealtimeData4).
    RealtimeData4,
    /// [`RealtimeDataCustom`](super::RealtimeDataCustom) with the fields that these flags select.
    RealtimeDataCustom(RealtimeDataCustomFlags),
    /// [`AhrsHelper`](super::AhrsHelper) of this IMU. IMUs are numbered from 0, as in the specification; some libraries
    /// number them from 1.
    AhrsHelper(ImuIndex),
    /// [`BoardEvent`]. Firmware 2.65b7+.
    Event {
        /// Event kind.
        event_id: EventId,
        /// Event phases to report.
        event_type: EventTypes,
    },
    /// [`CanDrvTelemetry`](super::CanDrvTelemetry) with the fields that these flags select. Firmware 2.72b0+ on boards
    /// of the extended family.
    CanDrvTelemetry {
        /// Flags that select the fields of the messages.
        flags: CanDrvTelemetryFlags,
        /// Driver to report. Sources do not specify whether this is a number from 0 to 6, as in the message, or a set
        /// of bits.
        drv_id: u8,
    },
    /// [`ExtMotorsState`](super::ExtMotorsState) of these motors. Firmware 2.73+.
    ExtMotorsState {
        /// Motors to report.
        for_motors: ExtMotors,
        /// Flags that select the fields of the messages.
        data_set: ExtMotorsStateDataSet,
    },
    /// [`RealtimeDataCustom2`](super::RealtimeDataCustom2) with the fields that these flags select. Firmware 2.74.2+.
    RealtimeDataCustom2(RealtimeDataCustom2Flags),
}

impl StreamSource {
    /// Interprets a command id and configuration; `None` if the command cannot be streamed. Bytes of the configuration
    /// that the command does not use are ignored.
    pub fn from_config(cmd_id: CommandId, config: StreamConfig) -> Option<Self> {
        let [first, second, third, fourth, fifth, ..] = config.0.0;
        let flags = u32::from_le_bytes([first, second, third, fourth]);
        Some(match cmd_id {
            CommandId::RealtimeData3 => Self::RealtimeData3,
            CommandId::RealtimeData4 => Self::RealtimeData4,
            CommandId::RealtimeDataCustom => {
                Self::RealtimeDataCustom(RealtimeDataCustomFlags::from_bits_retain(flags))
            }
            CommandId::AhrsHelper => Self::AhrsHelper(first.into()),
            CommandId::Event => {
                Self::Event { event_id: first.into(), event_type: EventTypes::from_bits_retain(second) }
            }
            CommandId::CanDrvTelemetry => {
                Self::CanDrvTelemetry { flags: CanDrvTelemetryFlags::from_bits_retain(flags), drv_id: fifth }
            }
            CommandId::ExtMotorsState => Self::ExtMotorsState {
                for_motors: ExtMotors::from_bits_retain(first),
                data_set: ExtMotorsStateDataSet::from_bits_retain(u32::from_le_bytes([
                    second, third, fourth, fifth,
                ])),
            },
            CommandId::RealtimeDataCustom2 => {
                Self::RealtimeDataCustom2(RealtimeDataCustom2Flags::from_bits_retain(flags))
            }
            _ => return None,
        })
    }

    /// The stream whose messages look like the answer to the request with this id and payload; `None` if there is none.
    pub fn of_request(command: CommandId, payload: &[u8]) -> Option<Self> {
        match command {
            CommandId::RealtimeDataCustom => {
                let request = RealtimeDataCustomRequest::decode(payload).ok()?;
                Some(Self::RealtimeDataCustom(request.flags))
            }
            CommandId::RealtimeDataCustom2 => {
                let request = RealtimeDataCustom2Request::decode(payload).ok()?;
                Some(Self::RealtimeDataCustom2(request.flags))
            }
            CommandId::AhrsHelper => {
                // The mode comes first in each form.
                let mode = AhrsHelperModeByte(*payload.first()?);
                Some(Self::AhrsHelper(if mode.frame_imu() { ImuIndex::Frame } else { ImuIndex::Main }))
            }
            _ => None,
        }
    }

    /// Whether messages come at each interval; otherwise only when something happens.
    pub const fn is_periodic(self) -> bool {
        !matches!(self, Self::Event { .. })
    }

    /// Command that the board sends.
    pub fn cmd_id(self) -> CommandId {
        match self {
            Self::RealtimeData3 => CommandId::RealtimeData3,
            Self::RealtimeData4 => CommandId::RealtimeData4,
            Self::RealtimeDataCustom(_) => CommandId::RealtimeDataCustom,
            Self::AhrsHelper(_) => CommandId::AhrsHelper,
            Self::Event { .. } => CommandId::Event,
            Self::CanDrvTelemetry { .. } => CommandId::CanDrvTelemetry,
            Self::ExtMotorsState { .. } => CommandId::ExtMotorsState,
            Self::RealtimeDataCustom2(_) => CommandId::RealtimeDataCustom2,
        }
    }

    /// Number of payload bytes of each message; `None` if it varies.
    ///
    /// The length is all that distinguishes the messages of two streams of one command with different flags.
    pub fn payload_len(self) -> Option<usize> {
        match self {
            Self::RealtimeDataCustom(flags) => Some(flags.payload_len()),
            Self::RealtimeDataCustom2(flags) => Some(flags.payload_len()),
            Self::CanDrvTelemetry { flags, .. } => Some(flags.payload_len()),
            _ => None,
        }
    }

    /// Configuration as on the wire.
    pub fn config(self) -> StreamConfig {
        match self {
            Self::RealtimeData3 | Self::RealtimeData4 => StreamConfig::default(),
            Self::RealtimeDataCustom(flags) => StreamConfig::new(flags.bits().to_le_bytes()),
            Self::AhrsHelper(imu) => StreamConfig::new([imu.raw()]),
            Self::Event { event_id, event_type } => StreamConfig::new([event_id.raw(), event_type.bits()]),
            Self::CanDrvTelemetry { flags, drv_id } => {
                let [a, b, c, d] = flags.bits().to_le_bytes();
                StreamConfig::new([a, b, c, d, drv_id])
            }
            Self::ExtMotorsState { for_motors, data_set } => {
                let [a, b, c, d] = data_set.bits().to_le_bytes();
                StreamConfig::new([for_motors.bits(), a, b, c, d])
            }
            Self::RealtimeDataCustom2(flags) => StreamConfig::new(flags.bits().to_le_bytes()),
        }
    }
}

/// Reports an event.
///
/// Sent only to ports that registered it with [`DataStreamInterval`].
#[message(CMD_EVENT, incoming, size = 4..=255, since = "2.65")]
#[derive(Copy)]
pub struct BoardEvent<'a> {
    /// Event kind.
    pub event_id: EventId,
    /// Event phase. For the camera, these bits have other names.
    pub event_type: EventTypes,
    /// Event parameter.
    ///
    /// For a menu button held or released, the holding time in milliseconds. For a script, its slot, counted from 0.
    pub param1: u16,
    /// Further parameters, which future firmware may add.
    pub extra: &'a [u8],
}

/// Event kind. Spec: `EVENT_ID`.
#[open_enum(u8, prefix = "EVENT_ID_")]
pub enum EventId {
    /// The menu button was released, pressed or held.
    MenuButton = 1,
    /// The motors were turned off or on.
    MotorState = 2,
    /// An emergency stop ended or began.
    EmergencyStop = 3,
    /// The menu command "Camera Rec/Photo event" or "Camera photo event" was run.
    Camera = 4,
    /// A script finished or started.
    #[wire(since = "2.68b8")]
    Script = 5,
    /// The retracted position was left or reached.
    #[wire(since = "2.73.1")]
    RetractedPosition = 6,
}

flags! {
    /// Event phases: one bit in an event, any combination in the configuration of a stream. Spec: `EVENT_TYPE`.
    pub struct EventTypes: u8, prefix "EVENT_TYPE_" {
        /// End: released or off. For the camera, this is [`REC_PHOTO`](Self::REC_PHOTO).
        const OFF = 1 << 0;
        /// Start: pressed or on. For the camera, this is [`PHOTO`](Self::PHOTO).
        const ON = 1 << 1;
        /// Continuation: held.
        const HOLD = 1 << 2;
    }
}

impl EventTypes {
    /// Recording or photo, with [`EventId::Camera`]. Spec: `EVENT_TYPE_REC_PHOTO`.
    pub const REC_PHOTO: Self = Self::OFF;
    /// Photo, with [`EventId::Camera`]. Spec: `EVENT_TYPE_PHOTO`, which the specification prints as a second
    /// `EVENT_TYPE_REC_PHOTO`.
    pub const PHOTO: Self = Self::ON;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Made by hand from the layout.
    #[test]
    fn a_stream_is_registered_with_what_it_sends() {
        let mut payload = [0; 21];
        payload[..4].copy_from_slice(&[0x58, 0x64, 0x00, 0x09]);
        let flags = RealtimeDataCustomFlags::IMU_ANGLES | RealtimeDataCustomFlags::STATOR_ROTOR_ANGLE;
        let source = StreamSource::RealtimeDataCustom(flags);
        let request = DataStreamInterval::new(source, StreamInterval::from_milliseconds(100.0));
        assert_eq!(request.encode(&mut [0; 21]), Ok(&payload[..]));
        assert_eq!(DataStreamInterval::decode(&payload), Ok(request));
        assert_eq!(request.source(), Some(source));
        assert!(DataStreamInterval::decode(&payload[..20]).is_err());
    }

    #[test]
    fn every_byte_of_a_configuration_is_kept() {
        let mut payload = [0xA5; 21];
        for id in 0..=255 {
            payload[0] = id;
            let request = DataStreamInterval::decode(&payload).unwrap();
            assert_eq!(request.encode(&mut [0; 21]), Ok(&payload[..]));
            if let Some(source) = request.source() {
                assert_eq!(StreamSource::from_config(source.cmd_id(), source.config()), Some(source));
                let (used, kept) = (source.config().0.0, request.config.0.0);
                assert!(used.into_iter().zip(kept).all(|(used, kept)| used == kept || used == 0));
            }
        }
    }

    /// Made by hand from the layout.
    #[test]
    fn configurations_are_laid_out_by_command() {
        let config = |source: StreamSource| (source.cmd_id().raw(), source.config().0.0);
        let event = StreamSource::Event {
            event_id: EventId::MenuButton,
            event_type: EventTypes::OFF | EventTypes::HOLD,
        };
        assert_eq!(config(event), (102, [1, 5, 0, 0, 0, 0, 0, 0]));
        assert_eq!(config(StreamSource::AhrsHelper(ImuIndex::Frame)), (56, [1, 0, 0, 0, 0, 0, 0, 0]));
        let flags = CanDrvTelemetryFlags::from_bits_retain(0x0403_0201);
        let telemetry = StreamSource::CanDrvTelemetry { flags, drv_id: 6 };
        assert_eq!(config(telemetry), (127, [1, 2, 3, 4, 6, 0, 0, 0]));
        let motors = StreamSource::ExtMotorsState {
            for_motors: ExtMotors::from_bits_retain(0x7F),
            data_set: ExtMotorsStateDataSet::from_bits_retain(0x0403_0201),
        };
        assert_eq!(config(motors), (131, [0x7F, 1, 2, 3, 4, 0, 0, 0]));
        let custom2 = StreamSource::RealtimeDataCustom2(RealtimeDataCustom2Flags::DEBUG);
        assert_eq!(config(custom2), (139, [8, 0, 0, 0, 0, 0, 0, 0]));
    }

    /// Made by hand from the layout.
    #[test]
    fn events_may_grow() {
        let event = BoardEvent::decode(&[2, 2, 0, 0]).unwrap();
        assert_eq!((event.event_id, event.event_type), (EventId::MotorState, EventTypes::ON));
        let payload = [1, 0x84, 0xE8, 0x03, 7, 8];
        let event = BoardEvent::decode(&payload).unwrap();
        assert_eq!(event.event_type, EventTypes::HOLD | EventTypes::from_bits_retain(0x80));
        assert_eq!((event.param1, event.extra), (1000, &[7, 8][..]));
        assert_eq!(event.encode(&mut [0; 6]), Ok(&payload[..]));
        assert!(BoardEvent::decode(&payload[..3]).is_err());
    }
}
