//! Writing parameters: what changes is shown, confirmed, backed up, written and verified.

use std::fs::{self, File};
use std::io;
use std::time::{SystemTime, UNIX_EPOCH};

use sbgc_host::params::{ParameterFile, Parameters, Place, Plan, Profile, Snapshot};

use super::show;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{act, files, places, talk};

/// Carries out a plan after its differences were shown and confirmed; returns whether it did.
///
/// With `--dry-run` it prints the frames; where nothing differs it says so.
pub(super) async fn carry_out(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    plan: &Plan,
) -> Result<bool, Failure> {
    if global.dry_run {
        let version = parameters.gimbal().version();
        for command in plan.commands() {
            act::show_payload(output, version, command.id, &command.payload)?;
        }
        return Ok(false);
    }
    if plan.is_empty() {
        talk::say("nothing to change: the board has these values");
        return Ok(false);
    }
    let differences = plan.differences();
    if !global.yes {
        for difference in &differences {
            talk::say(show::difference(difference));
        }
    }
    let (values, blocks) = (counted(differences.len(), "value"), counted(plan.steps().len(), "block"));
    act::ask(global, &format!("Write {values} in {blocks}?")).await?;
    let mut profiles: Vec<Profile> = plan.steps().iter().filter_map(|step| step.place.profile).collect();
    profiles.dedup();
    back_up(&parameters.snapshot(profiles).await?)?;
    let mut progress =
        Progress { written: Vec::new(), left: plan.steps().iter().map(|step| step.place).collect() };
    let outcome = parameters.write(plan, |step| progress.note(step.place)).await;
    progress.left.clear();
    outcome?;
    Ok(true)
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// Says what was written when a signal ends the work on the way.
struct Progress {
    written: Vec<Place>,
    left: Vec<Place>,
}

impl Progress {
    fn note(&mut self, place: Place) {
        self.left.retain(|left| *left != place);
        self.written.push(place);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.left.is_empty() {
            return;
        }
        let list = |places: &[Place]| {
            let names: Vec<_> = places.iter().map(Place::to_string).collect();
            if names.is_empty() { String::from("nothing") } else { names.join(", ") }
        };
        talk::say(format_args!(
            "interrupted; written: {}; not written: {}; run the same command again to complete it",
            list(&self.written),
            list(&self.left),
        ));
    }
}

/// Saves what a board has now below the state directory, and says where.
pub(super) fn back_up(snapshot: &Snapshot) -> Result<(), Failure> {
    let no_home = || Failure::Failed(String::from("no place for a backup; set XDG_STATE_HOME or HOME"));
    let directory = places::state().ok_or_else(no_home)?.join("backup");
    let failed = |source| Failure::File { place: directory.display().to_string(), source };
    fs::create_dir_all(&directory).map_err(failed)?;
    let now = timestamp();
    let names = (0..1000).map(|count| match count {
        0 => format!("{now}.toml"),
        count => format!("{now}-{count}.toml"),
    });
    for name in names {
        let path = directory.join(name);
        match File::create_new(&path) {
            Ok(_) => {
                files::write(&path, ParameterFile::document(snapshot).as_bytes())?;
                talk::say(format_args!("backup: {}", path.display()));
                return Ok(());
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(source) => return Err(Failure::File { place: path.display().to_string(), source }),
        }
    }
    Err(failed(io::ErrorKind::AlreadyExists.into()))
}

/// The time in UTC, as it can be part of a file's name: `2026-11-21T18-55-03Z`.
fn timestamp() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let (year, month, day) = date(days);
    format!("{year:04}-{month:02}-{day:02}T{:02}-{:02}-{:02}Z", rest / 3600, rest / 60 % 60, rest % 60)
}

/// Year, month and day, so many days after the first of January 1970.
fn date(days: u64) -> (u64, u64, u64) {
    // Years that begin in March end with the day that leap years add.
    let days = days + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    (year, month, day_of_year - (153 * shifted + 2) / 5 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_become_dates() {
        assert_eq!(date(0), (1970, 1, 1));
        assert_eq!(date(11_016), (2000, 2, 29));
        assert_eq!(date(20_778), (2026, 11, 21));
        assert_eq!(date(47_540), (2100, 2, 28));
        assert_eq!(date(47_541), (2100, 3, 1));
    }
}
