//! `sbgc motors`: power of the motors.

use clap::{Args, ValueEnum};
use sbgc_proto::commands::{MotorsOff, MotorsOffMode, MotorsOn};
use serde_json::json;

use crate::act;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};

const EXAMPLES: &str = "Examples:
  sbgc motors on
  sbgc motors off --json";

/// Turn the motors on or off
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Motors {
    /// What to do
    #[arg(value_enum)]
    switch: Switch,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Switch {
    /// Power the motors
    On,
    /// Cut power; an unbalanced camera will drop
    Off,
}

impl Motors {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| {
            let (on, command, text) = match self.switch {
                Switch::On => (true, "motors on", "motors on"),
                Switch::Off => (false, "motors off", "motors off"),
            };
            let confirmed = if on {
                act::confirm(global, output, &gimbal, &MotorsOn).await?
            } else {
                act::confirm(global, output, &gimbal, &MotorsOff { mode: MotorsOffMode::Normal }).await?
            };
            if confirmed.is_some() {
                output.outcome(command, State::Done, json!({"motors_on": on}), text)?;
            }
            Ok(())
        })
        .await
    }
}
