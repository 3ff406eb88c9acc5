//! `sbgc params`: parameters of the board by name.

use clap::{Args, Subcommand};
use sbgc_proto::commands::ProfileId;
use sbgc_proto::reflect::{self, Leaf};
use serde_json::{Map, Value, json};

use crate::connect::with_board;
use crate::failure::Failure;
use crate::fields;
use crate::options::Global;
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc params get
  sbgc params get motors.pitch rc_memory
  sbgc params get --profile 2 --json";

/// Read parameters
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Params {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Show parameters
    #[command(after_help = EXAMPLES)]
    Get(Get),
}

#[derive(Args, Debug)]
struct Get {
    /// Names or beginnings of paths, such as rc_memory, motors.pitch or SERVO_RATE; all when left out
    names: Vec<String>,

    /// Profile 1 to 5, or `current`
    #[arg(long, default_value = "current", value_parser = profile)]
    profile: ProfileId,
}

fn profile(text: &str) -> Result<ProfileId, String> {
    match text.parse::<u8>() {
        Ok(number @ 1..=5) => Ok(ProfileId::from_raw(number - 1)),
        _ if text.eq_ignore_ascii_case("current") => Ok(ProfileId::Current),
        _ => Err(String::from("no such profile; there are 1 to 5, and current")),
    }
}

impl Params {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Get(command) => command.run(global, output).await,
        }
    }
}

impl Get {
    async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let params = with_board(global, async |gimbal, _| Ok(gimbal.params3(self.profile).await?)).await?;
        let mut found = vec![false; self.names.len()];
        let mut lines = Vec::new();
        let mut object = Map::new();
        reflect::walk(&params, &mut |leaf: &Leaf<'_>| {
            let path = leaf.path.to_string();
            let mut wanted = self.names.is_empty() && !leaf.field.reserved;
            for (name, found) in self.names.iter().zip(&mut found) {
                if names(name, &path, leaf.field.spec) {
                    wanted = true;
                    *found = true;
                }
            }
            if wanted {
                lines.push(fields::to_text(leaf));
                fields::add_leaf(&mut object, leaf);
            }
        });
        if let Some((name, _)) = self.names.iter().zip(&found).find(|(_, found)| !**found) {
            return Err(Failure::Usage(format!(
                "no parameter is called {name:?}; `sbgc params get` lists them all"
            )));
        }
        if output.is_json() {
            output
                .object(&json!({ "profile": profile_name(self.profile), "params": Value::Object(object) }))?;
        } else {
            lines.iter().try_for_each(|line| output.line(line))?;
        }
        Ok(())
    }
}

fn profile_name(profile: ProfileId) -> Value {
    match profile {
        ProfileId::Current => "current".into(),
        profile => (profile.raw() + 1).into(),
    }
}

/// Whether `name` is the path, whole parts from its beginning, or the spec's name of the field.
fn names(name: &str, path: &str, spec: &str) -> bool {
    let begins = path.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
    begins || spec.eq_ignore_ascii_case(name)
}
