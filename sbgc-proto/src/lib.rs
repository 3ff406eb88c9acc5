//! The SimpleBGC32 serial protocol: framing and typed messages, for hosts and microcontrollers.
#![cfg_attr(not(any(feature = "std", test)), no_std)]

pub mod command_id;
pub mod commands;
mod error;
pub mod frame;
pub mod message;
#[cfg(feature = "reflect")]
pub mod reflect;
mod registry;
#[cfg(feature = "serde")]
mod serde_support;
pub mod units;
pub mod wire;

pub use command_id::{CommandId, Direction};
pub use error::{DecodeError, EncodeError, OutOfRange};
pub use message::{Message, Request};
pub use registry::{IncomingCommand, OutgoingCommand};
