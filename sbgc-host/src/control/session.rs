//! The session: one owner, one set-point, repeated until it ends.
//!
//! Whatever is sent goes out under one lock with the decision whether the session still runs, so that nothing moves the
//! gimbal after the command that stops it.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use sbgc_proto::commands::{
    Control, ControlAxis, ControlAxisConfig, ControlConfig, ControlConfigFlags, ControlMode, ControlQuat,
};
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::wire::PerAxis;
use tokio::task::AbortHandle;
use tokio::time::{Instant, MissedTickBehavior};
use tracing::Instrument;

use super::Claim;
use super::setpoint::{Command, Setpoint, adapted};
use crate::motion::Arrival;
use crate::{Error, Gimbal, Result};

/// The first firmware with a time-out of control.
pub(super) const TIMEOUT_SINCE: FirmwareVersion = FirmwareVersion::new(2, 61, 0);

/// The first firmware in which confirmations of control commands can be switched off.
const NO_CONFIRM_SINCE: FirmwareVersion = FirmwareVersion::new(2, 66, 2);

/// How often the time-out is armed anew, for a board that has restarted since.
const REARM: Duration = Duration::from_secs(1);

/// Set-points are repeated no faster than the board reads its input, and no slower than this.
const INTERVALS: [Duration; 2] = [Duration::from_millis(8), Duration::from_millis(250)];

/// How a session controls the gimbal.
///
/// ```
/// use std::time::Duration;
/// use sbgc_host::SessionOptions;
///
/// let options = SessionOptions { interval: Duration::from_millis(10), ..SessionOptions::default() };
/// assert_eq!(options.timeout, Some(Duration::from_secs(1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SessionOptions {
    /// Time without a set-point after which the board ends control by itself. `None` switches this protection off: if
    /// the process is killed, the gimbal goes on turning.
    pub timeout: Option<Duration>,
    /// Time between set-points, 8 to 250 ms. The board works best at 8 to 20 ms.
    pub interval: Duration,
    /// Whether the board confirms each set-point. Needed by [`ControlSession::apply`] and [`ControlSession::move_to`]
    /// to learn of refusals, a burden in fast loops.
    pub confirmations: bool,
    /// Filters and limits of each axis; 0 leaves each as it is.
    pub axes: PerAxis<ControlAxisConfig>,
    /// Curve of the signals of [`Setpoint::rc`]; 0 leaves it as it is.
    pub rc_expo_rate: u8,
}

impl Default for SessionOptions {
    /// 50 set-points per second, a time-out of one second, no confirmations.
    fn default() -> Self {
        Self {
            timeout: Some(Duration::from_secs(1)),
            interval: Duration::from_millis(20),
            confirmations: false,
            axes: PerAxis::default(),
            rc_expo_rate: 0,
        }
    }
}

impl SessionOptions {
    /// What the board is told at the start, and again and again.
    fn config(&self, firmware: FirmwareVersion) -> ControlConfig {
        let timeout = self.timeout.map_or(0, |timeout| timeout.as_millis().clamp(1, u16::MAX.into()));
        let quiet = !self.confirmations && firmware >= NO_CONFIRM_SINCE;
        ControlConfig {
            timeout_ms: u16::try_from(timeout).unwrap_or(u16::MAX),
            axes: self.axes,
            rc_expo_rate: self.rc_expo_rate,
            flags: if quiet { ControlConfigFlags::NO_CONFIRM } else { ControlConfigFlags::empty() },
            ..ControlConfig::default()
        }
    }
}

/// Control of a gimbal by one owner.
///
/// The newest set-point is repeated by itself at the rate of the options, and the board's own time-out is armed.
/// Dropping the session stops the axes that it moved, disarms the time-out and returns control to the board's other
/// sources, such as radio control. So does a panic or a cancelled task, as long as the runtime lives long enough to
/// send; when the process is killed, the board's time-out does it. [`stop`](Self::stop) is the same with
/// confirmations, [`hold`](Self::hold) leaves the axes where they were told to go.
///
/// ```no_run
/// use sbgc_host::proto::wire::PerAxis;
/// use sbgc_host::{ControlSession, Gimbal, SessionOptions, Setpoint};
///
/// # async fn example(gimbal: &Gimbal) -> sbgc_host::Result<()> {
/// let session = ControlSession::start(gimbal, SessionOptions::default()).await?;
/// session.set(Setpoint::speeds(PerAxis { yaw: Some(20.0), ..PerAxis::default() })?)?;
/// tokio::time::sleep(std::time::Duration::from_secs(2)).await;
/// session.stop().await?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
#[must_use = "dropping it stops the gimbal"]
pub struct ControlSession {
    inner: Arc<Inner>,
    repeater: AbortHandle,
    _claim: Claim,
}

#[derive(Debug)]
struct Inner {
    gimbal: Gimbal,
    options: SessionOptions,
    firmware: FirmwareVersion,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    newest: Option<Setpoint>,
    /// The axes that were moved so far.
    moved: PerAxis<bool>,
    by_quaternion: bool,
    phase: Phase,
}

impl State {
    /// Remembers a set-point as the one to be repeated.
    fn note(&mut self, setpoint: Setpoint) {
        if let Command::Quaternion(_) = setpoint.command {
            self.by_quaternion = true;
        } else {
            let PerAxis { roll, pitch, yaw } = setpoint.moves();
            self.moved.roll |= roll;
            self.moved.pitch |= pitch;
            self.moved.yaw |= yaw;
        }
        self.newest = Some(setpoint);
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Phase {
    /// Set-points are repeated.
    #[default]
    Running,
    /// The commands that end it are on their way.
    Ending,
    /// Nothing more is to be sent.
    Ended,
}

impl ControlSession {
    /// Takes control: asks the board for its firmware and sets up how it handles control commands.
    ///
    /// # Errors
    /// If another session or a calibration on this connection has control, if the options are out of range, if the
    /// firmware has no time-out ([`Error::TooOld`]), or if the board does not answer.
    ///
    /// # Panics
    /// Outside of a tokio runtime.
    pub async fn start(gimbal: &Gimbal, options: SessionOptions) -> Result<Self> {
        check(&options)?;
        let claim = Claim::take(gimbal)?;
        let firmware = gimbal.board_info().await?.firmware_ver;
        if options.timeout.is_some() && firmware < TIMEOUT_SINCE {
            let what = "the time-out of serial control";
            return Err(Error::TooOld { what, since: TIMEOUT_SINCE, firmware });
        }
        let state = Mutex::default();
        let inner = Arc::new(Inner { gimbal: gimbal.clone(), options, firmware, state });
        // From here on whatever happens disarms the time-out: it would end moves of others that are left to the board.
        let repeating = repeat(Arc::clone(&inner)).instrument(tracing::debug_span!("control session"));
        let repeater = tokio::spawn(repeating).abort_handle();
        let session = Self { inner, repeater, _claim: claim };
        if firmware >= TIMEOUT_SINCE {
            session.inner.confirm_config(&options.config(firmware)).await?;
        }
        Ok(session)
    }

    /// The firmware of the board.
    pub fn firmware(&self) -> FirmwareVersion {
        self.inner.firmware
    }

    /// Makes this the set-point that is repeated from now on, and sends it. Returns at once.
    ///
    /// It may be called at any rate: what the board cannot take in time is replaced by the next.
    ///
    /// # Errors
    /// If the firmware does not know such a set-point, or the link is gone.
    pub fn set(&self, setpoint: Setpoint) -> Result<()> {
        let setpoint = setpoint.for_firmware(self.inner.firmware)?;
        self.inner.put(&mut lock(&self.inner.state), setpoint)
    }

    /// Like [`set`](Self::set), and waits until the board confirms it.
    ///
    /// # Errors
    /// If the board refuses it, or does not confirm it; without
    /// [`confirmations`](SessionOptions::confirmations) nothing is waited for.
    pub async fn apply(&self, setpoint: Setpoint) -> Result<()> {
        let setpoint = setpoint.for_firmware(self.inner.firmware)?;
        if !self.inner.options.confirmations {
            return self.inner.put(&mut lock(&self.inner.state), setpoint);
        }
        lock(&self.inner.state).note(setpoint);
        match &setpoint.command {
            Command::Axes(control) => self.inner.gimbal.confirm(control).await.map(drop),
            Command::Extended(control) => self.inner.gimbal.confirm(control).await.map(drop),
            Command::Quaternion(control) => self.inner.gimbal.set(control),
        }
    }

    /// Moves to angles and waits until the gimbal is there; the session then goes on and holds it there.
    ///
    /// # Errors
    /// If the set-point is not one of angles, if the board refuses it, or if it is not reached `within` this time
    /// ([`Error::NotReached`]). The axes keep moving until the session ends.
    pub async fn move_to(&self, setpoint: Setpoint, within: Duration) -> Result<()> {
        let setpoint = setpoint.with_auto_task().for_firmware(self.inner.firmware)?;
        let Command::Axes(control) = setpoint.command else {
            return self.apply(setpoint).await;
        };
        let arrival = Arrival::watch(&self.inner.gimbal, control, within);
        if self.inner.options.confirmations {
            lock(&self.inner.state).note(setpoint);
            arrival.started(self.inner.gimbal.confirm(&control)).await?;
        } else {
            self.set(setpoint)?;
        }
        arrival.wait().await
    }

    /// Stops the axes that were moved, disarms the time-out and returns control; waits until the board confirms it.
    ///
    /// # Errors
    /// If the board does not confirm it; the same is then sent once more without waiting.
    pub async fn stop(self) -> Result<()> {
        let ending = self.begin_to_end();
        if let Some(control) = &ending.quaternion {
            self.inner.gimbal.set(control)?;
        }
        if let Some(control) = &ending.stop {
            self.confirm(control).await?;
        }
        self.disarm().await?;
        if let Some(control) = &ending.give_back {
            self.confirm(control).await?;
        }
        self.set_phase(Phase::Ended);
        Ok(())
    }

    /// Ends the session and leaves the axes to what they were told last: disarms the time-out and nothing else.
    ///
    /// # Errors
    /// If the board does not confirm it; the axes are then stopped, since the time-out may end the motion anyway.
    pub async fn hold(self) -> Result<()> {
        self.begin_to_end();
        self.disarm().await?;
        self.set_phase(Phase::Ended);
        Ok(())
    }

    /// Sends a command and waits for its confirmation, where there is one.
    async fn confirm(&self, control: &Control) -> Result<()> {
        if self.inner.options.confirmations {
            self.inner.gimbal.confirm(control).await.map(drop)
        } else {
            self.inner.gimbal.set(control)
        }
    }

    async fn disarm(&self) -> Result<()> {
        if self.inner.firmware < TIMEOUT_SINCE {
            return Ok(());
        }
        self.inner.confirm_config(&ControlConfig::default()).await
    }

    /// From here on nothing is repeated.
    fn begin_to_end(&self) -> Ending {
        let mut state = lock(&self.inner.state);
        state.phase = Phase::Ending;
        Ending::of(&state, &self.inner)
    }

    fn set_phase(&self, phase: Phase) {
        lock(&self.inner.state).phase = phase;
    }
}

impl Drop for ControlSession {
    fn drop(&mut self) {
        self.repeater.abort();
        let mut state = lock(&self.inner.state);
        if state.phase == Phase::Ended {
            return;
        }
        state.phase = Phase::Ended;
        Ending::of(&state, &self.inner).send_now(&self.inner);
    }
}

impl Inner {
    fn put(&self, state: &mut State, setpoint: Setpoint) -> Result<()> {
        state.note(setpoint);
        self.send(&setpoint)
    }

    fn send(&self, setpoint: &Setpoint) -> Result<()> {
        match &setpoint.command {
            Command::Axes(control) => self.gimbal.set(control),
            Command::Extended(control) => self.gimbal.set(control),
            Command::Quaternion(control) => self.gimbal.set(control),
        }
    }

    /// Sends settings until the board confirms them; sending them twice does no harm.
    async fn confirm_config(&self, config: &ControlConfig) -> Result<()> {
        let mut outcome = self.gimbal.confirm(config).await;
        for _ in 1..self.gimbal.options().attempts {
            if !matches!(outcome, Err(Error::Timeout { .. })) {
                break;
            }
            outcome = self.gimbal.confirm(config).await;
        }
        outcome.map(drop)
    }
}

/// Repeats the newest set-point, and now and then the settings.
async fn repeat(inner: Arc<Inner>) {
    let mut ticks = tokio::time::interval(inner.options.interval);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut armed = Instant::now();
    loop {
        ticks.tick().await;
        let state = lock(&inner.state);
        if state.phase != Phase::Running {
            return;
        }
        let Some(setpoint) = &state.newest else { continue };
        let mut sent = inner.send(setpoint);
        if inner.firmware >= TIMEOUT_SINCE && armed.elapsed() >= REARM {
            armed = Instant::now();
            sent = sent.and(inner.gimbal.set(&inner.options.config(inner.firmware)));
        }
        if let Err(error) = sent {
            if inner.gimbal.is_reconnecting() {
                // The board stops by itself meanwhile, and goes on with the newest set-point.
                continue;
            }
            tracing::debug!(%error, "control session ended");
            return;
        }
    }
}

/// What is sent when a session ends.
struct Ending {
    stop: Option<Control>,
    quaternion: Option<ControlQuat>,
    give_back: Option<Control>,
}

impl Ending {
    fn of(state: &State, inner: &Inner) -> Self {
        let moved = state.moved;
        let all = |mode| Control {
            control_mode: moved.map(|moved| if moved { mode } else { ControlMode::IGNORE }),
            axes: PerAxis::<ControlAxis>::default(),
        };
        let any = moved.into_array().contains(&true);
        let command = |mode| any.then(|| adapted(all(mode), inner.firmware));
        Self {
            stop: command(ControlMode::SPEED),
            quaternion: state.by_quaternion.then(ControlQuat::disable),
            give_back: command(ControlMode::NO_CONTROL),
        }
    }

    /// Hands everything to the link without waiting.
    fn send_now(&self, inner: &Inner) {
        let gimbal = &inner.gimbal;
        // The link may be gone; then the board's time-out stops the gimbal.
        let _ = self.stop.as_ref().map(|control| gimbal.send_now(control));
        let _ = self.quaternion.as_ref().map(|control| gimbal.send_now(control));
        if inner.firmware >= TIMEOUT_SINCE {
            let _ = gimbal.send_now(&ControlConfig::default());
        }
        let _ = self.give_back.as_ref().map(|control| gimbal.send_now(control));
    }
}

fn check(options: &SessionOptions) -> Result<()> {
    let milliseconds = |time: Duration| time.as_secs_f64() * 1000.0;
    let [shortest, longest] = INTERVALS;
    if !(shortest..=longest).contains(&options.interval) {
        return Err(Error::OutOfRange {
            what: "interval of set-points",
            value: milliseconds(options.interval),
            minimum: milliseconds(shortest),
            maximum: milliseconds(longest),
            unit: "ms",
        });
    }
    if let Some(timeout) = options.timeout
        && !(2 * options.interval..=Duration::from_millis(u16::MAX.into())).contains(&timeout)
    {
        return Err(Error::OutOfRange {
            what: "time-out of control",
            value: milliseconds(timeout),
            minimum: milliseconds(2 * options.interval),
            maximum: u16::MAX.into(),
            unit: "ms",
        });
    }
    Ok(())
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
