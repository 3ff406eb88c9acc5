//! Finding out whether there is a board, and which version it speaks.

use std::time::Duration;

use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;
use tokio::time::Instant;

use super::{Gimbal, VersionChoice};
use crate::{Error, Result};

/// How long an answer in version 2 may take. A board that knows it answers within two of its cycles, so this is for
/// the line and whatever is between.
const PATIENCE: Duration = Duration::from_millis(200);

/// How often version 2 is tried: a byte lost once must not cost the better checksum for the whole session.
const TRIES: u32 = 2;

impl Gimbal {
    /// Asks the board what it is and settles on a version.
    ///
    /// A board that has seen version 2 once takes nothing else until it restarts, and one whose firmware is older than
    /// 2.68b0 does not know it. So version 2 is tried first, in a hurry, then both in turn, beginning with version 1: on
    /// a line that loses much, silence in one says little. What was answered is kept.
    pub async fn handshake(&self) -> Result<BoardInfo> {
        let VersionChoice::Auto = self.options.version else {
            return self.board_info().await;
        };
        let began = Instant::now();
        let hurried = self.with_timeout(PATIENCE.min(self.options.timeout)).with_attempts(TRIES);
        let mut outcome = hurried.board_info_in(Version::V2).await;
        let mut sent = 0;
        for version in [Version::V1, Version::V2].into_iter().cycle().take(self.tries()) {
            let Err(Error::Timeout { attempts, .. }) = outcome else { return outcome };
            sent += attempts;
            outcome = self.with_attempts(1).board_info_in(version).await;
        }
        if let Err(Error::Timeout { after, attempts, .. }) = &mut outcome {
            // The next try is as likely to meet a board that knows both.
            self.shared.set_version(Version::V2);
            *attempts += sent;
            *after = began.elapsed();
        }
        outcome
    }

    fn tries(&self) -> usize {
        usize::try_from(self.options.attempts.max(1)).unwrap_or(usize::MAX)
    }

    async fn board_info_in(&self, version: Version) -> Result<BoardInfo> {
        self.shared.set_version(version);
        self.board_info().await
    }
}
