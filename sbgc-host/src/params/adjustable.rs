//! Adjustable variables of a board that is connected: their values in both forms, and saving them.
//!
//! What signals change them is a block like others, [`Block::AdjustableConfig`](super::Block::AdjustableConfig).

use sbgc_proto::commands::{
    AdjVarsInfoRequest, AdjVarsVal, AdjVarsValF, AdjustableVariable, GetAdjVarsVal, GetAdjVarsValF,
    SaveParams3, SaveParams3Extended, SetAdjVarsVal, SetAdjVarsValF, VariableType, VariableValue,
    VariableValueF,
};
use sbgc_proto::wire::{Float, List, Packed};
use sbgc_proto::{EncodeError, Message};

use super::block::has;
use super::board::Parameters;
use super::catalog::{NameError, nearest};
use super::error::{ParamsError, Result};
use super::quantity::{Amount, UnitError};
use crate::Error;

/// How many variables fit a message.
const AT_ONCE: usize = 40;

/// An adjustable variable of a board.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Which one.
    pub id: AdjustableVariable,
    /// The specification's name, or what the board calls it.
    pub name: String,
    /// Its value, in its unit.
    pub value: f64,
    /// The minimum and maximum value, in its unit, where they are known.
    pub range: Option<(f64, f64)>,
    /// Its unit, empty where it has none or none is known.
    pub unit: &'static str,
    /// The value is the raw number divided by this.
    divide: f64,
}

/// A variable that is going to be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Which one.
    pub id: AdjustableVariable,
    /// The raw number; it may have a fraction.
    pub raw: f64,
}

/// Why a value does not fit a variable.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VariableError {
    /// It is not a number.
    #[error("{name} = {text}: expected a number")]
    NotANumber {
        /// The variable.
        name: String,
        /// What was given.
        text: String,
    },
    /// It has another unit.
    #[error("{name} = {text}: {source}")]
    Unit {
        /// The variable.
        name: String,
        /// What was given.
        text: String,
        /// Why it does not fit.
        source: UnitError,
    },
    /// It is outside of the range.
    #[error("{name} = {text}: out of range; expected {least} to {most}{}{unit}", if unit.is_empty() { "" } else { " " })]
    OutOfRange {
        /// The variable.
        name: String,
        /// What was given.
        text: String,
        /// The minimum.
        least: f64,
        /// The maximum.
        most: f64,
        /// Their unit.
        unit: &'static str,
    },
}

impl Variable {
    /// A variable as it is published; `raw` is its raw value.
    fn published(id: AdjustableVariable, raw: f64) -> Self {
        let facts = id.facts();
        let divide = facts.map_or(1.0, |facts| f64::from(facts.divide));
        let limits = facts.map(|facts| match (facts.range, facts.ty) {
            (Some((least, most)), _) => (least, facts.newer_most.map_or(most, |newer| newer.max(most))),
            (None, VariableType::u8) => (0, 255),
            (None, VariableType::i8) => (-128, 127),
            (None, VariableType::u16) => (0, 65_535),
            (None, VariableType::i16) => (-32_768, 32_767),
        });
        Self {
            id,
            name: facts.map_or_else(|| format!("VARIABLE_{}", id.raw()), |facts| facts.name.to_owned()),
            value: raw / divide,
            range: limits.map(|(least, most)| (f64::from(least) / divide, f64::from(most) / divide)),
            unit: facts.map_or("", |facts| facts.unit),
            divide,
        }
    }

    /// What to send so that it has the value that a person writes, with or without a unit.
    ///
    /// # Errors
    /// If the text is not a number, has another unit or is out of range.
    pub fn parse(&self, text: &str) -> Result<Setting, VariableError> {
        let (name, given) = (self.name.clone(), text.to_owned());
        let Some(amount) = Amount::split(text.trim()) else {
            return Err(VariableError::NotANumber { name, text: given });
        };
        let value = match amount.in_unit(self.unit) {
            Ok(value) => value,
            Err(source) => return Err(VariableError::Unit { name, text: given, source }),
        };
        match self.range {
            Some((least, most)) if !(least..=most).contains(&value) => {
                Err(VariableError::OutOfRange { name, text: given, least, most, unit: self.unit })
            }
            _ => Ok(Setting { id: self.id, raw: value * self.divide }),
        }
    }
}

/// The variables that a name means: the name in any case, a number, or a pattern with `*`.
///
/// # Errors
/// If nothing is called so.
pub fn variables_called<'v>(variables: &'v [Variable], name: &str) -> Result<Vec<&'v Variable>, NameError> {
    let wanted = name.to_ascii_uppercase().replace(['-', '.'], "_");
    let found: Vec<_> = variables
        .iter()
        .filter(|variable| match wanted.parse::<u8>() {
            Ok(number) => variable.id.raw() == number,
            Err(_) => super::catalog::fits(&wanted, &variable.name.to_ascii_uppercase()),
        })
        .collect();
    if found.is_empty() {
        let names = variables.iter().map(|variable| variable.name.as_str());
        return Err(NameError::Unknown { name: name.to_owned(), similar: nearest(name, names) });
    }
    Ok(found)
}

impl Parameters {
    /// The variables that the firmware has, with their values.
    ///
    /// Firmware 2.73+ lists them itself; for older firmware they are those that are published.
    ///
    /// # Errors
    /// If the board does not answer, or refuses.
    pub async fn variables(&self) -> Result<Vec<Variable>> {
        if has(self.info().firmware_ver, AdjVarsInfoRequest::SINCE)
            && let Some(listed) = self.listed().await?
        {
            return Ok(listed);
        }
        let firmware = self.info().firmware_ver;
        let known = AdjustableVariable::ALL.iter().filter(|facts| has(firmware, facts.since));
        let ids: Vec<_> = known.map(|facts| facts.variable).collect();
        let mut variables = Vec::new();
        for ids in ids.chunks(AT_ONCE) {
            match self.variable_values(ids).await {
                // Not of all variables it is published since when they are: one that is missing refuses all.
                Err(ParamsError::Host(Error::Refused { .. })) => {
                    variables.extend(self.those_there(ids).await?);
                }
                values => variables.extend(values?),
            }
        }
        Ok(variables)
    }

    /// Those of some variables that the board does not refuse.
    async fn those_there(&self, ids: &[AdjustableVariable]) -> Result<Vec<Variable>> {
        let mut variables = Vec::new();
        for id in ids {
            match self.variable_values(std::slice::from_ref(id)).await {
                Err(ParamsError::Host(Error::Refused { .. })) => {}
                values => variables.extend(values?),
            }
        }
        Ok(variables)
    }

    /// The variables as the board lists them; none where it refuses to.
    async fn listed(&self) -> Result<Option<Vec<Variable>>> {
        let mut variables: Vec<Variable> = Vec::new();
        loop {
            let start = variables.last().map_or(0, |last| last.id.raw().saturating_add(1));
            let request = AdjVarsInfoRequest { start_id: Some(start.into()) };
            let answer = match self.gimbal().exchange(&request).await {
                Err(Error::Refused { .. }) if variables.is_empty() => return Ok(None),
                answer => answer?,
            };
            let page = answer.get();
            let before = variables.len();
            for info in &page.vars {
                // A page that begins anew would go on for ever.
                if info.var_id.raw() < start {
                    continue;
                }
                let mut variable = Variable::published(info.var_id, f64::from(info.value));
                if info.var_id.facts().is_none() {
                    variable.name = String::from_utf8_lossy(info.name.0).into_owned();
                }
                let (least, most) = (f64::from(info.range_min), f64::from(info.range_max));
                if least < most {
                    variable.range = Some((least / variable.divide, most / variable.divide));
                }
                variables.push(variable);
            }
            if variables.len() == before || variables.len() >= usize::from(page.total_number) {
                return Ok(Some(variables));
            }
        }
    }

    /// Values of variables, as floats where the firmware has them so.
    ///
    /// # Errors
    /// If the board does not answer, or does not know one of them.
    pub async fn variable_values(&self, ids: &[AdjustableVariable]) -> Result<Vec<Variable>> {
        let mut variables = Vec::new();
        for ids in ids.chunks(AT_ONCE) {
            if let Some(values) = self.values_as_floats(ids).await? {
                variables.extend(values);
                continue;
            }
            let values: AdjVarsVal = self.gimbal().request(&GetAdjVarsVal { param_id: list(ids)? }).await?;
            let value =
                |value: &VariableValue| Variable::published(value.param_id, f64::from(value.param_value));
            variables.extend(values.params.iter().map(value));
        }
        Ok(variables)
    }

    /// Values as floats; none where the firmware does not have them so.
    async fn values_as_floats(&self, ids: &[AdjustableVariable]) -> Result<Option<Vec<Variable>>> {
        if !self.has_floats() {
            return Ok(None);
        }
        let values: AdjVarsValF = match self.gimbal().request(&GetAdjVarsValF { param_id: list(ids)? }).await
        {
            Err(Error::Refused { .. }) => return Ok(None),
            values => values?,
        };
        let value = |value: &VariableValueF| {
            Variable::published(value.param_id, f64::from(f32::from_bits(value.param_value.bits())))
        };
        Ok(Some(values.params.iter().map(value).collect()))
    }

    fn has_floats(&self) -> bool {
        has(self.info().firmware_ver, GetAdjVarsValF::SINCE)
    }

    /// Sets variables at once, without saving them. Values are sent as integers unless one has a fraction and
    /// the firmware accepts floats.
    ///
    /// # Errors
    /// If the board does not answer, or refuses.
    pub async fn set_variables(&self, settings: &[Setting]) -> Result<()> {
        for command in self.variable_commands(settings)? {
            match command {
                VariableCommand::Integers(command) => self.gimbal().confirm(&command).await?,
                VariableCommand::Floats(command) => self.gimbal().confirm(&command).await?,
            };
        }
        Ok(())
    }

    /// The commands that set variables.
    ///
    /// # Errors
    /// If they do not fit messages, which at most 40 at a time always do.
    pub fn variable_commands(&self, settings: &[Setting]) -> Result<Vec<VariableCommand>> {
        let floats = self.has_floats() && settings.iter().any(|setting| setting.raw.fract().abs() > 1e-6);
        settings
            .chunks(AT_ONCE)
            .map(|settings| {
                if floats {
                    #[allow(clippy::cast_possible_truncation, reason = "the wire has 32 bits")]
                    let value = |setting: &Setting| VariableValueF {
                        param_id: setting.id,
                        param_value: Float::from_bits((setting.raw as f32).to_bits()),
                    };
                    let params = list(&settings.iter().map(value).collect::<Vec<_>>())?;
                    Ok(VariableCommand::Floats(SetAdjVarsValF(AdjVarsValF { params })))
                } else {
                    #[allow(clippy::cast_possible_truncation, reason = "ranges are those of 16 bits")]
                    let value = |setting: &Setting| VariableValue {
                        param_id: setting.id,
                        param_value: setting.raw.round() as i32,
                    };
                    let params = list(&settings.iter().map(value).collect::<Vec<_>>())?;
                    Ok(VariableCommand::Integers(SetAdjVarsVal(AdjVarsVal { params })))
                }
            })
            .collect()
    }

    /// Saves variables to the EEPROM: these, or all that are in use where none is named.
    ///
    /// # Errors
    /// If the firmware cannot save some only, or the board does not answer or refuses.
    pub async fn save_variables(&self, ids: &[AdjustableVariable]) -> Result<()> {
        if ids.is_empty() {
            self.gimbal().confirm(&SaveParams3 {}).await?;
        } else {
            self.gimbal().confirm(&self.saving(ids)?).await?;
        }
        Ok(())
    }

    /// The command that saves some variables.
    ///
    /// # Errors
    /// If the firmware cannot save some only.
    pub fn saving(&self, ids: &[AdjustableVariable]) -> Result<SaveParams3Extended> {
        let (firmware, since) = (self.info().firmware_ver, SaveParams3Extended::SINCE.unwrap_or_default());
        if firmware < since {
            return Err(ParamsError::Firmware { what: "saving some variables only", since, firmware });
        }
        Ok(SaveParams3Extended { adj_var_id: packed(ids)? })
    }
}

/// A command that sets variables, in one of its forms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VariableCommand {
    /// With integers.
    Integers(SetAdjVarsVal),
    /// With floats. Firmware 2.73.4+.
    Floats(SetAdjVarsValF),
}

fn packed(ids: &[AdjustableVariable]) -> Result<Packed<AdjustableVariable, 255>> {
    let mut list = Packed::new();
    ids.iter().try_for_each(|id| list.push(id)).map_err(Error::Encode)?;
    Ok(list)
}

fn list<T: Clone, const N: usize>(elements: &[T]) -> Result<List<T, N>> {
    let mut list = List::new();
    for element in elements {
        let full = |_| Error::Encode(EncodeError::BufferTooSmall { needed: elements.len(), capacity: N });
        list.push(element.clone()).map_err(full)?;
    }
    Ok(list)
}
