//! A simulated board, to try things without hardware and to test against.
//!
//! ```text
//!  serve, in_process, pty, tcp        a stream and the clock
//!       └─ Board                      plain state: bytes and time in, bytes out
//!            ├─ Line                  framing, buffers, bit rate
//!            ├─ answers               what each command brings about, a file per topic
//!            └─ Machine               what the board is made of:
//!                 ├─ Parameters       profiles and variables, in the Eeprom with its Files
//!                 ├─ Motion           how the camera turns
//!                 ├─ Steering         serial and remote control, follow mode
//!                 └─ Imu, Power, RcInputs, Pins, Bus, Script, …
//! ```
//!
//! [`Board`] is deterministic and knows no clock; [`SharedBoard`] runs it by that of tokio, behind any stream of bytes.
//! A test has a board with [`in_process`], and with [`simulate`] one that [`Fault`]s can be switched on in. Each module says in
//! its source what in it is as on a real board and what is simplified.
//!
//! # Where the protocol leaves it open
//! The board answers in the version it was asked in. A command whose payload has a size that it does not have is
//! ignored. One that asks for what cannot be is refused with `CMD_ERROR` in the form that begins with the command's id,
//! one that nobody knows with `ERR_UNKNOWN_COMMAND`, and one of which only the id is published with
//! `ERR_NOT_SUPPORTED`. Commands of which sources disagree whether they are confirmed are confirmed. A frame that stops
//! coming is given up after 100 ms of silence.
//!
//! # Not simulated
//! * What stabilizes a real camera, and disturbs it: PID, power, filters, notches, momentum and cogging of the motors,
//!   vibration, imbalance, gimbal lock, drift of sensors. Their parameters are kept and change nothing.
//! * The frame stands unless a program turns it ([`Board::turn_frame`], or `CMD_AHRS_HELPER` for the frame).
//! * Protection by password is set and read, and keeps nobody out: how a host proves that it knows the password is not
//!   published. Neither is encryption; signatures are made up.
//! * Control flags `MIX_FOLLOW` and `TARGET_PRECISE`, the order of Euler angles, forced and parking positions, and
//!   `STARTUP_ACTION`: published are names, or fields without the meaning of their numbers.
//! * Scripts are text, a command per line that moves, waits or calls the menu; compiled ones end with an error.
//! * Other devices: MAVLink, external sensors and motor drivers answer as ones that are not connected, and
//!   `CMD_TRANSPARENT_SAPI` leads nowhere. The bootloader takes no firmware: after three seconds it starts the board again.
//! * The menu button is pressed by `MENU_CMD_BUTTON_PRESS` alone, and the serial ports keep the rate of the line whatever
//!   `SERIAL_SPEED` says.

#![doc = include_str!("table.md")]

mod answers;
mod aux_motors;
mod board;
mod bus;
mod config;
mod eeprom;
mod events;
mod factory;
mod faults;
mod files;
mod imu;
mod line;
mod machine;
mod motion;
mod noise;
mod parameters;
mod pins;
mod power;
mod procedure;
#[cfg(unix)]
mod pty;
mod quaternion;
mod rc;
mod reply;
mod script;
mod serve;
mod state;
mod steering;
mod streams;
mod tcp;
mod variables;
#[cfg(unix)]
mod watch;

pub use board::{Board, POLL, TakenCommand};
pub use config::{Config, StoredBlock};
pub use faults::{Fault, FaultError, Way};
pub use line::LineCounters;
pub use motion::{Axis, CYCLE, Goal, Limits, Moment, Motion};
#[cfg(unix)]
pub use pty::{LineRate, Pty};
pub use serve::{SharedBoard, in_process, simulate, simulate_with_state};
pub use state::StateFile;
pub use tcp::{serve_shared_tcp, serve_tcp};

/// The device id of every simulated board, by which programs can tell that a board is one.
pub const DEVICE_ID: [u8; 9] = *b"SIMULATED";

#[cfg(test)]
mod tests;
