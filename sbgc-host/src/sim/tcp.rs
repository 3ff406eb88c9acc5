//! The board on TCP.

use std::io;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::time::{Instant, sleep_until};

use super::{Board, serve};

/// How long the board lives on without a host before it is looked at again.
const IDLE: Duration = Duration::from_millis(100);

/// Serves `board` to whoever connects, one after the other: the next one waits until the one before is gone.
///
/// The board lives on between them. What it sends while nobody is there is lost, as on a wire without a listener.
///
/// # Errors
/// When no more connections can be taken. That one breaks is no error: the next is waited for.
pub async fn serve_tcp(mut board: Board, listener: TcpListener) -> io::Result<()> {
    let started = Instant::now();
    loop {
        let (stream, peer) = loop {
            tokio::select! {
                accepted = listener.accept() => break accepted?,
                () = sleep_until(Instant::now() + IDLE) => {
                    board.advance(started.elapsed());
                    board.take_output();
                }
            }
        };
        tracing::debug!(%peer, "connected");
        stream.set_nodelay(true)?;
        match serve(&mut board, started, stream).await {
            Ok(_) => tracing::debug!(%peer, "disconnected"),
            Err(error) => tracing::debug!(%peer, %error, "connection broke"),
        }
    }
}
