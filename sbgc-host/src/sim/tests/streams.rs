//! Data streams.

use std::time::Duration;

use sbgc_proto::commands::{
    Confirm, DataStreamInterval, RealtimeData3, RealtimeData4, RealtimeDataCustom, RealtimeDataCustomFlags,
    StreamSource, Switch,
};
use sbgc_proto::units::StreamInterval;
use sbgc_proto::{CommandId, Message};

use super::{Bench, ms};
use crate::sim::{Config, POLL};

const ANGLES: RealtimeDataCustomFlags = RealtimeDataCustomFlags::IMU_ANGLES;

fn stream(source: StreamSource, interval: u16) -> DataStreamInterval {
    DataStreamInterval::new(source, StreamInterval(interval))
}

fn register(bench: &mut Bench, request: &DataStreamInterval) {
    bench.send(request);
    let got = bench.run(POLL);
    let confirm = got.iter().find(|got| got.id == Confirm::ID.raw()).unwrap_or_else(|| panic!("{got:?}"));
    assert_eq!(confirm.decoded::<Confirm>().cmd_id, CommandId::DataStreamInterval);
}

/// A bench whose next poll is now, so that a registration has a known time.
fn bench(config: Config) -> Bench {
    let mut bench = Bench::new(config);
    bench.run(ms(7));
    assert_eq!(bench.now, POLL);
    bench
}

#[test]
fn the_average_is_exact_and_no_sample_is_a_millisecond_off() {
    for (interval, time) in [(1, 0.8), (2, 2.0), (3, 3.0), (7, 7.0), (10, 10.0), (33, 33.0), (1000, 1000.0)] {
        let mut bench = bench(Config::default());
        // Sent at 8 ms, registered at 16.
        register(&mut bench, &stream(StreamSource::RealtimeDataCustom(ANGLES), interval));
        let seconds = 20.0;
        let got = bench.run(Duration::from_secs_f64(seconds));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
        let wanted = (seconds * 1000.0 / time).round() as usize;
        // The last may be taken in the cycle after.
        assert!(got.len() == wanted || got.len() + 1 == wanted, "{interval}: {} of {wanted}", got.len());
        for (index, sample) in (1_u32..).zip(&got) {
            let (data, _) = RealtimeDataCustom::decode_with(&sample.payload, ANGLES).unwrap();
            let ideal = 16.0 + f64::from(index) * time;
            let off = f64::from(data.timestamp_ms) - ideal;
            assert!(
                (-1.0..1.0).contains(&off),
                "{interval}: sample {index} at {} not {ideal}",
                data.timestamp_ms
            );
        }
    }
}

#[test]
fn a_stream_is_known_by_command_and_configuration() {
    let mut bench = bench(Config::default());
    let more = ANGLES | RealtimeDataCustomFlags::GYRO_DATA;
    register(&mut bench, &stream(StreamSource::RealtimeDataCustom(ANGLES), 100));
    register(&mut bench, &stream(StreamSource::RealtimeDataCustom(more), 200));
    register(&mut bench, &stream(StreamSource::RealtimeData3, 500));
    let count = |bench: &mut Bench| {
        let got = bench.run(Duration::from_secs(10));
        let of = |id: CommandId, length| {
            got.iter().filter(|got| got.id == id.raw() && got.payload.len() == length).count()
        };
        let id = CommandId::RealtimeDataCustom;
        [of(id, 8), of(id, 14), of(RealtimeData3::ID, 63)]
    };
    assert_eq!(count(&mut bench), [100, 50, 20]);
    register(&mut bench, &stream(StreamSource::RealtimeDataCustom(ANGLES), 50));
    register(&mut bench, &stream(StreamSource::RealtimeDataCustom(more), 0));
    bench.run(ms(1));
    assert_eq!(count(&mut bench), [200, 0, 20]);
}

#[test]
fn there_are_ten() {
    let mut bench = bench(Config::default());
    let source =
        |bit: u32| StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::from_bits_retain(1 << bit));
    let bits = [0, 1, 2, 3, 4, 5, 6, 7, 8];
    for bit in bits {
        register(&mut bench, &stream(source(bit), 60_000));
    }
    register(&mut bench, &stream(StreamSource::RealtimeData4, 60_000));
    let eleventh = stream(StreamSource::RealtimeData3, 60_000);
    assert_eq!(bench.ask_one(&eleventh).payload[..2], [85, 10]);
    // One that is there can still be changed, and one that goes makes room.
    register(&mut bench, &stream(source(3), 50_000));
    register(&mut bench, &stream(source(3), 0));
    register(&mut bench, &eleventh);
}

#[test]
fn what_cannot_be_sent_cannot_be_registered() {
    let mut bench = bench(Config::default());
    let mut request = stream(StreamSource::RealtimeData3, 10);
    request.cmd_id = CommandId::BoardInfo;
    assert_eq!(bench.ask_one(&request).payload[..2], [85, 2]);
    let source = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::all());
    assert_eq!(bench.ask_one(&stream(source, 10)).payload[..2], [85, 2]);
}

#[test]
fn in_step_with_the_sensors_the_interval_divides_their_rate() {
    let mut bench = bench(Config::default());
    let mut request = stream(StreamSource::RealtimeData3, 10);
    request.sync_to_data = Switch::On;
    register(&mut bench, &request);
    assert_eq!(bench.run(ms(800)).len(), 100);
}

#[test]
fn on_a_slow_line_samples_are_skipped_and_answers_come() {
    // 1,000 bytes a second for a stream that wants 13,000.
    let mut bench = bench(Config { bit_rate: Some(10_000), ..Config::default() });
    bench.send(&stream(StreamSource::RealtimeData4, 10));
    bench.run(Duration::from_secs(1));
    let before = bench.board.counters();
    assert!(before.skipped_samples > 50, "{before:?}");
    let samples = bench.run(Duration::from_secs(10)).len();
    assert!((75..=78).contains(&samples), "{samples}");
    bench.send(&stream(StreamSource::RealtimeData4, 0));
    let got = bench.run(Duration::from_secs(1));
    assert!(got.iter().any(|got| got.id == Confirm::ID.raw()));
    assert_eq!(got[0].decoded::<RealtimeData4>().actual_angle, [sbgc_proto::units::Angle(0); 3].into());
    assert_eq!(bench.run(Duration::from_secs(1)), []);
}
