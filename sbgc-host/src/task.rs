//! The one task that owns the port: it moves bytes and time between the port and the [`Machine`].
//!
//! Handles call the machine directly and wake the task. Nothing here waits for reading, writing or time alone, so a peer
//! that does not read cannot keep it from reading.

use std::future::poll_fn;
use std::io;
use std::pin::{Pin, pin};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker, ready};
use std::time::Duration;

use backon::{BackoffBuilder, ExponentialBackoff, ExponentialBuilder};
use bytes::Bytes;
use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt, ReadBuf};
use tokio::sync::{Notify, oneshot, watch};
use tokio::time::error::Elapsed;
use tokio::time::{Instant, Sleep, sleep, sleep_until, timeout, timeout_at};

use crate::error::Result;
use crate::machine::{Failure, LinkState, Machine, Setup, Trouble, Waiter};
use crate::transport::Io;

/// How much is read at once.
const READ_SIZE: usize = 4096;

/// How long the port may take to be shut down.
const SHUTDOWN: Duration = Duration::from_secs(1);

/// Clocks have an end, too; a timer is set to this far ahead at most, a day.
const FARTHEST: Duration = Duration::from_hours(24);

/// Nobody looks for a lost port longer than this, thirty years.
const LONGEST: Duration = Duration::from_hours(30 * 365 * 24);

/// Pauses between attempts to open the port again.
const SHORTEST_PAUSE: Duration = Duration::from_millis(200);
const LONGEST_PAUSE: Duration = Duration::from_secs(5);

fn pauses() -> ExponentialBackoff {
    let pauses = ExponentialBuilder::new().with_factor(2.0).with_jitter().without_max_times();
    pauses.with_min_delay(SHORTEST_PAUSE).with_max_delay(LONGEST_PAUSE).build()
}

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
        let (waker, state) = (driver.waker.take(), driver.machine.state());
        drop(driver);
        self.publish(state);
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

    /// Tells those who watch the state when it has changed.
    fn publish(&self, state: LinkState) {
        if *self.state.borrow() != state {
            self.state.send_replace(state);
            self.room.notify_waiters();
        }
    }

    /// Moves what can be moved. Ready when the port is to be given back, or is gone.
    fn poll(
        &self,
        context: &mut Context<'_>,
        io: &mut Io,
        input: &mut [u8],
        timer: Pin<&mut Sleep>,
    ) -> Poll<io::Result<()>> {
        let mut driver = self.lock();
        let outcome = self.turn(&mut driver, context, io, input, timer);
        let state = driver.machine.state();
        drop(driver);
        self.publish(state);
        outcome
    }

    fn turn(
        &self,
        Driver { machine, waker }: &mut Driver,
        context: &mut Context<'_>,
        io: &mut Io,
        input: &mut [u8],
        mut timer: Pin<&mut Sleep>,
    ) -> Poll<io::Result<()>> {
        loop {
            let now = self.started.elapsed();
            // What has come is looked at before the time is: after a pause of the whole program nothing times out whose
            // answer was there in time.
            let mut read = ReadBuf::new(input);
            let came = match Pin::new(&mut *io).poll_read(context, &mut read) {
                Poll::Ready(Ok(())) if read.filled().is_empty() => {
                    Some(Err(io::ErrorKind::UnexpectedEof.into()))
                }
                Poll::Ready(Ok(())) => {
                    machine.receive(now, read.filled());
                    Some(Ok(()))
                }
                Poll::Ready(Err(error)) => Some(Err(error)),
                Poll::Pending => None,
            };
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
                self.room.notify_waiters();
            }
            if machine.is_done(now) {
                return Poll::Ready(Ok(()));
            }
            if let Some(trouble) = machine.trouble() {
                return Poll::Ready(Err(io::Error::other(match trouble {
                    Trouble::Silent => "the board does not answer",
                    Trouble::Replaced => "another board answers",
                })));
            }
            if let Some(came) = came {
                came?;
                continue;
            }
            waker.get_or_insert_with(|| context.waker().clone()).clone_from(context.waker());
            let Some(wake) = machine.next_wake(now) else { return Poll::Pending };
            let wake = self.started + wake.min(now + FARTHEST);
            // A timer that goes off too early costs less than setting it anew for each request.
            if timer.is_elapsed() || wake < timer.deadline() {
                timer.as_mut().reset(wake);
            }
            ready!(timer.as_mut().poll(context));
        }
    }

    /// Waits until the link is closed from this side.
    async fn closed(&self) {
        poll_fn(|context| {
            let mut driver = self.lock();
            driver.waker = Some(context.waker().clone());
            if driver.machine.is_ending() { Poll::Ready(()) } else { Poll::Pending }
        })
        .await;
    }

    /// Opens the port again, with longer and longer pauses. `None` if the link is closed meanwhile, an error if the time
    /// is over.
    async fn open_again(
        &self,
        redial: &mut Redial,
        pauses: &mut ExponentialBackoff,
        until: Instant,
    ) -> std::result::Result<Option<Io>, Elapsed> {
        let tried = async {
            loop {
                sleep(pauses.next().unwrap_or(LONGEST_PAUSE)).await;
                match (redial.dial)().await {
                    Ok(io) => return Some(io),
                    Err(error) => tracing::debug!(%error, "port still lost"),
                }
            }
        };
        tokio::select! {
            biased;
            () = self.closed() => Ok(None),
            opened = timeout_at(until, tried) => opened,
        }
    }
}

/// What opens the port again.
pub(crate) type Dial = Box<dyn FnMut() -> Pin<Box<dyn Future<Output = Result<Io>> + Send>> + Send>;

/// How a lost port is opened again, and for how long that is tried.
pub(crate) struct Redial {
    pub(crate) dial: Dial,
    pub(crate) within: Duration,
}

/// The task itself.
pub(crate) struct Task {
    link: Arc<Link>,
    redial: Option<Redial>,
}

impl Task {
    pub(crate) fn new(link: Arc<Link>, redial: Option<Redial>) -> Self {
        Self { link, redial }
    }

    /// Serves the port until it fails for good, all handles are gone or one of them closes it.
    pub(crate) async fn run(mut self, mut io: Io) -> io::Result<()> {
        let link = Arc::clone(&self.link);
        let mut input = vec![0; READ_SIZE];
        let mut timer = pin!(sleep_until(link.started));
        let mut pauses = pauses();
        let mut give_up = None;
        loop {
            let served = poll_fn(|context| link.poll(context, &mut io, &mut input, timer.as_mut())).await;
            let Err(error) = served else { break };
            drop(io);
            tracing::debug!(%error, "port lost");
            // A link that worked begins with short pauses again.
            if link.look(Machine::state) == LinkState::Open {
                pauses = self::pauses();
                give_up = None;
            }
            let went_on = link.call(|machine, now| {
                let goes_on = self.redial.is_some() && machine.can_go_on();
                if goes_on {
                    machine.down(now);
                } else {
                    machine.lost(now);
                }
                goes_on
            });
            let Some(redial) = self.redial.as_mut().filter(|_| went_on) else { return Err(error) };
            let until = *give_up.get_or_insert_with(|| Instant::now() + redial.within.min(LONGEST));
            match link.open_again(redial, &mut pauses, until).await {
                Ok(Some(again)) => io = again,
                Ok(None) => return Ok(()),
                Err(_) => {
                    link.call(Machine::lost);
                    return Err(error);
                }
            }
            link.call(Machine::up);
        }
        // The other side need not care, and may be gone.
        drop(timeout(SHUTDOWN, io.shutdown()).await);
        // Whoever waits for the end may open the port again at once.
        drop(io);
        Ok(())
    }
}

impl Drop for Task {
    /// However it ends, nobody goes on waiting for it.
    fn drop(&mut self) {
        self.link.call(|machine, _| machine.closed_port());
    }
}
