//! From the shared options to a gimbal that responds.

use std::future::poll_fn;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::task::Poll;
use std::time::Duration;

use sbgc_host::capture::{Frames, Tapping};
use sbgc_host::connect::Wrap;
use sbgc_host::transport::{Address, PortKind, ports};
use sbgc_host::{ConnectOptions, Gimbal, Reconnect};
use sbgc_proto::commands::BoardInfo;

use crate::failure::Failure;
use crate::options::Global;
use crate::signals;

/// How long what follows a board waits for one that was unplugged or does not answer any more.
pub(crate) const FOLLOWED: Duration = Duration::from_secs(10);

/// Opens the port, makes sure that a board responds, and does `work` with it.
///
/// A signal ends the work by dropping it. However it ends, streams are unregistered and the port is closed.
pub(crate) async fn with_board<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    with_board_until(global, Reconnect::Never, unless_stopped(work)).await
}

/// Like [`with_board`], for work that goes on when the board is there again after it was reset or unplugged.
pub(crate) async fn with_followed_board<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    with_board_until(global, Reconnect::Within(FOLLOWED), unless_stopped(work)).await
}

/// Work that a signal ends by dropping it.
fn unless_stopped<T>(
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure> {
    async |gimbal, info| {
        tokio::select! {
            biased;
            signal = signals::stopped() => Err(Failure::Signal(signal)),
            outcome = work(gimbal, info) => outcome,
        }
    }
}

/// Like [`with_board`], but a signal does not end the work: it looks for [`signals::stopped`] itself.
pub(crate) async fn with_board_to_the_end<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    with_board_until(global, Reconnect::Never, work).await
}

async fn with_board_until<T>(
    global: &Global,
    reconnect: Reconnect,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let (gimbal, info) = tokio::select! {
        biased;
        signal = signals::stopped() => return Err(Failure::Signal(signal)),
        connected = connect(global, reconnect, None) => connected?,
    };
    let version = gimbal.version().number();
    let (board, firmware) = (info.board_ver.number(), info.firmware_ver);
    tracing::info!("board {board}, firmware {firmware}, protocol version {version}");
    let outcome = caught(work(gimbal.clone(), info)).await;
    let counters = gimbal.clone();
    // What the work has left to be sent as it was dropped, such as the end of a motion, goes out here.
    gimbal.close().await;
    tracing::info!("{}", counters.counters());
    outcome.unwrap_or_else(|panic| resume_unwind(panic))
}

/// Does work; if that panics, drops it and returns the panic, so that there is time to leave the board clean.
async fn caught<T>(work: impl Future<Output = T>) -> std::thread::Result<T> {
    let mut work = Box::pin(work);
    let outcome = poll_fn(|context| match catch_unwind(AssertUnwindSafe(|| work.as_mut().poll(context))) {
        Ok(Poll::Ready(outcome)) => Poll::Ready(Ok(outcome)),
        Ok(Poll::Pending) => Poll::Pending,
        Err(panic) => Poll::Ready(Err(panic)),
    });
    let outcome = outcome.await;
    drop(work);
    outcome
}

/// Like [`with_followed_board`], with all frames that pass the port from its opening on.
pub(crate) async fn with_tapped_board<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, &mut Frames) -> Result<T, Failure>,
) -> Result<(T, Frames), Failure> {
    let (tapping, mut frames) = Tapping::new();
    let wrap: Wrap = Arc::new(move |io| Box::new(tapping.tap(io)));
    let (gimbal, _) = tokio::select! {
        biased;
        signal = signals::stopped() => return Err(Failure::Signal(signal)),
        connected = connect(global, Reconnect::Within(FOLLOWED), Some(wrap)) => connected?,
    };
    let outcome = work(gimbal.clone(), &mut frames).await;
    gimbal.close().await;
    Ok((outcome?, frames))
}

/// Opens the port and makes sure that a board responds. `wrap` may put something between port and driver.
async fn connect(
    global: &Global,
    reconnect: Reconnect,
    wrap: Option<Wrap>,
) -> Result<(Gimbal, BoardInfo), Failure> {
    let address = address(global)?;
    tracing::info!("opening {address}");
    let options = ConnectOptions { reconnect, ..global.connect_options() };
    let gimbal = Gimbal::connect_through(&address, options, wrap).await?;
    let info = gimbal.found().map(|found| found.board.clone());
    Ok((gimbal, info.ok_or(sbgc_host::Error::Closed)?))
}

/// Where the board is: as given, or the only port that is likely to be one.
pub(crate) fn address(global: &Global) -> Result<Address, Failure> {
    if let Some(port) = &global.port {
        return port.parse().map_err(|error: sbgc_host::Error| Failure::Usage(format!("--port: {error}")));
    }
    let ports = ports();
    let likely: Vec<_> = ports.iter().filter(|port| port.kind == PortKind::Usb).collect();
    match (likely.as_slice(), ports.as_slice()) {
        ([port], _) => Ok(Address::Serial(port.name.clone())),
        ([], []) => Err(Failure::Usage(String::from(
            "no serial port found; set --port or SBGC_PORT, or try --port sim",
        ))),
        _ => {
            let names: Vec<_> = ports.iter().map(|port| format!("  {port}")).collect();
            let names = names.join("\n");
            Err(Failure::Usage(format!(
                "cannot tell which port is the board; choose one with --port:\n{names}"
            )))
        }
    }
}
