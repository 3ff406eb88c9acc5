//! How fast bytes become frames and frames become bytes.
//!
//! `cargo bench -p sbgc-benches --bench framing`

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, encode_into};

/// About as much as a link at 115200 baud carries in six seconds.
const STREAM: usize = 64 * 1024;
/// What one USB full-speed packet holds.
const PACKET: usize = 64;
/// A small answer, a block of parameters, the longest there is.
const PAYLOADS: [usize; 3] = [3, 134, 255];
const VERSIONS: [(&str, Version); 2] = [("v1", Version::V1), ("v2", Version::V2)];

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

/// Frames around `length` bytes, back to back, with `noise` before each; and how many they are.
fn stream(version: Version, length: usize, noise: &[u8]) -> (Vec<u8>, usize) {
    let payload = payload(length);
    let mut out = [0; MAX_FRAME];
    let frame = encode_into(version, 25, &payload, &mut out).expect("the longest frame fits");
    let piece = [noise, frame].concat();
    let count = STREAM / piece.len();
    (piece.repeat(count), count)
}

/// Decodes `stream` in chunks of `size` and says how many frames there were.
fn decode(stream: &[u8], size: usize) -> usize {
    let (mut decoder, mut frames) = (Decoder::default(), 0);
    for mut chunk in stream.chunks(size) {
        while let Some(event) = decoder.next(&mut chunk) {
            // By reference: a copy of the event would be measured too.
            if let Event::Frame { frame, .. } = black_box(&event) {
                frames += usize::from(frame.id > 0);
            }
        }
    }
    frames
}

/// The same byte by byte, as an interrupt brings them.
fn push(stream: &[u8]) -> usize {
    let (mut decoder, mut frames) = (Decoder::default(), 0);
    for &byte in stream {
        let mut next = decoder.push(byte);
        while let Some(event) = next {
            if let Event::Frame { frame, .. } = black_box(&event) {
                frames += usize::from(frame.id > 0);
            }
            next = decoder.more();
        }
    }
    frames
}

fn bench_decode(c: &mut Criterion) {
    let mut group = c.benchmark_group("decode");
    let mut run = |name: String, (stream, frames): &(Vec<u8>, usize), size: usize| {
        assert_eq!(decode(stream, size), *frames, "{name}");
        group.throughput(Throughput::Bytes(stream.len() as u64));
        group.bench_function(name, |b| b.iter(|| decode(black_box(stream), size)));
    };
    for (name, version) in VERSIONS {
        for length in PAYLOADS {
            let clean = stream(version, length, &[]);
            run(format!("{name}/{length}/whole"), &clean, STREAM);
            run(format!("{name}/{length}/packets"), &clean, PACKET);
            for size in [1, 7, 4096] {
                run(format!("{name}/{length}/chunks of {size}"), &clean, size);
            }
        }
        // As many bytes of noise as of frame, among them start bytes.
        run(format!("{name}/134/noise"), &stream(version, 134, &payload(140)), STREAM);
        // Nearly every byte starts a candidate that is refused by its header.
        run(format!("{name}/3/starts"), &stream(version, 3, &[version.start_byte(); 100]), STREAM);
    }
    for (name, version) in VERSIONS {
        for length in PAYLOADS {
            let (stream, frames) = stream(version, length, &[]);
            assert_eq!(push(&stream), frames, "{name}");
            group.throughput(Throughput::Bytes(stream.len() as u64));
            group.bench_function(format!("{name}/{length}/push"), |b| b.iter(|| push(black_box(&stream))));
        }
    }
    group.finish();
}

/// A dear stream: each start byte announces a long frame that only its check refuses.
fn bench_decode_hostile(c: &mut Criterion) {
    let mut group = c.benchmark_group("decode_hostile");
    for (name, version) in VERSIONS {
        let stream: Vec<u8> = [version.start_byte(), 0x40, 0xFF, 0x3F].repeat(STREAM / 4);
        assert_eq!(decode(&stream, STREAM), 0, "{name}");
        group.throughput(Throughput::Bytes(stream.len() as u64));
        for (cut, size) in [("whole", STREAM), ("packets", PACKET), ("bytes", 1)] {
            group.bench_function(format!("{name}/{cut}"), |b| b.iter(|| decode(black_box(&stream), size)));
        }
    }
    group.finish();
}

fn bench_encode(c: &mut Criterion) {
    let mut group = c.benchmark_group("encode");
    for (name, version) in VERSIONS {
        for length in PAYLOADS {
            let (payload, mut out) = (payload(length), [0; MAX_FRAME]);
            group.throughput(Throughput::Bytes(version.frame_len(length) as u64));
            group.bench_function(format!("{name}/{length}"), |b| {
                b.iter(|| {
                    encode_into(version, black_box(25), black_box(&payload), &mut out).map(<[u8]>::len)
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, bench_decode, bench_decode_hostile, bench_encode);
criterion_main!(benches);
