//! Control payloads byte by byte.

use super::*;
use crate::units::{ControlRateLimit, FineRate, JerkSlope, PackedQuaternion, SensorRate};
use crate::wire::{PerXyz, ToWire};
use crate::{DecodeError, Message};

fn bytes<M: Message + ToWire>(message: &M) -> Vec<u8> {
    message.encode(&mut [0; 255]).unwrap().to_vec()
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

/// The first from a third-party script that is in use, the others made by hand from the layout.
#[test]
fn only_chosen_values_are_sent() {
    let at = |angle| ControlExtAxis { control_mode: ControlMode::ANGLE, angle, ..ControlExtAxis::default() };
    let angles = [None, Some(at(Some(Angle(0x0102)))), Some(at(Some(Angle(-2))))];
    let control = ControlExt::new(angles.into());
    assert_eq!(control.data_set.bits(), 0x0840);
    let payload = [0x40, 8, 2, 0, 2, 1, 2, 0, 0xFE, 0xFF];
    assert_eq!(bytes(&control), payload);
    assert_eq!(ControlExt::decode(&payload), Ok(control));

    // Long values of ROLL, both speeds of PITCH, and a bit without a name for YAW.
    let payload = [0x2C, 0x41, 2, 1, 4, 3, 2, 1, 8, 7, 6, 5, 0x81, 0, 5, 0, 0x42, 0x80];
    let control = ControlExt::decode(&payload).unwrap();
    let roll = control.roll.unwrap();
    assert_eq!((roll.speed, roll.speed_32bit), (None, Some(FineRate(0x0102_0304))));
    assert_eq!((roll.angle, roll.angle_32bit), (None, Some(0x0506_0708)));
    assert_eq!(roll.mode_flags, ControlExtModeFlags::DISABLE_ANGLE_ERR_CORR);
    let pitch = control.pitch.unwrap();
    assert_eq!((pitch.speed, pitch.speed_32bit), (Some(ControlRate(5)), None));
    let yaw = control.yaw.unwrap();
    assert_eq!((yaw.control_mode, yaw.mode_flags.bits()), (ControlMode(0x42), 0x80));
    assert_eq!((yaw.speed, yaw.angle), (None, None));
    assert_eq!(bytes(&control), payload);

    assert_eq!(bytes(&ControlExt::new(PerAxis { roll: Some(at(None)), ..PerAxis::default() })), [0, 0]);
}

/// Made by hand from the layout.
#[test]
fn quaternions_are_sent_as_the_mode_says() {
    let one = 1.0_f32.to_le_bytes();
    let control = ControlQuat::attitude([1.0, 0.0, 0.0, 0.0], ControlQuatFlags::CONFIRM);
    let mut payload = [0; 18];
    payload[..2].copy_from_slice(&[2, 1]);
    payload[2..6].copy_from_slice(&one);
    assert_eq!(bytes(&control), payload);
    assert_eq!(ControlQuat::decode(&payload), Ok(control));

    let payload = [2, 2, 0, 0, 0, 0, 0, 0, 0, 0];
    assert_eq!(
        bytes(&ControlQuat::attitude([1.0, 0.0, 0.0, 0.0], ControlQuatFlags::ATTITUDE_PACKED)),
        payload
    );

    let speed = ControlQuat::speed(PerXyz { x: 0.0, y: 1.0, z: 0.0 }, ControlQuatFlags::empty());
    assert_eq!(bytes(&speed), [&[1, 0, 0, 0, 0, 0][..], &one, &[0; 4]].concat());
    assert_eq!(bytes(&ControlQuat::disable()), [0, 0]);
    assert_eq!(ControlQuat::decode_prefix(&[7, 0, 9]).unwrap().1, [9], "an unknown mode sends nothing");

    let both = [&[5, 0x82][..], &[1; 8], &f32::NAN.to_le_bytes(), &[0xFF; 8]].concat();
    assert_eq!(bytes(&ControlQuat::decode(&both).unwrap()), both);
}

#[test]
fn quaternions_survive_packing() {
    let half = 0.5_f32.sqrt();
    for quaternion in [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, -1.0, 0.0, 0.0],
        [0.5, -0.5, 0.5, -0.5],
        [0.0, half, 0.0, -half],
        [0.1, 0.2, -0.3, (1.0_f32 - 0.14).sqrt()],
    ] {
        let unpacked = PackedQuaternion::pack(quaternion).unpack();
        for (left, right) in quaternion.into_iter().zip(unpacked) {
            assert!((left - right).abs() < 2e-6, "{quaternion:?} {unpacked:?}");
        }
    }
    assert_eq!(PackedQuaternion::pack([1.0, 0.0, 0.0, -0.5]).0.0, [0, 0, 0, 0, 0, 0x27, 0xA8, 0x0D]);
    let _ = PackedQuaternion(crate::wire::Bytes([0xFF; 8])).unpack();
}

/// Made by hand from the layout.
#[test]
fn quaternion_status_and_config() {
    let payload = [0x61, 0, 0, 0x80, 9, 0x41, 0x80, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0];
    let status = ControlQuatStatus::decode(&payload).unwrap();
    assert_eq!(status.mode, Some(ControlQuatMode::SpeedLimited));
    assert_eq!(status.flags.unwrap().bits(), 0x8041);
    assert_eq!(status.setpoint_speed, Some(PerXyz { x: 1, y: 2, z: 3 }.map(SensorRate)));
    assert_eq!(status.actual_speed.unwrap().z, SensorRate(6));
    assert_eq!(status.actual_attitude, None);
    assert_eq!(bytes(&status), payload);
    let all = [&[0xFF, 3, 0, 0][..], &[0x55; 93]].concat();
    assert_eq!(bytes(&ControlQuatStatus::decode(&all).unwrap()), all);
    assert!(ControlQuatStatus::decode(&all[..96]).is_err());

    let payload = [0x3F, 0x80, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0, 7, 0, 8, 0, 9, 0, 1, 0x80, 10, 11];
    let config = ControlQuatConfig::decode(&payload).unwrap();
    assert_eq!(config.max_speed.unwrap().z, ControlRateLimit(3));
    assert_eq!((config.acc_limit.unwrap().x, config.jerk_slope.unwrap().z), (4, 9));
    assert_eq!((config.attitude_lpf_freq, config.speed_lpf_freq), (Some(10), Some(11)));
    assert_eq!(bytes(&config), payload);
    assert_eq!(bytes(&ControlQuatConfig::default()), [0, 0]);
}
