//! The board: its ports, its time, and what it does when.

mod ports;
mod wrong;

use std::collections::VecDeque;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{Confirm, RcSource};
use sbgc_proto::frame::Version;
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, Message};

use super::answers;
use super::config::Config;
use super::eeprom::Eeprom;
use super::faults::Fault;
use super::line::{Line, LineCounters, Received};
use super::machine::{Call, Machine};
use super::motion::Motion;
use super::reply::{Packet, Reply};

/// The board works through its queue once in this time.
pub const POLL: Duration = Duration::from_millis(8);

/// How long the bootloader waits for new firmware before it starts the board again.
const BOOTLOADER: Duration = Duration::from_secs(3);

/// How many commands are remembered.
const REMEMBERED: usize = 64;

/// A command that the board has taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TakenCommand {
    /// When it was carried out.
    pub time: Duration,
    /// The port it came on, counted from 0.
    pub port: u8,
    /// Its id.
    pub id: CommandId,
    /// Its payload.
    pub payload: Vec<u8>,
}

/// One of the board's ports.
#[derive(Debug)]
struct Port {
    line: Line,
    /// The version of the last command.
    version: Version,
    open: bool,
}

/// A simulated board, as plain state: it does no input or output and looks at no clock.
///
/// Time is given to it, counted from its start; going back does nothing. Whoever drives it gives it the host's bytes
/// with [`receive`](Self::receive), calls [`advance`](Self::advance) no later than [`next_event`](Self::next_event)
/// says, and then fetches what the board has sent with [`take_output`](Self::take_output).
///
/// ```
/// use std::time::Duration;
///
/// use sbgc_host::sim::{Board, Config};
///
/// let mut board = Board::new(Config::default());
/// let start = Duration::from_secs(1);
/// board.receive(start, &[0x3E, 86, 0, 86, 0]);
/// board.advance(start + Duration::from_millis(8));
/// assert_eq!(board.take_output()[..4], [0x3E, 86, 18, 104]);
/// ```
///
/// It has one port; [`connect`](Self::connect) adds more, so that several hosts can share it.
#[derive(Debug)]
pub struct Board {
    ports: Vec<Port>,
    machine: Machine,
    now: Duration,
    /// When it resets, and for how long it is deaf then.
    reset_at: Option<(Duration, Duration)>,
    /// Until when it is deaf.
    booting_until: Duration,
    resets: u64,
    /// Resets of faults, the next one first.
    planned_resets: Vec<Duration>,
    /// From when until when the line is dead, and the board stands still.
    unplugged: Vec<(Duration, Duration)>,
    stalled: Vec<(Duration, Duration)>,
    confirms: bool,
    /// Ports that carry raw bytes to each other.
    bridges: Vec<[u8; 2]>,
    /// What goes wrong on every line, those of ports that come later included.
    injected: Vec<Fault>,
    taken: VecDeque<TakenCommand>,
}

impl Board {
    /// A board that has just started and listens.
    pub fn new(config: Config) -> Self {
        let eeprom = Eeprom::new(config.eeprom_size);
        Self::start(config, eeprom)
    }

    /// A board with the EEPROM of an earlier one: its parameters, files and calibrations. `None` if the image is too
    /// small to be one.
    ///
    /// ```
    /// use sbgc_host::sim::{Board, Config};
    ///
    /// let image = Board::new(Config::default()).eeprom().to_vec();
    /// assert!(Board::with_eeprom(Config::default(), image).is_some());
    /// assert!(Board::with_eeprom(Config::default(), vec![0; 16]).is_none());
    /// ```
    pub fn with_eeprom(config: Config, image: Vec<u8>) -> Option<Self> {
        Eeprom::from_image(image).map(|eeprom| Self::start(config, eeprom))
    }

    fn start(config: Config, eeprom: Eeprom) -> Self {
        let port = Port { line: Line::new(config.bit_rate, config.seed), version: Version::V1, open: true };
        let faults = config.faults.clone();
        let mut board = Self {
            ports: vec![port],
            machine: Machine::new(config, eeprom),
            now: Duration::ZERO,
            reset_at: None,
            booting_until: Duration::ZERO,
            resets: 0,
            planned_resets: Vec::new(),
            unplugged: Vec::new(),
            stalled: Vec::new(),
            confirms: true,
            bridges: Vec::new(),
            injected: Vec::new(),
            taken: VecDeque::new(),
        };
        for fault in faults {
            board.inject(fault);
        }
        board
    }

    /// Puts bytes of the host on the line at `now`.
    pub fn receive(&mut self, now: Duration, bytes: &[u8]) {
        self.receive_on(0, now, bytes);
    }

    /// Puts bytes of a host on the line of a port at `now`.
    pub fn receive_on(&mut self, port: u8, now: Duration, bytes: &[u8]) {
        self.advance(now);
        let dead = self.is_unplugged();
        if let Some(port) = self.ports.get_mut(usize::from(port)).filter(|_| !dead) {
            port.line.carry_in(self.now, bytes);
        }
    }

    /// Bytes of the host that are still on the line. Who drives the board should not let them grow without bound.
    pub fn unreceived(&self) -> usize {
        self.unreceived_on(0)
    }

    /// Bytes of a host that are still on the line of a port.
    pub fn unreceived_on(&self, port: u8) -> usize {
        self.ports.get(usize::from(port)).map_or(0, |port| port.line.coming())
    }

    /// Does everything that happens up to `now`, each thing at its time.
    pub fn advance(&mut self, now: Duration) {
        while let Some(time) = self.next_event().filter(|time| *time <= now) {
            self.now = time;
            self.machine.motion.advance(time);
            self.happen(time);
            self.carry_out(time);
        }
        self.now = self.now.max(now);
        self.machine.motion.advance(self.now);
        self.carry_out(self.now);
    }

    fn carry_out(&mut self, now: Duration) {
        if covers(&self.stalled, now) {
            return;
        }
        let dead = covers(&self.unplugged, now);
        for port in &mut self.ports {
            port.line.carry_out(now);
            if dead {
                port.line.cut();
            }
        }
    }

    /// When something happens next that the host could notice; always later than the last
    /// [`advance`](Self::advance).
    pub fn next_event(&self) -> Option<Duration> {
        let lines = self.ports.iter().filter(|port| port.open).map(|port| &port.line);
        let busy = lines.clone().any(Line::is_busy) || self.machine.wants_poll();
        let out = lines.filter_map(Line::next_out).min();
        [
            out,
            busy.then(|| next_multiple(self.now, POLL)),
            self.machine.streams.next(),
            self.reset_at.map(|(time, _)| time),
            self.planned_resets.first().copied(),
            self.edges().filter(|time| *time > self.now).min(),
        ]
        .into_iter()
        .flatten()
        .min()
        // Whatever is overdue happens a moment later, so that time goes on.
        .map(|time| time.max(self.now.saturating_add(Duration::from_nanos(1))))
    }

    /// What has arrived at the host since the last call.
    pub fn take_output(&mut self) -> Bytes {
        self.take_output_of(0)
    }

    /// What has arrived at the host of a port since the last call.
    pub fn take_output_of(&mut self, port: u8) -> Bytes {
        let Some(port) = self.ports.get_mut(usize::from(port)) else { return Bytes::new() };
        let output = port.line.take_gone();
        self.carry_out(self.now);
        output
    }

    /// What became of the messages of the first port so far.
    pub fn counters(&self) -> LineCounters {
        self.counters_of(0)
    }

    /// What became of the messages of a port so far.
    pub fn counters_of(&self, port: u8) -> LineCounters {
        self.ports.get(usize::from(port)).map(|port| port.line.counters()).unwrap_or_default()
    }

    /// The last commands that the board has taken, the newest last.
    pub fn last_commands(&self) -> impl Iterator<Item = &TakenCommand> {
        self.taken.iter()
    }

    /// How often the board was reset.
    pub fn resets(&self) -> u64 {
        self.resets
    }

    /// How the camera stands and moves.
    pub fn motion(&self) -> &Motion {
        &self.machine.motion
    }

    /// Begins a new record of how the axes move, or ends it; [`Motion::recorded`] has it.
    ///
    /// ```
    /// use std::time::Duration;
    ///
    /// use sbgc_host::sim::{Board, Config};
    ///
    /// let mut board = Board::new(Config::default());
    /// board.record_motion(true);
    /// // `MENU_CMD_LOOK_DOWN`
    /// board.receive(Duration::ZERO, &[0x3E, 69, 1, 70, 17, 17]);
    /// board.advance(Duration::from_secs(3));
    /// let fastest = board.motion().recorded().iter().map(|moment| moment.speeds.pitch).fold(0.0, f64::max);
    /// assert!(fastest > 60.0 && fastest < 61.0, "the speed of automated tasks");
    /// ```
    pub fn record_motion(&mut self, on: bool) {
        self.machine.motion.set_recording(on);
    }

    /// The EEPROM: everything that outlives a reset.
    pub fn eeprom(&self) -> &[u8] {
        self.machine.parameters.eeprom.image()
    }

    /// A number that grows with each change of the EEPROM.
    pub fn eeprom_changes(&self) -> u64 {
        self.machine.parameters.eeprom.changes()
    }

    /// The pulse of a servo output in microseconds, counted from 0; `None` while it floats.
    pub fn servo(&self, output: usize) -> Option<u16> {
        self.machine.servo(output)
    }

    /// Connects an input of remote control to a signal of -1 to 1, or disconnects it.
    ///
    /// ```
    /// use sbgc_host::sim::{Board, Config};
    /// use sbgc_proto::commands::RcSource;
    ///
    /// let mut board = Board::new(Config::default());
    /// board.set_rc_input(RcSource::RC_INPUT_PITCH, Some(0.5));
    /// ```
    pub fn set_rc_input(&mut self, source: RcSource, signal: Option<f64>) {
        self.machine.rc.connect(source, signal);
        self.machine.steer(self.now);
    }

    /// Turns the frame to angles in degrees, as the one who carries it does.
    pub fn turn_frame(&mut self, angles: PerAxis<f64>) {
        self.machine.motion.turn_frame(angles);
        self.machine.steer(self.now);
    }

    fn happen(&mut self, time: Duration) {
        if let Some((_, deaf)) = self.reset_at.take_if(|(at, _)| *at <= time) {
            self.reset(time, deaf);
        }
        if self.planned_resets.first().is_some_and(|at| *at <= time) {
            self.planned_resets.remove(0);
            self.reset_with_notice();
        }
        if time >= self.booting_until {
            let stalled = covers(&self.stalled, time);
            for sample in answers::samples(&mut self.machine, time).into_iter().filter(|_| !stalled) {
                let (to, packet) = (sample.to, sample.packet);
                if sample.optional {
                    if let Some(port) = self.ports.get_mut(usize::from(to.port)) {
                        port.line.send_sample(time, to.version, packet.id.raw(), &packet.payload);
                    }
                    self.forward(time, to.port, true, packet.id.raw(), &packet.payload);
                } else {
                    self.send(time, to.port, &packet);
                }
            }
        }
        if is_multiple(time, POLL) {
            self.poll(time);
        }
    }

    fn poll(&mut self, time: Duration) {
        let stalled = covers(&self.stalled, time);
        let deaf = time < self.booting_until;
        for index in 0..self.ports.len() {
            let Some(port) = self.ports.get_mut(index) else { continue };
            port.line.take_in(time, deaf);
            let raw = port.line.take_raw();
            let number = u8::try_from(index).unwrap_or_default();
            if let Some(end) = self.other_end(number)
                && let Some(port) = self.ports.get_mut(usize::from(end))
            {
                port.line.send_raw(time, &raw);
                continue;
            }
            if stalled {
                continue;
            }
            while let Some(received) = self.ports.get_mut(index).and_then(|port| port.line.next_command()) {
                self.carry_out_command(time, number, &received);
            }
        }
        if !deaf && !stalled {
            for (port, reply) in answers::poll(&mut self.machine, time) {
                self.follow(time, port, reply);
            }
        }
    }

    fn carry_out_command(&mut self, time: Duration, port: u8, received: &Received) {
        if let Some(port) = self.ports.get_mut(usize::from(port)) {
            port.version = received.version;
        }
        self.forward(time, port, false, received.id, &received.payload);
        if self.taken.len() >= REMEMBERED {
            self.taken.pop_front();
        }
        let (id, payload) = (received.id.into(), received.payload.clone());
        self.taken.push_back(TakenCommand { time, port, id, payload });
        let call =
            Call { now: time, port, version: received.version, id: received.id, payload: &received.payload };
        for reply in answers::answer(&mut self.machine, &call).unwrap_or_default() {
            self.follow(time, port, reply);
        }
    }

    fn follow(&mut self, time: Duration, port: u8, reply: Reply) {
        match reply {
            Reply::Send(packet) => self.send(time, port, &packet),
            Reply::Reset { after } => {
                self.reset_at = Some((time.saturating_add(after), self.machine.config().boot));
            }
            Reply::Boot { after } => self.reset_at = Some((time.saturating_add(after), BOOTLOADER)),
            Reply::Bridge { ports } => self.bridge(time, port, ports),
        }
    }

    fn send(&mut self, time: Duration, port: u8, packet: &Packet) {
        if packet.id.raw() == Confirm::ID.raw() && !self.confirms {
            return;
        }
        if let Some(port) = self.ports.get_mut(usize::from(port)).filter(|port| port.open) {
            port.line.send(time, port.version, packet.id.raw(), &packet.payload);
        }
        self.forward(time, port, true, packet.id.raw(), &packet.payload);
    }

    fn reset(&mut self, time: Duration, deaf: Duration) {
        self.resets += 1;
        self.bridges.clear();
        for port in &mut self.ports {
            port.line.reset();
            port.version = Version::V1;
        }
        self.machine.reset();
        self.booting_until = time.saturating_add(deaf);
    }
}

/// Whether a time is within one of these spans.
fn covers(spans: &[(Duration, Duration)], time: Duration) -> bool {
    spans.iter().any(|(from, until)| (*from..*until).contains(&time))
}

/// The first multiple of `step` after `time`.
fn next_multiple(time: Duration, step: Duration) -> Duration {
    let over = time.as_nanos().checked_rem(step.as_nanos()).unwrap_or_default();
    let over = Duration::from_nanos(u64::try_from(over).unwrap_or_default());
    time.saturating_sub(over).saturating_add(step)
}

fn is_multiple(time: Duration, step: Duration) -> bool {
    time.as_nanos().checked_rem(step.as_nanos()) == Some(0)
}
