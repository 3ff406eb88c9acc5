//! `sbgc encode`: the inverse of `decode`, a frame from a command's name and fields.

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::io::Write as _;

use clap::{Args, ValueEnum};
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use sbgc_host::capture::{AnyMessage, Interpreted};
use sbgc_proto::frame::{MAX_FRAME, MAX_PAYLOAD, Version};
use sbgc_proto::reflect::{self, AssignError, Input};
use sbgc_proto::{
    CommandId, Direction, EncodeError, IncomingCommand, MessageInfo, OutOfRange, OutgoingCommand,
};

use super::explain;
use crate::failure::Failure;
use crate::line::Line;
use crate::options::{Global, Protocol};
use crate::output::Output;
use crate::{talk, text};

const EXAMPLES: &str = "Examples:
  sbgc encode BOARD_INFO
  sbgc encode READ_PARAMS profile_id=1
  sbgc encode MOTORS_OFF mode=1 --protocol 1";

/// Build a frame from names and values
///
/// --json prints the frame as `decode --json` does, and its bytes as `frame`.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Encode {
    /// The spec's name of the command, with or without CMD_, or its number
    #[arg(add = ArgValueCandidates::new(candidates))]
    name: String,

    /// Fields as PATH=VALUE: anything that decode prints for a field; omitted fields are zero or absent
    ///
    /// Numbers may have a unit, values and flags may be given by name, and hex after 0x is the raw number. Bytes are hex
    /// digits. A text is taken as it is; in double quotes, it may have escapes such as \x00.
    #[arg(value_name = "FIELD=VALUE", value_parser = assignment)]
    fields: Vec<(String, String)>,

    /// Direction of the message
    #[arg(long, value_enum, default_value_t)]
    direction: Way,

    /// Form of the message, for commands with several
    #[arg(long)]
    form: Option<String>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Way {
    /// Host to controller
    #[default]
    Outgoing,
    /// Controller to host
    Incoming,
}

/// What a shell completes for the name of a command.
pub(super) fn candidates() -> Vec<CompletionCandidate> {
    let names = OutgoingCommand::ALL.iter().map(|info| info.spec.trim_start_matches("CMD_"));
    let names: BTreeSet<&str> = names.collect();
    names.into_iter().map(CompletionCandidate::new).collect()
}

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) => Ok((path.trim().to_owned(), value.to_owned())),
        None => Err(format!("expected FIELD=VALUE, got {text:?}")),
    }
}

impl Encode {
    pub(crate) fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let version = match global.protocol {
            Protocol::V1 => Version::V1,
            Protocol::V2 | Protocol::Auto => Version::V2,
        };
        let Encoded { frame, json, warnings } = self.encode(version)?;
        for warning in warnings {
            talk::say(format_args!("warning: {warning}"));
        }
        if output.is_json() {
            output.writer().write_all(json.as_bytes())?;
        } else {
            let pairs: Vec<String> = frame.iter().map(|byte| format!("{byte:02X}")).collect();
            output.line(pairs.join(" "))?;
        }
        Ok(())
    }

    fn encode(&self, version: Version) -> Result<Encoded, Failure> {
        // Some messages borrow their bytes, so these live longer than the message.
        let arena: Vec<OnceCell<Vec<u8>>> = self.fields.iter().map(|_| OnceCell::new()).collect();
        let target = self.target()?;
        let mut message = match target {
            Target::Form(info) => Message::blank(info),
            Target::Unknown(id) => Some(Message::unknown(self.direction.direction(), id)),
        }
        .ok_or_else(|| self.unknown())?;
        let mut warnings = Vec::new();
        for ((path, value), bytes) in self.fields.iter().zip(&arena) {
            let outside = force(&mut message, path, value, bytes)
                .map_err(|error| Failure::Usage(explain(path, value, &error)))?;
            warnings.extend(outside.map(|outside| format!("{path}={value}: {outside}")));
        }
        let mut buffer = [0; MAX_FRAME];
        let name = match target {
            Target::Form(info) => info.spec,
            Target::Unknown(_) => &self.name,
        };
        let frame = message
            .encode_frame(version, &mut buffer)
            .map_err(|error| Failure::Usage(format!("{name}: {error}")))?
            .to_vec();
        let json = explain::built(&frame, version, &message.into());
        Ok(Encoded { frame, json, warnings })
    }

    /// What to build.
    fn target(&self) -> Result<Target, Failure> {
        let all = match self.direction {
            Way::Outgoing => OutgoingCommand::ALL,
            Way::Incoming => IncomingCommand::ALL,
        };
        let id = self.name.parse().ok().filter(|id| *id != 0);
        let name = self.name.to_ascii_uppercase();
        let name = name.strip_prefix("CMD_").unwrap_or(&name);
        let is_meant = |info: &&MessageInfo| {
            id == Some(info.id.raw()) || info.spec.strip_prefix("CMD_").is_some_and(|spec| spec == name)
        };
        let forms: Vec<&'static MessageInfo> = all.iter().filter(is_meant).collect();
        let wanted = self.form.as_deref();
        let found = match (forms.as_slice(), wanted) {
            ([], None | Some("unknown")) if let Some(id) = id => return Ok(Target::Unknown(id)),
            ([], _) => return Err(self.unknown()),
            (forms, Some(wanted)) => forms.iter().find(|info| info.form == wanted),
            (forms, None) => forms.iter().find(|info| info.is_default),
        };
        found.copied().map(Target::Form).ok_or_else(|| {
            let names: Vec<_> = forms.iter().map(|info| info.form).collect();
            let (name, wanted) = (forms.first().map_or(name, |info| info.spec), wanted.unwrap_or_default());
            Failure::Usage(format!("{name} has no form {wanted:?}; available: {}", names.join(", ")))
        })
    }

    fn unknown(&self) -> Failure {
        let (direction, all) = match self.direction {
            Way::Outgoing => ("outgoing", OutgoingCommand::ALL),
            Way::Incoming => ("incoming", IncomingCommand::ALL),
        };
        let names = all.iter().map(|info| info.spec.trim_start_matches("CMD_"));
        let name = self.name.to_ascii_uppercase();
        let what = format!("{direction} command");
        Failure::Usage(text::unknown(&what, name.trim_start_matches("CMD_"), names))
    }
}

/// The frame of a message to the board, for whoever sends it. Warnings are printed.
pub(super) fn outgoing(
    name: String,
    fields: Vec<(String, String)>,
    form: Option<String>,
    version: Version,
) -> Result<Vec<u8>, Failure> {
    let Encoded { frame, warnings, .. } =
        Encode { name, fields, direction: Way::Outgoing, form }.encode(version)?;
    for warning in warnings {
        talk::say(format_args!("warning: {warning}"));
    }
    Ok(frame)
}

impl Way {
    fn direction(self) -> Direction {
        match self {
            Way::Outgoing => Direction::Outgoing,
            Way::Incoming => Direction::Incoming,
        }
    }
}

/// A frame, and what is to be said about it.
struct Encoded {
    frame: Vec<u8>,
    /// The frame as `decode` shows it.
    json: Line,
    warnings: Vec<String>,
}

#[derive(Clone, Copy)]
enum Target {
    Form(&'static MessageInfo),
    /// A command that the protocol does not have.
    Unknown(u8),
}

/// A message of either direction.
#[allow(clippy::large_enum_variant, reason = "there is one")]
enum Message<'a> {
    Outgoing(OutgoingCommand<'a>),
    Incoming(IncomingCommand<'a>),
}

impl<'a> Message<'a> {
    fn blank(info: &MessageInfo) -> Option<Self> {
        match info.direction {
            Direction::Outgoing => OutgoingCommand::blank(info.id, info.form).map(Message::Outgoing),
            Direction::Incoming => IncomingCommand::blank(info.id, info.form).map(Message::Incoming),
        }
    }

    fn unknown(direction: Direction, id: u8) -> Self {
        let (id, payload) = (CommandId::from_raw(id), &[][..]);
        match direction {
            Direction::Outgoing => Message::Outgoing(OutgoingCommand::Unknown { id, payload }),
            Direction::Incoming => Message::Incoming(IncomingCommand::Unknown { id, payload }),
        }
    }

    fn force(&mut self, path: &str, value: Input<'a>) -> Result<Option<OutOfRange>, AssignError> {
        match self {
            Message::Outgoing(message) => message.force(path, value),
            Message::Incoming(message) => message.force(path, value),
        }
    }

    fn encode_frame<'o>(&self, version: Version, out: &'o mut [u8]) -> Result<&'o [u8], EncodeError> {
        match self {
            Message::Outgoing(message) => message.encode_frame(version, out),
            Message::Incoming(message) => message.encode_frame(version, out),
        }
    }
}

impl<'a> From<Message<'a>> for Interpreted<'a> {
    fn from(message: Message<'a>) -> Self {
        let message = match message {
            Message::Outgoing(message) => AnyMessage::Outgoing(message),
            Message::Incoming(message) => AnyMessage::Incoming(message),
        };
        Interpreted { message, rest: &[] }
    }
}

/// Sets one field; `bytes` keeps those that a field borrows.
fn force<'a>(
    message: &mut Message<'a>,
    path: &str,
    value: &'a str,
    bytes: &'a OnceCell<Vec<u8>>,
) -> Result<Option<OutOfRange>, AssignError> {
    match message.force(path, Input::Text(value)) {
        Err(AssignError::Borrowed { text }) => {
            let mut buffer = [0; MAX_PAYLOAD];
            let decode = if text { reflect::text_bytes } else { reflect::hex_bytes };
            let decoded = decode(value, &mut buffer)?.to_vec();
            message.force(path, Input::Bytes(bytes.get_or_init(|| decoded)))
        }
        result => result,
    }
}

/// The error with the names that may have been meant.
fn explain(path: &str, value: &str, error: &AssignError) -> String {
    let step = |at: usize| {
        let step = path.get(at..).unwrap_or_default();
        step.split(['.', '[']).next().unwrap_or_default()
    };
    let error = match error {
        AssignError::NoSuchField { at, fields } if !fields.is_empty() => {
            text::unknown("field", step(*at), fields.iter().map(|field| field.name))
        }
        AssignError::NoSuchPart { at, parts } => text::unknown("part", step(*at), parts.iter().copied()),
        error => error.to_string(),
    };
    format!("{path}={value}: {error}")
}

#[cfg(test)]
mod tests;
