//! Any payload of any command in either direction: what can be read is written as it was, its fields cover its bytes
//! one after the other, and nothing panics.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sbgc_proto::reflect::Leaf;
use sbgc_proto::{CommandId, IncomingCommand, OutgoingCommand};

fuzz_target!(|input: (bool, u8, &[u8])| {
    let (outgoing, id, payload) = input;
    let payload = &payload[..payload.len().min(255)];
    let id = CommandId::from_raw(id);
    let mut buffer = [0; 255];
    let mut covered = 0;
    let mut visitor = |leaf: &Leaf<'_>| {
        assert_eq!(leaf.offset, covered, "{}", leaf.path);
        covered += leaf.size;
    };
    let (written, rest) = if outgoing {
        let Ok((message, rest)) = OutgoingCommand::decode(id, payload) else { return };
        message.walk(&mut visitor);
        (message.encode(&mut buffer).expect("what was read can be written"), rest)
    } else {
        let Ok((message, rest)) = IncomingCommand::decode(id, payload) else { return };
        message.walk(&mut visitor);
        (message.encode(&mut buffer).expect("what was read can be written"), rest)
    };
    assert_eq!(covered, written.len());
    assert_eq!([written, rest].concat(), payload);
});
