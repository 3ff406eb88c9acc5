//! `sbgc profile`: the five profiles as wholes.

use clap::{Args, Subcommand, ValueEnum};
use sbgc_host::params::{Parameters, Profile, activation, profile_set, use_defaults};
use sbgc_proto::commands::{ProfileSetAction, ProfileSetSlot};
use serde_json::json;

use super::arguments::profile;
use super::{change, show, source};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{act, talk, text};

/// List, switch, name, copy and reset profiles
///
/// `set` saves all five profiles to a slot of the board, 1 to 5 or backup, and loads them from it.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  sbgc profile list
  sbgc profile use 2
  sbgc profile name 2 'Heavy lens' --yes")]
pub(crate) struct ProfileArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// List the profiles with their names
    #[command(after_help = "Examples:
  sbgc profile list
  sbgc profile list --json")]
    List,
    /// Make a profile the active one
    #[command(after_help = "Examples:
  sbgc profile use 2
  sbgc profile use 1 --json")]
    Use {
        /// Profile, 1 to 5
        #[arg(value_name = "N", value_parser = profile)]
        profile: Profile,
    },
    /// Name a profile (maximum 48 bytes of UTF-8)
    #[command(after_help = "Examples:
  sbgc profile name 2 'Heavy lens' --yes
  sbgc profile name 2 '' --yes")]
    Name {
        /// Profile, 1 to 5
        #[arg(value_name = "N", value_parser = profile)]
        profile: Profile,
        /// Name
        #[arg(allow_hyphen_values = true)]
        text: String,
    },
    /// Copy all parameters of profile N to profile M
    #[command(after_help = "Examples:
  sbgc profile copy 1 2 --yes
  sbgc profile copy 1 2 --dry-run")]
    Copy {
        /// Profile to copy, 1 to 5
        #[arg(value_name = "N", value_parser = profile)]
        from: Profile,
        /// Profile to overwrite, 1 to 5
        #[arg(value_name = "M", value_parser = profile)]
        to: Profile,
    },
    /// Reset a profile to the factory values
    #[command(after_help = "Examples:
  sbgc profile reset 2 --yes
  sbgc profile reset 2 --dry-run")]
    Reset {
        /// Profile, 1 to 5
        #[arg(value_name = "N", value_parser = profile)]
        profile: Profile,
    },
    /// Save all profiles to a slot of the board, load them, or clear the slot
    #[command(after_help = "Examples:
  sbgc profile set save 1 --yes
  sbgc profile set load 1 --dry-run
  sbgc profile set clear backup --yes")]
    Set {
        /// What to do
        #[arg(value_enum)]
        action: Action,
        /// Slot, 1 to 5 or backup
        #[arg(value_name = "N", value_parser = slot)]
        slot: ProfileSetSlot,
    },
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Action {
    Save,
    Load,
    Clear,
}

/// A slot for a set of profiles. A value parser of clap.
fn slot(text: &str) -> Result<ProfileSetSlot, String> {
    match text.parse::<u8>() {
        Ok(number @ 1..=5) => Ok(ProfileSetSlot::from(number)),
        _ if text.eq_ignore_ascii_case("backup") => Ok(ProfileSetSlot::Backup),
        _ => Err(String::from("expected a slot, 1 to 5 or backup")),
    }
}

impl ProfileArgs {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        with_board(global, async |gimbal, info| {
            let parameters = Parameters::new(gimbal, info);
            match self.what {
                What::List => list(output, &parameters, |_| true).await,
                What::Use { profile } => activate(global, output, &parameters, profile).await,
                What::Name { profile, text } => {
                    let plan = parameters.plan_name(profile, &text).await?;
                    if global.dry_run {
                        return change::carry_out(global, output, &parameters, &plan).await.map(drop);
                    }
                    change::carry_out(global, output, &parameters, &plan).await?;
                    list(output, &parameters, |listed| listed == profile).await
                }
                What::Copy { from, to } => {
                    let plan = parameters.plan_copy(from, to).await?;
                    change::carry_out(global, output, &parameters, &plan).await?;
                    if global.dry_run {
                        Ok(())
                    } else {
                        list(output, &parameters, |listed| listed == to).await
                    }
                }
                What::Reset { profile } => reset(global, output, &parameters, profile).await,
                What::Set { action, slot } => set(global, output, &parameters, action, slot).await,
            }
        })
        .await
    }
}

/// Prints some of the profiles.
async fn list(
    output: &mut Output,
    parameters: &Parameters,
    wanted: impl Fn(Profile) -> bool,
) -> Result<(), Failure> {
    let (names, active) = (parameters.names().await?, parameters.active().await?);
    for (profile, name) in Profile::all().zip(&names).filter(|(profile, _)| wanted(*profile)) {
        if output.is_json() {
            output.object(&json!({
                "profile": profile.number(),
                "name": name,
                "active": profile == active,
            }))?;
        } else {
            let mark = if profile == active { "*" } else { " " };
            output.line(format_args!("{mark} {}  {}", profile.number(), text::escape(name)))?;
        }
    }
    Ok(())
}

async fn activate(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    profile: Profile,
) -> Result<(), Failure> {
    if global.dry_run {
        return act::show(output, parameters.gimbal().version(), &activation(profile));
    }
    parameters.activate(profile).await?;
    list(output, parameters, |listed| listed == profile).await
}

async fn reset(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    profile: Profile,
) -> Result<(), Failure> {
    if global.dry_run {
        return act::show(output, parameters.gimbal().version(), &use_defaults(profile));
    }
    let before = parameters.snapshot([profile]).await?;
    if !global.yes {
        match source::defaults(parameters).await {
            Ok(defaults) => {
                let catalog = parameters.catalog();
                for (own, blocks) in &before.profiles {
                    let after = source::over(&defaults, *own, blocks, &catalog)?;
                    let differences =
                        blocks.values(&catalog).differences(&after.values(&catalog), Some(*own));
                    for difference in &differences {
                        talk::say(show::difference(difference));
                    }
                }
            }
            Err(_) => talk::say(format_args!("all parameters of {profile} become those of the factory")),
        }
    }
    act::ask(global, &format!("Reset {profile} to the factory values?")).await?;
    change::back_up(&before)?;
    parameters.reset(profile).await?;
    source::keep_defaults(parameters.info(), &parameters.read(profile).await?);
    list(output, parameters, |listed| listed == profile).await
}

async fn set(
    global: &Global,
    output: &mut Output,
    parameters: &Parameters,
    action: Action,
    slot: ProfileSetSlot,
) -> Result<(), Failure> {
    let place = match slot {
        ProfileSetSlot::Backup => String::from("the backup slot"),
        slot => format!("slot {}", slot.raw()),
    };
    let (command, question) = match action {
        Action::Save => {
            (ProfileSetAction::Save, format!("Save all profiles to {place}, overwriting what it has?"))
        }
        Action::Load => (ProfileSetAction::Load, format!("Replace all profiles by those of {place}?")),
        Action::Clear => (ProfileSetAction::Clear, format!("Clear {place}?")),
    };
    if global.dry_run {
        return act::show(output, parameters.gimbal().version(), &profile_set(slot, command));
    }
    act::ask(global, &question).await?;
    if matches!(action, Action::Load) {
        change::back_up(&parameters.snapshot(Profile::all()).await?)?;
    }
    parameters.profile_set(slot, command).await?;
    list(output, parameters, |_| true).await
}
