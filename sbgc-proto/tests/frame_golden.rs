//! Frames whose bytes were not made by this crate.

use sbgc_proto::frame::{
    Cause, Decoder, Event, Frame, MAX_FRAME, Scan, Version, Versions, append, checksum, encode_into,
    encode_with, scan,
};

/// The rows of a golden file, cut into their trimmed columns.
fn rows(file: &'static str) -> Vec<Vec<&'static str>> {
    let rows = file.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let rows: Vec<Vec<_>> = rows.map(|line| line.split(';').map(str::trim).collect()).collect();
    assert!(!rows.is_empty());
    rows
}

fn hex(text: &str) -> Vec<u8> {
    text.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

struct Example {
    name: String,
    version: Version,
    id: u8,
    payload: Vec<u8>,
    wire: Vec<u8>,
}

/// All examples, once for each version.
fn examples() -> Vec<Example> {
    let mut examples = Vec::new();
    for row in rows(include_str!("golden/frames.hex")) {
        let [name, id, payload, v1, v2] = row[..] else { panic!("{row:?}") };
        for (version, wire) in [(Version::V1, v1), (Version::V2, v2)] {
            let (name, id) = (format!("{name} {version:?}"), id.parse().unwrap());
            examples.push(Example { name, version, id, payload: hex(payload), wire: hex(wire) });
        }
    }
    // The longest frame, by rule: payload byte i is i. Its CRC comes from the same C code.
    let payload: Vec<u8> = (0..255).collect();
    for (version, start, check) in [(Version::V1, 0x3E, &[0x81][..]), (Version::V2, 0x24, &[0x9C, 0xCB])] {
        let wire = [&[start, 41, 0xFF, 0x28], &payload[..], check].concat();
        let name = format!("max_payload {version:?}");
        examples.push(Example { name, version, id: 41, payload: payload.clone(), wire });
    }
    examples
}

/// All frames in `stream`, encoded again.
fn decode(stream: &[u8]) -> Vec<Vec<u8>> {
    let (mut decoder, mut rest, mut frames) = (Decoder::default(), stream, Vec::new());
    while let Some(event) = decoder.next(&mut rest) {
        if let Event::Frame { at, frame } = event {
            let wire = &stream[usize::try_from(at).unwrap()..][..frame.encoded_len()];
            frames.push(wire.to_vec());
        }
    }
    frames
}

#[test]
fn crc16_vectors() {
    for row in rows(include_str!("golden/crc16.hex")) {
        let [bytes, crc] = row[..] else { panic!("{row:?}") };
        assert_eq!(checksum::crc16(&hex(bytes)), u16::from_str_radix(crc, 16).unwrap(), "{bytes}");
    }
}

#[test]
fn decodes_the_examples() {
    for Example { name, version, id, payload, wire } in examples() {
        let frame = Frame { version, id, payload: &payload };
        assert_eq!(frame.encoded_len(), wire.len(), "{name}");
        let found = Scan::Frame { frame, used: wire.len() };
        assert_eq!(scan(&wire, Versions::Both), found, "{name}");
        assert_eq!(scan(&wire, Versions::Only(version)), found, "{name}");

        let (mut decoder, mut rest) = (Decoder::default(), &wire[..]);
        assert_eq!(decoder.next(&mut rest), Some(Event::Frame { at: 0, frame }), "{name}");
        assert_eq!(decoder.next(&mut rest), None, "{name}");
    }
}

#[test]
fn a_version_that_is_not_accepted_is_noise() {
    for Example { name, version, wire, .. } in examples() {
        let other = if version == Version::V1 { Version::V2 } else { Version::V1 };
        let (mut decoder, mut rest) = (Decoder::new(Versions::Only(other)), &wire[..]);
        while let Some(event) = decoder.next(&mut rest) {
            assert!(matches!(event, Event::Skipped(_)), "{name}");
        }
        while let Some(event) = decoder.finish() {
            assert!(matches!(event, Event::Skipped(_)), "{name}");
        }
        assert_eq!(decoder.counters().skipped(), wire.len() as u64, "{name}");
    }
}

#[test]
fn encodes_the_examples() {
    for Example { name, version, id, payload, wire } in examples() {
        let mut out = [0xAA; MAX_FRAME];
        assert_eq!(encode_into(version, id, &payload, &mut out).unwrap(), wire, "{name}");

        let mut out = [0xAA; MAX_FRAME];
        let written = encode_with(version, id, &mut out, |area| {
            area[..payload.len()].copy_from_slice(&payload);
            Ok::<_, sbgc_proto::frame::EncodeFrameError>(payload.len())
        });
        assert_eq!(written.unwrap(), wire, "{name}");

        let mut out = heapless::Vec::<u8, 300>::from_slice(&[1, 2]).unwrap();
        append(version, id, &payload, &mut out).unwrap();
        assert_eq!((&out[..2], &out[2..]), (&[1, 2][..], &wire[..]), "{name}");
    }
}

#[test]
fn judges_damaged_frames() {
    for row in rows(include_str!("golden/bad_frames.hex")) {
        let [name, verdict, bytes] = row[..] else { panic!("{row:?}") };
        let bytes = hex(bytes);
        match (verdict, scan(&bytes, Versions::Both)) {
            ("need_more", Scan::NeedMore { at_least }) => assert_eq!(at_least, bytes.len() + 1, "{name}"),
            (_, Scan::Skip { used: 1, cause }) => assert_eq!(cause.as_str(), verdict, "{name}"),
            (_, other) => panic!("{name}: {other:?}"),
        }
        assert_eq!(decode(&bytes), Vec::<Vec<u8>>::new(), "{name}");
    }
}

#[test]
fn gets_back_into_step() {
    for row in rows(include_str!("golden/resync.hex")) {
        let [name, stream, frames @ ..] = &row[..] else { panic!("{row:?}") };
        let frames: Vec<_> = frames.iter().map(|frame| hex(frame)).collect();
        assert_eq!(decode(&hex(stream)), frames, "{name}");
    }
}

#[test]
fn all_examples_in_one_stream() {
    let wires: Vec<_> = examples().into_iter().map(|example| example.wire).collect();
    assert_eq!(decode(&wires.concat()), wires);
    // A header whose checksum is wrong before each of them loses none.
    assert_eq!(decode(&wires.join(&[0x24, 0x3E, 0x24, 0, 0x3E][..])), wires);
}

#[test]
fn zero_filled_payload_behind_a_start_byte_is_no_frame() {
    // A version 1 frame with a damaged payload: 3E 00 00 00 00 in it would pass all checks but that of the id.
    let bytes = [&[0x3E, 0x20, 8, 0x28, 0x3E][..], &[0; 7], &[0x3F]].concat();
    let (mut decoder, mut rest, mut refused) = (Decoder::default(), &bytes[..], 0);
    while let Some(event) = decoder.next(&mut rest) {
        let Event::Skipped(skipped) = event else { panic!("{event:?}") };
        refused += usize::from(skipped.cause == Cause::HeaderChecksum);
    }
    assert_eq!(refused, 1);
}
