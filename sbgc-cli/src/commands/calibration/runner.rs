//! Showing a run from its start to its end.

use sbgc_host::Gimbal;
use sbgc_host::calibrate::{Calibration, CalibrationRun, CalibrationState, Step};
use sbgc_proto::commands::BoardInfo;
use serde_json::json;
use tokio::time::{Duration, timeout};

use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::progress::Bar;
use crate::{act, signals, talk};

/// How long the board may take to confirm that it gives up.
const GIVE_UP: Duration = Duration::from_secs(2);

/// What is run, and how.
pub(super) struct Plan {
    /// The command as it is typed.
    pub(super) command: &'static str,
    pub(super) calibration: Calibration,
    /// What to ask before; nothing for what is not dangerous.
    pub(super) question: Option<&'static str>,
    /// Time after which it is given up; otherwise as long as the calibration may take.
    pub(super) patience: Option<Duration>,
}

/// Runs the calibration and prints its steps.
pub(super) async fn carry_out(
    global: &Global,
    output: &mut Output,
    gimbal: &Gimbal,
    info: &BoardInfo,
    plan: Plan,
) -> Result<(), Failure> {
    let Plan { command, calibration, question, patience } = plan;
    if global.dry_run {
        let (id, payload) = calibration.command(info.firmware_ver)?;
        return act::show_payload(output, gimbal.version(), id, &payload);
    }
    talk::say(calibration.preparation());
    if let Some(question) = question {
        act::ask(global, question).await?;
    }
    let mut run = tokio::select! {
        biased;
        signal = signals::stopped() => return Err(Failure::Signal(signal)),
        run = CalibrationRun::start(gimbal, calibration) => run?,
    };
    let bar = Bar::part(global, command);
    let steps = timeout(patience.unwrap_or(Duration::MAX), show(output, &mut run, &bar));
    let outcome = tokio::select! {
        biased;
        signal = signals::stopped() => Err(Failure::Signal(signal)),
        last = steps => last.unwrap_or_else(|_| Err(Failure::Failed(String::from("not finished in time")))),
    };
    drop(bar);
    match outcome {
        Ok(step) => {
            let state = if step.state == CalibrationState::Done { State::Done } else { State::Failed };
            let own = json!({"progress": step.progress, "message": step.message});
            let text = format_args!("{command}: {}", step.message).to_string();
            output.outcome(command, state, own, text)?;
            match state {
                State::Done => Ok(()),
                _ => Err(Failure::Failed(format!("{command}: {}", step.message))),
            }
        }
        Err(failure) => {
            // What ended it says more than that the board did not confirm the end, which was sent all the same.
            let _ = timeout(GIVE_UP, run.cancel()).await;
            if matches!(failure, Failure::Signal(_) | Failure::Failed(_)) {
                let own = json!({"progress": null, "message": failure.to_string()});
                output.outcome(command, State::Cancelled, own, format_args!("{command}: cancelled"))?;
            }
            Err(failure)
        }
    }
}

/// Prints all steps but the last one, which it returns.
async fn show(output: &mut Output, run: &mut CalibrationRun, bar: &Bar) -> Result<Step, Failure> {
    let mut before = None;
    loop {
        let step = run.next().await?;
        let word = match step.state {
            CalibrationState::Done | CalibrationState::Failed => return Ok(step),
            CalibrationState::Waiting => "waiting",
            CalibrationState::Running => "running",
            CalibrationState::Cancelled => "cancelled",
        };
        bar.show_part(step.progress.unwrap_or_default().into(), step.message.clone());
        if before.as_ref() == Some(&step) {
            continue;
        }
        if output.is_json() {
            let progress = step.progress.map(crate::values::plain);
            output.object(&json!({"state": word, "progress": progress, "message": step.message}))?;
            output.flush()?;
        }
        before = Some(step);
    }
}
