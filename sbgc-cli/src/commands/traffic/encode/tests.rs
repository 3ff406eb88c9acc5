//! What `decode` prints, `encode` takes, and makes the same frame of it.

use proptest::prelude::*;
use sbgc_proto::frame::{Decoder, Event, Frame, Versions, encode_into};
use sbgc_proto::reflect::{Leaf, Visitor};
use serde_json::Value;

use super::*;
use crate::fields;
use crate::line::Line;

/// Example frames of all commands, made independently of this program.
const VECTORS: &str = include_str!("../../../../../sbgc-proto/tests/protocol/vectors.jsonl");

/// How a field is printed.
#[derive(Clone, Copy, Debug)]
enum Print {
    Json,
    Text,
}

/// The path of a field and its value as it is printed.
fn printed(leaf: &Leaf<'_>, print: Print) -> (String, String) {
    match print {
        Print::Json => {
            let mut line = Line::default();
            fields::write_json(leaf, &mut line);
            let json: Value = serde_json::from_slice(line.as_bytes()).unwrap();
            let value = if json["value"].is_null() { &json["raw"] } else { &json["value"] };
            let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            (json["path"].as_str().unwrap().to_owned(), value)
        }
        Print::Text => {
            let mut line = Line::default();
            fields::write_text(leaf, &mut line);
            let text = line.into_text();
            let (path, value) = text.split_once(" = ").unwrap();
            (path.to_owned(), value.to_owned())
        }
    }
}

/// The arguments that give `payload` back; `None` for one that is longer or shorter than what is known.
fn arguments(direction: Direction, id: u8, payload: &[u8], print: Print) -> Option<Encode> {
    let id = CommandId::from_raw(id);
    let mut fields = Vec::new();
    let visitor: &mut dyn Visitor = &mut |leaf: &Leaf<'_>| fields.push(printed(leaf, print));
    let (name, form, way) = match direction {
        Direction::Outgoing => {
            let (message, rest) = OutgoingCommand::decode(id, payload).ok()?;
            message.walk(visitor);
            (message.spec_name().filter(|_| rest.is_empty())?, message.form(), Way::Outgoing)
        }
        Direction::Incoming => {
            let (message, rest) = IncomingCommand::decode(id, payload).ok()?;
            message.walk(visitor);
            (message.spec_name().filter(|_| rest.is_empty())?, message.form(), Way::Incoming)
        }
    };
    Some(Encode { name: name.to_owned(), fields, direction: way, form: Some(form.to_owned()) })
}

fn check(direction: Direction, frame: Frame<'_>, bytes: &[u8]) {
    for print in [Print::Json, Print::Text] {
        let encode = arguments(direction, frame.id, frame.payload, print).unwrap();
        let encoded = encode.encode(frame.version).unwrap_or_else(|error| panic!("{encode:?}: {error}"));
        assert_eq!(encoded.frame, bytes, "{print:?} {encode:?}");
    }
}

#[test]
fn every_example_comes_back_from_what_is_printed() {
    let mut checked = 0;
    for line in VECTORS.lines() {
        let example: Value = serde_json::from_str(line).unwrap();
        let direction = match example["direction"].as_str() {
            Some("incoming") => Direction::Incoming,
            _ => Direction::Outgoing,
        };
        let bytes = hex::decode(example["frame"].as_str().unwrap()).unwrap();
        let mut decoder = Decoder::new(Versions::Both);
        match decoder.next(&mut &bytes[..]) {
            Some(Event::Frame { frame, .. }) => check(direction, frame, &bytes),
            other => panic!("{other:?}"),
        }
        checked += 1;
    }
    assert!(checked > 400);
}

/// Bytes with the values at which mistakes show: ends of ranges, NaNs, quotes, hex digits, bytes that are not text.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![
        3 => any::<u8>(),
        2 => prop::sample::select(vec![0, 1, 2, 3, 7, 0x7F, 0x80, 0xFE, 0xFF]),
        2 => prop::sample::select(b"\"\\'A0 xz\n()=-".to_vec()),
    ];
    prop::collection::vec(byte, 255)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_form_comes_back_from_what_is_printed(bytes in bytes(), choice in any::<prop::sample::Index>()) {
        for info in OutgoingCommand::ALL.iter().chain(IncomingCommand::ALL) {
            let lengths: Vec<usize> = info.size.clone().filter(|length| (info.accepts)(*length)).collect();
            let mut frame = [0; MAX_FRAME];
            for length in [lengths[0], *choice.get(&lengths), lengths[lengths.len() - 1]] {
                let payload = &bytes[..length];
                if arguments(info.direction, info.id.raw(), payload, Print::Text).is_none() {
                    continue;
                }
                let whole = encode_into(Version::V2, info.id.raw(), payload, &mut frame).unwrap();
                check(info.direction, Frame { version: Version::V2, id: info.id.raw(), payload }, whole);
            }
        }
    }
}

#[test]
fn a_number_is_no_name_even_where_values_are_called_so() {
    let encoded = |value: &str| {
        let encode = Encode {
            name: "CMD_WRITE_PARAMS_EXT3".to_owned(),
            fields: vec![("encoder_cfg_ext.pitch".to_owned(), value.to_owned())],
            direction: Way::Outgoing,
            form: None,
        };
        let frame = encode.encode(Version::V2).unwrap().frame;
        u16::from_le_bytes([frame[4 + 137], frame[4 + 138]])
    };
    assert_eq!(encoded("24"), 24);
    assert_eq!(encoded("MULTI_TURN=24"), 4 << 5);
}

#[test]
fn every_form_is_tried() {
    // The strategy above skips what cannot be read; zeros and ones can be, at some length of every form.
    for info in OutgoingCommand::ALL.iter().chain(IncomingCommand::ALL) {
        let readable = |byte: u8| {
            info.size.clone().any(|length| {
                arguments(info.direction, info.id.raw(), &vec![byte; length], Print::Json)
                    .is_some_and(|encode| encode.form.as_deref() == Some(info.form))
            })
        };
        assert!([0, 1, 2].into_iter().any(readable), "{} {}", info.spec, info.form);
    }
}

fn encode(name: &str, fields: &[&str]) -> Result<Encoded, String> {
    let fields = fields.iter().map(|field| assignment(field).unwrap()).collect();
    let encode = Encode { name: name.to_owned(), fields, direction: Way::Outgoing, form: None };
    encode.encode(Version::V1).map_err(|failure| failure.to_string())
}

#[test]
fn values_beyond_their_documented_range_are_taken_with_a_warning() {
    let Encoded { frame, warnings, .. } =
        encode("BEEP_SOUND", &["decay_factor=15"]).unwrap_or_else(|error| panic!("{error}"));
    assert!(!frame.is_empty() && warnings.is_empty(), "{warnings:?}");
    let Encoded { warnings, .. } = encode("I2C_READ_REG_BUF", &["data_len=0"]).unwrap();
    assert_eq!(warnings, ["data_len=0: out of range; expected 1 to 255 byte"]);
    assert!(encode("I2C_READ_REG_BUF", &["data_len=256"]).is_err(), "the wire cannot hold it");
}

#[test]
fn versions_are_taken_as_they_are_shown() {
    let version = |text: &str| {
        let fields = vec![(String::from("firmware_ver"), text.to_owned())];
        let encode =
            Encode { name: String::from("BOARD_INFO"), fields, direction: Way::Incoming, form: None };
        encode.encode(Version::V1).map(|encoded| u16::from_le_bytes([encoded.frame[5], encoded.frame[6]]))
    };
    for (text, raw) in
        [("2.73", 2730), ("2.73.5", 2735), ("2.68b7", 2687), ("2735", 2735), ("2.73.5 (2735)", 2735)]
    {
        assert_eq!(version(text).unwrap(), raw, "{text}");
    }
    for text in ["2.7x", "2.73.5.1", "2.73.5 (2734)", "70.00", "1.5e1"] {
        assert!(version(text).is_err(), "{text}");
    }
}

#[test]
fn one_name_of_a_bit_field_says_all() {
    let by_name = encode("CONTROL", &["control_mode.roll=MODE_ANGLE"]).unwrap().frame;
    let by_part = encode("CONTROL", &["control_mode.roll=CONTROL_MODE=MODE_ANGLE"]).unwrap().frame;
    assert_eq!(by_name, by_part);
    assert!(encode("CONTROL", &["control_mode.roll=MODE_ANGLE|MODE_SPEED"]).is_err());
}

#[test]
fn commands_that_the_protocol_does_not_have_are_made_of_bytes() {
    let encoded = encode("200", &["payload=05"]).unwrap();
    assert_eq!(encoded.frame, [0x3E, 0xC8, 0x01, 0xC9, 0x05, 0x05]);
    let json: Value = serde_json::from_slice(encoded.json.as_bytes()).unwrap();
    assert_eq!((&json["name"], &json["form"], &json["id"]), (&Value::Null, &"unknown".into(), &200.into()));
    assert_eq!(
        encode("82", &["profile_id=1"]).unwrap().frame,
        encode("READ_PARAMS", &["profile_id=1"]).unwrap().frame
    );
}
