//! Boards on TCP.

use std::io;
use std::net::SocketAddr;
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio::time::{Instant, sleep};

use super::{Board, Config, SharedBoard};

/// How often it is looked whether the board is unplugged.
const LOOK: Duration = Duration::from_millis(20);

/// Who the board of a client is.
#[derive(Clone, Debug)]
enum Boards {
    /// Each client has one of its own.
    Own(Box<Config>),
    /// All have the same.
    One(SharedBoard),
}

/// Serves a board of its own to each client that connects, any number of them at once.
///
/// Faults at fixed times count from this call on, for all of them.
///
/// # Errors
/// If no more connections can be taken. That one breaks is not an error: the others go on.
pub async fn serve_tcp(config: Config, listener: TcpListener) -> io::Result<()> {
    serve(Boards::Own(Box::new(config)), listener).await
}

/// Serves one board to all clients that connect, each on a port of its own.
///
/// # Errors
/// As [`serve_tcp`].
pub async fn serve_shared_tcp(board: SharedBoard, listener: TcpListener) -> io::Result<()> {
    serve(Boards::One(board), listener).await
}

async fn serve(boards: Boards, listener: TcpListener) -> io::Result<()> {
    let started = Instant::now();
    let address = listener.local_addr()?;
    // A board of nobody, to know when the line is dead.
    let clock = match &boards {
        Boards::Own(config) => SharedBoard::since(started, Board::new((**config).clone()), None),
        Boards::One(board) => board.clone(),
    };
    let mut listener = Some(listener);
    let mut clients = JoinSet::new();
    loop {
        let unplugged = clock.with(|board| board.is_unplugged());
        match &listener {
            Some(_) if unplugged => {
                // Nobody is taken, and nobody is kept.
                listener = None;
                clients.shutdown().await;
            }
            None if !unplugged => listener = Some(bind_again(address).await?),
            None => sleep(LOOK).await,
            Some(open) => tokio::select! {
                accepted = open.accept() => {
                    let (stream, peer) = accepted?;
                    clients.spawn(client(boards.clone(), started, stream, peer));
                }
                // The board of all lives on while nobody is there.
                () = sleep(LOOK) => {}
                Some(_) = clients.join_next() => {}
            },
        }
    }
}

/// The same address again: it may be held for a moment by what was closed.
async fn bind_again(address: SocketAddr) -> io::Result<TcpListener> {
    for _ in 0..50 {
        match TcpListener::bind(address).await {
            Ok(listener) => return Ok(listener),
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => sleep(LOOK).await,
            Err(error) => return Err(error),
        }
    }
    TcpListener::bind(address).await
}

async fn client(boards: Boards, started: Instant, stream: TcpStream, peer: SocketAddr) {
    tracing::debug!(%peer, "connected");
    let _ = stream.set_nodelay(true);
    let served = match boards {
        Boards::Own(config) => {
            let mut board = Board::new(*config);
            board.read_at_once(0);
            SharedBoard::since(started, board, None).serve_port(0, stream).await
        }
        Boards::One(board) => board.serve(stream).await,
    };
    match served {
        Ok(()) => tracing::debug!(%peer, "disconnected"),
        Err(error) => tracing::debug!(%peer, %error, "connection broke"),
    }
}
