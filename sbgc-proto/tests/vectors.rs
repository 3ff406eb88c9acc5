//! Example frames with the value of every field: each is decoded, compared field by field, and encoded again to the
//! same bytes.
//!
//! The frames in `protocol/vectors.jsonl` were made from the layouts by a program that shares no code with this crate.
//! What is bytes there may be several fields here, where newer firmware has divided it, and a text is one field here
//! and two there.

use std::ops::Range;

use sbgc_proto::commands::{CanDrvTelemetryFlags, DebugVarKind, DebugVarValue};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, Versions};
use sbgc_proto::reflect::{self, Leaf, Raw};
use sbgc_proto::{CommandId, IncomingCommand, Message, OutgoingCommand};
use serde_json::Value;

#[test]
fn examples_decode_to_their_fields_and_back() {
    let mut complaints = Vec::new();
    let mut untyped = Vec::new();
    for (index, line) in include_str!("protocol/vectors.jsonl").lines().enumerate() {
        let example = Example::new(&serde_json::from_str(line).unwrap());
        match example.check() {
            Ok(()) => {}
            Err(Fault::Untyped) => untyped.push((example.id, example.incoming)),
            Err(Fault::Wrong(what)) => {
                let id = CommandId::from_raw(example.id);
                complaints.extend(what.iter().map(|what| format!("line {}, {id:?}: {what}", index + 1)));
            }
        }
    }
    untyped.sort_unstable();
    untyped.dedup();
    if !untyped.is_empty() {
        complaints.push(format!("not typed, (id, incoming): {untyped:?}"));
    }
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
}

enum Fault {
    /// The command has no type.
    Untyped,
    Wrong(Vec<String>),
}

struct Example {
    id: u8,
    incoming: bool,
    version: Version,
    frame: Vec<u8>,
    payload: Vec<u8>,
    fields: Vec<Part>,
    /// What the request selected, where the payload can be read only with that in mind.
    selection: Option<u32>,
    /// The types of debug variables.
    kinds: Vec<DebugVarKind>,
}

/// A field of an example, or a leaf of a message.
#[derive(Clone, Debug)]
struct Part {
    name: String,
    bytes: Range<usize>,
    kind: String,
    /// What it holds; of a float, the bits.
    number: Option<i64>,
}

impl Example {
    fn new(value: &Value) -> Self {
        let number = |key: &str| value[key].as_u64().unwrap();
        let fields = value["fields"].as_array().unwrap();
        Example {
            id: number("cmd_id").try_into().unwrap(),
            incoming: value["direction"] == "incoming",
            version: if number("version") == 1 { Version::V1 } else { Version::V2 },
            frame: from_hex(&value["frame"]),
            payload: from_hex(&value["payload"]),
            fields: fields.iter().map(Part::of_example).filter(|part| !part.bytes.is_empty()).collect(),
            selection: value["context"]["request_flags"].as_u64().map(|flags| flags.try_into().unwrap()),
            kinds: (value["context"]["var_types"].as_array().into_iter().flatten())
                .map(|kind| DebugVarKind(kind.as_u64().unwrap().try_into().unwrap()))
                .collect(),
        }
    }

    fn check(&self) -> Result<(), Fault> {
        let mut decoder = Decoder::new(Versions::Both);
        let mut chunk = &self.frame[..];
        let Some(Event::Frame { frame, .. }) = decoder.next(&mut chunk) else {
            return Err(Fault::Wrong(vec!["the frame is not one".into()]));
        };
        assert_eq!((frame.version, frame.id, frame.payload), (self.version, self.id, &self.payload[..]));

        let mut leaves = Vec::new();
        let mut visitor = |leaf: &Leaf<'_>| leaves.push(Part::of_message(leaf));
        let mut out = [0; MAX_FRAME];
        let mut wrong = Vec::new();
        let encoded = if self.incoming {
            let (message, rest) = IncomingCommand::from_frame(&frame).map_err(|error| broken(&error))?;
            if matches!(message, IncomingCommand::Unknown { .. }) {
                return Err(Fault::Untyped);
            }
            wrong.extend(surplus(rest));
            match (&message, self.selection) {
                (IncomingCommand::CanDrvTelemetryView(view), Some(selection)) => {
                    let selection = CanDrvTelemetryFlags::from_bits_retain(selection);
                    let typed = view.decode_as(selection).map_err(|error| broken(&error))?;
                    reflect::walk(&typed, &mut visitor);
                    let payload = typed.encode_with(selection, &mut out).map(<[u8]>::to_vec);
                    if payload.as_ref() != Ok(&self.payload) {
                        wrong.push(format!("encodes with its selection to {payload:02x?}"));
                    }
                }
                (IncomingCommand::DebugVars3(values), _) => {
                    let values: Result<Vec<_>, _> = values.values(self.kinds.iter().copied()).collect();
                    leaves = Part::of_variables(&values.map_err(|error| broken(&error))?);
                }
                _ => {
                    message.walk(&mut visitor);
                }
            }
            message.encode_frame(self.version, &mut out).map(<[u8]>::to_vec)
        } else {
            let (message, rest) = OutgoingCommand::from_frame(&frame).map_err(|error| broken(&error))?;
            if matches!(message, OutgoingCommand::Unknown { .. }) {
                return Err(Fault::Untyped);
            }
            wrong.extend(surplus(rest));
            message.walk(&mut visitor);
            message.encode_frame(self.version, &mut out).map(<[u8]>::to_vec)
        };
        match encoded {
            Ok(bytes) if bytes == self.frame => {}
            Ok(bytes) => wrong.push(format!("encodes to {bytes:02x?} instead of {:02x?}", self.frame)),
            Err(error) => wrong.push(format!("does not encode: {error}")),
        }
        leaves.retain(|leaf| !leaf.bytes.is_empty());
        wrong.extend(self.compare(&leaves));
        if wrong.is_empty() { Ok(()) } else { Err(Fault::Wrong(wrong)) }
    }

    /// Compares each field with the leaves that share bytes with it.
    fn compare(&self, leaves: &[Part]) -> Vec<String> {
        let mut wrong = Vec::new();
        let mut fields = &self.fields[..];
        let mut leaves = leaves;
        while let Some(first) = fields.first() {
            // Some examples leave fields out.
            let skipped = leaves.iter().take_while(|leaf| leaf.bytes.end <= first.bytes.start).count();
            leaves = &leaves[skipped..];
            // The fewest fields and leaves that end together.
            let (mut end, mut own, mut theirs) = (first.bytes.end, 0, 1);
            loop {
                while leaves.get(own).is_some_and(|leaf| leaf.bytes.start < end) {
                    own += 1;
                    end = end.max(leaves[own - 1].bytes.end);
                }
                match fields.get(theirs) {
                    Some(field) if field.bytes.start < end => {
                        end = end.max(field.bytes.end);
                        theirs += 1;
                    }
                    _ => break,
                }
            }
            wrong.extend(difference(&fields[..theirs], &leaves[..own]));
            (fields, leaves) = (&fields[theirs..], &leaves[own..]);
        }
        wrong
    }
}

impl Part {
    fn of_example(field: &Value) -> Self {
        let number = |key: &str| usize::try_from(field[key].as_u64().unwrap()).unwrap();
        let kind = field["type"].as_str().unwrap();
        Part {
            name: field["field"].as_str().unwrap_or_default().to_owned(),
            bytes: number("offset")..number("offset") + number("size"),
            kind: kind.to_owned(),
            #[allow(
                clippy::cast_possible_truncation,
                reason = "the examples give floats of 32 bits as decimals"
            )]
            number: match kind {
                "f32" => field["raw"].as_f64().map(|value| (value as f32).to_bits().into()),
                _ => field["raw"].as_i64(),
            },
        }
    }

    /// The values of debug variables, which stand one after the other.
    fn of_variables(values: &[DebugVarValue]) -> Vec<Self> {
        let mut at = 0;
        let part = |value: &DebugVarValue| {
            let (kind, size, number) = match *value {
                DebugVarValue::U8(value) => ("u8", 1, value.into()),
                DebugVarValue::I8(value) => ("i8", 1, value.into()),
                DebugVarValue::U16(value) => ("u16", 2, value.into()),
                DebugVarValue::I16(value) => ("i16", 2, value.into()),
                DebugVarValue::U32(value) => ("u32", 4, value.into()),
                DebugVarValue::I32(value) => ("i32", 4, value.into()),
                DebugVarValue::F32(value) => ("f32", 4, value.get().to_bits().into()),
            };
            at += size;
            Part { name: "value".into(), bytes: at - size..at, kind: kind.into(), number: Some(number) }
        };
        values.iter().map(part).collect()
    }

    fn of_message(leaf: &Leaf<'_>) -> Self {
        Part {
            name: leaf.path.to_string(),
            bytes: leaf.offset..leaf.offset + leaf.size,
            kind: leaf.type_name().to_owned(),
            number: match leaf.raw {
                Raw::Number(number) => Some(number),
                Raw::Bytes(_) | Raw::Text(_) => None,
            },
        }
    }
}

/// What differs between fields of an example and leaves of a message that take the same bytes.
fn difference(fields: &[Part], leaves: &[Part]) -> Option<String> {
    let same_bytes = fields.first().zip(leaves.first()).is_some_and(|(field, leaf)| {
        field.bytes.start == leaf.bytes.start
            && fields.last().map(|field| field.bytes.end) == leaves.last().map(|leaf| leaf.bytes.end)
    });
    let alike = match (fields, leaves) {
        ([field], [leaf]) if field.kind != "bytes" && leaf.kind != "str" => {
            (&field.kind, field.number) == (&leaf.kind, leaf.number)
        }
        ([field], _) if field.kind == "bytes" => true,
        // A length byte and what it counts.
        ([length, ..], [leaf]) => leaf.kind == "str" && length.kind == "u8",
        _ => false,
    };
    (!same_bytes || !alike).then(|| format!("expected {}; got {}", shown(fields), shown(leaves)))
}

fn shown(parts: &[Part]) -> String {
    let shown = |part: &Part| {
        let number = part.number.map_or_else(String::new, |number| format!(" = {number}"));
        format!("{}@{}+{} {}{number}", part.name, part.bytes.start, part.bytes.len(), part.kind)
    };
    if parts.is_empty() { "nothing".into() } else { parts.iter().map(shown).collect::<Vec<_>>().join(", ") }
}

fn surplus(rest: &[u8]) -> Option<String> {
    (!rest.is_empty()).then(|| format!("{} bytes are left over", rest.len()))
}

fn broken(error: &sbgc_proto::DecodeError) -> Fault {
    Fault::Wrong(vec![format!("does not decode: {error}")])
}

fn from_hex(value: &Value) -> Vec<u8> {
    let hex = value.as_str().unwrap();
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}
