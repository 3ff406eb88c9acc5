//! Motion that is waited for.

mod support;

use std::time::Duration;

use sbgc_host::Error;
use sbgc_host::proto::Message;
use sbgc_host::proto::commands::{Angles, AxisAngles};
use sbgc_host::proto::units::{Angle, ControlRate};
use sbgc_host::proto::wire::PerAxis;
use support::*;
use tokio::time::Instant;

const TARGET: PerAxis<Option<Angle>> = PerAxis { roll: None, pitch: Some(Angle(-1024)), yaw: None };
const WITHIN: Duration = Duration::from_secs(10);

fn angles(imu: i16, target: i16) -> Vec<u8> {
    let axis = |imu, target| AxisAngles {
        imu_angle: Angle(imu),
        target_angle: Angle(target),
        ..AxisAngles::default()
    };
    let angles = Angles { axes: PerAxis { pitch: axis(imu, target), ..PerAxis::default() } };
    angles.encode(&mut [0; 18]).unwrap().to_vec()
}

#[tokio::test(start_paused = true)]
async fn the_board_says_that_it_is_there() {
    let (gimbal, mut board) = gimbal();
    let start = Instant::now();
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), WITHIN), async {
        let control = board.expect(67).await;
        assert_eq!(control.payload[..3], [7, 0x42, 7]);
        board.confirm(67).await;
        tokio::time::sleep(MS(100)).await;
        board.send(CONFIRM, &[67, 1]).await;
        board.expect(GET_ANGLES).await;
        board.send(GET_ANGLES, &angles(-1000, -1024)).await;
    });
    moved.unwrap();
    assert_eq!(since(start), 100);
}

#[tokio::test(start_paused = true)]
async fn the_confirmation_of_somebody_elses_move_does_not_count() {
    let (gimbal, mut board) = gimbal();
    let start = Instant::now();
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), WITHIN), async {
        board.expect(67).await;
        board.confirm(67).await;
        // Another move has arrived; this one is on its way.
        board.send(CONFIRM, &[67, 1]).await;
        for (imu, target) in [(0, 0), (-300, -400), (-1000, -1024), (-1024, -1024)] {
            board.expect(GET_ANGLES).await;
            board.send(GET_ANGLES, &angles(imu, target)).await;
        }
    });
    moved.unwrap();
    assert!(since(start) >= 750, "{}", since(start));
}

#[tokio::test(start_paused = true)]
async fn a_whole_turn_is_not_reached_at_once() {
    let (gimbal, mut board) = gimbal();
    let turn = PerAxis { pitch: Some(Angle::from_degrees(360.0)), ..PerAxis::default() };
    let (moved, asked) = tokio::join!(gimbal.move_to(turn, ControlRate(0), WITHIN), async {
        board.expect(67).await;
        board.confirm(67).await;
        let mut asked = 0;
        for (imu, target) in [(0, 16384), (0, 0), (0, 0), (8000, 16384), (16380, 16384), (16384, 16384)] {
            board.expect(GET_ANGLES).await;
            board.send(GET_ANGLES, &angles(imu, target)).await;
            asked += 1;
        }
        asked
    });
    moved.unwrap();
    assert_eq!(asked, 6);
}

#[tokio::test(start_paused = true)]
async fn the_angles_say_it_when_the_board_does_not() {
    let (gimbal, mut board) = gimbal();
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), WITHIN), async {
        board.expect(67).await;
        board.confirm(67).await;
        // At rest before it sets off, on the way, almost there, there.
        for (imu, target) in [(0, 0), (0, 0), (-500, -500), (-900, -1024), (-1000, -1024), (-1024, -1024)] {
            board.expect(GET_ANGLES).await;
            board.send(GET_ANGLES, &angles(imu, target)).await;
        }
        assert!(board.is_quiet(MS(1000)).await);
    });
    moved.unwrap();
}

#[tokio::test(start_paused = true)]
async fn lost_confirmations_are_made_up_for() {
    let (gimbal, mut board) = gimbal();
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), WITHIN), async {
        board.expect(67).await;
        for _ in 0..2 {
            board.expect(GET_ANGLES).await;
            board.send(GET_ANGLES, &angles(-1024, -1024)).await;
        }
    });
    moved.unwrap();
}

#[tokio::test(start_paused = true)]
async fn a_target_that_is_not_reached_in_time() {
    let (gimbal, mut board) = gimbal();
    let start = Instant::now();
    let board_side = async {
        board.expect(67).await;
        board.confirm(67).await;
        loop {
            board.expect(GET_ANGLES).await;
            board.send(GET_ANGLES, &angles(0, -1024)).await;
        }
    };
    let moved = tokio::select! {
        moved = gimbal.move_to(TARGET, ControlRate(0), WITHIN) => moved,
        () = board_side => unreachable!(),
    };
    assert!(matches!(moved, Err(Error::NotReached { after: WITHIN })));
    assert_eq!(since(start), 10_000);
}

#[tokio::test(start_paused = true)]
async fn a_refusal_is_told_at_once() {
    let (gimbal, mut board) = gimbal();
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), WITHIN), async {
        board.expect(67).await;
        board.send(255, &[67, 8, 0, 0, 0, 0]).await;
    });
    assert!(matches!(moved, Err(Error::Refused { code: 8, .. })));
}

#[tokio::test(start_paused = true)]
async fn a_lost_port_ends_the_wait() {
    let (gimbal, mut board) = gimbal();
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), WITHIN), async move {
        board.expect(67).await;
        board.confirm(67).await;
        board.expect(GET_ANGLES).await;
        drop(board);
    });
    assert!(matches!(moved, Err(Error::Disconnected)));
}

#[tokio::test(start_paused = true)]
async fn whoever_waits_for_ever_may() {
    let options = sbgc_host::Options { timeout: Duration::MAX, gap: Duration::MAX, ..Default::default() };
    let (gimbal, mut board) = gimbal_with(4096, options);
    let (moved, ()) = tokio::join!(gimbal.move_to(TARGET, ControlRate(0), Duration::MAX), async {
        board.expect(67).await;
        board.confirm(67).await;
        board.send(CONFIRM, &[67, 1]).await;
        board.expect(GET_ANGLES).await;
        board.send(GET_ANGLES, &angles(-1024, -1024)).await;
    });
    moved.unwrap();
}
