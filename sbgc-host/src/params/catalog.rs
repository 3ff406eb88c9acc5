//! The parameters of a firmware by name.

use std::collections::BTreeMap;

use sbgc_proto::units::FirmwareVersion;

use super::block::{Block, has};
use super::parameter::{Parameter, parameters_of};

/// How similar a name has to be to be offered in the place of a misspelled one, 0 to 1.
const SIMILAR: f64 = 0.75;

/// A firmware that has everything.
const NEWEST: FirmwareVersion = FirmwareVersion(u16::MAX);

/// How many are offered.
const OFFERED: usize = 3;

/// The parameters that a firmware has, in wire order: those of a profile, or those that belong to no profile.
///
/// All blocks share one namespace of paths. Where two blocks have the same path, the newer block's is meant.
///
/// ```
/// use sbgc_host::params::Catalog;
///
/// let catalog = Catalog::newest();
/// let memory = catalog.find("rc_memory")?;
/// assert_eq!(memory.len(), 3);
/// assert_eq!(catalog.one("RC_MEMORY").is_err(), true);
/// assert_eq!(catalog.one("servo_rate")?.unit(), "Hz");
/// let error = catalog.find("servo_rat").unwrap_err();
/// assert_eq!(error.to_string(), "no parameter is called \"servo_rat\"; similar names: servo_rate");
/// # Ok::<(), sbgc_host::params::NameError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Catalog {
    firmware: FirmwareVersion,
    parameters: Vec<Parameter>,
}

/// Why a name does not mean what it should.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NameError {
    /// Nothing is called so.
    #[error("no parameter is called {name:?}{}", Similar(.similar))]
    Unknown {
        /// What was asked for.
        name: String,
        /// The nearest real names.
        similar: Vec<String>,
    },
    /// The name means several.
    #[error("{name:?} means several parameters: {}", Listed(.candidates))]
    Ambiguous {
        /// What was asked for.
        name: String,
        /// What it may mean.
        candidates: Vec<String>,
    },
}

struct Similar<'n>(&'n [String]);
struct Listed<'n>(&'n [String]);

impl std::fmt::Display for Similar<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0.is_empty() { Ok(()) } else { write!(f, "; similar names: {}", self.0.join(", ")) }
    }
}

impl std::fmt::Display for Listed<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let shown = self.0.get(..12).unwrap_or(self.0);
        f.write_str(&shown.join(", "))?;
        match self.0.len() - shown.len() {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

impl Catalog {
    /// The parameters of a profile in this firmware.
    pub fn of_profile(firmware: FirmwareVersion) -> Self {
        Self::of(&Block::OF_PROFILE, firmware)
    }

    /// What belongs to no profile in this firmware.
    pub fn of_board(firmware: FirmwareVersion) -> Self {
        Self::of(&Block::OF_BOARD, firmware)
    }

    /// The parameters of a profile in the newest firmware that is known.
    pub fn newest() -> Self {
        Self::of_profile(NEWEST)
    }

    /// What belongs to no profile in the newest firmware that is known.
    pub(super) fn newest_of_board() -> Self {
        Self::of_board(NEWEST)
    }

    /// The firmware.
    pub const fn firmware(&self) -> FirmwareVersion {
        self.firmware
    }

    fn of(blocks: &[Block], firmware: FirmwareVersion) -> Self {
        let blocks = blocks.iter().filter(|block| block.is_in(firmware));
        let mut parameters: Vec<_> = blocks.flat_map(|block| parameters_of(*block)).collect();
        parameters.retain(|parameter| has(firmware, parameter.field.since));
        let newest: BTreeMap<_, _> =
            parameters.iter().map(|parameter| (parameter.path.clone(), parameter.block)).collect();
        parameters.retain(|parameter| newest.get(&parameter.path) == Some(&parameter.block));
        Self { firmware, parameters }
    }

    /// All of them in wire order.
    pub fn iter(&self) -> impl Iterator<Item = &Parameter> {
        self.parameters.iter()
    }

    /// The parameter with this path.
    pub fn by_path(&self, path: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.path == path)
    }

    /// Everything that a name means: a path, a name of the specification, a beginning of paths up to a dot, an ending
    /// that only one path has, or a pattern with `*` over the whole path.
    ///
    /// # Errors
    /// If nothing is called so, or an ending is that of several paths.
    pub fn find(&self, name: &str) -> Result<Vec<&Parameter>, NameError> {
        if let Some(parameter) = self.by_path(name) {
            return Ok(vec![parameter]);
        }
        let matching = |matches: &dyn Fn(&Parameter) -> bool| {
            let found: Vec<_> = self.parameters.iter().filter(|parameter| matches(parameter)).collect();
            (!found.is_empty()).then_some(found)
        };
        let lower = name.to_ascii_lowercase();
        if name.contains('*') {
            return matching(&|parameter| fits(&lower, &parameter.path)).ok_or_else(|| self.unknown(name));
        }
        let beginning = lower.trim_end_matches('.');
        let begins = |parameter: &Parameter| {
            let rest = parameter.path.strip_prefix(beginning);
            !beginning.is_empty() && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let ends = |parameter: &Parameter| {
            let rest = parameter.path.strip_suffix(&lower);
            !lower.is_empty() && rest.is_some_and(|rest| rest.ends_with('.') || lower.starts_with('['))
        };
        if let Some(found) = matching(&|parameter| parameter.field.spec.eq_ignore_ascii_case(name))
            .or_else(|| matching(&begins))
        {
            return Ok(found);
        }
        match matching(&ends) {
            Some(found) if found.len() == 1 => Ok(found),
            Some(found) => Err(ambiguous(name, &found)),
            None => Err(self.unknown(name)),
        }
    }

    /// The one parameter that a name means.
    ///
    /// # Errors
    /// If it means none or several.
    pub fn one(&self, name: &str) -> Result<&Parameter, NameError> {
        let found = self.find(name)?;
        match found.as_slice() {
            [one] => Ok(one),
            _ => Err(ambiguous(name, &found)),
        }
    }

    /// That nothing is called so, and what is called alike.
    pub(super) fn unknown(&self, name: &str) -> NameError {
        let names = self.parameters.iter().flat_map(|parameter| {
            let ends = parameter.path.match_indices(['.', '[']).map(|(at, _)| at);
            let beginnings = ends.filter_map(|at| parameter.path.get(..at));
            [parameter.path.as_str(), parameter.field.spec].into_iter().chain(beginnings)
        });
        NameError::Unknown { name: name.into(), similar: nearest(name, names) }
    }
}

/// The names most like `name`, the likeliest first.
pub fn nearest<'n>(name: &str, names: impl IntoIterator<Item = &'n str>) -> Vec<String> {
    let wanted = name.to_ascii_lowercase();
    let mut rated: Vec<(f64, &str)> = names
        .into_iter()
        .filter(|candidate| !candidate.is_empty())
        .map(|candidate| {
            (strsim::normalized_damerau_levenshtein(&wanted, &candidate.to_ascii_lowercase()), candidate)
        })
        .filter(|(similarity, _)| *similarity >= SIMILAR)
        .collect();
    rated.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut offered: Vec<String> = Vec::new();
    for (_, candidate) in rated {
        if !offered.iter().any(|offered| offered.eq_ignore_ascii_case(candidate)) {
            offered.push(candidate.to_owned());
        }
    }
    offered.truncate(OFFERED);
    offered
}

fn ambiguous(name: &str, found: &[&Parameter]) -> NameError {
    let candidates = found.iter().map(|parameter| parameter.path.clone()).collect();
    NameError::Ambiguous { name: name.into(), candidates }
}

/// Whether `pattern`, in which `*` stands for any text, is all of `text`.
pub(super) fn fits(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = text.strip_prefix(first) else { return false };
    let mut parts = parts.peekable();
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return rest.ends_with(part);
        }
        match rest.find(part).and_then(|at| rest.get(at + part.len()..)) {
            Some(after) => rest = after,
            None => return false,
        }
    }
    rest.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_cover_the_whole_path() {
        assert!(fits("motors.*.p", "motors.pitch.p"));
        assert!(fits("*", ""));
        assert!(fits("*rc*", "rc_trim.roll"));
        assert!(!fits("motors.*.p", "motors.pitch.power"));
        assert!(!fits("m*s", "motors.pitch.p"));
        assert!(!fits("ab*ba", "aba"));
    }
}
