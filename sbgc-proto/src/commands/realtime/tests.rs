use super::*;
use crate::commands::{ImuType, ProfileId};
use crate::units::{Acceleration, Angle, EncoderAngle, LongAngle, RcSignal, SensorRate, Voltage};
use crate::wire::{FromWire, ToWire};
use crate::{DecodeError, Message};

use RealtimeDataCustomFlags as Flags;

fn check<M: for<'a> FromWire<'a> + ToWire + Message>(payload: &[u8]) -> M {
    let message = M::decode(payload).unwrap();
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    assert!(M::decode(&payload[..payload.len() - 1]).is_err());
    message
}

/// Made by hand from the layout.
const REALTIME_DATA_3: [u8; 63] = [
    0x0A, 0x00, 0xF6, 0xFF, 0x14, 0x00, 0xEC, 0xFF, 0x00, 0x02, 0xE2, 0xFF, 0x01, 0x00, 0x01, 0x08, 0x11,
    0x00, 0x00, 0x00, 0xDC, 0x05, 0xDD, 0x05, 0xDE, 0x05, 0xDF, 0x05, 0x00, 0x00, 0x00, 0x00, 0x01, 0x00,
    0x02, 0x00, 0x03, 0x00, 0x04, 0x00, 0x05, 0x00, 0x06, 0x00, 0x07, 0x00, 0x08, 0x00, 0x09, 0x00, 0x20,
    0x03, 0x03, 0x00, 0x00, 0x90, 0x06, 0x01, 0x01, 0x04, 0x0A, 0x14, 0x1E,
];

fn check_realtime_data_3(data: &RealtimeData3) {
    let acc = data.axes.map(|axis| axis.acc_data).into_array();
    assert_eq!(acc, [Acceleration(10), Acceleration(20), Acceleration::from_g(1.0)]);
    let gyro = data.axes.map(|axis| axis.gyro_data).into_array();
    assert_eq!(gyro, [SensorRate(-10), SensorRate(-20), SensorRate(-30)]);
    assert_eq!(data.serial_err_cnt, 1);
    assert_eq!(data.system_error, SystemErrors::NO_SENSOR | SystemErrors::EMERGENCY_STOP);
    assert_eq!(data.system_sub_error, SystemSubError::WrongInitialPosition);
    assert_eq!((data.rc_roll, data.rc_pitch, data.rc_yaw, data.rc_cmd), (1500, 1501, 1502, 1503));
    assert_eq!(data.imu_angle.into_array(), [Angle(1), Angle(2), Angle(3)]);
    assert_eq!(data.frame_imu_angle.into_array(), [Angle(4), Angle(5), Angle(6)]);
    assert_eq!(data.target_angle.into_array(), [Angle(7), Angle(8), Angle(9)]);
    assert_eq!((data.cycle_time, data.i2c_error_count), (800, 3));
    assert_eq!(data.bat_level, Voltage::from_volts(16.8));
    assert_eq!(data.rt_data_flags, RtDataFlags::MOTORS_ON);
    assert_eq!((data.cur_imu, data.cur_profile), (ImuType::Main, ProfileId::Profile5));
    assert_eq!(data.motor_power.into_array(), [10, 20, 30]);
}

#[test]
fn realtime_data_3() {
    check_realtime_data_3(&check(&REALTIME_DATA_3));
}

/// Made by hand from the layout.
#[test]
fn realtime_data_4_begins_with_realtime_data_3() {
    let more = [
        0x00, 0x10, 0x00, 0xF0, 0x01, 0x00, 0xAA, 0x00, 0x02, 0x00, 0xFE, 0xFF, 0xFF, 0xDC, 0x05, 0xE8, 0x03,
        0x18, 0xFC, 0x07, 0x00, 0xF6, 0x7F, 0x0A, 0xFF, 0xF0, 0xD8, 0x10, 0x27, 0x00, 0x00, 0x08, 0x63, 0x01,
        0x00, 0x02, 0x00, 0x03, 0x00, 0x20, 0x40, 0x00, 0x80,
    ];
    let mut payload = [0x55; 124];
    payload[..63].copy_from_slice(&REALTIME_DATA_3);
    payload[63..106].copy_from_slice(&more);
    let data: RealtimeData4 = check(&payload);
    check_realtime_data_3(&data.realtime_data_3);
    assert_eq!(data.stator_rotor_angle.into_array(), [Angle(4096), Angle(-4096), Angle(1)]);
    assert_eq!(data.reserved_1.0, [0xAA]);
    assert_eq!(data.balance_error.into_array(), [512, -512, -1]);
    assert_eq!(data.current, 1500);
    assert_eq!(data.mag_data.into_array(), [1000, -1000, 7]);
    assert_eq!((data.imu_temperature, data.frame_imu_temperature), (-10, 127));
    assert_eq!((data.imu_g_err.0, data.imu_h_err.0), (10, 255));
    assert_eq!(data.motor_out.into_array(), [-10000, 10000, 0]);
    assert_eq!((data.calib_mode, data.can_imu_ext_sens_err), (CalibMode::AutoPid, 0x63));
    assert_eq!(data.actual_angle.into_array(), [Angle(1), Angle(2), Angle(3)]);
    let unnamed = SystemStateFlags::from_bits_retain(0x8000_0000);
    let named = SystemStateFlags::POWER_MANAGER_ENABLED | SystemStateFlags::RETRACTED_POSITION;
    assert_eq!(data.system_state_flags, named | unnamed);
    assert_eq!(data.reserved_2.0, [0x55; 18]);
}

/// Made by hand from the layout.
#[test]
fn angles_axis_by_axis() {
    let payload = [
        0x00, 0x02, 0x00, 0xFC, 0x00, 0x00, 0x00, 0x10, 0x00, 0x10, 0xAE, 0xFF, 0x00, 0xE0, 0x00, 0x40, 0x33,
        0x03,
    ];
    let axes = check::<Angles>(&payload).axes;
    assert_eq!((axes.roll.imu_angle.degrees(), axes.roll.target_angle.degrees()), (11.25, -22.5));
    assert_eq!((axes.pitch.imu_angle.degrees(), axes.pitch.target_angle.degrees()), (90.0, 90.0));
    assert!((axes.pitch.target_speed.degrees_per_second() + 10.01).abs() < 0.001);
    assert_eq!((axes.yaw.imu_angle.degrees(), axes.yaw.target_angle.degrees()), (-180.0, 360.0));
    assert!((axes.yaw.target_speed.degrees_per_second() - 99.98).abs() < 0.005);
}

/// Made by hand from the layout.
#[test]
fn joint_angles_over_several_turns() {
    let payload = [
        0x64, 0x00, 0x38, 0xFF, 0x70, 0x11, 0x01, 0x00, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, //
        0xD4, 0xFE, 0x90, 0x01, 0x90, 0xEE, 0xFE, 0xFF, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, //
        0xFF, 0x7F, 0x00, 0x80, 0x00, 0x40, 0x00, 0x00, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,
    ];
    let axes = check::<AnglesExt>(&payload).axes;
    assert_eq!(axes.map(|axis| axis.imu_angle.0).into_array(), [100, -300, 32767]);
    assert_eq!(axes.map(|axis| axis.target_angle.0).into_array(), [-200, 400, -32768]);
    assert_eq!(axes.map(|axis| axis.stator_rotor_angle.0).into_array(), [70000, -70000, 16384]);
    assert_eq!(axes.yaw.stator_rotor_angle, LongAngle::from_degrees(360.0));
    assert_eq!(axes.yaw.reserved.0, [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
}

/// Made by hand from the layout.
#[test]
fn chosen_data_stand_in_the_order_of_the_bits() {
    let payload = [
        0xEF, 0xBE, 0x01, 0x00, 0xFE, 0xFF, 0x03, 0x00, // time, angles
        0xFB, 0xFF, 0x06, 0x00, 0x00, 0x00, 0x00, 0x3F, // motor 4
        0xC9, 0x80, 0x01, 0x02, 0x03, 0x04, 0x47, 0xE8, 0x03, 0x07, 0x00, 0x08, 0x09, 0, 0, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, // AHRS
        0x01, 0x02, 0x03, 0xFF, 0xFF, 0xFF, 0x00, 0x00, 0x80, // encoders
    ];
    let flags = Flags::from_bits_retain(0x0E01);
    assert_eq!(flags.payload_len(), payload.len());
    let (data, rest) = RealtimeDataCustom::decode_with(&payload, flags).unwrap();
    assert!(rest.is_empty());
    assert_eq!(data.encode_with(flags, &mut [0; 255]), Ok(&payload[..]));
    assert_eq!(data.timestamp_ms, 48879);
    assert_eq!(data.imu_angles, Some([Angle(1), Angle(-2), Angle(3)].into()));
    assert_eq!(data.target_angles, None);
    let motor4 = data.motor4_control.unwrap();
    assert_eq!((motor4.ff_speed.0, motor4.angle_error.0, motor4.pid_out.get()), (-5, 6, 0.5));
    let ahrs = data.ahrs_debug_info.unwrap();
    let source = ahrs.main_imu_ref_src;
    assert_eq!((source.attitude(), source.heading()), (AhrsRefSrc::Internal, AhrsRefSrc::Internal));
    assert!(source.internal_sensor() && source.enabled() && ahrs.frame_imu_ref_src.enabled());
    assert_eq!(ahrs.ext_imu_status.status(), ExtImuStatus::Fine);
    assert!(ahrs.ext_imu_status.bad_mag() && !ahrs.ext_imu_status.no_gps_signal());
    assert_eq!((ahrs.ext_imu_packets_received_cnt, ahrs.ext_imu_parse_err_cnt), (1000, 7));
    assert_eq!((ahrs.ext_corr_h_err.0, ahrs.ext_corr_z_err.0), (8, 9));
    let encoders = data.encoder_raw24.unwrap();
    assert_eq!(encoders.map(|angle| angle.0.get()).into_array(), [0x03_0201, 0xFF_FFFF, 0x80_0000]);
    assert_eq!(encoders.yaw, EncoderAngle::from_degrees(180.0));

    let view = RealtimeDataCustomView::decode(&payload).unwrap();
    assert_eq!(view.encode(&mut [0; 255]), Ok(&payload[..]));
    assert_eq!(view.decode_as(flags), Ok(data));
    assert_eq!(
        view.decode_as(flags | Flags::IMU_ANGLES_RAD),
        Err(DecodeError::Truncated {
            command: "CMD_REALTIME_DATA_CUSTOM",
            field: "IMU_ANGLES_RAD",
            offset: 51,
            needed: 12,
            got: 0
        })
    );
}

/// The sizes of the blocks, as the specification and newer sources have them.
#[test]
fn the_flags_tell_how_long_the_answer_is() {
    let sizes = [
        6, 6, 6, 6, 6, 12, 24, 36, 6, 8, 26, 9, 12, 40, 20, 46, 6, 12, 12, 7, 13, 8, 8, 8, 8, 12, 6, 24, 12,
        11, 0, 4,
    ];
    for (bit, size) in sizes.into_iter().enumerate() {
        let flags = Flags::from_bits_retain(1 << bit);
        assert_eq!(flags.payload_len(), 2 + size, "bit {bit}");
        let zeros = [0; 255];
        let (data, rest) = RealtimeDataCustom::decode_with(&zeros, flags).unwrap();
        assert_eq!(rest.len(), 253 - size);
        assert_eq!(data.encode_with(flags, &mut [0; 255]), Ok(&zeros[..2 + size]));
    }
    assert_eq!(Flags::empty().payload_len(), 2);
    assert_eq!(Flags::all().payload_len(), 2 + sizes.iter().sum::<usize>());
    assert!(RealtimeDataCustomRequest::new(Flags::all()).is_err());
    assert!(RealtimeDataCustomRequest::new(Flags::from_bits_retain(0x1FFF)).is_ok());
    let sizes = [6, 6, 6, 8, 6, 8, 6];
    for (bit, size) in sizes.into_iter().enumerate() {
        assert_eq!(RealtimeDataCustom2Flags::from_bits_retain(1 << bit).payload_len(), 2 + size, "bit {bit}");
    }
    assert_eq!(RealtimeDataCustom2Flags::all().payload_len(), 52);
}

/// Made by hand from the layout.
#[test]
fn flags_are_repeated_when_asked_for() {
    let payload = [0x01, 0x00, 0x20, 0x00, 0x00, 0x80, 0x00, 0x40, 0x00, 0xC0, 0, 0, 0, 0x80, 1, 0, 2, 0];
    let flags = Flags::RC_DATA | Flags::INCLUDE_FLAGS;
    let data = RealtimeDataCustomView::decode(&payload).unwrap().decode_as(flags).unwrap();
    assert_eq!(data.flags, Some(flags));
    let signals = data.rc_data.unwrap().map(RcSignal::signal);
    assert_eq!(signals[..4], [Some(1.0), Some(-1.0), Some(0.0), None]);
    assert_eq!(data.encode_with(flags, &mut [0; 255]), Ok(&payload[..]));
    assert!(data.encode_with(Flags::RC_DATA, &mut [0; 255]).is_err(), "flags that were not asked for");
}

/// Made by hand from the layout.
#[test]
fn the_second_set() {
    let payload = [2, 1, 1, 0, 2, 0, 0xFD, 0xFF, 0x06, 0, 0x09, 0, 1, 2, 3, 4, 0xE8, 0x03, 0xD0, 0x07, 0, 0];
    let flags = RealtimeDataCustom2Flags::FRAME_IMU_ANGLES
        | RealtimeDataCustom2Flags::PIN_STATE
        | RealtimeDataCustom2Flags::STAB_ERR_AMPL;
    let view = RealtimeDataCustom2View::decode(&payload).unwrap();
    let data = view.decode_as(flags).unwrap();
    assert_eq!(data.timestamp_ms, 0x0102);
    assert_eq!(data.frame_imu_angles, Some([Angle(1), Angle(2), Angle(-3)].into()));
    assert_eq!((data.extra_buttons_state, data.pin_state), (Some(6), Some(9)));
    assert_eq!(
        data.stab_err_ampl.map(|errors| errors.map(|error| error.0).into_array()),
        Some([1000, 2000, 0])
    );
    assert_eq!(data.encode_with(flags, &mut [0; 255]), Ok(&payload[..]));
}

/// Made by hand from the layout.
#[test]
fn a_request_names_its_flags() {
    let request: RealtimeDataCustomRequest = check(&[0x09, 0, 0, 0x40, 1, 2, 3, 4, 5, 6]);
    let flags = Flags::IMU_ANGLES | Flags::STATOR_ROTOR_ANGLE | Flags::from_bits_retain(1 << 30);
    assert_eq!(request.flags, flags);
    check::<RealtimeDataCustom2Request>(&[0x01, 0, 0, 0x80, 1, 2, 3, 4, 5, 6]);
}
