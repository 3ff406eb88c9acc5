//! From an address to a board that answers: opening, detection, and opening again.

mod options;
mod peek;
mod search;

use bytes::Bytes;
use sbgc_proto::CommandId;
use sbgc_proto::commands::BoardInfo3;
use sbgc_proto::frame::Version;

use crate::error::Result;
pub use crate::foreign::{Foreign, recognise};
use crate::gimbal::{Found, Gimbal, VersionChoice, knows_version_2};
use crate::machine::Identity;
use crate::transport::Address;
pub use options::{ConnectOptions, Reconnect, Wrap};
use search::Search;
pub use search::{Tried, detect, survey};

impl Gimbal {
    /// Opens an address, finds the board there, and goes on with the same board when the port was lost.
    ///
    /// ```
    /// # #[cfg(feature = "sim")]
    /// # #[tokio::main(flavor = "current_thread")]
    /// # async fn main() -> sbgc_host::Result<()> {
    /// use sbgc_host::Gimbal;
    ///
    /// let gimbal = Gimbal::connect(&"sim".parse()?).await?;
    /// assert!(gimbal.found().is_some_and(|found| found.device_id.is_some()));
    /// # gimbal.close().await;
    /// # Ok(())
    /// # }
    /// # #[cfg(not(feature = "sim"))]
    /// # fn main() {}
    /// ```
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub async fn connect(address: &Address) -> Result<Self> {
        Self::connect_with(address, ConnectOptions::default()).await
    }

    /// Like [`connect`](Self::connect), with options.
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub async fn connect_with(address: &Address, options: ConnectOptions) -> Result<Self> {
        Self::connect_through(address, options, None).await
    }

    /// Like [`connect_with`](Self::connect_with), with something between the port and the driver.
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub async fn connect_through(
        address: &Address,
        options: ConnectOptions,
        wrap: Option<Wrap>,
    ) -> Result<Self> {
        let mut search = Search::new(address, options);
        for line in search.lines() {
            let (gimbal, tried) = match search.try_line(line, wrap.as_ref()).await {
                Ok(tried) => tried,
                Err(tried) => return Err(tried.outcome.err().unwrap_or(crate::Error::Closed)),
            };
            match tried.outcome {
                Ok(found) => {
                    gimbal.settle(found, options.reconnect).await;
                    return Ok(gimbal);
                }
                Err(_) => gimbal.close().await,
            }
        }
        Err(search.failed())
    }

    /// Settles on a version and keeps what was found; who the board is only if it is to be found again.
    async fn settle(&self, mut found: Found, reconnect: Reconnect) {
        if reconnect == Reconnect::Never {
            self.prefer_version_2(&found.board).await;
        } else {
            self.remember(&mut found).await;
        }
        found.version = self.version();
        tracing::info!("{}: {found}", found.address);
        self.set_found(found);
    }

    /// Keeps who the board is. Asking for that settles the version as well.
    async fn remember(&self, found: &mut Found) {
        let board = &found.board;
        let newer = self.options().version == VersionChoice::Auto
            && self.version() == Version::V1
            && knows_version_2(board);
        let mut info = if newer { self.identity_in_version_2().await } else { None };
        if info.is_none() {
            info = self.board_info3().await.ok();
        }
        let identity = match info {
            Some(info) => {
                found.device_id = Some(info.device_id.0);
                let front = Bytes::copy_from_slice(&info.device_id.0);
                Identity { command: CommandId::BoardInfo3.raw(), front }
            }
            // Old firmware has no identity. What answers there is taken for the same.
            None => Identity { command: CommandId::BoardInfo.raw(), front: Bytes::new() },
        };
        self.link().call(|machine, _| machine.set_identity(identity));
    }

    /// Asks in version 2, and keeps to that if the board answers.
    async fn identity_in_version_2(&self) -> Option<BoardInfo3> {
        self.set_version(Version::V2);
        let info = self.with_attempts(2).board_info3().await.ok();
        if info.is_none() {
            self.set_version(Version::V1);
        }
        info
    }
}

#[cfg(test)]
mod tests;
