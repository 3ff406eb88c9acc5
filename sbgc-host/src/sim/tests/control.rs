//! Motion, motors, the menu, restarts.

use sbgc_proto::commands::{
    AnglesExt, CalibAction, CalibGyro, CalibGyroSimple, CalibMode, Confirm, ConfirmData, Control,
    ControlAxis, ControlConfig, ControlConfigFlags, ControlMode, ExecuteMenu, ExecuteMenuExtended,
    ExecuteMenuFlags, GetAnglesExt, ImuCalibration, MenuCommand, MotorsOff, MotorsOn, Params3, ProfileId,
    ReadParams3, RealtimeData3, RealtimeData3Request, RealtimeData4, RealtimeData4Request,
    RealtimeDataCustom, RealtimeDataCustomFlags, RealtimeDataCustomRequest, Reset, ResetExtendedRequest,
    ResetFlags, RtDataFlags,
};
use sbgc_proto::frame::Version;
use sbgc_proto::units::{Angle, ControlRate};
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, Message};

use super::{Bench, Got, ms};
use crate::sim::Config;

fn confirmed(got: &Got) -> (CommandId, u32) {
    let confirm = got.decoded::<Confirm>();
    (confirm.cmd_id, confirm.data.value())
}

fn pitch_to(degrees: f32, speed: f32) -> Control {
    let angles = PerAxis { pitch: Angle::from_degrees(degrees), ..PerAxis::default() };
    Control::angles(angles, ControlRate::from_degrees_per_second(speed))
}

fn pitch(bench: &Bench) -> f64 {
    bench.board.motion().axes().pitch.angle
}

#[test]
fn the_camera_goes_where_it_is_told() {
    let mut bench = Bench::new(Config::default());
    assert_eq!(confirmed(&bench.ask_one(&pitch_to(45.0, 30.0))), (CommandId::Control, 0));
    let mut fastest = 0.0_f64;
    let mut before = 0.0;
    for _ in 0..300 {
        assert_eq!(bench.run(ms(8)), []);
        let axis = bench.board.motion().axes().pitch;
        assert!(axis.angle >= before && axis.angle <= 45.001, "{axis:?} after {before}");
        fastest = fastest.max(axis.speed);
        before = axis.angle;
    }
    assert!((fastest - 30.0).abs() < 0.07, "{fastest}");
    let angles = bench.ask_one(&GetAnglesExt).decoded::<AnglesExt>();
    assert_eq!(angles.axes.pitch.imu_angle, Angle::from_degrees(45.0));
    assert_eq!(angles.axes.roll.imu_angle, Angle(0));
    assert_eq!(bench.board.next_event(), None, "a board at rest has nothing to do");
}

#[test]
fn speed_takes_time_to_build_up() {
    let mut bench = Bench::new(Config::default());
    let speeds = PerAxis { yaw: ControlRate::from_degrees_per_second(-60.0), ..PerAxis::default() };
    bench.ask_one(&Control::speeds(speeds));
    bench.run(ms(92));
    let early = bench.board.motion().axes().yaw;
    assert!(early.setpoint_speed > -31.0 && early.setpoint_speed < -26.0, "{early:?}");
    assert!(early.speed > early.setpoint_speed, "the camera follows: {early:?}");
    bench.run(ms(1000));
    let later = bench.board.motion().axes().yaw;
    assert!((later.speed + 60.0).abs() < 0.07, "{later:?}");
    // Over many turns the angle on the wire starts again and the joint's goes on.
    bench.run(ms(60_000));
    let angles = bench.ask_one(&GetAnglesExt).decoded::<AnglesExt>().axes.yaw;
    assert!(angles.stator_rotor_angle.degrees() < -3600.0);
    let low_bits = (i64::from(angles.stator_rotor_angle.0) - i64::from(angles.imu_angle.0)) % 65536;
    assert_eq!(low_bits, 0);
}

#[test]
fn a_task_is_reported_within_a_degree() {
    let mut bench = Bench::new(Config::default());
    let command = pitch_to(20.0, 0.0).with_auto_task();
    assert_eq!(confirmed(&bench.ask_one(&command)), (CommandId::Control, 0));
    let mut turns = 0;
    let reached = loop {
        let got = bench.run(ms(8));
        turns += 1;
        if let [got] = &got[..] {
            break got.clone();
        }
        assert!((pitch(&bench) - 20.0).abs() > 0.9 && turns < 200, "{}", pitch(&bench));
    };
    assert_eq!(reached.decoded::<Confirm>().data, ConfirmData::U8(1));
    assert!((pitch(&bench) - 20.0).abs() <= 1.0);
    assert_eq!(bench.run(ms(500)), []);
}

#[test]
fn confirmations_can_be_turned_off_and_control_times_out() {
    let mut bench = Bench::new(Config::default());
    let config =
        ControlConfig { timeout_ms: 100, flags: ControlConfigFlags::NO_CONFIRM, ..ControlConfig::default() };
    assert_eq!(confirmed(&bench.ask_one(&config)), (CommandId::ControlConfig, 0));
    let speeds = [ControlRate::from_degrees_per_second(50.0); 3].into();
    assert_eq!(bench.ask(&Control::speeds(speeds)), []);
    bench.run(ms(90));
    assert!(bench.board.motion().axes().roll.speed > 20.0);
    bench.run(ms(400));
    assert_eq!(bench.board.motion().axes().roll.speed.to_bits(), 0);
    // 15 zero bytes undo the configuration too.
    assert_eq!(bench.ask(&Control::release()), []);
    assert_eq!(bench.ask(&Control::speeds(speeds)).len(), 1);
}

#[test]
fn modes_that_are_none_are_refused_and_ignored_axes_go_on() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&pitch_to(30.0, 0.0));
    let mut command = Control { control_mode: [ControlMode::IGNORE; 3].into(), ..Control::default() };
    bench.ask_one(&command);
    command.control_mode.roll = ControlMode(15);
    assert_eq!(bench.ask_one(&command).payload[..2], [67, 2]);
    bench.run(ms(2000));
    assert!((pitch(&bench) - 30.0).abs() < 0.01);
    // From 30 degrees the shortest way to -170 is past 180.
    let shortest = ControlMode::ANGLE_SHORTEST;
    let axis = ControlAxis::angle(Angle::from_degrees(-170.0));
    let control_mode = PerAxis { pitch: shortest, ..command.control_mode.map(|_| ControlMode::IGNORE) };
    bench.ask_one(&Control { control_mode, axes: [axis; 3].into() });
    bench.run(ms(5000));
    assert!((pitch(&bench) - 190.0).abs() < 0.01, "{}", pitch(&bench));
}

#[test]
fn remote_control_is_mapped_by_the_parameters() {
    let mut bench = Bench::new(Config::default());
    let axes = PerAxis { pitch: ControlAxis::angle(Angle(250)), ..PerAxis::default() };
    bench.ask_one(&Control { control_mode: [ControlMode::RC; 3].into(), axes });
    bench.run(ms(3000));
    assert!((pitch(&bench) - 45.0).abs() < 0.01, "{}", pitch(&bench));
}

#[test]
fn without_motors_the_camera_stays_where_it_has_come_to_rest() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&pitch_to(60.0, 0.0));
    bench.run(ms(300));
    assert_eq!(confirmed(&bench.ask_one(&MotorsOff::default())), (CommandId::MotorsOff, 0));
    bench.run(ms(3000));
    let hangs = pitch(&bench);
    assert!(hangs > 1.0 && hangs < 59.0);
    bench.run(ms(1000));
    assert_eq!(pitch(&bench).to_bits(), hangs.to_bits());
    let flags = bench.ask_one(&RealtimeData3Request).decoded::<RealtimeData3>().rt_data_flags;
    assert!(!flags.contains(RtDataFlags::MOTORS_ON));
    bench.ask_one(&MotorsOn);
    bench.run(ms(3000));
    assert!((pitch(&bench) - 60.0).abs() < 0.01);
}

#[test]
fn a_board_with_two_axes_has_no_yaw() {
    let mut bench = Bench::new(Config { axes: 2, ..Config::default() });
    let command = Control::angles([Angle::from_degrees(10.0); 3].into(), ControlRate(0)).with_auto_task();
    bench.ask_one(&command);
    assert_eq!(bench.run(ms(2000)).len(), 1);
    let axes = bench.board.motion().axes();
    assert!(axes.roll.angle > 9.0 && axes.pitch.angle > 9.0 && axes.yaw.angle == 0.0);
}

#[test]
fn the_menu_is_carried_out() {
    let mut bench = Bench::new(Config::default());
    let menu = |command| ExecuteMenu { cmd_id: command };
    assert_eq!(confirmed(&bench.ask_one(&menu(MenuCommand::No))), (CommandId::ExecuteMenu, 0));
    bench.ask_one(&menu(MenuCommand::Profile3));
    let block = bench.ask_one(&ReadParams3 { profile_id: ProfileId::Current });
    assert_eq!(block.decoded::<Params3>().profile_id, ProfileId::Profile3);
    bench.ask_one(&menu(MenuCommand::MotorToggle));
    assert!(!bench.board.motion().motors_on());
    bench.ask_one(&menu(MenuCommand::MotorToggle));

    // A task goes before a command, and says when it is done.
    bench.ask_one(&pitch_to(-30.0, 0.0));
    let flags = ExecuteMenuFlags::CONFIRM_ON_FINISH;
    assert_eq!(bench.ask(&ExecuteMenuExtended { cmd_id: MenuCommand::LookDown, flags }), []);
    bench.ask_one(&pitch_to(-30.0, 0.0));
    let mut got = Vec::new();
    while got.is_empty() {
        got = bench.run(ms(8));
    }
    assert_eq!(confirmed(&got[0]), (CommandId::ExecuteMenu, 0));
    assert!((pitch(&bench) - 90.0).abs() <= 1.0);
    // Then the command is in force again.
    bench.run(ms(4000));
    assert!((pitch(&bench) + 30.0).abs() < 0.01);
}

#[test]
fn a_reset_forgets_and_unlocks() {
    let mut bench = Bench::new(Config::default());
    bench.version = Version::V2;
    bench.ask_one(&pitch_to(60.0, 0.0));
    bench.run(ms(300));
    let request = ResetExtendedRequest { flags: ResetFlags::CONFIRM, delay_ms: 500 };
    let notice = bench.ask_one(&request);
    assert_eq!((notice.id, notice.version), (Reset::ID.raw(), Version::V2));
    bench.run(ms(480));
    assert_eq!(bench.board.resets(), 0);
    bench.run(ms(30));
    assert_eq!(bench.board.resets(), 1);
    bench.version = Version::V1;
    assert_eq!(bench.ask(&RealtimeData3Request), [], "a board that starts is deaf");
    bench.run(ms(500));
    assert_eq!(bench.ask_one(&RealtimeData3Request).version, Version::V1);
    bench.run(ms(2000));
    assert_eq!(pitch(&bench).to_bits(), 0.0_f64.to_bits(), "it has taken the position of a start");
}

#[test]
fn chosen_data_is_what_was_chosen_or_an_error() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&pitch_to(90.0, 0.0));
    bench.run(ms(4000));
    let flags = RealtimeDataCustomFlags::IMU_ANGLES
        | RealtimeDataCustomFlags::Z_VECTOR_H_VECTOR
        | RealtimeDataCustomFlags::INCLUDE_FLAGS;
    let got = bench.ask_one(&RealtimeDataCustomRequest::new(flags).unwrap());
    let (data, rest) = RealtimeDataCustom::decode_with(&got.payload, flags).unwrap();
    assert!(rest.is_empty());
    assert_eq!(data.imu_angles.unwrap().pitch, Angle(4096));
    assert!((data.z_vector.unwrap().y.get() - 1.0).abs() < 1e-6, "{data:?}");
    // What does not fit one message is refused.
    let flags = RealtimeDataCustomFlags::all();
    let refused = RealtimeDataCustomRequest { flags, ..RealtimeDataCustomRequest::default() };
    assert_eq!(bench.ask_one(&refused).payload[..2], [88, 2]);
}

#[test]
fn a_calibration_takes_its_time() {
    let mut bench = Bench::new(Config::default());
    let request = CalibGyro(ImuCalibration { action: CalibAction::Regular, ..ImuCalibration::default() });
    assert_eq!(confirmed(&bench.ask_one(&request)), (CommandId::CalibGyro, 0));
    assert_eq!(bench.ask_one(&request).payload[..2], [103, 8]);
    let mode = bench.ask_one(&RealtimeData4Request).decoded::<RealtimeData4>().calib_mode;
    assert_eq!(mode, CalibMode::Gyro);
    assert_eq!(bench.run(ms(3900)), []);
    assert_eq!(confirmed(&bench.run(ms(100))[0]), (CommandId::CalibGyro, 0));
    assert_eq!(bench.ask(&CalibGyroSimple {}).len(), 1);
    assert_eq!(confirmed(&bench.run(ms(10_000))[0]), (CommandId::CalibGyro, 0));
    assert_eq!(bench.board.next_event(), None);
}
