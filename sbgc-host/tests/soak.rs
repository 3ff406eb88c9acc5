//! The simulated board under everything at once for a long time: it neither grows nor stalls.
#![cfg(feature = "sim")]

use std::time::Duration;

use sbgc_host::sim::{Board, Config};
use sbgc_proto::Message;
use sbgc_proto::commands::{
    Control, ControlAxis, ControlMode, DataStreamInterval, RealtimeData4, RealtimeData4Request,
    RealtimeDataCustomFlags, SetDebugPortRequest, StreamSource,
};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, Versions, encode_into};
use sbgc_proto::units::{Angle, ControlRate, StreamInterval};
use sbgc_proto::wire::ToWire;

const QUEUE: Duration = Duration::from_millis(8);

/// Numbers that look random (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: u64) -> u64 {
        self.next() % end
    }

    fn bytes(&mut self) -> Vec<u8> {
        let count = self.below(40);
        (0..count).map(|_| self.next().to_le_bytes()[2]).collect()
    }
}

fn frame<M: Message + ToWire>(message: &M) -> Vec<u8> {
    let (mut payload, mut buffer) = ([0; 255], [0; MAX_FRAME]);
    let payload = message.encode(&mut payload).unwrap();
    encode_into(Version::V1, M::ID.raw(), payload, &mut buffer).unwrap().to_vec()
}

/// Memory that is in use by this process, in KiB, where that can be asked.
fn resident() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

/// The one who has registered ten streams, controls, and asks each second.
struct Owner {
    decoder: Decoder,
    samples: u64,
    answers: u64,
    asked: Duration,
    slowest: Duration,
}

impl Owner {
    fn listen(&mut self, now: Duration, output: &[u8]) {
        let mut chunk = output;
        while let Some(event) = self.decoder.next(&mut chunk) {
            let Event::Frame { frame, .. } = event else { panic!("the board sent garbage: {event:?}") };
            if frame.id == RealtimeData4::ID.raw() {
                self.answers += 1;
                self.slowest = self.slowest.max(now.saturating_sub(self.asked));
            } else if frame.id == 88 {
                self.samples += 1;
            }
        }
    }
}

/// Somebody who comes, says nonsense or asks for a lot, perhaps never reads, and leaves.
struct Visitor {
    port: u8,
    reads: bool,
    leaves: Duration,
}

fn visit(board: &mut Board, now: Duration, random: &mut Random) -> Visitor {
    let port = board.connect().expect("few are there at once");
    let stream = |interval| {
        let source = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::RC_CHANNELS);
        frame(&DataStreamInterval::new(source, interval))
    };
    let first = match random.below(4) {
        0 => frame(&SetDebugPortRequest { action: 1.into(), ..SetDebugPortRequest::default() }),
        1 => stream(StreamInterval::EVERY_CYCLE),
        2 => frame(&RealtimeData4Request {}).repeat(100),
        _ => random.bytes(),
    };
    board.receive_on(port, now, &first);
    let leaves = now + Duration::from_millis(random.below(5000));
    Visitor { port, reads: random.below(2) == 0, leaves }
}

fn soak(time: Duration) {
    let mut board = Board::new(Config { bit_rate: Some(115_200), seed: 5, ..Config::default() });
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut now = Duration::ZERO;
    for bit in 0..10 {
        let source = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::from_bits_retain(1 << bit));
        board.receive(now, &frame(&DataStreamInterval::new(source, StreamInterval::EVERY_CYCLE)));
        now += 2 * QUEUE;
        board.advance(now);
    }
    let decoder = Decoder::new(Versions::Both);
    let mut owner = Owner { decoder, samples: 0, answers: 0, asked: now, slowest: Duration::ZERO };
    let mut visitors: Vec<Visitor> = Vec::new();
    let (mut asked, mut visits, mut settled) = (0, 0_u32, None);
    for turn in 0_u32.. {
        now += QUEUE;
        if now >= time {
            break;
        }
        // Set-points that keep the axes on their way, and now and then nonsense in between.
        let speed = ControlRate(i16::from_le_bytes([random.next().to_le_bytes()[0], 1]));
        let axis = ControlAxis { speed, angle: Angle(i16::from(random.next().to_le_bytes()[1])) };
        let mode = if turn % 3 == 0 { ControlMode::SPEED } else { ControlMode::ANGLE };
        board.receive(now, &frame(&Control { control_mode: [mode; 3].into(), axes: [axis; 3].into() }));
        if random.below(10) == 0 {
            board.receive(now, &random.bytes());
        }
        if turn % 125 == 0 {
            // What is left of nonsense must not swallow the question.
            now += Duration::from_millis(120);
            board.advance(now);
            board.receive(now, &frame(&RealtimeData4Request {}));
            (owner.asked, asked) = (now, asked + 1);
        }
        if visitors.len() < 5 && random.below(50) == 0 {
            visitors.push(visit(&mut board, now, &mut random));
            visits += 1;
        }
        board.advance(now);
        owner.listen(now, &board.take_output());
        visitors.retain(|visitor| {
            if visitor.reads {
                board.take_output_of(visitor.port);
            }
            let stays = now < visitor.leaves;
            if !stays {
                board.disconnect(visitor.port);
            }
            stays
        });
        assert!(board.unreceived() < 1024, "what comes in is worked off");
        if settled.is_none() && now > time / 5 {
            settled = resident();
        }
    }
    let counters = board.counters();
    println!(
        "{time:?}: {} answers, the slowest after {:?}, {} samples, {visits} visits, {settled:?} KiB, then {:?} KiB, {counters:?}",
        owner.answers,
        owner.slowest,
        owner.samples,
        resident(),
    );
    assert!(owner.answers + 2 >= asked, "{} of {asked} answered", owner.answers);
    assert!(owner.slowest < Duration::from_millis(300), "{:?}", owner.slowest);
    assert!(owner.samples > time.as_secs() * 100 && visits > 0);
    assert!(counters.input_peak <= 255 && counters.skipped_samples > 0, "{counters:?}");
    if let (Some(before), Some(after)) = (settled, resident()) {
        assert!(after < before + 1024, "it has grown from {before} to {after} KiB");
    }
}

#[test]
fn a_minute_of_everything_neither_grows_nor_stalls() {
    soak(Duration::from_mins(1));
}

/// Takes some minutes when built for release.
#[test]
#[ignore = "for release builds: cargo test --release --test soak -- --ignored"]
fn an_hour_of_everything_neither_grows_nor_stalls() {
    soak(Duration::from_hours(1));
}
