//! Payloads made by hand from the layouts, and what must not be mixed up in them.

use crate::Message;
use crate::commands::*;
use crate::units::{PageOffset, PeakAcceleration};
use crate::wire::ToWire;

fn bytes<M: Message + ToWire>(message: &M) -> Vec<u8> {
    message.encode(&mut [0; 255]).unwrap().to_vec()
}

#[test]
fn the_eeprom_is_read_in_blocks() {
    let request = EepromReadRequest { addr: 0x7FC0, size: 192 };
    assert_eq!(bytes(&request), [0xC0, 0x7F, 0, 0, 0xC0, 0]);
    assert_eq!(EepromReadRequest::decode(&bytes(&request)), Ok(request));

    let answer = [0xC0, 0x7F, 0, 0, 1, 2, 3];
    assert_eq!(EepromRead::decode(&answer), Ok(EepromRead { addr: 0x7FC0, data: &[1, 2, 3] }));
    assert!(EepromRead::decode(&answer[..3]).is_err());
}

#[test]
fn the_eeprom_is_written_in_blocks() {
    let payload = [0x40, 0x48, 0, 0, 9, 8];
    let message = EepromWrite::decode(&payload).unwrap();
    assert_eq!(message, EepromWrite { addr: 18_496, data: &[9, 8] });
    assert_eq!(bytes(&message), payload);
}

#[test]
fn file_ids_have_the_type_first() {
    let request = ReadFile {
        file_id: FileId::new(FileType::CanDrv, 9),
        page_offset: PageOffset::from_bytes(128.0),
        max_size: 192,
        ..ReadFile::default()
    };
    let payload = [10, 9, 2, 0, 192, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    assert_eq!(bytes(&request), payload);
    assert_eq!(ReadFile::decode(&payload), Ok(request));
    let unknown = FileId(0xFF02);
    assert_eq!((unknown.file_type(), unknown.number()), (FileType::Unknown(2), 255));
}

#[test]
fn answers_about_files_differ_by_length() {
    let part = [0x2C, 1, 3, 0, 7, 8, 9];
    assert!(FilePart::accepts(part.len()) && !FilePartError::accepts(part.len()));
    let message = FilePart::decode(&part).unwrap();
    assert_eq!(message, FilePart { file_size: 300, page_offset: PageOffset(3), data: &[7, 8, 9] });
    assert_eq!(bytes(&message), part);

    assert!(FilePartError::accepts(1) && !FilePart::accepts(1));
    for (byte, code) in [(9, FsErrorCode::FileCorrupted), (99, FsErrorCode::Unknown(99))] {
        let message = FilePartError::decode(&[byte]).unwrap();
        assert_eq!(message.err_code, code);
        assert_eq!(bytes(&message), [byte]);
    }
}

#[test]
fn a_write_without_data_deletes() {
    let delete = WriteFileDelete { file_id: FileId::new(FileType::Script, 0), ..WriteFileDelete::default() };
    assert_eq!(bytes(&delete), [1, 0, 0, 0, 0, 0]);
    assert!(WriteFileDelete::accepts(6) && !WriteFile::accepts(6));

    let payload = [5, 0, 2, 0, 0, 0, 0xAA, 0xBB];
    let write = WriteFile::decode(&payload).unwrap();
    assert_eq!(write.file_id.file_type(), FileType::AdjVarLut);
    assert_eq!((write.file_size, write.data), (2, &[0xAA, 0xBB][..]));
    assert_eq!(bytes(&write), payload);
}

#[test]
fn state_is_written_as_it_was_read() {
    let mut payload = [0xEE; 192];
    payload[..40].copy_from_slice(&[
        1, 2, 3, 4, 5, 6, 17, 0x20, 0x10, 0x0E, 0, 0, 42, 0, 0xB8, 0x0B, 20, 60, 25, 70, 9, 8, 7, 6, 100, 0,
        0, 0, 0, 0, 0x20, 0x41, 200, 0, 0, 0, 0, 0, 0xC0, 0x3F,
    ]);
    let state = StateVars::decode(&payload).unwrap();
    assert_eq!(state.max_acc, PeakAcceleration::from_g(2.0));
    assert_eq!((state.work_time, state.startup_cnt, state.max_current), (3600, 42, 3000));
    assert_eq!((state.energy.get(), state.avg_current.get()), (10.0, 1.5));
    assert_eq!(bytes(&WriteStateVars(state)), payload);
    assert!(StateVars::decode(&payload[..191]).is_err());
}

#[test]
fn user_data_is_kept() {
    let data = ExternalData::decode(&[7; 128]).unwrap();
    assert_eq!(bytes(&WriteExternalData(data)), [7; 128]);
    assert!(ExternalData::decode(&[7; 127]).is_err());
}
