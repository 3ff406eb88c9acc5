//! `sbgc detect`: which ports have a board, and how it is reached.

use std::ops::ControlFlow;

use clap::Args;
use sbgc_host::connect::survey;
use sbgc_host::gimbal::Found;
use sbgc_host::transport::{Address, Line, Parity, ports};
use sbgc_host::{ConnectOptions, Error};
use serde_json::json;
use tokio::sync::mpsc::{self, UnboundedSender};
use tokio::task::JoinSet;

use super::probe::{parity_name, scope, versions};
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{signals, text};

const EXAMPLES: &str = "Examples:
  sbgc detect
  sbgc detect --baud 115200 --json";

/// Find boards on all ports, at all rates
///
/// Tries all rates, parities and protocol versions, prints every combination that a board answers, and why a port has none. A board on USB may answer at every rate.
/// Options narrow what is tried: --port, --baud, --parity, --protocol, --timeout. Ends with 0 when a board was found,
/// else with 3.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Detect {}

/// Something found out about a port.
struct Tried {
    port: String,
    outcome: Outcome,
}

enum Outcome {
    /// A combination that a board answered, and whether it is the first of the port.
    Answered(Box<Found>, bool),
    /// Why no combination was answered.
    Nothing(String),
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
        let scope = scope(global);
        let (report, mut reports) = mpsc::unbounded_channel();
        let mut all = JoinSet::new();
        for address in addresses {
            all.spawn(try_port(address, scope, report.clone()));
        }
        drop(report);
        let mut found = false;
        loop {
            let tried = tokio::select! {
                biased;
                signal = signals::stopped() => return Err(Failure::Signal(signal)),
                tried = reports.recv() => match tried {
                    Some(tried) => tried,
                    None => break,
                },
            };
            found |= matches!(tried.outcome, Outcome::Answered(..));
            tried.print(output)?;
            output.flush()?;
        }
        if !found {
            let hint = "`sbgc doctor` looks for the cause";
            return Err(Failure::NotFound(format!("no board found; {hint}")));
        }
        Ok(())
    }
}

/// Tries all combinations of a port and reports those that are answered, or why none is.
async fn try_port(address: Address, scope: ConnectOptions, report: UnboundedSender<Tried>) {
    let say = |outcome| {
        // Nobody listens any more once the program is to stop.
        let _ = report.send(Tried { port: address.to_string(), outcome });
    };
    let mut silence = Silence::default();
    let mut answered = false;
    survey(&address, scope, |tried| {
        let hopeless = tried.is_hopeless();
        match tried.outcome {
            Ok(found) => {
                say(Outcome::Answered(Box::new(found), !answered));
                answered = true;
            }
            // It cannot be opened, so other rates are of no help.
            Err(error) if hopeless && !answered => {
                say(Outcome::Nothing(error.to_string()));
                answered = true;
            }
            Err(_) => silence.note(tried.line.unwrap_or_default(), tried.counters.received.skipped()),
        }
        ControlFlow::Continue(())
    })
    .await;
    if !answered {
        say(Outcome::Nothing(silence.reason(&address, &scope)));
    }
}

/// What was tried in vain.
#[derive(Default)]
struct Silence {
    lines: Vec<Line>,
    noise: Vec<String>,
}

impl Silence {
    fn note(&mut self, line: Line, skipped: u64) {
        if skipped > 0 {
            self.noise.push(format!("{skipped} bytes that are not frames at {}", line_text(line)));
        } else {
            self.lines.push(line);
        }
    }

    fn reason(&self, address: &Address, scope: &ConnectOptions) -> String {
        let tried = versions(scope);
        let mut reasons = Vec::new();
        if !self.noise.is_empty() {
            reasons.push(format!("received {}", self.noise.join("; ")));
        }
        if !matches!(address, Address::Serial(_)) && !self.lines.is_empty() {
            reasons.push(format!("no answer (tried {tried})"));
        } else if !self.lines.is_empty() {
            let mut by_parity: Vec<(Parity, Vec<String>)> = Vec::new();
            for line in &self.lines {
                match by_parity.iter_mut().find(|(parity, _)| *parity == line.parity) {
                    Some((_, rates)) => rates.push(line.baud.to_string()),
                    None => by_parity.push((line.parity, vec![line.baud.to_string()])),
                }
            }
            // Mostly the same rates were tried with each parity.
            let places = match by_parity.as_slice() {
                [(one, rates), (other, same)] if rates == same => {
                    let (one, other) = (parity_name(*one), parity_name(*other));
                    format!("{} baud, parity {one} and {other}", rates.join(", "))
                }
                several => {
                    let place = |(parity, rates): &(Parity, Vec<String>)| {
                        format!("{} baud, parity {}", rates.join(", "), parity_name(*parity))
                    };
                    several.iter().map(place).collect::<Vec<_>>().join("; ")
                }
            };
            reasons.push(format!("no answer at {places} (tried {tried})"));
        }
        reasons.join("; ")
    }
}

/// A serial line in words.
fn line_text(line: Line) -> String {
    format!("{} baud, parity {}", line.baud, parity_name(line.parity))
}

impl Tried {
    fn print(&self, output: &mut Output) -> Result<(), Failure> {
        let port = &self.port;
        if output.is_json() {
            output.object(&match &self.outcome {
                Outcome::Answered(found, _) => json!({
                    "port": port,
                    "baud": found.line.map(|line| line.baud),
                    "parity": found.line.map(|line| parity_name(line.parity)),
                    "protocol": found.version.number(),
                    "found": true,
                    "firmware": found.board.firmware_ver.to_string(),
                    "reason": null,
                }),
                Outcome::Nothing(reason) => json!({
                    "port": port, "baud": null, "parity": null, "protocol": null,
                    "found": false, "firmware": null, "reason": reason,
                }),
            })?;
            return Ok(());
        }
        let port = text::escape(port);
        output.line(match &self.outcome {
            Outcome::Answered(found, first) => {
                let line = found.line.map_or_else(String::new, |line| format!(" at {}", line_text(line)));
                let version = found.version.number();
                if *first {
                    let (board, firmware) = (found.board.board_ver.number(), found.board.firmware_ver);
                    format!("{port}: board {board:.1}, firmware {firmware}{line}, protocol version {version}")
                } else {
                    format!("{port}: also{line}, protocol version {version}")
                }
            }
            Outcome::Nothing(reason) => format!("{port}: {}", text::escape_lines(reason)),
        })?;
        Ok(())
    }
}
