//! `sbgc sim`: a simulated board for other programs.

use std::io;
use std::path::PathBuf;
use std::pin::Pin;

use clap::{ArgGroup, Args};
#[cfg(unix)]
use sbgc_host::sim::Pty;
use sbgc_host::sim::{self, Board, Config};
use serde_json::json;
use tokio::net::TcpListener;

use crate::failure::{Failure, until_stopped};
use crate::output::Output;
use crate::signals::stopped;

type Serving = Pin<Box<dyn Future<Output = io::Result<()>>>>;

const EXAMPLES: &str = "Examples:
  sbgc sim --pty --link /tmp/gimbal
  sbgc sim --tcp 127.0.0.1:4001";

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

    /// Make this symbolic link to the pseudo-terminal
    #[arg(long, requires = "pty", value_name = "PATH")]
    link: Option<PathBuf>,

    /// Serve on this address, e.g. 127.0.0.1:4001; port 0 picks a free port
    #[arg(long, value_name = "HOST:PORT", value_parser = host_and_port)]
    tcp: Option<String>,
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
        let board = Board::new(Config::default());
        let place = match (&self.tcp, &self.link) {
            (Some(address), _) => format!("tcp://{address}"),
            (None, Some(link)) => link.display().to_string(),
            (None, None) => String::from("pseudo-terminal"),
        };
        let failed = |source| Failure::File { place: place.clone(), source };
        let serving: Serving = match &self.tcp {
            Some(address) => {
                let listener = TcpListener::bind(address).await.map_err(failed)?;
                let bound = listener.local_addr().map_err(failed)?;
                announce(output, &format!("tcp://{bound}"))?;
                Box::pin(sim::serve_tcp(board, listener))
            }
            None => self.on_terminal(board, output, failed)?,
        };
        tokio::select! {
            served = serving => served.map_err(failed)?,
            // Whatever ends the program, the link to the terminal goes with it.
            signal = stopped() => return until_stopped(Err(Failure::Signal(signal))),
        }
        Ok(())
    }

    #[cfg(unix)]
    fn on_terminal(
        &self,
        mut board: Board,
        output: &mut Output,
        failed: impl Fn(io::Error) -> Failure,
    ) -> Result<Serving, Failure> {
        let mut terminal = Pty::open(self.link.as_deref()).map_err(failed)?;
        announce(output, &terminal.link().unwrap_or(terminal.path()).display().to_string())?;
        Ok(Box::pin(async move { terminal.serve(&mut board).await }))
    }

    #[cfg(not(unix))]
    fn on_terminal(
        &self,
        _: Board,
        _: &mut Output,
        _: impl Fn(io::Error) -> Failure,
    ) -> Result<Serving, Failure> {
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
