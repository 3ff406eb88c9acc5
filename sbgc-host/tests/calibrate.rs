//! Calibrations against the simulated board: progress, outcome, what they need, and giving up.
#![cfg(feature = "sim")]

mod support;

use std::time::Duration;

use sbgc_host::calibrate::{BodeTest, Calibration, CalibrationRun, CalibrationState, Step, Tuning};
use sbgc_host::proto::commands::{
    Axis, CalibAction, CalibImu, CalibMode, CoggingAxes, MotorsOffMode, RealtimeData3, RealtimeData4,
    RealtimeData4Request, RtDataFlags,
};
use sbgc_host::proto::units::{Angle, ControlRate};
use sbgc_host::proto::wire::PerAxis;
use sbgc_host::proto::{CommandId, Message};
use sbgc_host::sim::{self, Config};
use sbgc_host::{ControlSession, Error, Gimbal, Options, SessionOptions};

fn gimbal() -> Gimbal {
    Gimbal::spawn(sim::in_process(Config::default()), Options::default())
}

/// All steps up to the last one.
async fn finish(mut run: CalibrationRun) -> Vec<Step> {
    let mut steps = Vec::new();
    loop {
        let step = run.next().await.unwrap();
        let ended = matches!(step.state, CalibrationState::Done | CalibrationState::Failed);
        steps.push(step);
        if ended {
            return steps;
        }
    }
}

async fn calibrate(gimbal: &Gimbal, calibration: Calibration) -> Step {
    let run = CalibrationRun::start(gimbal, calibration).await.unwrap();
    let steps = finish(run).await;
    assert_eq!(steps[0].state, CalibrationState::Waiting);
    steps.last().unwrap().clone()
}

async fn mode(gimbal: &Gimbal) -> CalibMode {
    gimbal.request(&RealtimeData4Request {}).await.unwrap().calib_mode
}

const GYRO: Calibration = Calibration::Gyroscope(CalibImu::Main, CalibAction::Regular);

#[tokio::test(start_paused = true)]
async fn sensors_report_their_progress() {
    let gimbal = gimbal();
    let steps = finish(CalibrationRun::start(&gimbal, GYRO).await.unwrap()).await;
    let last = steps.last().unwrap();
    assert_eq!((last.state, last.progress), (CalibrationState::Done, Some(1.0)), "{last:?}");
    let running: Vec<f32> = steps.iter().filter_map(|step| step.progress).collect();
    assert!(running.len() > 8 && running.is_sorted(), "{running:?}");
    assert!(steps.iter().any(|step| step.message.starts_with("movement ")), "{steps:?}");
}

#[tokio::test(start_paused = true)]
async fn each_kind_ends() {
    let gimbal = gimbal();
    for calibration in [
        Calibration::Accelerometer(CalibImu::Main, CalibAction::Regular),
        Calibration::Magnetometer(CalibImu::Main, CalibAction::Regular),
        Calibration::Poles,
        Calibration::Battery(15.5),
        Calibration::FollowOffset,
        Calibration::ExternalGain,
        Calibration::EncoderOffset,
        Calibration::EncoderField,
        Calibration::ExternalReference([0.0, 0.0, 1.0]),
        Calibration::Cogging(CoggingAxes::YAW),
        Calibration::Tuning(Tuning::default()),
        Calibration::Bode(BodeTest { axis: Axis::Pitch, gain: 10, samples: 5000, frequencies: (3, 50) }),
    ] {
        let last = calibrate(&gimbal, calibration).await;
        assert_eq!(last.state, CalibrationState::Done, "{calibration:?}: {last:?}");
        assert_eq!(mode(&gimbal).await, CalibMode::None, "{calibration:?} has not ended yet");
        assert!(!calibration.preparation().is_empty());
    }
}

#[tokio::test(start_paused = true)]
async fn results_are_on_the_board() {
    let gimbal = gimbal();
    let target = PerAxis { yaw: Some(Angle::from_degrees(20.0)), ..PerAxis::default() };
    gimbal.move_to(target, ControlRate::default(), Duration::from_secs(20)).await.unwrap();
    calibrate(&gimbal, Calibration::FollowOffset).await;
    assert_eq!(gimbal.params3(255.into()).await.unwrap().follow_offset.yaw, 20);
    calibrate(&gimbal, Calibration::Poles).await;
    assert_eq!(gimbal.params3(255.into()).await.unwrap().motors.roll.poles, 22);
}

#[tokio::test(start_paused = true)]
async fn motors_are_checked() {
    let gimbal = gimbal();
    let wrong = CalibrationRun::start(&gimbal, Calibration::Orientation).await.unwrap_err();
    assert!(matches!(wrong, Error::MotorsMustBe { on: false }), "{wrong}");
    gimbal.motors_off(MotorsOffMode::Normal).await.unwrap();
    let last = calibrate(&gimbal, Calibration::Orientation).await;
    assert_eq!(last.state, CalibrationState::Done, "{last:?}");
    let wrong = CalibrationRun::start(&gimbal, Calibration::Poles).await.unwrap_err();
    assert!(matches!(wrong, Error::MotorsMustBe { on: true }), "{wrong}");
}

#[tokio::test(start_paused = true)]
async fn what_is_refused_or_not_met_fails() {
    let gimbal = gimbal();
    let voltage = CalibrationRun::start(&gimbal, Calibration::Battery(f32::NAN)).await.unwrap_err();
    assert!(matches!(voltage, Error::OutOfRange { unit: "V", .. }), "{voltage}");
    let far = CalibrationRun::start(&gimbal, Calibration::Battery(99.0)).await.unwrap_err();
    assert!(matches!(far, Error::Refused { .. }), "{far}");
    let began = tokio::time::Instant::now();
    let tilted = calibrate(&gimbal, Calibration::ExternalReference([1.0, 0.0, 0.0])).await;
    assert_eq!(tilted.state, CalibrationState::Failed, "{tilted:?}");
    assert!(began.elapsed() < Duration::from_secs(10));
}

#[tokio::test(start_paused = true)]
async fn what_was_refused_is_not_stopped() {
    let (gimbal, mut board) = support::gimbal();
    let (outcome, ()) =
        tokio::join!(CalibrationRun::start(&gimbal, Calibration::Cogging(CoggingAxes::YAW)), async {
            board.expect(support::BOARD_INFO).await;
            board.send(support::BOARD_INFO, &support::board_info(2730)).await;
            let state = board.expect(support::REALTIME_4).await;
            // The motors are on.
            let flags = RealtimeData3 { rt_data_flags: RtDataFlags::MOTORS_ON, ..RealtimeData3::default() };
            let data = RealtimeData4 { realtime_data_3: flags, ..RealtimeData4::default() };
            board.send(state.id, data.encode(&mut [0; 255]).unwrap()).await;
            let command = board.next().await;
            board.send(255, &[command.id, 1]).await;
        });
    assert!(matches!(outcome, Err(Error::Refused { code: 1, .. })), "{outcome:?}");
    assert!(board.is_quiet(Duration::from_secs(3)).await, "nothing switches the motors off");
}

#[tokio::test(start_paused = true)]
async fn nobody_controls_the_gimbal_meanwhile() {
    let gimbal = gimbal();
    let run = CalibrationRun::start(&gimbal, GYRO).await.unwrap();
    let session = ControlSession::start(&gimbal, SessionOptions::default()).await;
    assert!(matches!(session, Err(Error::ControlInUse)));
    finish(run).await;
    let session = ControlSession::start(&gimbal, SessionOptions::default()).await.unwrap();
    let run = CalibrationRun::start(&gimbal, GYRO).await;
    assert!(matches!(run, Err(Error::ControlInUse)));
    session.stop().await.unwrap();
}

#[tokio::test(start_paused = true)]
async fn giving_up_stops_what_moves() {
    let gimbal = gimbal();
    // Tuning has a command of its own; both ways.
    for cancelled in [true, false] {
        let mut run = CalibrationRun::start(&gimbal, Calibration::Tuning(Tuning::default())).await.unwrap();
        run.next().await.unwrap();
        tokio::time::sleep(Duration::from_secs(1)).await;
        assert_eq!(mode(&gimbal).await, CalibMode::AutoPid);
        if cancelled {
            run.cancel().await.unwrap();
        } else {
            drop(run);
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
        let before = gimbal.params3(255.into()).await.unwrap();
        tokio::time::sleep(Duration::from_secs(20)).await;
        assert_eq!(gimbal.params3(255.into()).await.unwrap(), before, "it did not go on");
    }
    // Others stop with the motors.
    let run = CalibrationRun::start(&gimbal, Calibration::Poles).await.unwrap();
    drop(run);
    tokio::time::sleep(Duration::from_secs(3)).await;
    let flags = gimbal.request(&RealtimeData4Request {}).await.unwrap().realtime_data_3.rt_data_flags;
    assert!(!flags.contains(RtDataFlags::MOTORS_ON));
    // What holds still is left to end.
    gimbal.motors_on().await.unwrap();
    let run = CalibrationRun::start(&gimbal, GYRO).await.unwrap();
    run.cancel().await.unwrap();
    let mut sent = gimbal.listen(CommandId::CONFIRM);
    assert!(sent.next().await.is_some(), "the second confirmation still comes");
}

#[tokio::test(start_paused = true)]
async fn a_board_that_goes_away_ends_the_run() {
    let gimbal = gimbal();
    let mut run = CalibrationRun::start(&gimbal, GYRO).await.unwrap();
    run.next().await.unwrap();
    gimbal.clone().close().await;
    let mut outcome = run.next().await;
    while outcome.is_ok() {
        outcome = run.next().await;
    }
    assert!(matches!(outcome, Err(Error::Closed)), "{outcome:?}");
}
