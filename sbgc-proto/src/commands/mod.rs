//! Every payload of the protocol, one file per topic.
//!
//! # Names
//! A message is named after its command: `CMD_X` becomes `X` in CamelCase. If the answer has the same id as the
//! request, the answer has the plain name and the request is `XRequest`, except for requests named READ or GET in the
//! specification, which keep the verb: `ReadParams3` is answered by `Params3`, `GetAngles` by `Angles`. Forms other
//! than the usual one add a suffix: `ControlLegacy`.
//!
//! # Declarations
//! Fields have the spec names in lower case. Their types express the meaning of numbers: quantities of
//! [`units`](crate::units), open enumerations, flag sets and numbers made of bit fields. Reserved bytes are
//! [`Reserved`](crate::wire::Reserved); bytes that newer firmware uses are typed fields, whose documentation names the
//! first firmware version.
//!
#![doc = include_str!("table.md")]

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
mod params;
mod rc_inputs;
mod realtime;
mod scripts;
mod selection;
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
pub use params::*;
pub use rc_inputs::*;
pub use realtime::*;
pub use scripts::*;
pub use storage::*;
pub use streams::*;
pub use system::*;
pub use tuning::*;
pub use unpublished::*;
