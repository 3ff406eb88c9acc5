//! The example that is a service, against a board that is reset and whose port goes away.
#![cfg(feature = "sim")]

#[path = "../examples/service.rs"]
#[allow(unreachable_pub, reason = "it is a program")]
mod service;

use std::time::Duration;

use sbgc_host::sim::{Board, Config, Fault, SharedBoard, serve_shared_tcp};
use tokio::net::TcpListener;
use tokio::sync::oneshot;
use tokio::time::{sleep, timeout};

const MS: fn(u64) -> Duration = Duration::from_millis;

async fn moves(board: &SharedBoard) -> bool {
    let yaw = || board.with(|board| board.motion().axes().yaw.wire_angle());
    let before = yaw();
    sleep(MS(100)).await;
    yaw() != before
}

/// Waits until the board moves, or stands.
async fn until(board: &SharedBoard, moving: bool) {
    let waiting = async { while moves(board).await != moving {} };
    timeout(Duration::from_secs(20), waiting).await.expect("in time");
}

#[tokio::test]
async fn the_service_goes_on_after_a_reset_and_a_lost_port_and_stops_the_motion() {
    let lost = Fault::Unplug { at: MS(3000), lasts: MS(700) };
    let faults = vec![Fault::Reset { at: MS(1500) }, lost];
    let board = SharedBoard::new(Board::new(Config { faults, ..Config::default() }));
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let port = format!("tcp://{}", listener.local_addr().unwrap());
    let server = tokio::spawn(serve_shared_tcp(board.clone(), listener));
    let (stop, stopped) = oneshot::channel::<()>();
    let service = tokio::spawn(async move { service::run(&port, async { drop(stopped.await) }).await });
    until(&board, true).await;
    // Past both faults.
    sleep(MS(4500)).await;
    assert_eq!(board.with(|board| board.resets()), 1);
    until(&board, true).await;
    stop.send(()).unwrap();
    timeout(Duration::from_secs(10), service).await.expect("in time").unwrap().unwrap();
    until(&board, false).await;
    server.abort();
}
