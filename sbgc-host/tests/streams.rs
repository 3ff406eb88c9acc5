//! Data streams and subscriptions.

mod support;

use std::pin::pin;

use futures_core::Stream;
use sbgc_host::proto::CommandId;
use sbgc_host::proto::commands::{
    Angles, EventId, EventTypes, RealtimeDataCustom, RealtimeDataCustomFlags, RealtimeDataCustomRequest,
    StreamSource,
};
use sbgc_host::streams::{Interruption, Item};
use sbgc_host::{Error, Options, Sample, StreamRequest, Subscription};
use support::*;
use tokio::time::Instant;

const REQUEST: StreamRequest = StreamRequest::new(CommandId::RealtimeData4, 20);

fn start(interval: u8) -> Vec<u8> {
    let mut payload = vec![0; 21];
    payload[..2].copy_from_slice(&[REALTIME_4, interval]);
    payload
}

async fn subscribe(gimbal: &sbgc_host::Gimbal, board: &mut Board) -> Subscription {
    let (subscription, payload) = tokio::join!(gimbal.subscribe(REQUEST), board.confirm_stream());
    assert_eq!(payload, start(20));
    subscription.unwrap()
}

fn payload(sample: Option<Sample>) -> Vec<u8> {
    match sample {
        Some(Sample::Payload(payload)) => payload.to_vec(),
        other => panic!("{other:?}"),
    }
}

#[tokio::test(start_paused = true)]
async fn samples_come_until_the_last_subscriber_leaves() {
    let (gimbal, mut board) = gimbal();
    let mut first = subscribe(&gimbal, &mut board).await;
    // The second shares the registration.
    let mut second = gimbal.subscribe(REQUEST).await.unwrap();
    board.send(REALTIME_4, b"abc").await;
    assert_eq!(payload(first.next().await), b"abc");
    assert_eq!(payload(second.next().await), b"abc");
    drop(first);
    assert!(board.is_quiet(MS(200)).await);
    drop(second);
    assert_eq!(board.confirm_stream().await, start(0));
    assert!(board.is_quiet(MS(1000)).await);
}

#[tokio::test(start_paused = true)]
async fn equal_requests_wait_for_one_confirmation() {
    let (gimbal, mut board) = gimbal();
    let (one, two, payload) =
        tokio::join!(gimbal.subscribe(REQUEST), gimbal.subscribe(REQUEST), board.confirm_stream());
    assert_eq!(payload, start(20));
    let _both = (one.unwrap(), two.unwrap());
    assert!(board.is_quiet(MS(200)).await);
}

#[tokio::test(start_paused = true)]
async fn another_interval_is_refused() {
    let (gimbal, mut board) = gimbal();
    let _running = subscribe(&gimbal, &mut board).await;
    let error = gimbal.subscribe(StreamRequest { interval_ms: 300, ..REQUEST }).await.unwrap_err();
    assert!(matches!(error, Error::StreamInUse { running_ms: 20, .. }), "{error}");
    assert!(board.is_quiet(MS(200)).await);
}

#[tokio::test(start_paused = true)]
async fn a_refused_stream_leaves_nothing_behind() {
    let (gimbal, mut board) = gimbal();
    let (refused, ()) = tokio::join!(gimbal.subscribe(REQUEST), async {
        board.expect(STREAM).await;
        board.send(255, &[STREAM, 9, 0, 0, 0, 0]).await;
    });
    assert!(matches!(refused, Err(Error::Refused { name: Some("ERR_NOT_SUPPORTED"), .. })));
    assert!(board.is_quiet(MS(1000)).await);
    subscribe(&gimbal, &mut board).await;
}

#[tokio::test(start_paused = true)]
async fn an_unconfirmed_stream_is_taken_back() {
    let (gimbal, mut board) = gimbal();
    assert!(matches!(gimbal.subscribe(REQUEST).await, Err(Error::Timeout { attempts: 3, .. })));
    for interval in [20, 20, 20, 0, 0] {
        assert_eq!(board.expect(STREAM).await.payload, start(interval));
    }
    // Until it is confirmed that it ended. The first confirmations may be late ones of the start.
    board.confirm(STREAM).await;
    let mut repeats = 0;
    while let Ok(frame) = tokio::time::timeout(MS(60_000), board.next()).await {
        assert_eq!(frame.payload, start(0));
        board.confirm(STREAM).await;
        repeats += 1;
    }
    assert!(repeats <= 3, "{repeats}");
}

#[tokio::test(start_paused = true)]
async fn a_subscriber_that_leaves_before_the_confirmation_leaves_nothing_behind() {
    let (gimbal, mut board) = gimbal();
    assert!(tokio::time::timeout(MS(50), gimbal.subscribe(REQUEST)).await.is_err());
    assert_eq!(board.expect(STREAM).await.payload, start(20));
    assert_eq!(board.expect(STREAM).await.payload, start(0));
    board.confirm(STREAM).await;
    board.confirm(STREAM).await;
    assert!(board.is_quiet(MS(1000)).await);
    subscribe(&gimbal, &mut board).await;
}

#[tokio::test(start_paused = true)]
async fn a_frame_that_answers_a_request_also_goes_to_subscribers() {
    let (gimbal, mut board) = gimbal();
    let mut heard = gimbal.listen(CommandId::GetAngles);
    let (angles, ()) = tokio::join!(gimbal.angles(), async {
        board.expect(GET_ANGLES).await;
        board.send(GET_ANGLES, &[3; 18]).await;
    });
    angles.unwrap();
    assert_eq!(payload(heard.next().await), [3; 18]);
    assert_eq!(gimbal.counters().unsolicited, 0);
}

#[tokio::test(start_paused = true)]
async fn a_slow_subscriber_is_told_how_many_it_lost_and_disturbs_nobody() {
    let (gimbal, mut board) = gimbal();
    let mut roomy = subscribe(&gimbal, &mut board).await;
    let mut slow = gimbal.subscribe(StreamRequest { capacity: 64, ..REQUEST }).await.unwrap();
    for byte in 0..100 {
        board.send(REALTIME_4, &[byte]).await;
        tokio::task::yield_now().await;
    }
    tokio::time::sleep(MS(10)).await;
    assert_eq!(slow.next().await, Some(Sample::Lagged(36)));
    assert_eq!(payload(slow.next().await), [36]);
    for byte in 0..100 {
        assert_eq!(payload(roomy.next().await), [byte]);
    }
    assert_eq!(gimbal.counters().lost_samples, 36);
}

#[tokio::test(start_paused = true)]
async fn subscriptions_end_with_the_link() {
    let (gimbal, mut board) = gimbal();
    let mut heard = gimbal.listen(CommandId::GetAngles);
    board.send(GET_ANGLES, b"x").await;
    drop(board);
    assert_eq!(payload(heard.next().await), b"x");
    assert_eq!(heard.next().await, None);
    assert_eq!(gimbal.listen(CommandId::GetAngles).next().await, None);
}

#[tokio::test(start_paused = true)]
async fn closing_takes_all_streams_back() {
    let (gimbal, mut board) = gimbal();
    let mut samples = subscribe(&gimbal, &mut board).await;
    let ((), payload) = tokio::join!(gimbal.close(), board.confirm_stream());
    assert_eq!(payload, start(0));
    assert!(board.try_next().await.is_none());
    assert_eq!(samples.next().await, None);
}

#[tokio::test(start_paused = true)]
async fn a_subscription_outlives_the_handles() {
    let (gimbal, mut board) = gimbal_with(4096, Options::default());
    let mut samples = subscribe(&gimbal, &mut board).await;
    drop(gimbal);
    board.send(REALTIME_4, b"abc").await;
    assert_eq!(payload(samples.next().await), b"abc");
    drop(samples);
    assert_eq!(board.confirm_stream().await, start(0));
    assert!(board.try_next().await.is_none());
}

#[tokio::test(start_paused = true)]
async fn samples_as_messages() {
    let (gimbal, mut board) = gimbal();
    let mut angles = pin!(gimbal.listen(CommandId::GetAngles).typed::<Angles>());
    board.send(GET_ANGLES, &[1; 18]).await;
    board.send(GET_ANGLES, &[1; 3]).await;
    let item = std::future::poll_fn(|context| angles.as_mut().poll_next(context)).await;
    assert!(matches!(item, Some(Item::Message(angles)) if angles.axes.roll.imu_angle.0 == 0x0101));
    assert!(matches!(angles.next().await, Some(Item::Undecoded(_))));
}

#[tokio::test(start_paused = true)]
async fn samples_that_need_a_context() {
    let (gimbal, mut board) = gimbal();
    let flags = RealtimeDataCustomFlags::IMU_ANGLES;
    let request = StreamRequest::of(StreamSource::RealtimeDataCustom(flags), 10);
    let (subscription, _) = tokio::join!(gimbal.subscribe(request), board.confirm_stream());
    let mut samples = subscription.unwrap().typed_with::<RealtimeDataCustom, _>(flags);
    // Another program has the board send something else.
    board.send(88, &[0; 20]).await;
    assert_eq!(samples.next().await, Some(Item::WrongLength { expected: 8, got: 20 }));
    board.send(88, &[0x10, 0x27, 0x00, 0x10, 0, 0, 0, 0xF8]).await;
    let Some(Item::Message(data)) = samples.next().await else { panic!("a message") };
    assert_eq!(data.timestamp_ms, 10_000);
}

/// Sends a sample each 20 ms for so long.
async fn samples_for(board: &mut Board, millis: u64) {
    for _ in 0..millis / 20 {
        board.send(REALTIME_4, b"abc").await;
        tokio::time::sleep(MS(20)).await;
    }
}

#[tokio::test(start_paused = true)]
async fn a_stream_that_falls_silent_is_registered_again() {
    let (gimbal, mut board) = gimbal();
    let mut samples = subscribe(&gimbal, &mut board).await;
    samples_for(&mut board, 1000).await;
    for _ in 0..50 {
        assert_eq!(payload(samples.next().await), b"abc");
    }
    // The board is deaf at first, as after it was switched on.
    for _ in 0..3 {
        assert_eq!(board.expect(STREAM).await.payload, start(20));
    }
    assert_eq!(samples.next().await, Some(Sample::Interrupted(Interruption::Silent)));
    assert_eq!(board.confirm_stream().await, start(20));
    samples_for(&mut board, 100).await;
    assert!(matches!(samples.next().await, Some(Sample::Resumed(after)) if after > MS(1000)));
    assert_eq!(payload(samples.next().await), b"abc");
}

#[tokio::test(start_paused = true)]
async fn a_stream_that_is_refused_after_an_interruption_ends() {
    let (gimbal, mut board) = gimbal();
    let mut samples = subscribe(&gimbal, &mut board).await;
    board.expect(STREAM).await;
    board.send(255, &[STREAM, 9, 0, 0, 0, 0]).await;
    assert_eq!(samples.next().await, Some(Sample::Interrupted(Interruption::Silent)));
    assert_eq!(samples.next().await, Some(Sample::Interrupted(Interruption::Refused)));
    assert_eq!(samples.next().await, None);
}

#[tokio::test(start_paused = true)]
async fn streams_come_back_after_a_reset_that_the_board_announces() {
    let (gimbal, mut board) = gimbal();
    let source = StreamSource::Event { event_id: EventId::MotorState, event_type: EventTypes::all() };
    let (events, _) = tokio::join!(gimbal.subscribe(StreamRequest::of(source, 100)), board.confirm_stream());
    let mut events = events.unwrap();
    let began = Instant::now();
    board.send(114, &[]).await;
    assert_eq!(events.next().await, Some(Sample::Interrupted(Interruption::Reset)));
    let again = board.confirm_stream().await;
    assert_eq!((again[0], since(began)), (102, 1500));
    assert!(matches!(events.next().await, Some(Sample::Resumed(_))));
    // Should the reset have come later than this, nothing else would show it.
    board.confirm_stream().await;
    assert_eq!(since(began), 15_000);
    board.send(102, &[2, 2, 0, 0]).await;
    assert_eq!(payload(events.next().await), [2, 2, 0, 0]);
}

#[tokio::test(start_paused = true)]
async fn streams_that_nothing_tells_apart_do_not_run_together() {
    let (gimbal, mut board) = gimbal();
    let custom = |flags| StreamRequest::of(StreamSource::RealtimeDataCustom(flags), 100);
    let angles = RealtimeDataCustomFlags::IMU_ANGLES;
    let (running, _) = tokio::join!(gimbal.subscribe(custom(angles)), board.confirm_stream());
    let targets = RealtimeDataCustomFlags::TARGET_ANGLES;
    assert!(matches!(gimbal.subscribe(custom(targets)).await, Err(Error::Indistinct { .. })));
    let once = RealtimeDataCustomRequest::new(targets).unwrap();
    assert!(matches!(gimbal.exchange(&once).await, Err(Error::Indistinct { .. })));
    // Another length tells answer and samples apart.
    let both = RealtimeDataCustomRequest::new(angles | targets).unwrap();
    let (answer, ()) = tokio::join!(gimbal.exchange(&both), async {
        board.expect(88).await;
        board.send(88, &[1; 8]).await;
        board.send(88, &[2; 14]).await;
        board.send(88, &[3; 8]).await;
    });
    assert_eq!(answer.unwrap().payload()[..], [2; 14]);
    let mut running = running.unwrap();
    assert_eq!((payload(running.next().await), payload(running.next().await)), (vec![1; 8], vec![3; 8]));
}

#[tokio::test(start_paused = true)]
async fn cancelled_subscriptions_leave_no_stream_behind() {
    let (gimbal, mut board) = gimbal();
    for interval_ms in 20..30 {
        // A request of the same kind holds the start back.
        let other = StreamRequest::new(CommandId::RealtimeData3, 50);
        let request = StreamRequest { interval_ms, ..REQUEST };
        let (_, _, ()) = tokio::join!(
            tokio::time::timeout(MS(20), gimbal.subscribe(other)),
            tokio::time::timeout(MS(20), gimbal.subscribe(request)),
            tokio::time::sleep(MS(30)),
        );
    }
    let mut running = std::collections::BTreeMap::new();
    while let Ok(frame) = tokio::time::timeout(MS(20_000), board.next()).await {
        running.insert(frame.payload[0], frame.payload[1]);
        board.confirm(STREAM).await;
    }
    assert!(running.values().all(|&interval| interval == 0), "{running:?}");
}

#[tokio::test(start_paused = true)]
async fn the_end_of_a_stream_is_repeated_until_it_is_confirmed() {
    let (gimbal, mut board) = gimbal();
    drop(subscribe(&gimbal, &mut board).await);
    for _ in 0..5 {
        assert_eq!(board.expect(STREAM).await.payload, start(0));
    }
    // Meanwhile it may be wanted again, at another interval.
    let request = StreamRequest { interval_ms: 100, ..REQUEST };
    let mut payloads = Vec::new();
    let again = tokio::select! {
        again = gimbal.subscribe(request) => again,
        () = async { loop { payloads.push(board.confirm_stream().await) } } => unreachable!(),
    };
    again.unwrap();
    assert_eq!(payloads.last(), Some(&start(100)), "{payloads:?}");
}

#[tokio::test(start_paused = true)]
async fn the_confirmation_of_one_end_is_not_taken_for_that_of_another() {
    let (gimbal, mut board) = gimbal();
    let first = subscribe(&gimbal, &mut board).await;
    let other = StreamRequest::new(CommandId::RealtimeData3, 50);
    let (second, _) = tokio::join!(gimbal.subscribe(other), board.confirm_stream());
    drop(first);
    drop(second.unwrap());
    // The first end is lost on the way; the other waits until that is settled.
    let lost = board.expect(STREAM).await.payload;
    let repeated = board.confirm_stream().await;
    assert_eq!((&lost, repeated[1]), (&repeated, 0));
    // The confirmation of the first attempt may still come, so the next end may need another one.
    let mut ends = Vec::new();
    while let Ok(frame) = tokio::time::timeout(MS(20_000), board.next()).await {
        ends.push((frame.payload[0], frame.payload[1]));
        board.confirm(STREAM).await;
    }
    let other = CommandId::RealtimeData3.raw();
    assert!(!ends.is_empty() && ends.len() <= 3 && ends.iter().all(|end| *end == (other, 0)), "{ends:?}");
}

#[tokio::test(start_paused = true)]
async fn no_more_streams_than_a_board_has() {
    let (gimbal, mut board) = gimbal();
    let mut kept = Vec::new();
    for config in 0..10 {
        let source = StreamSource::Event { event_id: config.into(), event_type: EventTypes::ON };
        let (one, _) = tokio::join!(gimbal.subscribe(StreamRequest::of(source, 50)), board.confirm_stream());
        kept.push(one.unwrap());
    }
    let error = gimbal.subscribe(REQUEST).await.unwrap_err();
    assert!(matches!(error, Error::TooManyStreams { maximum: 10 }), "{error}");
}
