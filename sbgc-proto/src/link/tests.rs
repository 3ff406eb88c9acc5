//! Sessions call by call, on a clock that the test turns.

use super::*;
use crate::commands::{
    Angles, BoardInfo, BoardInfo3Request, BoardInfoRequest, Confirm, Error, GetAngles, MotorsOn, ReadParams3,
};
use crate::frame::{MAX_FRAME, encode_into};

type Small = Link<64>;

fn frame(version: Version, id: CommandId, payload: &[u8]) -> Vec<u8> {
    encode_into(version, id.raw(), payload, &mut [0; MAX_FRAME]).unwrap().to_vec()
}

/// Feeds bytes and collects what happens, with the frames that come.
fn feed<const N: usize>(link: &mut Link<N>, bytes: &[u8], now: Millis) -> Vec<(Update, Vec<u8>)> {
    let mut updates = Vec::new();
    for &byte in bytes {
        link.receive(byte, now);
        updates.extend(drain(link, now));
    }
    updates
}

fn drain<const N: usize>(link: &mut Link<N>, now: Millis) -> Vec<(Update, Vec<u8>)> {
    let mut updates = Vec::new();
    while let Some(update) = link.poll(now) {
        let payload = if matches!(update, Update::Noise(_) | Update::TimedOut) {
            Vec::new()
        } else {
            link.frame().payload.to_vec()
        };
        updates.push((update, payload));
    }
    updates
}

/// What was sent, taken out of the output.
fn sent<const N: usize>(link: &mut Link<N>) -> Vec<u8> {
    let bytes = link.output().to_vec();
    link.sent(bytes.len());
    bytes
}

#[test]
fn an_answer_is_matched_by_what_it_repeats() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&ReadParams3 { profile_id: 1.into() }, 0).unwrap();
    assert_eq!(sent(&mut link), frame(Version::V2, ReadParams3::ID, &[1]));
    let other = frame(Version::V2, ReadParams3::ID, &[0; 134]);
    assert_eq!(feed(&mut link, &other, 1), [(Update::Message, vec![0; 134])]);
    let mut payload = [0; 134];
    payload[0] = 1;
    let answer = frame(Version::V2, ReadParams3::ID, &payload);
    assert_eq!(feed(&mut link, &answer, 2), [(Update::Answer, payload.to_vec())]);
    assert!(!link.is_waiting());
    assert_eq!(feed(&mut link, &answer, 3), [(Update::Message, payload.to_vec())], "nobody asked again");
}

#[test]
fn samples_of_a_stream_come_between_request_and_answer() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&BoardInfoRequest {}, 0).unwrap();
    let bytes = [
        frame(Version::V2, Angles::ID, &[7; 18]),
        frame(Version::V2, BoardInfo::ID, &[36; 18]),
        frame(Version::V2, Angles::ID, &[8; 18]),
    ]
    .concat();
    let updates = feed(&mut link, &bytes, 5);
    assert_eq!(
        updates.iter().map(|(update, _)| *update).collect::<Vec<_>>(),
        [Update::Message, Update::Answer, Update::Message]
    );
    assert_eq!((&updates[0].1[..], &updates[2].1[..]), (&[7; 18][..], &[8; 18][..]));
}

#[test]
fn one_request_waits_at_a_time() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&GetAngles {}, 0).unwrap();
    assert_eq!(link.request(&GetAngles {}, 0), Err(SendError::Busy));
    link.cancel();
    link.request(&GetAngles {}, 0).unwrap();
    assert!(link.is_waiting());
}

#[test]
fn four_bytes_of_noise_cost_a_gap_and_not_the_answer() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&GetAngles {}, 0).unwrap();
    // They announce 200 bytes, in which the answer disappears until the line is silent.
    let bytes = [&[0x24, 0x20, 0xC8, 0xE8][..], &frame(Version::V2, Angles::ID, &[1; 18])].concat();
    assert_eq!(feed(&mut link, &bytes, 3), []);
    assert_eq!(link.deadline(), Some(23));
    assert_eq!(drain(&mut link, 22), []);
    let updates = drain(&mut link, 23);
    assert!(matches!(updates[0].0, Update::Noise(Skipped { at: 0, length: 1, .. })));
    assert_eq!(updates.last(), Some(&(Update::Answer, vec![1; 18])));
}

#[test]
fn a_read_is_repeated_and_then_given_up() {
    let settings = Settings { versions: Versions::Only(Version::V1), ..Settings::DEFAULT };
    let mut link = Small::new(settings);
    link.request(&GetAngles {}, 1000).unwrap();
    let request = frame(Version::V1, GetAngles::ID, &[]);
    for attempt in 1..=3 {
        assert_eq!(sent(&mut link), request, "attempt {attempt}");
        assert_eq!(link.deadline(), Some(1000 + 200 * attempt));
        assert_eq!(drain(&mut link, 1000 + 200 * attempt - 1), []);
        let expected = if attempt < 3 { vec![] } else { vec![(Update::TimedOut, vec![])] };
        assert_eq!(drain(&mut link, 1000 + 200 * attempt), expected);
    }
    assert_eq!((link.deadline(), link.output()), (None, &[][..]));
}

#[test]
fn what_acts_is_sent_once() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&MotorsOn {}, 0).unwrap();
    sent(&mut link);
    assert_eq!(drain(&mut link, 200), [(Update::TimedOut, vec![])]);
    assert!(link.output().is_empty());
}

#[test]
fn a_board_that_knows_version_1_only_is_found() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&BoardInfoRequest {}, 0).unwrap();
    assert_eq!(sent(&mut link), frame(Version::V2, BoardInfo::ID, &[]));
    assert_eq!(drain(&mut link, 200), []);
    assert_eq!(sent(&mut link), frame(Version::V1, BoardInfo::ID, &[]));
    let answer = frame(Version::V1, BoardInfo::ID, &[30; 18]);
    assert_eq!(feed(&mut link, &answer, 205), [(Update::Answer, vec![30; 18])]);
    assert_eq!((link.version(), link.is_settled()), (Version::V1, true));

    // From now on a lost frame changes nothing about that.
    link.request(&GetAngles {}, 300).unwrap();
    sent(&mut link);
    assert_eq!(drain(&mut link, 500), []);
    assert_eq!(sent(&mut link), frame(Version::V1, GetAngles::ID, &[]));
}

#[test]
fn a_board_that_was_heard_in_version_2_keeps_it() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&BoardInfoRequest {}, 0).unwrap();
    feed(&mut link, &frame(Version::V2, BoardInfo::ID, &[36; 18]), 4);
    sent(&mut link);
    link.request(&GetAngles {}, 10).unwrap();
    sent(&mut link);
    assert_eq!(drain(&mut link, 210), []);
    assert_eq!(sent(&mut link), frame(Version::V2, GetAngles::ID, &[]));
}

#[test]
fn a_refusal_ends_the_request_that_it_names() {
    let mut link = Small::new(Settings::DEFAULT);
    link.request(&BoardInfo3Request {}, 0).unwrap();
    let id = BoardInfo3Request::ID.raw();
    let other = frame(Version::V2, Error::ID, &[id ^ 1, 3]);
    assert_eq!(feed(&mut link, &other, 1), [(Update::Message, vec![id ^ 1, 3])]);
    let refusal = frame(Version::V2, Error::ID, &[id, 3]);
    assert_eq!(feed(&mut link, &refusal, 2), [(Update::Refused, vec![id, 3])]);
    assert!(!link.is_waiting());
}

#[test]
fn the_clock_may_overflow() {
    let start = Millis::MAX - 100;
    let mut link = Small::new(Settings { attempts: 1, ..Settings::DEFAULT });
    link.request(&GetAngles {}, start).unwrap();
    assert_eq!(drain(&mut link, start.wrapping_add(199)), []);
    assert_eq!(drain(&mut link, start.wrapping_add(200)), [(Update::TimedOut, vec![])]);
}

#[test]
fn a_full_output_takes_no_more_and_loses_nothing() {
    let mut link = Link::<16>::new(Settings::DEFAULT);
    link.send(&GetAngles {}).unwrap();
    link.send(&GetAngles {}).unwrap();
    assert!(matches!(link.send(&GetAngles {}), Err(SendError::Encode(EncodeError::Frame(_)))));
    let two = [frame(Version::V2, GetAngles::ID, &[]), frame(Version::V2, GetAngles::ID, &[])].concat();
    assert_eq!(link.output(), two);
    link.sent(5);
    assert_eq!(link.output(), &two[5..]);
    link.sent(100);
    link.send(&GetAngles {}).unwrap();
    assert_eq!(link.output(), &two[..6]);
}

#[test]
fn bytes_behind_a_frame_wait_for_their_turn() {
    let mut queue = heapless::spsc::Queue::<u8, 64>::new();
    let (mut interrupt, mut received) = queue.split();
    let confirm = frame(Version::V1, Confirm::ID, &[77]);
    for byte in [&confirm[..], &confirm, b"\xFF"].concat() {
        interrupt.enqueue(byte).unwrap();
    }
    let mut link = Small::new(Settings::DEFAULT);
    let mut updates = Vec::new();
    while let Some(update) = link.poll_queue(&mut received, 0) {
        updates.push(update);
    }
    assert_eq!(updates[..2], [Update::Message; 2]);
    assert!(matches!(updates[2], Update::Noise(_)));
    assert_eq!(updates.len(), 3);
}
