//! `sbgc proxy`: one board, several clients.

use clap::Args;
use sbgc_host::proxy::{self, ProxyOptions};
use serde_json::json;
use tokio::net::TcpListener;

use super::sim::host_and_port;
use crate::connect::with_followed_board;
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::talk;

const EXAMPLES: &str = "Examples:
  sbgc proxy
  sbgc proxy --listen 127.0.0.1:0 --read-only --json";

/// Share one board among several programs
///
/// Prints its address on the first line, then runs until stopped. Replies go to the client that asked; identical data
/// streams are shared and end with their clients. Other programs connect with --port tcp://HOST:PORT.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Proxy {
    /// Address to serve on; port 0 picks a free port
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:4001", value_parser = host_and_port)]
    listen: String,

    /// Pass on reads only, refuse changes
    #[arg(long)]
    read_only: bool,

    /// Maximum number of clients at a time
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_clients: u16,
}

impl Proxy {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let failed = |source| Failure::File { place: format!("tcp://{}", self.listen), source };
        // Whether the address is free is known before the board is touched.
        let listener = TcpListener::bind(&self.listen).await.map_err(failed)?;
        let bound = listener.local_addr().map_err(failed)?;
        if !bound.ip().is_loopback() {
            talk::say(format_args!("warning: {bound} is reachable from other computers, without a password"));
        }
        let options = ProxyOptions { read_only: self.read_only, clients: self.max_clients.into() };
        until_stopped(
            with_followed_board(global, async |gimbal, _| {
                let place = format!("tcp://{bound}");
                if output.is_json() {
                    output.object(&json!({"port": place}))?;
                } else {
                    output.line(&place)?;
                }
                output.flush()?;
                Ok(proxy::serve(&gimbal, listener, options).await?)
            })
            .await,
        )
    }
}
