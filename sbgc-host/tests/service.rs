//! The example that is a service, against a board that is reset and whose port goes away, and in a process of its own
//! that is told to end, or killed.
#![cfg(feature = "sim")]

#[path = "../examples/service.rs"]
#[allow(unreachable_pub, reason = "it is a program")]
mod service;

use std::process::{Child, Command, Stdio};
use std::time::Duration;

use sbgc_host::proto::CommandId;
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

/// The service as a program: what the tests below start this test program again for.
#[tokio::test]
#[ignore = "it runs until it is told to end"]
async fn the_service_itself() {
    let Ok(port) = std::env::var("SBGC_TEST_PORT") else { return };
    service::run(&port, async { drop(tokio::signal::ctrl_c().await) }).await.unwrap();
}

/// A process that ends with the test, however that ends.
struct Process(Child);

impl Process {
    fn start(port: &str) -> Self {
        let mut command = Command::new(std::env::current_exe().unwrap());
        command.args(["--ignored", "--exact", "the_service_itself"]).env("SBGC_TEST_PORT", port);
        Self(command.stdout(Stdio::null()).spawn().unwrap())
    }

    async fn ended(&mut self) -> std::process::ExitStatus {
        let waiting = async {
            loop {
                match self.0.try_wait().unwrap() {
                    Some(status) => return status,
                    None => sleep(MS(20)).await,
                }
            }
        };
        timeout(Duration::from_secs(10), waiting).await.expect("it ends in time")
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A board behind a TCP port that goes on when its client is gone.
async fn board() -> (SharedBoard, String, tokio::task::AbortHandle) {
    let board = SharedBoard::new(Board::new(Config::default()));
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let port = format!("tcp://{}", listener.local_addr().unwrap());
    let server = tokio::spawn(serve_shared_tcp(board.clone(), listener)).abort_handle();
    (board, port, server)
}

/// How many of the last commands disarm the board's time-out.
fn disarmed(board: &SharedBoard) -> usize {
    board.with(|board| {
        let configs = board.last_commands().filter(|command| command.id == CommandId::ControlConfig);
        configs.filter(|command| command.payload.starts_with(&[0, 0])).count()
    })
}

#[tokio::test]
async fn a_killed_process_is_stopped_by_the_time_out_of_the_board() {
    let (board, port, server) = board().await;
    let mut process = Process::start(&port);
    until(&board, true).await;
    process.0.kill().unwrap();
    assert!(!process.ended().await.success());
    // Nobody has told the board to stop.
    assert_eq!(disarmed(&board), 0);
    let killed = tokio::time::Instant::now();
    until(&board, false).await;
    assert!(
        killed.elapsed() < Duration::from_secs(5),
        "the time-out is a second, it took {:?}",
        killed.elapsed()
    );
    assert_eq!(disarmed(&board), 0);
    server.abort();
}

#[cfg(unix)]
#[tokio::test]
async fn a_process_that_is_interrupted_stops_the_motion() {
    let (board, port, server) = board().await;
    let mut process = Process::start(&port);
    until(&board, true).await;
    let interrupt = Command::new("kill").args(["-s", "INT", &process.0.id().to_string()]).status().unwrap();
    assert!(interrupt.success());
    assert!(process.ended().await.success());
    assert_eq!(disarmed(&board), 1);
    // The axes slow down as fast as they may.
    until(&board, false).await;
    server.abort();
}
