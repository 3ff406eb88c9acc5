//! Framing, buffers and bit rate.

use sbgc_proto::commands::{BoardInfo, BoardInfoRequest};
use sbgc_proto::frame::{Version, encode_into};

use super::{Bench, Got, ms};
use crate::sim::Config;

#[test]
fn answers_come_in_the_version_of_the_question() {
    let mut bench = Bench::new(Config::default());
    for version in [Version::V1, Version::V2] {
        bench.version = version;
        let got = bench.ask_one(&BoardInfoRequest);
        assert_eq!(got.version, version);
        assert_eq!(got.decoded::<BoardInfo>().firmware_ver.to_string(), "2.73.5");
    }
}

#[test]
fn version_2_locks_version_1_out() {
    let mut bench = Bench::new(Config::default());
    bench.version = Version::V2;
    assert_eq!(bench.ask(&BoardInfoRequest).len(), 1);
    bench.version = Version::V1;
    assert_eq!(bench.ask(&BoardInfoRequest), []);
    bench.version = Version::V2;
    assert_eq!(bench.ask(&BoardInfoRequest).len(), 1);
}

#[test]
fn the_queue_is_worked_through_each_8_ms() {
    let mut bench = Bench::new(Config::default());
    bench.send(&BoardInfoRequest);
    assert_eq!(bench.run(ms(6)), []);
    assert_eq!(bench.run(ms(1)).len(), 1);
}

#[test]
fn what_does_not_fit_is_lost_whole() {
    let mut bench = Bench::new(Config::default());
    for _ in 0..10 {
        bench.send_raw(86, &[0; 55]);
    }
    // Four frames of 60 bytes fit 255; so does one of 5 behind them.
    bench.send_raw(86, &[]);
    assert_eq!(bench.run(ms(100)).len(), 5);
    assert_eq!((bench.board.counters().received, bench.board.counters().lost), (5, 6));

    // The longest frame that fits, and the shortest that never does.
    bench.send_raw(86, &[0; 250]);
    assert_eq!(bench.run(ms(8)).len(), 1);
    bench.send_raw(86, &[0; 251]);
    assert_eq!(bench.run(ms(8)), []);
}

#[test]
fn noise_and_frames_that_stop_are_passed_over() {
    let mut bench = Bench::new(Config::default());
    bench.board.receive(ms(1), b"noise>\x56\x00\x56");
    bench.run(ms(8));
    bench.board.receive(bench.now, b"\x00\x00\x24\x56\xC8\x1E");
    assert_eq!(bench.run(ms(8)).len(), 1);
    // 200 bytes are announced and do not come.
    bench.send(&BoardInfoRequest);
    assert_eq!(bench.run(ms(90)), []);
    assert_eq!(bench.run(ms(30)).len(), 1);
    assert!(bench.board.counters().skipped_bytes > 5);
    assert_eq!(bench.board.next_event(), None);
}

#[test]
fn what_nobody_knows_is_refused_and_wrong_sizes_are_ignored() {
    let mut bench = Bench::new(Config::default());
    let mut refused = |id, payload: &[u8]| {
        bench.send_raw(id, payload);
        bench.run(ms(8)).into_iter().map(|Got { id, payload, .. }| (id, payload)).collect::<Vec<_>>()
    };
    assert_eq!(refused(86, &[1]), []);
    assert_eq!(refused(199, &[1, 2]), [(255, vec![199, 6, 0, 0, 0, 0])]);
}

#[test]
fn a_slow_line_takes_its_time() {
    // One byte in a millisecond.
    let mut bench = Bench::new(Config { bit_rate: Some(10_000), ..Config::default() });
    let mut buffer = [0; 9];
    let frame = encode_into(Version::V1, 86, &[], &mut buffer).unwrap();
    bench.now = ms(8);
    bench.board.receive(bench.now, frame);
    // It is there at 13, seen at 16, and the last of the 23 bytes of the answer has left at 39.
    assert_eq!(bench.run(ms(30)), []);
    assert_eq!(bench.run(ms(1)).len(), 1);
}

#[test]
fn a_host_that_does_not_read_loses_answers_and_not_its_commands() {
    let mut bench = Bench::new(Config::default());
    let mut buffer = [0; 9];
    let frame = encode_into(Version::V1, 86, &[], &mut buffer).unwrap().to_vec();
    for turn in 0..300_u32 {
        bench.board.receive(super::POLL * turn, &frame);
    }
    bench.now = super::POLL * 300;
    bench.board.advance(bench.now);
    let before = bench.board.counters();
    assert_eq!((before.received, before.lost), (300, 0), "{before:?}");
    assert!(before.unread_bytes > 2000, "{before:?}");
    // What it can still read is what the line has kept.
    assert_eq!(bench.board.take_output().len(), 4096);
    bench.board.receive(bench.now, &frame);
    assert_eq!(bench.run(ms(8)).len(), 1);
}
