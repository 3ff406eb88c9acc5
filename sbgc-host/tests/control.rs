//! Control with an owner: what is sent meanwhile, and that the gimbal stops however the owner ends.
#![cfg(feature = "sim")]

mod support;

use std::sync::{Arc, Mutex};
use std::time::Duration;

use bytes::BytesMut;
use sbgc_host::proto::Message;
use sbgc_host::proto::commands::{Control, ControlConfig, ControlConfigFlags, ControlMode};
use sbgc_host::proto::units::{ControlRate, FirmwareVersion};
use sbgc_host::proto::wire::PerAxis;
use sbgc_host::sim::{Board as Simulated, Config};
use sbgc_host::{Connection, ControlSession, Error, Gimbal, Options, SessionOptions, Setpoint};
use support::*;
use tokio::io::{AsyncReadExt, AsyncWriteExt, duplex};
use tokio::time::{Instant, sleep, sleep_until};

const CONFIG: u8 = 90;
const CONTROL: u8 = 67;

/// A simulated board that runs on whether or not a host is there, and that can be looked at.
#[derive(Clone)]
struct Camera(Arc<Mutex<Simulated>>);

impl Camera {
    fn start(config: Config) -> (Gimbal, Self) {
        let (gimbal, connection, camera) = Self::with_connection(config);
        tokio::spawn(connection);
        (gimbal, camera)
    }

    fn with_connection(config: Config) -> (Gimbal, Connection, Self) {
        let (near, mut far) = duplex(4096);
        let camera = Self(Arc::new(Mutex::new(Simulated::new(config))));
        let board = Arc::clone(&camera.0);
        tokio::spawn(async move {
            let (started, mut input, mut open) = (Instant::now(), BytesMut::new(), true);
            loop {
                let (output, next) = {
                    let mut board = board.lock().unwrap();
                    board.receive(started.elapsed(), &input.split());
                    board.advance(started.elapsed());
                    (board.take_output(), started + board.next_event().unwrap_or(Duration::from_hours(9)))
                };
                let _ = far.write_all(&output).await;
                tokio::select! {
                    read = far.read_buf(&mut input), if open => open = read.is_ok_and(|count| count > 0),
                    () = sleep_until(next) => {}
                    () = sleep(MS(20)) => {}
                }
            }
        });
        let (gimbal, connection) = Gimbal::new(near, Options::default());
        (gimbal, connection, camera)
    }

    fn speeds(&self) -> [f64; 3] {
        self.0.lock().unwrap().motion().axes().map(|axis| axis.speed).into_array()
    }

    fn angle(&self) -> f64 {
        self.0.lock().unwrap().motion().axes().yaw.angle
    }

    fn stands(&self) -> bool {
        self.speeds().iter().all(|speed| *speed == 0.0)
    }
}

fn yaw(speed: f32) -> Setpoint {
    Setpoint::speeds(PerAxis { yaw: Some(speed), ..PerAxis::default() }).unwrap()
}

fn confirmed() -> SessionOptions {
    SessionOptions { confirmations: true, ..SessionOptions::default() }
}

async fn turning(gimbal: &Gimbal, camera: &Camera) -> ControlSession {
    let session = ControlSession::start(gimbal, SessionOptions::default()).await.unwrap();
    session.set(yaw(40.0)).unwrap();
    sleep(Duration::from_secs(3)).await;
    assert!((camera.speeds()[2] - 40.0).abs() < 0.1, "{:?}", camera.speeds());
    session
}

/// The axes stand, and go on to do so; and nothing on the board would end a move that is left to it.
async fn stops(gimbal: &Gimbal, camera: &Camera) {
    sleep(MS(400)).await;
    assert!(camera.stands(), "{:?}", camera.speeds());
    let angle = camera.angle();
    sleep(Duration::from_secs(3)).await;
    assert_eq!(camera.angle().to_bits(), angle.to_bits());
    let on = PerAxis { pitch: ControlRate::from_degrees_per_second(5.0), ..PerAxis::default() };
    gimbal.confirm(&Control::speeds(on)).await.unwrap();
    sleep(Duration::from_secs(5)).await;
    assert!(camera.speeds()[1] > 4.9, "the time-out is still armed");
}

#[tokio::test(start_paused = true)]
async fn a_dropped_session_stops_the_gimbal() {
    let (gimbal, camera) = Camera::start(Config::default());
    drop(turning(&gimbal, &camera).await);
    stops(&gimbal, &camera).await;
}

#[tokio::test(start_paused = true)]
async fn a_cancelled_owner_stops_the_gimbal() {
    let (gimbal, camera) = Camera::start(Config::default());
    let owner = tokio::spawn({
        let (gimbal, camera) = (gimbal.clone(), camera.clone());
        async move {
            let _session = turning(&gimbal, &camera).await;
            std::future::pending::<()>().await;
        }
    });
    sleep(Duration::from_secs(5)).await;
    assert!(!camera.stands());
    owner.abort();
    stops(&gimbal, &camera).await;
}

#[tokio::test(start_paused = true)]
async fn an_unwound_owner_stops_the_gimbal() {
    let (gimbal, camera) = Camera::start(Config::default());
    let owner = tokio::spawn({
        let (gimbal, camera) = (gimbal.clone(), camera.clone());
        async move {
            let _session = turning(&gimbal, &camera).await;
            panic!("the owner panics on purpose");
        }
    });
    assert!(owner.await.unwrap_err().is_panic());
    stops(&gimbal, &camera).await;
}

#[tokio::test(start_paused = true)]
async fn a_stopped_session_waits_for_the_board() {
    for options in [SessionOptions::default(), confirmed()] {
        let (gimbal, camera) = Camera::start(Config::default());
        let session = ControlSession::start(&gimbal, options).await.unwrap();
        session.apply(yaw(-40.0)).await.unwrap();
        sleep(Duration::from_secs(2)).await;
        assert!(camera.speeds()[2] < -39.0);
        session.stop().await.unwrap();
        stops(&gimbal, &camera).await;
    }
}

#[tokio::test(start_paused = true)]
async fn the_board_stops_by_itself_when_the_owner_is_killed() {
    let (gimbal, connection, camera) = Camera::with_connection(Config::default());
    let connection = tokio::spawn(connection);
    // No destructor runs, and nothing more is sent.
    let _session = std::mem::ManuallyDrop::new(turning(&gimbal, &camera).await);
    connection.abort();
    sleep(MS(900)).await;
    assert!(!camera.stands(), "the time-out is a second");
    sleep(MS(500)).await;
    assert!(camera.stands(), "{:?}", camera.speeds());
}

#[tokio::test(start_paused = true)]
async fn a_session_that_holds_leaves_the_axes_there() {
    let (gimbal, camera) = Camera::start(Config::default());
    let session = ControlSession::start(&gimbal, confirmed()).await.unwrap();
    let target = Setpoint::angles(PerAxis { yaw: Some(90.0), ..PerAxis::default() }, Some(45.0)).unwrap();
    let began = Instant::now();
    session.move_to(target, Duration::from_secs(20)).await.unwrap();
    assert!((camera.angle() - 90.0).abs() <= 1.01, "{}", camera.angle());
    assert!((1900..3000).contains(&since(began)), "{}", since(began));
    session.hold().await.unwrap();
    sleep(Duration::from_secs(5)).await;
    assert!((camera.angle() - 90.0).abs() < 0.01, "{}", camera.angle());
    stops(&gimbal, &camera).await;
}

#[tokio::test(start_paused = true)]
async fn two_moves_at_once_wait_each_for_their_own_axis() {
    let (gimbal, camera) = Camera::start(Config::default());
    let rate = ControlRate::from_degrees_per_second;
    let angle = sbgc_host::proto::units::Angle::from_degrees;
    let pitch = PerAxis { pitch: Some(angle(10.0)), ..PerAxis::default() };
    let turn = PerAxis { yaw: Some(angle(360.0)), ..PerAxis::default() };
    let began = Instant::now();
    let within = Duration::from_mins(1);
    let (first, second) = tokio::join!(
        async { gimbal.move_to(turn, rate(30.0), within).await.map(|()| since(began)) },
        async { gimbal.move_to(pitch, rate(5.0), within).await.map(|()| since(began)) },
    );
    let (first, second) = (first.unwrap(), second.unwrap());
    assert!(first >= 11_900, "a turn at 30 deg/s was reached after {first} ms");
    assert!((1_700..4_000).contains(&second), "10 degrees at 5 deg/s were reached after {second} ms");
    assert!((camera.angle() - 360.0).abs() <= 1.01, "{}", camera.angle());
}

#[tokio::test(start_paused = true)]
async fn only_one_owns_the_motion() {
    let (gimbal, camera) = Camera::start(Config::default());
    let session = turning(&gimbal, &camera).await;
    let other = gimbal.clone();
    assert!(matches!(ControlSession::start(&other, confirmed()).await, Err(Error::ControlInUse)));
    drop(session);
    drop(ControlSession::start(&other, confirmed()).await.unwrap());
}

#[tokio::test(start_paused = true)]
async fn old_firmware_has_no_time_out() {
    let (gimbal, _camera) =
        Camera::start(Config { firmware: FirmwareVersion::new(2, 60, 0), ..Config::default() });
    let error = ControlSession::start(&gimbal, SessionOptions::default()).await.unwrap_err();
    assert!(matches!(error, Error::TooOld { .. }), "{error}");
    let unprotected = SessionOptions { timeout: None, ..SessionOptions::default() };
    let session = ControlSession::start(&gimbal, unprotected).await.unwrap();
    let quaternion = Setpoint::attitude([1.0, 0.0, 0.0, 0.0]).unwrap();
    assert!(matches!(session.set(quaternion), Err(Error::TooOld { .. })));
}

#[tokio::test(start_paused = true)]
async fn options_out_of_range_are_refused() {
    let (gimbal, mut board) = gimbal();
    for (interval, timeout) in [(4, 1000), (300, 1000), (100, 150), (100, 70_000)] {
        let options = SessionOptions {
            interval: MS(interval),
            timeout: Some(MS(timeout)),
            ..SessionOptions::default()
        };
        let error = ControlSession::start(&gimbal, options).await.unwrap_err();
        assert!(matches!(error, Error::OutOfRange { unit: "ms", .. }), "{error}");
    }
    assert!(board.is_quiet(MS(100)).await);
}

/// A board of firmware 2.73.5 takes the configuration.
async fn begin(board: &mut Board) -> ControlConfig {
    board.expect(BOARD_INFO).await;
    board.send(BOARD_INFO, &board_info(2735)).await;
    let config = board.expect(CONFIG).await;
    board.confirm(CONFIG).await;
    ControlConfig::decode(&config.payload).unwrap()
}

#[tokio::test(start_paused = true)]
async fn set_points_are_repeated_from_the_newest() {
    let (gimbal, mut board) = gimbal();
    let (session, config) =
        tokio::join!(ControlSession::start(&gimbal, SessionOptions::default()), begin(&mut board));
    let session = session.unwrap();
    assert_eq!((config.timeout_ms, config.flags), (1000, ControlConfigFlags::NO_CONFIRM));
    assert!(board.is_quiet(MS(200)).await, "there is no set-point yet");
    session.set(yaw(1.0)).unwrap();
    session.set(yaw(30.0)).unwrap();
    let (mut controls, mut configs) = (0, 0);
    let until = Instant::now() + Duration::from_secs(2);
    while let Ok(frame) = tokio::time::timeout_at(until, board.next()).await {
        match frame.id {
            CONTROL => {
                let control = Control::decode(&frame.payload).unwrap();
                assert_eq!(
                    control.control_mode.into_array(),
                    [ControlMode::IGNORE, ControlMode::IGNORE, ControlMode::SPEED]
                );
                assert_eq!(control.axes.yaw.speed, ControlRate::from_degrees_per_second(30.0));
                controls += 1;
            }
            CONFIG => {
                assert_eq!(ControlConfig::decode(&frame.payload).unwrap(), config);
                configs += 1;
            }
            other => panic!("{other}"),
        }
    }
    assert!((95..=102).contains(&controls), "{controls} set-points in two seconds");
    assert!((1..=2).contains(&configs), "{configs}");
    drop(session);
    let stop = Control::decode(&board.expect(CONTROL).await.payload).unwrap();
    assert_eq!((stop.control_mode.yaw, stop.axes.yaw.speed), (ControlMode::SPEED, ControlRate(0)));
    assert_eq!(stop.control_mode.pitch, ControlMode::IGNORE);
    assert_eq!(ControlConfig::decode(&board.expect(CONFIG).await.payload).unwrap(), ControlConfig::default());
    let back = Control::decode(&board.expect(CONTROL).await.payload).unwrap();
    assert_eq!(
        back.control_mode.into_array(),
        [ControlMode::IGNORE, ControlMode::IGNORE, ControlMode::NO_CONTROL]
    );
    assert!(board.is_quiet(Duration::from_secs(5)).await, "nothing moves the gimbal after its owner");
}

#[tokio::test(start_paused = true)]
async fn a_start_that_is_given_up_disarms_the_time_out() {
    let (gimbal, mut board) = gimbal();
    tokio::select! {
        _ = ControlSession::start(&gimbal, SessionOptions::default()) => unreachable!(),
        () = async {
            board.expect(BOARD_INFO).await;
            board.send(BOARD_INFO, &board_info(2735)).await;
            board.expect(CONFIG).await;
        } => {}
    }
    let config = ControlConfig::decode(&board.expect(CONFIG).await.payload).unwrap();
    assert_eq!(config.timeout_ms, 0);
    assert!(board.is_quiet(Duration::from_secs(3)).await);
}

#[tokio::test(start_paused = true)]
async fn a_refused_set_point_is_an_error() {
    let (gimbal, mut board) = gimbal();
    let (session, _) = tokio::join!(ControlSession::start(&gimbal, confirmed()), begin(&mut board));
    let session = session.unwrap();
    let (applied, ()) = tokio::join!(session.apply(yaw(10.0)), async {
        board.expect(CONTROL).await;
        board.send(255, &[CONTROL, 8, 0, 0, 0, 0]).await;
    });
    assert!(matches!(applied, Err(Error::Refused { code: 8, .. })));
}
