//! Auxiliary motors.

use std::time::Duration;

use sbgc_proto::commands::{
    ExtMotorAction, ExtMotorControlMode, ExtMotorPower, ExtMotorStateFlags, ExtMotors, ExtMotorsControl,
    ExtMotorsControlConfig, ExtMotorsState, ExtMotorsStateDataSet as Set,
};
use sbgc_proto::units::{Angle, ControlRate, FineAngle, MicroRate};
use sbgc_proto::{CommandId, OutgoingCommand};

use crate::sim::aux_motors::AuxMotor;
use crate::sim::machine::{Call, Machine};
use crate::sim::motion::wire_angle;
use crate::sim::power::Power;
use crate::sim::reply::{Packet, Refusal, Replies, Reply, done, silence};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    machine.aux.advance(call.now);
    Some(match command {
        OutgoingCommand::ExtMotorsAction(request) => act(machine, request.for_motors, request.action)
            .and_then(|()| confirmed(call, request.for_motors)),
        OutgoingCommand::ExtMotorsControl(request) => {
            control(machine, request);
            confirmed(call, request.for_motors)
        }
        OutgoingCommand::ExtMotorsControlConfig(request) => {
            configure(machine, request).and_then(|()| confirmed(call, request.for_motors))
        }
        OutgoingCommand::ExtMotorsStateRequest(request) => {
            let states = states(machine, call.now, request.for_motors, request.data_set);
            if states.is_empty() {
                Err(Refusal::Parameters)
            } else {
                Ok(states.into_iter().map(Reply::Send).collect())
            }
        }
        _ => return None,
    })
}

fn confirmed(call: &Call<'_>, motors: ExtMotors) -> Replies {
    if motors.contains(ExtMotors::CONFIRM) { done(CommandId::from(call.id)) } else { silence() }
}

/// The motors that are chosen, lowest first.
fn chosen(machine: &mut Machine, motors: ExtMotors) -> impl Iterator<Item = &mut AuxMotor> {
    let bits = motors.bits();
    machine
        .aux
        .motors
        .iter_mut()
        .enumerate()
        .filter(move |(index, _)| bits >> index & 1 != 0)
        .map(|(_, motor)| motor)
}

fn act(machine: &mut Machine, motors: ExtMotors, action: ExtMotorAction) -> Result<(), Refusal> {
    if matches!(action, ExtMotorAction::Unknown(_)) {
        return Err(Refusal::Parameters);
    }
    for motor in chosen(machine, motors) {
        match action {
            ExtMotorAction::OffFloating => motor.power = ExtMotorPower::OffFloating,
            ExtMotorAction::OffBrake => motor.power = ExtMotorPower::OffBrake,
            ExtMotorAction::OffSafe => motor.power = ExtMotorPower::OffSafeStop,
            ExtMotorAction::On => {
                motor.power = ExtMotorPower::On;
                motor.angle_setpoint = motor.angle;
            }
            _ => {
                motor.mode = ExtMotorControlMode::Position;
                motor.angle_setpoint = 0.0;
            }
        }
    }
    Ok(())
}

fn control(machine: &mut Machine, request: &ExtMotorsControl) {
    for (motor, told) in chosen(machine, request.for_motors).zip(request.motors.iter()) {
        let (short, long) = (told.setpoint, told.setpoint_32bit);
        match motor.mode {
            ExtMotorControlMode::Position => {
                let short = short.map(|raw| f64::from(Angle(raw).degrees()));
                let angle = short.or(long.map(|raw| FineAngle(raw).degrees()));
                motor.angle_setpoint = angle.unwrap_or(motor.angle_setpoint);
            }
            ExtMotorControlMode::Speed => {
                let short = short.map(|raw| f64::from(ControlRate(raw).degrees_per_second()));
                let speed = short.or(long.map(|raw| MicroRate(raw).radians_per_second().to_degrees()));
                motor.speed_setpoint = speed.unwrap_or(motor.speed_setpoint);
            }
            _ => motor.torque_setpoint = short.unwrap_or(motor.torque_setpoint),
        }
    }
}

fn configure(machine: &mut Machine, request: &ExtMotorsControlConfig) -> Result<(), Refusal> {
    if matches!(request.mode, Some(ExtMotorControlMode::Unknown(_))) {
        return Err(Refusal::Parameters);
    }
    for motor in chosen(machine, request.for_motors) {
        motor.mode = request.mode.unwrap_or(motor.mode);
        motor.max_speed = request.max_speed.map_or(motor.max_speed, |limit| limit.0);
        motor.max_acceleration = request.max_acceleration.map_or(motor.max_acceleration, |limit| limit.0);
        motor.jerk_slope = request.jerk_slope.unwrap_or(motor.jerk_slope);
        motor.max_torque = request.max_torque.unwrap_or(motor.max_torque);
    }
    Ok(())
}

/// The states of the motors that are chosen, a message for each.
pub(super) fn states(machine: &mut Machine, now: Duration, motors: ExtMotors, set: Set) -> Vec<Packet> {
    machine.aux.advance(now);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is some volts")]
    let millivolts = (machine.power.voltage(now, &machine.motion) * 1000.0) as u16;
    let bits = motors.bits();
    let chosen = (0_u8..).zip(machine.aux.motors).filter(|(index, _)| bits >> index & 1 != 0);
    chosen
        .filter_map(|(motor_id, motor)| Packet::of(&state(motor_id, &motor, set, now, millivolts)).ok())
        .collect()
}

fn state(motor_id: u8, motor: &AuxMotor, set: Set, now: Duration, millivolts: u16) -> ExtMotorsState {
    let has = |part| set.contains(part);
    #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
    let rate = |speed: f64| ControlRate::from_degrees_per_second(speed as f32);
    let fine = |speed: f64| MicroRate::from_radians_per_second(speed.to_radians());
    let on = motor.power == ExtMotorPower::On;
    ExtMotorsState {
        motor_id,
        data_set: set,
        control_mode: has(Set::CONTROL_MODE).then_some(motor.mode),
        torque: has(Set::TORQUE).then_some(if on { 100 } else { 0 }),
        torque_setpoint: has(Set::TORQUE_SETPOINT).then_some(motor.torque_setpoint.max(-32767)),
        speed16: has(Set::SPEED16).then(|| rate(motor.speed)),
        speed16_setpoint: has(Set::SPEED16_SETPOINT).then(|| rate(motor.speed_setpoint)),
        speed32: has(Set::SPEED32).then(|| fine(motor.speed)),
        speed32_setpoint: has(Set::SPEED32_SETPOINT).then(|| fine(motor.speed_setpoint)),
        angle16: has(Set::ANGLE16).then(|| wire_angle(motor.angle)),
        angle16_setpoint: has(Set::ANGLE16_SETPOINT).then(|| wire_angle(motor.angle_setpoint)),
        angle32: has(Set::ANGLE32).then(|| FineAngle::from_degrees(motor.angle)),
        angle32_setpoint: has(Set::ANGLE32_SETPOINT).then(|| FineAngle::from_degrees(motor.angle_setpoint)),
        state_flags: has(Set::STATE_FLAGS).then(|| ExtMotorStateFlags::default().with_power(motor.power)),
        max_speed: has(Set::MAX_SPEED).then_some(motor.max_speed),
        max_acceleration: has(Set::MAX_ACCELERATION).then_some(motor.max_acceleration),
        jerk_slope: has(Set::JERK_SLOPE).then_some(motor.jerk_slope),
        max_torque: has(Set::MAX_TORQUE).then_some(motor.max_torque),
        current: has(Set::CURRENT).then_some(if on { 200 } else { 0 }),
        battery_voltage: has(Set::BATTERY_VOLTAGE).then_some(millivolts),
        motor_temperature: has(Set::MOTOR_TEMPERATURE).then_some(if on { 36 } else { 28 }),
        driver_temperature: has(Set::DRIVER_TEMPERATURE).then(|| Power::temperatures(now).1),
    }
}
