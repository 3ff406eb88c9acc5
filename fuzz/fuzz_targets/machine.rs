//! The driver's machine under any order of calls, with the invariants of the deterministic simulation: everybody is told
//! exactly once and in time, and an answer that fits; what acts is not sent twice; what goes out are whole frames, no
//! more at a time than the board's input buffer holds; nothing that moves goes out after what stops it; and it sleeps.
#![no_main]

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;
use std::time::Duration;

use bytes::Bytes;
use libfuzzer_sys::fuzz_target;
use sbgc_host::machine::{Call, Failure, Machine, Priority, Setup, Shape, StreamCall, Waiter};
use sbgc_proto::frame::{BOARD_BUFFER, Decoder, Event, Versions};
use sbgc_proto::{CommandId, Expected};

/// How long each attempt may take.
const TIMEOUT: Duration = Duration::from_millis(500);

/// How often the board reads its input.
const CYCLE: Duration = Duration::from_millis(8);

/// The longest time that the end of a link may take.
const LONGEST_FLUSH: Duration = Duration::from_secs(5);

const CONTROL: u8 = 67;
const MOTORS: [u8; 2] = [77, 109];

/// The first byte of a set-point that stops; no other begins with it.
const STOP: u8 = 0xEE;

type Told = Rc<RefCell<Vec<(usize, Result<Bytes, Failure>)>>>;

struct Asker {
    number: usize,
    gone: bool,
    told: Told,
}

impl Waiter for Asker {
    fn is_gone(&self) -> bool {
        self.gone
    }

    fn tell(self, outcome: Result<Bytes, Failure>) {
        self.told.borrow_mut().push((self.number, outcome));
    }
}

/// Somebody who has asked for something.
struct Asked {
    expected: Option<Expected>,
    /// Until when an outcome has to be told; `None` if nobody waits for it.
    deadline: Option<Duration>,
    told: bool,
}

struct World {
    machine: Machine<Asker>,
    now: Duration,
    told: Told,
    asked: Vec<Asked>,
    calls: BTreeMap<u8, usize>,
    written: BTreeMap<u8, usize>,
    outgoing: Decoder,
    /// What went out within a cycle of the board.
    recent: VecDeque<(Duration, usize)>,
    /// Whether the last command that moves or stops was one that stops.
    stops: bool,
    /// Whether the port had begun with a frame before that.
    begun: bool,
}

impl World {
    fn asker(&mut self, gone: bool, expected: Option<Expected>, deadline: Duration) -> Asker {
        let deadline = (!gone).then_some(deadline);
        self.asked.push(Asked { expected, deadline, told: false });
        Asker { number: self.asked.len() - 1, gone, told: Rc::clone(&self.told) }
    }

    fn request(&mut self, value: u8) {
        let (command, attempts) =
            ([21, 48, 73, 77, 86, 109][usize::from(value) % 6], 1 + u32::from(value % 3));
        let payload = Bytes::copy_from_slice(&[value % 4; 6]);
        let id = CommandId::from_raw(command);
        // What acts is sent once.
        let attempts = if MOTORS.contains(&command) { 1 } else { attempts };
        let expected = Expected::of_payload(id, &payload).unwrap_or(Expected::confirmation(id));
        let priority = Priority::of(command, &payload);
        let (timeout, shape, probe) = (TIMEOUT, None, None);
        let asker = self.asker(value % 7 == 6, Some(expected), self.now + TIMEOUT * attempts);
        *self.calls.entry(command).or_default() += 1;
        let call = Call { command, payload, expected, shape, timeout, attempts, priority, probe };
        self.machine.request(self.now, call, asker);
    }

    fn subscribe(&mut self, value: u8) {
        let command = CommandId::from_raw([23, 25, 88][usize::from(value) % 3]);
        let shape = Shape::new(command, [0; 8]);
        let call = StreamCall { shape, interval_ms: 20, synced: value % 3 == 0, capacity: 4 };
        // Streams that take turns may take long; leaving gives up waiting.
        let asker = self.asker(value % 2 == 0, None, Duration::MAX);
        let (number, _) = self.machine.subscribe(call, asker);
        if value % 2 == 0 {
            self.machine.leave(number);
        }
    }

    fn set(&mut self, value: u8) {
        if self.machine.set(self.now, CONTROL, Bytes::copy_from_slice(&[value % 7; 15])).is_ok() {
            self.stops = false;
        }
    }

    fn stop(&mut self) {
        if self.machine.send_now(self.now, CONTROL, Bytes::copy_from_slice(&[STOP; 15])).is_ok() {
            (self.stops, self.begun) = (true, self.outgoing.pending() > 0);
        }
    }

    /// The port takes so many bytes.
    fn write(&mut self, most: usize) {
        let pending = self.machine.pending(self.now);
        let bytes = pending[..pending.len().min(most)].to_vec();
        if bytes.is_empty() {
            return;
        }
        self.machine.written(self.now, bytes.len());
        while self.recent.front().is_some_and(|(time, _)| *time + CYCLE <= self.now) {
            self.recent.pop_front();
        }
        self.recent.push_back((self.now, bytes.len()));
        let in_cycle: usize = self.recent.iter().map(|(_, length)| length).sum();
        assert!(in_cycle <= BOARD_BUFFER, "{in_cycle} bytes within a cycle of the board");
        let mut rest = &bytes[..];
        while let Some(event) = self.outgoing.next(&mut rest) {
            let Event::Frame { frame, .. } = event else { panic!("what was sent is not a frame: {event:?}") };
            *self.written.entry(frame.id).or_default() += 1;
            if frame.id == CONTROL && self.stops && !self.begun {
                assert_eq!(frame.payload[0], STOP, "it moves after it was stopped");
            }
            self.begun = false;
        }
        for command in MOTORS {
            let (written, calls) = (self.written.get(&command), self.calls.get(&command));
            assert!(written.unwrap_or(&0) <= calls.unwrap_or(&0), "command {command} was sent twice");
        }
    }

    fn check_told(&mut self) {
        for (number, outcome) in self.told.take() {
            let asked = &mut self.asked[number];
            assert!(!asked.told, "told twice");
            asked.told = true;
            assert!(asked.deadline.is_none_or(|deadline| self.now <= deadline), "told too late");
            if let (Ok(answer), Some(expected)) = (outcome, &asked.expected) {
                assert!(expected.matches(expected.answer(), &answer), "an answer that is not its own");
            }
        }
    }

    fn waits(&self) -> impl Iterator<Item = Duration> {
        let waits = self.asked.iter().filter(|asked| !asked.told);
        waits.filter_map(|asked| asked.deadline).filter(|deadline| *deadline < Duration::MAX)
    }

    fn check(&mut self) {
        let idle = self.machine.pending(self.now).is_empty();
        self.check_told();
        let wake = self.machine.next_wake(self.now);
        assert!(self.waits().all(|deadline| self.now < deadline), "a request outlived its deadline");
        assert!(self.waits().next().is_none() || wake.is_some(), "a deadline has no alarm");
        assert!(wake.is_none_or(|wake| wake > self.now) || !idle, "it does not sleep");
    }
}

fuzz_target!(|steps: &[u8]| {
    let mut world = World {
        machine: Machine::new(Setup::default()),
        now: Duration::ZERO,
        told: Told::default(),
        asked: Vec::new(),
        calls: BTreeMap::new(),
        written: BTreeMap::new(),
        outgoing: Decoder::new(Versions::Both),
        recent: VecDeque::new(),
        stops: false,
        begun: false,
    };
    let mut rest = steps;
    while let [kind, value, following @ ..] = rest {
        rest = following;
        match kind % 9 {
            0 | 1 => world.request(*value),
            2 => drop(world.machine.send(world.now, 89, Bytes::copy_from_slice(&[*value]))),
            3 => world.set(*value),
            4 => world.stop(),
            5 => world.subscribe(*value),
            6 => {
                let (bytes, left) = rest.split_at(usize::from(*value).min(rest.len()));
                rest = left;
                world.machine.receive(world.now, bytes);
            }
            7 => world.write(usize::from(*value)),
            _ => {
                // Time does not pass what the machine waits for.
                let next = world.now + Duration::from_millis(u64::from(*value) * 2);
                while let Some(wake) = world.machine.next_wake(world.now).filter(|wake| *wake < next) {
                    world.now = wake.max(world.now + Duration::from_nanos(1));
                    world.machine.pending(world.now);
                    world.check_told();
                }
                world.now = next.max(world.now);
            }
        }
        world.check();
    }
    world.machine.close(world.now);
    world.check_told();
    let waits = world.asked.iter().find(|asked| !asked.told && asked.deadline.is_some());
    assert!(waits.is_none(), "somebody goes on waiting after the end");
    assert!(world.machine.is_done(world.now + LONGEST_FLUSH), "closing takes too long");
    world.machine.closed_port();
    world.check_told();
});
