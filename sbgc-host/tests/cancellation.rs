//! Cancellation at every await: each future of the public interface is dropped after its first poll, after its second,
//! and so on until it is done, and nothing may be left of it: no stream on the board, no motion whose owner is gone, no
//! claim, nothing that keeps a later request waiting.
#![cfg(all(feature = "params", feature = "sim"))]

use std::fmt::Debug;
use std::pin::pin;
use std::task::Poll;
use std::time::Duration;

use bytes::Bytes;
use sbgc_host::calibrate::{Calibration, CalibrationRun, CalibrationState, Tuning};
use sbgc_host::params::{Parameters, Profile};
use sbgc_host::proto::CommandId;
use sbgc_host::proto::commands::{
    CalibAction, CalibImu, Control, EventId, FileId, FileType, ImuIndex, MenuCommand, MotorsOffMode,
    ProfileId, ReadParams3, RealtimeData4, RealtimeDataCustomFlags,
};
use sbgc_host::proto::units::{Angle, ControlRate};
use sbgc_host::proto::wire::PerAxis;
use sbgc_host::sim::{self, Config, SharedBoard};
use sbgc_host::streams::Item;
use sbgc_host::{ControlSession, Gimbal, Options, SessionOptions, Setpoint};
use tokio::time::{sleep, timeout};

const MS: fn(u64) -> Duration = Duration::from_millis;

/// After how many polls a future is dropped, and whether at once or when it would be polled again.
#[derive(Clone, Copy, Debug)]
struct Cut {
    polls: usize,
    at_once: bool,
}

/// Polls a future until the cut; `None` if that came before its end.
async fn until<T>(cut: Cut, future: impl Future<Output = T>) -> Option<T> {
    let mut future = pin!(future);
    let mut left = cut.polls;
    std::future::poll_fn(|context| {
        if left == 0 {
            return Poll::Ready(None);
        }
        left -= 1;
        match future.as_mut().poll(context) {
            Poll::Ready(output) => Poll::Ready(Some(output)),
            Poll::Pending if left == 0 && cut.at_once => Poll::Ready(None),
            Poll::Pending => Poll::Pending,
        }
    })
    .await
}

/// What a future may leave to the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Leaves {
    /// Nothing: what moves has an owner.
    Nothing,
    /// A motion that the board completes.
    Motion,
}

/// Drops the future of `work` after each of its polls.
async fn cut_everywhere<T: Debug>(leaves: Leaves, work: impl AsyncFn(&Gimbal) -> sbgc_host::Result<T>) {
    for at_once in [true, false] {
        let mut polls = 1;
        loop {
            let cut = Cut { polls, at_once };
            let (board, line) = sim::simulate(Config::default());
            let gimbal = Gimbal::spawn(line, Options::default());
            gimbal.handshake().await.unwrap();
            let outcome = until(cut, work(&gimbal)).await;
            nothing_is_left(&gimbal, &board, leaves, cut).await;
            if let Some(outcome) = outcome {
                outcome.unwrap_or_else(|error| panic!("{cut:?}: {error}"));
                break;
            }
            // What takes long is cut ever more coarsely; the first polls are where things begin.
            polls += 1 + polls / 40;
        }
        assert!(polls > 1, "nothing was waited for");
    }
}

/// What must hold however somebody has given up.
async fn nothing_is_left(gimbal: &Gimbal, board: &SharedBoard, leaves: Leaves, cut: Cut) {
    let answers = timeout(Duration::from_secs(3), gimbal.board_info()).await;
    assert!(matches!(answers, Ok(Ok(_))), "{cut:?}: a later request got {answers:?}");
    let confirms = timeout(Duration::from_secs(3), gimbal.execute_menu(MenuCommand::No)).await;
    assert!(matches!(confirms, Ok(Ok(()))), "{cut:?}: a later command got {confirms:?}");
    // What ends it is on its way, and a sensor is calibrated to the end; then everything is quiet.
    sleep(Duration::from_secs(15)).await;
    let speeds = board.with(|board| board.motion().axes().map(|axis| axis.speed).into_array());
    let stands = speeds.iter().all(|speed| *speed == 0.0);
    assert!(stands || leaves == Leaves::Motion, "{cut:?}: it moves without an owner, {speeds:?}");
    let sent = gimbal.counters().sent_frames;
    let samples = board.with(|board| board.counters().sent);
    sleep(Duration::from_secs(4)).await;
    if leaves == Leaves::Nothing {
        assert_eq!(board.with(|board| board.counters().sent), samples, "{cut:?}: a stream goes on");
    }
    assert_eq!(gimbal.counters().sent_frames, sent, "{cut:?}: something goes on sending");
    let session =
        timeout(Duration::from_secs(3), ControlSession::start(gimbal, SessionOptions::default())).await;
    let session = session.unwrap_or_else(|_| panic!("{cut:?}: no session in time"));
    session.unwrap_or_else(|error| panic!("{cut:?}: {error}")).stop().await.unwrap();
    let counters = board.with(|board| board.counters());
    assert_eq!((counters.skipped_bytes, counters.lost), (0, 0), "{cut:?}: the board got what it cannot use");
    assert!(timeout(Duration::from_secs(2), gimbal.clone().close()).await.is_ok(), "{cut:?}: closing hangs");
}

fn yaw(speed: f32) -> Setpoint {
    Setpoint::speeds(PerAxis { yaw: Some(speed), ..PerAxis::default() }).unwrap()
}

fn pitch(degrees: f32) -> Setpoint {
    Setpoint::angles(PerAxis { pitch: Some(degrees), ..PerAxis::default() }, Some(20.0)).unwrap()
}

#[tokio::test(start_paused = true)]
async fn requests() {
    cut_everywhere(Leaves::Nothing, async |gimbal| gimbal.angles_ext().await).await;
    let raw = async |gimbal: &Gimbal| {
        gimbal.request_raw(CommandId::GetAngles, Bytes::new(), CommandId::GetAngles).await
    };
    cut_everywhere(Leaves::Nothing, raw).await;
    let exchange =
        async |gimbal: &Gimbal| gimbal.exchange(&ReadParams3 { profile_id: ProfileId::Current }).await;
    cut_everywhere(Leaves::Nothing, exchange).await;
    cut_everywhere(Leaves::Nothing, async |gimbal| gimbal.handshake().await).await;
}

#[tokio::test(start_paused = true)]
async fn commands() {
    cut_everywhere(Leaves::Nothing, async |gimbal| gimbal.motors_on().await).await;
    let off_and_on = async |gimbal: &Gimbal| {
        gimbal.motors_off(MotorsOffMode::Normal).await?;
        gimbal.motors_on().await
    };
    cut_everywhere(Leaves::Nothing, off_and_on).await;
    let many = async |gimbal: &Gimbal| {
        for _ in 0..80 {
            gimbal.send_raw(CommandId::BeepSound, vec![0; 60].into()).await?;
        }
        gimbal.board_info().await
    };
    cut_everywhere(Leaves::Nothing, many).await;
}

#[tokio::test(start_paused = true)]
async fn streams() {
    let typed = async |gimbal: &Gimbal| {
        let mut samples = gimbal.stream::<RealtimeData4>(MS(20)).await?;
        for _ in 0..5 {
            assert!(matches!(samples.next().await, Some(Item::Message(_))));
        }
        Ok(())
    };
    cut_everywhere(Leaves::Nothing, typed).await;
    let several = async |gimbal: &Gimbal| {
        let flags = RealtimeDataCustomFlags::IMU_ANGLES;
        let (first, second) =
            tokio::join!(gimbal.stream_custom(flags, MS(50)), gimbal.stream_custom(flags, MS(50)));
        let (mut first, _second) = (first?, second?);
        let _attitude = gimbal.ahrs(ImuIndex::Main, MS(100)).await?;
        let _events = gimbal.events(&[EventId::MotorState]).await?;
        assert!(matches!(first.next().await, Some(Item::Message(_))));
        Ok(())
    };
    cut_everywhere(Leaves::Nothing, several).await;
}

#[tokio::test(start_paused = true)]
async fn control_sessions() {
    for confirmations in [false, true] {
        let options = SessionOptions { confirmations, interval: MS(100), ..SessionOptions::default() };
        let session = async |gimbal: &Gimbal| {
            let session = ControlSession::start(gimbal, options).await?;
            session.set(yaw(30.0))?;
            sleep(MS(300)).await;
            session.apply(yaw(-30.0)).await?;
            session.move_to(pitch(-10.0), Duration::from_secs(10)).await?;
            session.stop().await
        };
        cut_everywhere(Leaves::Nothing, session).await;
        let held = async |gimbal: &Gimbal| {
            let session = ControlSession::start(gimbal, options).await?;
            session.move_to(pitch(10.0), Duration::from_secs(10)).await?;
            session.hold().await
        };
        cut_everywhere(Leaves::Nothing, held).await;
    }
}

#[tokio::test(start_paused = true)]
async fn moves_that_are_left_to_the_board() {
    let rate = ControlRate::from_degrees_per_second(30.0);
    let target = PerAxis { yaw: Some(Angle::from_degrees(20.0)), ..PerAxis::default() };
    let moved = async |gimbal: &Gimbal| gimbal.move_to(target, rate, Duration::from_secs(10)).await;
    cut_everywhere(Leaves::Motion, moved).await;
    let confirmed = async |gimbal: &Gimbal| gimbal.confirm(&Control::some_angles(target, rate)).await;
    cut_everywhere(Leaves::Motion, confirmed).await;
    let handed_over = async |gimbal: &Gimbal| {
        let firmware = gimbal.board_info().await?.firmware_ver;
        gimbal.hand_over(pitch(5.0), firmware).await
    };
    cut_everywhere(Leaves::Motion, handed_over).await;
}

#[tokio::test(start_paused = true)]
async fn calibrations() {
    let gyroscope = Calibration::Gyroscope(CalibImu::Main, CalibAction::Regular);
    for calibration in [gyroscope, Calibration::Poles, Calibration::Tuning(Tuning::default())] {
        let run = async |gimbal: &Gimbal| {
            let mut run = CalibrationRun::start(gimbal, calibration).await?;
            loop {
                let step = run.next().await?;
                match step.state {
                    CalibrationState::Done => return Ok(()),
                    CalibrationState::Failed => panic!("{step:?}"),
                    _ => {}
                }
            }
        };
        cut_everywhere(Leaves::Nothing, run).await;
    }
    let given_up = async |gimbal: &Gimbal| {
        let mut run = CalibrationRun::start(gimbal, Calibration::Poles).await?;
        run.next().await?;
        run.cancel().await
    };
    cut_everywhere(Leaves::Nothing, given_up).await;
}

#[tokio::test(start_paused = true)]
async fn storage() {
    let eeprom = async |gimbal: &Gimbal| {
        gimbal.eeprom_write(1024, &[7; 192], |_, _| {}).await?;
        gimbal.eeprom_read(1024, 192, |_, _| {}).await
    };
    cut_everywhere(Leaves::Nothing, eeprom).await;
    let file = FileId::new(FileType::Script, 3);
    let files = async |gimbal: &Gimbal| {
        gimbal.file_write(file, &[5; 500], |_, _| {}).await?;
        assert_eq!(gimbal.file_read(file, |_, _| {}).await?, [5; 500]);
        gimbal.file_delete(file).await
    };
    cut_everywhere(Leaves::Nothing, files).await;
    let user = async |gimbal: &Gimbal| {
        gimbal.set_user_data([3; 128]).await?;
        gimbal.user_data().await
    };
    cut_everywhere(Leaves::Nothing, user).await;
}

#[tokio::test(start_paused = true)]
async fn parameters() {
    let profile = Profile::from_number(2).unwrap();
    let write = async |gimbal: &Gimbal| {
        let parameters = Parameters::new(gimbal.clone(), gimbal.board_info().await?);
        let before = parameters.read(profile).await.unwrap();
        let mut after = before.clone();
        let catalog = parameters.catalog();
        for (name, value) in [("rc_memory.yaw", "45deg"), ("auto_speed", "40")] {
            let parameter = catalog.one(name).unwrap();
            after.set(parameter, &parameter.parse(value).unwrap());
        }
        let mut plan = parameters.plan();
        plan.change(Some(profile), &before, &after);
        parameters.write(&plan, |_| {}).await.unwrap();
        Ok(())
    };
    cut_everywhere(Leaves::Nothing, write).await;
}
