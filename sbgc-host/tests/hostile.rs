//! The driver against the simulated board over a line that does its worst.
#![cfg(feature = "sim")]

use std::time::Duration;

use sbgc_host::proto::commands::{RealtimeDataCustom, RealtimeDataCustomFlags as Flags, StreamSource};
use sbgc_host::proto::frame::{MAX_FRAME, Version, encode_into};
use sbgc_host::streams::Item;
use sbgc_host::{Gimbal, LinkState, Options, StreamRequest, sim};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt, duplex, split};

/// Numbers that look random and are the same each time (xorshift).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Once in `of` times.
    fn once_in(&mut self, of: u64) -> bool {
        self.roll().is_multiple_of(of)
    }

    fn byte(&mut self) -> u8 {
        self.roll().to_le_bytes()[3]
    }

    fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.roll() >> 8).unwrap_or_default() % limit
    }
}

/// What a line does to the bytes that pass it.
#[derive(Clone, Copy)]
struct Line {
    /// Puts noise, half frames, unknown commands and false lengths between pieces.
    inserts: bool,
    /// Changes, drops and repeats bytes, once in so many pieces; 0 for never.
    damages: u64,
}

fn insertion(dice: &mut Dice) -> Vec<u8> {
    let mut buffer = [0; MAX_FRAME];
    let payload: Vec<u8> = (0..dice.below(30)).map(|_| dice.byte()).collect();
    let version = if dice.once_in(2) { Version::V1 } else { Version::V2 };
    match dice.below(4) {
        0 => (0..dice.below(80)).map(|_| dice.byte()).collect(),
        // A command that no board has.
        1 => encode_into(version, 0xC8, &payload, &mut buffer).unwrap().to_vec(),
        2 => {
            let frame = encode_into(version, 86, &payload, &mut buffer).unwrap();
            frame[..dice.below(frame.len())].to_vec()
        }
        // A header that is right and promises what does not come.
        _ => vec![b'>', 86, 200, 86_u8.wrapping_add(200)],
    }
}

fn damage(piece: &mut Vec<u8>, dice: &mut Dice) {
    if piece.is_empty() {
        return;
    }
    let at = dice.below(piece.len());
    match dice.below(3) {
        0 => piece[at] ^= 1 << dice.below(8),
        1 => drop(piece.remove(at)),
        _ => piece.extend_from_within(..),
    }
}

/// Passes bytes on, one way.
async fn carry(
    mut from: impl AsyncRead + Unpin,
    mut to: impl AsyncWrite + Unpin,
    line: Line,
    mut dice: Dice,
) {
    let mut piece = Vec::with_capacity(4096);
    while from.read_buf(&mut piece).await.is_ok_and(|count| count > 0) {
        if line.damages > 0 && dice.once_in(line.damages) {
            damage(&mut piece, &mut dice);
        }
        if line.inserts && dice.once_in(2) {
            piece.splice(..0, insertion(&mut dice));
        }
        if to.write_all(&piece).await.is_err() {
            return;
        }
        piece.clear();
    }
}

/// A gimbal whose answers come over `line`; what it asks goes over the same if `both` is set.
fn gimbal(line: Line, both: bool, seed: u64) -> Gimbal {
    let (near, far) = duplex(4096);
    let (from_host, to_host) = split(far);
    let (from_board, to_board) = split(sim::in_process(sim::Config::default()));
    let clean = Line { inserts: false, damages: 0 };
    tokio::spawn(carry(from_board, to_host, line, Dice(seed)));
    tokio::spawn(carry(from_host, to_board, if both { line } else { clean }, Dice(seed ^ 0xFFFF)));
    Gimbal::spawn(near, Options { attempts: 20, ..Options::default() })
}

#[tokio::test(start_paused = true)]
async fn what_is_put_between_frames_loses_none_of_them() {
    for seed in 1..=20 {
        let gimbal = gimbal(Line { inserts: true, damages: 0 }, false, seed * 77_777);
        let info = gimbal.handshake().await.unwrap();
        for _ in 0..50 {
            assert_eq!(gimbal.board_info().await.unwrap(), info);
            gimbal.motors_on().await.unwrap();
        }
        let counters = gimbal.counters();
        assert_eq!(counters.timeouts, 0, "{counters}");
        assert!(counters.unsolicited > 0, "unknown commands are counted: {counters}");
        let received = counters.received;
        assert!(received.no_start_byte > 0 && received.truncated > 0, "{counters}");
    }
}

#[tokio::test(start_paused = true)]
async fn damaged_answers_are_asked_for_again() {
    for seed in 1..=20 {
        let gimbal = gimbal(Line { inserts: true, damages: 5 }, true, seed * 99_991);
        let info = gimbal.handshake().await.unwrap();
        assert_eq!(gimbal.version(), Version::V2);
        for _ in 0..50 {
            assert_eq!(gimbal.board_info().await.unwrap(), info);
        }
        let counters = gimbal.counters();
        assert!(counters.repeats > 0, "{counters}");
        assert!(counters.received.payload_checksum + counters.received.header_checksum > 0, "{counters}");
    }
}

#[tokio::test(start_paused = true)]
async fn a_stream_goes_on_through_all_of_it() {
    let gimbal = gimbal(Line { inserts: true, damages: 5 }, true, 4711);
    gimbal.handshake().await.unwrap();
    let source = StreamSource::RealtimeDataCustom(Flags::IMU_ANGLES);
    let samples = gimbal.subscribe(StreamRequest::of(source, 10)).await.unwrap();
    let mut samples = samples.typed_with::<RealtimeDataCustom, _>(Flags::IMU_ANGLES);
    let mut last = 0;
    let started = tokio::time::Instant::now();
    for _ in 0..500 {
        let Some(Item::Message(sample)) = samples.next().await else { panic!("the stream goes on") };
        // A damaged sample is lost; what is taken for one never makes time jump.
        assert!(sample.timestamp_ms >= last && sample.timestamp_ms < 60_000, "{}", sample.timestamp_ms);
        last = sample.timestamp_ms;
    }
    assert!(started.elapsed() < Duration::from_secs(10), "{:?}", started.elapsed());
    assert_eq!(*gimbal.link_state().borrow(), LinkState::Open);
}
