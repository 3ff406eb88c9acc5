//! A file of parameters laid over what a board has.

use super::{ParameterFile, Section, write};
use crate::params::block::Profile;
use crate::params::catalog::Catalog;
use crate::params::set::{Blocks, Snapshot, Values};

/// Board parameters overlaid with those of a file.
#[derive(Clone, Debug, Default)]
pub struct Applied {
    /// Blocks with the file's values.
    pub blocks: Blocks,
    /// Paths in the file that this firmware does not have, or not with the same meaning.
    pub left_out: Vec<String>,
}

impl ParameterFile {
    /// Writes parameters as a new document.
    pub fn document(snapshot: &Snapshot) -> String {
        write::document(snapshot)
    }

    /// Updates an older document of the same profiles, keeping its comments and the order of its lines; returns `None`
    /// if it is not such a document.
    pub fn updated(old: &str, snapshot: &Snapshot) -> Option<String> {
        write::updated(old, snapshot)
    }

    /// Overlays the file's values of a profile onto `board`, the blocks of a board with `catalog`.
    pub fn apply(&self, profile: Profile, board: &Blocks, catalog: &Catalog) -> Applied {
        self.lay(self.profiles.get(&profile), board, catalog)
    }

    /// Overlays the settings that belong to no profile onto `board`.
    pub fn apply_shared(&self, board: &Blocks, catalog: &Catalog) -> Applied {
        self.lay(self.shared.as_ref(), board, catalog)
    }

    fn lay(&self, section: Option<&Section>, board: &Blocks, catalog: &Catalog) -> Applied {
        let mut applied = Applied { blocks: board.clone(), left_out: Vec::new() };
        let Some(section) = section else { return applied };
        // Bytes without a name mean something in the same firmware only.
        if self.is_for(catalog.firmware()) {
            for (block, raw) in &section.raw {
                applied.blocks.take_unnamed(*block, raw, catalog.firmware());
            }
        }
        for (parameter, bytes) in &section.values {
            let known = catalog.by_path(&parameter.path).filter(|known| board.bytes_of(known).is_some());
            match known {
                Some(known) => applied.blocks.set(known, bytes),
                None => applied.left_out.push(parameter.path.clone()),
            }
        }
        applied
    }

    /// Values of a profile by parameter.
    pub fn values(&self, profile: Profile) -> Values {
        values(self.profiles.get(&profile))
    }

    /// Values that belong to no profile, by parameter.
    pub fn shared_values(&self) -> Values {
        values(self.shared.as_ref())
    }
}

fn values(section: Option<&Section>) -> Values {
    let mut values = Values::default();
    for (parameter, bytes) in section.iter().flat_map(|section| &section.values) {
        values.insert(parameter.clone(), bytes.clone());
    }
    values
}
