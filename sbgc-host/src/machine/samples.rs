//! Which stream a sample belongs to.
//!
//! A sample does not say which registration sent it. What tells those of one command apart is declared with the
//! protocol, see [`Expected::of_stream`]. Where nothing does, two of them must not run together.

use sbgc_proto::commands::{StreamConfig, StreamSource};
use sbgc_proto::{CommandId, Expected};

/// What the samples of a stream, or the answers to a request for the same data, look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shape {
    /// Command id of the samples.
    pub command: u8,
    /// Configuration of the stream.
    pub config: [u8; 8],
    expected: Expected,
    is_periodic: bool,
}

impl Shape {
    /// The shape of a stream of this command with this configuration.
    pub fn new(command: CommandId, config: [u8; 8]) -> Self {
        let source = StreamSource::from_config(command, StreamConfig(config.into()));
        Self {
            command: command.raw(),
            config,
            expected: source.map_or(Expected::any(command), Expected::of_stream),
            is_periodic: source.is_none_or(StreamSource::is_periodic),
        }
    }

    /// The shape of the answer to a request for what can also be streamed.
    pub(super) fn of_request(command: u8, payload: &[u8]) -> Option<Self> {
        let source = StreamSource::of_request(CommandId::from_raw(command), payload)?;
        Some(Self::new(source.cmd_id(), source.config().0.0))
    }

    /// Payload length of a sample in bytes, where that is known.
    pub fn length(&self) -> Option<usize> {
        self.expected.answer_len()
    }

    /// Whether samples come at each interval; events come when something happens.
    pub(super) const fn is_periodic(&self) -> bool {
        self.is_periodic
    }

    /// Whether a sample of this command may belong to the stream.
    pub(super) fn fits(&self, payload: &[u8]) -> bool {
        self.expected.fits(CommandId::from_raw(self.command), payload)
    }

    /// Whether a sample of this command is the stream's if there is no other, whatever it consists of: firmware leaves
    /// out what it does not know, and whoever reads the sample must learn that.
    pub(super) fn admits(&self, payload: &[u8]) -> bool {
        self.is_periodic || self.fits(payload)
    }

    /// Whether samples of both can be told apart, or each may go to both.
    pub(super) fn is_distinct_from(&self, other: &Self) -> bool {
        self.command != other.command
            || self.config == other.config
            || !self.is_periodic
            || self.expected.is_distinct_from(&other.expected)
    }
}

#[cfg(test)]
mod tests {
    use sbgc_proto::Message;
    use sbgc_proto::commands::{RealtimeDataCustomFlags, RealtimeDataCustomRequest};

    use super::*;

    fn custom(flags: RealtimeDataCustomFlags) -> Shape {
        let request = RealtimeDataCustomRequest::new(flags).unwrap();
        Shape::of_request(88, request.encode(&mut [0; 10]).unwrap()).unwrap()
    }

    #[test]
    fn selections_are_told_apart_by_length_or_included_flags() {
        use RealtimeDataCustomFlags as Flags;

        let (angles, targets) = (custom(Flags::IMU_ANGLES), custom(Flags::TARGET_ANGLES));
        assert_eq!((angles.length(), targets.length()), (Some(8), Some(8)));
        assert!(!angles.is_distinct_from(&targets));
        let both = custom(Flags::IMU_ANGLES | Flags::TARGET_ANGLES);
        assert!(angles.is_distinct_from(&both) && angles.fits(&[0; 8]) && !both.fits(&[0; 8]));
        assert!(both.admits(&[0; 8]), "old firmware leaves out what it does not know");

        let angles = custom(Flags::IMU_ANGLES | Flags::INCLUDE_FLAGS);
        let targets = custom(Flags::TARGET_ANGLES | Flags::INCLUDE_FLAGS);
        assert!(angles.is_distinct_from(&targets));
        let sample = [9, 9, 1, 0, 0, 0x80, 0, 0, 0, 0, 0, 0];
        assert!(angles.fits(&sample) && !targets.fits(&sample));
    }

    #[test]
    fn events_are_told_apart_by_what_they_are() {
        let event = |kind, types| Shape::new(CommandId::Event, [kind, types, 0, 0, 0, 0, 0, 0]);
        let (buttons, motors) = (event(1, 7), event(2, 3));
        assert!(buttons.is_distinct_from(&motors) && !buttons.is_periodic());
        assert!(buttons.fits(&[1, 4, 0, 0]) && !buttons.fits(&[2, 1, 0, 0]) && !motors.fits(&[2, 4, 0, 0]));
        assert!(!buttons.admits(&[2, 1, 0, 0]));
        assert!(buttons.is_distinct_from(&event(1, 1)), "an event may go to both");
    }

    #[test]
    fn sensors_of_an_attitude_cannot_be_told_apart() {
        let stream = |imu| Shape::new(CommandId::AhrsHelper, [imu, 0, 0, 0, 0, 0, 0, 0]);
        assert!(!stream(0).is_distinct_from(&stream(1)));
        assert_eq!(Shape::of_request(56, &[2]), Some(stream(1)));
    }
}
