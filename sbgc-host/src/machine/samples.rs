//! Which stream a sample belongs to.
//!
//! A sample does not say which registration sent it. What tells those of one command apart is their length, the flags
//! that newer firmware puts in front on request, or the event. Where nothing does, two of them must not run together.

use sbgc_proto::commands::{
    EventTypes, RealtimeDataCustom2Flags, RealtimeDataCustom2Request, RealtimeDataCustomFlags,
    RealtimeDataCustomRequest,
};
use sbgc_proto::{CommandId, Message};

/// What the samples of a stream, or the answers to a request for the same data, look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shape {
    /// Command id of the samples.
    pub command: u8,
    /// Configuration of the stream.
    pub config: [u8; 8],
    /// How many payload bytes a sample has, where that is known.
    pub length: Option<usize>,
}

impl Shape {
    /// The shape of the answer to a request for what can also be streamed.
    pub(super) fn of_request(command: u8, payload: &[u8]) -> Option<Self> {
        let with_flags = |flags: u32, length| {
            let mut config = [0; 8];
            config.iter_mut().zip(flags.to_le_bytes()).for_each(|(place, byte)| *place = byte);
            Some(Self { command, config, length: Some(length) })
        };
        match CommandId::from_raw(command) {
            CommandId::RealtimeDataCustom => {
                let flags = RealtimeDataCustomRequest::decode(payload).ok()?.flags;
                with_flags(flags.bits(), flags.payload_len())
            }
            CommandId::RealtimeDataCustom2 => {
                let flags = RealtimeDataCustom2Request::decode(payload).ok()?.flags;
                with_flags(flags.bits(), flags.payload_len())
            }
            CommandId::AhrsHelper => {
                // Which sensor is in bit 1 of the mode.
                let mut config = [0; 8];
                config[0] = (payload.first()? >> 1) & 1;
                Some(Self { command, config, length: None })
            }
            _ => None,
        }
    }

    /// Whether a sample of this command may belong to the stream.
    pub(super) fn fits(&self, payload: &[u8]) -> bool {
        if let Some(flags) = self.included_flags() {
            return payload.get(2..6) == Some(&flags.to_le_bytes());
        }
        self.admits(payload) && self.length.is_none_or(|length| length == payload.len())
    }

    /// Whether a sample of this command is the stream's if there is no other, whatever its length: firmware leaves out
    /// what it does not know, and whoever reads the sample must learn that.
    pub(super) fn admits(&self, payload: &[u8]) -> bool {
        let [kind, types, ..] = self.config;
        let held = |payload: &[u8]| {
            let wanted = EventTypes::from_bits_retain(types);
            payload.first() == Some(&kind)
                && payload.get(1).is_some_and(|&is| wanted.intersects(EventTypes::from_bits_retain(is)))
        };
        self.command != CommandId::Event.raw() || held(payload)
    }

    /// Whether samples of both can be told apart, or each may go to both.
    pub(super) fn is_distinct_from(&self, other: &Self) -> bool {
        if self.command != other.command || self.config == other.config {
            return true;
        }
        let by_flags = self.included_flags().is_some() && other.included_flags().is_some();
        let by_length = self.length.is_some() && other.length.is_some() && self.length != other.length;
        by_flags || by_length || self.command == CommandId::Event.raw()
    }

    /// The flags that stand in each sample, if they do.
    fn included_flags(&self) -> Option<u32> {
        let flags = u32::from_le_bytes(*self.config.first_chunk()?);
        let included = match CommandId::from_raw(self.command) {
            CommandId::RealtimeDataCustom => RealtimeDataCustomFlags::from_bits_retain(flags)
                .contains(RealtimeDataCustomFlags::INCLUDE_FLAGS),
            CommandId::RealtimeDataCustom2 => RealtimeDataCustom2Flags::from_bits_retain(flags)
                .contains(RealtimeDataCustom2Flags::INCLUDE_FLAGS),
            _ => false,
        };
        included.then_some(flags)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn custom(flags: RealtimeDataCustomFlags) -> Shape {
        let request = RealtimeDataCustomRequest::new(flags).unwrap();
        Shape::of_request(88, request.encode(&mut [0; 10]).unwrap()).unwrap()
    }

    #[test]
    fn selections_are_told_apart_by_length_or_included_flags() {
        use RealtimeDataCustomFlags as Flags;

        let (angles, targets) = (custom(Flags::IMU_ANGLES), custom(Flags::TARGET_ANGLES));
        assert_eq!((angles.length, targets.length), (Some(8), Some(8)));
        assert!(!angles.is_distinct_from(&targets));
        let both = custom(Flags::IMU_ANGLES | Flags::TARGET_ANGLES);
        assert!(angles.is_distinct_from(&both) && angles.fits(&[0; 8]) && !both.fits(&[0; 8]));

        let angles = custom(Flags::IMU_ANGLES | Flags::INCLUDE_FLAGS);
        let targets = custom(Flags::TARGET_ANGLES | Flags::INCLUDE_FLAGS);
        assert!(angles.is_distinct_from(&targets));
        let sample = [9, 9, 1, 0, 0, 0x80, 0, 0, 0, 0, 0, 0];
        assert!(angles.fits(&sample) && !targets.fits(&sample));
    }

    #[test]
    fn events_are_told_apart_by_what_they_are() {
        let event =
            |kind, types| Shape { command: 102, config: [kind, types, 0, 0, 0, 0, 0, 0], length: None };
        let (buttons, motors) = (event(1, 7), event(2, 3));
        assert!(buttons.is_distinct_from(&motors));
        assert!(buttons.fits(&[1, 4, 0, 0]) && !buttons.fits(&[2, 1, 0, 0]) && !motors.fits(&[2, 4, 0, 0]));
    }

    #[test]
    fn sensors_of_an_attitude_cannot_be_told_apart() {
        let stream = |imu| Shape { command: 56, config: [imu, 0, 0, 0, 0, 0, 0, 0], length: None };
        assert!(!stream(0).is_distinct_from(&stream(1)));
        assert_eq!(Shape::of_request(56, &[2]), Some(stream(1)));
    }
}
