//! From the shared options to a gimbal that responds.

use std::future::poll_fn;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::task::Poll;

use sbgc_host::capture::{Frames, tap};
use sbgc_host::transport::{self, Address, Io, Line, PortKind, ports};
use sbgc_host::{Gimbal, Options, VersionChoice};
use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;

use crate::failure::{Failure, NoBoard};
use crate::options::{Baud, Global, Parity, Protocol};
use crate::signals;

/// Opens the port, makes sure that a board responds, and does `work` with it.
///
/// A signal ends the work by dropping it. However it ends, streams are unregistered and the port is closed.
pub(crate) async fn with_board<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    with_board_to_the_end(global, async |gimbal, info| {
        tokio::select! {
            biased;
            signal = signals::stopped() => Err(Failure::Signal(signal)),
            outcome = work(gimbal, info) => outcome,
        }
    })
    .await
}

/// Like [`with_board`], but a signal does not end the work: it looks for [`signals::stopped`] itself.
pub(crate) async fn with_board_to_the_end<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let (gimbal, info) = tokio::select! {
        biased;
        signal = signals::stopped() => return Err(Failure::Signal(signal)),
        connected = connect(global, |io| io) => connected?,
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

/// Like [`with_board`], with all frames that pass the port from its opening on.
pub(crate) async fn with_tapped_board<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, &mut Frames) -> Result<T, Failure>,
) -> Result<(T, Frames), Failure> {
    let mut tapped = None;
    let (gimbal, _) = tokio::select! {
        biased;
        signal = signals::stopped() => return Err(Failure::Signal(signal)),
        connected = connect(global, |io| {
            let (io, frames) = tap(io);
            tapped = Some(frames);
            Box::new(io)
        }) => connected?,
    };
    let Some(mut frames) = tapped else { return Err(sbgc_host::Error::Closed.into()) };
    let outcome = work(gimbal.clone(), &mut frames).await;
    gimbal.close().await;
    Ok((outcome?, frames))
}

/// Opens the port and makes sure that a board responds. `wrap` may put something between port and driver.
async fn connect(global: &Global, mut wrap: impl FnMut(Io) -> Io) -> Result<(Gimbal, BoardInfo), Failure> {
    let address = address(global)?;
    let mut failed = None;
    for line in lines(global, &address) {
        tracing::info!("opening {address}");
        let options = Options {
            version: match global.protocol {
                Protocol::Auto => VersionChoice::Auto,
                Protocol::V1 => VersionChoice::Only(Version::V1),
                Protocol::V2 => VersionChoice::Only(Version::V2),
            },
            timeout: global.timeout,
            baud: address.baud(line),
            ..Options::default()
        };
        let gimbal = Gimbal::spawn(wrap(address.open(line).await?), options);
        let error = match gimbal.handshake().await {
            Ok(info) => return Ok((gimbal, info)),
            Err(error) => error,
        };
        gimbal.close().await;
        match error {
            source @ sbgc_host::Error::Timeout { .. } => failed = Some(source),
            error => return Err(error.into()),
        }
    }
    let source = failed.unwrap_or(sbgc_host::Error::Closed);
    let place = match (&address, global.baud) {
        (Address::Serial(_), Baud::Rate(baud)) => format!("{address} at {baud} baud"),
        _ => address.to_string(),
    };
    let tried = match global.protocol {
        Protocol::Auto => "versions 2 and 1",
        Protocol::V1 => "version 1",
        Protocol::V2 => "version 2",
    };
    let hint = match global.protocol {
        Protocol::Auto => "",
        Protocol::V1 => {
            "A board that has seen version 2 takes nothing else until it restarts: omit --protocol. "
        }
        Protocol::V2 => "Firmware before 2.68 knows version 1 only: omit --protocol. ",
    };
    Err(Failure::NoBoard(Box::new(NoBoard { place, tried, hint, source })))
}

/// The settings of the line to try, most likely first.
fn lines(global: &Global, address: &Address) -> Vec<Line> {
    let serial = matches!(address, Address::Serial(_));
    let rates = match global.baud {
        Baud::Auto if serial => Line::BAUDS.to_vec(),
        Baud::Auto => vec![Line::default().baud],
        Baud::Rate(rate) => vec![rate],
    };
    let parities = match global.parity {
        Parity::Auto if serial => vec![transport::Parity::None, transport::Parity::Even],
        Parity::Even => vec![transport::Parity::Even],
        Parity::None | Parity::Auto => vec![transport::Parity::None],
    };
    let of_rate = |baud: u32| parities.iter().map(move |&parity| Line { baud, parity });
    rates.into_iter().flat_map(of_rate).collect()
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
