//! Parameters, profiles and sets of them.

use std::time::Duration;

use sbgc_proto::commands::{
    ProfileId, ProfileSet, ProfileSetAction, Reset, WriteParamsSetAction, WriteProfileNames,
};
use sbgc_proto::{CommandId, OutgoingCommand};

use crate::sim::eeprom::{Block, Region};
use crate::sim::machine::{Call, Machine};
use crate::sim::parameters::PROFILES;
use crate::sim::reply::{Packet, RESET_NOTICE, Refusal, Replies, Reply, done, send};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::ReadParams3(request) => read(machine, Block::Params3, request.profile_id),
        OutgoingCommand::ReadParamsExt(request) => read(machine, Block::Ext, request.profile_id),
        OutgoingCommand::ReadParamsExt2(request) => read(machine, Block::Ext2, request.profile_id),
        OutgoingCommand::ReadParamsExt3(request) => read(machine, Block::Ext3, request.profile_id),
        OutgoingCommand::WriteParams3(_) => write(machine, call, Block::Params3),
        OutgoingCommand::WriteParamsExt(_) => write(machine, call, Block::Ext),
        OutgoingCommand::WriteParamsExt2(_) => write(machine, call, Block::Ext2),
        OutgoingCommand::WriteParamsExt3(_) => write(machine, call, Block::Ext3),
        OutgoingCommand::ReadParams(request) => read_of_old(machine, request.profile_id),
        OutgoingCommand::WriteParams(_) => write_of_old(machine, call),
        OutgoingCommand::WriteParamsSet(set) => series(machine, set.action),
        OutgoingCommand::ReadProfileNames(_) => names(machine),
        OutgoingCommand::WriteProfileNames(names) => rename(machine, names),
        OutgoingCommand::UseDefaults(request) => use_defaults(machine, request.profile_id),
        OutgoingCommand::ProfileSet(request) => profile_set(machine, request),
        _ => return None,
    })
}

/// The packet with a block, as its command answers and as calibrations send it unasked.
pub(super) fn packet(machine: &Machine, block: Block, profile: ProfileId) -> Result<Packet, Refusal> {
    let payload = machine.parameters.read(block, profile)?;
    Ok(Packet { id: block.read_by(), payload })
}

/// All blocks of a profile.
pub(super) fn packets(machine: &Machine, profile: ProfileId) -> impl Iterator<Item = Packet> {
    Block::ALL.into_iter().filter_map(move |block| packet(machine, block, profile).ok())
}

fn read(machine: &Machine, block: Block, profile: ProfileId) -> Replies {
    send(packet(machine, block, profile))
}

fn write(machine: &mut Machine, call: &Call<'_>, block: Block) -> Replies {
    let restart = machine.parameters.write(block, call.payload);
    machine.steer(call.now);
    with_restart(done(call.id.into())?, restart)
}

/// The layout of the old commands is not published for boards of 32 bits; here it is that of block 1.
fn read_of_old(machine: &Machine, profile: ProfileId) -> Replies {
    let payload = machine.parameters.read(Block::Params3, profile)?;
    send(Ok(Packet { id: CommandId::ReadParams, payload }))
}

fn write_of_old(machine: &mut Machine, call: &Call<'_>) -> Replies {
    if call.payload.len() == Block::Params3.size() {
        write(machine, call, Block::Params3)
    } else {
        Err(Refusal::Silent)
    }
}

fn series(machine: &mut Machine, action: WriteParamsSetAction) -> Replies {
    let begins = match action {
        WriteParamsSetAction::Start => true,
        WriteParamsSetAction::Finish => false,
        _ => return Err(Refusal::Parameters),
    };
    let restart = machine.parameters.series(begins);
    with_restart(done(CommandId::WriteParamsSet)?, restart)
}

/// A reset that the board makes by itself is announced.
pub(super) fn with_restart(mut replies: Vec<Reply>, restart: bool) -> Replies {
    if restart {
        replies.push(Reply::Send(Packet::of(&Reset {})?));
        replies.push(Reply::Reset { after: RESET_NOTICE });
    }
    Ok(replies)
}

fn names(machine: &Machine) -> Replies {
    let payload = machine.parameters.eeprom.region(Region::Names).to_vec();
    send(Ok(Packet { id: CommandId::ReadProfileNames, payload }))
}

fn rename(machine: &mut Machine, WriteProfileNames(names): &WriteProfileNames) -> Replies {
    let payload = Packet::of(names)?.payload;
    machine.parameters.eeprom.set_region(Region::Names, &payload);
    done(CommandId::WriteProfileNames)
}

/// Puts profiles back to what they were in the factory. Erasing the EEPROM restarts the board.
fn use_defaults(machine: &mut Machine, profile: ProfileId) -> Replies {
    let mut replies = done(CommandId::UseDefaults)?;
    match profile {
        ProfileId::EraseEeprom => {
            machine.parameters.eeprom.erase();
            replies.push(Reply::Reset { after: Duration::ZERO });
        }
        ProfileId::ResetCurrent => machine.parameters.restore(machine.parameters.active()),
        profile if profile.raw() < PROFILES => machine.parameters.restore(profile.raw()),
        _ => return Err(Refusal::Parameters),
    }
    Ok(replies)
}

fn profile_set(machine: &mut Machine, request: &ProfileSet) -> Replies {
    let slot = request.slot.raw();
    match request.action {
        ProfileSetAction::Save => machine.parameters.save_set(slot)?,
        ProfileSetAction::Clear => machine.parameters.clear_set(slot)?,
        ProfileSetAction::Load => machine.parameters.load_set(slot)?,
        _ => return Err(Refusal::Parameters),
    }
    done(CommandId::ProfileSet)
}
