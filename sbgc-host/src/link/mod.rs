//! The link: frames in and out of a byte stream, and the one task that owns it.
//!
//! ```text
//!   bytes ──► codec ──► session ──► whoever asked          codec    bytes and frames, no time
//!                  └──► listeners ─► subscriptions         session  who waits for what until when, no bytes
//!   bytes ◄── pacer ◄── session ◄── requests               pacer    how much the board can take, and when
//!                                                          task     moves the bytes, keeps the time
//! ```
//!
//! Here live framing over tokio's buffers, the table of requests in flight, pacing, the data streams that run, and
//! the task that ties them to a port. What payloads mean is the business of [`Gimbal`](crate::Gimbal), opening ports
//! that of [`transport`](crate::transport).

pub mod codec;
mod counters;
mod key;
mod pacer;
mod registry;
pub mod session;
pub(crate) mod shared;
pub(crate) mod task;

pub use counters::LinkCounters;
pub use shared::LinkState;
