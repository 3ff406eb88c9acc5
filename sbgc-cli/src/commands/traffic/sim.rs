//! `sbgc sim`: a simulated board for other programs.

use std::io;
use std::path::PathBuf;
use std::pin::Pin;

use clap::{ArgGroup, Args, ValueEnum};
use sbgc_host::proto::units::FirmwareVersion;
use sbgc_host::sim::{self, Board, Config, Fault, SharedBoard, StateFile};
#[cfg(unix)]
use sbgc_host::sim::{LineRate, Pty};
use serde_json::json;
use tokio::net::TcpListener;

use crate::failure::{Failure, until_stopped};
use crate::output::Output;
use crate::signals::stopped;

type Serving = Pin<Box<dyn Future<Output = io::Result<()>>>>;

const EXAMPLES: &str = "Examples:
  sbgc sim --pty --link /tmp/gimbal
  sbgc sim --tcp 127.0.0.1:4001 --fault drop=0.01 --fault unplug=5s/2s
  sbgc sim --pty --state gimbal.state --firmware 2.68

Faults: corrupt, drop and duplicate take a probability, delay a time, for frames
to the host; with :in (drop:in=0.01) for frames to the board. reset=5s,
unplug=5s/2s and stall=5s/1s count from the start. no-confirm, low-battery and
sensor take no value.";

/// Serve a simulated board
///
/// Prints the port on the first line, then runs until stopped.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
#[command(group = ArgGroup::new("place").required(true).args(["pty", "tcp"]))]
pub(crate) struct Sim {
    /// Serve on a pseudo-terminal
    #[arg(long)]
    pty: bool,

    /// Create this symbolic link to the pseudo-terminal
    #[arg(long, requires = "pty", conflicts_with = "tcp", value_name = "PATH")]
    link: Option<PathBuf>,

    /// Serve on this address, e.g. 127.0.0.1:4001; port 0 picks a free port
    #[arg(long, value_name = "HOST:PORT", value_parser = host_and_port)]
    tcp: Option<String>,

    /// Give all TCP clients the same board instead of one each [implied by --state]
    #[arg(long, requires = "tcp", conflicts_with = "pty")]
    shared: bool,

    /// Bit rate of the board's line, or `any`; a client with another rate gets garbage
    #[arg(long = "line", value_name = "RATE", default_value = "115200", value_parser = line)]
    rate: Rate,

    /// Keep parameters, files and calibrations in this file
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,

    /// Behave as this firmware
    #[arg(long, value_enum, default_value = "2.73")]
    firmware: Firmware,

    /// Seed of sensor noise and random faults
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,

    /// Inject a fault; may be repeated
    #[arg(long = "fault", value_name = "KIND[=VALUE]")]
    faults: Vec<Fault>,
}

/// What the board behaves as.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Firmware {
    #[value(name = "2.68")]
    V2_68,
    #[value(name = "2.73")]
    V2_73,
}

/// The bit rate of the line; `None` for any.
type Rate = Option<u32>;

fn line(text: &str) -> Result<Rate, String> {
    if text == "any" {
        return Ok(None);
    }
    let rate = text.parse().ok().filter(|rate| (300..=4_000_000).contains(rate));
    rate.map(Some).ok_or_else(|| String::from("expected a bit rate of 300 to 4000000, or `any`"))
}

pub(super) fn host_and_port(text: &str) -> Result<String, String> {
    let wanted = || String::from("expected HOST:PORT, e.g. 127.0.0.1:4001");
    let (host, port) = text.rsplit_once(':').ok_or_else(wanted)?;
    if host.is_empty() || port.parse::<u16>().is_err() {
        return Err(wanted());
    }
    Ok(text.to_owned())
}

impl Sim {
    pub(crate) async fn run(self, output: &mut Output) -> Result<(), Failure> {
        let place = match (&self.tcp, &self.link) {
            (Some(address), _) => format!("tcp://{address}"),
            (None, Some(link)) => link.display().to_string(),
            (None, None) => String::from("pseudo-terminal"),
        };
        let failed = |source| Failure::File { place: place.clone(), source };
        let serving: Serving = match &self.tcp {
            Some(address) => {
                // The state is looked at first: what cannot be used is not served.
                let one = if self.shared || self.state.is_some() { Some(self.board()?) } else { None };
                let listener = TcpListener::bind(address).await.map_err(failed)?;
                let bound = listener.local_addr().map_err(failed)?;
                announce(output, &format!("tcp://{bound}"))?;
                match one {
                    Some(board) => Box::pin(sim::serve_shared_tcp(board, listener)),
                    None => Box::pin(sim::serve_tcp(self.config(), listener)),
                }
            }
            None => self.on_terminal(output, failed)?,
        };
        tokio::select! {
            served = serving => served.map_err(failed)?,
            // Whatever ends the program, the link to the terminal goes with it.
            signal = stopped() => return until_stopped(Err(Failure::Signal(signal))),
        }
        Ok(())
    }

    fn config(&self) -> Config {
        let default = Config::default();
        Config {
            firmware: match self.firmware {
                Firmware::V2_68 => FirmwareVersion::new(2, 68, 9),
                Firmware::V2_73 => default.firmware,
            },
            bit_rate: self.rate,
            seed: self.seed,
            faults: self.faults.clone(),
            ..default
        }
    }

    /// The board, with its state if it has one.
    fn board(&self) -> Result<SharedBoard, Failure> {
        let Some(path) = &self.state else { return Ok(SharedBoard::new(Board::new(self.config()))) };
        let failed = |source| Failure::File { place: path.display().to_string(), source };
        let (state, board) = StateFile::open(path, &self.config()).map_err(failed)?;
        Ok(SharedBoard::with_state(board, state))
    }

    #[cfg(unix)]
    fn on_terminal(
        &self,
        output: &mut Output,
        failed: impl Fn(io::Error) -> Failure,
    ) -> Result<Serving, Failure> {
        let board = self.board()?;
        let line = self.rate.map_or(LineRate::Any, LineRate::Only);
        let mut terminal = Pty::open(self.link.as_deref(), line).map_err(failed)?;
        announce(output, &terminal.link().unwrap_or(terminal.path()).display().to_string())?;
        Ok(Box::pin(async move { terminal.serve(&board).await }))
    }

    #[cfg(not(unix))]
    fn on_terminal(&self, _: &mut Output, _: impl Fn(io::Error) -> Failure) -> Result<Serving, Failure> {
        Err(Failure::Usage(String::from("there are no pseudo-terminals on this system; use --tcp")))
    }
}

/// The first line says where the board is; whoever starts the program waits for it.
fn announce(output: &mut Output, place: &str) -> io::Result<()> {
    if output.is_json() {
        output.object(&json!({ "port": place }))?;
    } else {
        output.line(place)?;
    }
    output.flush()
}
