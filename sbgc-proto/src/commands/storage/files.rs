//! The internal file system: scripts, calibrations, look-up tables, profile sets.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::commands::{Confirm, FsErrorCode};

use crate::units::PageOffset;
use crate::wire::Reserved;

/// Requests a part of a file.
///
/// The board answers with the bytes from the offset, up to the end of the file and not more than requested; or,
/// where that fails, with [`FilePartError`]. A part must fit into one message, which leaves 251 bytes for it.
#[message(CMD_READ_FILE, outgoing, size = 20, answer = FilePart<'answer>, echo = page_offset)]
pub struct ReadFile {
    /// File id.
    pub file_id: FileId,
    /// Offset of the part.
    pub page_offset: PageOffset,
    /// Maximum number of bytes in the answer.
    #[wire(unit = "byte")]
    pub max_size: u16,
    pub reserved: Reserved<14>,
}

/// Part of a file.
///
/// The vendor's libraries expect one more byte after the part, an error code, and take
/// [`file_size`](Self::file_size) for the length of the part; the specification knows neither, and that is the reading
/// here. If exactly one byte more than requested is received, it is that code.
#[message(CMD_READ_FILE, incoming, form = "success", default, size = 4..=255, length = 4..)]
pub struct FilePart<'a> {
    /// Size of the whole file.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Offset of the part, as requested.
    pub page_offset: PageOffset,
    /// Contents of the part, in the requested size, or shorter at the end of the file.
    pub data: &'a [u8],
}

/// Error of reading a part of a file.
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
    /// File id.
    pub file_id: FileId,
    /// Size of the whole file after writing.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Offset of the part.
    pub page_offset: PageOffset,
    /// Contents of the part, at least one byte. The specification requires less than the file size, but a small file
    /// must fit.
    pub data: &'a [u8],
}

/// Deletes a file: a write without data.
///
/// The board confirms always, with a [`FsErrorCode`] as the data of the confirmation.
#[message(CMD_WRITE_FILE, outgoing, form = "delete", size = 6, length = 6, answer = Confirm)]
pub struct WriteFileDelete {
    /// File id.
    pub file_id: FileId,
    /// Ignored.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Ignored.
    pub page_offset: PageOffset,
}

/// Deletes all files.
///
/// Takes about five seconds and, according to the vendor's library, also erases settings in the EEPROM. The board
/// confirms when it is done, with a [`FsErrorCode`] as the data of the confirmation.
#[message(CMD_FS_CLEAR_ALL, outgoing, size = 0, answer = Confirm, slow)]
pub struct FsClearAll;

/// File id: its type, and a number among files of that type.
///
/// ```
/// use sbgc_proto::commands::{FileId, FileType};
///
/// let script = FileId::new(FileType::Script, 2);
/// assert_eq!(script, FileId(0x0201));
/// assert_eq!(script.file_type(), FileType::Script);
/// ```
#[bit_fields(u16)]
pub struct FileId {
    /// Type of the file: the first byte on the wire.
    #[wire(bits = 0..=7)]
    pub file_type: FileType,
    /// Number among files of its type, for a script the slot. The specification only states that it depends
    /// on the type.
    #[wire(bits = 8..=15)]
    pub number: u8,
}

impl FileId {
    /// The file of this type and number.
    pub fn new(file_type: FileType, number: u8) -> Self {
        Self(0).with_file_type(file_type).with_number(number)
    }
}

/// File type. Spec: `FILE_TYPE`.
#[open_enum(u8, prefix = "FILE_TYPE_")]
pub enum FileType {
    /// A script of the user.
    Script = 1,
    /// Calibrations of an IMU.
    ImuCalib = 3,
    /// Corrections for the cogging of a motor.
    CoggingCorrection = 4,
    /// A look-up table for an adjustable variable.
    AdjVarLut = 5,
    /// A set of profiles, as `CMD_PROFILE_SET` keeps them.
    ProfileSet = 6,
    /// Parameters.
    Params = 7,
    /// A tune for the beeper.
    Tune = 8,
    /// Data of motor drivers on the CAN bus.
    #[wire(spec = "FILE_TYPE_CANDRV")]
    CanDrv = 10,
}
