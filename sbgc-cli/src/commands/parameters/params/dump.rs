//! `sbgc params dump`.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use sbgc_host::params::{ParameterFile, Parameters, Profile};
use serde_json::json;

use super::super::arguments::{Profiles, profiles};
use super::super::change;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::talk;

/// Save parameters as TOML
///
/// Prints the document or writes FILE as a whole. Where FILE is such a document of the same profiles, its comments
/// and the order of its lines are kept. `params restore` reads it back.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params dump
  sbgc params dump gimbal.toml --profile all
  sbgc params dump --profile 2 | grep follow")]
pub(super) struct Dump {
    /// File to write [default: standard output]
    file: Option<PathBuf>,

    /// Profile, 1 to 5, or all [default: the active one]
    #[arg(long, value_name = "N|all", value_parser = profiles)]
    profile: Option<Profiles>,
}

impl Dump {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
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
        let old = fs::read_to_string(&file).ok();
        let updated = old.and_then(|old| ParameterFile::updated(&old, &snapshot));
        change::replace(&file, &updated.unwrap_or_else(|| ParameterFile::document(&snapshot)))?;
        talk::say(format_args!("wrote {}", file.display()));
        Ok(())
    }
}
