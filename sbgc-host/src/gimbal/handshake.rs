//! Finding out whether there is a board, and which version it speaks.

use std::time::Duration;

use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;

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
    /// 2.68b0 does not know it. So version 2 is tried first, then version 1, and what was answered is kept.
    pub async fn handshake(&self) -> Result<BoardInfo> {
        let VersionChoice::Auto = self.options.version else {
            return self.board_info().await;
        };
        self.shared.set_version(Version::V2);
        let first = self.with_timeout(PATIENCE.min(self.options.timeout)).with_attempts(TRIES);
        match first.board_info().await {
            Err(Error::Timeout { after, attempts: tried, .. }) => {
                self.shared.set_version(Version::V1);
                match self.board_info().await {
                    Err(Error::Timeout { command, after: last, attempts }) => {
                        // Neither: the next try is as likely to meet a board that knows both.
                        self.shared.set_version(Version::V2);
                        Err(Error::Timeout { command, after: after + last, attempts: attempts + tried })
                    }
                    answered => answered,
                }
            }
            answered => answered,
        }
    }
}
