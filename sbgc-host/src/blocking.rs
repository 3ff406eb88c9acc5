//! The driver for programs without async code.
//!
//! A thin facade: each call runs the async one to its end on a runtime of its own, which a thread drives in between.
//!
//! ```
//! # #[cfg(feature = "sim")]
//! # fn main() -> sbgc_host::Result<()> {
//! let gimbal = sbgc_host::blocking::Gimbal::connect("sim")?;
//! println!("{}", gimbal.call(|gimbal| async move { gimbal.board_info().await })?.firmware_ver);
//! gimbal.close();
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "sim"))]
//! # fn main() {}
//! ```

use tokio::runtime::{Builder, Handle, Runtime};

use crate::connect::ConnectOptions;
use crate::error::Result;
use crate::transport::Address;

/// A board, for programs without async code. Within async code its functions panic, as tokio's do there.
///
/// Dropping it is the same as [`close`](Self::close).
#[derive(Debug)]
pub struct Gimbal {
    gimbal: crate::Gimbal,
    /// Dropped last: it serves the port.
    runtime: Runtime,
}

impl Gimbal {
    /// Opens an address such as `/dev/ttyUSB0` and finds the board there.
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub fn connect(address: &str) -> Result<Self> {
        Self::connect_with(&address.parse()?, ConnectOptions::default())
    }

    /// Like [`connect`](Self::connect), with options.
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub fn connect_with(address: &Address, options: ConnectOptions) -> Result<Self> {
        let runtime = Builder::new_multi_thread().worker_threads(1).enable_all().build()?;
        let gimbal = runtime.block_on(crate::Gimbal::connect_with(address, options))?;
        Ok(Self { gimbal, runtime })
    }

    /// The async handle, for calls that return at once.
    pub const fn handle(&self) -> &crate::Gimbal {
        &self.gimbal
    }

    /// Does something with the async handle, and waits until that has ended.
    pub fn call<F: Future>(&self, work: impl FnOnce(crate::Gimbal) -> F) -> F::Output {
        self.runtime.block_on(work(self.gimbal.clone()))
    }

    /// Sends what is still to be sent, ends data streams, and closes the port.
    pub fn close(self) {
        drop(self);
    }
}

impl Drop for Gimbal {
    /// With the runtime ends the task that would send what is left, such as the end of a stream or of a motion.
    fn drop(&mut self) {
        if Handle::try_current().is_err() {
            self.runtime.block_on(self.gimbal.clone().close());
        }
    }
}

#[cfg(all(test, feature = "sim"))]
mod tests {
    use super::*;

    #[test]
    fn a_session_without_async_code() {
        let gimbal = Gimbal::connect("sim").unwrap();
        let board = gimbal.call(|gimbal| async move { gimbal.board_info().await }).unwrap();
        assert_eq!(Some(board), gimbal.handle().found().map(|found| found.board.clone()));
        gimbal.close();
    }

    #[test]
    fn what_is_dropped_last_leaves_the_board_clean() {
        use std::time::Duration;

        use sbgc_proto::CommandId;
        use sbgc_proto::commands::RealtimeData4;

        use crate::sim::{Board, Config, SharedBoard, serve_shared_tcp};

        let elsewhere = Builder::new_multi_thread().worker_threads(1).enable_all().build().unwrap();
        let (board, address) = elsewhere.block_on(async {
            let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
            let address = format!("tcp://{}", listener.local_addr().unwrap());
            let board = SharedBoard::new(Board::new(Config::default()));
            tokio::spawn(serve_shared_tcp(board.clone(), listener));
            (board, address)
        });
        let gimbal = Gimbal::connect(&address).unwrap();
        let stream = gimbal.call(|gimbal| async move {
            gimbal.stream::<RealtimeData4>(Duration::from_millis(20)).await.unwrap()
        });
        drop(stream);
        drop(gimbal);
        let _context = elsewhere.enter();
        // The connection has ended; what was sent before it is taken within a cycle of the board or two.
        let ended = || {
            board.with(|board| {
                let registrations =
                    board.last_commands().filter(|taken| taken.id == CommandId::DataStreamInterval);
                registrations.last().is_some_and(|last| last.payload.get(1..3) == Some(&[0, 0]))
            })
        };
        let until = std::time::Instant::now() + Duration::from_secs(5);
        while !ended() {
            assert!(std::time::Instant::now() < until, "the stream is still registered");
            std::thread::yield_now();
        }
    }
}
