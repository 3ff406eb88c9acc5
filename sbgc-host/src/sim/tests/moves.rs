//! Every source of motion.

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    Angles, ApiVirtChHighRes, Confirm, Control, ControlAxis, ControlConfig, ControlExt, ControlExtAxis,
    ControlMode, ControlQuat, ControlQuatFlags, ControlQuatStatus, ControlQuatStatusDataSet,
    ControlQuatStatusRequest, GetAngles, Params3, ParamsExt2, ProfileId, RcMode, RcSource, ReadParams3,
    ReadParamsExt2, RealtimeData3, RealtimeData3Request, SystemErrors, WriteParams3, WriteParamsExt2,
};
use sbgc_proto::units::{Angle, ControlRate, FineControlRate, RcSignal};
use sbgc_proto::wire::PerAxis;

use super::{Bench, ms};
use crate::sim::{Axis, Config, Fault};

fn change(bench: &mut Bench, change: impl FnOnce(&mut Params3)) {
    let mut block = bench.ask_one(&ReadParams3 { profile_id: ProfileId::Current }).decoded::<Params3>();
    change(&mut block);
    bench.ask(&WriteParams3(block));
}

fn change_2(bench: &mut Bench, change: impl FnOnce(&mut ParamsExt2)) {
    let mut block = bench.ask_one(&ReadParamsExt2 { profile_id: ProfileId::Current }).decoded::<ParamsExt2>();
    change(&mut block);
    bench.ask(&WriteParamsExt2(block));
}

fn pitch(bench: &Bench) -> Axis {
    bench.board.motion().axes().pitch
}

fn in_pitch(mode: ControlMode, axis: ControlAxis) -> Control {
    let control_mode = PerAxis { pitch: mode, ..[ControlMode::IGNORE; 3].into() };
    Control { control_mode, axes: PerAxis { pitch: axis, ..PerAxis::default() } }
}

fn channel(bench: &mut Bench, signal: RcSignal) {
    assert_eq!(bench.ask(&ApiVirtChHighRes { api_virt_ch: [signal].into_iter().collect() }), []);
}

#[test]
fn a_speed_of_0_is_that_of_the_parameters_and_another_one_overrides_it() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |block| block.rc.pitch.rc_speed = 10);
    let angle = ControlAxis::angle(Angle::from_degrees(90.0));
    bench.ask_one(&in_pitch(ControlMode::ANGLE, angle));
    bench.run(ms(1000));
    // 160 steps of 0.122 degrees per second.
    assert!((pitch(&bench).speed - 19.53).abs() < 0.1, "{:?}", pitch(&bench));
    let speed = ControlRate::from_degrees_per_second(50.0);
    bench.ask_one(&in_pitch(ControlMode::ANGLE, ControlAxis { speed, ..angle }));
    bench.run(ms(300));
    assert!((pitch(&bench).speed - 50.0).abs() < 0.1, "{:?}", pitch(&bench));
}

#[test]
fn target_and_angle_differ_while_it_moves() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&in_pitch(ControlMode::ANGLE, ControlAxis::angle(Angle::from_degrees(60.0))));
    bench.run(ms(400));
    let axis = bench.ask_one(&GetAngles {}).decoded::<Angles>().axes.pitch;
    assert_eq!(axis.target_angle, Angle::from_degrees(60.0));
    assert!(axis.imu_angle.degrees() > 2.0 && axis.imu_angle.degrees() < 40.0, "{axis:?}");
    assert!((axis.target_speed.degrees_per_second() - 60.0).abs() < 1.0, "{axis:?}");
    bench.run(ms(2000));
    let axis = bench.ask_one(&GetAngles {}).decoded::<Angles>().axes.pitch;
    assert_eq!((axis.imu_angle, axis.target_speed), (axis.target_angle, ControlRate(0)));
}

#[test]
fn a_fine_speed_is_counted_in_thousandths() {
    let mut bench = Bench::new(Config::default());
    let mode = ControlMode::SPEED.with_high_res_speed(true);
    bench.ask_one(&in_pitch(mode, ControlAxis::fine_speed(FineControlRate(500))));
    bench.run(ms(10_000));
    assert!((pitch(&bench).angle - 5.0).abs() < 0.1, "{:?}", pitch(&bench));
}

#[test]
fn software_limits_stop_an_axis() {
    let mut bench = Bench::new(Config::default());
    change_2(&mut bench, |block| {
        block.frame_cam_angle_min.pitch = -20;
        block.frame_cam_angle_max.pitch = 35;
    });
    let speed = ControlRate::from_degrees_per_second(-40.0);
    bench.ask_one(&in_pitch(ControlMode::SPEED, ControlAxis::speed(speed)));
    bench.run(ms(3000));
    assert!((pitch(&bench).angle + 20.0).abs() < 0.01 && pitch(&bench).speed == 0.0, "{:?}", pitch(&bench));
    bench.ask_one(&in_pitch(ControlMode::ANGLE, ControlAxis::angle(Angle::from_degrees(90.0))));
    bench.run(ms(4000));
    assert!((pitch(&bench).angle - 35.0).abs() < 0.01, "{:?}", pitch(&bench));
}

#[test]
fn speed_with_angle_arrives_at_the_angle() {
    let mut bench = Bench::new(Config::default());
    let axis =
        ControlAxis { speed: ControlRate::from_degrees_per_second(20.0), angle: Angle::from_degrees(30.0) };
    bench.ask_one(&in_pitch(ControlMode::SPEED_ANGLE, axis));
    bench.run(ms(800));
    assert!(pitch(&bench).speed > 15.0 && pitch(&bench).speed < 26.0, "{:?}", pitch(&bench));
    bench.run(ms(6000));
    assert!((pitch(&bench).angle - 30.0).abs() < 0.1, "{:?}", pitch(&bench));
}

#[test]
fn remote_control_moves_serial_control_overrides_and_mode_0_gives_it_back() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |block| block.rc_map_pitch = RcSource(129));
    channel(&mut bench, RcSignal::from_fraction(0.5));
    bench.run(ms(3000));
    assert!((pitch(&bench).angle - 45.0).abs() < 0.1, "{:?}", pitch(&bench));
    bench.ask_one(&in_pitch(ControlMode::ANGLE, ControlAxis::angle(Angle::from_degrees(-10.0))));
    bench.run(ms(3000));
    assert!((pitch(&bench).angle + 10.0).abs() < 0.1, "{:?}", pitch(&bench));
    // Mode 0 for this axis alone.
    bench.ask_one(&in_pitch(ControlMode::NO_CONTROL, ControlAxis::default()));
    bench.run(ms(3000));
    assert!((pitch(&bench).angle - 45.0).abs() < 0.1, "{:?}", pitch(&bench));
    // Without a signal the axis stands.
    for lost in [RcSignal::UNDEFINED, RcSignal::UNDEFINED_OLD] {
        channel(&mut bench, RcSignal::from_fraction(-0.5));
        bench.run(ms(300));
        channel(&mut bench, lost);
        bench.run(ms(500));
        let stands = pitch(&bench);
        assert!(stands.speed == 0.0 && stands.angle > -40.0 && stands.angle < 45.0, "{stands:?}");
    }
}

#[test]
fn dead_band_trim_and_inversion_are_skipped_when_speed_is_forced() {
    let mut bench = Bench::new(Config::default());
    change(&mut bench, |block| {
        block.rc.pitch.rc_mode = block.rc.pitch.rc_mode.with_mode(RcMode::Speed).with_inverted(true);
        block.rc_deadband = 100;
    });
    let signal = |steps: i16| ControlAxis::angle(Angle(steps));
    // 0.2 of full scale is the dead band.
    bench.ask_one(&in_pitch(ControlMode::RC, signal(90)));
    bench.run(ms(500));
    assert_eq!(pitch(&bench).angle.to_bits(), 0.0_f64.to_bits());
    bench.ask_one(&in_pitch(ControlMode::RC, signal(500)));
    bench.run(ms(1000));
    assert!((pitch(&bench).speed + 60.5).abs() < 0.5, "{:?}", pitch(&bench));
    bench.ask_one(&in_pitch(ControlMode::RC.with_force_rc_speed(true), signal(50)));
    bench.run(ms(1000));
    assert!((pitch(&bench).speed - 6.05).abs() < 0.1, "{:?}", pitch(&bench));
    bench.ask_one(&in_pitch(ControlMode::RC, signal(-10_000)));
    bench.run(ms(1000));
    assert_eq!(pitch(&bench).speed.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn zeros_end_control_and_its_configuration() {
    let mut bench = Bench::new(Config::default());
    let config = ControlConfig { timeout_ms: 200, ..ControlConfig::default() };
    bench.ask_one(&config);
    let speed = ControlRate::from_degrees_per_second(10.0);
    bench.ask_one(&Control::release());
    bench.ask_one(&in_pitch(ControlMode::SPEED, ControlAxis::speed(speed)));
    bench.run(ms(1000));
    assert!(pitch(&bench).speed > 9.0, "the time-out is gone");
    bench.ask_one(&Control::release());
    bench.run(ms(500));
    assert_eq!(pitch(&bench).speed.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn a_filter_makes_steps_smooth() {
    let mut bench = Bench::new(Config::default());
    let mut config = ControlConfig::default();
    config.axes.pitch.speed_lpf = 5;
    config.axes.pitch.acc_limit = 10_000;
    bench.ask_one(&config);
    let speed = ControlRate::from_degrees_per_second(50.0);
    bench.ask_one(&in_pitch(ControlMode::SPEED, ControlAxis::speed(speed)));
    bench.run(ms(100));
    assert!(pitch(&bench).setpoint_speed < 35.0, "{:?}", pitch(&bench));
    bench.run(ms(4000));
    assert!((pitch(&bench).setpoint_speed - 50.0).abs() < 0.1, "{:?}", pitch(&bench));
}

#[test]
fn the_camera_follows_the_frame_where_that_is_wanted() {
    let mut bench = Bench::new(Config::default());
    let frame = PerAxis { yaw: 40.0, ..PerAxis::default() };
    bench.board.turn_frame(frame);
    bench.run(ms(1000));
    let stands = bench.board.motion().axes().yaw.angle;
    assert_eq!(stands.to_bits(), 0.0_f64.to_bits(), "it is held against the frame");
    assert!((bench.board.motion().joints().yaw + 40.0).abs() < 1e-9);
    change(&mut bench, |block| block.rc.yaw.rc_follow = 1);
    bench.run(ms(20_000));
    let yaw = bench.board.motion().axes().yaw.angle;
    assert!((yaw - 40.0).abs() < 1.0, "{yaw}");
}

#[test]
fn angles_relative_to_the_frame_count_from_where_it_points() {
    let mut bench = Bench::new(Config::default());
    bench.board.turn_frame(PerAxis { pitch: 10.0, ..PerAxis::default() });
    bench.ask_one(&in_pitch(ControlMode::ANGLE_REL_FRAME, ControlAxis::angle(Angle::from_degrees(20.0))));
    bench.run(ms(3000));
    assert!((pitch(&bench).angle - 30.0).abs() < 0.1, "{:?}", pitch(&bench));
}

#[test]
fn the_extended_form_moves_only_the_axes_that_it_names() {
    let mut bench = Bench::new(Config::default());
    let axis = ControlExtAxis {
        control_mode: ControlMode::ANGLE,
        angle: Some(Angle::from_degrees(15.0)),
        ..ControlExtAxis::default()
    };
    let got = bench.ask_one(&ControlExt::new(PerAxis { roll: Some(axis), ..PerAxis::default() }));
    assert_eq!(got.decoded::<Confirm>().cmd_id, CommandId::ControlExt);
    bench.run(ms(2000));
    let PerAxis { roll, pitch, yaw } = bench.board.motion().axes().map(|axis| axis.angle);
    assert!((roll - 15.0).abs() < 0.1 && pitch == 0.0 && yaw == 0.0);
}

#[test]
fn a_quaternion_is_an_attitude_and_its_arrival_is_reported() {
    let mut bench = Bench::new(Config::default());
    // 30 degrees of pitch.
    let half = 15.0_f32.to_radians();
    let flags = ControlQuatFlags::CONFIRM | ControlQuatFlags::AUTO_TASK;
    bench.ask_one(&ControlQuat::attitude([half.cos(), half.sin(), 0.0, 0.0], flags));
    let got = bench.run(ms(3000));
    assert_eq!(got.len(), 1, "{got:?}");
    assert_eq!(got[0].payload[..2], [140, 1]);
    assert!((pitch(&bench).angle - 30.0).abs() < 0.1, "{:?}", pitch(&bench));
    let data_set = ControlQuatStatusDataSet::ACTUAL_ATTITUDE | ControlQuatStatusDataSet::MODE;
    let status = bench.ask_one(&ControlQuatStatusRequest { data_set }).decoded::<ControlQuatStatus>();
    assert!((status.actual_attitude.unwrap()[1].get() - half.sin()).abs() < 1e-3);
}

#[test]
fn an_emergency_stop_turns_everything_off_and_ends_by_itself() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&in_pitch(ControlMode::ANGLE, ControlAxis::angle(Angle::from_degrees(60.0))));
    bench.run(ms(300));
    bench.board.inject(Fault::Sensor);
    bench.run(ms(100));
    assert!(!bench.board.motion().motors_on());
    let data = bench.ask_one(&RealtimeData3Request {}).decoded::<RealtimeData3>();
    let errors = SystemErrors::NO_SENSOR | SystemErrors::EMERGENCY_STOP;
    assert_eq!((data.system_error, data.system_sub_error.raw()), (errors, 11));
    assert!(data.i2c_error_count > 0);
    assert_eq!(bench.ask_one(&sbgc_proto::commands::MotorsOn {}).payload[..2], [77, 8]);
    bench.board.clear_faults();
    bench.run(ms(2500));
    assert!(bench.board.motion().motors_on());
    let data = bench.ask_one(&RealtimeData3Request {}).decoded::<RealtimeData3>();
    assert!(data.system_error.is_empty());
}

#[test]
fn an_empty_battery_raises_its_errors_and_turns_the_motors_off() {
    let mut bench = Bench::new(Config::default());
    let data = |bench: &mut Bench| bench.ask_one(&RealtimeData3Request {}).decoded::<RealtimeData3>();
    let full = data(&mut bench).bat_level;
    bench.board.inject(Fault::LowBattery);
    bench.run(ms(33_000));
    let low = data(&mut bench);
    assert!(low.bat_level < full && low.system_error == SystemErrors::LOW_BAT1, "{low:?}");
    assert!(bench.board.motion().motors_on());
    bench.run(ms(15_000));
    assert!(data(&mut bench).system_error.contains(SystemErrors::LOW_BAT2));
    assert!(!bench.board.motion().motors_on());
}
