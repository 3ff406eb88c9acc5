//! Frames as text and as JSON, with all their fields.

use std::io::{self, Write as _};

use sbgc_host::capture::{Captured, Interpreted, Interpreter};
use sbgc_proto::frame::{Cause, Decoder, Event, Version, Versions};
use sbgc_proto::reflect::Leaf;
use sbgc_proto::{CommandId, DecodeError, Direction};

use crate::fields;
use crate::line::Line;
use crate::output::Output;

/// Prints frames and what is skipped between them.
pub(super) struct Explainer<'o> {
    interpreter: Interpreter,
    direction: Option<Direction>,
    pub(super) output: &'o mut Output,
    /// The frame that is being put together.
    line: Line,
}

/// What is known of a frame before its payload is read.
struct Head<'f> {
    at: u64,
    version: Option<Version>,
    direction: Direction,
    id: u8,
    name: Option<&'static str>,
    payload: &'f [u8],
}

impl<'o> Explainer<'o> {
    pub(super) fn new(
        custom_flags: Option<u32>,
        direction: Option<Direction>,
        output: &'o mut Output,
    ) -> Self {
        Self { interpreter: Interpreter::new(custom_flags), direction, output, line: Line::default() }
    }

    pub(super) fn print(&mut self, item: Captured) -> io::Result<()> {
        self.line.clear();
        match item {
            Captured::Skipped { at, length, cause } => self.skipped(at, length, cause),
            Captured::Frame { at, version, direction, id, payload, .. } => {
                let direction = self.direction.or(direction);
                let direction = direction.unwrap_or_else(|| Interpreter::likely_direction(id, payload.len()));
                let name = CommandId::from_raw(id).spec_name(direction);
                let head = Head { at, version, direction, id, name, payload: &payload };
                match (self.interpreter.interpret(Some(direction), id, &payload), self.output.is_json()) {
                    (Ok(message), true) => frame_json(&head, &message, &mut self.line),
                    (Ok(message), false) => frame_text(&head, &message, &mut self.line),
                    (Err(error), true) => undecoded_json(&head, &error, &mut self.line),
                    (Err(error), false) => undecoded_text(&head, &error, &mut self.line),
                }
            }
        }
        self.output.writer().write_all(self.line.as_bytes())
    }

    fn skipped(&mut self, at: u64, length: usize, cause: Cause) {
        let line = &mut self.line;
        if self.output.is_json() {
            line.push(r#"{"kind":"skipped","at":"#);
            line.integer(at);
            line.push(r#","length":"#);
            line.integer(length);
            line.push(r#","cause":"#);
            line.json_name(Some(cause.as_str()));
            line.push("}\n");
        } else {
            line.integer(at);
            line.push(": skipped ");
            line.integer(length);
            line.push(if length == 1 { " byte: " } else { " bytes: " });
            line.push(cause.as_str());
            line.push("\n");
        }
    }
}

/// A frame that was built from `message`, as JSON: like a decoded one, and with its bytes.
pub(super) fn built(frame: &[u8], version: Version, message: &Interpreted<'_>) -> Line {
    let mut decoder = Decoder::new(Versions::Both);
    let (mut id, mut payload) = (0, Vec::new());
    if let Some(Event::Frame { frame, .. }) = decoder.next(&mut &*frame) {
        (id, payload) = (frame.id, frame.payload.to_vec());
    }
    let (direction, name) = (message.direction(), message.name());
    let head = Head { at: 0, version: Some(version), direction, id, name, payload: &payload };
    let mut line = Line::default();
    frame_fields(&head, message, &mut line);
    line.push(r#","frame":""#);
    line.hex(frame);
    line.push("\"}\n");
    line
}

fn frame_json(head: &Head<'_>, message: &Interpreted<'_>, line: &mut Line) {
    frame_fields(head, message, line);
    line.push("}\n");
}

/// A frame as JSON, without the end.
fn frame_fields(head: &Head<'_>, message: &Interpreted<'_>, line: &mut Line) {
    head_json("frame", head, line);
    line.push(r#","form":"#);
    line.json_name(Some(message.form()));
    payload_json(head, line);
    line.push(r#","fields":["#);
    let mut separator = "";
    message.walk(&mut |leaf: &Leaf<'_>| {
        line.push(separator);
        fields::write_json(leaf, line);
        separator = ",";
    });
    line.push("]");
}

fn undecoded_json(head: &Head<'_>, error: &DecodeError, line: &mut Line) {
    head_json("undecoded", head, line);
    payload_json(head, line);
    line.push(r#","error":"#);
    line.json_text(&error.to_string());
    line.push("}\n");
}

fn head_json(kind: &str, head: &Head<'_>, line: &mut Line) {
    line.push(r#"{"kind":"#);
    line.json_name(Some(kind));
    line.push(r#","at":"#);
    line.integer(head.at);
    line.push(r#","version":"#);
    match head.version {
        Some(version) => line.integer(version.number()),
        None => line.push("null"),
    }
    line.push(r#","direction":"#);
    line.json_name(Some(head.direction.as_str()));
    line.push(r#","id":"#);
    line.integer(head.id);
    line.push(r#","name":"#);
    line.json_name(head.name);
}

fn payload_json(head: &Head<'_>, line: &mut Line) {
    line.push(r#","length":"#);
    line.integer(head.payload.len());
    line.push(r#","payload":""#);
    line.hex(head.payload);
    line.push("\"");
}

fn frame_text(head: &Head<'_>, message: &Interpreted<'_>, line: &mut Line) {
    head_text(head, line);
    line.push(", form ");
    line.push(message.form());
    length_text(head, line);
    message.walk(&mut |leaf: &Leaf<'_>| {
        line.push("    ");
        fields::write_text(leaf, line);
        line.push("\n");
    });
}

fn undecoded_text(head: &Head<'_>, error: &DecodeError, line: &mut Line) {
    head_text(head, line);
    line.push(", undecoded");
    length_text(head, line);
    line.push("    payload ");
    line.hex(head.payload);
    line.show(format_args!("\n    error: {error}\n"));
}

fn head_text(head: &Head<'_>, line: &mut Line) {
    line.integer(head.at);
    line.push(": ");
    line.push(head.name.unwrap_or("command"));
    line.push(" (");
    line.integer(head.id);
    line.push(") ");
    line.push(head.direction.as_str());
}

fn length_text(head: &Head<'_>, line: &mut Line) {
    line.push(", ");
    line.integer(head.payload.len());
    line.push(if head.payload.len() == 1 { " byte" } else { " bytes" });
    if let Some(version) = head.version {
        line.push(", version ");
        line.integer(version.number());
    }
    line.push("\n");
}
