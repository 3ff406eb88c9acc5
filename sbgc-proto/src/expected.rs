//! Matching answers to requests.
//!
//! The protocol has no sequence numbers. What tells one answer from another is its command id and, for some, what it
//! repeats of the request: the confirmed command, the profile, the address.

use crate::echo::Echo;
use crate::frame::MAX_PAYLOAD;
use crate::message::Request;
use crate::wire::ToWire;
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Expected {
    answer: CommandId,
    /// The command that a confirmation must name.
    confirmed: Option<CommandId>,
    echo: &'static [Echo],
    /// The front of the request.
    request: [u8; KEPT],
    length: u8,
}

impl Expected {
    /// Returns the expected answer to `request`.
    pub fn of<Q: Request + ToWire>(request: &Q) -> Self {
        let mut payload = [0; MAX_PAYLOAD];
        let request = match Q::REQUEST.echo {
            [] => &[],
            // What cannot be written cannot be sent either.
            _ => request.encode(&mut payload).unwrap_or_default(),
        };
        Self::of_info(Q::ID, Q::REQUEST, <Q::Answer<'static> as crate::Message>::ID, request)
    }

    /// Returns the expected answer to a request that was encoded already.
    pub(crate) fn of_encoded<Q: Request>(payload: &[u8]) -> Self {
        Self::of_info(Q::ID, Q::REQUEST, <Q::Answer<'static> as crate::Message>::ID, payload)
    }

    /// Returns the expected answer to the request with this id and payload; `None` if none is declared or
    /// certain.
    pub fn of_payload(command: CommandId, payload: &[u8]) -> Option<Self> {
        let info = RequestInfo::of_payload(command, payload)?;
        Some(Self::of_info(command, info, info.answer?, payload))
    }

    /// Expects any message with this id.
    pub const fn any(answer: CommandId) -> Self {
        Self { answer, confirmed: None, echo: &[], request: [0; KEPT], length: 0 }
    }

    /// Expects the confirmation of a command, with any data.
    pub const fn confirmation(command: CommandId) -> Self {
        Self { confirmed: Some(command), ..Self::any(CommandId::CONFIRM) }
    }

    fn of_info(command: CommandId, info: RequestInfo, answer: CommandId, payload: &[u8]) -> Self {
        let confirmed = (answer == CommandId::CONFIRM).then_some(command);
        let mut expected = Self { confirmed, echo: info.echo, ..Self::any(answer) };
        if !info.echo.is_empty() {
            for (kept, byte) in expected.request.iter_mut().zip(payload) {
                *kept = *byte;
                expected.length += 1;
            }
        }
        expected
    }

    /// Command id of the answer.
    pub const fn answer(&self) -> CommandId {
        self.answer
    }

    /// Whether a message is the answer.
    ///
    /// A message that ends before the repeated bytes matches: boards report some errors that way.
    pub fn matches(&self, id: CommandId, payload: &[u8]) -> bool {
        let confirms = || match (self.confirmed, payload.first()) {
            (Some(command), Some(&confirmed)) => command.raw() == confirmed,
            _ => true,
        };
        id == self.answer && confirms() && self.echo.iter().all(|echo| echo.admits(self.request(), payload))
    }

    /// Whether one message could answer both.
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

    fn request(&self) -> &[u8] {
        self.request.get(..usize::from(self.length)).unwrap_or_default()
    }
}
