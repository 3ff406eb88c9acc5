//! Requests and their answers, against a board that does what the test says.

mod support;

use sbgc_host::proto::commands::{BoardInfoRequest, Control, EepromReadRequest, MotorsOn, ReadParams3};
use sbgc_host::proto::frame::Version;
use sbgc_host::proto::{CommandId, Message};
use sbgc_host::{Error, LinkState, Options, VersionChoice};
use support::*;
use tokio::io::AsyncWriteExt;
use tokio::time::Instant;

#[tokio::test(start_paused = true)]
async fn an_answer_comes_back() {
    let (gimbal, mut board) = gimbal();
    let (info, ()) = tokio::join!(gimbal.board_info(), async {
        assert_eq!(board.expect(BOARD_INFO).await.payload.len(), 0);
        board.send(BOARD_INFO, &board_info(2700)).await;
    });
    assert_eq!(info.unwrap().board_ver.0, 30);
    assert_eq!(gimbal.counters().sent_frames, 1);
    assert_eq!(gimbal.counters().received.frames, 1);
}

/// A program may stand still for longer than a time-out, in a debugger or under load.
#[tokio::test(start_paused = true)]
async fn what_came_in_time_counts_though_it_is_looked_at_late() {
    let (gimbal, mut board) = gimbal();
    let request = tokio::spawn({
        let gimbal = gimbal.clone();
        async move { gimbal.board_info().await }
    });
    board.expect(BOARD_INFO).await;
    let before = Instant::now();
    board.send(BOARD_INFO, &board_info(2700)).await;
    assert_eq!(before.elapsed(), MS(0));
    tokio::time::advance(MS(5000)).await;
    assert_eq!(request.await.unwrap().unwrap().board_ver.0, 30);
    assert_eq!(gimbal.counters().sent_frames, 1);
}

#[tokio::test(start_paused = true)]
async fn reads_repeat_and_fail_at_exactly_the_last_deadline() {
    let (gimbal, mut board) = gimbal();
    let start = Instant::now();
    let error = gimbal.board_info().await.unwrap_err();
    assert_eq!(since(start), 1500);
    assert!(
        matches!(error, Error::Timeout { command: "CMD_BOARD_INFO", attempts: 3, after } if after == MS(1500))
    );
    for _ in 0..3 {
        board.expect(BOARD_INFO).await;
    }
    assert!(board.is_quiet(MS(5000)).await);
    assert_eq!((gimbal.counters().timeouts, gimbal.counters().repeats), (1, 2));
}

#[tokio::test(start_paused = true)]
async fn writes_are_sent_once() {
    let (gimbal, mut board) = gimbal();
    let start = Instant::now();
    let error = gimbal.motors_on().await.unwrap_err();
    assert_eq!(since(start), 500);
    assert!(matches!(error, Error::Timeout { command: "CMD_MOTORS_ON", attempts: 1, .. }));
    board.expect(MOTORS_ON).await;
    assert!(board.is_quiet(MS(5000)).await);
}

#[tokio::test(start_paused = true)]
async fn a_restart_is_answered_but_never_repeated() {
    let (gimbal, mut board) = gimbal();
    let reset = gimbal.request_raw(CommandId::Reset, vec![1, 0, 0].into(), CommandId::Reset);
    assert!(matches!(reset.await, Err(Error::Timeout { attempts: 1, .. })));
    board.expect(114).await;
    assert!(board.is_quiet(MS(5000)).await);
}

#[tokio::test(start_paused = true)]
async fn a_late_confirmation_does_not_confirm_the_next_command() {
    let (gimbal, mut board) = gimbal();
    assert!(gimbal.motors_on().await.is_err());
    board.expect(MOTORS_ON).await;
    let (second, ()) = tokio::join!(gimbal.motors_on(), async {
        tokio::time::sleep(MS(100)).await;
        board.confirm(MOTORS_ON).await;
        board.expect(MOTORS_ON).await;
        board.send(255, &[MOTORS_ON, 8, 0, 0, 0, 0]).await;
    });
    assert!(matches!(second, Err(Error::Refused { code: 8, name: Some("ERR_WRONG_STATE"), .. })));
    assert_eq!(gimbal.counters().late, 1);
}

#[tokio::test(start_paused = true)]
async fn a_caller_that_leaves_before_sending_sends_nothing() {
    let (gimbal, mut board) = gimbal();
    let first = gimbal.clone();
    let first = tokio::spawn(async move { first.angles().await });
    board.expect(GET_ANGLES).await;
    // The second waits for the first, for one answer could be taken for both.
    let second = tokio::time::timeout(MS(50), gimbal.angles()).await;
    assert!(second.is_err());
    board.send(GET_ANGLES, &[0; 18]).await;
    first.await.unwrap().unwrap();
    assert!(board.is_quiet(MS(5000)).await);
}

#[tokio::test(start_paused = true)]
async fn a_caller_that_leaves_after_sending_takes_its_answer_along() {
    let (gimbal, mut board) = gimbal();
    assert!(tokio::time::timeout(MS(50), gimbal.angles()).await.is_err());
    let (second, ()) = tokio::join!(gimbal.angles(), async {
        board.expect(GET_ANGLES).await;
        board.send(GET_ANGLES, &[1; 18]).await;
        board.expect(GET_ANGLES).await;
        board.send(GET_ANGLES, &[2; 18]).await;
    });
    assert_eq!(second.unwrap().axes.roll.imu_angle.0, 0x0202);
    assert_eq!(gimbal.counters().late, 1);
}

#[tokio::test(start_paused = true)]
async fn different_requests_are_in_flight_together() {
    let (gimbal, mut board) = gimbal();
    let read = |address| EepromReadRequest { addr: address, size: 64 };
    let (one, two) = (read(64), read(128));
    let (one, two, motors, ()) =
        tokio::join!(gimbal.exchange(&one), gimbal.exchange(&two), gimbal.motors_on(), async {
            for id in [48, 48, MOTORS_ON] {
                board.expect(id).await;
            }
            board.confirm(MOTORS_ON).await;
            board.send(48, &[128, 0, 0, 0, 2, 2]).await;
            board.send(48, &[64, 0, 0, 0, 1, 1]).await;
        });
    motors.unwrap();
    assert_eq!((one.unwrap().get().data, two.unwrap().get().data), (&[1, 1][..], &[2, 2][..]));
}

#[tokio::test(start_paused = true)]
async fn equal_requests_take_turns() {
    let (gimbal, mut board) = gimbal();
    let (one, two, ()) = tokio::join!(gimbal.angles(), gimbal.angles(), async {
        for byte in [1, 2] {
            board.expect(GET_ANGLES).await;
            assert!(board.is_quiet(MS(50)).await);
            board.send(GET_ANGLES, &[byte; 18]).await;
        }
    });
    assert_eq!(one.unwrap().axes.yaw.target_angle.0, 0x0101);
    assert_eq!(two.unwrap().axes.yaw.target_angle.0, 0x0202);
}

#[tokio::test(start_paused = true)]
async fn refusals_in_both_forms() {
    let (gimbal, mut board) = gimbal();
    for answer in [&[MOTORS_ON, 6, 1, 0, 0, 0][..], &[6, 1, 0, 0, 0]] {
        let (outcome, ()) = tokio::join!(gimbal.motors_on(), async {
            board.expect(MOTORS_ON).await;
            board.send(255, answer).await;
        });
        let error = outcome.unwrap_err();
        let Error::Refused { command, code, name, data } = &error else { panic!("{error}") };
        assert_eq!((*command, *code, *name), ("CMD_MOTORS_ON", 6, Some("ERR_UNKNOWN_COMMAND")));
        assert_eq!(data[..], [1, 0, 0, 0]);
    }
}

#[tokio::test(start_paused = true)]
async fn an_answer_that_is_too_short_is_an_error_of_its_own() {
    let (gimbal, mut board) = gimbal();
    let (outcome, ()) = tokio::join!(gimbal.board_info(), async {
        board.expect(BOARD_INFO).await;
        board.send(BOARD_INFO, &[1, 2]).await;
    });
    assert!(matches!(outcome, Err(Error::Decode(_))));
}

#[tokio::test(start_paused = true)]
async fn noise_does_not_matter() {
    let (gimbal, mut board) = gimbal();
    let (info, ()) = tokio::join!(gimbal.board_info(), async {
        board.expect(BOARD_INFO).await;
        board.send_bytes(b"\xFF\xFE>\x01\x02\x00$$$>").await;
        let answer = encoded(BOARD_INFO, &board_info(2700));
        for byte in &answer {
            board.send_bytes(&[*byte]).await;
        }
    });
    info.unwrap();
    assert!(gimbal.counters().received.skipped() >= 8);
}

#[tokio::test(start_paused = true)]
async fn an_answer_behind_a_false_start_comes_out_after_the_gap() {
    let (gimbal, mut board) = gimbal();
    let start = Instant::now();
    let (info, ()) = tokio::join!(gimbal.board_info(), async {
        board.expect(BOARD_INFO).await;
        board.send_bytes(&[0x24, 0x20, 200, 232]).await;
        board.send(BOARD_INFO, &board_info(2700)).await;
    });
    info.unwrap();
    assert_eq!(since(start), 100);
}

#[tokio::test(start_paused = true)]
async fn the_end_in_the_middle_of_a_frame_fails_everything_at_once() {
    let (gimbal, mut board) = gimbal();
    let mut state = gimbal.link_state();
    let start = Instant::now();
    let (info, angles, ()) = tokio::join!(gimbal.board_info(), gimbal.angles(), async move {
        board.expect(BOARD_INFO).await;
        board.expect(GET_ANGLES).await;
        // A frame behind half a frame still counts.
        board.send_bytes(&[0x24, 0x20, 200, 232]).await;
        board.send(GET_ANGLES, &[0; 18]).await;
        board.send_bytes(&[0x24, 86]).await;
        drop(board);
    });
    assert!(matches!(info, Err(Error::Disconnected)));
    angles.unwrap();
    // Both requests were in one batch.
    assert_eq!(since(start), 0);
    assert_eq!(*state.borrow_and_update(), LinkState::Lost);
    assert!(matches!(gimbal.motors_on().await, Err(Error::Disconnected)));
    assert!(matches!(gimbal.control(&Control::default()), Err(Error::Disconnected)));
}

#[tokio::test(start_paused = true)]
async fn the_answer_is_found_among_all_profiles() {
    let (gimbal, mut board) = gimbal();
    let payload = |profile| [&[profile][..], &[0; 200]].concat();
    let request = ReadParams3 { profile_id: 1.into() };
    let (answer, ()) = tokio::join!(gimbal.request(&request), async {
        board.expect(21).await;
        board.send(21, &payload(0)).await;
        board.send(21, &payload(1)).await;
    });
    assert_eq!(answer.unwrap().profile_id.raw(), 1);
    assert_eq!(gimbal.counters().unsolicited, 1);
}

#[tokio::test(start_paused = true)]
async fn version_1_is_tried_when_version_2_is_not_answered() {
    let (gimbal, mut board) = gimbal();
    let (info, ()) = tokio::join!(gimbal.handshake(), async {
        for version in [Version::V2, Version::V2, Version::V1] {
            assert_eq!(board.expect(BOARD_INFO).await.version, version);
        }
        board.send_in(Version::V1, BOARD_INFO, &board_info(2600)).await;
    });
    info.unwrap();
    assert_eq!(gimbal.version(), Version::V1);
}

#[tokio::test(start_paused = true)]
async fn the_version_of_a_late_answer_decides() {
    for millis in [460, 700, 1100] {
        let (gimbal, mut board) = gimbal();
        let (info, ()) = tokio::join!(gimbal.handshake(), async {
            board.expect(BOARD_INFO).await;
            tokio::time::sleep(MS(millis)).await;
            board.send(BOARD_INFO, &board_info(2700)).await;
        });
        info.unwrap();
        assert_eq!(gimbal.version(), Version::V2, "after {millis} ms");
    }
}

#[tokio::test(start_paused = true)]
async fn newer_firmware_that_was_heard_in_version_1_is_asked_again_in_version_2() {
    for answers in [true, false] {
        let (gimbal, mut board) = gimbal();
        let (info, ()) = tokio::join!(gimbal.handshake(), async {
            for _ in 0..3 {
                board.expect(BOARD_INFO).await;
            }
            board.send_in(Version::V1, BOARD_INFO, &board_info(2700)).await;
            assert_eq!(board.expect(BOARD_INFO).await.version, Version::V2);
            if answers {
                board.send(BOARD_INFO, &board_info(2700)).await;
            }
        });
        info.unwrap();
        assert_eq!(gimbal.version(), if answers { Version::V2 } else { Version::V1 });
    }
}

/// Over a slow line answers in both versions are on their way. Once the board was asked in version 2, it takes nothing
/// else.
#[tokio::test(start_paused = true)]
async fn a_late_frame_of_version_2_rules_out_version_1() {
    let (gimbal, mut board) = gimbal();
    let (info, ()) = tokio::join!(gimbal.handshake(), async {
        for _ in 0..3 {
            board.expect(BOARD_INFO).await;
        }
        board.send_in(Version::V1, BOARD_INFO, &board_info(2700)).await;
        tokio::time::sleep(MS(200)).await;
        board.send(BOARD_INFO, &board_info(2700)).await;
    });
    info.unwrap();
    assert_eq!(gimbal.version(), Version::V2);
}

#[tokio::test(start_paused = true)]
async fn version_2_is_tried_again_when_version_1_is_not_answered() {
    let (gimbal, mut board) = gimbal();
    let (info, ()) = tokio::join!(gimbal.handshake(), async {
        for version in [Version::V2, Version::V2, Version::V1, Version::V2] {
            assert_eq!(board.expect(BOARD_INFO).await.version, version);
        }
        board.send(BOARD_INFO, &board_info(2700)).await;
    });
    info.unwrap();
    assert_eq!(gimbal.version(), Version::V2);
}

#[tokio::test(start_paused = true)]
async fn nobody_is_found_in_a_time_that_is_said() {
    let (gimbal, _board) = gimbal();
    let start = Instant::now();
    let error = gimbal.handshake().await.unwrap_err();
    let waited = start.elapsed();
    assert!(
        matches!(error, Error::Timeout { after, attempts: 5, .. } if after == waited),
        "{error} after {waited:?}"
    );
    assert!(waited < MS(3000), "{waited:?}");
    assert_eq!(gimbal.version(), Version::V2);
}

#[tokio::test(start_paused = true)]
async fn version_2_is_kept_when_it_is_answered() {
    let (gimbal, mut board) = gimbal();
    let (info, ()) = tokio::join!(gimbal.handshake(), async {
        assert_eq!(board.expect(BOARD_INFO).await.version, Version::V2);
        board.send(BOARD_INFO, &board_info(2700)).await;
    });
    info.unwrap();
    assert_eq!(gimbal.version(), Version::V2);
}

#[tokio::test(start_paused = true)]
async fn a_chosen_version_is_the_only_one() {
    let options = Options { version: VersionChoice::Only(Version::V1), ..Options::default() };
    let (gimbal, mut board) = gimbal_with(4096, options);
    assert!(gimbal.handshake().await.is_err());
    for _ in 0..3 {
        assert_eq!(board.expect(BOARD_INFO).await.version, Version::V1);
    }
}

#[tokio::test(start_paused = true)]
async fn what_the_board_would_lose_is_not_sent() {
    let (gimbal, mut board) = gimbal();
    let error = gimbal.send_raw(CommandId::WriteFile, vec![0; 250].into()).await.unwrap_err();
    assert!(matches!(error, Error::PayloadTooLong { length: 250, limit: 249, .. }));
    gimbal.send_raw(CommandId::WriteFile, vec![0; 249].into()).await.unwrap();
    assert_eq!(board.expect(54).await.payload.len(), 249);
}

#[tokio::test(start_paused = true)]
async fn closing_sends_what_is_left_and_gives_the_port_back() {
    let (gimbal, mut board) = gimbal();
    let other = gimbal.clone();
    let waiting = tokio::spawn({
        let gimbal = gimbal.clone();
        async move { gimbal.board_info().await }
    });
    board.expect(BOARD_INFO).await;
    for _ in 0..20 {
        gimbal.send(&MotorsOn).await.unwrap();
    }
    gimbal.close().await;
    for _ in 0..20 {
        board.expect(MOTORS_ON).await;
    }
    assert!(board.try_next().await.is_none());
    assert!(matches!(waiting.await.unwrap(), Err(Error::Closed)));
    assert!(matches!(other.motors_on().await, Err(Error::Closed)));
    assert_eq!(*other.link_state().borrow(), LinkState::Closed);
}

#[tokio::test(start_paused = true)]
async fn dropping_the_last_handle_ends_the_task() {
    let (gimbal, mut board) = gimbal();
    gimbal.send(&MotorsOn).await.unwrap();
    let other = gimbal.clone();
    drop(gimbal);
    board.expect(MOTORS_ON).await;
    assert!(board.is_quiet(MS(5000)).await);
    drop(other);
    assert!(board.try_next().await.is_none());
}

#[tokio::test(start_paused = true)]
async fn a_board_that_reads_nothing_cannot_hold_up_the_end() {
    let (gimbal, board) = gimbal_with(8, Options::default());
    let start = Instant::now();
    gimbal.send(&MotorsOn).await.unwrap();
    gimbal.send(&MotorsOn).await.unwrap();
    gimbal.close().await;
    assert!(since(start) <= 2000);
    drop(board);
}

#[tokio::test(start_paused = true)]
async fn requests_of_all_kinds_are_send() {
    fn is_send<T: Send>(value: T) -> T {
        value
    }
    let (gimbal, _board) = gimbal();
    drop(is_send(gimbal.request(&BoardInfoRequest)));
    drop(is_send(gimbal.exchange(&EepromReadRequest::default())));
    drop(is_send(gimbal.confirm(&MotorsOn)));
    drop(is_send(gimbal.close()));
    assert_eq!(MotorsOn::ID.raw(), MOTORS_ON);
}

#[tokio::test(start_paused = true)]
async fn a_hostile_stream_stops_nothing() {
    let (gimbal, mut board) = gimbal_with(64, Options::default());
    let mut noise = Vec::new();
    let mut seed = 1_u32;
    for round in 0..400_u32 {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let [a, b, c, _] = seed.to_be_bytes();
        match round % 5 {
            0 => noise.extend([b'$', a, b, a.wrapping_add(b)]),
            1 => noise.extend(&encoded(a | 1, &vec![b; usize::from(c)])),
            2 => noise.extend(&encoded(255, &vec![a; usize::from(b % 8)])),
            3 => noise.extend(&encoded(67, &vec![a; usize::from(b % 8)])[..5]),
            _ => noise.extend([a, b, c, b'>', b'$', 0]),
        }
    }
    board.send_bytes(&noise).await;
    board.io.flush().await.unwrap();
    tokio::time::sleep(MS(200)).await;
    let received = gimbal.counters().received;
    assert_eq!(received.bytes(), noise.len() as u64);
    let (info, ()) = tokio::join!(gimbal.board_info(), async {
        board.expect(BOARD_INFO).await;
        board.send(BOARD_INFO, &board_info(2700)).await;
    });
    info.unwrap();
}

/// Notes the spans that are opened, and what they record.
#[derive(Clone, Default)]
struct Notes(std::sync::Arc<std::sync::Mutex<Vec<String>>>);

impl tracing::field::Visit for &Notes {
    fn record_debug(&mut self, field: &tracing::field::Field, value: &dyn std::fmt::Debug) {
        self.0.lock().unwrap().push(format!("{field}={value:?}"));
    }
}

impl tracing::Subscriber for Notes {
    fn enabled(&self, metadata: &tracing::Metadata<'_>) -> bool {
        metadata.is_span()
    }

    fn new_span(&self, span: &tracing::span::Attributes<'_>) -> tracing::span::Id {
        self.0.lock().unwrap().push(span.metadata().name().to_owned());
        span.record(&mut &*self);
        tracing::span::Id::from_u64(1)
    }

    fn record(&self, _: &tracing::span::Id, values: &tracing::span::Record<'_>) {
        values.record(&mut &*self);
    }

    fn record_follows_from(&self, _: &tracing::span::Id, _: &tracing::span::Id) {}

    fn event(&self, _: &tracing::Event<'_>) {}

    fn enter(&self, _: &tracing::span::Id) {}

    fn exit(&self, _: &tracing::span::Id) {}
}

#[tokio::test(start_paused = true)]
async fn each_request_is_a_span_with_its_outcome() {
    let notes = Notes::default();
    let _noting = tracing::subscriber::set_default(notes.clone());
    let (gimbal, mut board) = gimbal();
    notes.0.lock().unwrap().clear();
    let (angles, ()) = tokio::join!(gimbal.angles(), async {
        board.expect(GET_ANGLES).await;
        board.send(GET_ANGLES, &[0; 18]).await;
    });
    angles.unwrap();
    let seen = notes.0.lock().unwrap().clone();
    assert_eq!(seen, ["request", "command=\"CMD_GET_ANGLES\"", "outcome=18 bytes"]);
}
