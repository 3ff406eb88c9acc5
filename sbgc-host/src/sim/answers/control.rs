//! Serial control of the axes.

use std::time::Duration;

use sbgc_proto::commands::{
    ConfirmData, Control, ControlConfig, ControlConfigFlags, ControlExt, ControlExtAxis, ControlMode,
    ControlModeKind,
};
use sbgc_proto::units::JerkSlope;
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, OutgoingCommand};

use super::calibration;
use crate::sim::machine::{Call, Machine};
use crate::sim::quaternion::QuatControl;
use crate::sim::reply::{DONE, Packet, Refusal, Replies, Reply, done, silence};
use crate::sim::steering::{Order, Shaping};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::ControlLegacy(legacy) => {
            let all = Control { control_mode: [legacy.control_mode; 3].into(), axes: legacy.axes };
            control(machine, call, &all)
        }
        OutgoingCommand::Control(command) => control(machine, call, command),
        OutgoingCommand::ControlExt(command) => control_ext(machine, call, command),
        OutgoingCommand::ControlConfig(config) => {
            let config = known_config(machine, config);
            machine.steering.configure(call.now, call.port, &config);
            machine.steer(call.now);
            done(CommandId::ControlConfig)
        }
        _ => return None,
    })
}

/// Where the confirmation of a command comes from; with `NO_CONFIRM` there is none.
fn confirmed(command: CommandId, confirms: bool) -> Replies {
    if confirms { done(command) } else { silence() }
}

fn control(machine: &mut Machine, call: &Call<'_>, command: &Control) -> Replies {
    let modes = command.control_mode.into_array();
    let confirms = machine.steering.confirms();
    if modes.iter().all(|mode| mode.kind() == ControlModeKind::NoControl) {
        machine.steering.finish(*command == Control::release());
        machine.quat = QuatControl::default();
        machine.steer(call.now);
        return confirmed(CommandId::Control, confirms);
    }
    // Before 2.68b9 the mode 0 for one axis leaves it as it is.
    let single = machine.config().has("2.68b9");
    let order = |(mode, axis): (ControlMode, sbgc_proto::commands::ControlAxis)| {
        let keep = mode.kind() == ControlModeKind::NoControl && !single;
        (!keep).then(|| Order {
            mode: known(machine, mode),
            speed: Some(axis.speed_in(mode).into()),
            angle: Some(axis.angle.degrees().into()),
            signal: axis.angle.0,
            shaping: Shaping::default(),
        })
    };
    let mut orders = modes.into_iter().zip(command.axes.into_array()).map(order);
    let orders = [(); 3].map(|()| orders.next().flatten());
    tell(machine, call, CommandId::Control, &orders, confirms)
}

/// The mode as the firmware knows it: flags that came later are dropped.
fn known(machine: &Machine, mode: ControlMode) -> ControlMode {
    if machine.config().has("2.70") { mode } else { mode.with_mix_follow(false).with_target_precise(false) }
}

/// The configuration as the firmware knows it: what came later is in bytes and bits that it does not look at.
fn known_config(machine: &Machine, config: &ControlConfig) -> ControlConfig {
    let mut config = config.clone();
    let has = |since| machine.config().has(since);
    for (flag, since) in
        [(ControlConfigFlags::LPF_EXT_RANGE, "2.72b3"), (ControlConfigFlags::LPF_FREQUENCY_HZ, "2.74.1")]
    {
        if !has(since) {
            config.flags.remove(flag);
        }
    }
    let PerAxis { roll, pitch, yaw } = &mut config.axes;
    for axis in [roll, pitch, yaw] {
        if !has("2.70b1") {
            axis.acc_limit = 0;
        }
        if !has("2.70b8") {
            axis.jerk_slope = JerkSlope::UNCHANGED;
        }
    }
    config
}

fn control_ext(machine: &mut Machine, call: &Call<'_>, command: &ControlExt) -> Replies {
    let confirms = machine.steering.confirms();
    let order = |axis: Option<ControlExtAxis>| axis.map(|axis| ext_order(&axis));
    let PerAxis { roll, pitch, yaw } =
        PerAxis { roll: order(command.roll), pitch: order(command.pitch), yaw: order(command.yaw) };
    tell(machine, call, CommandId::ControlExt, &[roll, pitch, yaw], confirms)
}

/// The step of the longer angle is not settled; here it is 2^20 per turn.
fn ext_order(axis: &ControlExtAxis) -> Order {
    let mode = axis.control_mode;
    let short_speed = axis.speed.map(|speed| {
        let fine = sbgc_proto::commands::ControlAxis::speed(speed);
        f64::from(fine.speed_in(mode))
    });
    let long_speed = axis.speed_32bit.map(sbgc_proto::units::FineRate::degrees_per_second);
    let short_angle = axis.angle.map(|angle| f64::from(angle.degrees()));
    let long_angle = axis.angle_32bit.map(|raw| f64::from(raw) * 360.0 / 1_048_576.0);
    let signal = axis.angle.map(|angle| angle.0);
    let long_signal = axis.angle_32bit.map(|raw| i16::try_from(raw).unwrap_or(i16::MAX));
    Order {
        mode,
        speed: short_speed.or(long_speed),
        angle: short_angle.or(long_angle),
        signal: signal.or(long_signal).unwrap_or_default(),
        shaping: Shaping::default(),
    }
}

fn tell(
    machine: &mut Machine,
    call: &Call<'_>,
    command: CommandId,
    orders: &[Option<Order>; 3],
    confirms: bool,
) -> Replies {
    if !machine.steering.admits(call.port) {
        // Another port has a higher priority: the command is taken and has no effect.
        return confirmed(command, confirms);
    }
    let mut replies = confirmed(command, confirms)?;
    if let Some(cancelled) = calibration::cancelled_by_control(machine) {
        replies.push(cancelled);
    }
    if !machine.steering.tell(call.now, call.port, orders, &machine.motion) {
        return Err(Refusal::Parameters);
    }
    machine.quat.stop();
    machine.steer(call.now);
    Ok(replies)
}

/// Lets all sources of motion act, and reports the angles that were to be reported.
pub(super) fn poll(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    let finished = machine.motion.finish_tasks();
    if finished {
        machine.starting = false;
    }
    let port = machine.steering.port();
    if machine.steer(now)
        && let Ok(packet) = Packet::confirmation(CommandId::Control, ConfirmData::U8(1))
    {
        replies.push((port, Reply::Send(packet)));
    }
    if finished
        && machine.procedure.is_none()
        && let Some(port) = machine.menu_reports.take()
    {
        replies.extend(
            Packet::confirmation(CommandId::ExecuteMenu, DONE).ok().map(|packet| (port, Reply::Send(packet))),
        );
    }
}
