//! Control payloads byte by byte.

use super::*;
use crate::units::JerkSlope;
use crate::wire::ToWire;
use crate::{DecodeError, Message};

fn bytes<M: Message + ToWire>(message: &M) -> heapless::Vec<u8, 255> {
    let mut buffer = [0; 255];
    heapless::Vec::from_slice(message.encode(&mut buffer).unwrap()).unwrap()
}

/// From the vendor's published example commands.
#[test]
fn published_examples() {
    let mut yaw_45 = Control::default();
    yaw_45.control_mode.yaw = ControlMode::ANGLE;
    yaw_45.axes.yaw = ControlAxis::angle(Angle::from_degrees(45.0));

    let mut pitch_up = Control::default();
    pitch_up.control_mode.pitch = ControlMode::ANGLE;
    pitch_up.axes.pitch =
        ControlAxis { speed: ControlRate::from_degrees_per_second(5.0), angle: Angle::from_degrees(-90.0) };

    let mut pitch_up_rel_frame = Control::default();
    pitch_up_rel_frame.control_mode.pitch = ControlMode::ANGLE_REL_FRAME;
    pitch_up_rel_frame.axes.pitch =
        ControlAxis { speed: ControlRate::from_degrees_per_second(90.0), angle: Angle::from_degrees(-45.0) };

    let mut home = Control::angles_rel_frame(PerAxis::default(), ControlRate(0)).with_auto_task();
    home.control_mode.roll = ControlMode::ANGLE.with_auto_task(true);
    let mut level = home;
    level.control_mode.pitch = ControlMode::ANGLE.with_auto_task(true);

    for (control, payload) in [
        (yaw_45, [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8]),
        (pitch_up, [0, 2, 0, 0, 0, 0, 0, 0x29, 0, 0, 0xF0, 0, 0, 0, 0]),
        (pitch_up_rel_frame.with_auto_task(), [0, 0x45, 0, 0, 0, 0, 0, 0xE1, 2, 0, 0xF8, 0, 0, 0, 0]),
        (home, [0x42, 0x45, 0x45, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        (level, [0x42, 0x42, 0x45, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        (Control::release(), [0; 15]),
    ] {
        assert_eq!(bytes(&control), payload);
        assert_eq!(Control::decode(&payload), Ok(control));
    }
}

/// Made by hand from the layout.
#[test]
fn legacy_has_one_mode() {
    let payload = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0x52, 0, 0, 0];
    let control = ControlLegacy::decode(&payload).unwrap();
    assert_eq!(control.control_mode, ControlMode::SPEED);
    assert_eq!(control.axes.yaw.speed, ControlRate::from_degrees_per_second(10.0));
    assert_eq!(bytes(&control), payload);
    assert!(ControlLegacy::accepts(13) && !ControlLegacy::accepts(15));
    assert_eq!(
        Control::decode(&payload),
        Err(DecodeError::TooShort { command: "CMD_CONTROL", needed: 15, got: 13 })
    );
}

#[test]
fn constructors_set_all_axes() {
    let speeds = Control::speeds(PerAxis { roll: 1, pitch: -2, yaw: 3 }.map(ControlRate));
    assert_eq!(bytes(&speeds), [1, 1, 1, 1, 0, 0, 0, 0xFE, 0xFF, 0, 0, 3, 0, 0, 0]);
    let fine = Control::fine_speeds([0.5; 3].map(FineControlRate::from_degrees_per_second).into());
    assert_eq!(fine.control_mode.roll, ControlMode(0x81));
    assert!((fine.axes.yaw.speed_in(fine.control_mode.yaw) - 0.5).abs() < 1e-6);
    assert!((fine.axes.yaw.speed_in(ControlMode::SPEED) - 61.04).abs() < 0.01);
    let path = Control::path(speeds.axes).with_auto_task();
    assert_eq!(path.control_mode, [ControlMode(3); 3].into());
}

#[test]
fn modes_keep_what_they_do_not_know() {
    for raw in 0..=255 {
        let mode = ControlMode(raw);
        assert_eq!(mode.with_kind(mode.kind()).with_auto_task(mode.force_rc_speed()), mode);
    }
    assert_eq!(ControlMode(0x3F).kind(), ControlModeKind::Unknown(15));
    assert_eq!(ControlMode::from(ControlModeKind::Rc).with_force_rc_speed(true), ControlMode(0x44));
    let lost = ControlAxis::rc_signal(CoarseRcSignal::UNDEFINED);
    assert_eq!((lost.angle, lost.as_rc_signal()), (Angle(-10000), CoarseRcSignal::UNDEFINED));
    let lost = ControlAxis::high_res_rc_signal(RcSignal::UNDEFINED);
    assert_eq!((lost.angle, lost.as_high_res_rc_signal()), (Angle(-32768), RcSignal::UNDEFINED));
}

/// Made by hand from the layout.
#[test]
fn config_has_every_byte_in_its_place() {
    let mut payload: [u8; 41] = core::array::from_fn(|index| u8::try_from(index).unwrap());
    payload[29..31].copy_from_slice(&[1, 0x80]);
    let config = ControlConfig::decode(&payload).unwrap();
    assert_eq!(config.timeout_ms, 0x0100);
    assert_eq!(config.this_ch_priority, 6);
    assert_eq!(config.axes.pitch.angle_lpf, 14);
    assert_eq!(config.axes.pitch.acc_limit, 0x1211);
    assert_eq!(config.axes.pitch.jerk_slope, JerkSlope(19));
    assert_eq!(config.rc_expo_rate, 28);
    assert_eq!(config.flags, ControlConfigFlags::NO_CONFIRM | ControlConfigFlags::from_bits_retain(0x8000));
    assert_eq!(config.euler_order, ControlEulerOrder::Unknown(31));
    assert_eq!(bytes(&config), payload);
    assert!(ControlConfig::decode(&payload[..40]).is_err());

    let no_confirm = ControlConfig { flags: ControlConfigFlags::NO_CONFIRM, ..ControlConfig::default() };
    let mut payload = [0; 41];
    payload[29] = 1;
    assert_eq!(bytes(&no_confirm), payload);
}
