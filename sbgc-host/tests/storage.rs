//! Files, scripts, EEPROM, I2C and user data against a small board of the test's own.

mod support;

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use sbgc_host::proto::commands::{FileId, FileType, FsErrorCode, I2cDevice, I2cPort, ScriptDebug};
use sbgc_host::streams::Item;
use sbgc_host::{Error, Gimbal};
use support::*;

const EEPROM_WRITE: u8 = 47;
const EEPROM_READ: u8 = 48;
const READ_FILE: u8 = 53;
const WRITE_FILE: u8 = 54;
const RUN_SCRIPT: u8 = 57;
const READ_DATA: u8 = 42;
const WRITE_DATA: u8 = 41;
const I2C_WRITE: u8 = 39;
const I2C_READ: u8 = 40;
const BOARD_INFO_3: u8 = 20;
const SCRIPT_DEBUG: u8 = 58;
const ERROR: u8 = 255;

#[derive(Default)]
struct State {
    eeprom: Vec<u8>,
    files: HashMap<u16, Vec<u8>>,
    user: Vec<u8>,
    i2c: Vec<u8>,
    /// How often each command came.
    seen: HashMap<u8, usize>,
    /// How many writes are carried out without being confirmed, and how many are neither.
    unconfirmed: usize,
    lost: usize,
    /// Whether the memory keeps a wrong byte.
    broken: bool,
    /// Whether parts of files end with an error code and count themselves, as the vendor's libraries read them.
    vendor: bool,
    refuse_scripts: bool,
    scripts: Vec<Vec<u8>>,
}

struct Store(Arc<Mutex<State>>);

impl Store {
    fn start() -> (Gimbal, Self) {
        let (gimbal, mut board) = gimbal();
        let state = Arc::new(Mutex::new(State {
            eeprom: (0..1024_u32).map(|at| u8::try_from(at * 7 % 251).unwrap()).collect(),
            user: vec![0; 128],
            ..State::default()
        }));
        let shared = Arc::clone(&state);
        tokio::spawn(async move {
            while let Some(frame) = board.try_next().await {
                let answers = shared.lock().unwrap().answer(frame.id, &frame.payload);
                for (id, payload) in answers {
                    board.send(id, &payload).await;
                }
            }
        });
        (gimbal, Self(state))
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap()
    }
}

impl State {
    fn answer(&mut self, id: u8, payload: &[u8]) -> Vec<(u8, Vec<u8>)> {
        *self.seen.entry(id).or_default() += 1;
        let word = |at: usize| u16::from_le_bytes([payload[at], payload[at + 1]]);
        let writes = matches!(id, EEPROM_WRITE | WRITE_FILE);
        if writes && self.lost > 0 {
            self.lost -= 1;
            return Vec::new();
        }
        let answer = match id {
            EEPROM_READ => {
                let (at, size) = (usize::from(word(0)), usize::from(word(4)));
                assert!(at % 64 == 0 && size % 64 == 0 && size <= 192, "{at} {size}");
                match self.eeprom.get(at..at + size) {
                    Some(block) => (id, [&payload[..4], block].concat()),
                    None => (ERROR, vec![id, 10, 0, 0, 0, 0]),
                }
            }
            EEPROM_WRITE => {
                let at = usize::from(word(0));
                self.eeprom[at..at + payload.len() - 4].copy_from_slice(&payload[4..]);
                self.eeprom[at] ^= u8::from(self.broken);
                (CONFIRM, vec![id, payload[0], payload[1]])
            }
            READ_FILE => {
                let (at, most) = (usize::from(word(2)) * 64, usize::from(word(4)));
                match self.files.get(&word(0)) {
                    Some(file) => {
                        let part = &file[at.min(file.len())..file.len().min(at + most)];
                        let size = u16::try_from(if self.vendor { part.len() } else { file.len() }).unwrap();
                        let mut answer = [&size.to_le_bytes()[..], &payload[2..4], part].concat();
                        answer.extend(self.vendor.then_some(0));
                        (id, answer)
                    }
                    None => (id, vec![FsErrorCode::FileNotFound.raw()]),
                }
            }
            WRITE_FILE if payload.len() == 6 => {
                let gone = self.files.remove(&word(0)).is_some();
                (CONFIRM, vec![id, if gone { 0 } else { FsErrorCode::FileNotFound.raw() }])
            }
            WRITE_FILE => {
                let (size, at) = (usize::from(word(2)), usize::from(word(4)) * 64);
                if size > 2000 {
                    return vec![(CONFIRM, vec![id, FsErrorCode::NoFreeSpace.raw()])];
                }
                let file = self.files.entry(word(0)).or_default();
                file.resize(size, 0xFF);
                file[at..at + payload.len() - 6].copy_from_slice(&payload[6..]);
                file[at] ^= u8::from(self.broken);
                (CONFIRM, vec![id, 0])
            }
            RUN_SCRIPT if self.refuse_scripts => (ERROR, vec![id, 8, 0, 0, 0, 0]),
            RUN_SCRIPT => {
                self.scripts.push(payload[..2].to_vec());
                let steps = (1..=3).map(|step| (SCRIPT_DEBUG, vec![step, 0, 0]));
                return if payload[0] == 2 { steps.collect() } else { Vec::new() };
            }
            BOARD_INFO_3 => {
                let mut info = vec![0; 69];
                let size = |slot| self.files.get(&(u16::from(slot) << 8 | 1)).map_or(0, Vec::len);
                for slot in 0..5_u8 {
                    let at = 25 + 2 * usize::from(slot);
                    info[at..at + 2].copy_from_slice(&u16::try_from(size(slot)).unwrap().to_le_bytes());
                }
                (id, info)
            }
            READ_DATA => (id, self.user.clone()),
            WRITE_DATA => {
                self.user = payload.to_vec();
                (CONFIRM, vec![id])
            }
            I2C_WRITE => {
                self.i2c = payload.to_vec();
                (CONFIRM, vec![id])
            }
            I2C_READ => (id, (0..payload[2]).collect()),
            BOARD_INFO => (id, board_info(2735).to_vec()),
            other => panic!("command {other}"),
        };
        if writes && self.unconfirmed > 0 {
            self.unconfirmed -= 1;
            return Vec::new();
        }
        vec![answer]
    }
}

const NOTHING: fn(usize, usize) = |_, _| {};
const FILE: FileId = FileId(0x0205);

#[tokio::test(start_paused = true)]
async fn the_eeprom_is_read_from_any_address() {
    let (gimbal, store) = Store::start();
    let expected = store.state().eeprom.clone();
    for (address, length) in [(0, 1024), (64, 64), (10, 3), (60, 8), (1000, 24), (130, 500), (5, 0)] {
        let mut steps = Vec::new();
        let data = gimbal.eeprom_read(address, length, |done, all| steps.push((done, all))).await.unwrap();
        let start = usize::try_from(address).unwrap();
        assert_eq!(data, expected[start..start + length], "{address} {length}");
        assert_eq!((steps.first(), steps.last()), (Some(&(0, length)), Some(&(length, length))));
    }
    let beyond = gimbal.eeprom_read(1000, 100, NOTHING).await.unwrap_err();
    assert_eq!(beyond.file_error(), Some(FsErrorCode::WrongParams), "{beyond}");
}

#[tokio::test(start_paused = true)]
async fn eeprom_pages_are_written_and_verified() {
    let (gimbal, store) = Store::start();
    let before = store.state().eeprom.clone();
    let data: Vec<u8> = (0..=255).collect();
    gimbal.eeprom_write(128, &data, NOTHING).await.unwrap();
    assert_eq!(store.state().eeprom, [&before[..128], &data, &before[384..]].concat());
    for (address, length) in [(1, 64), (64, 63), (64, 1)] {
        let error = gimbal.eeprom_write(address, &data[..length], NOTHING).await.unwrap_err();
        assert!(matches!(error, Error::Misaligned { step: 64, .. }), "{error}");
    }
    store.state().broken = true;
    let error = gimbal.eeprom_write(128, &data, NOTHING).await.unwrap_err();
    assert!(matches!(error, Error::NotVerified { at: 128, .. }), "{error}");
}

#[tokio::test(start_paused = true)]
async fn a_write_whose_confirmation_is_lost_is_looked_at_first() {
    let (gimbal, store) = Store::start();
    // A driver that has had no answer yet waits long for late ones.
    gimbal.eeprom_read(0, 64, NOTHING).await.unwrap();
    store.state().unconfirmed = 1;
    gimbal.eeprom_write(0, &[9; 64], NOTHING).await.unwrap();
    assert_eq!(store.state().seen[&EEPROM_WRITE], 1, "it was there, so it is not written again");
    store.state().lost = 2;
    gimbal.eeprom_write(64, &[8; 64], NOTHING).await.unwrap();
    assert_eq!(store.state().seen[&EEPROM_WRITE], 4);
    assert_eq!(store.state().eeprom[..128], [[9; 64], [8; 64]].concat());
    store.state().lost = 3;
    let error = gimbal.eeprom_write(128, &[7; 64], NOTHING).await.unwrap_err();
    assert!(matches!(error, Error::Timeout { .. }), "{error}");

    store.state().unconfirmed = 1;
    gimbal.file_write(FILE, &[5; 100], NOTHING).await.unwrap();
    assert_eq!(store.state().seen[&WRITE_FILE], 1);
    store.state().lost = 1;
    gimbal.file_write(FILE, &[6; 100], NOTHING).await.unwrap();
    assert_eq!(store.state().seen[&WRITE_FILE], 3);
}

#[tokio::test(start_paused = true)]
async fn files_are_written_and_read_in_portions() {
    let (gimbal, store) = Store::start();
    for vendor in [false, true] {
        store.state().vendor = vendor;
        for length in [1, 191, 192, 193, 384, 1000] {
            let data: Vec<u8> = (0..length).map(|at| u8::try_from(at % 253).unwrap()).collect();
            gimbal.file_write(FILE, &data, NOTHING).await.unwrap();
            assert_eq!(store.state().files[&FILE.0], data);
            assert_eq!(gimbal.file_read(FILE, NOTHING).await.unwrap(), data, "{length} {vendor}");
        }
    }
    gimbal.file_delete(FILE).await.unwrap();
    assert!(store.state().files.is_empty());
}

#[tokio::test(start_paused = true)]
async fn errors_of_files_are_typed() {
    let (gimbal, store) = Store::start();
    for error in
        [gimbal.file_read(FILE, NOTHING).await.unwrap_err(), gimbal.file_delete(FILE).await.unwrap_err()]
    {
        assert_eq!(error.file_error(), Some(FsErrorCode::FileNotFound), "{error}");
        assert!(error.to_string().contains("ERR_FILE_NOT_FOUND"), "{error}");
    }
    let full = gimbal.file_write(FILE, &[1; 3000], NOTHING).await.unwrap_err();
    assert_eq!(full.file_error(), Some(FsErrorCode::NoFreeSpace), "{full}");
    for length in [0, 70_000] {
        let error = gimbal.file_write(FILE, &vec![0; length], NOTHING).await.unwrap_err();
        assert!(matches!(error, Error::FileSize { .. }), "{error}");
    }
    store.state().broken = true;
    let error = gimbal.file_write(FILE, &[1; 300], NOTHING).await.unwrap_err();
    assert!(matches!(error, Error::NotVerified { at: 0, .. }), "{error}");
}

#[tokio::test(start_paused = true)]
async fn scripts_have_slots_from_1() {
    let (gimbal, store) = Store::start();
    assert!(matches!(gimbal.script_run(2, true).await, Err(Error::EmptySlot { slot: 2 })));
    assert!(store.state().scripts.is_empty());
    gimbal.script_upload(2, b"script", NOTHING).await.unwrap();
    assert_eq!(store.state().files[&FileId::new(FileType::Script, 1).0], b"script");
    let mut trace = gimbal.script_trace();
    gimbal.script_run(2, true).await.unwrap();
    for step in 1..=3 {
        let expected = ScriptDebug { cmd_count: step, ..ScriptDebug::default() };
        assert_eq!(trace.next().await, Some(Item::Message(expected)));
    }
    gimbal.script_stop(2).await.unwrap();
    assert_eq!(store.state().scripts, [[2, 1], [0, 1]]);
    gimbal.script_delete(2).await.unwrap();
    for slot in [0, 11] {
        assert!(matches!(gimbal.script_stop(slot).await, Err(Error::OutOfRange { .. })));
    }
}

#[tokio::test(start_paused = true)]
async fn a_refusal_of_what_may_be_unconfirmed_is_found_without_waiting() {
    let (gimbal, store) = Store::start();
    store.state().refuse_scripts = true;
    let began = tokio::time::Instant::now();
    let error = gimbal.script_stop(1).await.unwrap_err();
    assert!(matches!(error, Error::Refused { code: 8, name: Some("ERR_WRONG_STATE"), .. }), "{error}");
    assert!(began.elapsed() < Duration::from_millis(100));
}

#[tokio::test(start_paused = true)]
async fn registers_and_user_data() {
    let (gimbal, store) = Store::start();
    let device = I2cDevice::new(I2cPort::Internal, 0x50);
    assert_eq!(gimbal.i2c_read(device, 6, 4).await.unwrap(), [0, 1, 2, 3]);
    gimbal.i2c_write(device, 7, &[1, 2]).await.unwrap();
    assert_eq!(store.state().i2c, [0xA1, 7, 1, 2]);
    assert!(gimbal.i2c_read(device, 6, 0).await.is_err());
    assert!(gimbal.i2c_write(device, 6, &[0; 241]).await.is_err());
    gimbal.set_user_data([3; 128]).await.unwrap();
    assert_eq!(gimbal.user_data().await.unwrap(), [3; 128]);
}
