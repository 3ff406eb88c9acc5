//! A file of the GUI laid over what a board has.

use super::{GAINS, GuiFile, Include as Word, Number};
use crate::params::Applied;
use crate::params::catalog::Catalog;
use crate::params::set::{Blocks, Values};

/// What is written on request only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Include {
    /// Elements of which it is likely, but not sure, what they mean.
    Likely,
    /// Calibration and wiring of one machine.
    UnitSpecific,
    /// Settings of ports, which can end the connection.
    Link,
}

impl Include {
    /// The word for it: `likely`, `unit-specific`, `link`.
    pub const fn name(self) -> &'static str {
        match self {
            Include::Likely => "likely",
            Include::UnitSpecific => "unit-specific",
            Include::Link => "link",
        }
    }

    /// All of them.
    pub const ALL: [Self; 3] = [Self::Likely, Self::UnitSpecific, Self::Link];
}

impl GuiFile {
    /// The values of the profile at `position`, with those that all profiles share, laid over the blocks of a profile.
    pub fn apply(&self, position: usize, board: &Blocks, catalog: &Catalog, include: &[Word]) -> Applied {
        let profile = self.profiles.get(position).into_iter();
        let readings = std::iter::once(&self.board).chain(profile);
        let numbers = readings.flat_map(|reading| &reading.numbers);
        self.lay(numbers.filter(|number| number.parameter.block.is_of_profile()), board, catalog, include)
    }

    /// What belongs to no profile laid over `board`.
    pub fn apply_shared(&self, board: &Blocks, catalog: &Catalog, include: &[Word]) -> Applied {
        let numbers = self.board.numbers.iter();
        self.lay(numbers.filter(|number| !number.parameter.block.is_of_profile()), board, catalog, include)
    }

    fn lay<'n>(
        &self,
        numbers: impl Iterator<Item = &'n Number>,
        board: &Blocks,
        catalog: &Catalog,
        include: &[Word],
    ) -> Applied {
        let mut applied = Applied { blocks: board.clone(), left_out: Vec::new() };
        let gains = self.gains_are_known(catalog.firmware());
        for number in numbers {
            if !Word::asked_by(number.element).all(|word| include.contains(&word)) {
                continue;
            }
            let path = &number.parameter.path;
            let known = catalog.by_path(path).filter(|known| board.bytes_of(known).is_some());
            let Some(known) = known.filter(|_| gains || !GAINS.contains(&number.element.path)) else {
                applied.left_out.push(path.clone());
                continue;
            };
            let held = applied.blocks.bytes_of(known).and_then(|bytes| known.raw(bytes)).unwrap_or_default();
            let (mask, low) = number.mask();
            let raw = (held & !mask) | ((number.raw << low) & mask);
            let bytes = raw.to_le_bytes();
            if let Some(bytes) = bytes.get(..known.size) {
                applied.blocks.set(known, bytes);
            }
        }
        applied
    }

    /// The values of the profile at `position` by name, with those that all profiles share.
    pub fn values(&self, position: usize, board: &Blocks, catalog: &Catalog, include: &[Word]) -> Values {
        let mut values = Values::default();
        let blocks = self.apply(position, board, catalog, include).blocks;
        let readings = std::iter::once(&self.board).chain(self.profiles.get(position));
        for number in readings.flat_map(|reading| &reading.numbers) {
            if Word::asked_by(number.element).all(|word| include.contains(&word))
                && let Some(known) = catalog.by_path(&number.parameter.path)
                && let Some(bytes) = blocks.bytes_of(known)
            {
                values.insert(known.clone(), bytes.to_vec());
            }
        }
        values
    }
}
