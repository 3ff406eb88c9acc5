//! What the board answers to each command: one file per topic, in the topics of the commands.
//!
//! A topic has a function that takes a decoded command and returns what follows from it, or `None` for a command of
//! another topic; and, where something happens later, a function that is called each time the board works through its
//! queue. Topics know the [`Machine`] and, where they start something, the topic that runs it. Nobody knows them but
//! the lists below.

mod actions;
mod adjustable;
mod board;
mod calibration;
mod can;
mod control;
mod debug;
mod ext_motors;
mod imu;
mod menu;
mod params;
mod pins;
mod power;
mod quaternion;
mod realtime;
mod scripts;
mod storage;
mod streams;
mod system;
mod tuning;

use std::time::Duration;

use sbgc_proto::commands::AutoPid2Error;
use sbgc_proto::{CommandId, OutgoingCommand};

use super::machine::{Call, Machine};
use super::reply::{Refusal, Replies, Reply};

pub(super) use streams::samples;
pub(super) use system::is_left_out;

type Answer = fn(&mut Machine, &Call<'_>, &OutgoingCommand<'_>) -> Option<Replies>;

/// What the board does by itself, with the port that receives it.
type Poll = fn(&mut Machine, Duration, &mut Vec<(u8, Reply)>);

const ANSWERS: &[Answer] = &[
    actions::answer,
    adjustable::answer,
    board::answer,
    calibration::answer,
    can::answer,
    control::answer,
    debug::answer,
    ext_motors::answer,
    imu::answer,
    menu::answer,
    params::answer,
    pins::answer,
    quaternion::answer,
    realtime::answer,
    scripts::answer,
    storage::answer,
    streams::answer,
    system::answer,
    tuning::answer,
];

const POLLS: &[Poll] = &[
    power::poll,
    adjustable::poll,
    scripts::poll,
    menu::poll,
    quaternion::poll,
    control::poll,
    calibration::poll,
    tuning::poll,
    later,
];

/// Carries out a command.
pub(super) fn answer(machine: &mut Machine, call: &Call<'_>) -> Replies {
    carry_out(machine, call).or_else(|refusal| refusal.replies(call.id.into()))
}

fn carry_out(machine: &mut Machine, call: &Call<'_>) -> Replies {
    let id = CommandId::from(call.id);
    let Some(command) = decoded(id, call.payload) else {
        return Err(wrong_size(machine, id));
    };
    let form = command.form();
    if let Some(info) = OutgoingCommand::ALL.iter().find(|info| info.id == id && info.form == form) {
        if !machine.config().knows(info.since) {
            return Err(Refusal::Unknown);
        }
        // The finer virtual channels are 31 in the text and 32 for the vendor's library.
        if !info.size.contains(&call.payload.len()) && id != CommandId::ApiVirtChHighRes {
            return Err(wrong_size(machine, id));
        }
    }
    let answers = ANSWERS.iter().find_map(|answer| answer(machine, call, &command));
    // What is left are ids of which nobody has published the payload.
    answers.unwrap_or(Err(match command {
        OutgoingCommand::Unknown { .. } => Refusal::Unknown,
        _ => Refusal::NotSupported,
    }))
}

/// The command, if its payload has a size that the command has.
fn decoded(id: CommandId, payload: &[u8]) -> Option<OutgoingCommand<'_>> {
    let (command, rest) = OutgoingCommand::decode(id, payload).ok()?;
    rest.is_empty().then_some(command)
}

/// A body whose size differs from what is expected is ignored; tuning has an error code for it.
fn wrong_size(machine: &Machine, id: CommandId) -> Refusal {
    match id {
        CommandId::AutoPid2 if machine.config().has("2.70") => {
            Refusal::Tuning(AutoPid2Error::WrongCommandSize)
        }
        _ if is_newer(machine, id) => Refusal::Unknown,
        _ => Refusal::Silent,
    }
}

/// Whether the command exists, but the firmware is older than all of its forms.
fn is_newer(machine: &Machine, id: CommandId) -> bool {
    let mut forms = OutgoingCommand::ALL.iter().filter(|form| form.id == id).peekable();
    forms.peek().is_some() && forms.all(|form| !machine.config().knows(form.since))
}

/// What the board does by itself when it works through its queue.
pub(super) fn poll(machine: &mut Machine, now: Duration) -> Vec<(u8, Reply)> {
    let mut replies = Vec::new();
    for poll in POLLS {
        poll(machine, now, &mut replies);
    }
    replies
}

/// Sends what was to be sent later.
fn later(machine: &mut Machine, now: Duration, replies: &mut Vec<(u8, Reply)>) {
    machine.later.sort_by_key(|(time, ..)| *time);
    let due = machine.later.iter().take_while(|(time, ..)| *time <= now).count();
    replies.extend(machine.later.drain(..due).map(|(_, port, reply)| (port, reply)));
}
