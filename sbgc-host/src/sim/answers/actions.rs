//! Motors, restarts, sounds and virtual channels.

use std::time::Duration;

use sbgc_proto::commands::{BeepSound, CalibMode, MotorsOffMode, Reset, ResetFlags, Switch, SyncMotors};
use sbgc_proto::{CommandId, OutgoingCommand};

use crate::sim::machine::{Call, Machine};
use crate::sim::motion::Goal;
use crate::sim::procedure::{Kind, Procedure};
use crate::sim::rc::{coarse, high_res};
use crate::sim::reply::{Packet, Refusal, Replies, Reply, done, silence};

/// How long motors take at most to come to rest before they go off.
const SAFE_STOP: Duration = Duration::from_secs(2);

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::MotorsOn(_) => motors_on(machine),
        OutgoingCommand::MotorsOffSimple(_) => motors_off(machine, call, MotorsOffMode::Normal),
        OutgoingCommand::MotorsOff(request) => motors_off(machine, call, request.mode),
        OutgoingCommand::SyncMotors(request) => sync_motors(machine, call, request),
        OutgoingCommand::ResetRequest(_) => Ok(vec![Reply::Reset { after: Duration::ZERO }]),
        OutgoingCommand::ResetExtendedRequest(request) => {
            let after = Duration::from_millis(request.delay_ms.into());
            announced(request.flags.contains(ResetFlags::CONFIRM), Reply::Reset { after })
        }
        OutgoingCommand::BootMode3(_) => Ok(vec![Reply::Boot { after: Duration::ZERO }]),
        OutgoingCommand::BootMode3Extended(request) => {
            let after = Duration::from_millis(request.delay_ms.into());
            announced(request.confirm == Switch::On, Reply::Boot { after })
        }
        OutgoingCommand::BeepSound(sound) => beep(machine, sound),
        OutgoingCommand::ApiVirtChControl(channels) => {
            virtual_channels(machine, channels.api_virt_ch.iter().map(|signal| coarse(signal.0)))
        }
        OutgoingCommand::ApiVirtChControlVariable(channels) => {
            virtual_channels(machine, channels.api_virt_ch.iter().map(|signal| coarse(signal.0)))
        }
        OutgoingCommand::ApiVirtChHighRes(channels) => {
            virtual_channels(machine, channels.api_virt_ch.iter().map(|signal| high_res(signal.0)))
        }
        _ => return None,
    })
}

fn motors_on(machine: &mut Machine) -> Replies {
    if !machine.may_turn_on() {
        return Err(Refusal::State);
    }
    machine.end_stop();
    machine.set_motors(true);
    done(CommandId::MotorsOn)
}

fn motors_off(machine: &mut Machine, call: &Call<'_>, mode: MotorsOffMode) -> Replies {
    match mode {
        MotorsOffMode::SafeStop => safe_stop(machine, call.now, call.port),
        MotorsOffMode::Normal => machine.set_motors(false),
        MotorsOffMode::Brake => {
            machine.set_motors(false);
            machine.motion.brake();
        }
        _ => return Err(Refusal::Parameters),
    }
    done(CommandId::MotorsOff)
}

/// Lets the motors come to rest and then turns them off.
pub(super) fn safe_stop(machine: &mut Machine, now: Duration, port: u8) {
    if !machine.motion.motors_on() {
        return;
    }
    machine.steering.finish(false);
    machine.motion.drop_tasks();
    for axis in machine.motion.each_mut() {
        axis.goal = Goal::Rest;
    }
    machine.procedure = Some(Procedure {
        command: CommandId::MotorsOff,
        port,
        kind: Kind::SafeStop,
        mode: CalibMode::SafeStop,
        starts: now,
        ends: now.saturating_add(SAFE_STOP),
        reported: false,
        next_progress: now,
        steps: 0,
        holds: true,
    });
}

fn sync_motors(machine: &mut Machine, call: &Call<'_>, request: &SyncMotors) -> Replies {
    let axis = usize::from(request.axis.raw());
    if axis > 2 {
        return Err(Refusal::Parameters);
    }
    let ends = call.now.saturating_add(Duration::from_millis(request.time_ms.into()));
    machine.procedure = Some(Procedure {
        command: CommandId::SyncMotors,
        port: call.port,
        kind: Kind::SyncMotors { axis },
        mode: CalibMode::None,
        starts: call.now,
        ends,
        reported: false,
        next_progress: call.now,
        steps: 0,
        holds: false,
    });
    done(CommandId::SyncMotors)
}

/// A restart, with the notice that was asked for before it.
fn announced(notice: bool, restart: Reply) -> Replies {
    let mut replies = Vec::new();
    if notice {
        replies.push(Reply::Send(Packet::of(&Reset {})?));
    }
    replies.push(restart);
    Ok(replies)
}

fn beep(machine: &mut Machine, sound: &BeepSound) -> Replies {
    machine.last_sound = Some(sound.mode.bits());
    silence()
}

/// Channels that are not sent keep their state.
fn virtual_channels(machine: &mut Machine, signals: impl Iterator<Item = Option<f64>>) -> Replies {
    for (channel, signal) in signals.enumerate() {
        machine.rc.set_virtual(channel, signal);
    }
    silence()
}
