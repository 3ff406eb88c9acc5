//! A service that keeps a gimbal under control: finds the board, follows it through resets and lost ports, moves it in
//! a loop of 100 Hz, and stops the motion when it is told to end.
//!
//! `cargo run -p sbgc-host --example service --features sim -- /dev/ttyUSB0`; without a port it simulates a board.

use std::time::Duration;

use sbgc_host::proto::commands::{RealtimeData4, RealtimeDataCustomFlags as Flags};
use sbgc_host::proto::wire::PerAxis;
use sbgc_host::streams::Item;
use sbgc_host::{ControlSession, Error, Gimbal, Result, SessionOptions, Setpoint};

#[tokio::main(flavor = "current_thread")]
#[allow(dead_code, reason = "a test runs the service without it")]
async fn main() -> Result<()> {
    let port = std::env::args().nth(1).unwrap_or_else(|| "sim".into());
    run(&port, async { drop(tokio::signal::ctrl_c().await) }).await
}

/// Runs until `stop` is done.
pub async fn run(port: &str, stop: impl Future<Output = ()>) -> Result<()> {
    let gimbal = Gimbal::connect(&port.parse()?).await?;
    println!("connected: {}", gimbal.found().map(ToString::to_string).unwrap_or_default());
    let outcome = tokio::select! {
        outcome = serve(&gimbal) => outcome,
        () = stop => Ok(()),
    };
    // The session was dropped, and what stops the motion is sent first.
    gimbal.close().await;
    outcome
}

async fn serve(gimbal: &Gimbal) -> Result<()> {
    let mut states = gimbal.stream::<RealtimeData4>(Duration::from_millis(100)).await?;
    let mut angles = gimbal.stream_custom(Flags::IMU_ANGLES, Duration::from_millis(50)).await?;
    let session = ControlSession::start(gimbal, SessionOptions::default()).await?;
    let turn = Setpoint::speeds(PerAxis { yaw: Some(10.0), ..PerAxis::default() })?;
    let mut cycle = tokio::time::interval(Duration::from_millis(10));
    let mut last = None;
    loop {
        tokio::select! {
            item = states.next() => match item {
                Some(Item::Interrupted(why)) => println!("interrupted: {why}; last angles: {last:?}"),
                Some(Item::Resumed(after)) => println!("resumed after {} ms", after.as_millis()),
                Some(_) => {}
                None => return Err(Error::Disconnected),
            },
            item = angles.next() => if let Some(Item::Message(sample)) = item { last = sample.imu_angles },
            _ = cycle.tick() => match session.set(turn) {
                // The port is being opened again.
                Ok(()) | Err(Error::Disconnected) => {}
                Err(error) => return Err(error),
            },
        }
    }
}
