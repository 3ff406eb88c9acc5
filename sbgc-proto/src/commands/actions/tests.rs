//! Payloads of actions byte by byte. Where nothing else is said they are made by hand from the layout.

use super::*;
use crate::commands::Axis;
use crate::commands::{MenuCommand, Switch};
use crate::units::{CoarseRcSignal, NoteFrequency, RcSignal, ServoTime, SoundTime};
use crate::wire::{FromWire, ToWire};
use crate::{DecodeError, EncodeError, Message};

/// `payload` and `message` are each other's bytes and meaning.
#[track_caller]
pub(super) fn same<M: Message + for<'a> FromWire<'a> + ToWire + PartialEq + core::fmt::Debug>(
    message: M,
    payload: &[u8],
) {
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    assert_eq!(M::decode_prefix(payload), Ok((message, &[][..])));
}

#[test]
fn motors_and_menu() {
    same(MotorsOn, &[]);
    same(MotorsOffSimple {}, &[]);
    same(MotorsOff { mode: MotorsOffMode::SafeStop }, &[2]);
    same(MotorsOff { mode: MotorsOffMode::Unknown(9) }, &[9]);
    same(ExecuteMenu { cmd_id: MenuCommand::MotorToggle }, &[10]);
    let both = ExecuteMenuFlags::CONFIRM | ExecuteMenuFlags::CONFIRM_ON_FINISH;
    same(ExecuteMenuExtended { cmd_id: MenuCommand::CalibAcc, flags: both }, &[6, 3]);
    same(
        ExecuteMenuExtended {
            cmd_id: MenuCommand::Unknown(200),
            flags: ExecuteMenuFlags::from_bits_retain(0xF0),
        },
        &[200, 0xF0],
    );
    assert!(MotorsOffSimple::accepts(0) && !MotorsOffSimple::accepts(1));
    assert!(ExecuteMenuExtended::accepts(2) && !ExecuteMenuExtended::accepts(1));
    assert!(ExecuteMenu::decode(&[]).is_err());
}

#[test]
fn restarts() {
    same(ResetRequest {}, &[]);
    same(ResetExtendedRequest { flags: ResetFlags::CONFIRM, delay_ms: 500 }, &[1, 0xF4, 1]);
    same(ResetExtendedRequest { flags: ResetFlags::from_bits_retain(0x83), delay_ms: 0 }, &[0x83, 0, 0]);
    same(Reset {}, &[]);
    same(SetTranspProxy { port1: 0, port2: 3 }, &[0, 3]);
    same(BootMode3 {}, &[]);
    same(BootMode3Extended { confirm: Switch::On, delay_ms: 0x0203 }, &[1, 3, 2]);
    assert_eq!(
        ResetExtendedRequest::decode(&[1, 2]),
        Err(DecodeError::TooShort { command: "CMD_RESET", needed: 3, got: 2 })
    );
}

#[test]
fn motors_in_step() {
    let message = SyncMotors { axis: Axis::Yaw, power: 100, time_ms: 1000, angle: 0x0102 };
    same(message, &[2, 100, 0xE8, 3, 2, 1]);
}

#[test]
fn pins_and_servos() {
    same(TriggerPin { pin_id: TriggerPinId::Aux1, state: TriggerPinState::High }, &[16, 1]);
    same(TriggerPin { pin_id: TriggerPinId::CanDrv7Aux3, state: TriggerPinState::Unknown(5) }, &[84, 5]);
    let mut servo_time = [ServoTime::FLOATING; 8];
    servo_time[0] = ServoTime(1500);
    let mut payload = [0xFF; 16];
    payload[..2].copy_from_slice(&[0xDC, 5]);
    same(ServoOut { servo_time }, &payload);
}

#[test]
fn chosen_servos_have_one_time_each() {
    let servo_bits =
        ServoOutputs::SERVO4 | ServoOutputs::CAN_DRV7_SERVO2 | ServoOutputs::from_bits_retain(3 << 30);
    let message = ServoOutExt { servo_bits, servo_time: (1..=4).map(ServoTime).collect() };
    let payload = [8, 0, 2, 0xC0, 1, 0, 2, 0, 3, 0, 4, 0];
    same(message.clone(), &payload);
    assert!(ServoOutExt::decode(&payload[..11]).is_err());
    let fewer = ServoOutExt { servo_bits: ServoOutputs::SERVO1, ..message };
    assert_eq!(
        fewer.encode(&mut [0; 255]),
        Err(EncodeError::Count { field: "SERVO_TIME", expected: 1, got: 4 })
    );
}

/// From the specification's examples, the first two without the misprints that make them a byte too short and too long.
#[test]
fn melodies() {
    let restart = NoteFrequency::RESTART.0;
    let notes = [987, 987, restart, 987, 987, restart, 1174, 1174, restart, 1567, 1567, 1567, 1567];
    let melody = BeepSound {
        mode: BeepSoundMode::CUSTOM_MELODY,
        note_length: SoundTime(5),
        decay_factor: 3,
        note_freq_hz: notes.into_iter().map(NoteFrequency).collect(),
        ..BeepSound::default()
    };
    same(
        melody,
        &[
            0x00, 0x80, 0x05, 0x03, 0, 0, 0, 0, 0, 0, 0, 0, 0xDB, 0x03, 0xDB, 0x03, 0x08, 0x52, 0xDB, 0x03,
            0xDB, 0x03, 0x08, 0x52, 0x96, 0x04, 0x96, 0x04, 0x08, 0x52, 0x1F, 0x06, 0x1F, 0x06, 0x1F, 0x06,
            0x1F, 0x06,
        ],
    );
    let standard = BeepSound { mode: BeepSoundMode::CALIBRATE, decay_factor: 3, ..BeepSound::default() };
    same(standard, &[1, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0]);

    assert_eq!(NoteFrequency::pause(125), NoteFrequency(21125));
    assert_eq!((NoteFrequency(21125).pause_samples(), NoteFrequency(3000).pause_samples()), (125, 0));
    let half_a_note = [1, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 7];
    assert_eq!(BeepSound::decode_prefix(&half_a_note).unwrap().1, [7]);
}

#[test]
fn virtual_channels() {
    let mut api_virt_ch = [CoarseRcSignal::UNDEFINED; 32];
    api_virt_ch[31] = CoarseRcSignal(500);
    let mut payload = [0; 64];
    payload.chunks_mut(2).for_each(|channel| channel.copy_from_slice(&[0xF0, 0xD8]));
    payload[62..].copy_from_slice(&[0xF4, 1]);
    same(ApiVirtChControl { api_virt_ch }, &payload);
    assert!(ApiVirtChControl::accepts(64) && !ApiVirtChControl::accepts(62));

    let first = [-500, 500].map(CoarseRcSignal).into_iter().collect();
    same(ApiVirtChControlVariable { api_virt_ch: first }, &[0x0C, 0xFE, 0xF4, 1]);
    let first = [RcSignal(16384), RcSignal::UNDEFINED_OLD, RcSignal::UNDEFINED].into_iter().collect();
    same(ApiVirtChHighRes { api_virt_ch: first }, &[0, 0x40, 1, 0x80, 0, 0x80]);
}
