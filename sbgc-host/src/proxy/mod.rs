//! One board, several TCP clients.
//!
//! Each client talks to the proxy as if it were the board:
//! - Requests go through the one [`Gimbal`]; the answer, or the board's refusal, goes to who asked. Clients may use
//!   different versions of the protocol.
//! - Data streams are shared: equal ones use one registration of the board, at the shortest interval that was asked for
//!   first; clients that asked for a multiple get each n-th sample. A client's streams end with its connection.
//! - What the board sends by itself, such as events, traces of scripts and the end of a calibration, goes to the client
//!   that caused it, or to all.
//! - With [`ProxyOptions::read_only`], only what asks is passed on, everything else is refused.
//!
//! Nothing that one client does holds up another: each has its own bounded queue, loses samples when it does not read,
//! and is disconnected when it does not even take answers.

mod client;
mod outbox;
mod strays;
mod streams;

use std::sync::Arc;

use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tokio::task::JoinSet;

use crate::{Error, Gimbal, LinkState, Result};
use client::Client;
use strays::Strays;

/// How a proxy behaves.
///
/// ```
/// use sbgc_host::proxy::ProxyOptions;
///
/// let options = ProxyOptions { read_only: true, ..ProxyOptions::default() };
/// assert_eq!(options.clients, 16);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProxyOptions {
    /// Refuse everything that does more than ask. Data streams are allowed.
    pub read_only: bool,
    /// Maximum number of clients at a time; further ones are disconnected at once.
    pub clients: usize,
}

impl Default for ProxyOptions {
    fn default() -> Self {
        Self { read_only: false, clients: 16 }
    }
}

/// Serves clients until the connection to the board ends.
///
/// Dropping the future disconnects all clients and ends their streams.
///
/// ```no_run
/// # async fn example(gimbal: sbgc_host::Gimbal) -> sbgc_host::Result<()> {
/// use sbgc_host::proxy::{self, ProxyOptions};
///
/// let listener = tokio::net::TcpListener::bind("127.0.0.1:4001").await?;
/// proxy::serve(&gimbal, listener, ProxyOptions::default()).await
/// # }
/// ```
///
/// # Errors
/// If the connection to the board is lost or closed, or no more clients can be accepted.
pub async fn serve(gimbal: &Gimbal, listener: TcpListener, options: ProxyOptions) -> Result<()> {
    let mut state = gimbal.link_state();
    let room = Arc::new(Semaphore::new(options.clients));
    let strays = Strays::default();
    let mut clients = JoinSet::new();
    clients.spawn(strays.clone().forward(gimbal.clone()));
    loop {
        tokio::select! {
            ended = state.wait_for(|state| *state != LinkState::Open) => {
                return Err(if ended.is_ok_and(|state| *state == LinkState::Lost) {
                    Error::Disconnected
                } else {
                    Error::Closed
                });
            }
            accepted = listener.accept() => {
                let (stream, peer) = accepted?;
                let Ok(permit) = Arc::clone(&room).try_acquire_owned() else {
                    tracing::warn!(%peer, "too many clients");
                    continue;
                };
                let client = Client::new(gimbal.clone(), options.read_only, strays.clone());
                clients.spawn(async move {
                    tracing::info!(%peer, "client connected");
                    let outcome = client.run(stream).await;
                    tracing::info!(%peer, ?outcome, "client left");
                    drop(permit);
                });
            }
            Some(_) = clients.join_next() => {}
        }
    }
}
