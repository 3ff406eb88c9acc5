//! Captures in numbers: frames by command, skipped bytes by cause.

use std::collections::BTreeMap;
use std::io;

use sbgc_host::capture::{Captured, Interpreter};
use sbgc_proto::frame::Cause;
use sbgc_proto::{CommandId, Direction};
use serde_json::json;

use crate::output::Output;

/// Counts what is in a capture, in memory that does not grow with it.
pub(super) struct Summary {
    interpreter: Interpreter,
    direction: Option<Direction>,
    commands: BTreeMap<(u8, bool), Count>,
    skipped: BTreeMap<Cause, u64>,
}

/// The frames of one command in one direction.
#[derive(Default)]
struct Count {
    frames: u64,
    bytes: u64,
    undecoded: u64,
}

impl Summary {
    pub(super) fn new(custom_flags: Option<u32>, direction: Option<Direction>) -> Self {
        Self {
            interpreter: Interpreter::new(custom_flags),
            direction,
            commands: BTreeMap::new(),
            skipped: BTreeMap::new(),
        }
    }

    pub(super) fn count(&mut self, item: Captured) {
        match item {
            Captured::Skipped { length, cause, .. } => {
                *self.skipped.entry(cause).or_default() += u64::try_from(length).unwrap_or_default();
            }
            Captured::Frame { version, direction, id, payload, .. } => {
                let direction = self.direction.or(direction);
                let direction = direction.unwrap_or_else(|| Interpreter::likely_direction(id, payload.len()));
                let decoded = self.interpreter.interpret(Some(direction), id, &payload).is_ok();
                let bytes = version.map_or(payload.len(), |version| version.frame_len(payload.len()));
                let count = self.commands.entry((id, direction == Direction::Incoming)).or_default();
                count.frames += 1;
                count.bytes += u64::try_from(bytes).unwrap_or_default();
                count.undecoded += u64::from(!decoded);
            }
        }
    }

    pub(super) fn print(&self, output: &mut Output) -> io::Result<()> {
        for ((id, is_incoming), Count { frames, bytes, undecoded }) in &self.commands {
            let direction = if *is_incoming { Direction::Incoming } else { Direction::Outgoing };
            let name = CommandId::from_raw(*id).spec_name(direction);
            if output.is_json() {
                output.object(&json!({
                    "kind": "frames", "direction": direction.as_str(), "id": id, "name": name,
                    "frames": frames, "bytes": bytes, "undecoded": undecoded,
                }))?;
                continue;
            }
            let (name, direction) = (name.unwrap_or("command"), direction.as_str());
            let undecoded = if *undecoded > 0 { format!(", {undecoded} undecoded") } else { String::new() };
            let (frames, bytes) = (counted(*frames, "frame"), counted(*bytes, "byte"));
            output.line(format_args!("{name} ({id}) {direction}: {frames}, {bytes}{undecoded}"))?;
        }
        for (cause, length) in &self.skipped {
            if output.is_json() {
                output.object(&json!({"kind": "skipped", "cause": cause.as_str(), "length": length}))?;
            } else {
                output.line(format_args!("skipped, {cause}: {}", counted(*length, "byte")))?;
            }
        }
        Ok(())
    }
}

fn counted(number: u64, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {what}{plural}")
}
