//! Any stream in any chunks: no panic, progress on every step, every byte accounted for, and the frames of
//! a slow and obvious decoder; gaps at any moment keep the account.
//!
//! Input: a byte of options, a byte that seeds chunk sizes and gaps, then the stream.
#![no_main]

#[path = "../../sbgc-proto/tests/slow_decoder/mod.rs"]
mod slow_decoder;

use libfuzzer_sys::fuzz_target;
use sbgc_proto::frame::{Cause, Decoder, Event, MAX_FRAME, Version, Versions, encode_into};
use slow_decoder::{Seen, push};

/// The stream is a row of recipes for frames and noise: the way past checksums, which chance seldom finds.
const RECIPES: u8 = 0x04;
/// The driver sees gaps and gives candidates up.
const GAPS: u8 = 0x08;
/// Bytes come one at a time, and what else can be told is asked for now and then.
const SINGLE: u8 = 0x10;

fuzz_target!(|data: &[u8]| {
    let [options, seed, stream @ ..] = data else { return };
    let versions = match options & 0x03 {
        0 => Versions::Only(Version::V1),
        1 => Versions::Only(Version::V2),
        _ => Versions::Both,
    };
    let cooked;
    let stream = if options & RECIPES == 0 {
        stream
    } else {
        cooked = cook(stream);
        &cooked
    };

    let mut dice = Dice(u32::from(*seed) + 1);
    let gaps = options & GAPS != 0;
    let seen = if options & SINGLE == 0 {
        chunked(stream, versions, gaps, &mut dice)
    } else {
        pushed(stream, versions, gaps, &mut dice)
    };
    if !gaps {
        assert_eq!(seen, slow_decoder::decode(stream, versions));
    }
});

/// Recipes: a kind, a length and that many bytes. Kinds are noise, a frame, or a frame with a bad check.
fn cook(mut recipes: &[u8]) -> Vec<u8> {
    let mut stream = Vec::new();
    while let [kind, length, rest @ ..] = recipes {
        let (bytes, rest) = rest.split_at(rest.len().min(usize::from(*length)));
        recipes = rest;
        let version = if kind & 1 == 0 { Version::V1 } else { Version::V2 };
        let mut out = [0; MAX_FRAME];
        match (kind >> 1 & 0x03, encode_into(version, kind | 1, bytes, &mut out)) {
            (1 | 2, Ok(frame)) => stream.extend_from_slice(frame),
            (3, Ok(frame)) => {
                stream.extend_from_slice(frame);
                if let Some(last) = stream.last_mut() {
                    *last ^= 0x55;
                }
            }
            _ => stream.extend_from_slice(bytes),
        }
    }
    stream
}

fn chunked(stream: &[u8], versions: Versions, gaps: bool, dice: &mut Dice) -> Vec<Seen> {
    let mut decoder = Decoder::new(versions);
    let mut seen = Vec::new();
    let mut fed = 0;
    while fed < stream.len() {
        let sizes = [1, 2, 7, 64, 300, 1000];
        let most = sizes[dice.below(sizes.len())];
        let size = 1 + dice.below(most);
        let end = stream.len().min(fed + size);
        let mut rest = &stream[fed..end];
        loop {
            if gaps && dice.below(8) == 0 {
                if let Some(skipped) = decoder.skip_candidate() {
                    push(&mut seen, Event::Skipped(skipped));
                }
                account(&decoder, fed);
            }
            let before = decoder.position();
            let event = decoder.next(&mut rest);
            let more = event.is_some();
            if let Some(event) = event {
                push(&mut seen, event);
            }
            fed = end - rest.len();
            account(&decoder, fed);
            if !more {
                break;
            }
            assert!(decoder.position() > before, "no progress");
        }
        assert!(rest.is_empty() && decoder.pending() < MAX_FRAME);
    }
    finish(decoder, seen, fed)
}

fn pushed(stream: &[u8], versions: Versions, gaps: bool, dice: &mut Dice) -> Vec<Seen> {
    let mut decoder = Decoder::new(versions);
    let mut seen = Vec::new();
    for (fed, &byte) in stream.iter().enumerate() {
        if let Some(event) = decoder.push(byte) {
            push(&mut seen, event);
        }
        account(&decoder, fed + 1);
        while dice.below(3) > 0
            && let Some(event) = decoder.more()
        {
            push(&mut seen, event);
        }
        if gaps
            && dice.below(8) == 0
            && let Some(skipped) = decoder.skip_candidate()
        {
            push(&mut seen, Event::Skipped(skipped));
        }
        account(&decoder, fed + 1);
    }
    finish(decoder, seen, stream.len())
}

/// Ends the stream and compares the counters with what was seen.
fn finish(mut decoder: Decoder, mut seen: Vec<Seen>, fed: usize) -> Vec<Seen> {
    while let Some(event) = decoder.finish() {
        push(&mut seen, event);
    }
    assert_eq!(decoder.pending(), 0);
    account(&decoder, fed);

    let total = |wanted: Option<Cause>| -> u64 {
        let length = |seen: &Seen| match seen {
            Seen::Skipped(skipped) if Some(skipped.cause) == wanted => skipped.length as u64,
            Seen::Frame { .. } if wanted.is_none() => seen.length(),
            _ => 0,
        };
        seen.iter().map(length).sum()
    };
    assert_eq!(decoder.counters().frame_bytes, total(None));
    for cause in Cause::ALL {
        assert_eq!(decoder.counters().skipped_for(cause), total(Some(cause)));
    }
    seen
}

fn account(decoder: &Decoder, fed: usize) {
    assert_eq!(decoder.position() + decoder.pending() as u64, fed as u64);
}

/// A small generator (xorshift), so that one byte of input stands for a whole way of cutting.
struct Dice(u32);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0 as usize % limit
    }
}
