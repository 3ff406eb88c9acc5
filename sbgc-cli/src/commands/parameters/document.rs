//! Files of parameters: those of `params dump`, and those of the vendor's GUI.

use std::path::Path;

use sbgc_host::params::{Applied, Block, Blocks, Catalog, GuiFile, Include, ParameterFile, Profile, Values};
use sbgc_proto::units::FirmwareVersion;

use crate::failure::Failure;
use crate::{files, talk};

/// A file of parameters.
#[derive(Clone, Debug)]
pub(super) enum Document {
    Toml(ParameterFile),
    /// A file of the GUI, and what of it is written besides what is sure.
    Gui(Box<GuiFile>, Vec<Include>),
}

/// A profile in a file: its number, or in a file of the GUI its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Own {
    Number(Profile),
    Position(usize),
}

impl Document {
    /// Reads a file and checks it.
    pub(super) fn read(path: &Path, include: &[Include]) -> Result<Self, Failure> {
        Self::parse(&files::read_text(path)?, &path.display().to_string(), include)
    }

    /// Checks the text of a file that is found at `place`.
    pub(super) fn parse(text: &str, place: &str, include: &[Include]) -> Result<Self, Failure> {
        let wrong = |line: Option<usize>, problem: String| {
            let line = line.map_or_else(String::new, |line| format!(":{line}"));
            Failure::Usage(format!("{place}{line}: {problem}"))
        };
        if GuiFile::is_meant(text) {
            let file = GuiFile::parse(text).map_err(|error| wrong(error.line, error.problem.to_string()))?;
            return Ok(Self::Gui(Box::new(file), include.to_vec()));
        }
        let file =
            ParameterFile::parse(text).map_err(|error| wrong(error.line, error.problem.to_string()))?;
        Ok(Self::Toml(file))
    }

    /// The version of the firmware that it comes from, where it says so.
    pub(super) fn firmware(&self) -> Option<FirmwareVersion> {
        match self {
            Self::Toml(file) => file.firmware(),
            Self::Gui(file, _) => Some(file.firmware()),
        }
    }

    /// Whether it comes from a firmware with the same major and minor version.
    pub(super) fn is_for(&self, firmware: FirmwareVersion) -> bool {
        match self {
            Self::Toml(file) => file.is_for(firmware),
            Self::Gui(file, _) => file.is_for(firmware),
        }
    }

    /// Whether it has one profile without saying which.
    pub(super) fn is_nameless(&self) -> bool {
        matches!(self, Self::Gui(file, _) if file.is_single())
    }

    /// Its profiles, each with the profile of the board that it is for: the only one is for `wanted`; of several the
    /// wanted one is taken. One that does not say its number is for the active profile.
    pub(super) fn profiles(
        &self,
        wanted: Option<Profile>,
        active: Option<Profile>,
    ) -> Result<Vec<(Own, Profile)>, Failure> {
        let all: Vec<(Own, Profile)> = match self {
            Self::Toml(file) => file.profiles().map(|profile| (Own::Number(profile), profile)).collect(),
            Self::Gui(file, _) if file.is_single() => {
                active.or(wanted).map(|profile| (Own::Position(0), profile)).into_iter().collect()
            }
            Self::Gui(file, _) => {
                let positions = (0..file.profile_count()).map(Own::Position);
                positions.zip(Profile::all()).collect()
            }
        };
        match (wanted, all.as_slice()) {
            (None, _) => Ok(all),
            (Some(wanted), [(own, _)]) => Ok(vec![(*own, wanted)]),
            (Some(wanted), several) => {
                let found = several.iter().find(|(_, profile)| *profile == wanted);
                found
                    .map(|found| vec![*found])
                    .ok_or_else(|| Failure::Usage(format!("the file has no {wanted}")))
            }
        }
    }

    /// Whether it has something that belongs to no profile, for when `wanted` is all that is asked for.
    pub(super) fn has_shared(&self, wanted: Option<Profile>) -> bool {
        match self {
            Self::Toml(file) => file.has_shared() && (wanted.is_none() || file.profiles().count() == 1),
            Self::Gui(..) => true,
        }
    }

    /// The values of a profile laid over `blocks`; says what the firmware lacks.
    pub(super) fn lay(&self, own: Own, blocks: &Blocks, catalog: &Catalog, whose: &str) -> Blocks {
        let applied = match (self, own) {
            (Self::Toml(file), Own::Number(profile)) => file.apply(profile, blocks, catalog),
            (Self::Gui(file, include), Own::Position(position)) => {
                let applied = file.apply(position, blocks, catalog, include);
                let all = file.apply(position, blocks, catalog, &Include::ALL);
                say_withheld(file, &applied.blocks, &all.blocks, catalog, whose);
                applied
            }
            _ => Applied { blocks: blocks.clone(), ..Applied::default() },
        };
        say_left_out(applied, whose)
    }

    /// The same for what belongs to no profile.
    pub(super) fn lay_shared(&self, blocks: &Blocks, catalog: &Catalog) -> Blocks {
        let applied = match self {
            Self::Toml(file) => file.apply_shared(blocks, catalog),
            Self::Gui(file, include) => {
                let applied = file.apply_shared(blocks, catalog, include);
                let all = file.apply_shared(blocks, catalog, &Include::ALL);
                say_withheld(file, &applied.blocks, &all.blocks, catalog, "board");
                applied
            }
        };
        say_left_out(applied, "board")
    }

    /// Says what is never written though it holds something.
    pub(super) fn say_never_written(&self) {
        if let Self::Gui(file, _) = self {
            for held in file.never_written() {
                talk::say(format_args!("not written: {}", crate::text::escape(held)));
            }
        }
    }

    /// The values of a profile by name, without a board.
    pub(super) fn values(&self, own: Own) -> Values {
        match (self, own) {
            (Self::Toml(file), Own::Number(profile)) => file.values(profile),
            (Self::Gui(file, include), Own::Position(position)) => {
                let mut blank = Blocks::default();
                for block in Block::OF_PROFILE {
                    blank.insert(block, vec![0; block.size()]);
                }
                file.values(position, &blank, &Catalog::of_profile(file.firmware()), include)
            }
            _ => Values::default(),
        }
    }

    /// The values of what belongs to no profile, by name, without a board.
    pub(super) fn shared_values(&self) -> Values {
        match self {
            Self::Toml(file) => file.shared_values(),
            Self::Gui(..) => Values::default(),
        }
    }
}

fn say_left_out(applied: Applied, whose: &str) -> Blocks {
    if !applied.left_out.is_empty() {
        talk::say(format_args!("{whose}: not written for this firmware: {}", applied.left_out.join(", ")));
    }
    applied.blocks
}

/// Says which values of a GUI's file differ from the board's and ask for a word.
fn say_withheld(file: &GuiFile, chosen: &Blocks, all: &Blocks, catalog: &Catalog, whose: &str) {
    let mut by_words: Vec<(String, Vec<String>)> = Vec::new();
    for difference in chosen.values(catalog).differences(&all.values(catalog), None) {
        let asked = file.asks_for(&difference.path);
        let words =
            asked.iter().map(|word| format!("--include {}", word.name())).collect::<Vec<_>>().join(" ");
        match by_words.iter_mut().find(|(known, _)| *known == words) {
            Some((_, paths)) => paths.push(difference.path),
            None => by_words.push((words, vec![difference.path])),
        }
    }
    for (words, paths) in by_words {
        talk::say(format_args!("{whose}: not written without {words}: {}", paths.join(", ")));
    }
}
