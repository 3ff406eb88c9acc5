//! Finding out whether there is a board, and which version it speaks.

use sbgc_proto::commands::{BoardInfo, BoardInfoRequest};
use sbgc_proto::frame::Version;
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, Message};

use super::{Gimbal, VersionChoice, encode};
use crate::error::Result;

/// The first firmware that knows version 2.
const KNOWS_VERSION_2: FirmwareVersion = FirmwareVersion::new(2, 68, 0);

impl Gimbal {
    /// Asks the board what it is and settles on a version.
    ///
    /// With [`VersionChoice::Auto`] version 2 is tried first with a short timeout, then both versions alternate, as often
    /// as a read is sent. The version of the answer decides, however late it comes: whatever a board has once been asked
    /// in, it answers in. Firmware that knows version 2 and was heard in version 1 is asked once more in version 2.
    ///
    /// # Errors
    /// If no board answers.
    pub async fn handshake(&self) -> Result<BoardInfo> {
        let VersionChoice::Auto = self.options.version else {
            return self.board_info().await;
        };
        let (id, payload) = (CommandId::BoardInfo, encode(&BoardInfoRequest {})?);
        let mut call = self.make_call(id, payload, id, self.options.attempts.max(1))?;
        call.probe = true;
        let answer = self.ask_for(id, call).await?;
        let info = BoardInfo::decode(&answer)?;
        if self.version() == Version::V1 && info.firmware_ver >= KNOWS_VERSION_2 {
            self.set_version(Version::V2);
            if self.with_attempts(1).board_info().await.is_err() {
                self.set_version(Version::V1);
            }
        }
        Ok(info)
    }

    fn set_version(&self, version: Version) {
        self.link().call(|machine, _| machine.set_version(version));
    }
}
