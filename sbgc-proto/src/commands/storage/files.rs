//! The internal file system: scripts, calibrations, look-up tables, profile sets.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{Confirm, FsErrorCode};
use crate::units::PageOffset;
use crate::wire::{Reserved, bit_enums, bit_fields};

/// Asks for a part of a file.
///
/// The board answers with the bytes from the offset on, up to the end of the file and not more than asked for; or,
/// where that fails, with [`FilePartError`]. A part must fit into one message, which leaves 251 bytes for it.
#[message(CMD_READ_FILE, outgoing, size = 20, answer = FilePart<'answer>, echo = page_offset)]
pub struct ReadFile {
    /// Which file.
    pub file_id: FileId,
    /// Where the part starts.
    pub page_offset: PageOffset,
    /// The most bytes that the answer may have.
    #[wire(unit = "byte")]
    pub max_size: u16,
    pub reserved: Reserved<14>,
}

/// A part of a file.
///
/// The vendor's libraries expect one more byte after the part, an error code, and take
/// [`file_size`](Self::file_size) for the length of the part; the specification knows neither, and that is the reading
/// here. If exactly one byte more than asked for comes, it is that code.
#[message(CMD_READ_FILE, incoming, form = "success", default, size = 4..=255, length = 4..)]
pub struct FilePart<'a> {
    /// How long the whole file is.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Where the part starts, as the request had it.
    pub page_offset: PageOffset,
    /// The part: as long as was asked for, or shorter at the end of the file.
    pub data: &'a [u8],
}

/// A part of a file could not be read.
#[message(CMD_READ_FILE, incoming, form = "error", size = 1, length = 1)]
pub struct FilePartError {
    /// Why.
    pub err_code: FsErrorCode,
}

/// Writes a part of a file.
///
/// A file that does not exist is made, and one of another size is made to have
/// [`file_size`](Self::file_size). The board confirms always, with a [`FsErrorCode`] as the data of the
/// confirmation. Without data this would be a [`WriteFileDelete`].
#[message(CMD_WRITE_FILE, outgoing, form = "write", default, size = 7..=255, length = 7.., answer = Confirm)]
pub struct WriteFile<'a> {
    /// Which file.
    pub file_id: FileId,
    /// How long the whole file is to be.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Where the part starts.
    pub page_offset: PageOffset,
    /// The part. The specification wants less than the file size; all of a small file at once must be meant too.
    pub data: &'a [u8],
}

/// Deletes a file: a write without data.
///
/// The board confirms always, with a [`FsErrorCode`] as the data of the confirmation.
#[message(CMD_WRITE_FILE, outgoing, form = "delete", size = 6, length = 6, answer = Confirm)]
pub struct WriteFileDelete {
    /// Which file.
    pub file_id: FileId,
    /// Without meaning here.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Without meaning here.
    pub page_offset: PageOffset,
}

/// Deletes all files.
///
/// Takes about five seconds and, as the vendor's library warns, erases the settings in the EEPROM as well. The board
/// confirms when it is done, with a [`FsErrorCode`] as the data of the confirmation.
#[message(CMD_FS_CLEAR_ALL, outgoing, size = 0, answer = Confirm, slow)]
pub struct FsClearAll {}

bit_fields! {
    /// Which file: its type, and what tells it from others of that type.
    ///
    /// ```
    /// use sbgc_proto::commands::{FileId, FileType};
    ///
    /// let script = FileId::new(FileType::Script, 2);
    /// assert_eq!(script, FileId(0x0201));
    /// assert_eq!(script.file_type(), FileType::Script);
    /// ```
    pub struct FileId: u16 {
        /// What the file holds: the first byte on the wire.
        0..=7 => file_type / with_file_type "FILE_TYPE": FileType,
        /// What tells it from others of its type, for a script the slot. The specification only says that it depends
        /// on the type.
        8..=15 => number / with_number "NUMBER": u8,
    }
}

impl FileId {
    /// The file of this type and number.
    pub fn new(file_type: FileType, number: u8) -> Self {
        Self(0).with_file_type(file_type).with_number(number)
    }
}

/// What a file holds. Spec: `FILE_TYPE`.
#[open_enum(u8)]
pub enum FileType {
    /// A script of the user.
    #[wire(spec = "FILE_TYPE_SCRIPT")]
    Script = 1,
    /// Calibrations of an inertial measurement unit.
    #[wire(spec = "FILE_TYPE_IMU_CALIB")]
    ImuCalib = 3,
    /// Corrections for the cogging of a motor.
    #[wire(spec = "FILE_TYPE_COGGING_CORRECTION")]
    CoggingCorrection = 4,
    /// A look-up table for an adjustable variable.
    #[wire(spec = "FILE_TYPE_ADJ_VAR_LUT")]
    AdjVarLut = 5,
    /// A set of profiles, as `CMD_PROFILE_SET` keeps them.
    #[wire(spec = "FILE_TYPE_PROFILE_SET")]
    ProfileSet = 6,
    /// Parameters.
    #[wire(spec = "FILE_TYPE_PARAMS")]
    Params = 7,
    /// A tune for the beeper.
    #[wire(spec = "FILE_TYPE_TUNE")]
    Tune = 8,
    /// Data of motor drivers on the CAN bus.
    #[wire(spec = "FILE_TYPE_CANDRV")]
    CanDrv = 10,
}
bit_enums!(FileType);
