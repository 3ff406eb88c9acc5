//! The board behind streams of bytes.

use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use bytes::{Buf, Bytes, BytesMut};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt, DuplexStream};
use tokio::sync::watch;
use tokio::time::{Instant, sleep_until};

use super::{Board, Config, StateFile};

/// What is read at a time, and what may be on its way to the board.
const CHUNK: usize = 1024;

/// Size of the pipe of [`in_process`] in each direction.
const PIPE: usize = 4096;

#[derive(Debug)]
struct Shared {
    board: Mutex<(Board, Option<StateFile>)>,
    started: Instant,
    /// Counts what was done to the board, so that all who serve it look at it again.
    changed: watch::Sender<u64>,
}

/// A board that runs by the clock of tokio, for all who use it at once.
///
/// Clones are handles to the same board.
#[derive(Clone, Debug)]
pub struct SharedBoard(Arc<Shared>);

impl SharedBoard {
    /// Lets `board` run from now on.
    pub fn new(board: Board) -> Self {
        Self::since(Instant::now(), board, None)
    }

    /// The same with a file that keeps its state.
    pub fn with_state(board: Board, state: StateFile) -> Self {
        Self::since(Instant::now(), board, Some(state))
    }

    /// Lets `board` run as if it had done so from `started` on.
    pub(super) fn since(started: Instant, board: Board, state: Option<StateFile>) -> Self {
        let changed = watch::Sender::new(0);
        Self(Arc::new(Shared { board: Mutex::new((board, state)), started, changed }))
    }

    fn lock(&self) -> MutexGuard<'_, (Board, Option<StateFile>)> {
        self.0.board.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something with the board, as it is now: asks what it has seen, or lets something go wrong.
    ///
    /// ```
    /// use sbgc_host::sim::{self, Config, Fault};
    ///
    /// # #[tokio::main(flavor = "current_thread", start_paused = true)]
    /// # async fn main() {
    /// let (board, line) = sim::simulate(Config::default());
    /// board.with(|board| board.inject(Fault::NoConfirm));
    /// assert_eq!(board.with(|board| board.counters().received), 0);
    /// # }
    /// ```
    pub fn with<R>(&self, act: impl FnOnce(&mut Board) -> R) -> R {
        let mut locked = self.lock();
        locked.0.advance(self.0.started.elapsed());
        let result = act(&mut locked.0);
        drop(locked);
        self.0.changed.send_modify(|count| *count = count.wrapping_add(1));
        result
    }

    /// Moves the board on to now, saves what has changed, and looks at it.
    fn look<R>(&self, look: impl FnOnce(&mut Board) -> R) -> io::Result<R> {
        let mut locked = self.lock();
        let (board, state) = &mut *locked;
        board.advance(self.0.started.elapsed());
        // What the board confirms is safe before the host hears of it.
        if let Some(state) = state {
            state.save(board)?;
        }
        Ok(look(board))
    }

    /// Serves one of its ports over `io` until the other side is gone.
    ///
    /// Cancelling it loses what was on its way to the host and nothing else.
    ///
    /// # Errors
    /// If the stream breaks, or the state cannot be saved. That the other side closed it is not an error.
    pub async fn serve_port<S>(&self, port: u8, io: S) -> io::Result<()>
    where
        S: AsyncRead + AsyncWrite,
    {
        self.serve_gated(port, io, &mut Open).await
    }

    /// Serves it on a port of its own.
    ///
    /// # Errors
    /// As [`serve_port`](Self::serve_port), and if the board has no more ports.
    pub async fn serve<S>(&self, io: S) -> io::Result<()>
    where
        S: AsyncRead + AsyncWrite,
    {
        let port = self.with(|board| {
            let port = board.connect()?;
            board.read_at_once(port);
            Some(port)
        });
        let port = port.ok_or_else(|| io::Error::other("the board has no more ports"))?;
        let gone = Disconnecting(self, port);
        self.serve_port(gone.1, io).await
    }

    pub(super) async fn serve_gated<S, G>(&self, port: u8, io: S, gate: &mut G) -> io::Result<()>
    where
        S: AsyncRead + AsyncWrite,
        G: Gate,
    {
        let (mut reader, mut writer) = tokio::io::split(io);
        let mut received = BytesMut::with_capacity(CHUNK);
        let mut sending = Bytes::new();
        let mut changed = self.0.changed.subscribe();
        loop {
            if gate.look()? {
                sending.clear();
            }
            changed.mark_unchanged();
            let (output, event, full) = self.look(|board| {
                if let Some(rate) = gate.rate() {
                    board.set_bit_rate(port, Some(rate));
                }
                let output = if sending.is_empty() { board.take_output_of(port) } else { Bytes::new() };
                (output, board.next_event(), board.unreceived_on(port) >= CHUNK)
            })?;
            if sending.is_empty() {
                sending = gate.outgoing(output);
            }
            let next = self.0.started + event.unwrap_or_default();
            tokio::select! {
                // A flood of bytes must not keep what the board has to say from going out.
                count = writer.write(&sending), if !sending.is_empty() => match ended(count)? {
                    Some(count) => sending.advance(count),
                    None => return Ok(()),
                },
                count = reader.read_buf(&mut received), if !full => match ended(count)? {
                    Some(_) => {
                        // Somebody else may have come before these bytes did.
                        if gate.look()? {
                            sending.clear();
                        }
                        gate.incoming(&mut received);
                        self.with(|board| {
                            let now = self.0.started.elapsed();
                            board.receive_on(port, now, &received);
                        });
                        received.clear();
                    }
                    None => return Ok(()),
                },
                changed = changed.changed() => {
                    if changed.is_err() {
                        return Ok(());
                    }
                }
                ready = gate.ready() => ready?,
                () = sleep_until(next), if event.is_some() => {}
            }
        }
    }
}

/// Gives a port back, however its serving ends.
struct Disconnecting<'b>(&'b SharedBoard, u8);

impl Drop for Disconnecting<'_> {
    fn drop(&mut self) {
        self.0.with(|board| board.disconnect(self.1));
    }
}

/// What stands between a stream and a port of the board.
pub(super) trait Gate {
    /// Looks who is there; true if what was on its way to the one before is to be thrown away.
    fn look(&mut self) -> io::Result<bool>;

    /// Returns when there is something to look at.
    fn ready(&mut self) -> impl Future<Output = io::Result<()>> + Send;

    /// Bytes of the host, as they reach the board.
    fn incoming(&mut self, bytes: &mut [u8]);

    /// Bytes of the board, as they reach the host.
    fn outgoing(&mut self, bytes: Bytes) -> Bytes;

    /// The bit rate that the line has now, where that can change.
    fn rate(&self) -> Option<u32>;
}

/// A gate that lets everything through.
struct Open;

impl Gate for Open {
    fn look(&mut self) -> io::Result<bool> {
        Ok(false)
    }

    fn ready(&mut self) -> impl Future<Output = io::Result<()>> + Send {
        std::future::pending()
    }

    fn incoming(&mut self, _: &mut [u8]) {}

    fn outgoing(&mut self, bytes: Bytes) -> Bytes {
        bytes
    }

    fn rate(&self) -> Option<u32> {
        None
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
    simulate(config).1
}

/// The same with a handle to the board, to ask what it has seen and to let things go wrong.
///
/// ```
/// use sbgc_host::sim::{self, Config, Fault, Way};
/// use sbgc_host::{Gimbal, Options};
///
/// # #[tokio::main(flavor = "current_thread", start_paused = true)]
/// # async fn main() -> sbgc_host::Result<()> {
/// let (board, line) = sim::simulate(Config::default());
/// let gimbal = Gimbal::spawn(line, Options::default());
/// gimbal.handshake().await?;
///
/// // From now on nothing that the board sends arrives.
/// board.with(|board| board.inject(Fault::Drop { probability: 1.0, way: Way::Out }));
/// assert!(gimbal.handshake().await.is_err());
/// # Ok(())
/// # }
/// ```
///
/// # Panics
/// Outside of a tokio runtime, as [`tokio::spawn`] does.
pub fn simulate(config: Config) -> (SharedBoard, DuplexStream) {
    run(SharedBoard::new(Board::new(config)))
}

/// The same with a file that keeps the state of the board.
///
/// # Errors
/// As [`StateFile::open`].
///
/// # Panics
/// Outside of a tokio runtime, as [`tokio::spawn`] does.
pub fn simulate_with_state(
    path: &std::path::Path,
    config: &Config,
) -> io::Result<(SharedBoard, DuplexStream)> {
    let (state, board) = StateFile::open(path, config)?;
    Ok(run(SharedBoard::with_state(board, state)))
}

fn run(board: SharedBoard) -> (SharedBoard, DuplexStream) {
    let (host, line) = tokio::io::duplex(PIPE);
    let served = board.clone();
    tokio::spawn(async move {
        if let Err(error) = served.serve_port(0, line).await {
            tracing::debug!(%error, "the simulated board lost its host");
        }
    });
    (board, host)
}
