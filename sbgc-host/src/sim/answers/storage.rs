//! EEPROM, files, user data, state variables, and devices on the I2C bus.
//!
//! Real: addresses of the EEPROM are aligned to its pages of 64 bytes, at most three of which are read at once; a write
//! is confirmed with its address. Reading and writing files answer in their own form with their own error codes.
//! Deleting all files takes 5 seconds.

use std::time::Duration;

use sbgc_proto::commands::{
    ConfirmData, EepromRead, EepromReadRequest, EepromWrite, FilePart, FilePartError, FsErrorCode,
    I2cReadRegBuf, I2cReadRegBufRequest, I2cWriteRegBuf, ReadFile, StateVars, WriteFile,
};
use sbgc_proto::{CommandId, Message, OutgoingCommand};

use crate::sim::eeprom::{PAGE, Region};
use crate::sim::files::Files;
use crate::sim::machine::{Call, Machine};
use crate::sim::motion::Motion;
use crate::sim::power::Power;
use crate::sim::reply::{Packet, Refusal, Replies, Reply, confirm, done, message, send, silence};

/// How many pages are read at once at most.
const MOST_PAGES: usize = 3;

/// The most of a file that fits one message.
const MOST_OF_FILE: usize = 251;

/// How long it takes to delete all files.
const CLEARING: Duration = Duration::from_secs(5);

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::EepromReadRequest(request) => read_eeprom(machine, request),
        OutgoingCommand::EepromWrite(write) => write_eeprom(machine, write),
        OutgoingCommand::ReadFile(request) => read_file(machine, request),
        OutgoingCommand::WriteFile(write) => write_file(machine, write),
        OutgoingCommand::WriteFileDelete(request) => {
            let deleted = Files(&mut machine.parameters.eeprom).delete(request.file_id);
            confirm(CommandId::WriteFile, outcome(deleted))
        }
        OutgoingCommand::FsClearAll(_) => clear(machine, call),
        OutgoingCommand::ReadExternalData(_) => {
            let payload = machine.parameters.eeprom.region(Region::UserData).to_vec();
            send(Ok(Packet { id: CommandId::ReadExternalData, payload }))
        }
        OutgoingCommand::WriteExternalData(_) => {
            machine.parameters.eeprom.set_region(Region::UserData, call.payload);
            done(CommandId::WriteExternalData)
        }
        OutgoingCommand::ReadStateVars(_) => state_vars(machine, call.now),
        OutgoingCommand::WriteStateVars(_) => {
            machine.parameters.eeprom.set_region(Region::StateVars, call.payload);
            done(CommandId::WriteStateVars)
        }
        OutgoingCommand::I2cReadRegBufRequest(request) => read_register(machine, request),
        OutgoingCommand::I2cWriteRegBuf(write) => write_register(machine, write),
        _ => return None,
    })
}

fn read_eeprom(machine: &Machine, request: &EepromReadRequest) -> Replies {
    let (start, size) = (page(request.addr)?, usize::from(request.size));
    if size == 0 || size % PAGE != 0 || size > MOST_PAGES * PAGE {
        return Err(Refusal::Parameters);
    }
    let data = machine.parameters.eeprom.read(start, size).ok_or(Refusal::Parameters)?;
    message(&EepromRead { addr: request.addr, data })
}

fn write_eeprom(machine: &mut Machine, write: &EepromWrite<'_>) -> Replies {
    let start = page(write.addr)?;
    if write.data.is_empty() || !machine.parameters.eeprom.write(start, write.data) {
        return Err(Refusal::Parameters);
    }
    let address = u16::try_from(write.addr).map_or(ConfirmData::U32(write.addr), ConfirmData::U16);
    confirm(CommandId::EepromWrite, address)
}

/// The place of an address, which must be that of a page.
fn page(address: u32) -> Result<usize, Refusal> {
    let index = usize::try_from(address).map_err(|_| Refusal::Parameters)?;
    if index % PAGE == 0 { Ok(index) } else { Err(Refusal::Parameters) }
}

fn outcome(result: Result<(), FsErrorCode>) -> ConfirmData {
    ConfirmData::U8(result.err().unwrap_or(FsErrorCode::NoError).raw())
}

fn read_file(machine: &mut Machine, request: &ReadFile) -> Replies {
    let content = match Files(&mut machine.parameters.eeprom).content(request.file_id) {
        Ok(content) => content,
        Err(err_code) => return message(&FilePartError { err_code }),
    };
    let start = usize::from(request.page_offset.0) * PAGE;
    let Some(rest) = content.get(start..) else {
        return message(&FilePartError { err_code: FsErrorCode::WrongParams });
    };
    let size = usize::from(request.max_size).min(MOST_OF_FILE).min(rest.len());
    message(&FilePart {
        file_size: u16::try_from(content.len()).unwrap_or(u16::MAX),
        page_offset: request.page_offset,
        data: rest.get(..size).unwrap_or_default(),
    })
}

fn write_file(machine: &mut Machine, write: &WriteFile<'_>) -> Replies {
    let mut files = Files(&mut machine.parameters.eeprom);
    let written = files.write(write.file_id, write.file_size, write.page_offset.0, write.data);
    confirm(CommandId::WriteFile, outcome(written))
}

fn clear(machine: &mut Machine, call: &Call<'_>) -> Replies {
    Files(&mut machine.parameters.eeprom).clear();
    let packet = Packet::confirmation(CommandId::FsClearAll, outcome(Ok(())))?;
    machine.later.push((call.now.saturating_add(CLEARING), call.port, Reply::Send(packet)));
    silence()
}

fn state_vars(machine: &Machine, now: Duration) -> Replies {
    let saved = StateVars::decode(machine.parameters.eeprom.region(Region::StateVars)).unwrap_or_default();
    let (seconds, most) = machine.power.statistics();
    let (imu, board) = Power::temperatures(now);
    let degrees = |celsius: i8| u8::try_from(celsius).unwrap_or_default();
    let least = |saved: u8, now: u8| if saved == 0 { now } else { saved.min(now) };
    let current = average_current(&machine.motion);
    message(&StateVars {
        work_time: saved.work_time.saturating_add(seconds),
        startup_cnt: saved.startup_cnt.saturating_add(1),
        max_current: saved.max_current.max(most),
        imu_temp_min: least(saved.imu_temp_min, degrees(imu)),
        imu_temp_max: saved.imu_temp_max.max(degrees(imu)),
        mcu_temp_min: least(saved.mcu_temp_min, degrees(board)),
        mcu_temp_max: saved.mcu_temp_max.max(degrees(board)),
        avg_current_time: saved.avg_current_time.saturating_add(seconds),
        avg_current: if saved.avg_current_time == 0 { current } else { saved.avg_current },
        ..saved
    })
}

fn average_current(motion: &Motion) -> sbgc_proto::wire::Float {
    crate::sim::imu::float(Power::current(motion))
}

fn read_register(machine: &mut Machine, request: &I2cReadRegBufRequest) -> Replies {
    measure(machine);
    let connected = machine.imu.connected;
    let (device, register) = (request.device_addr, request.reg_addr);
    let data =
        machine.bus.read(&machine.parameters.eeprom, connected, device, register, request.data_len.max(1));
    let Some(data) = data else {
        machine.power.i2c_errors = machine.power.i2c_errors.saturating_add(1);
        return Err(Refusal::Failed);
    };
    message(&I2cReadRegBuf { data: &data })
}

fn write_register(machine: &mut Machine, write: &I2cWriteRegBuf<'_>) -> Replies {
    if write.data.is_empty() {
        return Err(Refusal::Silent);
    }
    let connected = machine.imu.connected;
    let eeprom = &mut machine.parameters.eeprom;
    if machine.bus.write(eeprom, connected, write.device_addr, write.reg_addr, write.data) {
        return done(CommandId::I2cWriteRegBuf);
    }
    machine.power.i2c_errors = machine.power.i2c_errors.saturating_add(1);
    Err(Refusal::Failed)
}

/// Lets the sensor on the bus measure what the one of the camera does.
fn measure(machine: &mut Machine) {
    let acc = machine.imu.acc(&machine.motion).into_array().map(|part| part.0.saturating_mul(32));
    let gyro = machine.imu.gyro(&machine.motion).map(|rate| rate.0);
    machine.bus.measure(acc, -1000, gyro);
}
