//! All messages of each direction in one enumeration: [`OutgoingCommand`] and [`IncomingCommand`].
//!
//! Here a command's id and the length of its payload find its type. Both follow from the
//! [table](crate::command_table); all else is said where the message is declared. Programs that want few messages match
//! on the id themselves and leave these enumerations, and what they cost, alone.

use crate::command_table::with_commands;
#[allow(clippy::wildcard_imports, reason = "the table names them all")]
use crate::commands::*;
use crate::frame::{self, Frame, Version};
use crate::message::{Message, write_message};
use crate::wire::{FromWire, ToWire, Writer};
use crate::{CommandId, DecodeError, Direction, EncodeError, RequestInfo};

/// Reads a payload as one message.
///
/// By itself, because all messages in one function would need as much stack as all of them together.
#[inline(never)]
fn decode_as<'a, M: Message + FromWire<'a>, E>(
    payload: &'a [u8],
    variant: impl FnOnce(M) -> E,
) -> Result<(E, &'a [u8]), DecodeError> {
    M::decode_prefix(payload).map(|(message, rest)| (variant(message), rest))
}

/// The messages of one direction: of each id the forms in the order in which they are tried.
macro_rules! declare_direction {
    (
        $(#[doc = $doc:literal])+
        $enum:ident: $direction:ident { $($id:tt($($ty:ident $(<$lifetime:lifetime>)?),*))* }
    ) => {
        const _: () = {
            $(
                assert!(true $(&& <$ty as Message>::ID.raw() == $id)*, "a type stands at the wrong id");
                assert!(
                    has_one_default(&[$(<$ty as Message>::IS_DEFAULT),*]),
                    "one of the forms must be the `default`"
                );
            )*
        };

        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq, Eq)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        #[allow(clippy::large_enum_variant, reason = "there is no allocator to put the large ones elsewhere")]
        #[non_exhaustive]
        pub enum $enum<'a> {
            $($(
                #[doc = concat!("[`", stringify!($ty), "`](crate::commands::", stringify!($ty), ").")]
                $ty($ty $(<$lifetime>)?),
            )*)*
            /// A command unknown in this direction.
            Unknown {
                /// Command id.
                id: CommandId,
                /// Payload as received.
                payload: &'a [u8],
            },
        }

        impl<'a> $enum<'a> {
            /// Direction of all messages in this enumeration.
            pub const DIRECTION: Direction = Direction::$direction;

            /// Decodes the payload of command `id` and returns the bytes that newer firmware has added at the end.
            ///
            /// # Errors
            /// If the payload is too short, or none of the forms of the command has its length.
            pub fn decode(id: CommandId, payload: &'a [u8]) -> Result<(Self, &'a [u8]), DecodeError> {
                let command: Option<&&str> = match id.raw() {
                    $($id => {
                        const SPECS: &[&str] = &[$(<$ty as Message>::SPEC),*];
                        $(
                            if <$ty as Message>::accepts(payload.len()) {
                                return decode_as(payload, Self::$ty);
                            }
                        )*
                        SPECS.first()
                    })*
                    _ => None,
                };
                match command {
                    Some(command) => Err(DecodeError::NoSuchForm { command, got: payload.len() }),
                    None => Ok((Self::Unknown { id, payload }, &[])),
                }
            }

            /// Decodes the payload of a frame.
            ///
            /// # Errors
            /// If the payload is too short, or none of the forms of the command has its length.
            pub fn from_frame(frame: &Frame<'a>) -> Result<(Self, &'a [u8]), DecodeError> {
                Self::decode(CommandId::from_raw(frame.id), frame.payload)
            }

            /// Command id.
            pub fn id(&self) -> CommandId {
                match self {
                    $($(Self::$ty(_) => <$ty as Message>::ID,)*)*
                    Self::Unknown { id, .. } => *id,
                }
            }

            /// Spec name of the command; `None` for an unknown one.
            pub fn spec_name(&self) -> Option<&'static str> {
                match self {
                    $($(Self::$ty(_) => Some(<$ty as Message>::SPEC),)*)*
                    Self::Unknown { id, .. } => id.spec_name(Self::DIRECTION),
                }
            }

            /// Name of the form; `unknown` for an unknown command.
            pub fn form(&self) -> &'static str {
                match self {
                    $($(Self::$ty(_) => <$ty as Message>::FORM,)*)*
                    Self::Unknown { .. } => "unknown",
                }
            }

            /// Encodes the payload at the start of `out` and returns it.
            ///
            /// # Errors
            /// If the buffer is too small, the message is inconsistent, or its length is that of another form.
            pub fn encode<'o>(&self, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError> {
                let mut writer = Writer::new(out);
                self.write((), &mut writer)?;
                let length = writer.len();
                Ok(out.get(..length).unwrap_or_default())
            }

            /// Encodes the whole frame at the start of `out` and returns it.
            ///
            /// # Errors
            /// If the buffer is too small, the message is inconsistent, or its length is that of another form.
            pub fn encode_frame<'o>(&self, version: Version, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError> {
                frame::encode_with(version, self.id().raw(), out, |payload| {
                    let mut writer = Writer::new(payload);
                    self.write((), &mut writer).map(|()| writer.len())
                })
            }
        }

        impl ToWire for $enum<'_> {
            fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
                match self {
                    $($(Self::$ty(message) => write_message(message, (), out),)*)*
                    Self::Unknown { payload, .. } => out.put(payload),
                }
            }
        }

        $($(
            impl<'a> From<$ty $(<$lifetime>)?> for $enum<'a> {
                fn from(message: $ty $(<$lifetime>)?) -> Self {
                    Self::$ty(message)
                }
            }
        )*)*

        #[cfg(all(test, feature = "serde"))]
        impl $enum<'_> {
            /// Takes every message through text and through bytes.
            fn through_serde() {
                $($(
                    for payload in tests::payloads() {
                        let Ok((message, _)) = <$ty>::decode_prefix(&payload) else { continue };
                        tests::through_bytes!(message, $ty);
                        tests::through_text!(message, $ty $(, $lifetime)?);
                    }
                )*)*
            }
        }

        #[cfg(feature = "reflect")]
        impl<'a> $enum<'a> {
            /// All messages of this direction, with the forms of a command in the order in which they are tried.
            pub const ALL: &'static [crate::MessageInfo] = {
                // A static has one place in memory, a constant would have one at each use.
                static ALL: &[crate::MessageInfo] = &[$($(
                    crate::MessageInfo::of::<$ty>(stringify!($ty)),
                )*)*];
                ALL
            };

            /// Returns a message with all fields zero or absent.
            pub fn blank(id: CommandId, form: &str) -> Option<Self> {
                match id.raw() {
                    $($id => {
                        $(
                            if form == <$ty as Message>::FORM {
                                return Some(Self::$ty(<$ty>::default()));
                            }
                        )*
                        None
                    })*
                    _ => None,
                }
            }

            /// Visits the fields in wire order and returns their total size in bytes.
            pub fn walk(&self, visitor: &mut dyn crate::reflect::Visitor) -> usize {
                match self {
                    $($(Self::$ty(message) => crate::reflect::walk(message, visitor),)*)*
                    Self::Unknown { payload, .. } => crate::reflect::walk_payload(payload, visitor),
                }
            }

            /// Sets the field that `path` names, as [`reflect::set`](crate::reflect::set) does.
            ///
            /// # Errors
            /// If there is no such field, or it cannot have `value`.
            pub fn set(
                &mut self,
                path: &str,
                value: crate::reflect::Input<'a>,
            ) -> Result<(), crate::reflect::AssignError> {
                crate::reflect::set(self, path, value)
            }

            /// Sets the field that `path` names to anything the wire can hold, as
            /// [`reflect::force`](crate::reflect::force) does.
            ///
            /// # Errors
            /// If there is no such field, or the wire cannot hold `value`.
            pub fn force(
                &mut self,
                path: &str,
                value: crate::reflect::Input<'a>,
            ) -> Result<Option<crate::OutOfRange>, crate::reflect::AssignError> {
                crate::reflect::force(self, path, value)
            }
        }

        #[cfg(feature = "reflect")]
        impl<'a> crate::reflect::Assign<'a> for $enum<'a> {
            fn assign(
                &mut self,
                path: crate::reflect::Steps<'_>,
                value: crate::reflect::Input<'a>,
                field: &'static crate::reflect::FieldInfo,
            ) -> Result<(), crate::reflect::AssignError> {
                match self {
                    $($(Self::$ty(message) => message.assign(path, value, field),)*)*
                    Self::Unknown { payload, .. } => crate::reflect::assign_payload(payload, path, value),
                }
            }
        }
    };
}

/// What is declared of the requests.
macro_rules! declare_requests {
    ($($id:tt($($ty:ident $(<$lifetime:lifetime>)?),*))*) => {
        impl RequestInfo {
            /// Returns the facts about the command with this id and payload; `None` if it is unknown.
            pub fn of_payload(command: CommandId, payload: &[u8]) -> Option<Self> {
                match command.raw() {
                    $($id => {
                        $(
                            if <$ty as Message>::accepts(payload.len()) {
                                return Some(<$ty as Message>::REQUEST);
                            }
                        )*
                        None
                    })*
                    _ => None,
                }
            }
        }
    };
}

macro_rules! declare_messages {
    ($(
        $(#[doc = $doc:tt])+
        $variant:ident = $id:tt $(as $spec:tt)?, outgoing $outgoing:tt, incoming $incoming:tt;
    )*) => {
        declare_direction! {
            /// A message from the host to the controller.
            OutgoingCommand: Outgoing { $($id $outgoing)* }
        }

        declare_direction! {
            /// A message from the controller to the host.
            IncomingCommand: Incoming { $($id $incoming)* }
        }

        declare_requests! { $($id $outgoing)* }
    };
}

with_commands!(declare_messages);

/// Whether exactly one of the forms, if there are any, is the default.
const fn has_one_default(mut forms: &[bool]) -> bool {
    let mut defaults = if forms.is_empty() { 1 } else { 0 };
    while let Some((is_default, rest)) = forms.split_first() {
        if *is_default {
            defaults += 1;
        }
        forms = rest;
    }
    defaults == 1
}

#[cfg(all(test, feature = "serde"))]
mod tests {
    use super::{IncomingCommand, OutgoingCommand};

    /// Payloads whose bytes are low, high, mixed: known and unknown values, NaNs, texts that are none.
    pub(super) fn payloads() -> impl Iterator<Item = [u8; 255]> {
        let mixed = core::array::from_fn(|index| u8::try_from(index * 73 % 256).unwrap_or_default());
        let ascending = core::array::from_fn(|index| u8::try_from(index % 256).unwrap_or_default());
        [[0; 255], [1; 255], [0x7F; 255], [0xFF; 255], mixed, ascending].into_iter()
    }

    macro_rules! through_bytes {
        ($message:ident, $ty:ident) => {
            let bytes = postcard::to_stdvec(&$message).unwrap();
            assert_eq!(postcard::from_bytes::<$ty>(&bytes).unwrap(), $message);
        };
    }
    pub(super) use through_bytes;

    macro_rules! through_text {
        ($message:ident, $ty:ident) => {
            let text = serde_json::to_string(&$message).unwrap();
            let again = serde_json::from_str::<$ty>(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
            assert_eq!(again, $message, "{text}");
        };
        // What borrows bytes cannot be read from text.
        ($message:ident, $ty:ident, $lifetime:lifetime) => {
            serde_json::to_string(&$message).unwrap();
        };
    }
    pub(super) use through_text;

    #[test]
    fn nothing_is_lost_in_serde() {
        OutgoingCommand::through_serde();
        IncomingCommand::through_serde();
    }

    #[test]
    fn people_read_names_and_physical_values() {
        let payload = [30, 1, 9, 4, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        let (info, _) = IncomingCommand::decode(crate::CommandId::BoardInfo, &payload).unwrap();
        let text = serde_json::to_value(&info).unwrap();
        let info = &text["BoardInfo"];
        assert_eq!((&info["board_ver"], &info["firmware_ver"]), (&3.0.into(), &"2.30b5".into()));
        assert_eq!(info["state_flags1"], "INIT_STEP1_DONE");
    }
}
