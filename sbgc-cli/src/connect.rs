//! From the shared arguments to a gimbal that answers.

use sbgc_host::transport::{Address, Line, PortKind, ports};
use sbgc_host::{Gimbal, Options, VersionChoice};
use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;

use crate::args::{Global, Protocol};
use crate::failure::Failure;

/// Opens the port, makes sure that a board answers, and does `work` with it.
///
/// However that ends, the streams are taken from the board and the port is given back.
pub(crate) async fn with_board<T>(
    global: &Global,
    work: impl AsyncFnOnce(Gimbal, BoardInfo) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let address = address(global)?;
    tracing::info!("opening {address}");
    let line = Line { baud: global.baud, ..Line::default() };
    let options = Options {
        version: match global.protocol {
            Protocol::Auto => VersionChoice::Auto,
            Protocol::V1 => VersionChoice::Only(Version::V1),
            Protocol::V2 => VersionChoice::Only(Version::V2),
        },
        timeout: global.timeout(),
        baud: address.baud(line),
        ..Options::default()
    };
    let gimbal = Gimbal::spawn(address.open(line).await?, options);
    let outcome = match gimbal.handshake().await {
        Ok(info) => {
            let version = gimbal.version().number();
            let (board, firmware) = (info.board_ver.number(), info.firmware_ver);
            tracing::info!("board {board}, firmware {firmware}, talking in version {version}");
            work(gimbal.clone(), info).await
        }
        Err(source @ sbgc_host::Error::Timeout { .. }) => {
            let place = match options.baud {
                Some(baud) => format!("{address} at {baud} baud"),
                None => address.to_string(),
            };
            Err(Failure::NoBoard { place, protocol: global.protocol, source })
        }
        Err(error) => Err(error.into()),
    };
    let counters = gimbal.clone();
    gimbal.close().await;
    tracing::info!("{}", counters.counters());
    outcome
}

fn address(global: &Global) -> Result<Address, Failure> {
    if let Some(port) = &global.port {
        return port.parse().map_err(|error: sbgc_host::Error| Failure::Usage(format!("--port: {error}")));
    }
    let ports = ports();
    let likely: Vec<_> = ports.iter().filter(|port| port.kind == PortKind::Usb).collect();
    match (likely.as_slice(), ports.as_slice()) {
        ([port], _) => Ok(Address::Serial(port.name.clone())),
        ([], []) => Err(Failure::Usage(String::from(
            "there is no serial port; say where the board is with --port or SBGC_PORT, or try --port sim",
        ))),
        _ => {
            let names: Vec<_> = ports.iter().map(|port| format!("  {port}")).collect();
            let names = names.join("\n");
            Err(Failure::Usage(format!(
                "no single port looks like the board; choose one with --port:\n{names}"
            )))
        }
    }
}
