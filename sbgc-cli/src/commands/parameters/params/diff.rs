//! `sbgc params diff`.

use clap::Args;
use sbgc_host::params::{Difference, Include, Parameters, Profile};

use super::super::arguments::{include, profile};
use super::super::document::{Document, Own};
use super::super::show;
use super::super::source::{self, Source};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

/// Compare parameters of files, of the board and of its profiles
///
/// A and B are a file, `board`, `defaults` or `profile:N`. For a file, only the profiles and parameters that it
/// contains are compared. Compared with a profile or defaults, `board` is the active profile. No command reads the
/// factory values of a real board: `profile reset` keeps those that it finds, and `defaults` means them from then on.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc params dump gimbal.toml && sbgc params diff gimbal.toml
  sbgc params diff profile:1 profile:2 --json
  sbgc params diff defaults")]
pub(super) struct Diff {
    /// One side
    #[arg(value_parser = source::source)]
    a: Source,

    /// Other side
    #[arg(value_parser = source::source, default_value = "board")]
    b: Source,

    /// Profile that `board` and a file with one profile stand for [default: the active one]
    #[arg(long, value_name = "N", value_parser = profile)]
    profile: Option<Profile>,

    /// Also compare from a GUI's file: likely, unit-specific, link
    #[arg(long, value_name = "CLASS", value_parser = include)]
    include: Vec<Include>,

    /// End with 1 when there are differences
    #[arg(long)]
    exit_code: bool,
}

/// One side, read as far as that goes without a board.
enum Side {
    File(Box<Document>),
    Board,
    Profile(Profile),
    Defaults,
}

impl Diff {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let differences = match (self.side(&self.a)?, self.side(&self.b)?) {
            (Side::File(a), Side::File(b)) => self.between_files(&a, &b)?,
            (a, b) => {
                with_board(global, async |gimbal, info| {
                    let parameters = Parameters::new(gimbal, info);
                    let (a, b) = (a.known(&parameters).await?, b.known(&parameters).await?);
                    self.with_sides(&parameters, &a, &b).await
                })
                .await?
            }
        };
        for difference in &differences {
            if output.is_json() {
                output.object(&show::difference_json(difference))?;
            } else {
                output.line(show::difference(difference))?;
            }
        }
        if self.exit_code && !differences.is_empty() {
            output.flush()?;
            return Err(Failure::Differs);
        }
        Ok(())
    }

    fn side(&self, source: &Source) -> Result<Side, Failure> {
        Ok(match source {
            Source::File(path) => Side::File(Box::new(Document::read(path, &self.include)?)),
            Source::Board => Side::Board,
            Source::Profile(profile) => Side::Profile(*profile),
            Source::Defaults => Side::Defaults,
        })
    }

    /// What two files say of the parameters that both have.
    fn between_files(&self, a: &Document, b: &Document) -> Result<Vec<Difference>, Failure> {
        let first = Profile::all().next();
        let of = |file: &Document| file.profiles(self.profile, self.profile.or(first));
        let (a_has, b_has) = (of(a)?, of(b)?);
        let pairs: Vec<_> = match (a_has.as_slice(), b_has.as_slice()) {
            ([a], [b]) => vec![(*a, *b)],
            (all, others) => {
                let same = |one: &(Own, Profile)| {
                    others.iter().find(|other| other.1 == one.1).map(|other| (*one, *other))
                };
                all.iter().filter_map(same).collect()
            }
        };
        let mut differences: Vec<_> = pairs
            .into_iter()
            .flat_map(|((own, one), (others, other))| {
                a.values(own).differences(&b.values(others), (one == other).then_some(one))
            })
            .collect();
        differences.extend(a.shared_values().differences(&b.shared_values(), None));
        Ok(differences)
    }

    async fn with_sides(
        &self,
        parameters: &Parameters,
        a: &Known,
        b: &Known,
    ) -> Result<Vec<Difference>, Failure> {
        match (a, b) {
            (Known::File(file), other) => self.file_with(parameters, file, other).await,
            (other, Known::File(file)) => Ok(swapped(self.file_with(parameters, file, other).await?)),
            (Known::Defaults(defaults), other) => self.defaults_with(parameters, defaults, other).await,
            (other, Known::Defaults(defaults)) => {
                Ok(swapped(self.defaults_with(parameters, defaults, other).await?))
            }
            _ => {
                let (one, other) =
                    (self.profile_of(parameters, a).await?, self.profile_of(parameters, b).await?);
                let catalog = parameters.catalog();
                let (a, b) = (parameters.read(one).await?, parameters.read(other).await?);
                let profile = (one == other).then_some(one);
                Ok(a.values(&catalog).differences(&b.values(&catalog), profile))
            }
        }
    }

    /// The profile of the board that a side stands for.
    async fn profile_of(&self, parameters: &Parameters, side: &Known) -> Result<Profile, Failure> {
        match (side, self.profile) {
            (Known::Profile(profile), _) => Ok(*profile),
            (_, Some(profile)) => Ok(profile),
            _ => Ok(parameters.active().await?),
        }
    }

    /// A file with something of the board; `a` is the file's.
    async fn file_with(
        &self,
        parameters: &Parameters,
        file: &Document,
        other: &Known,
    ) -> Result<Vec<Difference>, Failure> {
        let wanted = if let Known::Profile(profile) = other { Some(*profile) } else { self.profile };
        let active =
            if file.is_nameless() && wanted.is_none() { Some(parameters.active().await?) } else { None };
        let pairs = file.profiles(wanted, active)?;
        let catalog = parameters.catalog();
        let mut differences = Vec::new();
        for (own, on_board) in pairs {
            let mut blocks = parameters.read(on_board).await?;
            if let Known::Defaults(defaults) = other {
                blocks = source::over(defaults, on_board, &blocks, &catalog)?;
            }
            let of_file = file.lay(own, &blocks, &catalog, &on_board.to_string());
            differences
                .extend(of_file.values(&catalog).differences(&blocks.values(&catalog), Some(on_board)));
        }
        if file.has_shared(wanted) && matches!(other, Known::Board) {
            let (catalog, blocks) = (parameters.shared_catalog(), parameters.read_shared().await?);
            let of_file = file.lay_shared(&blocks, &catalog);
            differences.extend(of_file.values(&catalog).differences(&blocks.values(&catalog), None));
        }
        file.say_never_written();
        Ok(differences)
    }

    /// Factory values with something of the board; `a` is the factory's.
    async fn defaults_with(
        &self,
        parameters: &Parameters,
        defaults: &Document,
        other: &Known,
    ) -> Result<Vec<Difference>, Failure> {
        if matches!(other, Known::Defaults(_)) {
            return Ok(Vec::new());
        }
        let profile = self.profile_of(parameters, other).await?;
        let (catalog, blocks) = (parameters.catalog(), parameters.read(profile).await?);
        let factory = source::over(defaults, profile, &blocks, &catalog)?;
        Ok(factory.values(&catalog).differences(&blocks.values(&catalog), Some(profile)))
    }
}

impl Side {
    /// The rest of what has to be read.
    async fn known(self, parameters: &Parameters) -> Result<Known, Failure> {
        Ok(match self {
            Side::Defaults => Known::Defaults(source::defaults(parameters).await?),
            Side::File(file) => Known::File(*file),
            Side::Board => Known::Board,
            Side::Profile(profile) => Known::Profile(profile),
        })
    }
}

/// One side with a board at hand.
enum Known {
    File(Document),
    Defaults(Document),
    Board,
    Profile(Profile),
}

fn swapped(differences: Vec<Difference>) -> Vec<Difference> {
    let swap = |difference: Difference| Difference { a: difference.b, b: difference.a, ..difference };
    differences.into_iter().map(swap).collect()
}
