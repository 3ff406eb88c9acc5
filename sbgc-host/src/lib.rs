//! Async driver for SimpleBGC32 boards.

#[cfg(feature = "capture")]
pub mod capture;
pub mod link;
#[cfg(feature = "sim")]
pub mod sim;

pub use sbgc_proto as proto;
