//! Files, scripts, the I2C bus and pins.

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    BoardInfo3, BoardInfo3Request, Confirm, ExternalData, FileId, FilePart, FilePartError, FileType,
    FsClearAll, FsErrorCode, I2cDevice, I2cPort, I2cReadRegBuf, I2cReadRegBufRequest, I2cWriteRegBuf,
    RcInputs, RcSource, ReadExternalData, ReadFile, ReadRcInputs, RunScript, RunScriptMode, ScriptDebug,
    ServoOut, TriggerPin, TriggerPinId, TriggerPinState, WriteExternalData, WriteFile, WriteFileDelete,
};
use sbgc_proto::units::{PageOffset, RcSignal, ServoTime};
use sbgc_proto::wire::Bytes;

use super::{Bench, Got, ms};
use crate::sim::Config;

fn outcome(got: &Got) -> (CommandId, u32) {
    let confirm = got.decoded::<Confirm>();
    (confirm.cmd_id, confirm.data.value())
}

fn script(slot: u8) -> FileId {
    FileId::new(FileType::Script, slot)
}

fn upload(bench: &mut Bench, slot: u8, data: &[u8]) {
    let file_size = u16::try_from(data.len()).unwrap();
    let write = WriteFile { file_id: script(slot), file_size, page_offset: PageOffset(0), data };
    assert_eq!(outcome(&bench.ask_one(&write)), (CommandId::WriteFile, 0));
}

fn read(file_id: FileId, page: u16, max_size: u16) -> ReadFile {
    ReadFile { file_id, page_offset: PageOffset(page), max_size, ..ReadFile::default() }
}

#[test]
fn files_are_written_and_read_in_portions() {
    let mut bench = Bench::new(Config::default());
    let content: Vec<u8> = (0..300).map(|index| u8::try_from(index % 256).unwrap()).collect();
    for (page, part) in (0..).step_by(2).zip(content.chunks(128)) {
        let write =
            WriteFile { file_id: script(4), file_size: 300, page_offset: PageOffset(page), data: part };
        assert_eq!(outcome(&bench.ask_one(&write)), (CommandId::WriteFile, 0));
    }
    let got = bench.ask_one(&read(script(4), 1, 128));
    let part = got.decoded::<FilePart<'_>>();
    assert_eq!((part.file_size, part.page_offset, part.data), (300, PageOffset(1), &content[64..192]));
    let got = bench.ask_one(&read(script(4), 4, 128));
    assert_eq!(got.decoded::<FilePart<'_>>().data, &content[256..]);
    let info = bench.ask_one(&BoardInfo3Request {}).decoded::<BoardInfo3>();
    assert_eq!((info.script_slot5_size, info.script_slot1_size), (300, 0));

    let missing = bench.ask_one(&read(script(1), 0, 64));
    assert_eq!(missing.decoded::<FilePartError>().err_code, FsErrorCode::FileNotFound);
    let beyond = bench.ask_one(&read(script(4), 9, 64));
    assert_eq!(beyond.decoded::<FilePartError>().err_code, FsErrorCode::WrongParams);
    let delete = WriteFileDelete { file_id: script(4), ..WriteFileDelete::default() };
    assert_eq!(outcome(&bench.ask_one(&delete)), (CommandId::WriteFile, 0));
    assert_eq!(outcome(&bench.ask_one(&delete)), (CommandId::WriteFile, 2));
}

#[test]
fn all_files_go_at_once_and_that_takes_its_time() {
    let mut bench = Bench::new(Config::default());
    upload(&mut bench, 0, b"HOME()");
    assert_eq!(bench.ask(&FsClearAll {}), []);
    assert_eq!(bench.run(ms(4900)), []);
    assert_eq!(outcome(&bench.run(ms(200))[0]), (CommandId::FsClearAll, 0));
    assert_eq!(bench.ask_one(&read(script(0), 0, 64)).payload, [2]);
}

#[test]
fn a_script_moves_axes_with_a_trace() {
    let mut bench = Bench::new(Config::default());
    upload(&mut bench, 2, b"ANGLE(_, -20, _)\nWAIT(200)\nMENU(3)\n");
    let run = |mode| RunScript { mode, slot: 2, ..RunScript::default() };
    assert_eq!(outcome(&bench.ask_one(&run(RunScriptMode::StartWithDebug))), (CommandId::RunScript, 0));
    let got = bench.run(ms(5000));
    let traced: Vec<_> = got.iter().map(Got::decoded::<ScriptDebug>).collect();
    let counts: Vec<_> = traced.iter().map(|step| (step.cmd_count, step.err_code.raw())).collect();
    assert_eq!(counts, [(1, 0), (2, 0), (3, 0)]);
    assert!((bench.board.motion().axes().pitch.angle + 20.0).abs() < 0.1);
    let empty = RunScript { mode: RunScriptMode::Start, slot: 3, ..RunScript::default() };
    assert_eq!(bench.ask_one(&empty).payload[..2], [57, 10]);
    // What cannot be read ends it.
    upload(&mut bench, 2, &[1, 2, 3, 4]);
    bench.ask_one(&run(RunScriptMode::StartWithDebug));
    let step = bench.run(ms(100)).remove(0).decoded::<ScriptDebug>();
    assert_eq!((step.cmd_count, step.err_code), (1, FsErrorCode::FileCorrupted));
    assert_eq!(bench.run(ms(1000)), []);
}

#[test]
fn a_stopped_script_stops_what_it_moves() {
    let mut bench = Bench::new(Config::default());
    upload(&mut bench, 0, b"ANGLE(_, 80, _)");
    bench.ask_one(&RunScript { mode: RunScriptMode::Start, ..RunScript::default() });
    bench.run(ms(500));
    bench.ask_one(&RunScript { mode: RunScriptMode::Stop, ..RunScript::default() });
    bench.run(ms(1000));
    let pitch = bench.board.motion().axes().pitch;
    assert!(pitch.speed == 0.0 && pitch.angle > 5.0 && pitch.angle < 75.0, "{pitch:?}");
}

#[test]
fn two_devices_are_on_the_bus() {
    let mut bench = Bench::new(Config::default());
    let read = |port, address, register, length| I2cReadRegBufRequest {
        device_addr: I2cDevice::new(port, address),
        reg_addr: register,
        data_len: length,
    };
    let who = bench.ask_one(&read(I2cPort::External, 0x68, 0x75, 1));
    assert_eq!(who.decoded::<I2cReadRegBuf<'_>>().data, [0x68]);
    // The accelerometer shows 1 g on its third axis.
    let got = bench.ask_one(&read(I2cPort::External, 0x68, 0x3F, 2));
    let down = i16::from_be_bytes(got.decoded::<I2cReadRegBuf<'_>>().data.try_into().unwrap());
    assert!((15_500..17_500).contains(&down), "{down}");
    let device_addr = I2cDevice::new(I2cPort::External, 0x68);
    let write = I2cWriteRegBuf { device_addr, reg_addr: 0x19, data: &[7, 8] };
    assert_eq!(outcome(&bench.ask_one(&write)), (CommandId::I2cWriteRegBuf, 0));
    let got = bench.ask_one(&read(I2cPort::External, 0x68, 0x19, 2));
    assert_eq!(got.decoded::<I2cReadRegBuf<'_>>().data, [7, 8]);
    assert_eq!(bench.ask_one(&read(I2cPort::Internal, 0x50, 0, 4)).payload, *b"SBG1");
    assert_eq!(bench.ask_one(&read(I2cPort::External, 0x50, 0, 4)).payload, *b"SBG1");
    assert_eq!(bench.ask_one(&read(I2cPort::Internal, 0x51, 0, 4)).payload[..2], [40, 10]);
}

#[test]
fn free_pins_are_driven_and_the_others_are_passed_over_in_silence() {
    let mut bench = Bench::new(Config::default());
    let pin = |pin_id, state| TriggerPin { pin_id, state };
    for free in [TriggerPinId::Aux1, TriggerPinId::Aux3, TriggerPinId::Buzzer, TriggerPinId::SsatPower] {
        for state in [TriggerPinState::Low, TriggerPinState::High, TriggerPinState::Floating] {
            assert_eq!(outcome(&bench.ask_one(&pin(free, state))), (CommandId::TriggerPin, 0), "{free:?}");
        }
    }
    let pulled = bench.ask_one(&pin(TriggerPinId::Aux2, TriggerPinState::PulledUp));
    assert_eq!(outcome(&pulled), (CommandId::TriggerPin, 0x0111));
    for other in [TriggerPinId::RcInputPitch, TriggerPinId::CanDrv1Aux1, 99.into()] {
        assert_eq!(bench.ask(&pin(other, TriggerPinState::High)), [], "{other:?}");
    }
    assert_eq!(bench.ask(&pin(TriggerPinId::Aux1, 9.into())), []);
    // A pin that outputs pulses is taken.
    let mut servo_time = [ServoTime::FLOATING; 8];
    servo_time[3] = ServoTime(1500);
    assert_eq!(bench.ask(&ServoOut { servo_time }), []);
    assert_eq!((bench.board.servo(3), bench.board.servo(0)), (Some(1500), None));
    assert_eq!(bench.ask(&pin(TriggerPinId::Aux1, TriggerPinState::High)), []);
}

#[test]
fn inputs_without_a_signal_say_so() {
    let mut bench = Bench::new(Config::default());
    bench.board.set_rc_input(RcSource::RC_INPUT_YAW, Some(-0.5));
    let rc_src = [RcSource::RC_INPUT_ROLL, RcSource::RC_INPUT_YAW].into_iter().collect();
    let got = bench.ask_one(&ReadRcInputs { rc_src, ..ReadRcInputs::default() });
    let values = got.decoded::<RcInputs>().rc_val;
    assert_eq!(*values, [RcSignal(-32767), RcSignal(-8192)]);
}

#[test]
fn user_data_is_kept_over_a_reset() {
    let mut bench = Bench::new(Config::default());
    let data = ExternalData { data: Bytes(std::array::from_fn(|index| u8::try_from(index).unwrap())) };
    bench.ask_one(&WriteExternalData(data.clone()));
    bench.send(&sbgc_proto::commands::ResetRequest {});
    bench.run(ms(500));
    assert_eq!(bench.ask_one(&ReadExternalData {}).decoded::<ExternalData>(), data);
}
