//! The [`Message`] trait, implemented by every declared payload, and [`Request`], for those that are answered.

use core::ops::RangeInclusive;

use crate::frame::{self, Frame, Version};
use crate::units::FirmwareVersion;
use crate::wire::{Fault, FromWire, Layout, ToWire, Writer};
use crate::{CommandId, DecodeError, Direction, EncodeError, RequestInfo};

/// Payload of a command in one form.
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
    /// Command id.
    const ID: CommandId;
    /// Direction, seen from the host.
    const DIRECTION: Direction;
    /// Spec name of the command.
    const SPEC: &'static str;
    /// Name of the form; `full` if it is the only one.
    const FORM: &'static str;
    /// Whether this is the form to build by default: never one that deletes or
    /// reconfigures by what it leaves out.
    const IS_DEFAULT: bool;
    /// First firmware that supports the message; `None` if that is unknown or the first of all.
    const SINCE: Option<FirmwareVersion>;
    /// Summary in one sentence.
    const SUMMARY: &'static str;
    /// Payload length in bytes.
    const SIZE: RangeInclusive<usize>;
    /// Facts about the exchange that the message starts; empty for messages from the board.
    const REQUEST: RequestInfo = RequestInfo::NONE;

    /// Whether a payload of `length` bytes has this form. Always true for the only form of an id.
    fn accepts(length: usize) -> bool {
        let _ = length;
        true
    }

    /// Decodes a payload. Bytes that newer firmware has added at the end are ignored.
    ///
    /// # Errors
    /// If the payload is too short.
    fn decode<'a>(payload: &'a [u8]) -> Result<Self, DecodeError>
    where
        Self: FromWire<'a>,
    {
        Self::decode_prefix(payload).map(|(message, _)| message)
    }

    /// Decodes a payload and returns the bytes after the known part.
    ///
    /// # Errors
    /// If the payload is too short.
    fn decode_prefix<'a>(payload: &'a [u8]) -> Result<(Self, &'a [u8]), DecodeError>
    where
        Self: FromWire<'a>,
    {
        Self::decode_with(payload, ())
    }

    /// Decodes a payload that needs external context and returns the remaining bytes.
    ///
    /// # Errors
    /// If the payload is too short.
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

    /// Encodes the payload at the start of `out` and returns it.
    ///
    /// # Errors
    /// If the buffer is too small, the message is inconsistent, or its length is that of another form.
    fn encode<'o>(&self, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError>
    where
        Self: ToWire,
    {
        self.encode_with((), out)
    }

    /// Encodes the payload of a message that needs external context.
    ///
    /// # Errors
    /// If the buffer is too small, or the message is inconsistent in itself or with the context.
    fn encode_with<'o, C>(&self, context: C, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError>
    where
        Self: ToWire<C>,
    {
        let mut writer = Writer::new(out);
        write_message(self, context, &mut writer)?;
        let length = writer.len();
        Ok(out.get(..length).unwrap_or_default())
    }

    /// Encodes the whole frame at the start of `out` and returns it.
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
    /// If the buffer is too small, the message is inconsistent, or its length is that of another form.
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

impl<'a> Frame<'a> {
    /// Command id.
    pub const fn command(&self) -> CommandId {
        CommandId::from_raw(self.id)
    }

    /// Decodes the payload as the message `M`; `None` if the frame has another id, or the length of another form.
    ///
    /// ```
    /// use sbgc_proto::commands::{Confirm, Error};
    /// use sbgc_proto::frame::{Frame, Version};
    ///
    /// let frame = Frame { version: Version::V1, id: 67, payload: &[93, 255] };
    /// let confirm = frame.read::<Confirm>().expect("it is one")?;
    /// assert_eq!(confirm.data.value(), 255);
    /// assert!(frame.read::<Error>().is_none());
    /// # Ok::<(), sbgc_proto::DecodeError>(())
    /// ```
    pub fn read<M: Message + FromWire<'a>>(&self) -> Option<Result<M, DecodeError>> {
        (self.id == M::ID.raw() && M::accepts(self.payload.len())).then(|| M::decode(self.payload))
    }
}

/// Message that the board answers.
pub trait Request: Message {
    /// Type of the answer.
    type Answer<'answer>: Message;

    /// Decodes the answer to this request, using the request where needed, such as for the flags that select the
    /// fields.
    ///
    /// ```
    /// use sbgc_proto::Request;
    /// use sbgc_proto::commands::{RealtimeDataCustomFlags, RealtimeDataCustomRequest};
    ///
    /// let flags = RealtimeDataCustomFlags::IMU_ANGLES;
    /// let request = RealtimeDataCustomRequest { flags, ..Default::default() };
    /// let answer = request.decode_answer(&[0x10, 0x27, 0x00, 0x10, 0x00, 0x00, 0x00, 0xF8])?;
    /// assert_eq!(answer.imu_angles.map(|angles| angles.roll.degrees()), Some(90.0));
    /// # Ok::<(), sbgc_proto::DecodeError>(())
    /// ```
    ///
    /// # Errors
    /// If the payload is too short.
    fn decode_answer<'answer>(&self, payload: &'answer [u8]) -> Result<Self::Answer<'answer>, DecodeError> {
        self.decode_answer_prefix(payload).map(|(answer, _)| answer)
    }

    /// Decodes the answer to this request, like [`decode_answer`](Self::decode_answer), and returns the bytes after the
    /// known part.
    ///
    /// # Errors
    /// If the payload is too short.
    fn decode_answer_prefix<'answer>(
        &self,
        payload: &'answer [u8],
    ) -> Result<(Self::Answer<'answer>, &'answer [u8]), DecodeError>;

    /// Number of payload bytes of the answer; `None` if the request does not determine it.
    ///
    /// ```
    /// use sbgc_proto::Request;
    /// use sbgc_proto::commands::{BoardInfoRequest, RealtimeDataCustomFlags, RealtimeDataCustomRequest};
    ///
    /// let flags = RealtimeDataCustomFlags::IMU_ANGLES;
    /// let request = RealtimeDataCustomRequest { flags, ..Default::default() };
    /// assert_eq!(request.answer_len(), Some(2 + 6));
    /// assert_eq!(BoardInfoRequest.answer_len(), None);
    /// ```
    fn answer_len(&self) -> Option<usize> {
        None
    }
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
