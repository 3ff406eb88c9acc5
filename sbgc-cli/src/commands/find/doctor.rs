//! `sbgc doctor`: why nothing works, and what to do about it.

use std::ops::ControlFlow;

use clap::Args;
use sbgc_host::connect::{Foreign, recognise, survey};
use sbgc_host::gimbal::Found;
use sbgc_host::transport::{Address, Line, ports};
use sbgc_host::{ConnectOptions, Error, Gimbal, Reconnect};
use sbgc_proto::commands::{RealtimeData3, RealtimeData3Request};
use sbgc_proto::frame::Version;
use sbgc_proto::reflect::{self, Leaf};
use serde_json::json;

use super::ports::is_likely;
use super::probe::{listen, parity_name, scope};
use crate::failure::{Failure, permission_hint};
use crate::options::{Baud, Global};
use crate::output::Output;
use crate::{connect, fields, signals, text};

const EXAMPLES: &str = "Examples:
  sbgc doctor
  sbgc doctor --json";

/// Find out why nothing works
///
/// Looks at ports, permissions, other programs, rates, power and the board's own errors, and suggests remedies. Ends
/// with 0 when all is well, else with the exit code of the worst finding.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Doctor {}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Severity {
    Ok,
    Warning,
    Error,
}

impl Severity {
    const fn as_str(self) -> &'static str {
        match self {
            Severity::Ok => "ok",
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// One thing that was looked at.
struct Finding {
    name: &'static str,
    severity: Severity,
    port: Option<String>,
    message: String,
    remedy: Option<String>,
    /// The exit code that it stands for.
    code: u8,
}

/// What was found, printed as it is found.
struct Findings<'o> {
    output: &'o mut Output,
    port: Option<String>,
    worst: u8,
}

impl Findings<'_> {
    fn ok(&mut self, finding: &'static str, message: String) -> Result<(), Failure> {
        self.add(finding, Severity::Ok, message, None, 0)
    }

    fn warning(&mut self, finding: &'static str, message: String, remedy: &str) -> Result<(), Failure> {
        self.add(finding, Severity::Warning, message, Some(remedy.into()), 0)
    }

    fn error(
        &mut self,
        finding: &'static str,
        message: String,
        remedy: impl Into<String>,
        code: u8,
    ) -> Result<(), Failure> {
        self.add(finding, Severity::Error, message, Some(remedy.into()), code)
    }

    fn add(
        &mut self,
        finding: &'static str,
        severity: Severity,
        message: String,
        remedy: Option<String>,
        code: u8,
    ) -> Result<(), Failure> {
        let finding = Finding { name: finding, severity, port: self.port.clone(), message, remedy, code };
        self.worst = self.worst.max(finding.code);
        finding.print(self.output)?;
        self.output.flush()?;
        Ok(())
    }
}

impl Finding {
    fn print(&self, output: &mut Output) -> Result<(), Failure> {
        if output.is_json() {
            output.object(&json!({
                "finding": self.name,
                "severity": self.severity.as_str(),
                "port": self.port,
                "message": self.message,
                "remedy": self.remedy,
            }))?;
            return Ok(());
        }
        let word = self.severity.as_str();
        let color = match self.severity {
            Severity::Ok => "32",
            Severity::Warning => "33",
            Severity::Error => "31",
        };
        let shown =
            if output.is_colored() { format!("\u{1B}[{color}m{word}\u{1B}[0m") } else { word.to_owned() };
        let pad = " ".repeat(9_usize.saturating_sub(word.len()));
        let width = text::width().saturating_sub(9).max(20);
        let message = text::escape_lines(&self.message);
        let remedy = self.remedy.as_deref().map(text::escape_lines).unwrap_or_default();
        let mut lines = message.lines().chain(remedy.lines()).flat_map(|line| text::wrap(line, width));
        output.line(format_args!("{shown}{pad}{}", lines.next().unwrap_or_default()))?;
        for line in lines {
            output.line(format_args!("{:9}{line}", ""))?;
        }
        Ok(())
    }
}

impl Doctor {
    #[allow(clippy::unused_self, reason = "commands are alike")]
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let mut findings = Findings { output, port: None, worst: 0 };
        tokio::select! {
            biased;
            signal = signals::stopped() => return Err(Failure::Signal(signal)),
            examined = examine(global, &mut findings) => examined?,
        }
        match findings.worst {
            0 => Ok(()),
            code => Err(Failure::Found(code)),
        }
    }
}

async fn examine(global: &Global, findings: &mut Findings<'_>) -> Result<(), Failure> {
    let Some(address) = choose(global, findings)? else { return Ok(()) };
    findings.port = Some(address.to_string());
    let mut tried = Vec::new();
    survey(&address, scope(global), |report| {
        let ends = report.outcome.is_ok();
        tried.push(report);
        if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
    .await;
    let line = tried.first().and_then(|first| first.line).unwrap_or_default();
    let (mut heard, mut foreign) = (0, None);
    for (index, report) in tried.into_iter().enumerate() {
        let skipped = report.counters.received.skipped();
        let hopeless = report.is_hopeless();
        foreign = foreign.or(report.foreign());
        match report.outcome {
            Ok(found) => {
                rate(global, findings, &found)?;
                return board(global, &address, &found, skipped, findings).await;
            }
            Err(error) if hopeless => return cannot_open(&error, findings),
            Err(_) if index == 0 => findings.ok("port", format!("{address} can be opened"))?,
            Err(_) => {}
        }
        heard += skipped;
    }
    silence(&address, line, heard, foreign, findings).await
}

/// The port to look at; says so when there is none.
fn choose(global: &Global, findings: &mut Findings<'_>) -> Result<Option<Address>, Failure> {
    let ports = ports();
    let likely: Vec<_> = ports.iter().filter(|port| is_likely(port)).map(ToString::to_string).collect();
    if !ports.is_empty() {
        let names: Vec<_> = ports.iter().map(ToString::to_string).collect();
        findings.ok("ports", format!("serial ports: {}", names.join(", ")))?;
    }
    match connect::address(global) {
        Ok(address) => Ok(Some(address)),
        Err(failure) if global.port.is_some() => Err(failure),
        Err(_) if ports.is_empty() => {
            findings.error(
                "no_port",
                String::from("no serial port found"),
                "Plug the board in by USB, and use a cable that carries data, not charging cables. For a serial bridge or a \
                 UART of this computer, set --port.",
                1,
            )?;
            Ok(None)
        }
        Err(_) => {
            let which = if likely.is_empty() {
                "no port is a USB serial device"
            } else {
                "several ports may be the board"
            };
            findings.error(
                "several_ports",
                which.into(),
                "Choose one with --port, or try them all with `sbgc detect`.",
                2,
            )?;
            Ok(None)
        }
    }
}

fn cannot_open(error: &Error, findings: &mut Findings<'_>) -> Result<(), Failure> {
    let (finding, remedy) = match error {
        Error::PermissionDenied { path, group } => (
            "permission",
            permission_hint(path, group.as_deref())
                .unwrap_or_else(|| String::from("Ask the owner of the device for access.")),
        ),
        Error::PortBusy { .. } => (
            "busy",
            String::from(
                "Close the other program: the vendor's GUI, another sbgc, ModemManager, a terminal program. \
                 `fuser DEVICE` shows which one it is.",
            ),
        ),
        Error::NoSuchPort { .. } => {
            ("missing", String::from("Check the name with `sbgc ports`, and that the board is plugged in."))
        }
        _ => ("cannot_open", String::from("Check the address, the cable, and that the other side runs.")),
    };
    findings.error(finding, error.to_string(), remedy, 1)
}

/// Whether the board responds with the settings in use.
fn rate(global: &Global, findings: &mut Findings<'_>, found: &Found) -> Result<(), Failure> {
    let (board, firmware) = (found.board.board_ver.number(), found.board.firmware_ver);
    let version = found.version.number();
    let answers = format!("board {board}, firmware {firmware} responds in protocol version {version}");
    let Some(line) = found.line else { return findings.ok("board", answers) };
    let at = format!("{answers} at {} baud, parity {}", line.baud, parity_name(line.parity));
    match global.baud {
        Baud::Rate(rate) if rate != line.baud => findings.error(
            "rate",
            format!("{at}, not at {rate} baud"),
            format!("Use --baud {}, or set it in the configuration file.", line.baud),
            3,
        ),
        _ => findings.ok("board", at),
    }
}

/// Why no board responds on a port that can be opened.
async fn silence(
    address: &Address,
    line: Line,
    heard: u64,
    foreign: Option<Foreign>,
    findings: &mut Findings<'_>,
) -> Result<(), Failure> {
    let bytes = listen(address, line).await;
    if let Some(name) = foreign.or_else(|| recognise(&bytes)) {
        return findings.error(
            "protocol",
            format!("{address} sends {name}, not the SimpleBGC protocol"),
            "Check that this is the board's port, and how the port is set up in the board's parameters.",
            3,
        );
    }
    let count = heard + u64::try_from(bytes.len()).unwrap_or_default();
    if count > 0 {
        return findings.error(
            "noise",
            format!("{address} sends bytes ({count}), but no frames at any rate that was tried"),
            "The rate may be unusual (set --baud), the ground wire may be missing, or this is another device.",
            3,
        );
    }
    findings.error(
        "silent",
        format!("{address} can be opened, but nothing answers at any rate, parity or version that was tried"),
        "Check that the board has power (USB alone does not power every board; its LED shows it), that RX and TX are \
         crossed, and that this is the right port. A board in boot mode answers nothing: power it off and on.",
        3,
    )
}

/// What the board itself has to say.
async fn board(
    global: &Global,
    address: &Address,
    found: &Found,
    skipped: u64,
    findings: &mut Findings<'_>,
) -> Result<(), Failure> {
    if found.version == Version::V1 {
        findings.warning(
            "version",
            String::from("the board responds in protocol version 1 only, whose checksum misses some errors"),
            "Firmware 2.68 and later knows version 2.",
        )?;
    }
    if skipped > 0 {
        findings.warning(
            "link",
            format!("{skipped} received bytes belong to no frame"),
            "Check cable, ground and rate; data that others had subscribed to looks like this, too.",
        )?;
    }
    let (baud, parity) = (found.line.map(|line| line.baud), found.line.map(|line| line.parity));
    let options = ConnectOptions { baud, parity, reconnect: Reconnect::Never, ..global.connect_options() };
    let state = match Gimbal::connect_with(address, options).await {
        Ok(gimbal) => {
            let state = gimbal.request(&RealtimeData3Request {}).await;
            gimbal.close().await;
            state
        }
        Err(error) => Err(error),
    };
    match state {
        Ok(state) => condition(&state, findings),
        Err(error) => findings.error(
            "state",
            format!("the board responds, but does not report its state: {error}"),
            "Try again; `sbgc -vv info` shows every frame.",
            3,
        ),
    }
}

/// The least voltage that a battery for motors has: two cells, empty.
const NO_BATTERY: f32 = 5.5;

fn condition(state: &RealtimeData3, findings: &mut Findings<'_>) -> Result<(), Failure> {
    let volts = state.bat_level.volts();
    if volts < NO_BATTERY {
        findings.warning(
            "power",
            format!("no battery: {volts:.2} V; motors cannot run from USB"),
            "Connect the battery, and check its polarity and the fuse.",
        )?;
    } else {
        findings.ok("power", format!("battery: {volts:.2} V"))?;
    }
    let mut errors = None;
    reflect::walk(state, &mut |leaf: &Leaf<'_>| {
        if leaf.path.to_string() == "system_error" {
            errors = Some(fields::value_text(leaf));
        }
    });
    let (errors, any) = (errors.unwrap_or_default(), !state.system_error.is_empty());
    if any {
        findings.warning(
            "errors",
            format!("the board reports errors: {errors}"),
            "See the manual of the board for these errors; sensors and calibration are the usual causes.",
        )?;
    } else {
        findings.ok("errors", String::from("the board reports no errors"))?;
    }
    if state.i2c_error_count > 0 {
        findings.warning(
            "i2c",
            format!("{} errors on the bus of the sensors since the start", state.i2c_error_count),
            "Check the cable to the IMU: shorter, twisted, away from motor wires, with a ferrite or a filter.",
        )?;
    }
    if state.serial_err_cnt > 0 {
        findings.warning(
            "serial",
            format!("the board has received {} broken messages since the start", state.serial_err_cnt),
            "Check cable and ground, or use a lower rate.",
        )?;
    }
    Ok(())
}
