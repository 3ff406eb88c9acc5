//! The values of adjustable variables.
//!
//! Real: a value must be in the variable's range; one command is taken as a whole or not at all; what was not stored
//! is lost in a reset.
//!
//! Simplified: the variables stand apart from the parameters of the profiles, are the same in all of them and have no
//! effect. A variable that nobody has set is 0, or what is nearest to it in its range. Those that the protocol does
//! not list are refused.

use std::collections::BTreeMap;

use sbgc_proto::commands::{AdjustableVariable, VariableValue};

use super::answers::Refusal;

#[derive(Debug, Default)]
pub(super) struct Variables {
    values: BTreeMap<u8, i32>,
    stored: BTreeMap<u8, i32>,
}

impl Variables {
    pub(super) fn get(&self, variable: AdjustableVariable) -> Result<VariableValue, Refusal> {
        let (least, most) = range(variable)?;
        let unset = 0.clamp(least, most);
        let value = self.values.get(&variable.raw()).copied().unwrap_or(unset);
        Ok(VariableValue { param_id: variable, param_value: value })
    }

    pub(super) fn set(&mut self, values: &[VariableValue]) -> Result<(), Refusal> {
        for value in values {
            let (least, most) = range(value.param_id)?;
            if !(least..=most).contains(&value.param_value) {
                return Err(Refusal::Parameters);
            }
        }
        self.values.extend(values.iter().map(|value| (value.param_id.raw(), value.param_value)));
        Ok(())
    }

    /// Stores these variables.
    pub(super) fn store(&mut self, variables: &[AdjustableVariable]) {
        for id in variables.iter().map(|variable| variable.raw()) {
            if let Some(value) = self.values.get(&id) {
                self.stored.insert(id, *value);
            }
        }
    }

    pub(super) fn store_all(&mut self) {
        self.stored.clone_from(&self.values);
    }

    /// Forgets what is not stored.
    pub(super) fn reset(&mut self) {
        self.values.clone_from(&self.stored);
    }
}

/// The least and the greatest value of a variable.
fn range(variable: AdjustableVariable) -> Result<(i32, i32), Refusal> {
    let facts = variable.facts().ok_or(Refusal::Parameters)?;
    let (least, most) = facts.range.unwrap_or((i32::MIN, i32::MAX));
    Ok((least, facts.newer_most.unwrap_or(most)))
}
