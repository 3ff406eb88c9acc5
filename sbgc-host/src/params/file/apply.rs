//! A file of parameters laid over what a board has.

use super::{ParameterFile, Section, write};
use crate::params::block::Profile;
use crate::params::catalog::Catalog;
use crate::params::set::{Blocks, Snapshot, Values};

/// What comes of laying the parameters of a file over those of a board.
#[derive(Clone, Debug, Default)]
pub struct Applied {
    /// The blocks with the values of the file.
    pub blocks: Blocks,
    /// Paths of the file that the board's firmware does not have, or not as such.
    pub left_out: Vec<String>,
}

impl ParameterFile {
    /// The document for these parameters.
    pub fn document(snapshot: &Snapshot) -> String {
        write::document(snapshot)
    }

    /// An older document of the same profiles brought up to date, its comments and the order of its lines kept; none
    /// where it is no such document.
    pub fn updated(old: &str, snapshot: &Snapshot) -> Option<String> {
        write::updated(old, snapshot)
    }

    /// The file's values of a profile laid over `board`, the blocks of a board with `catalog`.
    pub fn apply(&self, profile: Profile, board: &Blocks, catalog: &Catalog) -> Applied {
        self.lay(self.profiles.get(&profile), board, catalog)
    }

    /// What belongs to no profile laid over `board`.
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

    /// The values of a profile by name.
    pub fn values(&self, profile: Profile) -> Values {
        values(self.profiles.get(&profile))
    }

    /// The values of what belongs to no profile, by name.
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
