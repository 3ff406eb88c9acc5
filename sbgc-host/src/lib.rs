//! Async driver for SimpleBGC32 boards: requests, data streams and motion over any byte stream.
//!
//! ```text
//!   Gimbal ─┐  clones of one handle            serial port, TCP, anything
//!   Gimbal ─┼─► the machine ◄─► the task ◄───► AsyncRead + AsyncWrite
//!   Gimbal ─┘     │  knows who waits for what, how long, and how much the board can take;
//!                 │  the task moves bytes and time between it and the port
//!   Subscription ◄┘  a bounded queue, drops its oldest
//! ```
//!
//! Modules use only those above them:
//!
//! ```text
//!   error · transport      what can go wrong; addresses and ports
//!   machine                the rules of the driver, without I/O
//!   task                   moves bytes and time
//!   gimbal                 the handle
//!   connect                opening, detection
//!   streams                data streams
//!   motion                 moves that are waited for
//!   proxy                  one board, several clients
//!   capture · sim          stand apart: recordings, the simulated board
//! ```
//!
//! - [`Gimbal`] is the handle: typed requests, confirmed commands, set-points, motion that is waited for.
//! - [`Connection`] is the task. Nobody else touches the port, so a slow caller holds up no other, and a caller that
//!   gives up leaves nothing behind.
//! - [`Subscription`] yields what the board sends on its own.
//! - [`ControlSession`] owns the motion of the gimbal, and stops it however the owner ends.
//! - [`transport`] opens ports; [`machine`] holds the rules of the driver, without I/O.
//!
//! ```no_run
//! use std::time::Duration;
//!
//! use sbgc_host::proto::units::{Angle, ControlRate};
//! use sbgc_host::proto::wire::PerAxis;
//! use sbgc_host::transport::{Address, Line};
//! use sbgc_host::{Gimbal, Options};
//!
//! # async fn example() -> sbgc_host::Result<()> {
//! let (address, line): (Address, _) = ("/dev/ttyUSB0".parse()?, Line::default());
//! let options = Options { baud: address.baud(line), ..Options::default() };
//! let gimbal = Gimbal::spawn(address.open(line).await?, options);
//!
//! let board = gimbal.handshake().await?;
//! println!("firmware {}", board.firmware_ver);
//!
//! gimbal.motors_on().await?;
//! let down = PerAxis { pitch: Some(Angle::from_degrees(-30.0)), ..PerAxis::default() };
//! gimbal.move_to(down, ControlRate::from_degrees_per_second(20.0), Duration::from_secs(10)).await?;
//! println!("{}", gimbal.angles().await?.axes.pitch.imu_angle.degrees());
//! gimbal.close().await;
//! # Ok(())
//! # }
//! ```
//!
//! No board is needed for tests: anything that can be read and written will do, such as one end of
//! [`tokio::io::duplex`].
//!
//! ```
//! use sbgc_host::proto::frame::{self, Version};
//! use sbgc_host::{Gimbal, Options};
//! use tokio::io::{AsyncReadExt, AsyncWriteExt};
//!
//! # #[tokio::main(flavor = "current_thread")]
//! # async fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let (near, mut board) = tokio::io::duplex(256);
//! let gimbal = Gimbal::spawn(near, Options::default());
//! let (angles, answered) = tokio::join!(gimbal.angles(), async {
//!     board.read_exact(&mut [0; 6]).await?;
//!     let mut buffer = [0; frame::MAX_FRAME];
//!     let answer = frame::encode_into(Version::V2, 73, &[0, 16].repeat(9), &mut buffer)?;
//!     board.write_all(answer).await?;
//!     Ok::<_, Box<dyn std::error::Error>>(())
//! });
//! answered?;
//! assert_eq!(angles?.axes.pitch.imu_angle.degrees(), 90.0);
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! | feature | what it adds |
//! | --- | --- |
//! | `serial` (default) | serial ports of the operating system |
//! | `params` | the module `params`: parameters by name, files, profiles and adjustable variables |
//! | `capture` | the module `capture`: recording, reading and interpreting traffic |
//! | `sim` | the module `sim`: the simulated board, and the address `sim` |
#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable
    )
)]

pub mod actions;
pub mod blocking;
pub mod calibrate;
#[cfg(feature = "capture")]
pub mod capture;
mod checked;
pub mod connect;
pub mod control;
mod error;
mod foreign;
pub mod gimbal;
pub mod machine;
mod motion;
#[cfg(feature = "params")]
pub mod params;
pub mod proxy;
#[cfg(feature = "sim")]
pub mod sim;
pub mod storage;
pub mod streams;
mod task;
pub mod transport;

pub use connect::{ConnectOptions, Reconnect, detect};
pub use control::{ControlSession, SessionOptions, Setpoint};
pub use error::{Error, Result};
pub use gimbal::{Answer, Connection, Found, Gimbal, Options, VersionChoice};
pub use machine::{LinkCounters, LinkState};
pub use sbgc_proto as proto;
pub use streams::{Sample, StreamRequest, Subscription, TypedStream};
