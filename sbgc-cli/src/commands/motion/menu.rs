//! `sbgc menu`: commands of the board's menu.

use clap::Args;
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use sbgc_proto::commands::{ExecuteMenu, MenuCommand};
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, text};

const EXAMPLES: &str = "Examples:
  sbgc menu home-position
  sbgc menu MENU_CMD_LEVEL_ROLL --json
  sbgc menu list";

/// Run a command of the board's menu
///
/// Names are those of the specification, with or without MENU_CMD_, in any case, with - or _.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Menu {
    /// Name of the menu command, or `list` for all names
    #[arg(value_name = "NAME", add = ArgValueCandidates::new(candidates))]
    name: String,
}

const PREFIX: &str = "MENU_CMD_";

fn short_names() -> impl Iterator<Item = &'static str> {
    MenuCommand::LABELS.iter().map(|label| label.name.strip_prefix(PREFIX).unwrap_or(label.name))
}

fn candidates() -> Vec<CompletionCandidate> {
    let listed = MenuCommand::LABELS.iter().map(|label| {
        let name = label.name.strip_prefix(PREFIX).unwrap_or(label.name);
        CompletionCandidate::new(name.to_ascii_lowercase().replace('_', "-")).help(Some(label.doc.into()))
    });
    listed.collect()
}

/// The menu command of this name, and its name in the specification.
fn command(name: &str) -> Result<(MenuCommand, &'static str), Failure> {
    let wanted = name.trim().to_ascii_uppercase().replace('-', "_");
    let wanted = wanted.strip_prefix(PREFIX).unwrap_or(&wanted);
    let label = MenuCommand::LABELS
        .iter()
        .find(|label| label.name.strip_prefix(PREFIX).unwrap_or(label.name) == wanted);
    match label {
        Some(label) => Ok((MenuCommand::from(u8::try_from(label.value).unwrap_or_default()), label.name)),
        None => {
            let names: Vec<String> = short_names().map(str::to_ascii_lowercase).collect();
            let message =
                text::unknown("menu command", &wanted.to_ascii_lowercase(), names.iter().map(String::as_str));
            Err(Failure::Usage(format!("{message} `sbgc menu list` lists all.")))
        }
    }
}

impl Menu {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        if self.name.eq_ignore_ascii_case("list") {
            return list(output);
        }
        let (command, name) = command(&self.name)?;
        with_board(global, async |gimbal, _| {
            if act::confirm(global, output, &gimbal, &ExecuteMenu { cmd_id: command }).await?.is_some() {
                output.outcome("menu", State::Done, json!({"name": name}), format_args!("{name}: done"))?;
            }
            Ok(())
        })
        .await
    }
}

fn list(output: &mut Output) -> Result<(), Failure> {
    for label in MenuCommand::LABELS {
        if output.is_json() {
            output.object(&json!({"name": label.name, "id": label.value, "description": label.doc}))?;
        } else {
            let name = label.name.strip_prefix(PREFIX).unwrap_or(label.name);
            output.line(format_args!(
                "{:<28}  {}",
                name.to_ascii_lowercase().replace('_', "-"),
                label.doc
            ))?;
        }
    }
    Ok(())
}
