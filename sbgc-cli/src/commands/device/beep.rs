//! `sbgc beep`: sounds.

use std::time::Duration;

use clap::Args;
use sbgc_host::actions::{melody, sound};
use sbgc_proto::commands::{BeepSound, BeepSoundMode};
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, text, values};

const EXAMPLES: &str = "Examples:
  sbgc beep
  sbgc beep C5 E5 G5 - C6 --length 150ms
  sbgc beep --sound complete";

/// Play a sound or a melody
///
/// Notes are names (C5, F#5, Bb5), frequencies (880Hz) or - for a pause. The board plays 554 Hz and up; a melody with
/// lower notes is played octaves higher.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Beep {
    /// Notes to play, at most 50 [default: the sound of a confirmation]
    #[arg(value_name = "NOTE")]
    notes: Vec<String>,

    /// Length of each note, 8ms to 2040ms
    #[arg(long, value_name = "TIME", default_value = "200ms", value_parser = values::timeout)]
    length: Duration,

    /// Standard sound to play: calibrate, confirm, error, click, complete or intro
    #[arg(long, value_name = "NAME", conflicts_with = "notes", value_parser = standard)]
    sound: Option<BeepSoundMode>,
}

fn standard(name: &str) -> Result<BeepSoundMode, String> {
    let short = |name: &str| name.trim_start_matches("BEEPER_MODE_").to_ascii_lowercase();
    let known = || BeepSoundMode::LABELS.iter().filter(|label| short(label.name) != "custom_melody");
    match known().find(|label| short(label.name) == short(&name.to_ascii_uppercase())) {
        Some(label) => Ok(BeepSoundMode::from_bits_retain(u16::try_from(label.value).unwrap_or_default())),
        None => {
            let names: Vec<String> = known().map(|label| short(label.name)).collect();
            Err(text::unknown("sound", name, names.iter().map(String::as_str)))
        }
    }
}

impl Beep {
    fn command(&self) -> Result<BeepSound, Failure> {
        if self.notes.is_empty() {
            return Ok(sound(self.sound.unwrap_or(BeepSoundMode::CONFIRM)));
        }
        let notes: Vec<&str> = self.notes.iter().map(String::as_str).collect();
        Ok(melody(&notes, self.length)?)
    }

    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let command = self.command()?;
        with_board(global, async |gimbal, _| {
            if global.dry_run {
                return act::show(output, gimbal.version(), &command);
            }
            gimbal.send_checked(&command).await?;
            Ok(output.outcome("beep", State::Accepted, json!({"notes": self.notes}), "accepted")?)
        })
        .await
    }
}
