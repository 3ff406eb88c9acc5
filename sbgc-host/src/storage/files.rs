//! The internal file system.

use sbgc_proto::commands::{
    Confirm, FailureCode, FileId, FilePart, FilePartError, FsClearAll, FsErrorCode, ReadFile, WriteFile,
    WriteFileDelete,
};
use sbgc_proto::units::PageOffset;
use sbgc_proto::{CommandId, Message};

use super::{PORTION, Progress, patient};
use crate::gimbal::{encode, name_of};
use crate::{Error, Gimbal, Result};

/// The longest file: its length is a number of 16 bits.
pub const MAX_FILE: usize = u16::MAX as usize;

/// Pages of a file by which parts are counted.
const PAGE: usize = 64;

/// The commands that write a file.
///
/// # Errors
/// If the data is empty, which would delete the file, or longer than [`MAX_FILE`].
pub fn file_portions(id: FileId, data: &[u8]) -> Result<impl Iterator<Item = WriteFile<'_>>> {
    let Ok(file_size @ 1..) = u16::try_from(data.len()) else {
        return Err(Error::FileSize { size: data.len(), maximum: MAX_FILE });
    };
    let offsets = (0..).step_by(PORTION).map(page);
    let portions = offsets.zip(data.chunks(PORTION));
    Ok(portions.map(move |(page_offset, data)| WriteFile { file_id: id, file_size, page_offset, data }))
}

impl Gimbal {
    /// Reads a file.
    ///
    /// # Errors
    /// If there is no such file or it cannot be read ([`Error::Refused`] with a code of the file system, see
    /// [`Error::file_error`]), or if the board does not answer.
    pub async fn file_read(&self, id: FileId, mut progress: impl Progress) -> Result<Vec<u8>> {
        let mut data = Vec::new();
        loop {
            let part = self.file_part(id, data.len()).await?;
            data.extend_from_slice(&part.data);
            progress(data.len(), part.file_size.max(data.len()));
            let ended = part.data.len() < PORTION || (!part.counts_itself && data.len() >= part.file_size);
            if ended {
                return Ok(data);
            }
            if data.len() > MAX_FILE {
                return Err(Error::WrongLength { what: "file", expected: MAX_FILE, got: data.len() });
            }
        }
    }

    async fn file_part(&self, id: FileId, at: usize) -> Result<Part> {
        let request = ReadFile {
            file_id: id,
            page_offset: page(at),
            max_size: u16::try_from(PORTION).unwrap_or(u16::MAX),
            ..ReadFile::default()
        };
        let answer = self.request_raw(CommandId::ReadFile, encode(&request)?, CommandId::ReadFile).await?;
        if FilePartError::accepts(answer.len()) {
            return Err(refused(CommandId::ReadFile, FilePartError::decode(&answer)?.err_code));
        }
        let part = FilePart::decode(&answer)?;
        let size = usize::from(part.file_size);
        // A part that goes beyond the file is one as the vendor's libraries read it: the size is that of the part, and
        // an error code follows; see `FilePart`.
        let counts_itself = at + part.data.len() > size;
        let (data, code) = match part.data.split_at_checked(size) {
            Some((data, [code])) if counts_itself => (data, FsErrorCode::from(*code)),
            _ => (part.data, FsErrorCode::NoError),
        };
        if code != FsErrorCode::NoError {
            return Err(refused(CommandId::ReadFile, code));
        }
        Ok(Part { data: data.to_vec(), file_size: size, counts_itself })
    }

    /// Writes a file, which is made or replaced, and reads it back.
    ///
    /// # Errors
    /// If the data is empty, which would delete the file, or longer than [`MAX_FILE`]; if the board refuses it; or if
    /// it has other bytes afterwards ([`Error::NotVerified`]).
    pub async fn file_write(&self, id: FileId, data: &[u8], mut progress: impl Progress) -> Result<()> {
        let portions = file_portions(id, data)?;
        progress(0, data.len());
        let mut at = 0;
        for portion in portions {
            self.file_write_portion(&portion, at).await?;
            at += portion.data.len();
            progress(at, data.len());
        }
        let there = self.file_read(id, |_, _| {}).await?;
        if there == data {
            return Ok(());
        }
        let at = there.iter().zip(data).take_while(|(one, other)| one == other).count();
        Err(Error::NotVerified { what: "file", at: u32::try_from(at).unwrap_or(u32::MAX) })
    }

    async fn file_write_portion(&self, write: &WriteFile<'_>, at: usize) -> Result<()> {
        let mut left = self.options().attempts.max(1);
        let mut gimbal = self.clone();
        loop {
            left -= 1;
            let outcome = gimbal.confirm(write).await;
            gimbal = patient(self);
            match outcome {
                Ok(confirmed) => return done(CommandId::WriteFile, confirmed),
                Err(Error::Timeout { .. }) => {}
                Err(error) => return Err(error),
            }
            match self.file_part(write.file_id, at).await {
                Ok(part) if part.data.starts_with(write.data) => return Ok(()),
                _ if left == 0 => return outcome.map(drop),
                Ok(_) | Err(Error::Refused { .. }) => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Deletes a file.
    ///
    /// # Errors
    /// If there is no such file, if the board refuses it, or does not answer.
    pub async fn file_delete(&self, id: FileId) -> Result<()> {
        let delete = WriteFileDelete { file_id: id, ..WriteFileDelete::default() };
        done(CommandId::WriteFile, self.confirm(&delete).await?)
    }

    /// Deletes all files and, as the vendor's library warns, the settings in the EEPROM. Takes about five seconds.
    ///
    /// # Errors
    /// If the board refuses it, or does not answer within ten seconds.
    pub async fn files_clear(&self) -> Result<()> {
        let patient = self.with_timeout(self.options().timeout.max(std::time::Duration::from_secs(10)));
        done(CommandId::FsClearAll, patient.confirm(&FsClearAll {}).await?)
    }
}

struct Part {
    data: Vec<u8>,
    file_size: usize,
    counts_itself: bool,
}

fn page(at: usize) -> PageOffset {
    PageOffset(u16::try_from(at / PAGE).unwrap_or(u16::MAX))
}

/// These commands are confirmed when they fail, too, with the error as the data.
fn done(command: CommandId, confirmed: Confirm) -> Result<()> {
    match u8::try_from(confirmed.data.value()) {
        Ok(0) | Err(_) => Ok(()),
        Ok(code) => Err(refused(command, code.into())),
    }
}

fn refused(command: CommandId, code: FsErrorCode) -> Error {
    Error::Refused {
        command: name_of(command),
        code: code.raw(),
        name: FailureCode::Files(code).name(),
        data: bytes::Bytes::new(),
    }
}
