//! The link: frames in and out of a byte stream, and the one task that owns it.
//!
//! ```text
//!   bytes ──► codec ──► session ──► whoever asked          codec    bytes and frames, no time
//!                  └──► listeners ─► subscriptions         session  who waits for what until when, no bytes
//!   bytes ◄── pacer ◄── session ◄── requests               pacer    how much the board can take, and when
//!                                                          task     moves the bytes, keeps the time
//! ```
//!
//! Here live framing over tokio's buffers, the table of requests in flight, pacing, and the task that ties them to
//! a port. What payloads mean belongs to [`gimbal`](crate::gimbal), opening ports to [`transport`](crate::transport).

pub mod codec;
mod counters;
mod key;
pub mod session;

pub use counters::LinkCounters;
