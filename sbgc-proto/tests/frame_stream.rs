//! Streams of frames and noise, cut into chunks in every way.

mod slow_decoder;

use proptest::collection::vec;
use proptest::prelude::*;
use sbgc_proto::frame::{
    Cause, Decoder, Event, MAX_FRAME, Scan, Skipped, Version, Versions, encode_into, scan,
};

use slow_decoder::{Seen, push};

/// The whole stream by `scan` alone.
fn one_shot(stream: &[u8], versions: Versions) -> Vec<Seen> {
    let (mut seen, mut at) = (Vec::new(), 0);
    while at < stream.len() {
        let skipped = |length, cause| Event::Skipped(Skipped { at: at as u64, length, cause });
        let (event, used) = match scan(&stream[at..], versions) {
            Scan::Frame { frame, used } => (Event::Frame { at: at as u64, frame }, used),
            Scan::Skip { used, cause } => (skipped(used, cause), used),
            Scan::NeedMore { at_least } => {
                assert!(at_least > stream.len() - at && at_least <= MAX_FRAME);
                (skipped(1, Cause::Truncated), 1)
            }
        };
        push(&mut seen, event);
        at += used;
    }
    seen
}

/// Feeds a decoder and checks after each step what must always hold.
struct Feed {
    decoder: Decoder,
    fed: u64,
    seen: Vec<Seen>,
}

impl Feed {
    fn new(versions: Versions) -> Self {
        Self { decoder: Decoder::new(versions), fed: 0, seen: Vec::new() }
    }

    /// As [`chunk`](Self::chunk), where something may be told of bytes before it.
    fn chunk_behind_bytes(&mut self, chunk: &[u8]) {
        while let Some(event) = self.decoder.more().map(Seen::from) {
            self.seen_next(Some(event));
        }
        self.chunk(chunk);
    }

    fn chunk(&mut self, chunk: &[u8]) {
        let start = self.fed;
        let mut rest = chunk;
        loop {
            let before = self.decoder.position();
            let event = self.decoder.next(&mut rest);
            let ended = event.is_none();
            if let Some(event) = event {
                if let Event::Frame { at, frame } = event {
                    let lent = chunk.as_ptr_range().contains(&frame.payload.as_ptr());
                    assert_eq!(lent, at >= start, "a frame is lent from the chunk if it lies whole in it");
                }
                push(&mut self.seen, event);
            }
            self.fed = start + (chunk.len() - rest.len()) as u64;
            self.check();
            if ended {
                break;
            }
            assert!(self.decoder.position() > before, "no progress");
        }
        assert_eq!(rest, []);
        assert!(self.decoder.pending() < MAX_FRAME);
    }

    /// As an interrupt does it: every byte by itself, and what else can be told asked for at once or not.
    fn bytes(&mut self, bytes: &[u8], ask: bool) {
        for &byte in bytes {
            let (pending, at) = (self.decoder.pending(), self.decoder.position());
            let event = self.decoder.push(byte).map(Seen::from);
            self.fed += 1;
            let mut told = event.is_some();
            self.seen_next(event);
            if !ask && told {
                continue;
            }
            while told {
                let event = self.decoder.more().map(Seen::from);
                told = event.is_some();
                self.seen_next(event);
            }
            // A byte that only is put to others changes nothing else.
            if self.decoder.position() == at {
                assert_eq!(self.decoder.pending(), pending + 1);
            }
            assert!(self.decoder.pending() < MAX_FRAME);
        }
    }

    fn seen_next(&mut self, event: Option<Seen>) {
        if let Some(event) = event {
            push(&mut self.seen, event);
        }
        self.check();
    }

    fn finish(mut self) -> Vec<Seen> {
        while let Some(event) = self.decoder.finish() {
            push(&mut self.seen, event);
            self.check();
        }
        assert_eq!((self.decoder.pending(), self.decoder.position()), (0, self.fed));
        self.seen
    }

    fn check(&self) {
        let (decoder, counters) = (&self.decoder, self.decoder.counters());
        assert_eq!(counters.bytes() + decoder.pending() as u64, self.fed);
        assert_eq!(decoder.position(), self.seen.iter().map(Seen::length).sum::<u64>());
        let frames = self.seen.iter().filter(|seen| matches!(seen, Seen::Frame { .. })).count();
        assert_eq!(counters.frames, frames as u64);
        for cause in Cause::ALL {
            let skipped = self.seen.iter().map(|seen| match seen {
                Seen::Skipped(skipped) if skipped.cause == cause => skipped.length as u64,
                _ => 0,
            });
            assert_eq!(counters.skipped_for(cause), skipped.sum::<u64>());
        }
    }
}

fn chunked<'a>(chunks: impl IntoIterator<Item = &'a [u8]>, versions: Versions) -> Vec<Seen> {
    let mut feed = Feed::new(versions);
    for chunk in chunks {
        feed.chunk(chunk);
    }
    feed.finish()
}

fn pushed(stream: &[u8], versions: Versions, ask: bool) -> Vec<Seen> {
    let mut feed = Feed::new(versions);
    feed.bytes(stream, ask);
    feed.finish()
}

/// Whether `bytes` starts with an intact frame, by a second way of looking at it.
fn starts_with_frame(bytes: &[u8], versions: Versions) -> bool {
    let (Some(&start), Some(&size)) = (bytes.first(), bytes.get(2)) else { return false };
    let Some(version) = Version::from_start_byte(start).filter(|&version| versions.accepts(version)) else {
        return false;
    };
    let Some(frame) = bytes.get(..version.frame_len(size.into())) else { return false };
    let payload = &frame[4..4 + usize::from(size)];
    let mut encoded = [0; MAX_FRAME];
    encode_into(version, frame[1], payload, &mut encoded).is_ok_and(|encoded| encoded == frame)
}

fn encode(version: Version, id: u8, payload: &[u8]) -> Vec<u8> {
    encode_into(version, id, payload, &mut [0; MAX_FRAME]).unwrap().to_vec()
}

/// A header that announces `size` bytes.
fn header(version: Version, id: u8, size: u8) -> Vec<u8> {
    vec![version.start_byte(), id, size, id.wrapping_add(size)]
}

fn frames(seen: &[Seen]) -> Vec<Vec<u8>> {
    let frame = |seen: &Seen| match seen {
        Seen::Frame { version, id, payload, .. } => Some(encode(*version, *id, payload)),
        Seen::Skipped(_) => None,
    };
    seen.iter().filter_map(frame).collect()
}

/// One of everything that is hard: frames back to back, noise, frames inside broken frames, false starts of
/// full length, a cut end.
fn hard_stream() -> Vec<u8> {
    let (v1, v2) = (encode(Version::V1, 82, &[1]), encode(Version::V2, 110, b"\x04>$>$"));
    let mut broken = encode(Version::V2, 33, &[&v1[..], &v2, &v1].concat());
    *broken.last_mut().unwrap() ^= 1;
    let mut nested = encode(Version::V1, 33, &[&b">$"[..], &broken, &header(Version::V2, 9, 60)].concat());
    *nested.last_mut().unwrap() ^= 1;
    [
        &b"noise"[..],
        &v1,
        &v2,
        b">>$$>\0$\0\0\0>>>",
        &broken,
        &v1,
        &header(Version::V1, 7, 255),
        &v2,
        &[b'>'; 40],
        &nested,
        &header(Version::V2, 7, 255),
        &[0; 300],
        &encode(Version::V2, 41, &[0x3E; 255]),
        &v2,
        &header(Version::V1, 7, 200),
        &v1,
        &v2[..6],
    ]
    .concat()
}

#[test]
fn every_split_point() {
    let stream = hard_stream();
    let expected = one_shot(&stream, Versions::Both);
    assert_eq!(frames(&expected).len(), 13);
    for split in 0..=stream.len() {
        let (head, tail) = stream.split_at(split);
        assert_eq!(chunked([head, tail], Versions::Both), expected, "split at {split}");
    }
}

#[test]
fn every_chunk_size() {
    let stream = hard_stream();
    for versions in [Versions::Both, Versions::Only(Version::V1), Versions::Only(Version::V2)] {
        let expected = one_shot(&stream, versions);
        assert_eq!(slow_decoder::decode(&stream, versions), expected);
        assert_eq!(pushed(&stream, versions, true), expected);
        assert_eq!(pushed(&stream, versions, false), expected);
        for size in 1..=stream.len() {
            assert_eq!(chunked(stream.chunks(size), versions), expected, "chunks of {size}");
        }
    }
}

#[test]
fn frames_behind_a_refused_straddler_are_lent_from_the_chunk() {
    let inner = encode(Version::V2, 82, &[1]);
    let mut broken = encode(Version::V1, 33, &[&inner[..], &inner].concat());
    *broken.last_mut().unwrap() ^= 1;
    // `Feed` compares the pointers.
    for split in 1..4 {
        let (head, tail) = broken.split_at(split);
        assert_eq!(frames(&chunked([head, tail], Versions::Both)), [inner.clone(), inner.clone()]);
    }
}

#[test]
fn a_gap_ends_one_candidate() {
    let frame = encode(Version::V2, 82, &[1]);
    let mut feed = Feed::new(Versions::Both);
    assert_eq!(feed.decoder.skip_candidate(), None);

    // A false start, then a frame of which the last byte is late.
    feed.chunk(&[&header(Version::V1, 9, 255)[..], &frame[..6]].concat());
    let skipped = feed.decoder.skip_candidate().unwrap();
    assert_eq!(skipped, Skipped { at: 0, length: 1, cause: Cause::Truncated });
    push(&mut feed.seen, Event::Skipped(skipped));
    // The noise behind the start byte can be told of without a new byte, so nothing waits yet.
    assert_eq!(feed.decoder.skip_candidate(), None);
    feed.chunk(&[]);
    assert_eq!(feed.decoder.pending(), 6);

    // The late byte still completes the frame.
    feed.chunk(&frame[6..]);
    assert_eq!(frames(&feed.finish()), [frame]);
}

#[test]
fn reset_starts_a_new_stream() {
    let mut feed = Feed::new(Versions::Only(Version::V1));
    feed.chunk(&hard_stream()[..60]);
    feed.chunk(b">\x01\xFF\x00");
    let mut decoder = feed.decoder;
    decoder.reset();
    assert_eq!((decoder.pending(), decoder.position(), decoder.counters().frames), (0, 0, 0));
    assert_eq!(decoder.versions(), Versions::Only(Version::V1));
    let frame = encode(Version::V1, 82, &[1]);
    assert!(matches!(decoder.next(&mut &frame[..]), Some(Event::Frame { at: 0, .. })));
}

#[test]
fn versions_can_change_with_bytes_pending() {
    let frame = encode(Version::V2, 82, &[1]);
    let mut feed = Feed::new(Versions::Both);
    feed.chunk(&header(Version::V1, 9, 255));
    feed.decoder.set_versions(Versions::Only(Version::V2));
    feed.chunk(&frame);
    let noise = Skipped { at: 0, length: 4, cause: Cause::NoStartByte };
    assert_eq!(feed.seen[0], Seen::Skipped(noise));
    assert_eq!(frames(&feed.finish()), [frame]);
}

fn version() -> impl Strategy<Value = Version> {
    prop_oneof![Just(Version::V1), Just(Version::V2)]
}

fn versions() -> impl Strategy<Value = Versions> {
    prop_oneof![Just(Versions::Both), version().prop_map(Versions::Only)]
}

/// Bytes of which half are start bytes, so that payloads and noise are full of candidates.
fn starts(length: impl Into<proptest::collection::SizeRange>) -> impl Strategy<Value = Vec<u8>> {
    vec(prop_oneof![Just(b'>'), Just(b'$'), any::<u8>(), 0..4_u8], length)
}

fn frame_around(payload: impl Strategy<Value = Vec<u8>>) -> impl Strategy<Value = Vec<u8>> {
    (version(), 1..=255_u8, payload).prop_map(|(version, id, payload)| encode(version, id, &payload))
}

fn frame() -> impl Strategy<Value = Vec<u8>> {
    frame_around(prop_oneof![4 => starts(0..24), 1 => starts(0..=255)])
}

/// A frame or something that looks like one for a while.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        4 => frame(),
        2 => starts(0..40),
        1 => (frame(), any::<prop::sample::Index>(), 1..=255_u8).prop_map(|(mut frame, index, flip)| {
            let length = frame.len();
            frame[index.index(length)] ^= flip;
            frame
        }),
        1 => (frame(), any::<prop::sample::Index>())
            .prop_map(|(frame, index)| frame[..index.index(frame.len())].to_vec()),
        1 => (version(), 1..=255_u8, any::<u8>()).prop_map(|(version, id, size)| header(version, id, size)),
    ]
}

fn stream() -> impl Strategy<Value = Vec<u8>> {
    vec(piece(), 0..12).prop_map(|pieces| pieces.concat())
}

/// `stream` cut into chunks of these sizes in turn.
fn cut<'a>(mut stream: &'a [u8], sizes: &[usize]) -> Vec<&'a [u8]> {
    let mut chunks = Vec::new();
    for &size in sizes.iter().cycle() {
        if stream.is_empty() {
            break;
        }
        let (chunk, rest) = stream.split_at(size.min(stream.len()));
        chunks.push(chunk);
        stream = rest;
    }
    chunks
}

proptest! {
    #[test]
    fn frames_between_noise_come_out(
        pieces in vec((vec(any::<u8>(), 0..20), frame()), 0..10),
        sizes in vec(1..80_usize, 1..6),
    ) {
        let quiet = |byte: &u8| Version::from_start_byte(*byte).is_none();
        let noise = pieces.iter().map(|(noise, _)| noise.iter().copied().filter(quiet).collect::<Vec<_>>());
        let sent: Vec<_> = pieces.iter().map(|(_, frame)| frame.clone()).collect();
        let stream: Vec<_> = noise.zip(&sent).flat_map(|(noise, frame)| [&noise[..], frame].concat()).collect();
        prop_assert_eq!(frames(&chunked(cut(&stream, &sizes), Versions::Both)), sent);
    }

    #[test]
    fn chunks_are_invisible(
        stream in stream(),
        sizes in vec(prop_oneof![1..8_usize, 1..300_usize], 1..8),
        versions in versions(),
    ) {
        let expected = slow_decoder::decode(&stream, versions);
        prop_assert_eq!(&one_shot(&stream, versions), &expected);
        prop_assert_eq!(&chunked(cut(&stream, &sizes), versions), &expected);
        prop_assert_eq!(&pushed(&stream, versions, true), &expected);
        prop_assert_eq!(&pushed(&stream, versions, false), &expected);
    }

    #[test]
    fn chunks_and_single_bytes_mix(
        stream in stream(),
        sizes in vec(prop_oneof![1..8_usize, 1..300_usize], 1..8),
        single in vec(any::<bool>(), 1..6),
        ask in any::<bool>(),
    ) {
        let mut feed = Feed::new(Versions::Both);
        for (chunk, single) in cut(&stream, &sizes).into_iter().zip(single.into_iter().cycle()) {
            // A chunk is looked at once all has been told of what came before.
            if single { feed.bytes(chunk, ask) } else { feed.chunk_behind_bytes(chunk) }
        }
        prop_assert_eq!(feed.finish(), slow_decoder::decode(&stream, Versions::Both));
    }

    #[test]
    fn no_intact_frame_is_skipped(stream in stream(), versions in versions()) {
        for seen in chunked([&stream[..]], versions) {
            if let Seen::Skipped(skipped) = seen {
                let start = usize::try_from(skipped.at).unwrap();
                for at in start..start + skipped.length {
                    prop_assert!(!starts_with_frame(&stream[at..], versions), "at {}", at);
                }
            }
        }
    }

    /// A gap ends the false start before the frame, which is shorter than what the false start announces.
    #[test]
    fn gaps_lose_no_whole_frame(bursts in vec(frame_around(starts(0..90)), 1..8), size in 100..=255_u8) {
        let mut feed = Feed::new(Versions::Both);
        for burst in &bursts {
            feed.chunk(&header(Version::V1, 1, size));
            feed.chunk(burst);
            while let Some(skipped) = feed.decoder.skip_candidate() {
                push(&mut feed.seen, Event::Skipped(skipped));
                feed.chunk(&[]);
            }
            prop_assert_eq!(feed.decoder.pending(), 0);
        }
        prop_assert_eq!(frames(&feed.finish()), bursts);
    }

    #[test]
    fn gaps_anywhere_keep_the_account(
        stream in stream(),
        sizes in vec(1..100_usize, 1..6),
        gaps in vec(any::<bool>(), 1..6),
    ) {
        let mut feed = Feed::new(Versions::Both);
        for (chunk, gap) in cut(&stream, &sizes).into_iter().zip(gaps.into_iter().cycle()) {
            feed.chunk(chunk);
            if gap && let Some(skipped) = feed.decoder.skip_candidate() {
                push(&mut feed.seen, Event::Skipped(skipped));
                feed.check();
            }
        }
        feed.finish();
    }
}
