//! What goes out, when, and in which order.

mod support;

use std::pin::Pin;
use std::task::{Context, Poll, Waker};

use sbgc_host::proto::CommandId;
use sbgc_host::proto::commands::{Control, ControlMode, MotorsOffMode};
use sbgc_host::proto::wire::PerAxis;
use sbgc_host::{Error, Options};
use support::*;
use tokio::io::AsyncReadExt;
use tokio::time::Instant;

/// Reads so many bytes as they come; returns when and how many each time.
async fn arrivals(board: &mut Board, total: usize) -> Vec<(u64, usize)> {
    let (start, mut seen, mut arrivals) = (Instant::now(), 0, Vec::new());
    while seen < total {
        let mut buffer = [0; 4096];
        let count = board.io.read(&mut buffer).await.expect("the driver is there");
        seen += count;
        arrivals.push((since(start), count));
    }
    arrivals
}

fn futures_poll<F: Future>(future: Pin<&mut F>) -> Poll<F::Output> {
    future.poll(&mut Context::from_waker(Waker::noop()))
}

#[tokio::test(start_paused = true)]
async fn batches_fit_the_buffer_of_the_board_and_keep_to_its_cycle() {
    let (gimbal, mut board) = gimbal();
    for _ in 0..20 {
        gimbal.send_raw(CommandId::BeepSound, vec![0; 94].into()).await.unwrap();
    }
    let arrivals = arrivals(&mut board, 20 * 100).await;
    assert!(arrivals.iter().all(|&(_, count)| count <= 255), "{arrivals:?}");
    for pair in arrivals.windows(2) {
        assert_eq!(pair[1].0 - pair[0].0, 8, "{arrivals:?}");
    }
    assert_eq!(gimbal.counters().sent_bytes, 2000);
}

#[tokio::test(start_paused = true)]
async fn nothing_goes_out_faster_than_the_line_carries_it() {
    let (gimbal, mut board) = gimbal_with(4096, Options { baud: Some(9600), ..Options::default() });
    for _ in 0..10 {
        gimbal.send_raw(CommandId::BeepSound, vec![0; 94].into()).await.unwrap();
    }
    let arrivals = arrivals(&mut board, 1000).await;
    // 1000 bytes take 1042 ms; the last batch has that of the others before it.
    let (last, count) = *arrivals.last().expect("some");
    let carried = (1000 - count) * 10 * 1000 / 9600;
    assert!(last >= carried as u64, "{arrivals:?}");
}

#[tokio::test(start_paused = true)]
async fn the_newest_set_point_replaces_those_not_yet_sent() {
    let (gimbal, mut board) = gimbal();
    let control = |kind: u8| {
        let mut control = Control::default();
        control.control_mode.roll = ControlMode(kind);
        control
    };
    gimbal.control(&control(1)).unwrap();
    assert_eq!(board.expect(67).await.payload[0], 1);
    let start = Instant::now();
    for kind in 2..=7 {
        gimbal.control(&control(kind)).unwrap();
    }
    assert_eq!(board.expect(67).await.payload[0], 7);
    assert_eq!(since(start), 8);
    assert!(board.is_quiet(MS(1000)).await);
    assert_eq!(gimbal.counters().superseded, 5);
}

#[tokio::test(start_paused = true)]
async fn confirmations_of_set_points_confirm_nothing_else() {
    let (gimbal, mut board) = gimbal();
    gimbal.control(&Control::default()).unwrap();
    board.expect(67).await;
    let control = Control::default();
    let (confirmed, ()) = tokio::join!(gimbal.confirm(&control), async {
        board.send(CONFIRM, &[67, 0]).await;
        board.expect(67).await;
        board.send(CONFIRM, &[67, 1]).await;
    });
    assert_eq!(confirmed.unwrap().data.value(), 1);
}

#[tokio::test(start_paused = true)]
async fn commands_keep_their_order() {
    let (gimbal, mut board) = gimbal();
    for byte in 0..60 {
        let gimbal = gimbal.clone();
        let sent = async move { gimbal.send_raw(CommandId::BeepSound, vec![byte; 30].into()).await };
        if byte < 40 {
            sent.await.unwrap();
        } else {
            tokio::spawn(sent);
            tokio::task::yield_now().await;
        }
    }
    for byte in 0..60 {
        assert_eq!(board.expect(89).await.payload[0], byte);
    }
}

#[tokio::test(start_paused = true)]
async fn two_sides_that_both_write_first_do_not_block_each_other() {
    let (gimbal, mut board) = gimbal_with(8, Options::default());
    let angles = gimbal.listen(CommandId::GetAngles);
    let writes = async {
        for _ in 0..10 {
            gimbal.send_raw(CommandId::BeepSound, vec![0; 200].into()).await.unwrap();
        }
    };
    // The board reads nothing before it has written everything.
    let board_side = async {
        for _ in 0..50 {
            board.send(GET_ANGLES, &[0; 18]).await;
        }
        for _ in 0..10 {
            board.expect(89).await;
        }
    };
    tokio::time::timeout(MS(60_000), async { tokio::join!(writes, board_side) }).await.expect("no deadlock");
    assert_eq!(gimbal.counters().received.frames, 50);
    drop(angles);
}

#[tokio::test(start_paused = true)]
async fn what_stops_motion_overtakes_everything_and_the_end_of_the_link() {
    let (gimbal, mut board) = gimbal();
    gimbal.send_raw(CommandId::BeepSound, vec![0; 240].into()).await.unwrap();
    board.expect(89).await;
    for _ in 0..20 {
        gimbal.send_raw(CommandId::BeepSound, vec![0; 94].into()).await.unwrap();
    }
    let mut reads: Vec<_> = (0..200).map(|_| Box::pin(gimbal.angles())).collect();
    for read in &mut reads {
        assert!(futures_poll(read.as_mut()).is_pending());
    }
    gimbal.control(&Control::default()).unwrap();
    // The set-point is not sent after the command that stops.
    gimbal
        .send_now(&Control {
            control_mode: PerAxis { roll: ControlMode(1), ..PerAxis::default() },
            ..Control::default()
        })
        .unwrap();
    let start = Instant::now();
    let off = gimbal.motors_off(MotorsOffMode::Brake);
    let (off, ()) = tokio::join!(off, async {
        assert_eq!(board.expect(67).await.payload[0], 1);
        board.expect(109).await;
        board.confirm(109).await;
    });
    off.unwrap();
    assert_eq!(since(start), 8);
    drop(reads);
    drop(gimbal);
    for _ in 0..20 {
        board.expect(89).await;
    }
    assert!(board.try_next().await.is_none());
}

#[tokio::test(start_paused = true)]
async fn what_stops_motion_goes_out_when_the_last_handle_is_dropped() {
    struct Session(sbgc_host::Gimbal);

    impl Drop for Session {
        fn drop(&mut self) {
            self.0.send_now(&Control::default()).unwrap();
        }
    }

    let (gimbal, mut board) = gimbal();
    drop(Session(gimbal));
    board.expect(67).await;
    assert!(board.try_next().await.is_none());
}

#[tokio::test(start_paused = true)]
async fn a_port_that_takes_nothing_holds_up_nobody() {
    let (gimbal, mut board) = gimbal_with(8, Options::default());
    let start = Instant::now();
    let (first, second, third, sent) =
        tokio::join!(gimbal.board_info(), gimbal.motors_on(), gimbal.angles(), async {
            loop {
                if let Err(error) = gimbal.send_raw(CommandId::BeepSound, vec![0; 94].into()).await {
                    return error;
                }
            }
        });
    assert!(matches!(first, Err(Error::Timeout { after, .. }) if after == MS(1500)));
    assert!(matches!(second, Err(Error::Timeout { after, .. }) if after == MS(500)));
    assert!(matches!(third, Err(Error::Timeout { after, .. }) if after == MS(1500)));
    assert!(matches!(sent, Error::Timeout { attempts: 0, .. }));
    assert_eq!(since(start), 1500);
    // What nobody waits for any more does not go out later.
    board.expect(BOARD_INFO).await;
    // Of which the port had taken the beginning.
    board.expect(MOTORS_ON).await;
    board.expect(89).await;
}
