//! `sbgc decode`: captured traffic, explained.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use sbgc_host::capture::{Format, Interpreter, Item, Reader};
use sbgc_proto::Direction;
use sbgc_proto::frame::Version;
use sbgc_proto::reflect::Leaf;
use serde_json::json;

use crate::failure::Failure;
use crate::output::Output;
use crate::{fields, signals, values};

const EXAMPLES: &str = "Examples:
  sbgc encode BOARD_INFO | sbgc decode
  sbgc encode CONFIRM cmd_id=1 --direction incoming | sbgc decode --json
  sbgc decode capture.bin";

/// Explain captured traffic
///
/// Shows each frame with all its fields, and each run of bytes that are no frame with the cause. What comes through a
/// pipe is shown as it comes. Answers that only their request explains are read with what was seen before.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Decode {
    /// The capture; standard input when left out, or for `-`
    file: Option<PathBuf>,

    /// How the capture is written
    #[arg(long, value_enum, default_value_t)]
    from: From,

    /// Which way the messages go
    #[arg(long, value_enum, default_value_t)]
    direction: Way,

    /// Flags of CMD_REALTIME_DATA_CUSTOM, where the capture has no request for it
    #[arg(long, value_name = "N", value_parser = values::number)]
    custom_flags: Option<u32>,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum From {
    /// Whatever the beginning looks like
    #[default]
    Auto,
    /// Raw bytes
    Bin,
    /// Hex digits; white space, 0x, : and , between bytes
    Hex,
    /// Debug log of the GUI
    Log,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Way {
    /// As the capture says, or as the message fits
    #[default]
    Auto,
    /// Host to controller
    Outgoing,
    /// Controller to host
    Incoming,
}

impl Decode {
    pub(crate) fn run(self, output: &mut Output) -> Result<(), Failure> {
        let (mut input, place) = open(self.file.as_deref())?;
        let mut reader = Reader::new(self.from.into());
        let direction = match self.direction {
            Way::Auto => None,
            Way::Outgoing => Some(Direction::Outgoing),
            Way::Incoming => Some(Direction::Incoming),
        };
        let mut explainer = Explainer::new(self.custom_flags, direction, output);
        let mut piece = vec![0; 64 * 1024];
        loop {
            let length = match input.read(&mut piece) {
                Ok(length) => length,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(source) => return Err(Failure::File { place, source }),
            };
            let fed = match piece.get(..length) {
                Some(bytes) if length > 0 => reader.feed(bytes, &mut |item| explainer.explain(item)),
                _ => reader.finish(&mut |item| explainer.explain(item)),
            };
            explainer.result?;
            explainer.result = Ok(());
            explainer.output.flush()?;
            fed?;
            if length == 0 {
                return Ok(());
            }
        }
    }
}

impl std::convert::From<From> for Format {
    fn from(from: From) -> Self {
        match from {
            From::Auto => Format::Auto,
            From::Bin => Format::Bin,
            From::Hex => Format::Hex,
            From::Log => Format::Log,
        }
    }
}

/// Opens a capture; standard input when there is no path, or for `-`.
fn open(path: Option<&Path>) -> Result<(Box<dyn Read>, String), Failure> {
    match path {
        Some(path) if path.as_os_str() != "-" => {
            let place = path.display().to_string();
            match File::open(path) {
                Ok(file) => Ok((Box::new(file), place)),
                Err(source) => Err(Failure::File { place, source }),
            }
        }
        _ => Ok((Box::new(io::stdin().lock()), String::from("standard input"))),
    }
}

/// Reads a capture as a whole.
pub(super) fn read_all(path: &Path, format: Format) -> Result<Vec<Item>, Failure> {
    signals::blocking(|| {
        let (mut input, place) = open(Some(path))?;
        let (mut bytes, mut items, mut reader) = (Vec::new(), Vec::new(), Reader::new(format));
        input.read_to_end(&mut bytes).map_err(|source| Failure::File { place, source })?;
        reader.feed(&bytes, &mut |item| items.push(item))?;
        reader.finish(&mut |item| items.push(item))?;
        Ok(items)
    })
}

/// Prints frames and what is skipped between them.
pub(super) struct Explainer<'o> {
    interpreter: Interpreter,
    direction: Option<Direction>,
    pub(super) output: &'o mut Output,
    result: io::Result<()>,
}

impl<'o> Explainer<'o> {
    pub(super) fn new(
        custom_flags: Option<u32>,
        direction: Option<Direction>,
        output: &'o mut Output,
    ) -> Self {
        Self { interpreter: Interpreter::new(custom_flags), direction, output, result: Ok(()) }
    }

    fn explain(&mut self, item: Item) {
        if self.result.is_ok() {
            self.result = self.print(item);
        }
    }

    pub(super) fn print(&mut self, item: Item) -> io::Result<()> {
        match item {
            Item::Skipped { at, length, cause } if self.output.is_json() => {
                let object = json!({"kind": "skipped", "at": at, "length": length, "cause": cause.as_str()});
                self.output.object(&object)
            }
            Item::Skipped { at, length, cause } => {
                self.output.line(format_args!("{at}: skipped {length} bytes: {cause}"))
            }
            Item::Frame { at, version, direction, id, payload, .. } => {
                let direction = self.direction.or(direction);
                self.print_frame(at, version, direction, id, &payload)
            }
        }
    }

    fn print_frame(
        &mut self,
        at: u64,
        version: Option<Version>,
        direction: Option<Direction>,
        id: u8,
        payload: &[u8],
    ) -> io::Result<()> {
        let message = match self.interpreter.interpret(direction, id, payload) {
            Ok(message) => message,
            Err(error) if self.output.is_json() => {
                let error = error.to_string();
                let object =
                    json!({"kind": "undecoded", "at": at, "id": id, "length": payload.len(), "error": error});
                return self.output.object(&object);
            }
            Err(error) => return self.output.line(format_args!("{at}: undecoded: {error}")),
        };
        let version = version.map(Version::number);
        let name = message.name().map_or_else(|| format!("command {id}"), str::to_owned);
        if self.output.is_json() {
            let mut leaves = Vec::new();
            message.walk(&mut |leaf: &Leaf<'_>| leaves.push(fields::to_json(leaf)));
            return self.output.object(&json!({
                "kind": "frame",
                "at": at,
                "version": version,
                "direction": message.direction().as_str(),
                "id": id,
                "name": message.name(),
                "form": message.form(),
                "length": payload.len(),
                "payload": hex::encode(payload),
                "fields": leaves,
            }));
        }
        let version = version.map_or_else(String::new, |version| format!(", version {version}"));
        let (direction, form, length) = (message.direction().as_str(), message.form(), payload.len());
        self.output
            .line(format_args!("{at}: {name} ({id}) {direction}, form {form}, {length} bytes{version}"))?;
        let mut lines = Vec::new();
        message.walk(&mut |leaf: &Leaf<'_>| lines.push(fields::to_text(leaf)));
        lines.iter().try_for_each(|line| self.output.line(format_args!("    {line}")))
    }
}
