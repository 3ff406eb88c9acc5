//! The handle to a board.
//!
//! Here live [`Gimbal`], what it can be asked in general, and how it is set up. Data streams are in
//! [`streams`](crate::streams); whole parameter sets, calibrations and files stand above
//! this module and use nothing but it.

mod answer;
mod found;
mod handshake;
mod options;

use std::future::Future;
use std::io;
use std::pin::Pin;
use std::sync::{Arc, OnceLock};
use std::task::{Context, Poll};
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{
    Angles, AnglesExt, BoardInfo, BoardInfo3, BoardInfo3Request, Confirm, Control, ExecuteMenu, FailureCode,
    GetAngles, GetAnglesExt, MenuCommand, MotorsOff, MotorsOffMode, MotorsOn, Params3, ProfileId,
    ReadParams3,
};
use sbgc_proto::frame::{MAX_PAYLOAD, Version};
use sbgc_proto::wire::ToWire;
use sbgc_proto::{CommandId, Direction, EncodeError, Expected, Message, Request, RequestInfo};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::sync::{oneshot, watch};
use tokio::time::timeout;
use tracing::{Instrument, field};

pub use answer::Answer;
pub use found::Found;
pub(crate) use handshake::knows_version_2;
pub(crate) use options::LONGEST;
pub use options::{Options, VersionChoice};

use crate::error::{Error, Result};
use crate::machine::{Call, Failure, LinkCounters, LinkState, MAX_STREAMS, Machine, Priority};
use crate::task::{Link, Redial, Task};
use crate::transport::Io;

/// A board at the other end of a link.
///
/// A cheap handle: clones talk to the same task, which owns the port and ends when the last of them is dropped. All
/// methods take `&self`, and whatever they wait for is given up by dropping their future. A request that was dropped
/// after it was sent is carried out all the same; its answer is put aside.
#[derive(Clone, Debug)]
pub struct Gimbal {
    handle: Arc<Handle>,
    options: Options,
}

/// What all clones have in common. The link is closed when it is dropped.
#[derive(Debug)]
struct Handle {
    link: Arc<Link>,
    /// Whose turn it is to hand over a command, once as many wait as may.
    turn: tokio::sync::Mutex<()>,
    /// What was found when it was opened.
    found: OnceLock<Found>,
}

impl Drop for Handle {
    fn drop(&mut self) {
        self.link.call(Machine::close);
    }
}

/// The task that owns the port, to be spawned. It is done when the port is.
///
/// `Ok` after the last handle was dropped or one of them closed the link, else what happened to the port. Until it is polled,
/// requests wait, whatever their deadline.
#[must_use = "nothing happens on the port until this is polled"]
pub struct Connection(Pin<Box<dyn Future<Output = io::Result<()>> + Send>>);

impl Future for Connection {
    type Output = io::Result<()>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        self.0.as_mut().poll(context)
    }
}

impl Connection {
    pub(crate) fn spawn(self) {
        let span = tracing::debug_span!("link");
        tokio::spawn(tracing::Instrument::instrument(
            async move {
                if let Err(error) = self.await {
                    tracing::warn!(%error, "the port failed");
                }
            },
            span,
        ));
    }
}

impl std::fmt::Debug for Connection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Connection").finish_non_exhaustive()
    }
}

impl Gimbal {
    /// A handle to what is at the other end of `io`, and the task that serves it.
    ///
    /// `io` must not keep written bytes back. Nothing is sent yet; [`handshake`](Self::handshake) finds out whether
    /// there is a board.
    ///
    /// # Panics
    /// Not here, but the task needs a tokio runtime with time enabled.
    pub fn new<Io>(io: Io, options: Options) -> (Self, Connection)
    where
        Io: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        Self::with_dial(Box::new(io), options, None)
    }

    /// Like [`new`](Self::new); a port that is lost is opened again by `redial`, once it is known who the board is.
    pub(crate) fn with_dial(io: Io, options: Options, redial: Option<Redial>) -> (Self, Connection) {
        let link = Arc::new(Link::new(options.setup()));
        let task = Task::new(Arc::clone(&link), redial);
        let handle = Arc::new(Handle { link, turn: tokio::sync::Mutex::default(), found: OnceLock::new() });
        (Self { handle, options }, Connection(Box::pin(task.run(io))))
    }

    /// The same with the task already spawned on the present tokio runtime.
    ///
    /// # Panics
    /// Outside of a tokio runtime.
    pub fn spawn<Io>(io: Io, options: Options) -> Self
    where
        Io: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let (gimbal, connection) = Self::new(io, options);
        connection.spawn();
        gimbal
    }

    /// A handle to the same board whose requests wait so long for their answers.
    #[must_use]
    pub fn with_timeout(&self, timeout: Duration) -> Self {
        let options = Options { timeout, ..self.options };
        Self { options, ..self.clone() }
    }

    /// A handle to the same board that sends reads so often, 1 for once.
    #[must_use]
    pub fn with_attempts(&self, attempts: u32) -> Self {
        let options = Options { attempts, ..self.options };
        Self { options, ..self.clone() }
    }

    /// What was found when it was [connected](Self::connect); `None` for a handle to a stream of bytes.
    pub fn found(&self) -> Option<&Found> {
        self.handle.found.get()
    }

    pub(crate) fn set_found(&self, found: Found) {
        // It is set once.
        let _ = self.handle.found.set(found);
    }

    /// How it was set up.
    pub const fn options(&self) -> &Options {
        &self.options
    }

    /// The version in which frames go out at present.
    pub fn version(&self) -> Version {
        self.link().look(Machine::version)
    }

    /// What passed the link so far.
    pub fn counters(&self) -> LinkCounters {
        self.link().look(Machine::counters)
    }

    /// Whether the port is there, for all that wait for a change of it.
    pub fn link_state(&self) -> watch::Receiver<LinkState> {
        self.link().state.subscribe()
    }

    /// Whether the port was lost and is being opened again.
    pub fn is_reconnecting(&self) -> bool {
        self.link().look(Machine::state) == LinkState::Reconnecting
    }

    /// Sends what is still to be sent, ends data streams, and gives the port back. All handles are closed by it.
    pub async fn close(self) {
        let mut state = self.link_state();
        self.link().call(Machine::close);
        let open = |state: &LinkState| matches!(state, LinkState::Open | LinkState::Reconnecting);
        let _ = state.wait_for(|state| !open(state)).await;
    }

    /// Asks for something and waits for the answer.
    ///
    /// If no answer comes in time the request is sent again, unless it does more than ask.
    pub async fn request<Q, A>(&self, request: &Q) -> Result<A>
    where
        Q: for<'b> Request<Answer<'b> = A> + ToWire,
        A: Message,
    {
        let payload = self.ask(request, A::ID).await?;
        Ok(request.decode_answer(&payload)?)
    }

    /// The same for answers that borrow from their payload.
    pub async fn exchange<Q: Request + ToWire + Clone>(&self, request: &Q) -> Result<Answer<Q>> {
        let payload = self.ask(request, <Q::Answer<'static> as Message>::ID).await?;
        Answer::new(request.clone(), payload)
    }

    async fn ask<Q: Message + ToWire>(&self, request: &Q, answer: CommandId) -> Result<Bytes> {
        self.request_raw(Q::ID, encode(request)?, answer).await
    }

    /// Sends a command and waits until the board confirms it. It is never sent again.
    ///
    /// When no confirmation comes, the command may have been carried out all the same.
    pub async fn confirm<M: Message + ToWire>(&self, command: &M) -> Result<Confirm> {
        let payload = self.request_raw(M::ID, encode(command)?, CommandId::CONFIRM).await?;
        Ok(Confirm::decode(&payload)?)
    }

    /// Sends a command without waiting for an answer. It is on its way when the next request is answered, or the link
    /// was [closed](Self::close).
    pub async fn send<M: Message + ToWire>(&self, command: &M) -> Result<()> {
        self.send_raw(M::ID, encode(command)?).await
    }

    /// Sends payload bytes as a command and waits for a frame with the id `answer`; see [`request`](Self::request).
    pub async fn request_raw(&self, command: CommandId, payload: Bytes, answer: CommandId) -> Result<Bytes> {
        let attempts = if only_reads(command, &payload, answer) { self.options.attempts.max(1) } else { 1 };
        self.ask_for(command, self.make_call(command, payload, answer, attempts)?).await
    }

    async fn ask_for(&self, command: CommandId, call: Call) -> Result<Bytes> {
        let span = tracing::debug_span!("request", command = name_of(command), outcome = field::Empty);
        let asked = async {
            let (reply, outcome) = oneshot::channel();
            self.link().call(|machine, now| machine.request(now, call, reply));
            let outcome = outcome.await.map_err(|_| self.gone())?;
            outcome.map_err(|failure| explain(command, failure))
        };
        let outcome = asked.instrument(span.clone()).await;
        match &outcome {
            Ok(answer) => span.record("outcome", field::display(format_args!("{} bytes", answer.len()))),
            Err(error) => span.record("outcome", field::display(error)),
        };
        outcome
    }

    /// Sends payload bytes as a command; see [`send`](Self::send).
    pub async fn send_raw(&self, command: CommandId, payload: Bytes) -> Result<()> {
        self.check(command, &payload)?;
        let began = tokio::time::Instant::now();
        let room = async {
            let _turn = self.handle.turn.lock().await;
            loop {
                let mut freed = std::pin::pin!(self.link().room.notified());
                freed.as_mut().enable();
                let sent = self.link().call(|machine, now| {
                    machine.has_room().then(|| machine.send(now, command.raw(), payload.clone()))
                });
                match sent {
                    Some(outcome) => return outcome.map_err(|failure| explain(command, failure)),
                    None => freed.await,
                }
            }
        };
        timeout(self.options.timeout.min(LONGEST), room).await.unwrap_or_else(|_| {
            Err(explain(command, Failure::Timeout { after: began.elapsed(), attempts: 0 }))
        })
    }

    /// Sends a command before everything else that waits, and returns at once.
    ///
    /// For commands that stop motion. It needs no runtime, so that it can be called when something is dropped.
    /// A set-point of the same command that was not sent yet is not sent any more, and the command goes out even if the
    /// last handle is dropped right after.
    ///
    /// # Errors
    /// If the message cannot be encoded, or the link has ended.
    pub fn send_now<M: Message + ToWire>(&self, command: &M) -> Result<()> {
        self.send_now_raw(M::ID, encode(command)?)
    }

    /// Like [`send_now`](Self::send_now), for payload bytes.
    ///
    /// # Errors
    /// If the payload is too long, or the link has ended.
    pub fn send_now_raw(&self, command: CommandId, payload: Bytes) -> Result<()> {
        self.check(command, &payload)?;
        let sent = self.link().call(|machine, now| machine.send_now(now, command.raw(), payload));
        sent.map_err(|failure| explain(command, failure))
    }

    /// Sends a command that says where to go or how fast, and returns at once.
    ///
    /// If one with the same id waits to be sent, or the port has not begun to take it, this one takes its place: a stale
    /// set-point is worse than none. Set-points overtake requests and commands that wait. That suits all of
    /// `CMD_CONTROL` and its kin, `CMD_SERVO_OUT`, `CMD_API_VIRT_CH_CONTROL`, `CMD_HELPER_DATA`.
    pub fn set<M: Message + ToWire>(&self, command: &M) -> Result<()> {
        let payload = encode(command)?;
        self.check(M::ID, &payload)?;
        let set = self.link().call(|machine, now| machine.set(now, M::ID.raw(), payload));
        set.map_err(|failure| explain(M::ID, failure))
    }

    /// Moves the gimbal; the newest command replaces those that were not yet sent. Returns at once.
    ///
    /// [`confirm`](Self::confirm) sends each and waits, [`control_and_wait`](Self::control_and_wait) waits until the
    /// target is reached.
    pub fn control(&self, control: &Control) -> Result<()> {
        self.set(control)
    }

    /// What the board is, and the version of its firmware.
    pub async fn board_info(&self) -> Result<BoardInfo> {
        self.request(&sbgc_proto::commands::BoardInfoRequest).await
    }

    /// More about what the board is.
    pub async fn board_info3(&self) -> Result<BoardInfo3> {
        self.request(&BoardInfo3Request).await
    }

    /// Where the camera points and where it should.
    pub async fn angles(&self) -> Result<Angles> {
        self.request(&GetAngles).await
    }

    /// The same, and how far the joints are turned.
    pub async fn angles_ext(&self) -> Result<AnglesExt> {
        self.request(&GetAnglesExt).await
    }

    /// The first block of the parameters of a profile.
    pub async fn params3(&self, profile: ProfileId) -> Result<Params3> {
        self.request(&ReadParams3 { profile_id: profile }).await
    }

    /// Switches the motors on.
    pub async fn motors_on(&self) -> Result<()> {
        self.confirm(&MotorsOn).await.map(drop)
    }

    /// Switches the motors off.
    pub async fn motors_off(&self, mode: MotorsOffMode) -> Result<()> {
        self.confirm(&MotorsOff { mode }).await.map(drop)
    }

    /// Runs a menu command.
    pub async fn execute_menu(&self, command: MenuCommand) -> Result<()> {
        self.confirm(&ExecuteMenu { cmd_id: command }).await.map(drop)
    }

    fn make_call(
        &self,
        command: CommandId,
        payload: Bytes,
        answer: CommandId,
        attempts: u32,
    ) -> Result<Call> {
        self.check(command, &payload)?;
        let expected = expected(command, &payload, answer);
        let priority = Priority::of(command.raw(), &payload);
        let timeout = self.options.timeout;
        Ok(Call {
            command: command.raw(),
            payload,
            expected,
            shape: None,
            timeout,
            attempts,
            priority,
            probe: None,
        })
    }

    fn check(&self, command: CommandId, payload: &Bytes) -> Result<()> {
        let (length, limit) = (payload.len(), self.version().safe_payload());
        if length > limit {
            return Err(Error::PayloadTooLong { command: name_of(command), length, limit });
        }
        if command.raw() == 0 {
            return Err(EncodeError::from(sbgc_proto::frame::EncodeFrameError::ZeroId).into());
        }
        Ok(())
    }

    pub(crate) fn link(&self) -> &Arc<Link> {
        &self.handle.link
    }

    /// Why the task does not answer.
    pub(crate) fn gone(&self) -> Error {
        match self.link().look(Machine::state) {
            LinkState::Open | LinkState::Closed => Error::Closed,
            _ => Error::Disconnected,
        }
    }
}

pub(crate) fn encode<M: Message + ToWire>(message: &M) -> Result<Bytes> {
    Ok(Bytes::copy_from_slice(message.encode(&mut [0; MAX_PAYLOAD])?))
}

/// What answers a request: as it is declared, or any message with the id `answer`.
fn expected(command: CommandId, payload: &[u8], answer: CommandId) -> Expected {
    let declared = Expected::of_payload(command, payload).filter(|expected| expected.answer() == answer);
    declared.unwrap_or(if answer == CommandId::CONFIRM {
        Expected::confirmation(command)
    } else {
        Expected::any(answer)
    })
}

/// Whether a request asks and does nothing else, so that it may be sent again.
fn only_reads(command: CommandId, payload: &[u8], answer: CommandId) -> bool {
    answer != CommandId::CONFIRM && !RequestInfo::of_payload(command, payload).is_some_and(|info| info.acts)
}

/// The spec's name of an outgoing command.
pub(crate) fn name_of(command: CommandId) -> &'static str {
    command.spec_name(Direction::Outgoing).unwrap_or("unknown command")
}

pub(crate) fn explain(command: CommandId, failure: Failure) -> Error {
    let name = name_of(command);
    match failure {
        Failure::Timeout { after, attempts } => Error::Timeout { command: name, after, attempts },
        Failure::Refused { code, data } => {
            Error::Refused { command: name, code, name: FailureCode::from_raw(command, code).name(), data }
        }
        Failure::Disconnected => Error::Disconnected,
        Failure::Closed => Error::Closed,
        Failure::StreamInUse { running_ms } => Error::StreamInUse { command: name, running_ms },
        Failure::Indistinct => Error::Indistinct { command: name },
        Failure::TooManyStreams => Error::TooManyStreams { maximum: MAX_STREAMS },
    }
}
