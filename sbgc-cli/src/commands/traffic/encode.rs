//! `sbgc encode`: the inverse of `decode`, a frame from a command's name and fields.

use clap::{Args, ValueEnum};
use sbgc_proto::frame::{MAX_FRAME, Version};
use sbgc_proto::reflect::{AssignError, Input, MessageInfo};
use sbgc_proto::{IncomingCommand, OutgoingCommand};
use serde_json::json;

use crate::failure::Failure;
use crate::options::{Global, Protocol};
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc encode BOARD_INFO
  sbgc encode READ_PARAMS profile_id=1
  sbgc encode MOTORS_OFF mode=1 --protocol 1";

/// Build a frame from a command name and field values
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Encode {
    /// The spec's name of the command, with or without CMD_
    name: String,

    /// Fields as PATH=VALUE: values in the field's unit, names of values, hex bytes; what is not named is zero or absent
    #[arg(value_name = "FIELD=VALUE", value_parser = assignment)]
    fields: Vec<(String, String)>,

    /// Which way the message goes
    #[arg(long, value_enum, default_value_t)]
    direction: Way,

    /// The form, where the command has several
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

fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) => Ok((path.trim().to_owned(), value.trim().to_owned())),
        None => Err(format!("expected FIELD=VALUE, got {text:?}")),
    }
}

impl Encode {
    pub(crate) fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let version = match global.protocol {
            Protocol::V1 => Version::V1,
            Protocol::V2 | Protocol::Auto => Version::V2,
        };
        let info = self.message()?;
        // Bytes are borrowed by the message, so they are made before it.
        let bytes: Vec<Option<Vec<u8>>> = self.fields.iter().map(|(_, value)| bytes_of(value)).collect();
        let mut buffer = [0; MAX_FRAME];
        let frame = if self.direction == Way::Outgoing {
            let mut message = OutgoingCommand::blank(info.id, info.form).ok_or_else(|| self.unknown())?;
            self.assign(&bytes, |path, value| message.set(path, value))?;
            message.encode_frame(version, &mut buffer)
        } else {
            let mut message = IncomingCommand::blank(info.id, info.form).ok_or_else(|| self.unknown())?;
            self.assign(&bytes, |path, value| message.set(path, value))?;
            message.encode_frame(version, &mut buffer)
        };
        let frame = frame.map_err(|error| Failure::Usage(format!("{}: {error}", info.spec)))?;
        if output.is_json() {
            output.object(&json!({
                "name": info.spec,
                "form": info.form,
                "version": version.number(),
                "frame": hex::encode(frame),
            }))?;
        } else {
            let pairs: Vec<String> = frame.iter().map(|byte| format!("{byte:02X}")).collect();
            output.line(pairs.join(" "))?;
        }
        Ok(())
    }

    fn assign<'v>(
        &'v self,
        bytes: &'v [Option<Vec<u8>>],
        mut set: impl FnMut(&str, Input<'v>) -> Result<(), AssignError>,
    ) -> Result<(), Failure> {
        for ((path, value), bytes) in self.fields.iter().zip(bytes) {
            let result = match bytes {
                // Hex digits may be the bytes of a block, a text, or a number.
                Some(bytes) => match set(path, Input::Bytes(bytes)) {
                    Err(AssignError::NotANumber { .. }) => set(path, Input::Text(value)),
                    result => result,
                },
                None => set(path, Input::Text(value)),
            };
            result.map_err(|error| Failure::Usage(format!("{path}={value}: {error}")))?;
        }
        Ok(())
    }

    fn message(&self) -> Result<&'static MessageInfo, Failure> {
        let all = match self.direction {
            Way::Outgoing => OutgoingCommand::ALL,
            Way::Incoming => IncomingCommand::ALL,
        };
        let name = self.name.to_ascii_uppercase();
        let name = name.strip_prefix("CMD_").unwrap_or(&name);
        let forms: Vec<_> = all
            .iter()
            .filter(|info| info.spec.strip_prefix("CMD_").is_some_and(|spec| spec == name))
            .collect();
        let wanted = self.form.as_deref();
        let found = match (forms.as_slice(), wanted) {
            ([], _) => return Err(self.unknown()),
            (forms, Some(wanted)) => forms.iter().find(|info| info.form == wanted),
            (forms, None) => forms.iter().find(|info| info.is_default),
        };
        found.copied().ok_or_else(|| {
            let names: Vec<_> = forms.iter().map(|info| info.form).collect();
            let wanted = wanted.unwrap_or_default();
            Failure::Usage(format!("CMD_{name} has no form {wanted:?}; there are {}", names.join(", ")))
        })
    }

    fn unknown(&self) -> Failure {
        let direction = if self.direction == Way::Outgoing { "outgoing" } else { "incoming" };
        Failure::Usage(format!("{:?} is no {direction} command of the protocol", self.name))
    }
}

/// The bytes, if `value` is a hex dump of whole bytes.
fn bytes_of(value: &str) -> Option<Vec<u8>> {
    let digits: String = value.chars().filter(|character| !character.is_whitespace()).collect();
    hex::decode(digits).ok()
}
