//! What the state of power and sensors brings about by itself.

use std::time::Duration;

use sbgc_proto::commands::{CalibMode, SystemSubError};

use crate::sim::machine::Machine;
use crate::sim::procedure::Kind;
use crate::sim::reply::Reply;

/// Watches battery and sensor, ends an emergency stop whose cause is gone, and ends a safe stop.
pub(super) fn poll(machine: &mut Machine, now: Duration, _: &mut Vec<(u8, Reply)>) {
    let scale = machine.voltage_scale();
    let settings = machine.parameters.settings();
    if machine.power.watch(now, settings, &machine.motion, scale) {
        machine.set_motors(false);
    }
    if !machine.imu.connected {
        machine.power.i2c_errors = machine.power.i2c_errors.saturating_add(1);
        if machine.power.stop().is_none() {
            machine.emergency_stop(now, SystemSubError::ImuSensorNotResponding);
        }
    } else if machine.power.stop_is_over(now, machine.settings()) {
        machine.end_stop();
        if machine.may_turn_on() {
            machine.set_motors(true);
        }
    }
    let stopping = machine.procedure.as_ref().is_some_and(|procedure| procedure.kind == Kind::SafeStop);
    if stopping && !machine.motion.is_moving() {
        machine.procedure = None;
        machine.set_motors(false);
    }
    machine.imu.calib_mode = machine.procedure.as_ref().map_or(CalibMode::None, |procedure| procedure.mode);
}
