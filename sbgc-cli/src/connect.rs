//! From the shared arguments to a gimbal that answers.

use sbgc_host::transport::{Address, Line, PortKind, ports};
use sbgc_host::{Gimbal, Options, VersionChoice};
use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;

use crate::args::{Global, Protocol};
use crate::failure::Failure;

/// Opens the port and makes sure that a board answers.
pub(crate) async fn connect(global: &Global) -> Result<(Gimbal, BoardInfo), Failure> {
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
    let io = match address.open(line).await {
        Err(sbgc_host::Error::Io(source)) => {
            return Err(Failure::File { place: address.to_string(), source });
        }
        opened => opened?,
    };
    let gimbal = Gimbal::spawn(io, options);
    let info = gimbal.handshake().await?;
    tracing::info!("board {}, firmware {}", info.board_ver.number(), info.firmware_ver);
    Ok((gimbal, info))
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
