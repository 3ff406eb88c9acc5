//! Matching answers to requests.
//!
//! The protocol has no sequence numbers. What tells one answer from another is its command id and, for some, what it
//! repeats of the request: the confirmed command, the profile, the address. Where the request selects the fields of the
//! answer, its length tells too.

use crate::commands::{BoardEvent, RealtimeDataCustom2Request, RealtimeDataCustomRequest, StreamSource};
use crate::echo::Echo;
use crate::frame::MAX_PAYLOAD;
use crate::message::Request;
use crate::wire::{Layout, Slot, ToWire};
use crate::{CommandId, RequestInfo};

/// The bytes of a request that can come back: a count and forty ids, the longest of all.
const KEPT: usize = 41;

/// Distinguishes the answer to a request from other messages.
///
/// ```
/// use sbgc_proto::commands::{ProfileId, ReadParams3};
/// use sbgc_proto::{CommandId, Expected};
///
/// let expected = Expected::of(&ReadParams3 { profile_id: ProfileId::Profile2 });
/// assert!(expected.matches(CommandId::ReadParams3, &[1, 10, 20]));
/// assert!(!expected.matches(CommandId::ReadParams3, &[0, 10, 20]), "another profile");
///
/// let another = Expected::of(&ReadParams3 { profile_id: ProfileId::Profile1 });
/// assert!(!expected.overlaps(&another));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Expected {
    answer: CommandId,
    /// The command that a confirmation must name.
    confirmed: Option<CommandId>,
    echo: &'static [Echo],
    /// The front of the request.
    request: [u8; KEPT],
    /// How much of that is used.
    request_len: u8,
    /// Payload bytes of the answer.
    answer_len: Option<u16>,
}

impl Expected {
    /// Returns the expected answer to `request`.
    pub fn of<Q: Request + ToWire>(request: &Q) -> Self {
        let mut payload = [0; MAX_PAYLOAD];
        let encoded = match Q::REQUEST.echo {
            [] => &[],
            // What cannot be written cannot be sent either.
            _ => request.encode(&mut payload).unwrap_or_default(),
        };
        Self::of_encoded::<Q>(encoded).with_len(request.answer_len())
    }

    /// Returns the expected answer to a request that was encoded already, with any length.
    pub(crate) fn of_encoded<Q: Request>(payload: &[u8]) -> Self {
        Self::of_info(Q::ID, Q::REQUEST, <Q::Answer<'static> as crate::Message>::ID, payload)
    }

    /// Returns the expected answer to the request with this id and payload; `None` if none is declared or
    /// certain.
    pub fn of_payload(command: CommandId, payload: &[u8]) -> Option<Self> {
        let info = RequestInfo::of_payload(command, payload)?;
        let expected = Self::of_info(command, info, info.answer?, payload);
        Some(expected.with_len((info.answer_len)(payload)))
    }

    /// Returns the expected messages of a data stream.
    ///
    /// ```
    /// use sbgc_proto::commands::{EventId, EventTypes, StreamSource};
    /// use sbgc_proto::{CommandId, Expected};
    ///
    /// let source = StreamSource::Event { event_id: EventId::MenuButton, event_type: EventTypes::OFF };
    /// let expected = Expected::of_stream(source);
    /// assert!(expected.matches(CommandId::Event, &[1, 1, 0, 0]));
    /// assert!(!expected.matches(CommandId::Event, &[1, 2, 0, 0]), "the button was pressed");
    /// ```
    pub fn of_stream(source: StreamSource) -> Self {
        // The configuration is the front of the message.
        const KIND: Slot = Slot::find(BoardEvent::SLOTS, "event_id");
        const PHASE: Slot = Slot::find(BoardEvent::SLOTS, "event_type");
        const EVENT: &[Echo] = &[Echo::same(KIND, KIND), Echo::any_of(PHASE, PHASE)];
        match source {
            StreamSource::RealtimeDataCustom(flags) => {
                Self::of(&RealtimeDataCustomRequest { flags, ..Default::default() })
            }
            StreamSource::RealtimeDataCustom2(flags) => {
                Self::of(&RealtimeDataCustom2Request { flags, ..Default::default() })
            }
            StreamSource::Event { event_id, event_type } => {
                Self { echo: EVENT, ..Self::any(CommandId::Event) }
                    .with_request(&[event_id.raw(), event_type.bits()])
            }
            _ => Self::any(source.cmd_id()).with_len(source.payload_len()),
        }
    }

    /// Expects any message with this id.
    pub const fn any(answer: CommandId) -> Self {
        Self { answer, confirmed: None, echo: &[], request: [0; KEPT], request_len: 0, answer_len: None }
    }

    /// Expects the confirmation of a command, with any data.
    pub const fn confirmation(command: CommandId) -> Self {
        Self { confirmed: Some(command), ..Self::any(CommandId::CONFIRM) }
    }

    fn of_info(command: CommandId, info: RequestInfo, answer: CommandId, payload: &[u8]) -> Self {
        let confirmed = (answer == CommandId::CONFIRM).then_some(command);
        let expected = Self { confirmed, echo: info.echo, ..Self::any(answer) };
        if info.echo.is_empty() { expected } else { expected.with_request(payload) }
    }

    fn with_request(mut self, payload: &[u8]) -> Self {
        for (kept, byte) in self.request.iter_mut().zip(payload) {
            *kept = *byte;
            self.request_len += 1;
        }
        self
    }

    fn with_len(self, length: Option<usize>) -> Self {
        Self { answer_len: length.and_then(|length| length.try_into().ok()), ..self }
    }

    /// Command id of the answer.
    pub const fn answer(&self) -> CommandId {
        self.answer
    }

    /// Number of payload bytes of the answer; `None` if it varies.
    pub fn answer_len(&self) -> Option<usize> {
        self.answer_len.map(usize::from)
    }

    /// Whether a message is the answer, whatever its length.
    ///
    /// A message that ends before the repeated bytes matches: boards report some errors that way. Firmware leaves out
    /// what it does not know, so a message of another length than [`answer_len`](Self::answer_len) may be the answer.
    pub fn matches(&self, id: CommandId, payload: &[u8]) -> bool {
        let confirms = || match (self.confirmed, payload.first()) {
            (Some(command), Some(&confirmed)) => command.raw() == confirmed,
            _ => true,
        };
        id == self.answer && confirms() && self.echo.iter().all(|echo| echo.admits(self.request(), payload))
    }

    /// Whether a message is the answer and has its length, unless it names its fields itself.
    ///
    /// ```
    /// use sbgc_proto::commands::{RealtimeDataCustomFlags as Flags, RealtimeDataCustomRequest};
    /// use sbgc_proto::{CommandId, Expected};
    ///
    /// let expected = Expected::of(&RealtimeDataCustomRequest { flags: Flags::IMU_ANGLES, ..Default::default() });
    /// assert!(expected.fits(CommandId::RealtimeDataCustom, &[0; 8]));
    /// assert!(!expected.fits(CommandId::RealtimeDataCustom, &[0; 14]), "other fields");
    /// ```
    pub fn fits(&self, id: CommandId, payload: &[u8]) -> bool {
        let names_fields = || self.echo.iter().any(|echo| echo.names_fields(self.request()));
        self.matches(id, payload)
            && (self.answer_len().is_none_or(|length| length == payload.len()) || names_fields())
    }

    /// Whether one message could answer both, whatever its length.
    pub fn overlaps(&self, other: &Self) -> bool {
        if self.answer != other.answer {
            return false;
        }
        if let (Some(one), Some(other)) = (self.confirmed, other.confirmed)
            && one != other
        {
            return false;
        }
        let apart = |echo: &Echo| other.echo.contains(echo) && echo.excludes(self.request(), other.request());
        !self.echo.iter().any(apart)
    }

    /// Whether no message could [fit](Self::fits) both.
    pub fn is_distinct_from(&self, other: &Self) -> bool {
        let differ = matches!((self.answer_len, other.answer_len), (Some(one), Some(other)) if one != other);
        differ || !self.overlaps(other)
    }

    fn request(&self) -> &[u8] {
        self.request.get(..usize::from(self.request_len)).unwrap_or_default()
    }
}
