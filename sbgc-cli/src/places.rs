//! Where files of the tool are, by the XDG base directory specification.

use std::path::PathBuf;

/// The directory of the configuration, `$XDG_CONFIG_HOME/sbgc`.
pub(crate) fn config() -> Option<PathBuf> {
    place("XDG_CONFIG_HOME", ".config")
}

/// The directory of what the tool keeps, such as backups, `$XDG_STATE_HOME/sbgc`.
pub(crate) fn state() -> Option<PathBuf> {
    place("XDG_STATE_HOME", ".local/state")
}

fn place(variable: &str, in_home: &str) -> Option<PathBuf> {
    // A relative path is invalid there, and is ignored.
    let base = std::env::var_os(variable).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = || std::env::home_dir().filter(|home| home.is_absolute()).map(|home| home.join(in_home));
    base.or_else(home).map(|base| base.join("sbgc"))
}
