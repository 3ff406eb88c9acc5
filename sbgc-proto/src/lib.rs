//! The SimpleBGC32 serial protocol, for hosts and microcontrollers: framing of versions 1 and 2, and every message of
//! the protocol typed, in both directions, without std, allocator or unsafe code.
//!
//! ```text
//!  bytes ──► frame ──────► message, command  ──► commands ──► your program
//!            frames and    a message by its      one struct
//!            noise         id and length         a payload
//!                               │                   │ declared with
//!                            reflect             wire, units
//!                            fields by name      numbers, lists, angles, volts
//! ```
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
//! Whoever has to do with all of them matches on [`IncomingCommand`] and [`OutgoingCommand`], which a proxy, a sniffer
//! or a simulated board needs nothing besides; whoever wants a few matches on the frame's id, and pays for those only.
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
//! # What holds everywhere
//! - No input panics, and time is linear in its length.
//! - Reading a payload and writing it gives the same bytes: reserved bytes, unknown values, undefined flags and NaNs too.
//!   So parameters that are read, changed and written back disturb nothing that newer firmware keeps beside them.
//! - A payload that is too short is an error that says both lengths, unless older firmware is known to send less. What
//!   newer firmware adds at the end is handed out beside the message.
//! - Angles, rates and voltages are types of [`units`]; their raw numbers stay in reach.
//!
//! # Features
//! None is on by default, and none changes what another means.
//!
//! | feature | what it adds |
//! | --- | --- |
//! | `reflect` | [`reflect`]: fields by name, for tools |
//! | `serde` | serde for all messages: names and physical values where people read, raw numbers elsewhere |
//! | `defmt` | [`defmt::Format`](https://docs.rs/defmt) for all messages |
//! | `std` | links the standard library |
#![cfg_attr(not(any(feature = "std", test)), no_std)]
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
mod echo;
mod error;
mod expected;
pub mod frame;
pub mod message;
#[cfg(feature = "reflect")]
pub mod reflect;
#[cfg(feature = "serde")]
mod serde_support;
mod text;
pub mod units;
pub mod wire;

pub use command::{IncomingCommand, OutgoingCommand};
pub use command_id::{CommandId, Direction};
pub use echo::RequestInfo;
pub use error::{DecodeError, EncodeError, OutOfRange, TextTooLong};
pub use expected::Expected;
pub use message::{Message, Request};

// Types of it stand in this crate's own signatures.
pub use heapless;

/// The examples of the project's front page.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct FrontPage;
