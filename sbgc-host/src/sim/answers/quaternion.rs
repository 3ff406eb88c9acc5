//! Control by quaternion.
//!
//! Simplified: a target attitude is a target of the three angles, and speeds about X, Y and Z are those of pitch, roll
//! and yaw, as for a level camera.

use std::time::Duration;

use sbgc_proto::commands::{
    ConfirmData, ControlMode, ControlQuat, ControlQuatConfig, ControlQuatConfigDataSet, ControlQuatFlags,
    ControlQuatMode, ControlQuatStatus, ControlQuatStatusDataSet as Set, ControlQuatStatusFlags,
};
use sbgc_proto::units::{PackedQuaternion, SensorRate};
use sbgc_proto::wire::{Float, PerAxis, PerXyz};
use sbgc_proto::{CommandId, OutgoingCommand};

use crate::sim::imu::{angles_of_quaternion, quaternion};
use crate::sim::machine::{Call, Machine};
use crate::sim::quaternion::{QuatControl, TASK_TIMEOUT};
use crate::sim::reply::{Packet, Refusal, Replies, Reply, done, message, silence};
use crate::sim::steering::{Order, Shaping, cutoff_time};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::ControlQuat(command) => control(machine, call, command),
        OutgoingCommand::ControlQuatStatusRequest(request) => status(machine, request.data_set),
        OutgoingCommand::ControlQuatConfig(config) => configure(machine, config),
        _ => return None,
    })
}

fn control(machine: &mut Machine, call: &Call<'_>, command: &ControlQuat) -> Replies {
    if matches!(command.mode, ControlQuatMode::Unknown(_)) {
        return Err(Refusal::Parameters);
    }
    let packed = command.target_attitude_packed.map(PackedQuaternion::unpack);
    let attitude = command.target_attitude.map(|parts| parts.map(Float::get)).or(packed);
    let target = attitude.map(|parts| angles_of_quaternion(parts.map(f64::from)));
    let radians = command.target_speed.map(|speed| speed.map(|part| f64::from(part.get()).to_degrees()));
    let speed: PerXyz<f64> = radians.unwrap_or([0.0; 3].into());
    let finite = |parts: [f64; 3]| parts.iter().all(|part| part.is_finite());
    if !finite(speed.into_array()) || target.is_some_and(|target| !finite(target.into_array())) {
        return Err(Refusal::Parameters);
    }
    let quat = &mut machine.quat;
    quat.mode = command.mode;
    quat.flags = command.flags;
    quat.target = target;
    quat.speed = speed;
    let reports = command.flags.contains(ControlQuatFlags::AUTO_TASK) && target.is_some();
    quat.task = reports.then_some((call.port, call.now));
    let orders = orders(quat);
    if command.mode == ControlQuatMode::Disabled {
        machine.steering.finish(false);
    } else {
        machine.steering.tell(call.now, call.port, &orders, &machine.motion);
    }
    machine.steer(call.now);
    if command.flags.contains(ControlQuatFlags::CONFIRM) { done(CommandId::ControlQuat) } else { silence() }
}

fn orders(quat: &QuatControl) -> [Option<Order>; 3] {
    let along = |parts: PerXyz<f64>| [parts.y, parts.x, parts.z];
    let of_axis = |parts: Option<PerXyz<f64>>, index: usize| along(parts?).get(index).copied();
    // Speed without limits knows no motion profile.
    let profile = quat.mode != ControlQuatMode::Speed;
    let mut index = 0;
    along(quat.speed).map(|speed| {
        let limit = of_axis(quat.max_speed, index).filter(|limit| *limit > 0.0);
        let angle = quat.target.and_then(|target| target.into_array().get(index).copied());
        let shaping = Shaping {
            acceleration: of_axis(quat.acceleration, index).filter(|_| profile),
            jerk_time: of_axis(quat.jerk_time, index).filter(|_| profile),
            angle_filter: quat.attitude_filter,
            speed_filter: quat.speed_filter,
            rc_filter: None,
        };
        index += 1;
        Some(match angle {
            Some(angle) => Order {
                mode: ControlMode::ANGLE_SHORTEST,
                speed: Some(if speed == 0.0 { limit.unwrap_or_default() } else { speed }),
                angle: Some(angle),
                signal: 0,
                shaping,
            },
            None => {
                let speed = limit.map_or(speed, |limit| speed.clamp(-limit, limit));
                Order { mode: ControlMode::SPEED, speed: Some(speed), angle: None, signal: 0, shaping }
            }
        })
    })
}

fn status(machine: &Machine, data_set: Set) -> Replies {
    let quat = &machine.quat;
    let axes = machine.motion.axes();
    let actual = quaternion(axes.map(|axis| axis.angle));
    let setpoint = quaternion(axes.map(|axis| axis.setpoint));
    let target = quat.target.map_or(setpoint, quaternion);
    let floats = |parts: [f32; 4]| parts.map(Float::from);
    let packed = PackedQuaternion::pack;
    #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
    let rates = |speeds: PerXyz<f64>| speeds.map(|speed| SensorRate::from_degrees_per_second(speed as f32));
    let about = |speeds: PerAxis<f64>| PerXyz { x: speeds.pitch, y: speeds.roll, z: speeds.yaw };
    let has = |part| data_set.contains(part);
    message(&ControlQuatStatus {
        data_set,
        mode: has(Set::MODE).then_some(quat.mode),
        flags: has(Set::MODE).then(|| ControlQuatStatusFlags::from_bits_retain(quat.flags.bits().into())),
        target_attitude: has(Set::TARGET_ATTITUDE).then(|| floats(target)),
        setpoint_attitude: has(Set::SETPOINT_ATTITUDE).then(|| floats(setpoint)),
        actual_attitude: has(Set::ACTUAL_ATTITUDE).then(|| floats(actual)),
        target_speed: has(Set::TARGET_SPEED).then(|| rates(quat.speed)),
        setpoint_speed: has(Set::SETPOINT_SPEED).then(|| rates(about(axes.map(|axis| axis.setpoint_speed)))),
        actual_speed: has(Set::ACTUAL_SPEED).then(|| rates(about(axes.map(|axis| axis.speed)))),
        target_attitude_packed: has(Set::TARGET_ATTITUDE_PACKED).then(|| packed(target)),
        setpoint_attitude_packed: has(Set::SETPOINT_ATTITUDE_PACKED).then(|| packed(setpoint)),
        actual_attitude_packed: has(Set::ACTUAL_ATTITUDE_PACKED).then(|| packed(actual)),
    })
}

fn configure(machine: &mut Machine, config: &ControlQuatConfig) -> Replies {
    let quat = &mut machine.quat;
    if config.data_set.contains(ControlQuatConfigDataSet::MAX_SPEED) {
        quat.max_speed = config.max_speed.map(|speed| speed.map(|part| f64::from(part.degrees_per_second())));
    }
    if config.data_set.contains(ControlQuatConfigDataSet::ACC_LIMIT) {
        quat.acceleration = config.acc_limit.map(|limit| limit.map(f64::from));
    }
    if config.data_set.contains(ControlQuatConfigDataSet::JERK_SLOPE) {
        quat.jerk_time = config.jerk_slope.map(|slope| slope.map(|ms| f64::from(ms) / 1000.0));
    }
    let filter = |frequency: Option<u8>, before| {
        frequency.map_or(before, |frequency| Some(cutoff_time(frequency.into())).filter(|time| *time > 0.0))
    };
    quat.attitude_filter = filter(config.attitude_lpf_freq, quat.attitude_filter);
    quat.speed_filter = filter(config.speed_lpf_freq, quat.speed_filter);
    done(CommandId::ControlQuatConfig)
}

/// Reports a target that is reached, or given up after ten seconds.
pub(super) fn poll(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    let Some((port, since)) = machine.quat.task else { return };
    let Some(target) = machine.quat.target else { return };
    let axes = machine.motion.axes().into_array();
    let near = |angle: f64, target: f64| ((angle - target + 180.0).rem_euclid(360.0) - 180.0).abs() <= 1.0;
    let reached =
        axes.iter().zip(target.into_array()).all(|(axis, target)| !axis.present || near(axis.angle, target));
    if reached {
        machine.quat.task = None;
        let packet = Packet::confirmation(CommandId::ControlQuat, ConfirmData::U8(1));
        replies.extend(packet.ok().map(|packet| (port, Reply::Send(packet))));
    } else if now.saturating_sub(since) >= TASK_TIMEOUT {
        machine.quat.task = None;
        machine.steering.finish(false);
    }
}
