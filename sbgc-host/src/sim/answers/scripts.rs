//! Scripts of the user: starting, stopping, and carrying them out.

use std::time::Duration;

use sbgc_proto::commands::{
    EventId, EventTypes, FileId, FileType, FsErrorCode, MenuCommand, RunScriptMode, ScriptDebug,
};
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, OutgoingCommand};

use crate::sim::events::Happened;
use crate::sim::files::Files;
use crate::sim::machine::{Call, Machine, MenuRequest};
use crate::sim::motion::Goal;
use crate::sim::reply::{Packet, Refusal, Replies, Reply, done};
use crate::sim::script::{Command, STEP, Script};
use crate::sim::steering::speed_of;

/// How many slots there are.
const SLOTS: u8 = 10;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    let OutgoingCommand::RunScript(request) = command else { return None };
    Some(run(machine, call, request.mode, request.slot))
}

fn run(machine: &mut Machine, call: &Call<'_>, mode: RunScriptMode, slot: u8) -> Replies {
    let traced = match mode {
        RunScriptMode::Stop => {
            stop(machine);
            return done(CommandId::RunScript);
        }
        RunScriptMode::Start => false,
        RunScriptMode::StartWithDebug => true,
        _ => return Err(Refusal::Parameters),
    };
    let slots = if machine.config().has("2.70") { SLOTS } else { 5 };
    if slot >= slots {
        return Err(Refusal::Parameters);
    }
    if Files(&mut machine.parameters.eeprom).size(script(slot)).is_none() {
        return Err(Refusal::Failed);
    }
    start(machine, call.now, call.port, slot, traced);
    done(CommandId::RunScript)
}

fn script(slot: u8) -> FileId {
    FileId::new(FileType::Script, slot)
}

/// Starts the script of a slot; an empty slot does nothing.
pub(super) fn start(machine: &mut Machine, now: Duration, port: u8, slot: u8, traced: bool) {
    let Ok(file) = Files(&mut machine.parameters.eeprom).content(script(slot)) else { return };
    stop(machine);
    let mut script = Script::new(slot, port, traced, &file);
    script.until = now.saturating_add(STEP);
    machine.script = Some(script);
    machine.events.push(Happened::new(EventId::Script, EventTypes::ON, slot.into()));
}

/// Stops the script that runs, and what it has moving.
pub(super) fn stop(machine: &mut Machine) {
    if let Some(script) = machine.script.take() {
        machine.motion.drop_tasks();
        for axis in machine.motion.each_mut() {
            if matches!(axis.goal, Goal::Speed(_)) {
                axis.goal = Goal::Rest;
            }
        }
        machine.events.push(Happened::new(EventId::Script, EventTypes::OFF, script.slot.into()));
    }
}

/// Carries out the next command of the script that runs.
pub(super) fn poll(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    let Some(script) = &mut machine.script else { return };
    if now < script.until || (script.moving && machine.motion.has_tasks()) {
        return;
    }
    script.moving = false;
    let fetched = script.fetch();
    script.until = now.saturating_add(STEP);
    let (port, traced, cmd_count) = (script.port, script.traced, script.count);
    let mut trace = |err_code| {
        if traced && let Ok(packet) = Packet::of(&ScriptDebug { cmd_count, err_code }) {
            replies.push((port, Reply::Send(packet)));
        }
    };
    match fetched {
        Some(Ok(command)) => {
            trace(FsErrorCode::NoError);
            carry_out(machine, now, port, command);
        }
        Some(Err(())) => {
            trace(FsErrorCode::FileCorrupted);
            stop(machine);
        }
        None => stop(machine),
    }
}

fn carry_out(machine: &mut Machine, now: Duration, port: u8, command: Command) {
    match command {
        Command::Angle(angles) => {
            let speed = Some(speed_of(machine.settings().ext2.auto_speed));
            let tasks = angles.map(|angle| angle.map(|angle| Goal::Angle { angle, speed }));
            machine.motion.give_task(tasks.into());
            if let Some(script) = &mut machine.script {
                script.moving = true;
            }
        }
        Command::Speed([roll, pitch, yaw]) => {
            let tasks = PerAxis { roll, pitch, yaw };
            for (axis, speed) in machine.motion.each_mut().into_iter().zip(tasks.into_array()) {
                axis.goal = Goal::Speed(speed);
            }
        }
        Command::Wait(time) => {
            if let Some(script) = &mut machine.script {
                script.until = now.saturating_add(time);
            }
        }
        Command::Menu(command) => {
            machine.menu.push_back(MenuRequest { command: MenuCommand::from(command), port });
        }
        Command::Motors(on) => {
            if !on || machine.may_turn_on() {
                machine.set_motors(on);
            }
        }
        Command::Profile(profile) => {
            machine.parameters.activate(profile);
            machine.steer(now);
        }
        Command::Goto(_) | Command::End => {}
    }
}
