//! What goes wrong on purpose, and a minute in which everything does.

use std::time::Duration;

use sbgc_proto::commands::{
    BoardInfoRequest, Control, DataStreamInterval, MotorsOn, RealtimeDataCustomFlags, SetDebugPortRequest,
    StreamSource,
};
use sbgc_proto::frame::{Version, encode_into};
use sbgc_proto::units::{ControlRate, StreamInterval};

use super::{Bench, ms};
use crate::sim::{Board, Config, Fault, Way};

fn bench(fault: Fault) -> Bench {
    Bench::new(Config { faults: vec![fault], ..Config::default() })
}

/// How many of 200 questions are answered.
fn answered(bench: &mut Bench) -> usize {
    (0..200).map(|_| bench.ask(&BoardInfoRequest {}).len()).sum()
}

#[test]
fn frames_are_lost_doubled_and_late() {
    let lost = |way| answered(&mut bench(Fault::Drop { probability: 0.3, way }));
    assert!((110..170).contains(&lost(Way::Out)) && (110..170).contains(&lost(Way::In)));
    assert_eq!(lost(Way::In), lost(Way::In), "a seed repeats itself");
    let doubled = |way| answered(&mut bench(Fault::Duplicate { probability: 0.5, way }));
    assert!((270..330).contains(&doubled(Way::Out)) && (270..330).contains(&doubled(Way::In)));
    for way in [Way::Out, Way::In] {
        let mut late = bench(Fault::Delay { time: ms(40), way });
        assert_eq!(late.ask(&BoardInfoRequest {}), []);
        assert_eq!(late.run(ms(31)), []);
        assert_eq!(late.run(ms(16)).len(), 1, "{way:?}");
    }
    let spoiled = answered(&mut bench(Fault::Corrupt { probability: 0.3, way: Way::In }));
    assert!((110..170).contains(&spoiled));
}

#[test]
fn a_spoiled_frame_has_one_wrong_bit() {
    let mut board = Board::new(Config {
        faults: vec![Fault::Corrupt { probability: 1.0, way: Way::Out }],
        ..Config::default()
    });
    let mut whole = Board::new(Config::default());
    let mut frames = [&mut board, &mut whole].map(|board| {
        board.receive(ms(1), &[0x3E, 86, 0, 86, 0]);
        board.advance(ms(8));
        board.take_output()
    });
    let [spoiled, good] = &mut frames;
    let wrong: u32 = spoiled.iter().zip(good.iter()).map(|(a, b)| (a ^ b).count_ones()).sum();
    assert_eq!((wrong, spoiled.len()), (1, good.len()));
}

#[test]
fn a_reset_is_announced_and_forgets() {
    let mut bench = bench(Fault::Reset { at: ms(1000) });
    let source = StreamSource::RealtimeData3;
    bench.ask_one(&DataStreamInterval::new(source, StreamInterval(100)));
    bench.run(ms(900));
    let got = bench.run(ms(300));
    assert!(got.iter().any(|got| got.id == 114), "{got:?}");
    assert_eq!((bench.board.resets(), bench.run(ms(1000))), (1, vec![]));
}

/// At a real bit rate the notice takes its time, all the more behind the samples of a stream.
#[test]
fn the_notice_of_a_reset_leaves_before_it() {
    for interval in [0, 1, 20] {
        let faults = vec![Fault::Reset { at: ms(1000) }];
        let mut bench = Bench::new(Config { faults, bit_rate: Some(115_200), ..Config::default() });
        if interval > 0 {
            bench.send(&DataStreamInterval::new(StreamSource::RealtimeData4, StreamInterval(interval)));
        }
        let ids: Vec<u8> = bench.run(ms(1300)).iter().map(|got| got.id).collect();
        assert_eq!(ids.last(), Some(&114), "{interval}: {ids:?}");
        assert_eq!(bench.board.resets(), 1);
    }
}

#[test]
fn an_unplugged_line_is_dead_both_ways_while_the_board_runs_on() {
    let mut bench = bench(Fault::Unplug { at: ms(500), lasts: ms(1000) });
    let speed = ControlRate::from_degrees_per_second(10.0);
    bench.ask_one(&Control::speeds([speed; 3].into()));
    bench.run(ms(500));
    assert!(bench.board.is_unplugged());
    let before = bench.board.motion().axes().yaw.angle;
    assert_eq!(bench.ask(&BoardInfoRequest {}), []);
    bench.run(ms(1100));
    assert!(!bench.board.is_unplugged() && bench.board.motion().axes().yaw.angle > before + 8.0);
    assert_eq!(bench.ask(&BoardInfoRequest {}).len(), 1);
}

#[test]
fn a_stalled_board_works_off_what_has_come() {
    let mut bench = bench(Fault::Stall { at: ms(100), lasts: ms(500) });
    bench.run(ms(104));
    for _ in 0..5 {
        assert_eq!(bench.ask(&BoardInfoRequest {}), []);
    }
    assert_eq!(bench.run(ms(600)).len(), 5);
}

#[test]
fn without_confirmations_the_rest_is_answered() {
    let mut bench = bench(Fault::NoConfirm);
    assert_eq!(bench.ask(&MotorsOn {}), []);
    assert_eq!(bench.ask(&BoardInfoRequest {}).len(), 1);
    bench.board.clear_faults();
    assert_eq!(bench.ask(&MotorsOn {}).len(), 1);
}

#[test]
fn a_debug_port_sees_what_the_others_say() {
    let mut board = Board::new(Config::default());
    let debug = board.connect().unwrap();
    let mut buffer = [0; 64];
    let request = SetDebugPortRequest { action: 1.into(), ..SetDebugPortRequest::default() };
    let mut payload = [0; 32];
    let payload = sbgc_proto::Message::encode(&request, &mut payload).unwrap();
    board.receive_on(debug, ms(1), encode_into(Version::V1, 249, payload, &mut buffer).unwrap());
    board.advance(ms(8));
    assert_eq!(board.take_output_of(debug)[1], 67);
    board.receive(ms(9), &[0x3E, 86, 0, 86, 0]);
    board.advance(ms(16));
    let seen = board.take_output_of(debug);
    // The question and the answer, with their time, port and direction.
    assert_eq!((seen[1], seen[4..8].to_vec()), (249, vec![16, 0, 0, 86]));
    assert_eq!((seen[9 + 1], seen[9 + 6], seen[9 + 7]), (249, 0x80, 86));
    board.disconnect(debug);
    assert_eq!(board.connect(), Some(debug));
}

#[test]
fn a_minute_of_everything_leaves_it_as_lively_as_before() {
    let mut board = Board::new(Config { bit_rate: Some(115_200), ..Config::default() });
    let mut buffer = [0; 64];
    for bit in 0..10 {
        let source = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::from_bits_retain(1 << bit));
        let request = DataStreamInterval::new(source, StreamInterval::EVERY_CYCLE);
        let mut payload = [0; 32];
        let payload = sbgc_proto::Message::encode(&request, &mut payload).unwrap();
        let frame = encode_into(Version::V1, 85, payload, &mut buffer).unwrap().to_vec();
        board.receive(ms(20 * (bit + 1)), &frame);
    }
    let mut control = vec![0x3E, 67, 15, 82];
    control.resize(20, 0);
    let mut garbage = 1_u32;
    // Each second somebody comes and goes.
    let mut now = Duration::from_secs(1);
    board.advance(now);
    board.take_output();
    for turn in 0..7500_u32 {
        now += ms(8);
        board.receive(now, &control);
        if turn % 10 == 0 {
            garbage = garbage.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            board.receive(now, &garbage.to_le_bytes());
        }
        if turn % 125 == 0 {
            let port = board.connect().unwrap();
            board.receive_on(port, now, &[0x3E, 86, 0, 86, 0]);
            board.advance(now + ms(2));
            board.disconnect(port);
        }
        assert!(board.take_output().len() < 4096 && board.unreceived() < 1024);
    }
    let counters = board.counters();
    assert!(counters.received > 7000 && counters.input_peak <= 255, "{counters:?}");
    assert!(counters.skipped_samples > 0 && board.last_commands().count() <= 64, "{counters:?}");
}
