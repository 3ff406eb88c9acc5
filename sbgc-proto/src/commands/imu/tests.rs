//! Golden bytes, all made by hand from the layouts.

use super::*;
use crate::commands::{CalibAction, CalibImu, ImuType};
use crate::units::{Acceleration, Angle, CalibrationTime, FrameHeading, GyroZero, SensorRate};
use crate::wire::{Float, PerXyz, ToWire};
use crate::{DecodeError, Message};

/// `message` is `payload`.
fn is<M: Message + ToWire>(message: &M, payload: &[u8]) {
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    assert!(M::accepts(payload.len()) && M::SIZE.contains(&payload.len()));
}

#[test]
fn sensors_are_chosen() {
    is(&SelectImu3 { imu_type: ImuType::Frame }, &[2]);
    assert!(!SelectImu3::accepts(12));
    let payload = [1, 3, 0xA0, 0x0F, 1, 2, 3, 4, 5, 6, 7, 8];
    for length in [11, 12] {
        let message = SelectImu3Extended::decode(&payload[..length]).unwrap();
        assert_eq!((message.imu_type, message.action), (CalibImu::Main, CalibAction::Temperature));
        assert_eq!(message.time_ms, CalibrationTime(4000));
        is(&message, &payload[..length]);
    }
    assert!(!SelectImu3Extended::accepts(4));
}

#[test]
fn gyroscopes_are_corrected() {
    let payload = [1, 0xE8, 0x03, 0x00, 0x80, 0, 0, 0xFF, 0x7F];
    let message = GyroCorrection::decode(&payload).unwrap();
    assert_eq!(message.imu_type, ImuIndex::Frame);
    assert_eq!(message.gyro_zero_corr, PerXyz { x: GyroZero(1000), y: GyroZero(-32768), z: GyroZero(0) });
    assert!((message.gyro_zero_corr.x.units() - 1.0).abs() < f32::EPSILON);
    is(&message, &payload);
}

/// Down is Z and North is Y.
const UPRIGHT: [u8; 24] =
    [0, 0, 0, 0, 0, 0, 0, 0, 0x00, 0x00, 0x80, 0x3F, 0, 0, 0, 0, 0x00, 0x00, 0x80, 0x3F, 0, 0, 0, 0];

#[test]
fn attitude_is_given_in_two_lengths() {
    let (zero, one) = (Float::default(), Float::from(1.0));
    let z_vect = PerXyz { x: zero, y: zero, z: one };
    let h_vect = PerXyz { x: zero, y: one, z: zero };
    let mut payload = [0; 26];
    payload[2..].copy_from_slice(&UPRIGHT);
    payload[1] = 5;
    is(&AhrsHelperLegacyRequest { mode: AhrsHelperModeByte::MAIN_REFERENCE, z_vect, h_vect }, &payload[1..]);
    payload[..2].copy_from_slice(&[0xCB, 0xFE]);
    let message = AhrsHelperRequest::decode(&payload).unwrap();
    let mode = message.mode;
    assert!(mode.set() && mode.frame_imu() && !mode.use_as_reference() && mode.translate());
    assert!(!mode.z_only() && !mode.h_only() && mode.translate_z_only() && mode.translate_h_only());
    assert_eq!(mode.location(), AhrsHelperLocation::BelowOuterMotor);
    assert!(mode.disable_internal_correction());
    is(&message, &payload);
    assert!(!AhrsHelperLegacyRequest::accepts(26));

    payload[4] = 0xC0;
    payload[5] = 0x7F;
    is(&AhrsHelperRequest::decode(&payload).unwrap(), &payload);
}

#[test]
fn attitude_is_asked_for() {
    let old = AhrsHelperShortRequest { mode: AhrsHelperModeByte::GET_FRAME, mode_high: None };
    is(&old, &[2]);
    is(&AhrsHelperShortRequest { mode_high: Some(0), ..old }, &[2, 0]);
    let answer = AhrsHelper::decode(&UPRIGHT).unwrap();
    assert_eq!((answer.z_vect.z.get().to_bits(), answer.h_vect.y), (1.0_f32.to_bits(), Float::from(1.0)));
    is(&answer, &UPRIGHT);
    assert!(AhrsHelperStream::accepts(26) && !AhrsHelperStream::accepts(24));
    is(&AhrsHelperStream::decode(&[3; 26]).unwrap(), &[3; 26]);
}

#[test]
fn motion_of_the_frame_is_told() {
    let payload = [
        0x00, 0x02, 0x00, 0xFE, 0x00, 0x00, 0x64, 0x00, 0x9C, 0xFF, 0x82, 0x0A, 0x00, 0x14, 0x00, 0xE2, 0xFF,
        0x00, 0x10, 0x00,
    ];
    let frame_acc = PerXyz { x: Acceleration::from_g(1.0), y: Acceleration(-512), z: Acceleration(0) };
    let (frame_angle_roll, frame_angle_pitch) = (Angle(100), Angle(-100));
    let message = HelperData::decode(&payload).unwrap();
    assert_eq!(
        message,
        HelperData {
            frame_acc,
            frame_angle_roll,
            frame_angle_pitch,
            flags: HelperDataFlags::default()
                .with_coord_sys(HelperCoordSys::Ground)
                .with_use_frame_heading(true),
            frame_speed: PerXyz { x: SensorRate(10), y: SensorRate(20), z: SensorRate(-30) },
            frame_heading: FrameHeading::from_degrees(90.0),
            ..HelperData::default()
        }
    );
    is(&message, &payload);
    is(&HelperDataLegacy { frame_acc, frame_angle_roll, frame_angle_pitch }, &payload[..10]);
    assert!(!HelperDataLegacy::accepts(20));
    is(&HelperData::decode(&[0xFF; 20]).unwrap(), &[0xFF; 20]);
    assert_eq!(
        HelperData::decode(&payload[..12]),
        Err(DecodeError::TooShort { command: "CMD_HELPER_DATA", needed: 20, got: 12 })
    );
}

#[test]
fn messages_are_passed_on() {
    is(&ExtImuCmdRequest { cmd_id: GpsImuCmd::GetDeviceInfo, data: &[] }, &[4]);
    is(&ExtImuCmd { cmd_id: GpsImuCmd::Unknown(14), data: &[1] }, &[14, 1]);
    let payload = [0x81, 9, 1, 2];
    let message = ExtSensCmdRequest::decode(&payload).unwrap();
    assert!(message.flags.contains(ExtSensFlags::HIGH_PRIORITY));
    assert_eq!((message.cmd_id, message.data), (GpsImuCmd::Calib, &[1, 2][..]));
    is(&message, &payload);
    is(&ExtSensCmd { cmd_id: GpsImuCmd::Data, data: &[5] }, &[8, 5]);
    assert!(ExtSensCmdRequest::decode(&[1]).is_err() && ExtImuCmd::decode(&[]).is_err());
}

#[test]
fn external_sensors_report() {
    is(&ExtImuDebugInfoRequest {}, &[]);
    let mut payload: [u8; 74] = core::array::from_fn(|index| u8::try_from(index).unwrap());
    payload[30..34].copy_from_slice(&(-1.0_f32).to_le_bytes());
    payload[58..66].copy_from_slice(&[0, 0, 0x80, 0x3F, 1, 0, 0xC0, 0x7F]);
    payload[70..].copy_from_slice(&9.8_f32.to_le_bytes());
    let message = ExtImuDebugInfo::decode(&payload).unwrap();
    assert_eq!(message.ahrs_debug_info.ext_imu_packets_received_cnt, 0x0807);
    assert_eq!((message.dcm[1], message.dcm[8]), (Float::from(-1.0), Float::from(1.0)));
    assert_eq!(message.acc_body.x, Float::from_bits(0x7FC0_0001), "NaN keeps its bits");
    assert_eq!(message.acc_body.z, Float::from(9.8));
    is(&message, &payload);
    assert!(ExtImuDebugInfo::decode(&payload[..73]).is_err());
}
