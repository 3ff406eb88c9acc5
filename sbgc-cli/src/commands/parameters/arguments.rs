//! Arguments of these commands: profiles, names, and names with values.

use clap_complete::engine::CompletionCandidate;
use sbgc_host::params::{Catalog, Include, Profile};

/// A profile, 1 to 5. A value parser of clap.
pub(super) fn profile(text: &str) -> Result<Profile, String> {
    let number = text.parse().ok().and_then(Profile::from_number);
    number.ok_or_else(|| format!("expected a profile, 1 to {}", Profile::COUNT))
}

/// One profile or all of them.
#[derive(Clone, Copy, Debug)]
pub(super) enum Profiles {
    /// This one.
    One(Profile),
    /// All five.
    All,
}

/// A profile, 1 to 5, or `all`. A value parser of clap.
pub(super) fn profiles(text: &str) -> Result<Profiles, String> {
    match text {
        "all" => Ok(Profiles::All),
        _ => profile(text).map(Profiles::One).map_err(|error| format!("{error}, or all")),
    }
}

/// `NAME=VALUE`.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) name: String,
    pub(super) value: String,
}

/// `NAME=VALUE`. A value parser of clap.
pub(super) fn assignment(text: &str) -> Result<Assignment, String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE")?;
    if name.trim().is_empty() {
        return Err(String::from("expected a name before the ="));
    }
    Ok(Assignment { name: name.trim().into(), value: value.trim().into() })
}

/// What of a GUI's file is written on request only. A value parser of clap.
pub(super) fn include(text: &str) -> Result<Include, String> {
    let found = Include::ALL.into_iter().find(|include| include.name() == text);
    found.ok_or_else(|| format!("expected {}", Include::ALL.map(Include::name).join(", ")))
}

/// What a shell completes for the name of a parameter.
pub(super) fn candidates() -> Vec<CompletionCandidate> {
    Catalog::newest()
        .iter()
        .map(|parameter| CompletionCandidate::new(&parameter.path).help(Some(parameter.field.doc.into())))
        .collect()
}
