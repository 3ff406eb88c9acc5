//! A simulated board, to try things without hardware and to test against.
//!
//! ```text
//!  serve, in_process, pty, tcp        a stream and the clock
//!       └─ Board                      plain state: bytes and time in, bytes out
//!            ├─ Line                  framing, buffers, bit rate
//!            └─ Machine               parameters, streams, control
//!                 ├─ answers          what each command brings about
//!                 └─ Motion           how the camera turns
//! ```
//!
//! [`Board`] is deterministic and knows no clock; [`serve`] puts it behind any stream of bytes. Each module says in
//! its source what in it is as on a real board and what is simplified. One host at a time talks to the board: it has
//! one port.
//!
//! # Simplified
//! The frame stands still and level, so angles against it and against the ground are the same. The camera is exactly
//! where the limits of speed and acceleration let its target be. Speed with angle goes to the angle with at most that
//! speed; remote control is a straight line; filters and priorities are taken and not used. Parameters and adjustable
//! variables are kept and, but for those that map remote control to angles, have no effect. A menu command that is not
//! simulated is confirmed; any other command that is not is refused as not supported.
//!
//! # Where the protocol leaves it open
//! The board answers in the version it was asked in. A command that it knows but whose payload has a length it does not
//! know, that asks for what cannot be, or that it does not know at all is refused with `CMD_ERROR` in the form that
//! begins with the command's id. A frame that stops coming is given up after 100 ms of silence.

mod answers;
mod board;
mod config;
mod control;
mod line;
mod machine;
mod motion;
mod parameters;
#[cfg(unix)]
mod pty;
mod serve;
mod streams;
mod tcp;
mod variables;

pub use board::{Board, POLL};
pub use config::{Config, StoredBlock};
pub use line::LineCounters;
pub use motion::{Axis, CYCLE, Goal, Limits, Motion};
#[cfg(unix)]
pub use pty::Pty;
pub use serve::{in_process, serve};
pub use tcp::serve_tcp;

#[cfg(test)]
mod tests;
