//! The EEPROM: everything that outlives a reset.
//!
//! ```text
//!  0x0000  header: magic, layout, active profile, profile set, calibrations   64 bytes
//!  0x0040  names of the profiles                                             256
//!  0x0140  user data (CMD_WRITE_EXTERNAL_DATA)                               128
//!  0x01C0  slots of adjustable variables (CMD_WRITE_ADJ_VARS_CFG)            128
//!  0x0240  state variables (CMD_WRITE_STATE_VARS)                            192
//!  0x0300  configuration of automatic tuning                                 128
//!  0x0400  profiles 0 to 4, 640 bytes each: the four blocks of parameters   3200
//!  0x1080  file system, to the end
//! ```
//!
//! The places are those of this simulated board: where a real one keeps what is not published. What is written by
//! `CMD_EEPROM_WRITE` is therefore what the commands read, after the next reset.

use std::ops::Range;

use sbgc_proto::CommandId;

/// Size of a page, which addresses are aligned to.
pub(super) const PAGE: usize = 64;

/// The start of a header that this program has written, with the version of the layout.
const MAGIC: [u8; 4] = *b"SBG1";

const PROFILES_AT: usize = 0x0400;
const PROFILE_SIZE: usize = 640;

/// Parts of the image that commands read and write as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Region {
    Names,
    UserData,
    VariableSlots,
    StateVars,
    Tuning,
    /// A block of parameters of a profile.
    Block(u8, Block),
    /// All profiles with their blocks.
    Profiles,
}

/// The four blocks of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Block {
    Params3,
    Ext,
    Ext2,
    Ext3,
}

impl Block {
    pub(super) const ALL: [Self; 4] = [Self::Params3, Self::Ext, Self::Ext2, Self::Ext3];

    pub(super) const fn size(self) -> usize {
        match self {
            Self::Params3 => 134,
            Self::Ext => 104,
            Self::Ext2 => 151,
            Self::Ext3 => 221,
        }
    }

    /// The command that reads it.
    pub(super) const fn read_by(self) -> CommandId {
        match self {
            Self::Params3 => CommandId::ReadParams3,
            Self::Ext => CommandId::ReadParamsExt,
            Self::Ext2 => CommandId::ReadParamsExt2,
            Self::Ext3 => CommandId::ReadParamsExt3,
        }
    }

    const fn offset(self) -> usize {
        match self {
            Self::Params3 => 0,
            Self::Ext => 134,
            Self::Ext2 => 238,
            Self::Ext3 => 389,
        }
    }
}

impl Region {
    const fn range(self) -> Range<usize> {
        let (start, size) = match self {
            Self::Names => (0x0040, 240),
            Self::UserData => (0x0140, 128),
            Self::VariableSlots => (0x01C0, 128),
            Self::StateVars => (0x0240, 192),
            Self::Tuning => (0x0300, 128),
            Self::Block(profile, block) => {
                (PROFILES_AT + PROFILE_SIZE * profile as usize + block.offset(), block.size())
            }
            Self::Profiles => (PROFILES_AT, PROFILE_SIZE * 5),
        };
        start..start + size
    }
}

/// Single bytes of the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cell {
    ActiveProfile = 4,
    ProfileSet = 5,
    /// The IMU that calibrations are for.
    SelectedImu = 6,
    /// The scale of the voltage sensor, in 1/128.
    VoltageScale = 7,
    /// Sensors that have been calibrated, a bit each.
    Calibrated = 8,
    /// Limits of the accelerometer that have been calibrated.
    AccelerometerLimits = 9,
    /// Whether calibrations by temperature are in use.
    TemperatureCalibrations = 10,
    /// Axes whose cogging is corrected.
    Cogging = 11,
    /// The four bytes of the password protection.
    Protection = 12,
}

/// Where the file system begins.
pub(super) const FILES_AT: usize = 0x1080;

/// The least size that has room for everything but files.
pub(super) const LEAST_SIZE: usize = FILES_AT + 0x0580;

/// The image, and how often it was changed.
#[derive(Clone, Debug)]
pub(super) struct Eeprom {
    bytes: Vec<u8>,
    changes: u64,
}

impl Eeprom {
    /// An erased one of `size` bytes, which is at least what the layout needs.
    pub(super) fn new(size: usize) -> Self {
        Self { bytes: vec![0xFF; size.max(LEAST_SIZE)], changes: 0 }
    }

    /// The one that was saved; `None` if it has no room for what is kept in it.
    pub(super) fn from_image(bytes: Vec<u8>) -> Option<Self> {
        (bytes.len() >= LEAST_SIZE).then_some(Self { bytes, changes: 0 })
    }

    pub(super) fn image(&self) -> &[u8] {
        &self.bytes
    }

    /// A number that grows with each change.
    pub(super) fn changes(&self) -> u64 {
        self.changes
    }

    pub(super) fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Whether it has been laid out, and not erased since.
    pub(super) fn is_formatted(&self) -> bool {
        self.bytes.starts_with(&MAGIC)
    }

    pub(super) fn erase(&mut self) {
        self.bytes.fill(0xFF);
        self.changes += 1;
    }

    pub(super) fn format(&mut self) {
        self.write(0, &MAGIC);
        self.write(MAGIC.len(), &[0; PAGE - MAGIC.len()]);
    }

    pub(super) fn read(&self, start: usize, size: usize) -> Option<&[u8]> {
        start.checked_add(size).and_then(|end| self.bytes.get(start..end))
    }

    /// Writes bytes; false if they are not all within it.
    pub(super) fn write(&mut self, start: usize, bytes: &[u8]) -> bool {
        let place = start.checked_add(bytes.len()).and_then(|end| self.bytes.get_mut(start..end));
        let Some(place) = place else { return false };
        if place != bytes {
            place.copy_from_slice(bytes);
            self.changes += 1;
        }
        true
    }

    pub(super) fn region(&self, region: Region) -> &[u8] {
        self.bytes.get(region.range()).unwrap_or_default()
    }

    /// Replaces a region; what is shorter leaves the rest as it is, what is longer is cut.
    pub(super) fn set_region(&mut self, region: Region, bytes: &[u8]) {
        let range = region.range();
        let bytes = bytes.get(..range.len()).unwrap_or(bytes);
        self.write(range.start, bytes);
    }

    pub(super) fn cell(&self, cell: Cell) -> u8 {
        self.bytes.get(cell as usize).copied().unwrap_or_default()
    }

    pub(super) fn set_cell(&mut self, cell: Cell, value: u8) {
        self.write(cell as usize, &[value]);
    }

    pub(super) fn protection(&self) -> [u8; 4] {
        let bytes = self.read(Cell::Protection as usize, 4).unwrap_or_default();
        bytes.try_into().unwrap_or_default()
    }

    pub(super) fn set_protection(&mut self, flags: [u8; 4]) {
        self.write(Cell::Protection as usize, &flags);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_region_overlaps_another() {
        let mut regions = vec![
            Region::Names.range(),
            Region::UserData.range(),
            Region::VariableSlots.range(),
            Region::StateVars.range(),
            Region::Tuning.range(),
        ];
        for profile in 0..5 {
            regions.extend(Block::ALL.map(|block| Region::Block(profile, block).range()));
        }
        regions.push(FILES_AT..LEAST_SIZE);
        for pair in regions.windows(2) {
            assert!(pair[0].end <= pair[1].start, "{pair:?}");
        }
        assert!(regions[0].start >= PAGE);
        assert_eq!(Region::Profiles.range().end, FILES_AT);
    }

    #[test]
    fn writing_what_is_there_is_no_change() {
        let mut eeprom = Eeprom::new(0);
        eeprom.format();
        let changes = eeprom.changes();
        assert!(eeprom.write(0, &MAGIC));
        assert_eq!(eeprom.changes(), changes);
        eeprom.set_cell(Cell::ActiveProfile, 3);
        assert_eq!((eeprom.cell(Cell::ActiveProfile), eeprom.changes()), (3, changes + 1));
        assert!(!eeprom.write(LEAST_SIZE - 1, &[1, 2]) && !eeprom.write(usize::MAX, &[1]));
        assert!(eeprom.is_formatted());
        eeprom.erase();
        assert!(!eeprom.is_formatted());
    }
}
