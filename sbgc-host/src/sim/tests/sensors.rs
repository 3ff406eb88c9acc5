//! Sensors, streams of every kind, auxiliary motors, and several ports.

use sbgc_proto::commands::{
    AhrsHelper, AhrsHelperMode, AhrsHelperRequest, CanDrvTelemetry, CanDrvTelemetryFlags, Control,
    ControlAxis, ControlConfig, ControlMode, DataStreamInterval, ExtMotorAction, ExtMotorSetpoint, ExtMotors,
    ExtMotorsAction, ExtMotorsControl, ExtMotorsControlDataSet, ExtMotorsState, ExtMotorsStateDataSet,
    ExtMotorsStateRequest, HelperData, HelperDataFlags, ImuIndex, MotorsOff, RealtimeData4,
    RealtimeData4Request, RealtimeDataCustom, RealtimeDataCustom2Flags, RealtimeDataCustomFlags,
    RealtimeDataCustomRequest, StreamSource,
};
use sbgc_proto::frame::{Version, encode_into};
use sbgc_proto::units::{Acceleration, Angle, ControlRate, FineAngle, FrameHeading, StreamInterval};
use sbgc_proto::wire::{Float, PerAxis, PerXyz};
use sbgc_proto::{CommandId, Message};

use super::{Bench, ms};
use crate::sim::{Board, Config};

fn vector(parts: [f32; 3]) -> PerXyz<Float> {
    parts.map(Float::from).into()
}

#[test]
fn an_attitude_from_outside_replaces_corrects_or_is_that_of_the_frame() {
    let mut bench = Bench::new(Config::default());
    // Pitched by 30 degrees, heading north.
    let (sin, cos) = 30.0_f32.to_radians().sin_cos();
    let set =
        |mode| AhrsHelperRequest { mode, z_vect: vector([0.0, sin, cos]), h_vect: vector([0.0, cos, -sin]) };
    assert_eq!(bench.ask(&set(AhrsHelperMode::MAIN_REFERENCE)), []);
    let pitch = bench.board.motion().axes().pitch.angle;
    assert!((pitch - 3.0).abs() < 0.1, "a reference corrects by and by: {pitch}");
    assert_eq!(bench.ask(&set(AhrsHelperMode::SET_CAMERA_ATTITUDE)), []);
    assert!((bench.board.motion().axes().pitch.angle - 30.0).abs() < 0.1);
    let got =
        bench.ask_one(&AhrsHelperRequest { mode: AhrsHelperMode::GET_MAIN, ..AhrsHelperRequest::default() });
    assert!((got.decoded::<AhrsHelper>().z_vect.y.get() - sin).abs() < 1e-3);
    assert_eq!(bench.ask(&set(AhrsHelperMode::SET_FRAME_ATTITUDE)), []);
    assert!((bench.board.motion().frame().pitch - 30.0).abs() < 0.1);
}

#[test]
fn the_first_heading_turns_the_camera_too() {
    let mut bench = Bench::new(Config::default());
    let heading = |degrees| HelperData {
        flags: HelperDataFlags::default().with_use_frame_heading(true),
        frame_heading: FrameHeading::from_degrees(degrees),
        ..HelperData::default()
    };
    assert_eq!(bench.ask(&heading(40.0)), []);
    let motion = bench.board.motion();
    assert!((motion.frame().yaw - 40.0).abs() < 0.1 && (motion.axes().yaw.angle - 40.0).abs() < 0.1);
    assert_eq!(bench.ask(&heading(50.0)), []);
    let motion = bench.board.motion();
    assert!((motion.frame().yaw - 50.0).abs() < 0.1 && (motion.axes().yaw.angle - 40.0).abs() < 0.1);
}

#[test]
fn noise_is_small_and_the_same_for_the_same_seed() {
    let data = |seed| {
        let mut bench = Bench::new(Config { seed, ..Config::default() });
        let flags = RealtimeDataCustomFlags::GYRO_DATA | RealtimeDataCustomFlags::ACC_DATA;
        let got = bench.ask_one(&RealtimeDataCustomRequest::new(flags).unwrap());
        RealtimeDataCustom::decode_with(&got.payload, flags).unwrap().0
    };
    assert_eq!(data(1), data(1));
    assert_ne!(data(1), data(2));
    let acc = data(1).acc_data.unwrap();
    assert!((acc.z.g() - 1.0).abs() < 0.02 && data(1).gyro_data.unwrap().x.degrees_per_second().abs() < 0.2);
}

#[test]
fn motors_that_are_off_need_no_current() {
    let mut bench = Bench::new(Config::default());
    let current = |bench: &mut Bench| bench.ask_one(&RealtimeData4Request {}).decoded::<RealtimeData4>();
    let on = current(&mut bench);
    bench.ask_one(&MotorsOff::default());
    let off = current(&mut bench);
    assert!(on.current > off.current + 400 && off.current < 100, "{} {}", on.current, off.current);
    assert_eq!(off.motor_out, PerAxis::default());
    assert!(off.realtime_data_3.bat_level >= on.realtime_data_3.bat_level);
}

#[test]
fn every_kind_of_stream_runs() {
    let mut bench = Bench::new(Config::default());
    let telemetry = CanDrvTelemetryFlags::BUS_VOLTAGE | CanDrvTelemetryFlags::MOTOR_SPEED;
    let sources = [
        StreamSource::RealtimeData3,
        StreamSource::RealtimeData4,
        StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::SYSTEM_POWER_STATE),
        StreamSource::RealtimeDataCustom2(RealtimeDataCustom2Flags::FRAME_ACC),
        StreamSource::AhrsHelper(ImuIndex::Main),
        StreamSource::CanDrvTelemetry { flags: telemetry, drv_id: 1 },
        StreamSource::ExtMotorsState {
            for_motors: ExtMotors::MOTOR1 | ExtMotors::MOTOR3,
            data_set: ExtMotorsStateDataSet::ANGLE32,
        },
    ];
    for source in sources {
        bench.ask_one(&DataStreamInterval::new(source, StreamInterval(100)));
        let got = bench.run(ms(1000));
        // One for each of the two auxiliary motors.
        let each = if matches!(source, StreamSource::ExtMotorsState { .. }) { 2 } else { 1 };
        assert_eq!(got.len(), 10 * each, "{source:?}");
        assert!(got.iter().all(|got| CommandId::from(got.id) == source.cmd_id()), "{source:?}");
        if let StreamSource::CanDrvTelemetry { flags, .. } = source {
            let (data, _) = CanDrvTelemetry::decode_with(&got[0].payload, flags).unwrap();
            assert!(data.bus_voltage.unwrap() > 15_000 && data.drv_id == 1, "{data:?}");
        }
        bench.ask_one(&DataStreamInterval::new(source, StreamInterval::UNREGISTER));
        assert_eq!(bench.run(ms(300)), []);
    }
}

#[test]
fn auxiliary_motors_are_moved_one_by_one() {
    let mut bench = Bench::new(Config::default());
    let second = ExtMotors::MOTOR2;
    let on =
        ExtMotorsAction { for_motors: second | ExtMotors::CONFIRM, action: ExtMotorAction::On, args: &[] };
    assert_eq!(bench.ask_one(&on).payload[0], 128);
    let setpoint = ExtMotorSetpoint { setpoint: Some(4096), ..ExtMotorSetpoint::default() };
    let control = ExtMotorsControl {
        for_motors: second,
        data_set: ExtMotorsControlDataSet::empty(),
        motors: [setpoint].into_iter().collect(),
    };
    assert_eq!(bench.ask(&control), [], "without the bit it is not confirmed");
    bench.run(ms(2000));
    let data_set = ExtMotorsStateDataSet::ANGLE32;
    let got = bench.ask(&ExtMotorsStateRequest { for_motors: second | ExtMotors::MOTOR5, data_set });
    let angles: Vec<_> = got.iter().map(super::Got::decoded::<ExtMotorsState>).collect();
    assert_eq!((angles[0].motor_id, angles[0].angle32), (1, Some(FineAngle(1 << 18))));
    assert_eq!((angles[1].motor_id, angles[1].angle32), (4, Some(FineAngle(0))));
}

#[test]
fn a_port_with_a_higher_priority_is_obeyed_alone() {
    let mut board = Board::new(Config::default());
    let other = board.connect().unwrap();
    let mut now = ms(1);
    let mut send = |board: &mut Board, port: u8, id: u8, payload: &[u8]| {
        let mut buffer = [0; 64];
        board.receive_on(port, now, encode_into(Version::V1, id, payload, &mut buffer).unwrap());
        now += ms(8);
        board.advance(now);
    };
    let mut buffer = [0; 64];
    let config = ControlConfig { this_ch_priority: 5, ..ControlConfig::default() };
    send(&mut board, other, 90, config.encode(&mut buffer).unwrap());
    let pitch_to = |degrees| Control {
        control_mode: PerAxis { pitch: ControlMode::ANGLE, ..[ControlMode::IGNORE; 3].into() },
        axes: [ControlAxis { speed: ControlRate(0), angle: Angle::from_degrees(degrees) }; 3].into(),
    };
    send(&mut board, other, 67, pitch_to(20.0).encode(&mut buffer).unwrap());
    send(&mut board, 0, 67, pitch_to(-20.0).encode(&mut buffer).unwrap());
    board.advance(ms(3000));
    assert!((board.motion().axes().pitch.angle - 20.0).abs() < 0.1, "{:?}", board.motion().axes().pitch);
}

#[test]
fn an_acceleration_that_is_not_there_leads_gravity_astray() {
    let mut bench = Bench::new(Config::default());
    let mut error = |x: f32| {
        let acc = PerXyz { x, y: 0.0, z: 0.0 }.map(Acceleration::from_g);
        assert_eq!(bench.ask(&HelperData { frame_acc: acc, ..HelperData::default() }), []);
        bench.ask_one(&RealtimeData4Request {}).decoded::<RealtimeData4>().imu_g_err.degrees()
    };
    assert!(error(0.0) < 0.5);
    let astray = error(0.2);
    assert!((astray - 11.5).abs() < 0.5, "{astray}");
    assert!(error(0.0) < 0.5);
}
