//! `sbgc config`: the common options, and where each value comes from.

use clap::Args;
use serde_json::json;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{places, talk, text};

const EXAMPLES: &str = "Examples:
  sbgc config
  sbgc config --baud 57600 --json";

/// Show the settings and where each comes from
///
/// A value comes from the option, else from the environment (SBGC_PORT, SBGC_BAUD, ...), else from
/// $XDG_CONFIG_HOME/sbgc/config.toml, whose keys are the names of the options (port = "/dev/ttyUSB0"), else it is the
/// default.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Config {}

impl Config {
    #[allow(clippy::unused_self, reason = "commands are alike")]
    pub(crate) fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        for setting in &global.settings {
            if output.is_json() {
                output.object(&json!({
                    "name": setting.name,
                    "value": setting.value,
                    "source": setting.source,
                    "place": setting.place,
                }))?;
                continue;
            }
            let value = text::escape(setting.value.as_deref().unwrap_or("-"));
            let place = setting
                .place
                .as_deref()
                .map_or_else(String::new, |place| format!("  {}", text::escape(place)));
            output.line(
                format_args!("{:<10}{value:<20}{:<12}{place}", setting.name, setting.source)
                    .to_string()
                    .trim_end(),
            )?;
        }
        if let Some(directory) = places::config().filter(|_| !output.is_json()) {
            let file = directory.join("config.toml");
            let note = if file.exists() { "" } else { " (does not exist)" };
            output.flush()?;
            talk::say(format_args!("configuration file: {}{note}", file.display()));
        }
        Ok(())
    }
}
