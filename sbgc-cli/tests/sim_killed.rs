//! A simulated board that is killed while it saves its state.
#![cfg(unix)]

mod common;

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;

use common::sbgc;

/// How often it is killed.
const KILLS: u64 = 40;

const CONFIRM: u8 = 67;
const WRITE_EXTERNAL_DATA: u8 = 41;
const READ_EXTERNAL_DATA: u8 = 42;

/// A served board with a client.
struct Served {
    child: Child,
    line: TcpStream,
}

impl Served {
    fn start(state: &Path) -> Self {
        let mut command = sbgc();
        command.args(["sim", "--tcp", "127.0.0.1:0", "--state"]).arg(state);
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        let line = TcpStream::connect(first.trim().trim_start_matches("tcp://")).unwrap();
        Self { child, line }
    }

    fn send(&mut self, id: u8, payload: &[u8]) {
        let length = u8::try_from(payload.len()).unwrap();
        let sum = payload.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        let header = [0x3E, id, length, id.wrapping_add(length)];
        self.line.write_all(&[&header[..], payload, &[sum]].concat()).unwrap();
    }

    /// The next message, if it begins within this time.
    fn receive(&mut self, patience: Duration) -> Option<(u8, Vec<u8>)> {
        let mut header = [0; 4];
        self.line.set_read_timeout(Some(patience)).unwrap();
        self.line.read_exact(&mut header[..1]).ok()?;
        self.line.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        self.line.read_exact(&mut header[1..]).unwrap();
        let mut rest = vec![0; usize::from(header[2]) + 1];
        self.line.read_exact(&mut rest).unwrap();
        rest.pop();
        Some((header[1], rest))
    }

    fn data(&mut self) -> Vec<u8> {
        self.send(READ_EXTERNAL_DATA, &[]);
        let (id, data) = self.receive(Duration::from_secs(20)).expect("it answers");
        assert_eq!(id, READ_EXTERNAL_DATA);
        data
    }

    fn kill(mut self) {
        // SIGKILL on Unix.
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}

#[test]
fn a_board_that_is_killed_at_any_moment_has_the_old_state_or_the_new_one() {
    let directory = tempfile::tempdir().unwrap();
    let state = directory.path().join("state");
    let mut served = Served::start(&state);
    let mut random = 0x2545_F491_4F6C_DD1D_u64;
    let (mut fill, mut cut_short) = (0_u8, 0);
    for kill in 0..KILLS {
        // It writes again and again until a confirmation takes longer than it may this time.
        let mut saved = served.data()[0];
        loop {
            fill = fill.wrapping_add(1);
            served.send(WRITE_EXTERNAL_DATA, &[fill; 128]);
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let patience = Duration::from_micros(1 + (random >> 32) % 20_000);
            match served.receive(patience) {
                Some((CONFIRM, _)) => saved = fill,
                Some(other) => panic!("{other:?}"),
                None => break,
            }
        }
        served.kill();
        served = Served::start(&state);
        let data = served.data();
        assert!(data.iter().all(|byte| *byte == data[0]), "kill {kill}: a mixture: {data:?}");
        assert!(data[0] == saved || data[0] == fill, "kill {kill}: {} of {saved} and {fill}", data[0]);
        cut_short += u32::from(data[0] == saved);
    }
    served.kill();
    assert!(cut_short > 0, "some come before it is saved");
}
