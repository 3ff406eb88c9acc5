//! Async driver for SimpleBGC32 boards.

#[cfg(feature = "sim")]
pub mod sim;
