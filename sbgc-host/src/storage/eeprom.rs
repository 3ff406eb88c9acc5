//! The EEPROM as plain memory.

use sbgc_proto::commands::{EepromReadRequest, EepromWrite};

use super::{PORTION, Progress, patient};
use crate::{Error, Gimbal, Result};

/// The EEPROM is read and written in pages of this many bytes.
pub const EEPROM_PAGE: usize = 64;

/// The commands that write pages of the EEPROM.
///
/// # Errors
/// If address or length are not multiples of [`EEPROM_PAGE`], or there is nothing to write.
pub fn eeprom_portions(address: u32, data: &[u8]) -> Result<impl Iterator<Item = EepromWrite<'_>>> {
    let start = usize::try_from(address).unwrap_or(usize::MAX);
    for (what, value) in [("EEPROM address", start), ("length of the EEPROM block", data.len())] {
        if value % EEPROM_PAGE != 0 {
            return Err(Error::Misaligned { what, value, step: EEPROM_PAGE });
        }
    }
    if data.is_empty() {
        return Err(Error::WrongLength { what: "EEPROM block", expected: EEPROM_PAGE, got: 0 });
    }
    let addresses = (address..).step_by(PORTION);
    Ok(addresses.zip(data.chunks(PORTION)).map(|(addr, data)| EepromWrite { addr, data }))
}

impl Gimbal {
    /// Size of the EEPROM in bytes.
    ///
    /// # Errors
    /// If the board does not answer.
    pub async fn eeprom_size(&self) -> Result<u32> {
        Ok(self.board_info3().await?.eeprom_size)
    }

    /// Reads bytes of the EEPROM, from any address.
    ///
    /// # Errors
    /// If the board refuses it, as it does beyond the end, or does not answer.
    pub async fn eeprom_read(
        &self,
        address: u32,
        length: usize,
        mut progress: impl Progress,
    ) -> Result<Vec<u8>> {
        let skip = usize::try_from(address).unwrap_or(usize::MAX) % EEPROM_PAGE;
        let mut next = address - u32::try_from(skip).unwrap_or_default();
        let wanted = skip.saturating_add(length);
        let mut data = Vec::with_capacity(length.min(1 << 20));
        progress(0, length);
        while data.len() < wanted {
            let pages = (wanted - data.len()).div_ceil(EEPROM_PAGE) * EEPROM_PAGE;
            let size = pages.min(PORTION);
            let request = EepromReadRequest { addr: next, size: u16::try_from(size).unwrap_or(u16::MAX) };
            let answer = self.exchange(&request).await?;
            let block = answer.get().data;
            if block.len() != size {
                return Err(Error::WrongLength { what: "EEPROM block", expected: size, got: block.len() });
            }
            data.extend_from_slice(block);
            next = next.wrapping_add(u32::from(request.size));
            progress(data.len().saturating_sub(skip).min(length), length);
        }
        data.truncate(wanted);
        data.drain(..skip.min(data.len()));
        Ok(data)
    }

    /// Writes pages of the EEPROM and reads each back.
    ///
    /// **Nothing checks what is written**: wrong bytes destroy settings and calibrations. Keep a copy of what was there.
    ///
    /// # Errors
    /// If address or length are not multiples of [`EEPROM_PAGE`], if the board refuses it, or if it has other bytes
    /// afterwards ([`Error::NotVerified`]).
    pub async fn eeprom_write(&self, address: u32, data: &[u8], mut progress: impl Progress) -> Result<()> {
        let portions = eeprom_portions(address, data)?;
        progress(0, data.len());
        let mut done = 0;
        for portion in portions {
            self.eeprom_write_portion(&portion).await?;
            done += portion.data.len();
            progress(done, data.len());
        }
        Ok(())
    }

    async fn eeprom_write_portion(&self, portion: &EepromWrite<'_>) -> Result<()> {
        let EepromWrite { addr: address, data } = *portion;
        let mut left = self.options().attempts.max(1);
        let mut gimbal = self.clone();
        loop {
            left -= 1;
            let outcome = gimbal.confirm(portion).await;
            gimbal = patient(self);
            if !matches!(outcome, Ok(_) | Err(Error::Timeout { .. })) {
                return outcome.map(drop);
            }
            let there = self.eeprom_read(address, data.len(), |_, _| {}).await?;
            if there == data {
                return Ok(());
            }
            // Confirmed but different is no accident of the line.
            if outcome.is_ok() || left == 0 {
                outcome?;
                return Err(Error::NotVerified { what: "EEPROM page", at: address });
            }
        }
    }
}
