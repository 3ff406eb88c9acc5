//! `sbgc params set`.

use clap::Args;
use clap_complete::engine::ArgValueCandidates;
use sbgc_host::params::{Catalog, Parameter, Parameters, ParamsError, Profile, ValueError};
use serde_json::json;

use super::super::arguments::{Assignment, assignment, candidates, profile};
use super::super::{change, show};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

/// Write parameters
///
/// A value is a number with or without unit (45deg, 0.5s), the name of a value, names of flags joined by |, or a raw
/// number in hex (0x1F). Asks first, saves a backup, writes the blocks that change and reads them back.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params set rc_memory.pitch=-30deg --yes
  sbgc params set motors.roll.p=35 motors.roll.d=42 --profile 2 --yes
  sbgc params set servo_rate=50Hz --dry-run")]
pub(super) struct Set {
    /// Parameters with their new values
    #[arg(value_name = "NAME=VALUE", required = true, value_parser = assignment, add = ArgValueCandidates::new(candidates))]
    settings: Vec<Assignment>,

    /// Profile, 1 to 5 [default: the active one]
    #[arg(long, value_name = "N", value_parser = profile)]
    profile: Option<Profile>,
}

impl Set {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        // What fits no firmware needs no board.
        settings(&Catalog::newest(), &self.settings)?;
        with_board(global, async |gimbal, info| {
            let parameters = Parameters::new(gimbal, info);
            let settings = settings(&parameters.catalog(), &self.settings)?;
            let profile = match self.profile {
                Some(profile) => profile,
                None => parameters.active().await?,
            };
            let before = parameters.read(profile).await?;
            let mut after = before.clone();
            for (parameter, bytes) in &settings {
                after.set(parameter, bytes);
            }
            let mut plan = parameters.plan();
            plan.change(Some(profile), &before, &after);
            if !change::carry_out(global, output, &parameters, &plan).await? {
                return Ok(());
            }
            for difference in plan.differences() {
                if output.is_json() {
                    output.object(&json!({
                        "path": difference.path,
                        "before": show::value(&difference.value(&difference.a)),
                        "after": show::value(&difference.value(&difference.b)),
                        "verified": true,
                    }))?;
                } else {
                    output.line(show::difference(&difference))?;
                }
            }
            Ok(())
        })
        .await
    }
}

/// The parameters with the bytes of their new values.
pub(in super::super) fn settings(
    catalog: &Catalog,
    assignments: &[Assignment],
) -> Result<Vec<(Parameter, Vec<u8>)>, Failure> {
    let mut settings: Vec<(Parameter, Vec<u8>)> = Vec::new();
    for Assignment { name, value } in assignments {
        let parameter = catalog.one(name)?;
        if settings.iter().any(|(set, _)| set.path == parameter.path) {
            return Err(Failure::Usage(format!("{} is given twice", parameter.path)));
        }
        let bytes = if parameter.is_state() { Err(ValueError::State) } else { parameter.parse(value) };
        let bytes = bytes.map_err(|source| ParamsError::Value {
            path: parameter.path.clone(),
            value: value.clone(),
            source: Box::new(source),
        })?;
        settings.push((parameter.clone(), bytes));
    }
    Ok(settings)
}
