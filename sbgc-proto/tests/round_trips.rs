//! Every message of the protocol: bytes to value to bytes, and value to bytes to value, at every length.

use proptest::prelude::*;
use sbgc_proto::{CommandId, DecodeError, Direction, IncomingCommand, MessageInfo, OutgoingCommand};

/// Reads a payload, writes what was read, and returns the bytes with what followed the known part.
fn through(direction: Direction, id: CommandId, payload: &[u8]) -> Result<Vec<u8>, DecodeError> {
    let mut buffer = [0; 255];
    match direction {
        Direction::Outgoing => {
            let (message, rest) = OutgoingCommand::decode(id, payload)?;
            let written = message.encode(&mut buffer).expect("what was read can be written").to_vec();
            let (again, _) = OutgoingCommand::decode(id, &written).expect("what was written can be read");
            assert_eq!(again, message, "{message:?}");
            Ok([&written, rest].concat())
        }
        Direction::Incoming => {
            let (message, rest) = IncomingCommand::decode(id, payload)?;
            let written = message.encode(&mut buffer).expect("what was read can be written").to_vec();
            let (again, _) = IncomingCommand::decode(id, &written).expect("what was written can be read");
            assert_eq!(again, message, "{message:?}");
            Ok([&written, rest].concat())
        }
    }
}

fn all() -> impl Iterator<Item = &'static MessageInfo> {
    OutgoingCommand::ALL.iter().chain(IncomingCommand::ALL)
}

/// Bytes with the values at which mistakes show: ends of ranges, NaNs, start bytes.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![
        3 => any::<u8>(),
        2 => prop::sample::select(vec![0, 1, 2, 3, 7, 0x7F, 0x80, 0xFE, 0xFF, b'>', b'$']),
    ];
    prop::collection::vec(byte, 255)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn what_can_be_read_is_written_as_it_was(bytes in bytes()) {
        for info in all() {
            for length in 0..=bytes.len() {
                let payload = &bytes[..length];
                // A payload that a list or condition makes too short is an error; any other comes back.
                if let Ok(written) = through(info.direction, info.id, payload) {
                    prop_assert_eq!(&written, payload, "{} {} of {} bytes", info.spec, info.form, length);
                }
            }
        }
    }
}

#[test]
fn zeros_of_every_declared_length_are_read() {
    let zeros = [0; 255];
    for info in all() {
        for length in info.size.clone().filter(|length| (info.accepts)(*length)) {
            let written = through(info.direction, info.id, &zeros[..length]);
            let written = written.unwrap_or_else(|error| panic!("{} {}: {error}", info.spec, info.form));
            assert_eq!(written, zeros[..length], "{} {}", info.spec, info.form);
        }
    }
}

#[test]
fn too_short_is_an_error_that_says_both_lengths() {
    let zeros = [0; 255];
    for info in all() {
        let shortest = all()
            .filter(|other| (other.id, other.direction) == (info.id, info.direction))
            .map(|other| *other.size.start())
            .min()
            .expect("it is in the list itself");
        for length in 0..shortest {
            match through(info.direction, info.id, &zeros[..length]) {
                Err(DecodeError::TooShort { command, needed, got }) => {
                    assert_eq!((command, got), (info.spec, length));
                    assert!(needed > length);
                }
                Err(
                    DecodeError::NoSuchForm { command, got } | DecodeError::Truncated { command, got, .. },
                ) => {
                    assert_eq!(command, info.spec);
                    assert!(got <= length);
                }
                // Lists may be empty though the protocol never sends them so.
                Ok(written) => assert_eq!(written, zeros[..length], "{}", info.spec),
                Err(error) => panic!("{}: unexpected {error:?}", info.spec),
            }
        }
    }
}

#[test]
fn longer_payloads_keep_what_they_end_in() {
    let ones = [1; 255];
    for info in all() {
        let payload = &ones[..];
        if let Ok(written) = through(info.direction, info.id, payload) {
            assert_eq!(written, payload, "{} {}", info.spec, info.form);
        }
    }
}
