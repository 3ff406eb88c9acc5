//! `sbgc events`: what happens on the board.

use std::time::{Duration, Instant};

use clap::Args;
use sbgc_host::capture::Interpreter;
use sbgc_host::streams::Sample;
use sbgc_host::{Error, Gimbal, StreamRequest};
use sbgc_proto::commands::{EventId, EventTypes, StreamSource};
use sbgc_proto::{CommandId, Direction};
use tokio::time::timeout;

use crate::connect::with_followed_board;
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::samples::Printer;
use crate::{talk, text, values};

const EXAMPLES: &str = "Examples:
  sbgc events --for 1s
  sbgc events motor-state script --for 500ms --json";

/// Show events as they happen
///
/// Reports events of the menu button, motors, emergency stop, camera and scripts. Runs until interrupted, the output
/// is closed, or --count or --for is reached. timestamp_ms is the time since the start. Firmware 2.65+.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Events {
    /// Kinds of events, such as menu-button or script [default: all]
    #[arg(value_name = "EVENT", value_parser = event)]
    kinds: Vec<EventId>,

    /// Repeat interval of an event while something is held
    #[arg(long, default_value = "100ms", value_parser = values::interval, value_name = "TIME", allow_hyphen_values = true)]
    interval: u16,

    /// Stop after N events
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,

    /// Stop after this time
    #[arg(long = "for", value_name = "TIME", value_parser = values::seconds)]
    time: Option<Duration>,
}

const PREFIX: &str = "EVENT_ID_";

fn event(name: &str) -> Result<EventId, String> {
    let plain = name.to_ascii_uppercase().replace('-', "_");
    let plain = plain.strip_prefix(PREFIX).unwrap_or(&plain);
    let short = |name: &'static str| name.strip_prefix(PREFIX).unwrap_or(name);
    match EventId::LABELS.iter().find(|label| short(label.name) == plain) {
        Some(label) => Ok(EventId::from(u8::try_from(label.value).unwrap_or_default())),
        None => Err(text::unknown("event", plain, EventId::LABELS.iter().map(|label| short(label.name)))),
    }
}

impl Events {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let limit = self.time.unwrap_or(Duration::MAX);
        until_stopped(
            with_followed_board(global, async |gimbal, _| {
                timeout(limit, self.show(&gimbal, output)).await.unwrap_or(Ok(()))
            })
            .await,
        )
    }

    async fn show(&self, gimbal: &Gimbal, output: &mut Output) -> Result<(), Failure> {
        let began = Instant::now();
        let mut events = gimbal.listen(CommandId::Event);
        // Each kind is a stream of its own.
        let registered = self.subscribe(gimbal).await?;
        let mut interpreter = Interpreter::new(None);
        let mut printer = Printer::default();
        let mut left = self.count.unwrap_or(u64::MAX);
        while left > 0 {
            match events.next().await {
                None => return Err(Error::Disconnected.into()),
                Some(Sample::Lagged(lost)) => talk::say(format_args!("{lost} events lost")),
                Some(Sample::Interrupted(_) | Sample::Resumed(_)) => {}
                Some(Sample::Payload(payload)) => {
                    left -= 1;
                    let id = CommandId::Event.raw();
                    let event = interpreter
                        .interpret(Some(Direction::Incoming), id, &payload)
                        .map_err(Error::from)?;
                    printer.print(output, &event, began.elapsed())?;
                }
            }
        }
        drop(registered);
        Ok(())
    }

    async fn subscribe(&self, gimbal: &Gimbal) -> Result<Vec<sbgc_host::Subscription>, Failure> {
        let mut registered = Vec::new();
        let all =
            EventId::LABELS.iter().map(|label| EventId::from(u8::try_from(label.value).unwrap_or_default()));
        let chosen = if self.kinds.is_empty() { all.collect() } else { self.kinds.clone() };
        for event_id in chosen {
            let source = StreamSource::Event { event_id, event_type: EventTypes::all() };
            match gimbal.subscribe(StreamRequest::of(source, self.interval)).await {
                Ok(subscription) => registered.push(subscription),
                // Not every firmware has all kinds.
                Err(error @ Error::Refused { .. }) if self.kinds.is_empty() => {
                    tracing::info!("{event_id:?}: {error}");
                    if event_id == EventId::MenuButton {
                        return Err(error.into());
                    }
                }
                Err(error) => return Err(error.into()),
            }
        }
        Ok(registered)
    }
}
