//! The offsets that the documentation of fields shows.

use std::fmt::Write as _;
use std::sync::{Mutex, PoisonError};

use crate::wire::Slot;

/// The file that the macros read.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/commands/offsets.txt");

/// Compares the file with the declaration of a structure; with `UPDATE_OFFSETS=1`, writes it there.
pub(crate) fn check(structure: &str, slots: &[Slot]) {
    /// One test at a time writes.
    static WRITING: Mutex<()> = Mutex::new(());

    let mut line = structure.to_owned();
    for slot in slots {
        if let Some(offset) = slot.at {
            let _ = write!(line, " {}={offset}", slot.name);
        }
    }
    let has_offsets = line != structure;
    let is_of = |line: &str| line.split(' ').next() == Some(structure);
    if std::env::var_os("UPDATE_OFFSETS").is_some() {
        let _guard = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
        let text = std::fs::read_to_string(FILE).unwrap_or_default();
        let mut lines: Vec<&str> = text.lines().filter(|line| !is_of(line)).collect();
        lines.extend(has_offsets.then_some(line.as_str()));
        lines.sort_unstable();
        std::fs::write(FILE, lines.join("\n") + "\n").unwrap();
        return;
    }
    let text = std::fs::read_to_string(FILE).unwrap();
    let known = text.lines().find(|line| is_of(line));
    let expected = has_offsets.then_some(line.as_str());
    let remedy = "UPDATE_OFFSETS=1 cargo test -p sbgc-proto --all-features --lib offsets_of";
    assert_eq!(known, expected, "the documentation shows other offsets; run `{remedy}`");
}
