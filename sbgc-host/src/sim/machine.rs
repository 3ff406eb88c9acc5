//! What is in the board besides its line: settings, motion, streams.

use std::time::Duration;

use super::answers::{Calibration, Packet};
use super::config::Config;
use super::control::Steering;
use super::motion::Motion;
use super::parameters::Parameters;
use super::streams::Streams;
use super::variables::Variables;

#[derive(Debug)]
pub(super) struct Machine {
    config: Config,
    pub(super) motion: Motion,
    pub(super) steering: Steering,
    pub(super) parameters: Parameters,
    pub(super) streams: Streams,
    pub(super) variables: Variables,
    pub(super) eeprom: Vec<u8>,
    /// Whether what the menu has running is to be reported when it is done.
    pub(super) menu_runs: bool,
    pub(super) calibration: Option<Calibration>,
}

impl Machine {
    pub(super) fn new(config: Config) -> Self {
        let motion = Motion::new(config.limits, config.axes, config.motors_on);
        let parameters = Parameters::new(config.profile, &config.parameters);
        let eeprom = vec![0xFF; config.eeprom_size];
        Self {
            config,
            motion,
            steering: Steering::default(),
            parameters,
            streams: Streams::default(),
            variables: Variables::default(),
            eeprom,
            menu_runs: false,
            calibration: None,
        }
    }

    pub(super) fn config(&self) -> &Config {
        &self.config
    }

    /// Forgets what is not stored. The camera stays where it is.
    pub(super) fn reset(&mut self) {
        self.motion.restart(self.config.limits, self.config.motors_on);
        self.steering = Steering::default();
        self.streams = Streams::default();
        self.variables.reset();
        self.menu_runs = false;
        self.calibration = None;
    }

    /// Whether something has to be looked at when the board next works through its queue.
    pub(super) fn wants_poll(&self) -> bool {
        self.steering.is_waiting() || self.menu_runs || self.calibration.is_some() || self.motion.has_tasks()
    }

    /// What the board says by itself.
    pub(super) fn poll(&mut self, now: Duration) -> Vec<Packet> {
        let reached = self.steering.poll(now, &mut self.motion);
        let finished = self.motion.finish_tasks() && std::mem::take(&mut self.menu_runs);
        let packets = [reached.then(Self::control_finished), finished.then(Self::menu_finished)];
        let calibrated = self.calibration_finished(now);
        packets.into_iter().flatten().flatten().chain(calibrated).collect()
    }
}
