//! The ports of the board: who comes and goes, who sees a copy of what, and which carry raw bytes.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::{PortAndDirection, SetDebugPort};
use sbgc_proto::frame::Version;

use super::super::answers;
use super::super::faults::Fault;
use super::super::line::Line;
use super::super::reply::{Packet, Refusal};
use super::{Board, Port};

/// The longest payload that a debug port can forward.
const FORWARDED: usize = 251;

impl Board {
    /// Adds a port, or reuses one that was given back, and returns its number. At most 255 are open at once.
    pub fn connect(&mut self) -> Option<u8> {
        let free = self.ports.iter().position(|port| !port.open);
        let index = free.unwrap_or(self.ports.len());
        let number = u8::try_from(index).ok().filter(|number| *number < u8::MAX)?;
        let config = self.machine.config();
        let mut line = Line::new(config.bit_rate, config.seed.wrapping_add(u64::from(number)));
        for fault in &self.injected {
            if let Fault::Corrupt { way, .. }
            | Fault::Drop { way, .. }
            | Fault::Duplicate { way, .. }
            | Fault::Delay { way, .. } = *fault
            {
                line.tamper(way, *fault);
            }
        }
        let port = Port { line, version: Version::V1, open: true };
        match self.ports.get_mut(index) {
            Some(place) => *place = port,
            None => self.ports.push(port),
        }
        Some(number)
    }

    /// Gives a port back: what is on its way is lost, and its streams end. Motion goes on.
    pub fn disconnect(&mut self, port: u8) {
        if let Some(port) = self.ports.get_mut(usize::from(port)) {
            port.open = false;
            port.line.reset();
        }
        self.machine.streams.drop_port(port);
        self.machine.debug_ports.remove(&port);
        if let Some(index) = self.bridges.iter().position(|bridge| bridge.contains(&port)) {
            for end in self.bridges.remove(index) {
                self.set_raw(end, false);
            }
        }
    }

    /// Changes the bit rate of a port's line; `None` for one that is never the bottleneck.
    pub fn set_bit_rate(&mut self, port: u8, bit_rate: Option<u32>) {
        if let Some(port) = self.ports.get_mut(usize::from(port)) {
            port.line.set_bit_rate(bit_rate);
        }
    }

    /// Lets bytes of a port's host be there at once, whatever the bit rate, as a network delivers them.
    pub fn read_at_once(&mut self, port: u8) {
        if let Some(port) = self.ports.get_mut(usize::from(port)) {
            port.line.read_at_once();
        }
    }

    pub(super) fn send_to_all(&mut self, packet: &Packet) {
        for port in 0..self.ports.len() {
            self.send(self.now, u8::try_from(port).unwrap_or_default(), packet);
        }
    }

    /// Sends a copy of a message of one port to the debug ports.
    pub(super) fn forward(&mut self, time: Duration, from: u8, out: bool, id: u8, payload: &[u8]) {
        let [low, high, ..] = time.as_millis().to_le_bytes();
        let watching = self.machine.debug_ports.iter().filter(|(port, filter)| {
            **port != from && !answers::is_left_out(**filter, id) && payload.len() <= FORWARDED
        });
        let watching: Vec<u8> = watching.map(|(port, _)| *port).collect();
        for port in watching {
            let copy = SetDebugPort {
                time_ms: u16::from_le_bytes([low, high]),
                port_and_dir: PortAndDirection::default().with_port(from).with_direction(out),
                cmd_id: id.into(),
                payload,
            };
            if let (Ok(copy), Some(port)) = (Packet::of(&copy), self.ports.get_mut(usize::from(port))) {
                port.line.send_sample(time, port.version, copy.id.raw(), &copy.payload);
            }
        }
    }

    /// Lets two ports carry raw bytes to each other, or refuses it.
    pub(super) fn bridge(&mut self, time: Duration, asked_on: u8, ports: [u8; 2]) {
        let open = |port: &u8| {
            self.ports.get(usize::from(*port)).is_some_and(|port| port.open && !port.line.is_raw())
        };
        if ports.iter().all(open) {
            self.bridges.push(ports);
            for end in ports {
                self.set_raw(end, true);
            }
            return;
        }
        for reply in Refusal::State.replies(CommandId::SetTranspProxy).unwrap_or_default() {
            self.follow(time, asked_on, reply);
        }
    }

    fn set_raw(&mut self, port: u8, raw: bool) {
        if let Some(port) = self.ports.get_mut(usize::from(port)) {
            port.line.set_raw(raw);
        }
    }

    /// The port that what comes on a bridged one leaves on.
    pub(super) fn other_end(&self, port: u8) -> Option<u8> {
        let [one, other] = *self.bridges.iter().find(|bridge| bridge.contains(&port))?;
        Some(if one == port { other } else { one })
    }
}
