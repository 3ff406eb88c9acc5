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
    /// Contents of the part, as many bytes as requested, or fewer at the end of the file.
    pub data: &'a [u8],
}

/// Error reply to a request for a part of a file.
#[message(CMD_READ_FILE, incoming, form = "error", size = 1, length = 1)]
pub struct FilePartError {
    /// Error code.
    pub err_code: FsErrorCode,
}

/// Writes a part of a file.
///
/// Creates the file if it does not exist, and resizes it to [`file_size`](Self::file_size). Always confirmed, with an
/// [`FsErrorCode`] as the data of the confirmation. A message without data is a [`WriteFileDelete`].
#[message(CMD_WRITE_FILE, outgoing, form = "write", default, size = 7..=255, length = 7.., answer = Confirm)]
pub struct WriteFile<'a> {
    /// File id.
    pub file_id: FileId,
    /// Size of the whole file after writing.
    #[wire(unit = "byte")]
    pub file_size: u16,
    /// Offset of the part.
    pub page_offset: PageOffset,
    /// Contents of the part, at least one byte. The specification requires fewer bytes than the file size, but a small
    /// file must fit into one part.
    pub data: &'a [u8],
}

/// Deletes a file.
///
/// On the wire, this is a write without data. Always confirmed, with an [`FsErrorCode`] as the data of the
/// confirmation.
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

/// Deletes all files of the internal file system.
///
/// Takes about five seconds and, according to the vendor's library, also erases settings in the EEPROM. Confirmed at
/// the end, with an [`FsErrorCode`] as the data of the confirmation.
#[message(CMD_FS_CLEAR_ALL, outgoing, size = 0, answer = Confirm, slow)]
pub struct FsClearAll;

/// File id: the file type, and a number among files of that type.
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
    /// File type, the first byte on the wire.
    #[wire(bits = 0..=7)]
    pub file_type: FileType,
    /// Number among files of the same type; for a script, its slot. The specification only states that it depends on
    /// the type.
    #[wire(bits = 8..=15)]
    pub number: u8,
}

impl FileId {
    /// Creates a file id from a type and a number.
    pub fn new(file_type: FileType, number: u8) -> Self {
        Self(0).with_file_type(file_type).with_number(number)
    }
}

/// File type. Spec: `FILE_TYPE`.
#[open_enum(u8, prefix = "FILE_TYPE_")]
pub enum FileType {
    /// User script.
    Script = 1,
    /// Calibration data of an IMU.
    ImuCalib = 3,
    /// Cogging correction of a motor.
    CoggingCorrection = 4,
    /// Lookup table of an adjustable variable.
    AdjVarLut = 5,
    /// Profile set, see `CMD_PROFILE_SET`.
    ProfileSet = 6,
    /// Parameters.
    Params = 7,
    /// Melody of the buzzer.
    Tune = 8,
    /// Data of CAN motor drivers.
    #[wire(spec = "FILE_TYPE_CANDRV")]
    CanDrv = 10,
}
