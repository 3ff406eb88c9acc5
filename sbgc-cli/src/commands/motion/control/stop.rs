//! `sbgc control stop`.

use clap::Args;
use sbgc_host::control;
use serde_json::json;

use crate::act;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};

const EXAMPLES: &str = "Examples:
  sbgc control stop
  sbgc control stop --json";

/// Stop all axes and return control to the board's other sources
///
/// Ends moves that were handed over, and resets what CMD_CONTROL_CONFIG has set.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Stop {}

impl Stop {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| {
            for command in control::stop_commands() {
                act::confirm(global, output, &gimbal, &command).await?;
            }
            if !global.dry_run {
                output.outcome("control stop", State::Stopped, json!({}), "stopped")?;
            }
            Ok(())
        })
        .await
    }
}
