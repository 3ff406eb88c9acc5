//! Messages whose fields the request or the data stream has chosen: how long they are, and reading them late.

use crate::wire::{FromWire, ToWire, Writer};
use crate::{DecodeError, Message};

/// Zeros for the longest message that any choice makes.
static ZEROS: [u8; 512] = [0; 512];

/// Number of payload bytes of a message with the fields that `choice` selects.
pub(in crate::commands) fn payload_len<M, C>(choice: C) -> usize
where
    M: FromWire<'static, C>,
{
    const { assert!(M::MAX_LEN <= ZEROS.len()) };
    let rest = M::read(&ZEROS, choice).map_or(0, |(rest, _)| rest.len());
    ZEROS.len() - rest
}

/// Decodes again, with the choice, a message that was decoded without.
pub(in crate::commands) fn decode_view<M, C>(view: &impl ToWire, choice: C) -> Result<M, DecodeError>
where
    M: Message + for<'b> FromWire<'b, C>,
{
    let mut payload = [0; 255];
    let mut writer = Writer::new(&mut payload);
    // What does not fit a payload did not come in one, and is missed below.
    let _ = view.write((), &mut writer);
    let length = writer.len();
    M::decode_with(payload.get(..length).unwrap_or_default(), choice).map(|(message, _)| message)
}
