//! What happens, and what must hold after each step.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use bytes::Bytes;
use sbgc_host::machine::{
    Call, Failure, Identity, LinkState, Machine, Priority, Queue, Sample, Setup, Shape, StreamCall, Waiter,
};
use sbgc_host::proto::frame::{Decoder, Event, Version, Versions};
use sbgc_host::proto::{CommandId, Expected};
use sbgc_host::sim::{Board, Config, Fault};

use crate::line::{Dice, Line};

const MS: fn(u64) -> Duration = Duration::from_millis;
const MOTORS_ON: u8 = 77;
const MOTORS_OFF: u8 = 109;
const CONTROL: u8 = 67;
const EEPROM_READ: u8 = 48;
const READ_PARAMS_3: u8 = 21;
const GET_ANGLES: u8 = 73;
const REALTIME_4: u8 = 25;
const REALTIME_3: u8 = 23;

/// Outcomes by the number of the asker.
type Told = Rc<RefCell<Vec<(usize, Result<Bytes, Failure>)>>>;

struct Asker {
    number: usize,
    gone: Rc<Cell<bool>>,
    told: Told,
}

impl Waiter for Asker {
    fn is_gone(&self) -> bool {
        self.gone.get()
    }

    fn tell(self, outcome: Result<Bytes, Failure>) {
        self.told.borrow_mut().push((self.number, outcome));
    }
}

/// What was asked, and what is known of it.
struct Asked {
    command: u8,
    payload: Vec<u8>,
    called: Duration,
    deadline: Duration,
    /// When a frame with these bytes first went out after the call.
    first_written: Option<Duration>,
    gone: Rc<Cell<bool>>,
    told: bool,
    urgent: bool,
}

/// One of those who use the link side by side.
enum Task {
    Idle {
        until: Duration,
    },
    Waits {
        asked: usize,
        cancels: Duration,
    },
    Listens {
        asked: usize,
        number: u64,
        queue: Arc<Queue>,
        until: Duration,
        since: Duration,
        interval: Duration,
        interrupted: bool,
    },
}

pub(crate) struct World {
    dice: Dice,
    now: Duration,
    machine: Machine<Asker>,
    board: Board,
    to_board: Line,
    to_host: Line,
    /// How much longer than usual nothing happens.
    scale: u32,
    /// Each way, without what the board needs.
    latency: Duration,
    faults: u64,
    tasks: Vec<Task>,
    asked: Vec<Asked>,
    told: Told,
    outgoing: Decoder,
    incoming: Decoder,
    /// How many samples of streams the board has sent.
    samples: u64,
    written: HashMap<u8, u64>,
    calls: HashMap<u8, u64>,
    newest_setpoint: u8,
    stalled_until: Duration,
    next_fault: Duration,
    unplugged: Option<Duration>,
    /// When the board sent what came last.
    last_sent: Duration,
    end: Duration,
}

impl World {
    pub(crate) fn new(seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        let latency = match dice.below(4) {
            0 => Duration::ZERO,
            1 => dice.millis(20),
            2 => dice.millis(300),
            _ => dice.millis(1000),
        };
        let timeout = MS(500) + latency * 3;
        let baud = dice.percent(50).then_some(115_200);
        let setup = Setup { baud, timeout, ..Setup::default() };
        let mut machine = Machine::new(setup);
        let identity = Identity { command: CommandId::BoardInfo3.raw(), front: Bytes::new() };
        machine.set_identity(identity);
        let tasks = 1 + dice.below(32);
        let scale = [1, 1, 1, 5][usize::try_from(dice.below(4)).unwrap()];
        let end = Duration::from_secs(30 + dice.below(300)) * scale;
        let faults = if dice.percent(70) { dice.below(3) } else { 0 };
        Self {
            board: Board::new(Config { bit_rate: baud, ..Config::default() }),
            tasks: (0..tasks)
                .map(|_| Task::Idle { until: Duration::from_secs(4) + dice.millis(5000) })
                .collect(),
            now: Duration::ZERO,
            to_board: Line::default(),
            to_host: Line::default(),
            asked: Vec::new(),
            told: Told::default(),
            outgoing: Decoder::new(Versions::Both),
            incoming: Decoder::new(Versions::Both),
            samples: 0,
            written: HashMap::new(),
            calls: HashMap::new(),
            newest_setpoint: 0,
            stalled_until: Duration::ZERO,
            next_fault: if dice.percent(60) {
                Duration::from_secs(5 + dice.below(60))
            } else {
                Duration::MAX
            },
            unplugged: None,
            last_sent: Duration::ZERO,
            dice,
            machine,
            scale,
            latency,
            faults,
            end,
        }
    }

    /// Lets it all happen; returns how long it took in there.
    pub(crate) fn run(mut self) -> Duration {
        // What the latency is must be known before anything is asked whose answers nothing tells apart.
        let faults = std::mem::take(&mut self.faults);
        self.ask(CommandId::BoardInfo.raw(), &[], CommandId::BoardInfo.raw(), 3, Some(Version::V2));
        self.until(Duration::from_secs(4), |world| world.asked.iter().all(|asked| asked.told));
        self.faults = faults;
        let end = self.end;
        self.until(end, |_| false);
        if self.dice.percent(50) {
            self.leave();
        }
        self.close();
        self.now
    }

    /// All leave while nothing gets through to the board, which must not keep it from learning of it.
    fn leave(&mut self) {
        self.next_fault = Duration::MAX;
        let outage = self.now + self.dice.millis(8000);
        if self.dice.percent(50) {
            self.stalled_until = outage;
        } else {
            self.faults = 100;
        }
        for task in std::mem::take(&mut self.tasks) {
            match task {
                Task::Listens { asked, number, .. } => {
                    self.asked[asked].gone.set(true);
                    self.machine.leave(number);
                }
                Task::Waits { asked, .. } => self.asked[asked].gone.set(true),
                Task::Idle { .. } => {}
            }
        }
        self.until(outage, |_| false);
        self.come_up();
        // The longest pause between two attempts, and an attempt.
        let ended = self.now + Duration::from_secs(7) + (MS(500) + self.latency * 3) * 3;
        self.until(ended, |_| false);
        self.check_quiet("nobody listens any more");
    }

    /// Nothing goes wrong any more, and the link is there.
    fn come_up(&mut self) {
        (self.faults, self.next_fault) = (0, Duration::MAX);
        self.stalled_until = self.now;
        let up = self.now + Duration::from_mins(1);
        self.until(up, |world| world.machine.state() == LinkState::Open && world.unplugged.is_none());
        // A board that was just reset listens again.
        let ready = self.now + Duration::from_secs(3) + self.latency * 4;
        self.until(ready, |_| false);
    }

    fn check_quiet(&mut self, since: &str) {
        let samples = self.samples;
        let later = self.now + Duration::from_secs(5);
        self.until(later, |_| false);
        assert_eq!(self.samples, samples, "a stream is left on the board: {since}");
    }

    /// Whoever owns the motion stops it; then nothing may be left.
    fn close(&mut self) {
        self.come_up();
        // Nothing that was to move it goes out after what stops it, however far it has come.
        self.machine.set(self.now, CONTROL, Bytes::from_static(&[1; 15])).unwrap();
        if self.dice.percent(50) {
            self.machine.pending(self.now);
        }
        self.machine.send_now(self.now, CONTROL, Bytes::from_static(&[0xEE; 15])).unwrap();
        self.machine.close(self.now);
        let began = self.now;
        self.check_told();
        self.until(began + Duration::from_secs(6), |world| world.machine.is_done(world.now));
        assert!(self.machine.is_done(self.now), "closing takes too long");
        let waits = self.asked.iter().find(|asked| !asked.told && !asked.gone.get());
        assert!(waits.is_none(), "command {} goes on waiting", waits.map_or(0, |asked| asked.command));
        self.tasks.clear();
        self.machine.closed_port();
        let quiet = self.now + Duration::from_secs(3) + self.latency * 4;
        self.until(quiet, |_| false);
        assert_eq!(self.newest_setpoint, 0xEE, "the stop went out, and nothing that moves after it");
        self.check_quiet("the link was closed");
    }

    fn until(&mut self, end: Duration, done: impl Fn(&Self) -> bool) {
        let mut turns = 0;
        while self.now < end && !done(self) {
            let before = self.now;
            self.step(end);
            turns = if self.now > before { 0 } else { turns + 1 };
            assert!(
                turns < 10_000,
                "time stands still at {:?}, next {:?}, {:?}",
                self.now,
                self.machine.next_wake(self.now),
                self.board.next_event()
            );
        }
    }

    fn step(&mut self, end: Duration) {
        let tasks = self.tasks.iter().map(|task| match task {
            Task::Idle { until } | Task::Listens { until, .. } => *until,
            Task::Waits { cancels, .. } => *cancels,
        });
        let stalled = Some(self.stalled_until).filter(|until| *until > self.now);
        let times = [
            self.machine.next_wake(self.now),
            self.board.next_event(),
            self.to_board.next(),
            self.to_host.next(),
            Some(self.next_fault),
            self.unplugged,
            stalled,
        ];
        let next = times.into_iter().flatten().chain(tasks).min().unwrap_or(end);
        self.now = next.clamp(self.now, end);
        let now = self.now;
        while let Some(piece) = self.to_board.take(now) {
            self.board.receive(now, &piece.bytes);
        }
        self.board.advance(now);
        let output = self.board.take_output();
        let mut bytes = &output[..];
        while let Some(event) = self.incoming.next(&mut bytes) {
            let sample = |id| matches!(id, REALTIME_3 | REALTIME_4);
            self.samples += u64::from(matches!(event, Event::Frame { frame, .. } if sample(frame.id)));
        }
        if !output.is_empty() && self.unplugged.is_none() {
            let jitter = self.dice.millis(1 + u64::try_from(self.latency.as_millis() / 4).unwrap());
            self.to_host.send(now, self.latency + jitter, &output, self.faults, &mut self.dice);
        }
        while let Some(piece) = self.to_host.take(now) {
            self.last_sent = piece.sent;
            self.machine.receive(now, &piece.bytes);
            self.check_told();
        }
        self.break_something();
        for index in 0..self.tasks.len() {
            self.go_on(index);
        }
        self.write();
        self.check_told();
        self.check();
    }

    /// The port takes what it takes.
    fn write(&mut self) {
        let now = self.now;
        loop {
            let pending = self.machine.pending(now);
            if pending.is_empty() || now < self.stalled_until || self.unplugged.is_some() {
                return;
            }
            let whole = pending.len() as u64;
            let count = if self.dice.percent(80) { whole } else { 1 + self.dice.below(whole) };
            let bytes = pending[..usize::try_from(count).unwrap()].to_vec();
            self.machine.written(now, bytes.len());
            self.to_board.send(now, self.latency, &bytes, self.faults, &mut self.dice);
            let mut rest = &bytes[..];
            let mut outgoing = std::mem::take(&mut self.outgoing);
            while let Some(event) = outgoing.next(&mut rest) {
                let Event::Frame { frame, .. } = event else {
                    panic!("what was sent is not a frame: {event:?}")
                };
                self.on_written(frame.id, frame.payload);
            }
            self.outgoing = outgoing;
        }
    }

    fn on_written(&mut self, command: u8, payload: &[u8]) {
        *self.written.entry(command).or_default() += 1;
        if command == CONTROL {
            self.newest_setpoint = payload[0];
        }
        for asked in self.asked.iter_mut().rev().take(200) {
            if !asked.told && asked.command == command && asked.payload == payload {
                asked.first_written.get_or_insert(self.now);
            }
        }
        // What must not be carried out twice is not sent twice.
        for command in [MOTORS_ON, MOTORS_OFF] {
            let (written, calls) = (self.written.get(&command), self.calls.get(&command));
            assert!(written.unwrap_or(&0) <= calls.unwrap_or(&0), "command {command} was sent twice");
        }
    }

    fn break_something(&mut self) {
        if self.unplugged.is_some_and(|until| until <= self.now) {
            self.unplugged = None;
            self.outgoing = Decoder::new(Versions::Both);
            self.machine.up(self.now);
        }
        if self.machine.trouble().is_some() && self.unplugged.is_none() {
            self.unplug(MS(500));
        }
        if self.now < self.next_fault {
            return;
        }
        self.next_fault = self.now + Duration::from_secs(10 + self.dice.below(60)) * self.scale;
        match self.dice.below(3) {
            0 => self.stalled_until = self.now + self.dice.millis(8000),
            1 => self.board.inject(Fault::Reset { at: self.now }),
            _ if self.unplugged.is_none() => {
                let time = MS(100) + self.dice.millis(5000);
                self.unplug(time);
            }
            _ => {}
        }
    }

    fn unplug(&mut self, time: Duration) {
        self.unplugged = Some(self.now + time);
        self.to_board.pieces.clear();
        self.to_host.pieces.clear();
        self.machine.down(self.now);
    }

    fn ask(
        &mut self,
        command: u8,
        payload: &[u8],
        answer: u8,
        attempts: u32,
        probe: Option<Version>,
    ) -> usize {
        let (number, gone) = (self.asked.len(), Rc::new(Cell::new(false)));
        let expected = if answer == CONTROL {
            Expected::confirmation(command.into())
        } else {
            Expected::of_payload(command.into(), payload).expect("a request")
        };
        let timeout = MS(300) + self.latency * 3 + self.dice.millis(400);
        let priority = Priority::of(command, payload);
        let payload_bytes = Bytes::copy_from_slice(payload);
        let call = Call {
            command,
            payload: payload_bytes,
            expected,
            shape: None,
            timeout,
            attempts,
            priority,
            probe,
        };
        let hurried = if probe.is_some() { MS(400) } else { Duration::ZERO };
        let deadline = self.now + timeout * attempts + hurried;
        let (payload, urgent) = (payload.to_vec(), priority == Priority::Urgent);
        let asked = Asked {
            command,
            payload,
            called: self.now,
            deadline,
            first_written: None,
            gone: Rc::clone(&gone),
            told: false,
            urgent,
        };
        self.asked.push(asked);
        *self.calls.entry(command).or_default() += 1;
        self.machine.request(self.now, call, Asker { number, gone, told: Rc::clone(&self.told) });
        number
    }

    /// What a task does when its time has come.
    fn go_on(&mut self, index: usize) {
        let now = self.now;
        match &mut self.tasks[index] {
            Task::Waits { asked, cancels } => {
                let (told, cancelled) = (self.asked[*asked].told, *cancels <= now);
                if !told && !cancelled {
                    return;
                }
                self.asked[*asked].gone.set(true);
                self.tasks[index] = Task::Idle { until: now + self.pause() };
            }
            Task::Listens { asked, number, queue, until, since, interval, interrupted } => {
                let mut ended = false;
                while let Poll::Ready(sample) = queue.poll(&mut Context::from_waker(Waker::noop())) {
                    *since = now;
                    *interrupted = matches!(sample, Some(Sample::Interrupted(_)));
                    ended = sample.is_none();
                    if ended {
                        break;
                    }
                }
                // Whoever listens gets samples, or learns that none come.
                let allowed = (*interval * 3).max(MS(250)) * 2 + self.latency * 16 + MS(9000);
                assert!(
                    *interrupted || now < *since + allowed,
                    "nothing was heard of a stream since {since:?}"
                );
                if ended || *until <= now {
                    self.asked[*asked].gone.set(true);
                    self.machine.leave(*number);
                    self.tasks[index] = Task::Idle { until: now + self.pause() };
                }
            }
            Task::Idle { until } if *until <= now => self.tasks[index] = self.act(),
            Task::Idle { .. } => {}
        }
    }

    fn pause(&mut self) -> Duration {
        match self.dice.below(10) {
            0 => Duration::from_secs(self.dice.below(120)) * self.scale,
            1..=3 => Duration::ZERO,
            _ => self.dice.millis(2000) * self.scale,
        }
    }

    fn act(&mut self) -> Task {
        let asked = match self.dice.below(12) {
            0..=2 => {
                let [low, high, ..] = (self.dice.below(64) * 64).to_le_bytes();
                self.ask(EEPROM_READ, &[low, high, 0, 0, 64, 0], EEPROM_READ, 3, None)
            }
            3 | 4 => {
                let profile = u8::try_from(self.dice.below(5)).unwrap();
                self.ask(READ_PARAMS_3, &[profile], READ_PARAMS_3, 3, None)
            }
            5 => {
                let attempts = 1 + u32::try_from(self.dice.below(3)).unwrap();
                self.ask(GET_ANGLES, &[], GET_ANGLES, attempts, None)
            }
            6 => self.ask(MOTORS_ON, &[], CONTROL, 1, None),
            7 => self.ask(MOTORS_OFF, &[0], CONTROL, 1, None),
            8 | 9 => {
                for _ in 0..=self.dice.below(5) {
                    let value = u8::try_from(self.dice.below(7)).unwrap();
                    // Refused while the link is down.
                    let _ = self.machine.set(self.now, CONTROL, Bytes::copy_from_slice(&[value; 15]));
                }
                return Task::Idle { until: self.now + self.pause() };
            }
            _ => return self.subscribe(),
        };
        let cancels = if self.dice.percent(20) { self.now + self.dice.millis(1500) } else { Duration::MAX };
        Task::Waits { asked, cancels }
    }

    fn subscribe(&mut self) -> Task {
        let command = if self.dice.percent(50) { REALTIME_4 } else { REALTIME_3 };
        let interval_ms = if command == REALTIME_4 { 200 } else { 1000 };
        let shape = Shape::new(command.into(), [0; 8]);
        let (asked, gone) = (self.asked.len(), Rc::new(Cell::new(false)));
        let deadline = self.now + Duration::from_hours(1);
        let payload = Vec::new();
        let (called, first_written) = (self.now, Some(self.now));
        self.asked.push(Asked {
            command: 85,
            payload,
            called,
            deadline,
            first_written,
            gone: Rc::clone(&gone),
            told: false,
            urgent: false,
        });
        let waiter = Asker { number: asked, gone, told: Rc::clone(&self.told) };
        let call = StreamCall { shape, interval_ms, synced: false, capacity: 64 };
        let (number, queue) = self.machine.subscribe(call, waiter);
        let until = self.now + self.dice.millis(20_000);
        let interval = MS(interval_ms.into());
        Task::Listens { asked, number, queue, until, since: self.now, interval, interrupted: false }
    }

    /// Whoever was told something was told once, in time, and the right thing.
    fn check_told(&mut self) {
        for (number, outcome) in self.told.take() {
            let asked = &mut self.asked[number];
            assert!(!asked.told, "told twice");
            asked.told = true;
            assert!(
                self.now <= asked.deadline,
                "told at {:?}, the deadline was {:?}",
                self.now,
                asked.deadline
            );
            let Ok(answer) = outcome else { continue };
            if asked.command == 85 {
                continue;
            }
            let sent = self.last_sent;
            let written = asked.first_written.expect("answers come after the request");
            assert!(asked.called <= written);
            // Confirmations of the same urgent command are counted off only.
            if !asked.urgent {
                assert!(
                    sent >= written + self.latency,
                    "command {} of {written:?} got an answer of {sent:?}",
                    asked.command
                );
            }
            match asked.command {
                EEPROM_READ => assert_eq!(answer[..4], asked.payload[..4]),
                READ_PARAMS_3 => assert_eq!(answer[0], asked.payload[0]),
                MOTORS_ON | MOTORS_OFF => assert_eq!(answer[0], asked.command),
                _ => {}
            }
        }
    }

    fn check(&self) {
        assert_eq!(self.board.counters().lost, 0, "the board's input buffer overflowed at {:?}", self.now);
        let overdue = self
            .asked
            .iter()
            .rev()
            .take(200)
            .find(|asked| !asked.told && !asked.gone.get() && asked.deadline < self.now);
        assert!(
            overdue.is_none(),
            "command {} outlived its deadline",
            overdue.map_or(0, |asked| asked.command)
        );
    }
}
