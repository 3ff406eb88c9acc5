//! `sbgc reset`: restarts the board.

use std::time::Duration;

use clap::Args;
use sbgc_host::Gimbal;
use sbgc_host::actions::reset_command;
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, values};

const EXAMPLES: &str = "Examples:
  sbgc reset
  sbgc reset --delay 500ms --wait --json";

/// Restart the board
///
/// Prints "accepted" once the board has announced it, or "done" with --wait once it responds again.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Reset {
    /// Time between the announcement and the restart
    #[arg(long, value_name = "TIME", default_value = "100ms", value_parser = values::delay)]
    delay: Duration,

    /// Wait until the board responds again, at most 20 seconds
    #[arg(long)]
    wait: bool,
}

impl Reset {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| {
            if global.dry_run {
                return act::show(output, gimbal.version(), &reset_command(self.delay));
            }
            gimbal.restart(self.delay).await?;
            let state = if self.wait {
                tokio::time::sleep(self.delay).await;
                responds(&gimbal).await?;
                State::Done
            } else {
                State::Accepted
            };
            Ok(output.outcome("reset", state, json!({}), state.as_str())?)
        })
        .await
    }
}

/// Waits until the board is there again.
async fn responds(gimbal: &Gimbal) -> Result<(), Failure> {
    let mut outcome = gimbal.handshake().await;
    for _ in 0..20 {
        if !matches!(outcome, Err(sbgc_host::Error::Timeout { .. })) {
            break;
        }
        outcome = gimbal.handshake().await;
    }
    Ok(outcome.map(drop)?)
}
