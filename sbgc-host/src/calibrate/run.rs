//! One calibration from its start to its end.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{
    AutoPid, BodeTestData, BodeTestStartStop, CalibAction, CalibImu, CalibInfo, CalibInfoRequest, CalibMode,
    Confirm, FailureCode, ImuType, MotorsOff, MotorsOffMode, RealtimeData4, RealtimeData4Request,
    RtDataFlags, SystemErrors, SystemSubError,
};
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, Message};
use tokio::time::{Instant, sleep_until, timeout_at};

use super::kind::{Calibration, End, Facts};
use super::tune::stop_tuning;
use crate::control::Claim;
use crate::error::{Error, Result};
use crate::gimbal::Gimbal;
use crate::streams::{Sample, Subscription};

/// How often the board is asked how it goes.
const POLL: Duration = Duration::from_millis(250);

/// How long it may take until real-time data reports the mode of a calibration that was accepted. What has not shown
/// it until then was done at once.
const SHOWS: Duration = Duration::from_millis(1200);

/// How many questions in a row may stay without an answer: while it calibrates, a board may be busy.
const SILENT: u32 = 8;

/// How a run stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CalibrationState {
    /// The board has taken the command.
    Waiting,
    /// It goes on.
    Running,
    /// It has ended well.
    Done,
    /// It has ended otherwise.
    Failed,
    /// It was given up.
    Cancelled,
}

/// A step of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// How it stands; nothing follows after [`CalibrationState::Done`] and [`CalibrationState::Failed`].
    pub state: CalibrationState,
    /// How much is done, 0 to 1, where the board reports it.
    pub progress: Option<f32>,
    /// What happens, or why it failed.
    pub message: String,
}

/// A calibration that runs on a board.
///
/// Dropping it before its end stops the motion of those that move: tuning by its own command, others by switching the
/// motors off gently. A calibration of a sensor cannot be stopped; the board completes it.
#[derive(Debug)]
pub struct CalibrationRun {
    gimbal: Gimbal,
    calibration: Calibration,
    facts: Facts,
    firmware: FirmwareVersion,
    command: CommandId,
    events: Events,
    began: Instant,
    next_poll: Instant,
    /// Errors of the board before it began.
    errors_before: SystemErrors,
    announced: bool,
    seen_mode: bool,
    mode_gone: Option<Instant>,
    silent: u32,
    samples: u32,
    progress: Option<f32>,
    ended: bool,
    _claim: Claim,
}

/// What the board says by itself.
#[derive(Debug)]
struct Events {
    confirmations: Subscription,
    errors: Subscription,
    resets: Subscription,
    /// The message that ends it, or one that nobody sends.
    last: Subscription,
    tuning: Subscription,
    bode: Subscription,
}

enum Event {
    Confirm(Bytes),
    Error(Bytes),
    Reset,
    Last(Bytes),
    Tuning(Bytes),
    Bode(Bytes),
    Poll,
    TimeOut,
    Gone,
}

impl CalibrationRun {
    /// Checks what the calibration needs, and starts it.
    ///
    /// # Errors
    /// If a control session or another run on this connection has control, if the motors are not as they have to be
    /// ([`Error::MotorsMustBe`]), or if the board refuses it.
    pub async fn start(gimbal: &Gimbal, calibration: Calibration) -> Result<Self> {
        let claim = Claim::take(gimbal)?;
        let facts = calibration.facts();
        let firmware = gimbal.board_info().await?.firmware_ver;
        let (command, payload) = calibration.command(firmware)?;
        let before = gimbal.request(&RealtimeData4Request {}).await?;
        if let Some(on) = facts.motors
            && before.realtime_data_3.rt_data_flags.contains(RtDataFlags::MOTORS_ON) != on
        {
            return Err(Error::MotorsMustBe { on });
        }
        let last = match facts.end {
            End::Message(command) => command,
            _ => CommandId::Reset,
        };
        let listen = |command| gimbal.listen(command);
        let mut run = Self {
            events: Events {
                confirmations: listen(CommandId::CONFIRM),
                errors: listen(CommandId::Error),
                resets: listen(CommandId::Reset),
                last: listen(last),
                tuning: listen(CommandId::AutoPid),
                bode: listen(CommandId::BodeTestData),
            },
            gimbal: gimbal.clone(),
            calibration,
            facts,
            firmware,
            command,
            began: Instant::now(),
            next_poll: Instant::now() + POLL,
            errors_before: before.realtime_data_3.system_error,
            announced: false,
            seen_mode: false,
            mode_gone: None,
            silent: 0,
            samples: 0,
            progress: None,
            ended: false,
            _claim: claim,
        };
        let started = if facts.confirmed {
            gimbal.request_raw(command, payload, CommandId::CONFIRM).await.map(drop)
        } else if facts.end == End::First {
            gimbal.send_raw(command, payload).await
        } else {
            gimbal.send_checked_raw(command, payload).await.map(drop)
        };
        // What was refused does not move, and nothing has to stop it.
        run.ended = matches!(started, Err(Error::Refused { .. }));
        started?;
        if facts.confirmed && facts.end != End::First {
            // That was the first one.
            run.events.confirmations = gimbal.listen(CommandId::CONFIRM);
        }
        run.began = Instant::now();
        Ok(run)
    }

    /// The next step: when something happens, and four times per second.
    ///
    /// Giving up by dropping the future loses nothing; call it again, or drop the run.
    ///
    /// # Errors
    /// If the link is gone, or the board does not answer any more.
    pub async fn next(&mut self) -> Result<Step> {
        if !self.announced {
            self.announced = true;
            return Ok(self.step(CalibrationState::Waiting, "accepted"));
        }
        loop {
            let event = self.event().await;
            if let Some(step) = self.take(event).await? {
                self.ended |= matches!(step.state, CalibrationState::Done | CalibrationState::Failed);
                return Ok(step);
            }
        }
    }

    /// Gives the run up, and stops the motion if there is one; see [`CalibrationRun`].
    ///
    /// # Errors
    /// If the board does not confirm that; the command was sent all the same.
    pub async fn cancel(mut self) -> Result<()> {
        if self.ended {
            return Ok(());
        }
        let Some((command, payload)) = self.stop_command() else {
            self.ended = true;
            return Ok(());
        };
        self.gimbal.request_raw(command, payload, CommandId::CONFIRM).await?;
        self.ended = true;
        Ok(())
    }

    /// What stops it, if it moves.
    fn stop_command(&self) -> Option<(CommandId, Bytes)> {
        match self.calibration {
            Calibration::Tuning(_) => stop_tuning(self.firmware).ok(),
            _ if self.facts.moves => super::tune::frame(&MotorsOff { mode: MotorsOffMode::SafeStop }).ok(),
            _ => None,
        }
    }

    async fn event(&mut self) -> Event {
        let deadline = self.began + self.facts.timeout;
        let Events { confirmations, errors, resets, last, tuning, bode } = &mut self.events;
        let payload = |sample: Option<Sample>, make: fn(Bytes) -> Event| match sample {
            Some(Sample::Payload(payload)) => make(Bytes::copy_from_slice(&payload)),
            Some(_) => Event::Poll,
            None => Event::Gone,
        };
        tokio::select! {
            biased;
            sample = errors.next() => payload(sample, Event::Error),
            sample = last.next() => payload(sample, Event::Last),
            sample = confirmations.next() => payload(sample, Event::Confirm),
            sample = resets.next() => payload(sample, |_| Event::Reset),
            sample = tuning.next() => payload(sample, Event::Tuning),
            sample = bode.next() => payload(sample, Event::Bode),
            () = sleep_until(deadline) => Event::TimeOut,
            () = sleep_until(self.next_poll) => Event::Poll,
        }
    }

    async fn take(&mut self, event: Event) -> Result<Option<Step>> {
        Ok(match event {
            Event::Gone => return Err(self.gimbal.gone()),
            Event::TimeOut => {
                let seconds = self.facts.timeout.as_secs();
                Some(self.step(CalibrationState::Failed, &format!("not finished within {seconds} s")))
            }
            Event::Confirm(payload) => self.confirmed(&payload).await,
            Event::Error(payload) => self.refused(&payload),
            Event::Reset | Event::Last(_) if self.restarts() => Some(self.done("the board restarts")),
            Event::Reset => Some(self.step(CalibrationState::Failed, "the board has restarted")),
            Event::Last(payload) => match self.facts.end {
                End::Message(CommandId::BodeTestStartStop) => Some(self.bode_ended(&payload)),
                End::Message(_) => self.settle().await,
                _ => None,
            },
            Event::Tuning(payload) => AutoPid::decode(&payload).ok().map(|report| self.tuning(&report)),
            Event::Bode(payload) => {
                if let Ok(data) = BodeTestData::decode(&payload) {
                    self.samples =
                        self.samples.saturating_add(u32::try_from(data.samples.len()).unwrap_or_default());
                }
                if let Calibration::Bode(test) = self.calibration {
                    self.progress = Some(part(f64::from(self.samples), f64::from(test.samples.max(1))));
                }
                None
            }
            Event::Poll => self.poll().await?,
        })
    }

    async fn confirmed(&mut self, payload: &[u8]) -> Option<Step> {
        let confirm = Confirm::decode(payload).ok().filter(|confirm| confirm.cmd_id == self.command)?;
        match self.facts.end {
            End::First | End::Second => self.settle().await,
            End::Confirmed(data) if confirm.data.value() == data => self.settle().await,
            _ => None,
        }
    }

    fn refused(&mut self, payload: &[u8]) -> Option<Step> {
        let code = match *payload {
            [code] | [code, _, _, _, _] => code,
            [command, code, ..] if command == self.command.raw() => code,
            _ => return None,
        };
        let name = FailureCode::from_raw(self.command, code).name().unwrap_or("unknown error");
        Some(self.step(CalibrationState::Failed, &format!("the board gave up with error {code} ({name})")))
    }

    /// Whether the board restarts at its end.
    fn restarts(&self) -> bool {
        use CalibAction::{DisableTempCalibAndRestart, EnableTempCalibAndRestart, ResetAllAndRestart};

        matches!(
            self.calibration,
            Calibration::Accelerometer(_, action)
                | Calibration::Gyroscope(_, action)
                | Calibration::Magnetometer(_, action)
                if matches!(action, ResetAllAndRestart | EnableTempCalibAndRestart | DisableTempCalibAndRestart)
        )
    }

    fn bode_ended(&self, payload: &[u8]) -> Step {
        match BodeTestStartStop::decode(payload) {
            Ok(end) if end.error_code == 0 => self.done(&format!("{} samples", end.samples_count)),
            Ok(end) => self.step(CalibrationState::Failed, &format!("error {}", end.error_code)),
            Err(error) => self.step(CalibrationState::Failed, &error.to_string()),
        }
    }

    fn tuning(&mut self, report: &AutoPid) -> Step {
        let gains: Vec<String> = [("P", report.p), ("I", report.i), ("D", report.d)]
            .map(|(name, values)| {
                let [roll, pitch, yaw] = values.into_array();
                format!("{name} {roll}/{pitch}/{yaw}")
            })
            .to_vec();
        let [roll, pitch, yaw] = report.axes.map(|axis| axis.tracking_error.get()).into_array();
        let message = format!(
            "iteration {}: {}, error {roll:.2}/{pitch:.2}/{yaw:.2}",
            report.iteration_cnt,
            gains.join(", ")
        );
        self.step(CalibrationState::Running, &message)
    }

    /// It seems to have ended: whether well, the errors of the board say.
    async fn settle(&mut self) -> Option<Step> {
        let Ok(state) = self.state().await else { return Some(self.done("done")) };
        let relevant = SystemErrors::CALIB_POLES | SystemErrors::EMERGENCY_STOP | SystemErrors::NO_SENSOR;
        let new = state.realtime_data_3.system_error & relevant & !self.errors_before;
        if self.facts.moves && !new.is_empty() {
            let reason = sub_error(state.realtime_data_3.system_sub_error);
            return Some(self.step(CalibrationState::Failed, &reason));
        }
        Some(self.done("done"))
    }

    async fn state(&self) -> Result<RealtimeData4> {
        self.gimbal.request(&RealtimeData4Request {}).await
    }

    async fn poll(&mut self) -> Result<Option<Step>> {
        let deadline = self.began + self.facts.timeout;
        let asked = timeout_at(deadline, self.ask()).await;
        self.next_poll = Instant::now() + POLL;
        match asked {
            Ok(Ok(step)) => {
                self.silent = 0;
                Ok(step)
            }
            Ok(Err(Error::Timeout { .. } | Error::Refused { .. })) if self.silent < SILENT => {
                self.silent += 1;
                Ok(None)
            }
            Ok(Err(error)) => Err(error),
            Err(_) => Ok(None),
        }
    }

    async fn ask(&mut self) -> Result<Option<Step>> {
        let state = self.state().await?;
        let mode = state.calib_mode;
        if mode != CalibMode::None && (mode == self.facts.mode || self.is_sensor()) {
            self.seen_mode = true;
            let message = match self.imu() {
                Some(imu) => self.sensor(imu).await?,
                None => String::from("running"),
            };
            return Ok(Some(self.step(CalibrationState::Running, &message)));
        }
        let late = self.began.elapsed() >= SHOWS;
        Ok(match self.facts.end {
            // The mode has come and gone, or what was accepted was done at once.
            End::Mode if self.seen_mode || late => self.settle().await,
            // What ends it is on its way, or was lost.
            End::Message(_) | End::Second | End::Confirmed(_) if self.seen_mode => {
                let gone = *self.mode_gone.get_or_insert_with(Instant::now);
                if gone.elapsed() >= SHOWS { self.settle().await } else { None }
            }
            _ => None,
        })
    }

    fn is_sensor(&self) -> bool {
        self.imu().is_some()
    }

    /// The sensor that is calibrated.
    fn imu(&self) -> Option<ImuType> {
        match self.calibration {
            Calibration::Accelerometer(imu, _)
            | Calibration::Gyroscope(imu, _)
            | Calibration::Magnetometer(imu, _) => {
                Some(if imu == CalibImu::Frame { ImuType::Frame } else { ImuType::Main })
            }
            _ => None,
        }
    }

    /// How the calibration of a sensor goes.
    async fn sensor(&mut self, imu_type: ImuType) -> Result<String> {
        let info: CalibInfo =
            self.gimbal.request(&CalibInfoRequest { imu_type, ..CalibInfoRequest::default() }).await?;
        self.progress = Some(part(info.progress.into(), 100.0));
        Ok(match self.calibration {
            Calibration::Accelerometer(..) => {
                let done = info.acc_limits_info.bits().count_ones();
                format!("axis {:?}, {done} of 6 limits calibrated", info.acc_cur_axis)
            }
            Calibration::Gyroscope(..) => format!("movement {}", info.gyro_abs_val),
            _ => format!("heading error {}", info.h_err_length),
        })
    }

    fn done(&self, message: &str) -> Step {
        Step { progress: Some(1.0), ..self.step(CalibrationState::Done, message) }
    }

    fn step(&self, state: CalibrationState, message: &str) -> Step {
        Step { state, progress: self.progress, message: message.to_owned() }
    }
}

impl Drop for CalibrationRun {
    fn drop(&mut self) {
        if !self.ended
            && let Some((command, payload)) = self.stop_command()
        {
            // The link may be gone; then nothing can be done.
            let _ = self.gimbal.send_now_raw(command, payload);
        }
    }
}

fn sub_error(error: SystemSubError) -> String {
    let label = SystemSubError::LABELS.iter().find(|label| label.value == i64::from(error.raw()));
    match label {
        Some(label) => format!("the board reports {}: {}", label.name, label.doc.trim_end_matches('.')),
        None => format!("the board reports error {}", error.raw()),
    }
}

#[allow(clippy::cast_possible_truncation, reason = "a part of a whole")]
fn part(done: f64, all: f64) -> f32 {
    (done / all).clamp(0.0, 1.0) as f32
}
