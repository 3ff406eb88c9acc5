//! How many instructions things take, counted by callgrind: the same numbers on every run, whatever else the machine
//! does.
//!
//! `benches/instructions.sh` runs this program once for each case; by itself it lists the cases.

use std::hint::black_box;

use sbgc_proto::commands::{Control, RealtimeData4};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, encode_into};
use sbgc_proto::units::{Angle, ControlRate};
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, IncomingCommand, Message};

/// About what a case works on.
const STREAM: usize = 16 * 1024;

/// What is counted: called once, and nothing else goes through it.
#[inline(never)]
fn measured(work: &mut dyn FnMut()) {
    work();
}

/// Payload bytes without order. About one in 128 is a start byte, as in any payload.
fn payload(length: usize) -> Vec<u8> {
    let mut state = 0x2545_F491_u32;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state.to_le_bytes()[0]
    };
    (0..length).map(|_| next()).collect()
}

fn frames(version: Version, length: usize) -> Vec<u8> {
    let mut out = [0; MAX_FRAME];
    let frame = encode_into(version, 25, &payload(length), &mut out).expect("the longest frame fits");
    frame.repeat(STREAM / frame.len())
}

fn chunks(stream: &[u8], size: usize) {
    let mut decoder = Decoder::default();
    for mut chunk in stream.chunks(size) {
        while let Some(event) = decoder.next(&mut chunk) {
            black_box(&event);
        }
    }
}

fn push(stream: &[u8]) {
    let mut decoder = Decoder::default();
    for &byte in stream {
        let mut next = decoder.push(byte);
        while let Some(event) = next {
            black_box(&event);
            next = decoder.more();
        }
    }
}

fn typed(stream: &[u8]) {
    let (mut decoder, mut rest) = (Decoder::default(), stream);
    while let Some(event) = decoder.next(&mut rest) {
        if let Event::Frame { frame, .. } = event {
            let _ = black_box(&IncomingCommand::from_frame(&frame));
        }
    }
}

type Case = (String, &'static str, usize, Box<dyn FnMut()>);

/// Name, unit, number of units, and the work.
fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for (name, version) in [("v1", Version::V1), ("v2", Version::V2)] {
        for length in [2, 124] {
            let stream = frames(version, length);
            let count = stream.len() / version.frame_len(length);
            for size in [1, 7, 64, 4096] {
                let stream = stream.clone();
                let case = format!("{name}/payload {length}/chunks of {size}");
                cases.push((case, "frame", count, Box::new(move || chunks(&stream, size))));
            }
            let bytes = stream.clone();
            cases.push((
                format!("{name}/payload {length}/push"),
                "byte",
                bytes.len(),
                Box::new(move || push(&bytes)),
            ));
            if length == 124 {
                cases.push((
                    format!("{name}/typed CMD_REALTIME_DATA_4"),
                    "frame",
                    count,
                    Box::new(move || typed(&stream)),
                ));
            }
        }
        let start = version.start_byte();
        let hostile = [start, 0x40, 0xFF, 0x3F].repeat(STREAM / 4);
        let bytes = hostile.clone();
        cases.push((
            format!("{name}/false headers"),
            "byte",
            hostile.len(),
            Box::new(move || chunks(&hostile, 4096)),
        ));
        cases.push((
            format!("{name}/false headers, push"),
            "byte",
            bytes.len(),
            Box::new(move || push(&bytes)),
        ));
        let starts = vec![start; STREAM];
        cases.push((
            format!("{name}/start bytes"),
            "byte",
            starts.len(),
            Box::new(move || chunks(&starts, 4096)),
        ));
        let noise = payload(STREAM);
        cases.push((format!("{name}/noise"), "byte", noise.len(), Box::new(move || chunks(&noise, 4096))));
        let control = Control::angles(PerAxis { pitch: Angle(100), ..PerAxis::default() }, ControlRate(500));
        let encode = move || {
            for _ in 0..100 {
                let _ = black_box(black_box(&control).encode_frame(version, &mut [0; 64]).map(<[u8]>::len));
            }
        };
        cases.push((format!("{name}/encode CMD_CONTROL"), "frame", 100, Box::new(encode)));
    }
    let bytes = payload(124);
    let decode = move || {
        for _ in 0..100 {
            let _ = black_box(&RealtimeData4::decode(black_box(&bytes)));
        }
    };
    cases.push(("decode CMD_REALTIME_DATA_4".to_owned(), "message", 100, Box::new(decode)));
    let find = || {
        for id in 0..=255 {
            let _ = black_box(CommandId::from_raw(black_box(id)));
        }
    };
    cases.push(("find a command".to_owned(), "id", 256, Box::new(find)));
    cases
}

fn main() {
    let wanted = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    for (name, unit, count, mut work) in cases() {
        match &wanted {
            Some(wanted) if *wanted == name => measured(&mut *work),
            Some(_) => {}
            None => println!("{count}\t{unit}\t{name}"),
        }
    }
}
