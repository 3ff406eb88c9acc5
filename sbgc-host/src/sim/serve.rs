//! The board behind a stream of bytes.

use std::io;
use std::time::Duration;

use bytes::{Buf, Bytes, BytesMut};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt, DuplexStream};
use tokio::time::{Instant, sleep_until};

use super::{Board, Config};

/// What is read at a time, and what may be on its way to the board.
const CHUNK: usize = 1024;

/// Size of the pipe of [`in_process`] in each direction.
const PIPE: usize = 4096;

/// Lets `board` talk over `io` until the other side is gone, and gives the time of the board when it was.
///
/// `started` is when the board's own time was 0; to go on with a board later, on another stream, give the same again.
/// Time is that of tokio, so that it can be paused in tests.
///
/// Cancelling it loses what was on its way to the host and nothing else.
///
/// # Errors
/// What the stream says when it breaks. That the other side closed it is no error.
pub async fn serve<S>(board: &mut Board, started: Instant, io: S) -> io::Result<Duration>
where
    S: AsyncRead + AsyncWrite,
{
    let (mut reader, mut writer) = tokio::io::split(io);
    let mut received = BytesMut::with_capacity(CHUNK);
    let mut sending = Bytes::new();
    loop {
        let now = started.elapsed();
        board.advance(now);
        if sending.is_empty() {
            sending = board.take_output();
        }
        let event = board.next_event();
        let next = started + event.unwrap_or_default();
        tokio::select! {
            // A flood of bytes must not keep what the board has to say from going out.
            count = writer.write(&sending), if !sending.is_empty() => match ended(count)? {
                Some(count) => sending.advance(count),
                None => return Ok(now),
            },
            count = reader.read_buf(&mut received), if board.unreceived() < CHUNK => match ended(count)? {
                Some(_) => {
                    board.receive(started.elapsed(), &received);
                    received.clear();
                }
                None => return Ok(now),
            },
            () = sleep_until(next), if event.is_some() => {}
        }
    }
}

/// How many bytes were moved; `None` when the other side is gone.
fn ended(result: io::Result<usize>) -> io::Result<Option<usize>> {
    match result {
        Ok(0) => Ok(None),
        Ok(count) => Ok(Some(count)),
        Err(error) if matches!(error.kind(), io::ErrorKind::BrokenPipe | io::ErrorKind::ConnectionReset) => {
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Starts a board inside the process and gives the host's end of the line. The board ends when that is dropped.
///
/// ```
/// use sbgc_host::sim::{self, Config};
/// use tokio::io::{AsyncReadExt, AsyncWriteExt};
///
/// # #[tokio::main(flavor = "current_thread", start_paused = true)]
/// # async fn main() -> std::io::Result<()> {
/// let mut line = sim::in_process(Config::default());
/// line.write_all(&[0x3E, 86, 0, 86, 0]).await?;
/// let mut answer = [0; 23];
/// line.read_exact(&mut answer).await?;
/// assert_eq!(answer[..4], [0x3E, 86, 18, 104]);
/// # Ok(())
/// # }
/// ```
///
/// # Panics
/// Outside of a tokio runtime, as [`tokio::spawn`] does.
pub fn in_process(config: Config) -> DuplexStream {
    let (host, line) = tokio::io::duplex(PIPE);
    tokio::spawn(async move {
        let mut board = Board::new(config);
        if let Err(error) = serve(&mut board, Instant::now(), line).await {
            tracing::debug!(%error, "the simulated board lost its host");
        }
    });
    host
}
