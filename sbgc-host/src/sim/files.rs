//! The file system of the board: files by their id, in pages of the EEPROM.
//!
//! Real: ids of two bytes, portions that begin at pages of 64 bytes, files that are made, resized and deleted by
//! writing, the error codes. The layout in the EEPROM is this program's own: a directory of 32 files, a table that
//! chains pages, and the pages.

use sbgc_proto::commands::{FileId, FsErrorCode};

use super::eeprom::{Eeprom, FILES_AT, PAGE};

/// How many files there can be.
const FILES: usize = 32;

/// Bytes of a directory entry: id, size, first page.
const ENTRY: usize = 6;

const TABLE_AT: usize = FILES_AT + FILES * ENTRY;

/// What stands in the table for a free page, and for the last one of a file.
const FREE: u16 = 0xFFFF;
const LAST: u16 = 0xFFFE;

/// A file as the directory has it.
#[derive(Clone, Copy, Debug)]
struct Entry {
    place: usize,
    size: u16,
    first: u16,
}

/// Access to the files in an EEPROM.
#[derive(Debug)]
pub(super) struct Files<'e>(pub(super) &'e mut Eeprom);

impl Files<'_> {
    /// Where the pages begin, and how many there are.
    fn pages(&self) -> (usize, usize) {
        let total = self.0.len().saturating_sub(TABLE_AT);
        let count = total / (PAGE + 2);
        let start = (TABLE_AT + count * 2).next_multiple_of(PAGE);
        (start, count.saturating_sub(1))
    }

    fn number(&self, at: usize) -> u16 {
        let bytes = self.0.read(at, 2).unwrap_or(&[0xFF, 0xFF]);
        u16::from_le_bytes(bytes.try_into().unwrap_or([0xFF; 2]))
    }

    fn set_number(&mut self, at: usize, number: u16) {
        self.0.write(at, &number.to_le_bytes());
    }

    fn entry(&self, id: FileId) -> Option<Entry> {
        (0..FILES).map(|index| FILES_AT + index * ENTRY).find_map(|place| {
            let present = self.number(place) == id.0 && id.0 != FREE;
            present.then(|| Entry { place, size: self.number(place + 2), first: self.number(place + 4) })
        })
    }

    /// The pages of a file, in order; short if the chain is broken.
    fn chain(&self, first: u16) -> Vec<u16> {
        let (_, count) = self.pages();
        let mut chain = Vec::new();
        let mut page = first;
        while usize::from(page) < count && chain.len() <= count {
            chain.push(page);
            page = self.number(TABLE_AT + usize::from(page) * 2);
        }
        chain
    }

    /// Deletes all files.
    pub(super) fn clear(&mut self) {
        let (start, _) = self.pages();
        let erased = vec![0xFF; start.saturating_sub(FILES_AT)];
        self.0.write(FILES_AT, &erased);
    }

    /// The size of a file, if there is one.
    pub(super) fn size(&self, id: FileId) -> Option<u16> {
        self.entry(id).map(|entry| entry.size)
    }

    /// The whole of a file.
    pub(super) fn content(&self, id: FileId) -> Result<Vec<u8>, FsErrorCode> {
        let entry = self.entry(id).ok_or(FsErrorCode::FileNotFound)?;
        let (start, _) = self.pages();
        let mut content = Vec::new();
        for page in self.chain(entry.first) {
            let bytes = self.0.read(start + usize::from(page) * PAGE, PAGE).ok_or(FsErrorCode::Fat)?;
            content.extend_from_slice(bytes);
        }
        if content.len() < entry.size.into() {
            return Err(FsErrorCode::FileCorrupted);
        }
        content.truncate(entry.size.into());
        Ok(content)
    }

    /// Writes a portion at a page; makes the file, or gives it another size, where needed.
    pub(super) fn write(
        &mut self,
        id: FileId,
        size: u16,
        page_offset: u16,
        data: &[u8],
    ) -> Result<(), FsErrorCode> {
        let start = usize::from(page_offset) * PAGE;
        if id.0 == FREE || id.file_type().raw() == 0 {
            return Err(FsErrorCode::WrongParams);
        }
        if size == 0 || start.saturating_add(data.len()) > usize::from(size) {
            return Err(FsErrorCode::FileSize);
        }
        self.resize(id, size)?;
        let entry = self.entry(id).ok_or(FsErrorCode::Fat)?;
        let (pages_at, _) = self.pages();
        let chain = self.chain(entry.first);
        for (part, page) in data.chunks(PAGE).zip(chain.iter().skip(page_offset.into())) {
            if !self.0.write(pages_at + usize::from(*page) * PAGE, part) {
                return Err(FsErrorCode::EepromFault);
            }
        }
        Ok(())
    }

    /// Replaces a file as a whole.
    pub(super) fn replace(&mut self, id: FileId, content: &[u8]) -> Result<(), FsErrorCode> {
        let size = u16::try_from(content.len()).map_err(|_| FsErrorCode::FileSize)?;
        self.write(id, size, 0, content)
    }

    pub(super) fn delete(&mut self, id: FileId) -> Result<(), FsErrorCode> {
        let entry = self.entry(id).ok_or(FsErrorCode::FileNotFound)?;
        for page in self.chain(entry.first) {
            self.set_number(TABLE_AT + usize::from(page) * 2, FREE);
        }
        self.0.write(entry.place, &[0xFF; ENTRY]);
        Ok(())
    }

    fn resize(&mut self, id: FileId, size: u16) -> Result<(), FsErrorCode> {
        let wanted = usize::from(size).div_ceil(PAGE);
        let (entry, mut chain) = match self.entry(id) {
            Some(entry) => (entry.place, self.chain(entry.first)),
            None => {
                let mut places = (0..FILES).map(|index| FILES_AT + index * ENTRY);
                let place = places.find(|place| self.number(*place) == FREE);
                (place.ok_or(FsErrorCode::FatIsFull)?, Vec::new())
            }
        };
        let (_, count) = self.pages();
        let free: Vec<u16> = (0..count)
            .filter(|page| self.number(TABLE_AT + page * 2) == FREE)
            .filter_map(|page| u16::try_from(page).ok())
            .take(wanted.saturating_sub(chain.len()))
            .collect();
        if chain.len() + free.len() < wanted {
            return Err(FsErrorCode::NoFreeSpace);
        }
        for page in chain.drain(wanted.min(chain.len())..).collect::<Vec<_>>() {
            self.set_number(TABLE_AT + usize::from(page) * 2, FREE);
        }
        chain.extend(free);
        let next = chain.iter().skip(1).copied().chain([LAST]);
        for (page, next) in chain.iter().zip(next) {
            self.set_number(TABLE_AT + usize::from(*page) * 2, next);
        }
        self.set_number(entry, id.0);
        self.set_number(entry + 2, size);
        self.set_number(entry + 4, chain.first().copied().unwrap_or(LAST));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use sbgc_proto::commands::FileType;

    use super::*;

    fn script(number: u8) -> FileId {
        FileId::new(FileType::Script, number)
    }

    fn pattern(length: usize) -> Vec<u8> {
        (0..length).map(|index| u8::try_from(index % 251).unwrap()).collect()
    }

    #[test]
    fn files_grow_shrink_and_go() {
        let mut eeprom = Eeprom::new(32 * 1024);
        let mut files = Files(&mut eeprom);
        let content = pattern(300);
        files.write(script(0), 300, 0, &content[..128]).unwrap();
        files.write(script(1), 10, 0, &[1; 10]).unwrap();
        files.write(script(0), 300, 2, &content[128..]).unwrap();
        assert_eq!(files.content(script(0)).unwrap(), content);
        files.write(script(0), 100, 0, &content[..64]).unwrap();
        assert_eq!(files.content(script(0)).unwrap(), content[..100]);
        assert_eq!(files.content(script(1)).unwrap(), [1; 10]);
        files.delete(script(0)).unwrap();
        assert_eq!(files.content(script(0)), Err(FsErrorCode::FileNotFound));
        assert_eq!(files.delete(script(0)), Err(FsErrorCode::FileNotFound));
        files.clear();
        assert_eq!(files.size(script(1)), None);
    }

    #[test]
    fn what_does_not_fit_is_refused_and_nothing_is_lost() {
        let mut eeprom = Eeprom::new(32 * 1024);
        let mut files = Files(&mut eeprom);
        let big = pattern(20_000);
        files.replace(script(0), &big).unwrap();
        assert_eq!(files.replace(script(1), &big), Err(FsErrorCode::NoFreeSpace));
        assert_eq!(files.content(script(0)).unwrap(), big);
        assert_eq!(files.write(script(1), 10, 0, &[0; 11]), Err(FsErrorCode::FileSize));
        for number in 1..32 {
            files.replace(script(number), &[number]).unwrap();
        }
        assert_eq!(files.replace(script(32), &[1]), Err(FsErrorCode::FatIsFull));
        assert_eq!(files.content(script(31)).unwrap(), [31]);
    }
}
