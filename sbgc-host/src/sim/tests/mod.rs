//! The board, driven by a clock of its own and over streams.

mod control;
mod every_command;
mod every_payload;
mod faults;
mod line;
mod memory;
mod moves;
mod parameters;
mod ports;
mod procedures;
mod remote;
mod sensors;
mod serving;
mod shaping;
mod startup;
mod storage;
mod streams;
mod variables;

use std::time::Duration;

use sbgc_proto::Message;
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, Versions, encode_into};
use sbgc_proto::wire::{FromWire, ToWire};

use super::{Board, Config, POLL};

pub(super) const fn ms(count: u64) -> Duration {
    Duration::from_millis(count)
}

/// A message from the board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Got {
    pub(super) version: Version,
    pub(super) id: u8,
    pub(super) payload: Vec<u8>,
}

impl Got {
    pub(super) fn decoded<'a, M: Message + FromWire<'a>>(&'a self) -> M {
        assert_eq!(self.id, M::ID.raw(), "{self:?}");
        M::decode(&self.payload).unwrap()
    }
}

/// A host that talks to a board in a time of its own.
pub(super) struct Bench {
    pub(super) board: Board,
    pub(super) now: Duration,
    pub(super) version: Version,
    decoder: Decoder,
}

impl Bench {
    pub(super) fn new(config: Config) -> Self {
        Self::of(Board::new(config))
    }

    pub(super) fn of(board: Board) -> Self {
        Self { board, now: ms(1), version: Version::V1, decoder: Decoder::new(Versions::Both) }
    }

    pub(super) fn send_raw(&mut self, id: u8, payload: &[u8]) {
        let mut buffer = [0; MAX_FRAME];
        let frame = encode_into(self.version, id, payload, &mut buffer).unwrap();
        self.board.receive(self.now, frame);
    }

    pub(super) fn send<M: Message + ToWire>(&mut self, message: &M) {
        let mut buffer = [0; 255];
        self.send_raw(M::ID.raw(), message.encode(&mut buffer).unwrap());
    }

    /// What the board says in this time.
    pub(super) fn run(&mut self, time: Duration) -> Vec<Got> {
        self.now += time;
        let mut got = Vec::new();
        loop {
            let until = self.board.next_event().map_or(self.now, |event| event.min(self.now));
            self.board.advance(until);
            let output = self.board.take_output();
            let mut chunk = &output[..];
            while let Some(event) = self.decoder.next(&mut chunk) {
                let Event::Frame { frame, .. } = event else { panic!("the board sent garbage: {event:?}") };
                got.push(Got { version: frame.version, id: frame.id, payload: frame.payload.to_vec() });
            }
            if until == self.now {
                return got;
            }
        }
    }

    /// What the board says to this within one turn of its queue.
    pub(super) fn ask<M: Message + ToWire>(&mut self, message: &M) -> Vec<Got> {
        self.send(message);
        self.run(POLL)
    }

    /// The only thing that the board says to this.
    pub(super) fn ask_one<M: Message + ToWire>(&mut self, message: &M) -> Got {
        let mut got = self.ask(message);
        assert_eq!(got.len(), 1, "{got:?}");
        got.remove(0)
    }
}
