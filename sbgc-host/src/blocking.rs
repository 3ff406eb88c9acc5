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

use tokio::runtime::{Builder, Runtime};

use crate::connect::ConnectOptions;
use crate::error::Result;
use crate::transport::Address;

/// A board, for programs without async code.
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
        self.runtime.block_on(self.gimbal.close());
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
}
