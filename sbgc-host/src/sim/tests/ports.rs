//! Several ports of one board.

use sbgc_proto::Message;
use sbgc_proto::commands::{Control, ControlConfig, DataStreamInterval, StreamSource};
use sbgc_proto::frame::{Version, encode_into};
use sbgc_proto::units::{ControlRate, StreamInterval};
use sbgc_proto::wire::ToWire;

use super::ms;
use crate::sim::{Board, Config};

fn frame(id: u8, payload: &[u8]) -> Vec<u8> {
    let mut buffer = [0; 80];
    encode_into(Version::V1, id, payload, &mut buffer).unwrap().to_vec()
}

fn of<M: Message + ToWire>(message: &M) -> Vec<u8> {
    let mut payload = [0; 64];
    frame(M::ID.raw(), message.encode(&mut payload).unwrap())
}

const BOARD_INFO: [u8; 5] = [0x3E, 86, 0, 86, 0];

#[test]
fn bridged_ports_carry_raw_bytes_until_a_reset() {
    let mut board = Board::new(Config { bit_rate: Some(115_200), ..Config::default() });
    let (second, third) = (board.connect().unwrap(), board.connect().unwrap());
    // 0 is the port that it comes on, the others count from 1.
    board.receive(ms(1), &frame(143, &[0, second + 1]));
    board.advance(ms(20));
    assert_eq!(board.take_output(), [][..], "success is not answered");
    let nonsense = b"$GPGGA,123519\r\n";
    board.receive(ms(21), nonsense);
    board.receive_on(second, ms(21), &BOARD_INFO);
    board.advance(ms(60));
    assert_eq!(board.take_output_of(second), nonsense[..]);
    assert_eq!(board.take_output(), BOARD_INFO[..], "a question is passed on like everything");
    assert_eq!(board.take_output_of(third), [][..]);
    // A port that has an end of a bridge gets no other.
    board.receive_on(third, ms(61), &frame(143, &[0, 1]));
    board.advance(ms(80));
    assert_eq!(board.take_output_of(third)[4..6], [143, 8]);
    board.receive_on(third, ms(81), &frame(114, &[]));
    board.advance(ms(500));
    board.receive(ms(500), &BOARD_INFO);
    board.advance(ms(520));
    assert_eq!(board.take_output()[1], 86, "it talks the protocol again");
}

#[test]
fn a_bridge_ends_when_one_of_its_ports_is_given_back() {
    let mut board = Board::new(Config::default());
    let second = board.connect().unwrap();
    board.receive(ms(1), &frame(143, &[1, second + 1]));
    board.advance(ms(8));
    board.disconnect(second);
    board.receive(ms(9), &BOARD_INFO);
    board.advance(ms(16));
    assert_eq!(board.take_output()[1], 86);
}

#[test]
fn a_bridge_needs_two_ports_that_are_there() {
    let mut board = Board::new(Config::default());
    let cases = [([0, 1], 2), ([0, 0], 2), ([0, 9], 8), ([200, 0], 8)];
    for (turn, (ports, code)) in (1_u64..).zip(cases) {
        board.receive(ms(turn * 100), &frame(143, &ports));
        board.advance(ms(turn * 100 + 8));
        assert_eq!(board.take_output()[4..6], [143, code], "{ports:?}");
    }
}

#[test]
fn a_host_that_leaves_stops_its_streams_and_not_the_motion() {
    for timeout in [0, 300] {
        let mut board = Board::new(Config::default());
        let (host, watcher) = (board.connect().unwrap(), board.connect().unwrap());
        let config = ControlConfig { timeout_ms: timeout, ..ControlConfig::default() };
        let speed = ControlRate::from_degrees_per_second(20.0);
        let mut now = ms(1);
        let mut tell = |board: &mut Board, frame: Vec<u8>| {
            board.receive_on(host, now, &frame);
            now += ms(8);
            board.advance(now);
        };
        tell(&mut board, of(&config));
        tell(&mut board, of(&DataStreamInterval::new(StreamSource::RealtimeData3, StreamInterval(10))));
        tell(&mut board, of(&Control::speeds([speed; 3].into())));
        board.advance(ms(200));
        board.disconnect(host);
        board.advance(ms(1000));
        let turns = board.motion().axes().yaw.speed;
        let expected = if timeout == 0 { 20.0 } else { 0.0 };
        assert!((turns - expected).abs() < 0.1, "{timeout}: {turns}");
        // The port is given to the next host, which gets nothing of the one before.
        assert_eq!(board.connect(), Some(host));
        board.advance(ms(2000));
        assert_eq!((board.take_output_of(host), board.take_output_of(watcher)), Default::default());
    }
}
