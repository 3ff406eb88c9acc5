//! `sbgc boot`: the bootloader.

use std::time::Duration;

use clap::Args;
use sbgc_host::actions::boot_command;
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, talk, values};

const EXAMPLES: &str = "Examples:
  sbgc --dry-run boot
  sbgc --yes boot --delay 500ms";

/// Enter the bootloader (asks first)
///
/// The gimbal stops working until the board is restarted.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Boot {
    /// Delay before entering it
    #[arg(long, value_name = "TIME", default_value = "100ms", value_parser = values::delay)]
    delay: Duration,
}

impl Boot {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| {
            if global.dry_run {
                return act::show(output, gimbal.version(), &boot_command(self.delay));
            }
            talk::say(
                "the board enters its bootloader; the gimbal stops working until the board is restarted",
            );
            act::ask(global, "Enter the bootloader?").await?;
            let announced = gimbal.enter_bootloader(self.delay).await?;
            if !announced {
                talk::say("the board did not announce it, as some firmware does not");
            }
            Ok(output.outcome("boot", State::Accepted, json!({"announced": announced}), "accepted")?)
        })
        .await
    }
}
