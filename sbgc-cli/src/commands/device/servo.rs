//! `sbgc servo`: servo outputs.

use clap::Args;
use sbgc_host::actions::servo_command;
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, talk};

const EXAMPLES: &str = "Examples:
  sbgc --dry-run servo 1 1500
  sbgc --yes servo 2 1000 2000 --json";

/// Set servo outputs (asks first)
///
/// Typical servos take 500 to 2500 us, 1500 in the middle; 0 holds an output low, -1 lets it float. Firmware before
/// 2.73.2 sets all eight outputs at once: omitted outputs float.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Servo {
    /// First output, counted from 1
    #[arg(value_name = "N")]
    first: u8,

    /// Pulse times in microseconds, of this output and those that follow
    #[arg(value_name = "MICROSECONDS", required = true, allow_negative_numbers = true)]
    times: Vec<i16>,
}

impl Servo {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, info| {
            let (id, payload) = servo_command(info.firmware_ver, self.first, &self.times)?.frame()?;
            if global.dry_run {
                return act::show_payload(output, gimbal.version(), id, &payload);
            }
            for (output, time) in (self.first..).zip(&self.times) {
                talk::say(format_args!("servo output {output}: {time} us"));
            }
            act::ask(global, "Set them?").await?;
            gimbal.send_checked_raw(id, payload).await?;
            let own = json!({"servo": self.first, "times": self.times});
            Ok(output.outcome("servo", State::Accepted, own, "accepted")?)
        })
        .await
    }
}
