//! What shapes motion: limits, filters, and tasks that go before commands.

use sbgc_proto::commands::{
    Control, ControlAxis, ControlConfig, ControlConfigFlags, ControlMode, ControlQuat, ControlQuatConfig,
    ControlQuatConfigDataSet, ControlQuatFlags, ExecuteMenu, MenuCommand, MotorsOff, MotorsOffMode,
    ParamsExt2, ProfileId, ReadParamsExt2, WriteParamsExt2,
};
use sbgc_proto::units::{Angle, ControlRate, ControlRateLimit, FirmwareVersion, JerkSlope};
use sbgc_proto::wire::PerAxis;

use super::{Bench, ms};
use crate::sim::{Axis, Config, POLL};

fn change_2(bench: &mut Bench, change: impl FnOnce(&mut ParamsExt2)) {
    let mut block = bench.ask_one(&ReadParamsExt2 { profile_id: ProfileId::Current }).decoded::<ParamsExt2>();
    change(&mut block);
    bench.ask(&WriteParamsExt2(block));
}

fn yaw(bench: &Bench) -> Axis {
    bench.board.motion().axes().yaw
}

fn in_yaw(mode: ControlMode, axis: ControlAxis) -> Control {
    let control_mode = PerAxis { yaw: mode, ..[ControlMode::NO_CONTROL; 3].into() };
    Control { control_mode, axes: PerAxis { yaw: axis, ..PerAxis::default() } }
}

fn speed(degrees: f32) -> Control {
    in_yaw(ControlMode::SPEED, ControlAxis::speed(ControlRate::from_degrees_per_second(degrees)))
}

fn angle(degrees: f32) -> Control {
    in_yaw(ControlMode::ANGLE, ControlAxis::angle(Angle::from_degrees(degrees)))
}

/// Maximum acceleration of a recorded motion up to just before its end, and its maximum change per second.
fn peaks(bench: &Bench, end: f64) -> (f64, f64) {
    let moments = bench.board.motion().recorded().iter();
    let on_the_way = moments.take_while(|moment| (moment.angles.yaw - end).abs() > 0.01);
    let speeds: Vec<f64> = on_the_way.map(|moment| moment.speeds.yaw).collect();
    let slope =
        |values: &[f64]| -> Vec<f64> { values.windows(2).map(|pair| (pair[1] - pair[0]) / 0.0008).collect() };
    let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
    let accelerations = slope(&speeds);
    (peak(&accelerations), peak(&slope(&accelerations)))
}

#[test]
fn accelerations_build_up_and_the_axis_still_arrives_without_overshoot() {
    for way in [3.0, 40.0, 170.0_f32] {
        for slope in [0, 100, 250] {
            let mut bench = Bench::new(Config::default());
            change_2(&mut bench, |params| params.jerk_slope.yaw = slope);
            bench.board.record_motion(true);
            bench.ask_one(&angle(way));
            bench.run(ms(8000));
            let moments = bench.board.motion().recorded();
            let furthest = moments.iter().map(|moment| moment.angles.yaw).fold(0.0, f64::max);
            let end = f64::from(Angle::from_degrees(way).degrees());
            assert!((yaw(&bench).angle - end).abs() < 0.01, "{way} {slope}: {:?}", yaw(&bench));
            assert!(furthest < end + 0.1, "{way} {slope}: {furthest}");
            if slope > 0 {
                let (acceleration, jerk) = peaks(&bench, end);
                assert!(acceleration < 305.0, "{way} {slope}: {acceleration}");
                // 300 degrees per second squared in that time, twice as much at the joints of the curve.
                let expected = 300.0 / (f64::from(slope) / 1000.0);
                assert!(jerk < 2.5 * expected, "{way} {slope}: {jerk} instead of {expected}");
            }
        }
    }
}

#[test]
fn the_slope_of_control_goes_before_that_of_the_parameters() {
    let reached = |slope: JerkSlope, firmware| {
        let mut bench = Bench::new(Config { firmware, ..Config::default() });
        change_2(&mut bench, |params| params.jerk_slope.yaw = 100);
        let mut config = ControlConfig::default();
        config.axes.yaw.jerk_slope = slope;
        bench.ask_one(&config);
        bench.ask_one(&speed(60.0));
        bench.run(ms(120));
        yaw(&bench).setpoint_speed
    };
    let new = FirmwareVersion::new(2, 73, 5);
    let own = reached(JerkSlope::UNCHANGED, new);
    assert!(reached(JerkSlope::OFF, new) > own * 1.3);
    assert!(reached(JerkSlope::from_milliseconds(400.0), new) < own / 2.0);
    let old = reached(JerkSlope::OFF, FirmwareVersion::new(2, 68, 9));
    assert!((old - own).abs() < 0.1, "these bytes came later: {old} {own}");
}

#[test]
fn the_strongest_filter_takes_seconds_and_not_minutes() {
    for (speed_lpf, flags, half) in [
        (15, ControlConfigFlags::empty(), ms(1248)),
        (255, ControlConfigFlags::LPF_EXT_RANGE, ms(1248)),
        (1, ControlConfigFlags::LPF_FREQUENCY_HZ, ms(110)),
    ] {
        let mut bench = Bench::new(Config::default());
        change_2(&mut bench, |params| params.acc_limiter.yaw.0 = 0);
        let mut config = ControlConfig { flags, ..ControlConfig::default() };
        config.axes.yaw.speed_lpf = speed_lpf;
        bench.ask_one(&config);
        bench.ask_one(&speed(40.0));
        bench.run(half);
        let halfway = yaw(&bench).setpoint_speed;
        assert!((halfway - 20.0).abs() < 1.5, "{speed_lpf}: {halfway}");
        bench.run(ms(20_000));
        assert!((yaw(&bench).setpoint_speed - 40.0).abs() < 0.1);
    }
}

#[test]
fn control_by_quaternion_has_a_motion_profile_of_its_own() {
    let reached = |config: Option<ControlQuatConfig>| {
        let mut bench = Bench::new(Config::default());
        if let Some(config) = config {
            bench.ask_one(&config);
        }
        let half = 40.0_f32.to_radians();
        let turned = [half.cos(), 0.0, 0.0, half.sin()];
        bench.ask_one(&ControlQuat::attitude(turned, ControlQuatFlags::CONFIRM));
        bench.run(ms(1000));
        let way = yaw(&bench).angle;
        bench.run(ms(20_000));
        assert!((yaw(&bench).angle - 80.0).abs() < 0.1, "{:?}", yaw(&bench));
        way
    };
    let own = reached(None);
    assert!(own > 40.0);
    let gentle = ControlQuatConfig {
        data_set: ControlQuatConfigDataSet::ACC_LIMIT,
        acc_limit: Some([10; 3].into()),
        ..ControlQuatConfig::default()
    };
    let way = reached(Some(gentle));
    assert!((way - 5.0).abs() < 0.5, "half of 10 degrees per second squared, in a second: {way}");
}

#[test]
fn control_by_quaternion_filters_the_attitude_where_that_is_configured() {
    for (frequency, expected) in [(None, 40.0), (Some(0), 40.0), (Some(1), 20.0)] {
        let mut bench = Bench::new(Config::default());
        let mut data_set = ControlQuatConfigDataSet::MAX_SPEED | ControlQuatConfigDataSet::ACC_LIMIT;
        data_set.set(ControlQuatConfigDataSet::ATTITUDE_LPF_FREQ, frequency.is_some());
        bench.ask_one(&ControlQuatConfig {
            data_set,
            max_speed: Some([ControlRateLimit::from_degrees_per_second(4000.0); 3].into()),
            acc_limit: Some([0; 3].into()),
            attitude_lpf_freq: frequency,
            ..ControlQuatConfig::default()
        });
        let half = 20.0_f32.to_radians();
        let turned = [half.cos(), 0.0, 0.0, half.sin()];
        bench.ask_one(&ControlQuat::attitude(turned, ControlQuatFlags::CONFIRM));
        // 1 / (2 π) seconds times the logarithm of 2.
        bench.run(ms(110));
        let way = yaw(&bench).setpoint;
        assert!((way - expected).abs() < 2.0, "{frequency:?}: {way}");
    }
}

#[test]
fn an_axis_stays_where_the_last_task_led_it() {
    let mut bench = Bench::new(Config::default());
    for (command, pitch) in
        [(MenuCommand::LookDown, 90.0), (MenuCommand::HomePosition, 0.0), (MenuCommand::LookDown, 90.0)]
    {
        bench.ask_one(&ExecuteMenu { cmd_id: command });
        bench.run(ms(10_000));
        let stands = bench.board.motion().axes().pitch.angle;
        assert!((stands - pitch).abs() < 0.1, "{command:?}: {stands}");
    }
}

#[test]
fn a_command_goes_on_when_the_task_before_it_is_done() {
    let mut bench = Bench::new(Config::default());
    bench.ask_one(&angle(50.0));
    bench.run(ms(3000));
    bench.ask_one(&ExecuteMenu { cmd_id: MenuCommand::CenterYaw });
    bench.run(ms(600));
    assert!(yaw(&bench).angle < 40.0);
    bench.ask_one(&angle(50.0));
    let moments =
        |bench: &Bench| bench.board.motion().recorded().iter().map(|at| at.angles.yaw).fold(50.0, f64::min);
    bench.board.record_motion(true);
    bench.run(ms(8000));
    assert!(moments(&bench) < 1.0, "the task overrides the command until it is done");
    assert!((yaw(&bench).angle - 50.0).abs() < 0.1, "then the command holds again: {:?}", yaw(&bench));
}

#[test]
fn without_motors_the_camera_coasts_to_rest_unless_they_brake_it() {
    for (mode, least, most) in [
        (MotorsOffMode::Normal, 5.0, 30.0),
        (MotorsOffMode::Brake, 0.0, 0.5),
        (MotorsOffMode::SafeStop, 1.0, 30.0),
    ] {
        let mut bench = Bench::new(Config::default());
        bench.ask_one(&speed(50.0));
        bench.run(ms(1000));
        let start = yaw(&bench).angle;
        bench.send(&MotorsOff { mode });
        bench.run(POLL);
        let at_once = yaw(&bench).angle;
        bench.run(ms(5000));
        assert!(!bench.board.motion().motors_on());
        let way = yaw(&bench).angle - start;
        assert!(at_once < start + 1.0 && yaw(&bench).speed.to_bits() == 0, "{mode:?}: {:?}", yaw(&bench));
        assert!(way >= least && way < most, "{mode:?}: {way}");
    }
}
