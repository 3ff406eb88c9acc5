//! `sbgc adj`: adjustable variables.

use clap::{Args, Subcommand};
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use sbgc_host::params::{
    Blocks, Catalog, Parameters, ParamsError, Variable, VariableCommand, variables_called,
};
use sbgc_proto::commands::{AdjustableVariable, SaveParams3};
use serde_json::json;

use super::arguments::{Assignment, assignment};
use super::params::settings;
use super::{change, show};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{act, text};

/// Read, set and save adjustable variables
///
/// They change the board at once and are lost at the next restart unless they are saved. `config` shows and changes
/// which signals run actions and change variables.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc adj list
  sbgc adj set P_ROLL=40 P_PITCH=45
  sbgc adj save P_ROLL --yes")]
pub(crate) struct Adj {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// List all variables of the firmware
    #[command(after_help = "Examples:
  sbgc adj list
  sbgc adj list --json")]
    List,
    /// Print variables
    #[command(after_help = "Examples:
  sbgc adj get P_ROLL I_ROLL
  sbgc adj get 'FOLLOW_*' --json")]
    Get {
        /// Names, numbers, or patterns with *
        #[arg(value_name = "NAME", required = true, add = ArgValueCandidates::new(candidates))]
        names: Vec<String>,
    },
    /// Set variables until the next restart
    #[command(after_help = "Examples:
  sbgc adj set P_ROLL=40 P_PITCH=45
  sbgc adj set FRAME_HEADING_ANGLE=-30deg --dry-run")]
    Set {
        /// Variables with their new values
        #[arg(value_name = "NAME=VALUE", required = true, value_parser = assignment, add = ArgValueCandidates::new(candidates))]
        settings: Vec<Assignment>,
    },
    /// Save variables to the EEPROM (those of a profile to the active one)
    #[command(after_help = "Examples:
  sbgc adj save --yes
  sbgc adj save P_ROLL P_PITCH --yes")]
    Save {
        /// Names or numbers [default: all in use]
        #[arg(value_name = "NAME", add = ArgValueCandidates::new(candidates))]
        names: Vec<String>,
    },
    /// Show or change which signals run actions and change variables
    #[command(after_help = "Examples:
  sbgc adj config
  sbgc adj config 'trigger_slots[0]'
  sbgc adj config 'analog_slots[0].analog_src_ch=ADC1' --yes")]
    Config {
        /// Names to show, or NAME=VALUE to change
        #[arg(value_name = "NAME[=VALUE]")]
        words: Vec<String>,
    },
}

/// What a shell completes for the name of a variable.
fn candidates() -> Vec<CompletionCandidate> {
    AdjustableVariable::ALL.iter().map(|facts| CompletionCandidate::new(facts.name)).collect()
}

impl Adj {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, info| {
            let parameters = Parameters::new(gimbal, info);
            match self.what {
                What::List => print(output, &parameters.variables().await?),
                What::Get { names } => {
                    let called = called(&parameters, &names).await?;
                    print(output, &called)
                }
                What::Set { settings } => set(global, output, &parameters, &settings).await,
                What::Save { names } => save(global, output, &parameters, &names).await,
                What::Config { words } => config(global, output, &parameters, &words).await,
            }
        })
        .await
    }
}

fn print(output: &mut Output, variables: &[Variable]) -> Result<(), Failure> {
    let width = variables.iter().map(|variable| variable.name.len()).max().unwrap_or_default();
    for variable in variables {
        if output.is_json() {
            let limit = |pick: fn((f64, f64)) -> f64| variable.range.map(|range| show::number(pick(range)));
            output.object(&json!({
                "name": variable.name,
                "id": variable.id.raw(),
                "value": show::number(variable.value),
                "min": limit(|range| range.0),
                "max": limit(|range| range.1),
                "unit": show::unit(variable.unit),
            }))?;
        } else {
            let (name, space) =
                (text::escape(&variable.name), if variable.unit.is_empty() { "" } else { " " });
            output.line(format_args!("{name:<width$}  {}{space}{}", variable.value, variable.unit))?;
        }
    }
    Ok(())
}

/// The variables that names mean, in the order of the names, with their present values.
async fn called(parameters: &Parameters, names: &[String]) -> Result<Vec<Variable>, Failure> {
    let all = parameters.variables().await?;
    let mut found: Vec<Variable> = Vec::new();
    for name in names {
        for variable in variables_called(&all, name)? {
            if !found.contains(variable) {
                found.push(variable.clone());
            }
        }
    }
    Ok(found)
}

async fn set(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    assignments: &[Assignment],
) -> Result<(), Failure> {
    let all = parameters.variables().await?;
    let mut settings = Vec::new();
    for Assignment { name, value } in assignments {
        let found = variables_called(&all, name)?;
        let [variable] = found.as_slice() else {
            let names: Vec<_> = found.iter().map(|variable| variable.name.as_str()).collect();
            return Err(Failure::Usage(format!("{name:?} means several variables: {}", names.join(", "))));
        };
        settings.push(variable.parse(value).map_err(|error| Failure::Usage(error.to_string()))?);
    }
    if global.dry_run {
        let version = parameters.gimbal().version();
        return parameters.variable_commands(&settings)?.iter().try_for_each(|command| match command {
            VariableCommand::Integers(command) => act::show(output, version, command),
            VariableCommand::Floats(command) => act::show(output, version, command),
        });
    }
    parameters.set_variables(&settings).await?;
    let after = parameters.variables().await?;
    let set = |variable: &&Variable| settings.iter().any(|setting| setting.id == variable.id);
    print(output, &after.iter().filter(set).cloned().collect::<Vec<_>>())
}

async fn save(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    names: &[String],
) -> Result<(), Failure> {
    let saved = called(parameters, names).await?;
    let ids: Vec<_> = saved.iter().map(|variable| variable.id).collect();
    let version = parameters.gimbal().version();
    if !ids.is_empty() {
        // A firmware that cannot do it says so before anybody is asked.
        let command = parameters.saving(&ids)?;
        if global.dry_run {
            return act::show(output, version, &command);
        }
    } else if global.dry_run {
        return act::show(output, version, &SaveParams3 {});
    }
    let which = match saved.as_slice() {
        [] => String::from("all variables in use"),
        saved => saved.iter().map(|variable| variable.name.as_str()).collect::<Vec<_>>().join(", "),
    };
    act::ask(global, &format!("Save {which} to the EEPROM?")).await?;
    change::back_up(&parameters.snapshot([parameters.active().await?]).await?)?;
    parameters.save_variables(&ids).await?;
    let saved = if names.is_empty() { parameters.variables().await? } else { saved };
    print(output, &saved)
}

async fn config(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    words: &[String],
) -> Result<(), Failure> {
    let catalog = parameters.shared_catalog();
    let before = parameters.read_shared().await?;
    let (changes, names): (Vec<_>, Vec<_>) = words.iter().partition(|word| word.contains('='));
    if changes.is_empty() {
        return print_config(output, &catalog, &before, &names);
    }
    if !names.is_empty() {
        return Err(Failure::Usage(String::from("expected names to show or NAME=VALUE to change, not both")));
    }
    let assignments: Result<Vec<_>, _> = changes.iter().map(|word| assignment(word)).collect();
    let settings = settings(&catalog, &assignments.map_err(Failure::Usage)?)?;
    let mut after = before.clone();
    for (parameter, bytes) in &settings {
        after.set(parameter, bytes);
    }
    let mut plan = parameters.plan();
    plan.change(None, &before, &after);
    if change::carry_out(global, output, parameters, &plan).await? {
        let paths: Vec<_> = plan.differences().into_iter().map(|difference| difference.path).collect();
        print_config(output, &catalog, &after, &paths.iter().collect::<Vec<_>>())?;
    }
    Ok(())
}

fn print_config(
    output: &mut Output,
    catalog: &Catalog,
    blocks: &Blocks,
    names: &[&String],
) -> Result<(), Failure> {
    let mut paths = Vec::new();
    for name in names {
        paths.extend(catalog.find(name).map_err(ParamsError::from)?.iter().map(|found| found.path.clone()));
    }
    let of_config = |path: &str| path.starts_with("trigger_slots") || path.starts_with("analog_slots");
    for parameter in catalog.iter().filter(|parameter| of_config(&parameter.path)) {
        if !names.is_empty() && !paths.contains(&parameter.path) {
            continue;
        }
        let Some(bytes) = blocks.bytes_of(parameter) else { continue };
        if output.is_json() {
            let range = parameter.range();
            output.object(&json!({
                "name": parameter.path,
                "id": null,
                "value": parameter.label(bytes).map_or_else(|| show::value(&parameter.value(bytes)), Into::into),
                "min": range.map(|range| show::number(range.0)),
                "max": range.map(|range| show::number(range.1)),
                "unit": show::unit(parameter.unit()),
            }))?;
        } else {
            output.line(format_args!("{} = {}", parameter.path, text::escape(&parameter.show(bytes))))?;
        }
    }
    Ok(())
}
