//! What goes wrong with the board on purpose.

use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::commands::SystemSubError;

use super::super::faults::Fault;
use super::super::reply::Packet;
use super::{Board, covers};

impl Board {
    /// Lets something go wrong from now on, or at its time.
    pub fn inject(&mut self, fault: Fault) {
        match fault {
            Fault::Corrupt { way, .. }
            | Fault::Drop { way, .. }
            | Fault::Duplicate { way, .. }
            | Fault::Delay { way, .. } => {
                for port in &mut self.ports {
                    port.line.tamper(way, fault);
                }
            }
            Fault::Reset { at } => {
                self.planned_resets.push(at);
                self.planned_resets.sort_unstable();
            }
            Fault::Unplug { at, lasts } => self.unplugged.push((at, at.saturating_add(lasts))),
            Fault::Stall { at, lasts } => self.stalled.push((at, at.saturating_add(lasts))),
            Fault::NoConfirm => self.confirms = false,
            Fault::LowBattery => self.machine.power.empty(Some(self.now)),
            Fault::Sensor => self.set_sensor(false),
        }
        self.injected.push(fault);
    }

    /// Ends what goes wrong.
    pub fn clear_faults(&mut self) {
        for port in &mut self.ports {
            port.line.stop_tampering();
        }
        self.planned_resets.clear();
        self.unplugged.clear();
        self.stalled.clear();
        self.confirms = true;
        self.machine.power.empty(None);
        self.set_sensor(true);
        self.injected.clear();
    }

    /// Whether the line is dead now, because of a fault.
    pub fn is_unplugged(&self) -> bool {
        covers(&self.unplugged, self.now)
    }

    /// When faults begin and end.
    pub(super) fn edges(&self) -> impl Iterator<Item = Duration> {
        self.unplugged.iter().chain(&self.stalled).flat_map(|(from, until)| [*from, *until])
    }

    /// Disconnects the sensor of the camera, which is an emergency, or connects it again.
    fn set_sensor(&mut self, connected: bool) {
        self.machine.imu.connected = connected;
        if !connected {
            self.machine.emergency_stop(self.now, SystemSubError::ImuSensorNotResponding);
        }
    }

    /// Resets the board as soon as the notice that it gives before a reset of its own has left.
    pub(super) fn reset_with_notice(&mut self) {
        let payload = Vec::new();
        self.send_to_all(&Packet { id: CommandId::Reset, payload });
        let open = self.ports.iter().filter(|port| port.open);
        let told = open.map(|port| port.line.empty_at(self.now)).max().unwrap_or(self.now);
        // What leaves at the very moment of the reset would be forgotten.
        let then = told.saturating_add(Duration::from_millis(1));
        self.reset_at = Some((then, self.machine.config().boot));
    }
}
