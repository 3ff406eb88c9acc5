//! `sbgc params list`, `get` and `describe`.

use clap::Args;
use clap_complete::engine::ArgValueCandidates;
use sbgc_host::params::{Blocks, Catalog, Parameter, Parameters, Profile};
use sbgc_proto::reflect::Meaning;

use super::super::arguments::{candidates, profile};
use super::super::show;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::text;

/// List parameters with their values
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params list
  sbgc params list 'motors.*' servo_rate
  sbgc params list --profile 2 --json")]
pub(super) struct List {
    /// Names or patterns [default: all]
    #[arg(value_name = "PATTERN", add = ArgValueCandidates::new(candidates))]
    names: Vec<String>,

    /// Profile, 1 to 5 [default: the active one]
    #[arg(long, value_name = "N", value_parser = profile)]
    profile: Option<Profile>,
}

/// Print the values of parameters
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params get servo_rate
  sbgc params get motors.pitch RC_MEMORY --json
  sbgc params get bat_threshold_alarm --profile 3")]
pub(super) struct Get {
    /// Names or patterns
    #[arg(value_name = "NAME", required = true, add = ArgValueCandidates::new(candidates))]
    names: Vec<String>,

    /// Profile, 1 to 5 [default: the active one]
    #[arg(long, value_name = "N", value_parser = profile)]
    profile: Option<Profile>,
}

/// Explain parameters: meaning, unit, range, names of values (needs no board)
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params describe rc_memory.pitch
  sbgc params describe GENERAL_FLAGS1
  sbgc params describe 'motors.roll.*' --json")]
pub(super) struct Describe {
    /// Names or patterns
    #[arg(value_name = "NAME", required = true, add = ArgValueCandidates::new(candidates))]
    names: Vec<String>,
}

impl List {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (blocks, found) = read(global, &self.names, self.profile).await?;
        let width = found.iter().map(|parameter| parameter.path.len()).max().unwrap_or_default();
        for parameter in &found {
            let Some(bytes) = blocks.bytes_of(parameter) else { continue };
            if output.is_json() {
                output.object(&show::parameter(parameter, Some(bytes)))?;
            } else {
                let value = parameter.show(bytes);
                output.line(format_args!("{:<width$}  {}", parameter.path, text::escape(&value)))?;
            }
        }
        Ok(())
    }
}

impl Get {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (blocks, found) = read(global, &self.names, self.profile).await?;
        for parameter in &found {
            let Some(bytes) = blocks.bytes_of(parameter) else { continue };
            if output.is_json() {
                output.object(&show::parameter(parameter, Some(bytes)))?;
            } else {
                let value = parameter.show(bytes);
                output.line(format_args!("{} = {}", parameter.path, text::escape(&value)))?;
            }
        }
        Ok(())
    }
}

impl Describe {
    pub(super) fn run(self, output: &mut Output) -> Result<(), Failure> {
        for parameter in named(&Catalog::newest(), &self.names)? {
            if output.is_json() {
                output.object(&show::parameter(&parameter, None))?;
            } else {
                describe(&parameter, output)?;
            }
        }
        Ok(())
    }
}

/// The blocks of a profile, and the parameters that the names mean.
async fn read(
    global: &Global,
    names: &[String],
    profile: Option<Profile>,
) -> Result<(Blocks, Vec<Parameter>), Failure> {
    // What no firmware has needs no board.
    named(&Catalog::newest(), names)?;
    with_board(global, async |gimbal, info| {
        let parameters = Parameters::new(gimbal, info);
        let found = named(&parameters.catalog(), names)?;
        let profile = match profile {
            Some(profile) => profile,
            None => parameters.active().await?,
        };
        Ok((parameters.read(profile).await?, found))
    })
    .await
}

/// The parameters that the names mean, in wire order; all for no names.
fn named(catalog: &Catalog, names: &[String]) -> Result<Vec<Parameter>, Failure> {
    let mut paths = Vec::new();
    for name in names {
        paths.extend(catalog.find(name)?.into_iter().map(|parameter| parameter.path.clone()));
    }
    let wanted = |parameter: &&Parameter| names.is_empty() || paths.contains(&parameter.path);
    Ok(catalog.iter().filter(wanted).cloned().collect())
}

fn describe(parameter: &Parameter, output: &mut Output) -> Result<(), Failure> {
    output.line(&parameter.path)?;
    let mut facts =
        vec![format!("{} of {}, {}", parameter.field.spec, parameter.block, parameter.type_name())];
    if let Some((least, most)) = parameter.range() {
        let unit = parameter.unit();
        let space = if unit.is_empty() { "" } else { " " };
        facts.push(format!("{least} to {most}{space}{unit}"));
    } else if !parameter.unit().is_empty() {
        facts.push(parameter.unit().to_owned());
    }
    if let Some(since) = parameter.field.since {
        facts.push(format!("firmware {since}+"));
    }
    if parameter.is_state() {
        facts.push(String::from("set by the board, read-only"));
    }
    let mut lines = vec![parameter.field.doc.trim().to_owned(), facts.join("; ")];
    let names = match parameter.number.map(|number| number.meaning) {
        Some(Meaning::Enum(labels) | Meaning::Flags(labels) | Meaning::Special(labels)) => {
            labels.iter().map(|label| format!("{} ({})", label.name, label.value)).collect()
        }
        Some(Meaning::Bits(parts, labels)) => {
            let names = labels.iter().map(|label| format!("{} ({})", label.name, label.value));
            names.chain(parts.iter().map(|part| format!("{}=...", part.name))).collect()
        }
        _ => Vec::new(),
    };
    if !names.is_empty() {
        lines.push(format!("values: {}", names.join(", ")));
    }
    let width = text::width().saturating_sub(2);
    for line in lines.iter().filter(|line| !line.is_empty()).flat_map(|line| text::wrap(line, width)) {
        output.line(format_args!("  {line}"))?;
    }
    Ok(())
}
