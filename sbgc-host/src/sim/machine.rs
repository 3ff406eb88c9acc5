//! What is in the board besides its lines.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use sbgc_proto::commands::{
    AdjustableVariable, DebugPortFilter, EventId, EventTypes, GeneralFlags1, GeneralFlags2, MenuCommand,
    ProfileFlags1, RcSource, RcSourceKind, SystemStateFlags, SystemSubError,
};
use sbgc_proto::frame::Version;

use super::aux_motors::AuxMotors;
use super::bus::Bus;
use super::config::Config;
use super::eeprom::{Cell, Eeprom};
use super::events::Happened;
use super::imu::Imu;
use super::motion::{Goal, Motion};
use super::parameters::{Parameters, Settings};
use super::pins::{Pins, servo_channel};
use super::power::Power;
use super::procedure::Procedure;
use super::quaternion::QuatControl;
use super::rc::{RcInputs, pulse};
use super::reply::Reply;
use super::script::Script;
use super::steering::{Steering, speed_of};
use super::streams::Streams;

/// A command as it came.
#[derive(Clone, Copy, Debug)]
pub(super) struct Call<'p> {
    pub(super) now: Duration,
    pub(super) port: u8,
    pub(super) version: Version,
    pub(super) id: u8,
    pub(super) payload: &'p [u8],
}

/// A command of the menu that waits to be run.
#[derive(Clone, Copy, Debug)]
pub(super) struct MenuRequest {
    pub(super) command: MenuCommand,
    pub(super) port: u8,
}

#[derive(Debug)]
pub(super) struct Machine {
    config: Config,
    pub(super) parameters: Parameters,
    pub(super) motion: Motion,
    pub(super) steering: Steering,
    pub(super) quat: QuatControl,
    pub(super) streams: Streams,
    pub(super) rc: RcInputs,
    pub(super) imu: Imu,
    pub(super) power: Power,
    pub(super) pins: Pins,
    pub(super) bus: Bus,
    pub(super) aux: AuxMotors,
    pub(super) procedure: Option<Procedure>,
    pub(super) script: Option<Script>,
    /// Commands that scripts and trigger slots have given to the menu.
    pub(super) menu: VecDeque<MenuRequest>,
    /// The port that is told when what the menu has running is done.
    pub(super) menu_reports: Option<u8>,
    /// The levels that the trigger slots had last.
    pub(super) trigger_levels: [Option<u8>; 10],
    /// The level that the command channel of remote control had last.
    pub(super) command_level: Option<u8>,
    /// Whether the axes still move to where they should be after a start.
    pub(super) starting: bool,
    /// The action that was triggered last, by slot.
    pub(super) triggered: [u8; 10],
    /// What has happened and was not reported yet.
    pub(super) events: Vec<Happened>,
    /// What is sent later, by its time.
    pub(super) later: Vec<(Duration, u8, Reply)>,
    /// Ports that get a copy of the traffic of the others.
    pub(super) debug_ports: BTreeMap<u8, DebugPortFilter>,
    /// The module of the CAN bus whose firmware is being written.
    pub(super) flashing: Option<u8>,
    /// The last melody or sound.
    pub(super) last_sound: Option<u16>,
    /// Modes that the menu turns on and off.
    pub(super) modes: SystemStateFlags,
}

impl Machine {
    pub(super) fn new(config: Config, eeprom: Eeprom) -> Self {
        let parameters = Parameters::new(eeprom, &config);
        let motors_on = config.motors_on && starts_with_motors(parameters.settings());
        let mut machine = Self {
            motion: Motion::new(config.axes, motors_on),
            steering: Steering::default(),
            quat: QuatControl::default(),
            streams: Streams::default(),
            rc: RcInputs::default(),
            imu: Imu::new(config.seed),
            power: Power::new(),
            pins: Pins::default(),
            bus: Bus::new(),
            aux: AuxMotors::new(),
            procedure: None,
            script: None,
            menu: VecDeque::new(),
            menu_reports: None,
            trigger_levels: [None; 10],
            command_level: None,
            starting: false,
            triggered: [0; 10],
            events: Vec::new(),
            later: Vec::new(),
            debug_ports: BTreeMap::new(),
            flashing: None,
            last_sound: None,
            modes: SystemStateFlags::empty(),
            parameters,
            config,
        };
        machine.apply_settings();
        machine.take_position();
        machine
    }

    pub(super) fn config(&self) -> &Config {
        &self.config
    }

    pub(super) fn settings(&self) -> &Settings {
        self.parameters.settings()
    }

    /// Forgets what is not stored. The camera stays where it is, and what is connected stays connected.
    pub(super) fn reset(&mut self) {
        self.parameters.start(&self.config);
        let motors_on = self.config.motors_on && starts_with_motors(self.parameters.settings());
        self.steering = Steering::default();
        self.quat = QuatControl::default();
        self.streams = Streams::default();
        self.rc.reset();
        self.imu.reset();
        self.power.reset();
        self.pins.reset();
        self.aux.reset();
        self.procedure = None;
        self.script = None;
        self.menu.clear();
        self.menu_reports = None;
        self.trigger_levels = [None; 10];
        self.command_level = None;
        self.triggered = [0; 10];
        self.events.clear();
        self.later.clear();
        self.debug_ports.clear();
        self.flashing = None;
        self.modes = SystemStateFlags::empty();
        self.motion.restart(motors_on);
        self.apply_settings();
        self.take_position();
    }

    /// Moves the axes to the angles that they take at a start, as an automated task.
    fn take_position(&mut self) {
        let settings = self.parameters.settings();
        let keeps = settings.params.profile_flags1.contains(ProfileFlags1::RC_KEEP_CUR_POS_ON_INIT);
        self.starting = self.motion.motors_on() && !keeps;
        if !self.starting {
            return;
        }
        let mut angles = settings.params.rc_memory.map(|angle| f64::from(angle.degrees()));
        if settings.params.general_flags1.contains(GeneralFlags1::CENTER_YAW_AT_STARTUP) {
            angles.yaw = self.motion.frame().yaw;
        }
        let speed = Some(speed_of(settings.ext2.auto_speed));
        let axes = self.motion.axes().into_array().into_iter().zip(angles.into_array());
        // An axis that is there already stands, so that a correction of its attitude does not make it move.
        let mut tasks = axes.map(|(axis, angle)| {
            let there = (axis.angle - angle).abs() < 0.01;
            (!there).then_some(Goal::Angle { angle, speed })
        });
        self.motion.give_task([(); 3].map(|()| tasks.next().flatten()).into());
        self.starting = !self.motion.finish_tasks();
    }

    /// Lets parameters act that no command looks up by itself.
    fn apply_settings(&mut self) {
        let now = self.motion_time();
        self.steer(now);
    }

    fn motion_time(&self) -> Duration {
        self.motion.now()
    }

    /// Lets all sources of motion act. True if serial control has reached what it was to report.
    pub(super) fn steer(&mut self, now: Duration) -> bool {
        self.rc.step(self.parameters.settings());
        let held = self.procedure.as_ref().is_some_and(|procedure| procedure.holds);
        self.steering.poll(now, self.parameters.settings(), &self.rc, held, &mut self.motion)
    }

    /// Whether a variable is one that the firmware knows.
    pub(super) fn knows_variable(&self, variable: AdjustableVariable) -> bool {
        variable.facts().is_some_and(|facts| self.config.knows(facts.since))
    }

    /// Turns the motors on or off, which hosts can have reported.
    pub(super) fn set_motors(&mut self, on: bool) {
        if on != self.motion.motors_on() {
            let what = if on { EventTypes::ON } else { EventTypes::OFF };
            self.events.push(Happened::new(EventId::MotorState, what, 0));
        }
        self.motion.set_motors(on);
    }

    /// Whether the motors may be turned on.
    pub(super) fn may_turn_on(&self) -> bool {
        self.imu.connected && !self.power.is_exhausted()
    }

    /// Stops everything because of an error.
    pub(super) fn emergency_stop(&mut self, now: Duration, cause: SystemSubError) {
        if self.power.stop().is_none() {
            self.events.push(Happened::new(EventId::EmergencyStop, EventTypes::ON, cause.raw().into()));
        }
        self.power.set_stop(now, cause);
        self.motion.drop_tasks();
        self.steering.finish(false);
        self.set_motors(false);
    }

    /// Ends an emergency stop.
    pub(super) fn end_stop(&mut self) {
        if self.power.stop().is_some() {
            self.power.end_stop();
            self.events.push(Happened::new(EventId::EmergencyStop, EventTypes::OFF, 0));
        }
    }

    /// The pulse of a servo output in microseconds; `None` while it floats.
    pub(super) fn servo(&self, output: usize) -> Option<u16> {
        let settings = self.parameters.settings();
        match servo_channel(output, settings) {
            Some(channel) => {
                let kind = RcSource::default().with_kind(RcSourceKind::ApiVirt);
                let signal = self.rc.signal(kind.with_channel(channel % 32), settings)?;
                u16::try_from(pulse(Some(signal))).ok()
            }
            None => self.pins.servo(output),
        }
    }

    /// The scale of the voltage sensor, in 1/128.
    pub(super) fn voltage_scale(&self) -> u8 {
        self.parameters.eeprom.cell(Cell::VoltageScale)
    }

    /// Whether something has to be looked at when the board next works through its queue.
    pub(super) fn wants_poll(&self) -> bool {
        self.steering.is_busy(self.parameters.settings(), &self.rc)
            || self.motion.has_tasks()
            || self.procedure.is_some()
            || self.script.is_some()
            || self.menu_reports.is_some()
            || self.quat.task.is_some()
            || self.power.is_changing()
            || !self.imu.connected
            || !self.menu.is_empty()
            || !self.events.is_empty()
            || !self.later.is_empty()
    }
}

fn starts_with_motors(settings: &Settings) -> bool {
    !settings.ext2.general_flags2.contains(GeneralFlags2::MOTORS_OFF_AT_STARTUP)
}
