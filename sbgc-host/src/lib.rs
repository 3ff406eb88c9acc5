//! Async driver for SimpleBGC32 boards.

#[cfg(feature = "capture")]
pub mod capture;
#[cfg(feature = "sim")]
pub mod sim;
