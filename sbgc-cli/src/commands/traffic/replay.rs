//! `sbgc replay`: what a capture's host sent, once more.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use sbgc_host::capture::{self, Captured, Format, ReplayStep};
use sbgc_proto::Direction;
use serde_json::json;

use super::danger::{changes, dangerous};
use super::decode::{From, read_all};
use super::explain::Explainer;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, talk, values};

const EXAMPLES: &str = "Examples:
  sbgc record moves.log --for 1s && sbgc replay moves.log
  sbgc record moves.log --for 1s && sbgc replay moves.log --speed 2 --json";

/// Send the outgoing frames of a capture again
///
/// Keeps the original timing where the capture has times. Asks first if a command among them changes what the board
/// keeps. --json prints each frame sent, then the outcome.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Replay {
    /// Capture; standard input for `-`
    file: PathBuf,

    /// Speed relative to the capture
    #[arg(long, value_name = "N", default_value = "1", value_parser = speed, allow_hyphen_values = true)]
    speed: f64,

    /// Capture format
    #[arg(long, value_enum, default_value_t)]
    from: From,
}

fn speed(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(speed) if (0.001..=1000.0).contains(&speed) => Ok(speed),
        _ => Err(format!("expected a number of 0.001 to 1000, got \"{text}\"")),
    }
}

impl Replay {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let items = read_all(&self.file, Format::from(self.from))?;
        let replay = capture::Replay::new(items);
        let frames = replay.steps().len();
        if frames == 0 {
            let place = self.file.display();
            return Err(Failure::Failed(format!("{place}: nothing to send: no outgoing frames found")));
        }
        if global.dry_run {
            for step in replay.steps().iter().filter(|step| changes(step.command, &step.payload)) {
                act::show_payload(output, global.version(), step.command, &step.payload)?;
            }
            return Ok(());
        }
        let dangers = dangerous(replay.steps().iter().map(|step| step.command));
        if !dangers.is_empty() {
            let duration = values::time_text(Duration::from_millis(
                u64::try_from(replay.duration().as_millis()).unwrap_or(u64::MAX),
            ));
            talk::say(format_args!("{frames} frames over {duration}, among them {}", dangers.join(", ")));
            act::ask(global, "Send them?").await?;
        }
        with_board(global, async |gimbal, _| {
            let began = Instant::now();
            let mut shown = Ok(());
            let mut explainer = Explainer::new(None, None, output);
            let mut at = 0;
            let mut show = |step: &ReplayStep| {
                at += 1;
                if explainer.output.is_json() && shown.is_ok() {
                    let frame = Captured::Frame {
                        at,
                        time: None,
                        version: Some(gimbal.version()),
                        direction: Some(Direction::Outgoing),
                        id: step.command.raw(),
                        payload: step.payload.to_vec(),
                    };
                    shown = explainer.print(frame).and_then(|()| explainer.output.flush());
                }
            };
            replay.run(&gimbal, self.speed, &mut show).await?;
            shown?;
            // Everything has left when the board has answered once more.
            gimbal.board_info().await?;
            let seconds = began.elapsed().as_secs_f64();
            let text = format!("{frames} frames sent in {seconds:.1} s");
            output.outcome("replay", State::Done, json!({"frames": frames}), text)?;
            Ok(())
        })
        .await
    }
}
