//! `sbgc debug-vars`: variables that the firmware shows for debugging.

use clap::Args;
use sbgc_host::{Error, Gimbal};
use sbgc_proto::commands::{
    DebugVarAxis, DebugVarKind, DebugVarValue, DebugVars3Request, DebugVarsInfo3,
    DebugVarsInfo3ExtendedRequest, DebugVarsInfo3Request,
};
use serde_json::{Value, json};

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::text;

const EXAMPLES: &str = "Examples:
  sbgc debug-vars
  sbgc debug-vars --json";

/// Show the debug variables of the firmware
///
/// Their names and types come from the board. Angles are shown in degrees.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct DebugVars {
    /// Names or parts of names [default: all]
    names: Vec<String>,
}

/// A variable as the board describes it.
struct Variable {
    name: String,
    kind: DebugVarKind,
}

impl DebugVars {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (variables, values) = with_board(global, async |gimbal, _| {
            let variables = describe(&gimbal).await?;
            let answer = gimbal.exchange(&DebugVars3Request {}).await?;
            let kinds = variables.iter().map(|variable| variable.kind);
            let values: Result<Vec<_>, _> = answer.get().values(kinds).collect();
            Ok((variables, values.map_err(Error::from)?))
        })
        .await?;
        let known: Vec<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
        for name in &self.names {
            if !known.iter().any(|known| fits(name, known)) {
                return Err(Failure::Usage(text::unknown("debug variable", name, known.iter().copied())));
            }
        }
        let width = known.iter().map(|name| name.chars().count()).max().unwrap_or_default();
        let values = values.into_iter().map(Some).chain(std::iter::repeat(None));
        for ((id, variable), value) in variables.iter().enumerate().zip(values) {
            if !self.names.is_empty() && !self.names.iter().any(|name| fits(name, &variable.name)) {
                continue;
            }
            if output.is_json() {
                output.object(&variable.json(id, value))?;
            } else {
                output.line(variable.text(width, value))?;
            }
        }
        Ok(())
    }
}

fn fits(name: &str, known: &str) -> bool {
    known.to_ascii_lowercase().contains(&name.to_ascii_lowercase())
}

impl Variable {
    fn unit(&self) -> Option<&'static str> {
        self.kind.is_angle().then_some("deg")
    }

    fn json(&self, id: usize, value: Option<DebugVarValue>) -> Value {
        // What is not finite is no number in JSON.
        let value = value.map(|value| match value {
            DebugVarValue::F32(value) if !self.kind.is_angle() => json!(value.get()),
            value if self.kind.is_angle() => json!(self.kind.physical(value)),
            DebugVarValue::U8(value) => json!(value),
            DebugVarValue::I8(value) => json!(value),
            DebugVarValue::U16(value) => json!(value),
            DebugVarValue::I16(value) => json!(value),
            DebugVarValue::U32(value) => json!(value),
            DebugVarValue::I32(value) => json!(value),
            DebugVarValue::F32(value) => json!(value.get()),
        });
        json!({"name": self.name, "id": id, "value": value, "min": null, "max": null, "unit": self.unit()})
    }

    fn text(&self, width: usize, value: Option<DebugVarValue>) -> String {
        let value = match value {
            None => String::from("-"),
            Some(value) if self.kind.is_angle() => format!("{:.2}", self.kind.physical(value)),
            Some(DebugVarValue::F32(value)) => format!("{}", value.get()),
            Some(value) => format!("{}", value.to_f64()),
        };
        let axis = match self.kind.axis() {
            DebugVarAxis::Roll => "  ROLL",
            DebugVarAxis::Pitch => "  PITCH",
            DebugVarAxis::Yaw => "  YAW",
            _ => "",
        };
        let unit = self.unit().map_or_else(String::new, |unit| format!(" {unit}"));
        format!("{:<width$}  {value}{unit}{axis}", text::escape(&self.name))
    }
}

/// Asks for the description until all variables are described.
async fn describe(gimbal: &Gimbal) -> Result<Vec<Variable>, Failure> {
    let mut variables: Vec<Variable> = Vec::new();
    let first = gimbal.exchange(&DebugVarsInfo3Request {}).await?;
    let count = usize::from(first.get().debug_vars_num);
    add(&mut variables, &first.get());
    // Newer firmware tells the rest only when asked for it.
    while variables.len() < count {
        let Ok(start_idx) = u8::try_from(variables.len()) else { break };
        let more = match gimbal.exchange(&DebugVarsInfo3ExtendedRequest { start_idx }).await {
            Ok(more) => more,
            Err(Error::Timeout { .. } | Error::Refused { .. }) => break,
            Err(error) => return Err(error.into()),
        };
        let before = variables.len();
        add(&mut variables, &more.get());
        if variables.len() == before {
            break;
        }
    }
    Ok(variables)
}

fn add(variables: &mut Vec<Variable>, info: &DebugVarsInfo3<'_>) {
    variables.extend(info.vars.iter().map(|variable| Variable {
        name: String::from_utf8_lossy(variable.var_name.0).trim_end_matches('\0').to_owned(),
        kind: variable.var_type,
    }));
}
