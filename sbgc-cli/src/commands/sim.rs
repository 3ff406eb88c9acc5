//! `sbgc sim`: a simulated board for other programs.

use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::pin::Pin;

use clap::{ArgGroup, Args};
#[cfg(unix)]
use sbgc_host::sim::Pty;
use sbgc_host::sim::{self, Board, Config};
use serde_json::json;
use tokio::net::TcpListener;

use crate::failure::Failure;
use crate::output::Output;

#[derive(Args, Debug)]
#[command(group = ArgGroup::new("place").required(true).args(["pty", "tcp"]))]
pub(crate) struct Sim {
    /// Serve on a pseudo-terminal
    #[arg(long)]
    pty: bool,

    /// Make this symbolic link to the pseudo-terminal
    #[arg(long, requires = "pty", value_name = "PATH")]
    link: Option<PathBuf>,

    /// Serve on this address, such as 127.0.0.1:4001
    #[arg(long, value_name = "ADDR")]
    tcp: Option<SocketAddr>,
}

impl Sim {
    pub(crate) async fn run(self, output: &mut Output) -> Result<(), Failure> {
        let board = Board::new(Config::default());
        let serving: Pin<Box<dyn Future<Output = io::Result<()>>>> = match self.tcp {
            Some(address) => {
                let place = format!("tcp://{address}");
                let listener =
                    TcpListener::bind(address).await.map_err(|source| Failure::File { place, source })?;
                announce(output, &format!("tcp://{}", listener.local_addr()?))?;
                Box::pin(sim::serve_tcp(board, listener))
            }
            None => Box::pin(self.on_terminal(board, output)?),
        };
        tokio::select! {
            served = serving => served?,
            // Whatever ends the program, the link to the terminal goes with it.
            () = stopped() => {}
        }
        Ok(())
    }

    #[cfg(unix)]
    fn on_terminal(
        &self,
        mut board: Board,
        output: &mut Output,
    ) -> Result<impl Future<Output = io::Result<()>> + use<>, Failure> {
        let place = self
            .link
            .as_ref()
            .map_or_else(|| String::from("pseudo-terminal"), |link| link.display().to_string());
        let mut terminal =
            Pty::open(self.link.as_deref()).map_err(|source| Failure::File { place, source })?;
        announce(output, &terminal.link().unwrap_or(terminal.path()).display().to_string())?;
        Ok(async move { terminal.serve(&mut board).await })
    }

    #[cfg(not(unix))]
    fn on_terminal(&self, _: Board, _: &mut Output) -> Result<std::future::Ready<io::Result<()>>, Failure> {
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

#[cfg(unix)]
async fn stopped() {
    use tokio::signal::unix::{SignalKind, signal};

    match signal(SignalKind::terminate()) {
        Ok(mut terminate) => tokio::select! {
            _ = tokio::signal::ctrl_c() => {}
            _ = terminate.recv() => {}
        },
        Err(_) => drop(tokio::signal::ctrl_c().await),
    }
}

#[cfg(not(unix))]
async fn stopped() {
    drop(tokio::signal::ctrl_c().await);
}
