//! Captured traffic: files and pipes that hold frames, and what the frames in them mean.
//!
//! [`Reader`] turns bytes, hex dumps and log lines into [`Captured`]s: frames and what was skipped between them.
//! [`Interpreter`] gives each frame its meaning; it remembers the requests it has seen, because some answers can be
//! read only with the request in mind. Neither knows ports or time.
//!
//! [`tap`] copies the frames that pass a port and [`Recorder`] writes them; [`Replay`] sends the outgoing ones again.

mod hex;
mod interpret;
mod log;
mod reader;
mod record;
mod replay;
mod time;

pub use hex::HexError;
use interpret::likely_direction;
pub use interpret::{AnyMessage, Interpreted, Interpreter};
pub use reader::{Captured, Format, ReadError, Reader};
pub use record::{Frames, Passed, Recorder, Tap, Tapping, tap};
pub use replay::{Replay, ReplayStep};
