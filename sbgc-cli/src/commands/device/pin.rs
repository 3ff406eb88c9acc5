//! `sbgc pin`: the board's pins.

use clap::{Args, ValueEnum};
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use sbgc_host::actions::PinLevel;
use sbgc_proto::commands::{TriggerPin, TriggerPinId, TriggerPinState};
use serde_json::json;

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, talk, text};

const EXAMPLES: &str = "Examples:
  sbgc --dry-run pin 16 high
  sbgc --dry-run pin aux2 float
  sbgc --yes pin aux1 low --json";

/// Drive or read a pin
///
/// N is the number of a pin or its name, such as aux1. A pin that has another function is not driven. Driving asks
/// first. Reading makes the pin an input; firmware 2.74.3+ reports its level.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Pin {
    /// Pin: a number or a name
    #[arg(value_name = "N", value_parser = pin, add = ArgValueCandidates::new(candidates))]
    pin: TriggerPinId,

    /// What to do with it
    #[arg(value_enum)]
    action: Action,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Action {
    /// Drive it to 3.3 V
    High,
    /// Drive it to ground
    Low,
    /// Let it float
    Float,
    /// Read its level
    Read,
}

fn short(name: &str) -> String {
    name.strip_prefix("PIN_").unwrap_or(name).to_ascii_lowercase()
}

/// What a shell completes for a pin.
fn candidates() -> Vec<CompletionCandidate> {
    TriggerPinId::LABELS.iter().map(|label| CompletionCandidate::new(short(label.name))).collect()
}

fn pin(text: &str) -> Result<TriggerPinId, String> {
    let number = text.parse::<u8>().ok();
    let wanted = short(&text.to_ascii_uppercase().replace('-', "_"));
    let is_it = |label: &&sbgc_proto::wire::Label| {
        number.map_or_else(|| short(label.name) == wanted, |number| label.value == i64::from(number))
    };
    match TriggerPinId::LABELS.iter().find(is_it) {
        Some(label) => Ok(TriggerPinId::from(u8::try_from(label.value).unwrap_or_default())),
        None => {
            let names: Vec<String> = TriggerPinId::LABELS.iter().map(|label| short(label.name)).collect();
            Err(text::unknown("pin", text, names.iter().map(String::as_str)))
        }
    }
}

impl Pin {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let label = TriggerPinId::LABELS.iter().find(|label| label.value == i64::from(self.pin.raw()));
        let name = label.map_or_else(|| self.pin.raw().to_string(), |label| short(label.name));
        let (state, word) = match self.action {
            Action::High => (TriggerPinState::High, "high"),
            Action::Low => (TriggerPinState::Low, "low"),
            Action::Float => (TriggerPinState::Floating, "float"),
            Action::Read => return self.read(global, output, &name).await,
        };
        let command = TriggerPin { pin_id: self.pin, state };
        with_board(global, async |gimbal, _| {
            if global.dry_run {
                return act::show(output, gimbal.version(), &command);
            }
            talk::say(format_args!("pin {name} becomes {word}; whatever is connected to it sees that"));
            act::ask(global, "Drive the pin?").await?;
            if !gimbal.pin_drive(self.pin, state).await? {
                return Err(Failure::Failed(format!(
                    "pin {name} was not driven: the board has no such pin, or uses it for something else"
                )));
            }
            let own = json!({"pin": self.pin.raw(), "level": word});
            Ok(output.outcome("pin", State::Done, own, format_args!("{name}: {word}"))?)
        })
        .await
    }

    async fn read(&self, global: &Global, output: &mut Output, name: &str) -> Result<(), Failure> {
        with_board(global, async |gimbal, _| {
            if global.dry_run {
                let command = TriggerPin { pin_id: self.pin, state: TriggerPinState::PulledDown };
                return act::show(output, gimbal.version(), &command);
            }
            let level = match gimbal.pin_read(self.pin).await? {
                PinLevel::Low => Some("low"),
                PinLevel::High => Some("high"),
                PinLevel::Unknown => None,
            };
            let own = json!({"pin": self.pin.raw(), "level": level});
            Ok(output.outcome(
                "pin",
                State::Done,
                own,
                format_args!("{name}: {}", level.unwrap_or("unknown")),
            )?)
        })
        .await
    }
}
