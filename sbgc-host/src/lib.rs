//! Async driver for SimpleBGC32 boards.
#![cfg_attr(
    not(test),
    deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)
)]

#[cfg(feature = "capture")]
pub mod capture;
mod error;
pub mod link;
#[cfg(feature = "sim")]
pub mod sim;
pub mod transport;

pub use error::{Error, Result};
pub use sbgc_proto as proto;
