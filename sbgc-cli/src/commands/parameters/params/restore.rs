//! `sbgc params restore`.

use std::path::PathBuf;

use clap::Args;
use sbgc_host::params::{ParameterFile, Parameters, Profile};

use super::super::arguments::profile;
use super::super::{change, show, source};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::talk;

/// Write the parameters of a file to the board
///
/// Checks the file before anything is sent, shows what differs, asks, saves a backup, writes only blocks that differ and
/// reads them back. A parameter that the file does not have stays as it is. When it is interrupted, run it again.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params restore gimbal.toml
  sbgc params restore gimbal.toml --dry-run
  sbgc params restore one-profile.toml --profile 3 --yes")]
pub(super) struct Restore {
    /// File of `params dump`
    file: PathBuf,

    /// Profile to write to, for a file with one; else the only one to restore
    #[arg(long, value_name = "N", value_parser = profile)]
    profile: Option<Profile>,

    /// Accept a file from another firmware; what both have is written
    #[arg(long)]
    force: bool,
}

impl Restore {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let file = self.select(source::read(&self.file)?)?;
        with_board(global, async |gimbal, info| {
            let parameters = Parameters::new(gimbal, info);
            self.check_firmware(&file, &parameters)?;
            let mut plan = parameters.plan();
            for profile in file.profiles() {
                let before = parameters.read(profile).await?;
                let whose = profile.to_string();
                let after = source::lay(&file, profile, &before, &parameters.catalog(), &whose);
                plan.change(Some(profile), &before, &after);
            }
            if file.has_shared() {
                let before = parameters.read_shared().await?;
                plan.change(None, &before, &source::lay_shared(&file, &before, &parameters));
            }
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

    /// What of the file is to be restored, and to which profile.
    fn select(&self, file: ParameterFile) -> Result<ParameterFile, Failure> {
        let Some(wanted) = self.profile else { return Ok(file) };
        if file.profiles().count() == 1 {
            return Ok(file.moved_to(wanted));
        }
        if !file.profiles().any(|profile| profile == wanted) {
            return Err(Failure::Usage(format!("{} has no {wanted}", self.file.display())));
        }
        Ok(file.only(wanted))
    }

    fn check_firmware(&self, file: &ParameterFile, parameters: &Parameters) -> Result<(), Failure> {
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
