//! Finding out whether there is a board, and which version it speaks.

use sbgc_proto::commands::{BoardInfo, BoardInfoRequest};
use sbgc_proto::frame::Version;
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, Message};

use super::{Gimbal, VersionChoice, encode};
use crate::error::Result;
use crate::machine::Machine;

/// The first firmware that knows version 2.
const KNOWS_VERSION_2: FirmwareVersion = FirmwareVersion::new(2, 68, 0);

/// Whether the firmware knows version 2 of the framing.
pub(crate) fn knows_version_2(info: &BoardInfo) -> bool {
    info.firmware_ver >= KNOWS_VERSION_2
}

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
        let info = self.probe(Version::V2).await?;
        self.prefer_version_2(&info).await;
        Ok(info)
    }

    /// Asks the board what it is, in both versions if none is chosen, beginning with `first`.
    pub(crate) async fn probe(&self, first: Version) -> Result<BoardInfo> {
        self.probe_times(first, self.options.attempts.max(1)).await
    }

    /// The same with so many attempts after the first two.
    pub(crate) async fn probe_times(&self, first: Version, attempts: u32) -> Result<BoardInfo> {
        let VersionChoice::Auto = self.options.version else {
            return self.with_attempts(attempts).board_info().await;
        };
        let (id, payload) = (CommandId::BoardInfo, encode(&BoardInfoRequest {})?);
        let mut call = self.make_call(id, payload, id, attempts)?;
        call.probe = Some(first);
        let answer = self.ask_for(id, call).await?;
        Ok(BoardInfo::decode(&answer)?)
    }

    /// Goes over to version 2 if the firmware knows it and the board answers in it.
    pub(crate) async fn prefer_version_2(&self, info: &BoardInfo) {
        let free = self.options.version == VersionChoice::Auto;
        if free && self.version() == Version::V1 && knows_version_2(info) {
            self.set_version(Version::V2);
            let answers = self.with_attempts(2).board_info().await.is_ok();
            // An answer that came too late says as much, and version 1 would be ignored from now on.
            if !answers && !self.link().look(Machine::has_heard_version_2) {
                self.set_version(Version::V1);
            }
        }
    }

    pub(crate) fn set_version(&self, version: Version) {
        self.link().call(|machine, _| machine.set_version(version));
    }
}
