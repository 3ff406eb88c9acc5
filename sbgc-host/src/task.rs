//! The one task that owns the port: it moves bytes and time between the port and the [`Machine`].
//!
//! Handles call the machine directly and wake the task. Nothing here waits for reading, writing or time alone, so a peer
//! that does not read cannot keep it from reading.

use std::io;
use std::pin::{Pin, pin};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker, ready};
use std::time::Duration;

use bytes::Bytes;
use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt, ReadBuf};
use tokio::sync::{Notify, oneshot, watch};
use tokio::time::{Instant, Sleep, sleep_until, timeout};

use crate::machine::{Failure, LinkState, Machine, Setup, Waiter};

/// How much is read at once.
const READ_SIZE: usize = 4096;

/// How long the port may take to be shut down.
const SHUTDOWN: Duration = Duration::from_secs(1);

/// Clocks have an end, too; a timer is set to this far ahead at most, a day.
const FARTHEST: Duration = Duration::from_hours(24);

/// Who waits for an answer: a future that may have been dropped meanwhile.
pub(crate) type Reply = oneshot::Sender<Result<Bytes, Failure>>;

impl Waiter for Reply {
    fn is_gone(&self) -> bool {
        self.is_closed()
    }

    fn tell(self, outcome: Result<Bytes, Failure>) {
        // Whoever left meanwhile does not need it.
        let _ = self.send(outcome);
    }
}

/// What the handles and the task share.
#[derive(Debug)]
pub(crate) struct Link {
    driver: Mutex<Driver>,
    /// When the machine's time was zero.
    started: Instant,
    pub(crate) state: watch::Sender<LinkState>,
    /// Whether a control session or a calibration owns the motion.
    pub(crate) motion_owned: AtomicBool,
    /// Notified when commands that nobody waits for have gone out.
    pub(crate) room: Notify,
}

#[derive(Debug)]
struct Driver {
    machine: Machine<Reply>,
    /// Of the task.
    waker: Option<Waker>,
}

impl Link {
    pub(crate) fn new(setup: Setup) -> Self {
        Self {
            driver: Mutex::new(Driver { machine: Machine::new(setup), waker: None }),
            started: Instant::now(),
            state: watch::Sender::new(LinkState::Open),
            motion_owned: AtomicBool::new(false),
            room: Notify::new(),
        }
    }

    /// Calls the machine with the time, and has the task see what follows from that.
    pub(crate) fn call<T>(&self, work: impl FnOnce(&mut Machine<Reply>, Duration) -> T) -> T {
        let mut driver = self.lock();
        let value = work(&mut driver.machine, self.started.elapsed());
        let waker = driver.waker.take();
        drop(driver);
        if let Some(waker) = waker {
            waker.wake();
        }
        value
    }

    /// Looks at the machine without changing it.
    pub(crate) fn look<T>(&self, look: impl FnOnce(&Machine<Reply>) -> T) -> T {
        look(&self.lock().machine)
    }

    fn lock(&self) -> MutexGuard<'_, Driver> {
        self.driver.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn end(&self, end: impl FnOnce(&mut Machine<Reply>, Duration)) {
        self.call(end);
        let state = self.look(Machine::state);
        self.state.send_replace(state);
        self.room.notify_waiters();
    }
}

/// The task itself.
#[derive(Debug)]
pub(crate) struct Task {
    link: Arc<Link>,
}

impl Task {
    pub(crate) fn new(link: Arc<Link>) -> Self {
        Self { link }
    }

    /// Serves the port until it fails, all handles are gone or one of them closes it.
    pub(crate) async fn run(self, io: impl AsyncRead + AsyncWrite + Unpin) -> io::Result<()> {
        let mut io = io;
        let mut input = vec![0; READ_SIZE];
        let mut timer = pin!(sleep_until(self.link.started));
        let outcome =
            std::future::poll_fn(|context| self.poll(context, &mut io, &mut input, timer.as_mut())).await;
        match &outcome {
            // The other side need not care, and may be gone.
            Ok(()) => drop(timeout(SHUTDOWN, io.shutdown()).await),
            Err(error) => {
                tracing::debug!(%error, "port lost");
                self.link.end(Machine::lost);
            }
        }
        // Whoever waits for the end may open the port again at once.
        drop(io);
        outcome
    }

    fn poll(
        &self,
        context: &mut Context<'_>,
        io: &mut (impl AsyncRead + AsyncWrite + Unpin),
        input: &mut [u8],
        mut timer: Pin<&mut Sleep>,
    ) -> Poll<io::Result<()>> {
        let mut driver = self.link.lock();
        let Driver { machine, waker } = &mut *driver;
        loop {
            let now = self.link.started.elapsed();
            let full = !machine.has_room();
            loop {
                let pending = machine.pending(now);
                if pending.is_empty() {
                    break;
                }
                match Pin::new(&mut *io).poll_write(context, pending)? {
                    Poll::Ready(0) => return Poll::Ready(Err(io::ErrorKind::WriteZero.into())),
                    Poll::Ready(count) => machine.written(now, count),
                    Poll::Pending => break,
                }
            }
            if full && machine.has_room() {
                self.link.room.notify_waiters();
            }
            if machine.is_done(now) {
                return Poll::Ready(Ok(()));
            }
            let mut read = ReadBuf::new(input);
            if Pin::new(&mut *io).poll_read(context, &mut read)?.is_ready() {
                if read.filled().is_empty() {
                    return Poll::Ready(Err(io::ErrorKind::UnexpectedEof.into()));
                }
                machine.receive(now, read.filled());
                continue;
            }
            waker.get_or_insert_with(|| context.waker().clone()).clone_from(context.waker());
            let Some(wake) = machine.next_wake(now) else { return Poll::Pending };
            let wake = self.link.started + wake.min(now + FARTHEST);
            // A timer that goes off too early costs less than setting it anew for each request.
            if timer.is_elapsed() || wake < timer.deadline() {
                timer.as_mut().reset(wake);
            }
            ready!(timer.as_mut().poll(context));
        }
    }
}

impl Drop for Task {
    /// However it ends, nobody goes on waiting for it.
    fn drop(&mut self) {
        self.link.end(|machine, _| machine.closed_port());
    }
}
