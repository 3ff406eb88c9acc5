//! Parameters and memory.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    ConfirmData, EepromRead, EepromReadRequest, EepromWrite, ProfileId, WriteProfileNames,
};

use super::{Refusal, Replies, Reply, confirm, message, send};
use crate::sim::machine::Machine;
use crate::sim::parameters::{PROFILES, Parameters};

/// Size of a page of the EEPROM.
const PAGE: usize = 64;

/// The most pages that are read at once.
const MOST_PAGES: usize = 3;

impl Machine {
    pub(super) fn read_block(&self, id: CommandId, profile: ProfileId) -> Replies {
        send(self.parameters.read(id, profile))
    }

    pub(super) fn write_block(
        &mut self,
        written_by: CommandId,
        read_by: CommandId,
        payload: &[u8],
    ) -> Replies {
        self.parameters.write(read_by, payload)?;
        confirm(written_by, ConfirmData::U8(0))
    }

    pub(super) fn write_names(&mut self, WriteProfileNames(names): WriteProfileNames) -> Replies {
        self.parameters.rename(names);
        confirm(CommandId::WriteProfileNames, ConfirmData::U8(0))
    }

    /// Puts profiles back to what they were in the factory. Erasing the EEPROM restarts the board.
    pub(super) fn use_defaults(&mut self, profile: ProfileId) -> Replies {
        let mut replies = confirm(CommandId::UseDefaults, ConfirmData::U8(0))?;
        match profile {
            ProfileId::EraseEeprom => {
                self.parameters = Parameters::new(0, &[]);
                self.eeprom.fill(0xFF);
                replies.push(Reply::Reset { after: Duration::ZERO });
            }
            ProfileId::ResetCurrent => self.parameters.restore(self.parameters.active()),
            profile if profile.raw() < PROFILES => self.parameters.restore(profile.raw()),
            _ => return Err(Refusal::Parameters),
        }
        Ok(replies)
    }

    pub(super) fn read_eeprom(&self, request: &EepromReadRequest) -> Replies {
        let (start, size) = (index(request.addr)?, usize::from(request.size));
        if size == 0 || size % PAGE != 0 || size > MOST_PAGES * PAGE {
            return Err(Refusal::Parameters);
        }
        let data = start.checked_add(size).and_then(|end| self.eeprom.get(start..end));
        message(&EepromRead { addr: request.addr, data: data.ok_or(Refusal::Parameters)? })
    }

    pub(super) fn write_eeprom(&mut self, write: &EepromWrite<'_>) -> Replies {
        let start = index(write.addr)?;
        let place = start.checked_add(write.data.len()).and_then(|end| self.eeprom.get_mut(start..end));
        place.ok_or(Refusal::Parameters)?.copy_from_slice(write.data);
        let address = u16::try_from(write.addr).map_or(ConfirmData::U32(write.addr), ConfirmData::U16);
        confirm(CommandId::EepromWrite, address)
    }
}

/// The place of an address, which must be that of a page.
fn index(address: u32) -> Result<usize, Refusal> {
    let index = usize::try_from(address).map_err(|_| Refusal::Parameters)?;
    if index % PAGE == 0 { Ok(index) } else { Err(Refusal::Parameters) }
}
