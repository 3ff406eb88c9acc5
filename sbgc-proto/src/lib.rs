//! The SimpleBGC32 serial protocol, for hosts and microcontrollers: framing of versions 1 and 2, and every message of
//! the protocol typed, in both directions, without std, allocator or unsafe code.
//!
//! ```text
//!  bytes ──► frame ──────► OutgoingCommand, ──► commands ──► your program
//!            frames and    IncomingCommand      one struct per payload
//!            noise         by id and length        │ declared with
//!                                               units, wire
//!                                               angles, volts, numbers, lists
//! ```
//!
//! Each module uses only those before it: `frame`, `error`, `version` (of the firmware), [`wire`] (bytes of one field), [`reflect`] and serde (its
//! name and text), `declare` (the macros for numbers with a meaning), [`units`], [`command_id`], `echo` (what an answer
//! repeats), [`message`], [`commands`], and at the top what knows all commands: [`OutgoingCommand`],
//! [`IncomingCommand`], [`Expected`].
//!
//! # Frames
//! [`frame::Decoder`] finds frames in chunks of any size, borrows their payload from the chunk where it can, and loses
//! no intact frame whatever stands between them.
//!
//! ```
//! use sbgc_proto::frame::{Decoder, Event, Versions};
//!
//! let mut decoder = Decoder::new(Versions::Both);
//! let mut chunk = &b"noise\x3E\x43\x02\x45\x5D\xFF\x5C"[..];
//! let mut frames = 0;
//! while let Some(event) = decoder.next(&mut chunk) {
//!     if let Event::Frame { frame, .. } = event {
//!         assert_eq!((frame.id, frame.payload), (67, &[93, 255][..]));
//!         frames += 1;
//!     }
//! }
//! assert_eq!(frames, 1);
//! ```
//!
//! # Messages
//! Each payload is a struct in [`commands`]; [`Message`] reads and writes it. The table of all commands is
//! [there](commands#all-commands).
//!
//! ```
//! use sbgc_proto::commands::Control;
//! use sbgc_proto::frame::Version;
//! use sbgc_proto::units::{Angle, ControlRate};
//! use sbgc_proto::wire::PerAxis;
//! use sbgc_proto::Message;
//!
//! let angles = PerAxis { pitch: Angle::from_degrees(-30.0), ..PerAxis::default() };
//! let control = Control::angles(angles, ControlRate::from_degrees_per_second(20.0));
//! let mut buffer = [0; 32];
//! assert_eq!(control.encode_frame(Version::V2, &mut buffer)?.len(), 21);
//! # Ok::<(), sbgc_proto::EncodeError>(())
//! ```
//!
//! To handle every message, match on [`IncomingCommand`] or [`OutgoingCommand`]; a proxy, sniffer or simulator needs
//! nothing else. To handle a few, match on `frame.id`: unused messages then cost nothing.
//!
//! ```
//! use sbgc_proto::{CommandId, IncomingCommand};
//!
//! let (message, _) = IncomingCommand::decode(CommandId::CONFIRM, &[93, 255])?;
//! let IncomingCommand::Confirm(confirm) = message else { panic!("another message") };
//! assert_eq!((confirm.cmd_id, confirm.data.value()), (CommandId::CalibCogging, 255));
//! # Ok::<(), sbgc_proto::DecodeError>(())
//! ```
//!
//! # Requests
//! What answers a request is declared with it: [`Request::Answer`] is its type, [`Request::decode_answer`] decodes it
//! with what only the request defines, and [`Expected`] distinguishes it from other messages.
//!
//! ```
//! use sbgc_proto::commands::{ProfileId, ReadParams3};
//! use sbgc_proto::{CommandId, Expected};
//!
//! let expected = Expected::of(&ReadParams3 { profile_id: ProfileId::Profile2 });
//! assert!(!expected.matches(CommandId::ReadParams3, &[0, 10, 20]), "the parameters of another profile");
//! ```
//!
//! # Guarantees
//! - No input panics, and time is linear in its length.
//! - Decoding a payload and encoding it gives the same bytes, including reserved bytes, unknown values, undefined flags
//!   and NaN payloads. Parameters that are read, changed and written back keep what newer firmware stores beside them.
//! - A payload that is too short is an error that states both lengths, unless older firmware is known to send less.
//!   Trailing bytes added by newer firmware are returned alongside the message.
//! - Angles, rates and voltages are newtypes in [`units`]; the raw value is field `0`.
//!
//! # Features
//! All features are off by default and additive.
//!
//! | feature | what it adds |
//! | --- | --- |
//! | `reflect` | [`reflect`]: list, read and set message fields by name |
//! | `serde` | serde for all messages: names and physical values in human-readable formats, raw numbers in binary ones |
//! | `defmt` | [`defmt::Format`](https://docs.rs/defmt) for all messages |
//! | `embedded-io` | [`link::port`]: the firmware link on a UART with non-blocking reads |
//! | `embedded-io-async` | [`link::async_port`]: the firmware link on an async UART |
//!
//! In human-readable formats, bytes are hex digits. Messages that borrow bytes from their payload can be written in these
//! formats, but read back from binary ones only: decoding hex digits needs memory, and this crate allocates none.
#![cfg_attr(not(test), no_std)]
#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::cast_possible_truncation
    )
)]

mod command;
pub mod command_id;
mod command_table;
pub mod commands;
mod declare;
mod echo;
mod error;
mod expected;
pub mod frame;
pub mod link;
pub mod message;
#[cfg(feature = "reflect")]
mod message_info;
#[cfg(test)]
mod offsets;
#[cfg(feature = "reflect")]
pub mod reflect;
#[cfg(feature = "serde")]
mod serde_support;
mod text;
pub mod units;
mod version;
pub mod wire;

pub use command::{IncomingCommand, OutgoingCommand};
pub use command_id::{CommandId, Direction};
pub use echo::RequestInfo;
pub use error::{DecodeError, EncodeError, OutOfRange, TextTooLong};
pub use expected::Expected;
pub use message::{Message, Request};
#[cfg(feature = "reflect")]
pub use message_info::MessageInfo;

/// The macros read it to document the offsets of fields; named here so that a change of it builds the crate again.
const _: &str = include_str!("commands/offsets.txt");

// Types of it stand in this crate's own signatures.
pub use heapless;

/// The examples of the crate's front page.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct FrontPage;
