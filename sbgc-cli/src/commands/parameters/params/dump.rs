//! `sbgc params dump`.

use std::path::{Path, PathBuf};

use clap::Args;
use sbgc_host::params::{GuiFile, ParameterFile, Parameters, Profile};
use serde_json::json;

use super::super::arguments::{Profiles, profiles};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{files, talk};

/// Save parameters as TOML
///
/// Prints the document, or replaces FILE as a whole. If FILE has the same profiles already, keeps its comments and
/// the order of its lines. `params restore` reads it back.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params dump
  sbgc params dump gimbal.toml --profile all
  sbgc params dump --profile 2

`--profile-template saved.profile out.profile` writes a file for the vendor's GUI.")]
pub(super) struct Dump {
    /// File to write [default: standard output]
    file: Option<PathBuf>,

    /// Profile, 1 to 5, or all [default: the active one]
    #[arg(long, value_name = "N|all", value_parser = profiles)]
    profile: Option<Profiles>,

    /// File saved by the vendor's GUI; FILE becomes a copy of it with the board's values
    #[arg(long, value_name = "FILE.profile", requires = "file")]
    profile_template: Option<PathBuf>,

    /// Accept a template from another firmware
    #[arg(long, requires = "profile_template")]
    force: bool,
}

impl Dump {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        if let (Some(template), Some(file)) = (&self.profile_template, &self.file) {
            return self.fill(global, template, file).await;
        }
        let snapshot = with_board(global, async |gimbal, info| {
            let parameters = Parameters::new(gimbal, info);
            Ok(match self.profile {
                Some(Profiles::All) => parameters.snapshot(Profile::all()).await?,
                Some(Profiles::One(profile)) => parameters.snapshot([profile]).await?,
                None => parameters.snapshot([parameters.active().await?]).await?,
            })
        })
        .await?;
        let Some(file) = self.file else {
            let document = ParameterFile::document(&snapshot);
            if output.is_json() {
                output.object(&json!({ "document": document }))?;
            } else {
                output.line(document.trim_end())?;
            }
            return Ok(());
        };
        // A device has no lines to keep, and reading it may never end.
        let old = if file.is_file() { files::read_text(&file).ok() } else { None };
        let updated = old.and_then(|old| ParameterFile::updated(&old, &snapshot));
        let document = updated.unwrap_or_else(|| ParameterFile::document(&snapshot));
        files::write(&file, document.as_bytes())?;
        talk::say(format_args!("wrote {}", file.display()));
        Ok(())
    }

    /// Puts the values of the board into a copy of a file that the GUI saved.
    async fn fill(&self, global: &Global, template: &Path, file: &Path) -> Result<(), Failure> {
        let text = files::read_text(template)?;
        let gui = GuiFile::parse(&text).map_err(|error| {
            let line = error.line.map_or_else(String::new, |line| format!(":{line}"));
            Failure::Usage(format!("{}{line}: {}", template.display(), error.problem))
        })?;
        let filled = with_board(global, async |gimbal, info| {
            let (own, board) = (gui.firmware(), info.firmware_ver);
            if !gui.is_for(board) {
                let problem = format!("{} is from firmware {own}, the board has {board}", template.display());
                if !self.force {
                    return Err(Failure::Failed(format!("{problem}; --force fills it all the same")));
                }
                talk::say(problem);
            }
            let parameters = Parameters::new(gimbal, info);
            let wanted: Vec<Profile> = match (gui.is_single(), self.profile) {
                (true, Some(Profiles::One(profile))) => vec![profile],
                (true, _) => vec![parameters.active().await?],
                (false, _) => Profile::all().take(gui.profile_count()).collect(),
            };
            let mut profiles = Vec::new();
            for profile in wanted {
                profiles.push(parameters.read(profile).await?);
            }
            Ok(gui.fill(&text, &profiles, &parameters.read_shared().await?, board))
        })
        .await?;
        if !filled.unsaid.is_empty() {
            talk::say(format_args!("left as in the template: {}", filled.unsaid.join(", ")));
        }
        files::write(file, filled.text.as_bytes())?;
        talk::say(format_args!("wrote {}", file.display()));
        Ok(())
    }
}
