//! `sbgc send`: any command, by name or as it is.

use std::time::Duration;

use clap::{ArgGroup, Args};
use clap_complete::engine::ArgValueCandidates;
use sbgc_host::Gimbal;
use sbgc_host::capture::Captured;
use sbgc_proto::frame::{Decoder, Event, Versions};
use sbgc_proto::{CommandId, Direction, RequestInfo};
use serde_json::json;

use super::danger::dangerous;
use super::encode::{assignment, candidates, outgoing};
use super::explain::Explainer;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::{Output, State};
use crate::{act, talk, values};

const EXAMPLES: &str = "Examples:
  sbgc send GET_ANGLES
  sbgc send BEEP_SOUND mode=BEEPER_MODE_COMPLETE --json
  sbgc send --raw '24 49 00 49 04 08'";

/// Send a command by name, or a raw frame
///
/// Waits for the reply that the protocol defines for the command. Asks first for commands that change what the board
/// keeps. --json prints the frames of both directions, then the outcome.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, group = ArgGroup::new("what").required(true).args(["name", "raw"]))]
pub(crate) struct Send {
    /// The spec's name of the command, with or without CMD_, or its number
    #[arg(add = ArgValueCandidates::new(candidates))]
    name: Option<String>,

    /// Fields as PATH=VALUE, as encode takes them
    #[arg(value_name = "FIELD=VALUE", value_parser = assignment, requires = "name")]
    fields: Vec<(String, String)>,

    /// Form of the message, for commands with several
    #[arg(long, requires = "name")]
    form: Option<String>,

    /// Payload in hex, in place of fields
    #[arg(long, value_name = "HEX", requires = "name", conflicts_with_all = ["fields", "form"])]
    payload: Option<String>,

    /// Frame in hex, of either version, with correct checksums
    #[arg(long, value_name = "HEX")]
    raw: Option<String>,
}

/// How long an answer may take that the work comes before.
const SLOW: Duration = Duration::from_secs(30);

impl Send {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (command, payload) = self.message(global)?;
        if global.dry_run {
            return act::show_payload(output, global.version(), command, &payload);
        }
        if let Some(name) = dangerous(std::iter::once(command)).first() {
            talk::say(format_args!(
                "{name} ({}), {} bytes: {}",
                command.raw(),
                payload.len(),
                hex::encode(&payload)
            ));
            act::ask(global, "Send it?").await?;
        }
        with_board(global, async |gimbal, _| send(&gimbal, command, payload, output).await).await
    }

    fn message(&self, global: &Global) -> Result<(CommandId, Vec<u8>), Failure> {
        let bytes_of = |text: &str| values::bytes(text).map_err(Failure::Usage);
        if let Some(raw) = &self.raw {
            return frame(&bytes_of(raw)?);
        }
        let name = self.name.clone().unwrap_or_default();
        let built = frame(&outgoing(name, self.fields.clone(), self.form.clone(), global.version())?)?;
        match &self.payload {
            Some(payload) => Ok((built.0, bytes_of(payload)?)),
            None => Ok(built),
        }
    }
}

/// The only frame in these bytes.
fn frame(mut bytes: &[u8]) -> Result<(CommandId, Vec<u8>), Failure> {
    let expected =
        |why: &str| Failure::Usage(format!("expected one frame with correct checksums, got {why}"));
    let mut decoder = Decoder::new(Versions::Both);
    let mut found = None;
    while let Some(event) = decoder.next(&mut bytes) {
        match event {
            Event::Frame { frame, .. } if found.is_none() => {
                found = Some((CommandId::from_raw(frame.id), frame.payload.to_vec()));
            }
            Event::Frame { .. } => return Err(expected("several")),
            Event::Skipped(skipped) => return Err(expected(skipped.cause.as_str())),
        }
    }
    match (found, decoder.pending()) {
        (Some(found), 0) => Ok(found),
        _ => Err(expected("an incomplete one")),
    }
}

async fn send(
    gimbal: &Gimbal,
    command: CommandId,
    payload: Vec<u8>,
    output: &mut Output,
) -> Result<(), Failure> {
    let info = RequestInfo::of_payload(command, &payload);
    let answer = info.and_then(|info| info.answer);
    let item = |direction, command: CommandId, payload: &[u8]| Captured::Frame {
        at: 0,
        time: None,
        version: Some(gimbal.version()),
        direction: Some(direction),
        id: command.raw(),
        payload: payload.to_vec(),
    };
    let request = item(Direction::Outgoing, command, &payload);
    let received = match answer {
        Some(answer) => {
            let slow = info.is_some_and(|info| info.slow);
            let gimbal = if slow { gimbal.with_timeout(SLOW) } else { gimbal.clone() };
            Some((answer, gimbal.request_raw(command, payload.into(), answer).await?))
        }
        None => {
            gimbal.send_raw(command, payload.into()).await?;
            // It has left when the board has answered something later.
            gimbal.board_info().await?;
            None
        }
    };
    let json = output.is_json();
    let mut explainer = Explainer::new(None, None, output);
    // The answer may be readable only with the request in mind, so both are explained.
    explainer.print(request)?;
    let (state, text) = match received {
        Some((CommandId::CONFIRM, payload)) => {
            explainer.print(item(Direction::Incoming, CommandId::CONFIRM, &payload))?;
            (State::Accepted, "accepted")
        }
        Some((answer, payload)) => {
            explainer.print(item(Direction::Incoming, answer, &payload))?;
            (State::Done, "")
        }
        None => (State::Done, "sent; the protocol has no answer to it"),
    };
    let name = command.spec_name(Direction::Outgoing);
    if json || !text.is_empty() {
        output.outcome("send", state, json!({"name": name, "id": command.raw()}), text)?;
    }
    Ok(())
}
