//! Messages as such: what every declared payload can do, and how one is put into a frame.

use core::ops::RangeInclusive;

use crate::frame::{self, Version};
use crate::wire::{Fault, FromWire, Layout, ToWire, Writer};
use crate::{CommandId, DecodeError, Direction, EncodeError, RequestInfo};

/// The payload of one command in one form.
///
/// ```
/// use sbgc_proto::commands::BoardInfo;
/// use sbgc_proto::Message;
///
/// let payload = [30, 0x01, 0x09, 0x04, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
/// let info = BoardInfo::decode(&payload)?;
/// assert_eq!(info.board_ver.number(), 3.0);
/// assert_eq!(info.firmware_ver.to_string(), "2.30b5");
///
/// let mut buffer = [0; 18];
/// assert_eq!(info.encode(&mut buffer), Ok(&payload[..]));
/// # Ok::<(), sbgc_proto::DecodeError>(())
/// ```
pub trait Message: Layout {
    /// The command's id.
    const ID: CommandId;
    /// Which way it goes.
    const DIRECTION: Direction;
    /// The spec's name of the command.
    const SPEC: &'static str;
    /// The name of the form; `full` where there is one only.
    const FORM: &'static str;
    /// Whether it is, of all forms, the one to build unless another is asked for: never one that deletes or
    /// reconfigures by what it leaves out.
    const IS_DEFAULT: bool;
    /// The first firmware that knows it; empty when that is not known or the first of all.
    const SINCE: &'static str;
    /// What it is for, in a sentence.
    const SUMMARY: &'static str;
    /// How many bytes the payload has.
    const SIZE: RangeInclusive<usize>;
    /// What answers it and what it does; of messages from the board, nothing.
    const REQUEST: RequestInfo = RequestInfo::NONE;

    /// Whether a payload of `length` bytes has this form. Where an id has one form only, all have.
    fn accepts(length: usize) -> bool {
        let _ = length;
        true
    }

    /// Reads a payload. Bytes that newer firmware has added at its end are passed over.
    ///
    /// # Errors
    /// When the payload is too short.
    fn decode<'a>(payload: &'a [u8]) -> Result<Self, DecodeError>
    where
        Self: FromWire<'a>,
    {
        Self::decode_prefix(payload).map(|(message, _)| message)
    }

    /// Reads a payload and returns what follows the known part.
    ///
    /// # Errors
    /// When the payload is too short.
    fn decode_prefix<'a>(payload: &'a [u8]) -> Result<(Self, &'a [u8]), DecodeError>
    where
        Self: FromWire<'a>,
    {
        Self::decode_with(payload, ())
    }

    /// Reads a payload with what must be known besides it, and returns what follows the known part.
    ///
    /// # Errors
    /// When the payload is too short.
    fn decode_with<'a, C>(payload: &'a [u8], context: C) -> Result<(Self, &'a [u8]), DecodeError>
    where
        Self: FromWire<'a, C>,
    {
        let too_short =
            DecodeError::TooShort { command: Self::SPEC, needed: Self::MIN_LEN, got: payload.len() };
        let Some(rest) = payload.get(Self::MIN_LEN..) else { return Err(too_short) };
        // No name of a field is needed where only the length of the whole can be wrong.
        if Self::FIXED {
            return Self::read_fixed(payload, context).map(|message| (message, rest)).ok_or(too_short);
        }
        match Self::read(payload, context) {
            Ok((rest, message)) => Ok((message, rest)),
            Err(fault) => Err(explain(Self::SPEC, payload.len(), &fault)),
        }
    }

    /// Writes the payload to the front of `out` and returns it.
    ///
    /// # Errors
    /// When it does not fit, or the message contradicts itself.
    fn encode<'o>(&self, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError>
    where
        Self: ToWire,
    {
        self.encode_with((), out)
    }

    /// Writes the payload of a message that is read with a context.
    ///
    /// # Errors
    /// When it does not fit, or the message contradicts itself or the context.
    fn encode_with<'o, C>(&self, context: C, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError>
    where
        Self: ToWire<C>,
    {
        let mut writer = Writer::new(out);
        write_message(self, context, &mut writer)?;
        let length = writer.len();
        Ok(out.get(..length).unwrap_or_default())
    }

    /// Writes the whole frame to the front of `out` and returns it.
    ///
    /// ```
    /// use sbgc_proto::commands::ReadParams;
    /// use sbgc_proto::{Message, frame::Version};
    ///
    /// let mut buffer = [0; 64];
    /// let frame = ReadParams { profile_id: 1.into() }.encode_frame(Version::V1, &mut buffer)?;
    /// assert_eq!(frame, [0x3E, 0x52, 0x01, 0x53, 0x01, 0x01]);
    /// # Ok::<(), sbgc_proto::EncodeError>(())
    /// ```
    ///
    /// # Errors
    /// When it does not fit, or the message contradicts itself.
    fn encode_frame<'o>(&self, version: Version, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError>
    where
        Self: ToWire,
    {
        frame::encode_with(version, Self::ID.raw(), out, |payload| {
            let mut writer = Writer::new(payload);
            write_message(self, (), &mut writer).map(|()| writer.len())
        })
    }
}

/// A message that the board answers with another.
pub trait Request: Message {
    /// The answer.
    type Answer<'answer>: Message + FromWire<'answer>;
}

/// Appends the payload of a message to `out`, unless its length is that of another form.
pub(crate) fn write_message<M: Message + ToWire<C>, C>(
    message: &M,
    context: C,
    out: &mut Writer<'_>,
) -> Result<(), EncodeError> {
    let start = out.len();
    message.write(context, out)?;
    let length = out.len().saturating_sub(start);
    if M::accepts(length) {
        return Ok(());
    }
    Err(EncodeError::OtherForm { command: M::SPEC, form: M::FORM, length })
}

#[cold]
fn explain(command: &'static str, length: usize, fault: &Fault) -> DecodeError {
    DecodeError::Truncated {
        command,
        field: fault.field,
        offset: length.saturating_sub(fault.left),
        needed: fault.needed,
        got: fault.left,
    }
}
