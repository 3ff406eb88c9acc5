//! Every payload of the protocol, one file a topic.
//!
//! # Names
//! A message is named after its command: `CMD_X` becomes `X` in CamelCase. Where a command has its answer under the
//! same id, the answer has the plain name and the request is `XRequest`; only the requests that the spec calls READ or
//! GET keep the verb: `ReadParams3` is answered by `Params3`, `GetAngles` by `Angles`. Forms other than the usual one
//! say so at the end: `ControlLegacy`. A struct that stands inside messages is a `record`.
//!
//! # Declarations
//! Each payload is declared once, with [`sbgc_proto_macros::message`], and everything else follows from that. Fields
//! have the spec's names in lower case. What a number means is in its type: quantities of [`units`](crate::units), open
//! enumerations, flag sets and bit fields; only plain numbers have a `unit` or `range` of their own. Reserved bytes are
//! [`Reserved`](crate::wire::Reserved); those that newer firmware has put to use are typed fields with a `since`.

mod actions;
mod adjustable;
mod board;
mod calibration;
mod can;
mod can_driver;
mod common;
mod confirm;
mod control;
mod debug;
mod ext_motors;
mod i2c;
mod imu;
mod packed_quaternion;
mod params;
mod rc_inputs;
mod realtime;
mod scripts;
mod storage;
mod streams;
mod system;
mod tuning;
mod unpublished;

pub use actions::*;
pub use adjustable::*;
pub use board::*;
pub use calibration::*;
pub use can::*;
pub use can_driver::*;
pub use common::*;
pub use confirm::*;
pub use control::*;
pub use debug::*;
pub use ext_motors::*;
pub use i2c::*;
pub use imu::*;
pub use packed_quaternion::*;
pub use params::*;
pub use rc_inputs::*;
pub use realtime::*;
pub use scripts::*;
pub use storage::*;
pub use streams::*;
pub use system::*;
pub use tuning::*;
pub use unpublished::*;
