//! `sbgc params restore`.

use std::path::PathBuf;

use clap::Args;
use sbgc_host::params::{Include, Parameters, Profile};

use super::super::arguments::{include, profile};
use super::super::document::Document;
use super::super::{change, show};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::talk;

/// Write the parameters of a file to the board
///
/// Checks the file before anything is sent, shows what differs, asks, saves a backup, writes only blocks that differ
/// and reads them back. A parameter that the file does not have stays as it is. If it is interrupted, run it again.
///
/// FILE may also be a .profile of the vendor's GUI. Of such a file, only values whose meaning is certain are written,
/// unless --include adds others; values that are never written are listed.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params dump gimbal.toml && sbgc params restore gimbal.toml
  sbgc params dump gimbal.toml && sbgc params restore gimbal.toml --dry-run")]
pub(super) struct Restore {
    /// File of `params dump`, or of the GUI
    file: PathBuf,

    /// Profile to write a file with one profile to, or the only one to restore of several [default: as in the file,
    /// or the active one for a GUI's file]
    #[arg(long, value_name = "N", value_parser = profile)]
    profile: Option<Profile>,

    /// Accept a file from another firmware and write what both have
    #[arg(long)]
    force: bool,

    /// Also write from a GUI's file: likely, unit-specific (calibration, wiring), link (ports)
    #[arg(long, value_name = "CLASS", value_parser = include)]
    include: Vec<Include>,
}

impl Restore {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let file = Document::read(&self.file, &self.include)?;
        with_board(global, async |gimbal, info| {
            let parameters = Parameters::new(gimbal, info);
            self.check_firmware(&file, &parameters)?;
            let active = if file.is_nameless() && self.profile.is_none() {
                Some(parameters.active().await?)
            } else {
                None
            };
            let mut plan = parameters.plan();
            for (own, profile) in file.profiles(self.profile, active)? {
                let before = parameters.read(profile).await?;
                let after = file.lay(own, &before, &parameters.catalog(), &profile.to_string());
                plan.change(Some(profile), &before, &after);
            }
            if file.has_shared(self.profile) {
                let before = parameters.read_shared().await?;
                plan.change(None, &before, &file.lay_shared(&before, &parameters.shared_catalog()));
            }
            file.say_never_written();
            if !change::carry_out(global, output, &parameters, &plan).await? {
                return Ok(());
            }
            for difference in plan.differences() {
                if output.is_json() {
                    output.object(&show::difference_json(&difference))?;
                } else {
                    output.line(show::difference(&difference))?;
                }
            }
            Ok(())
        })
        .await
    }

    fn check_firmware(&self, file: &Document, parameters: &Parameters) -> Result<(), Failure> {
        let board = parameters.info().firmware_ver;
        if file.is_for(board) {
            return Ok(());
        }
        let from = match file.firmware() {
            Some(firmware) => format!("is from firmware {firmware}"),
            None => String::from("does not say from which firmware it is"),
        };
        let problem = format!("{} {from}, the board has {board}", self.file.display());
        if self.force {
            talk::say(problem);
            return Ok(());
        }
        Err(Failure::Failed(format!("{problem}; --force writes what both have")))
    }
}
