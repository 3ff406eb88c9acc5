//! `sbgc detect`: which ports have a board, and how it is reached.

use clap::Args;
use sbgc_host::Error;
use sbgc_host::transport::{Address, ports};
use serde_json::json;
use tokio::task::JoinSet;

use super::probe::{Found, Scope, parity_name};
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{signals, text};

const EXAMPLES: &str = "Examples:
  sbgc detect
  sbgc detect --baud 115200 --json";

/// Try all ports, rates, parities and protocol versions
///
/// Options narrow what is tried: --port, --baud, --parity, --protocol, --timeout. Ends with 0 when a board was found, else
/// with 3.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Detect {}

/// What was found out about a port.
struct Tried {
    port: String,
    outcome: Result<Found, String>,
}

impl Detect {
    #[allow(clippy::unused_self, reason = "commands are alike")]
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let addresses = match &global.port {
            Some(port) => {
                vec![port.parse().map_err(|error: Error| Failure::Usage(format!("--port: {error}")))?]
            }
            None => ports().into_iter().map(|port| Address::Serial(port.name)).collect::<Vec<_>>(),
        };
        let scope = Scope::of(global);
        let mut all = JoinSet::new();
        for address in addresses {
            all.spawn(try_port(address, scope.clone()));
        }
        let mut found = 0;
        loop {
            let tried = tokio::select! {
                biased;
                signal = signals::stopped() => return Err(Failure::Signal(signal)),
                tried = all.join_next() => match tried {
                    Some(Ok(tried)) => tried,
                    Some(Err(error)) => return Err(Failure::Failed(error.to_string())),
                    None => break,
                },
            };
            found += usize::from(tried.outcome.is_ok());
            tried.print(output)?;
            output.flush()?;
        }
        if found == 0 {
            let hint = "`sbgc doctor` looks for the cause";
            return Err(Failure::NotFound(format!("no board found; {hint}")));
        }
        Ok(())
    }
}

async fn try_port(address: Address, scope: Scope) -> Tried {
    let port = address.to_string();
    let (mut silent, mut noisy) = (Vec::new(), Vec::new());
    for line in scope.lines(&address) {
        match scope.probe(&address, line).await {
            Ok(found) => return Tried { port, outcome: Ok(found) },
            Err((Error::Timeout { .. }, counters)) => {
                let place = format!("{} baud, parity {}", line.baud, parity_name(line.parity));
                let bytes = counters.received.skipped();
                if bytes > 0 {
                    noisy.push(format!("{bytes} bytes that are not frames at {place}"));
                } else if !silent.contains(&line.baud) {
                    silent.push(line.baud);
                }
            }
            Err((error, _)) => return Tried { port, outcome: Err(error.to_string()) },
        }
    }
    let rates: Vec<_> = silent.iter().map(ToString::to_string).collect();
    let reason = match (&address, noisy.is_empty()) {
        (_, false) => format!("received {}", noisy.join("; ")),
        (Address::Serial(_), _) => format!("no answer at {} baud", rates.join(", ")),
        _ => String::from("no answer"),
    };
    Tried { port, outcome: Err(reason) }
}

impl Tried {
    fn print(&self, output: &mut Output) -> Result<(), Failure> {
        let port = &self.port;
        if output.is_json() {
            output.object(&match &self.outcome {
                Ok(found) => json!({
                    "port": port,
                    "baud": found.line.map(|line| line.baud),
                    "parity": found.line.map(|line| parity_name(line.parity)),
                    "protocol": found.version.number(),
                    "found": true,
                    "firmware": found.info.firmware_ver.to_string(),
                    "reason": null,
                }),
                Err(reason) => json!({
                    "port": port, "baud": null, "parity": null, "protocol": null,
                    "found": false, "firmware": null, "reason": reason,
                }),
            })?;
            return Ok(());
        }
        let port = text::escape(port);
        output.line(match &self.outcome {
            Ok(found) => {
                let line = found.line.map_or_else(String::new, |line| {
                    format!(" at {} baud, parity {}", line.baud, parity_name(line.parity))
                });
                let (board, firmware) = (found.info.board_ver.number(), found.info.firmware_ver);
                let version = found.version.number();
                format!("{port}: board {board}, firmware {firmware}{line}, protocol version {version}")
            }
            Err(reason) => format!("{port}: {}", text::escape_lines(reason)),
        })?;
        Ok(())
    }
}
