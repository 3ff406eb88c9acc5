//! The driver against the simulated board.
#![cfg(feature = "sim")]

use std::time::Duration;

use sbgc_host::proto::commands::{
    DebugVarsInfo3Request, MenuCommand, MotorsOffMode, RealtimeData4, RealtimeDataCustom,
    RealtimeDataCustomFlags as Flags, StreamSource,
};
use sbgc_host::proto::frame::Version;
use sbgc_host::proto::units::{Angle, ControlRate};
use sbgc_host::proto::wire::PerAxis;
use sbgc_host::streams::Item;
use sbgc_host::transport::{Address, Line};
use sbgc_host::{Gimbal, Options, StreamRequest};

async fn gimbal() -> Gimbal {
    let address: Address = "sim".parse().expect("an address");
    let io = address.open(Line::default()).await.expect("a board");
    Gimbal::spawn(io, Options::default())
}

#[tokio::test(start_paused = true)]
async fn a_session() {
    let gimbal = gimbal().await;
    let board = gimbal.handshake().await.unwrap();
    assert_eq!(gimbal.version(), Version::V2);
    assert!(board.firmware_ver.to_string().starts_with("2."));
    gimbal.board_info3().await.unwrap();
    gimbal.angles_ext().await.unwrap();
    let params = gimbal.params3(1.into()).await.unwrap();
    assert_eq!(params.profile_id.raw(), 1);
    // The current one answers with its own number.
    assert!(gimbal.params3(255.into()).await.unwrap().profile_id.raw() < 5);
    gimbal.motors_off(MotorsOffMode::Normal).await.unwrap();
    gimbal.motors_on().await.unwrap();
    gimbal.execute_menu(MenuCommand::No).await.unwrap();
    gimbal.close().await;
}

#[tokio::test(start_paused = true)]
async fn motion_that_is_waited_for() {
    let gimbal = gimbal().await;
    let target = PerAxis { pitch: Some(Angle::from_degrees(-30.0)), ..PerAxis::default() };
    gimbal.move_to(target, ControlRate(0), Duration::from_secs(20)).await.unwrap();
    let pitch = gimbal.angles().await.unwrap().axes.pitch.imu_angle.degrees();
    assert!((pitch + 30.0).abs() <= 1.0, "{pitch}");
}

#[tokio::test(start_paused = true)]
async fn two_streams_at_once() {
    let gimbal = gimbal().await;
    let flags = Flags::IMU_ANGLES | Flags::TARGET_ANGLES;
    let all = gimbal.subscribe(StreamRequest::of(StreamSource::RealtimeData4, 50)).await.unwrap();
    let some =
        gimbal.subscribe(StreamRequest::of(StreamSource::RealtimeDataCustom(flags), 20)).await.unwrap();
    let (mut all, mut some) = (all.typed::<RealtimeData4>(), some.typed_with::<RealtimeDataCustom, _>(flags));
    for _ in 0..50 {
        assert!(matches!(some.next().await, Some(Item::Message(data)) if data.imu_angles.is_some()));
    }
    for _ in 0..20 {
        assert!(matches!(all.next().await, Some(Item::Message(_))));
    }
    drop(all);
    drop(some);
    // The end of the second is sent when that of the first is confirmed.
    tokio::time::sleep(Duration::from_millis(100)).await;
    gimbal.angles().await.unwrap();
    let before = gimbal.counters().received.frames;
    tokio::time::sleep(Duration::from_secs(1)).await;
    assert_eq!(gimbal.counters().received.frames, before, "the streams have ended");
    assert_eq!(gimbal.counters().received.skipped(), 0);
}

#[tokio::test(start_paused = true)]
async fn what_the_board_does_not_know_is_refused_or_read() {
    let gimbal = gimbal().await;
    match gimbal.exchange(&DebugVarsInfo3Request).await {
        Ok(answer) => drop(answer.get()),
        Err(error) => assert!(matches!(error, sbgc_host::Error::Refused { .. }), "{error}"),
    }
    gimbal.board_info().await.unwrap();
}
