//! From frames to typed messages and back: small and large ones, in both versions.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use sbgc_proto::commands::{Angles, Confirm, Params3, RealtimeData4};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, MAX_PAYLOAD, Version, Versions};
use sbgc_proto::wire::{FromWire, ToWire};
use sbgc_proto::{IncomingCommand, Message};

/// A payload of `length` bytes in which no two neighbours are alike.
fn payload(length: usize) -> Vec<u8> {
    (0..length).map(|index| u8::try_from(index * 37 % 251).unwrap_or_default()).collect()
}

/// A stream of frames of one message.
fn stream<M: Message>(version: Version, frames: usize) -> Vec<u8> {
    let mut frame = [0; MAX_FRAME];
    let payload = payload(*M::SIZE.start());
    let frame = sbgc_proto::frame::encode_into(version, M::ID.raw(), &payload, &mut frame).expect("it fits");
    frame.repeat(frames)
}

/// Frames of `M` are found in a stream, and each is read as a message of its type, or as whatever its id says.
fn decode<M: Message + for<'a> FromWire<'a>>(criterion: &mut Criterion) {
    const FRAMES: usize = 256;
    let mut group = criterion.benchmark_group(format!("decode/{}", M::SPEC));
    for version in [Version::V1, Version::V2] {
        let stream = stream::<M>(version, FRAMES);
        group.throughput(Throughput::Elements(FRAMES as u64));
        let parameter = format!("v{}", version.number());
        group.bench_with_input(BenchmarkId::new("typed", &parameter), &stream, |bencher, stream| {
            bencher.iter(|| {
                let mut decoder = Decoder::new(Versions::Both);
                let mut input = &stream[..];
                while let Some(event) = decoder.next(&mut input) {
                    if let Event::Frame { frame, .. } = event {
                        black_box(M::decode(frame.payload)).expect("it is whole");
                    }
                }
            });
        });
        group.bench_with_input(BenchmarkId::new("any command", &parameter), &stream, |bencher, stream| {
            bencher.iter(|| {
                let mut decoder = Decoder::new(Versions::Both);
                let mut input = &stream[..];
                while let Some(event) = decoder.next(&mut input) {
                    if let Event::Frame { frame, .. } = event {
                        black_box(IncomingCommand::from_frame(&frame)).expect("it is whole");
                    }
                }
            });
        });
    }
    group.finish();
}

/// A message is written as a frame.
fn encode<M: Message + for<'a> FromWire<'a> + ToWire>(criterion: &mut Criterion) {
    let bytes = payload(MAX_PAYLOAD);
    let message = M::decode(&bytes[..*M::SIZE.start()]).expect("it is whole");
    let mut group = criterion.benchmark_group(format!("encode/{}", M::SPEC));
    group.throughput(Throughput::Elements(1));
    for version in [Version::V1, Version::V2] {
        let mut frame = [0; MAX_FRAME];
        group.bench_function(format!("v{}", version.number()), |bencher| {
            bencher.iter(|| black_box(&message).encode_frame(version, &mut frame).expect("it fits").len());
        });
    }
    group.finish();
}

criterion_group!(
    benches,
    decode::<Confirm>,
    decode::<Angles>,
    decode::<RealtimeData4>,
    decode::<Params3>,
    encode::<Confirm>,
    encode::<Angles>,
    encode::<RealtimeData4>,
    encode::<Params3>,
);
criterion_main!(benches);
