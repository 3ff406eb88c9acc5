//! The debug port, signatures, and protection by password.
//!
//! Simplified: signatures are made up and the same for the same message. A protection that is set keeps nobody out, since
//! nobody has published how a host proves that it knows the password.

use sbgc_proto::commands::{
    DebugPortAction, DebugPortFilter, PassProtectFlags, PassProtectRead, SetDebugPortRequest, SignMessage,
    SignMessageRequest,
};
use sbgc_proto::wire::Bytes;
use sbgc_proto::{CommandId, OutgoingCommand};

use super::can::crc32;
use crate::sim::machine::{Call, Machine};
use crate::sim::reply::{Refusal, Replies, done, message};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::SetDebugPortRequest(request) => debug_port(machine, call, request),
        OutgoingCommand::SignMessageRequest(request) => sign(request),
        OutgoingCommand::PassProtectReadRequest(_) => {
            let flags = u32::from_le_bytes(machine.parameters.eeprom.protection());
            let flags = PassProtectFlags::from_bits_retain(flags);
            message(&PassProtectRead { flags, ..PassProtectRead::default() })
        }
        OutgoingCommand::PassProtectWrite(write) => {
            machine.parameters.eeprom.set_protection(write.flags.bits().to_le_bytes());
            done(CommandId::PassProtectWrite)
        }
        _ => return None,
    })
}

fn debug_port(machine: &mut Machine, call: &Call<'_>, request: &SetDebugPortRequest) -> Replies {
    match request.action {
        DebugPortAction::Stop => {
            machine.debug_ports.remove(&call.port);
        }
        DebugPortAction::Start => {
            machine.debug_ports.insert(call.port, request.cmd_filter);
        }
        _ => return Err(Refusal::Parameters),
    }
    done(CommandId::SetDebugPort)
}

fn sign(request: &SignMessageRequest) -> Replies {
    let mut signature = [0; 32];
    let mut sum = crc32(&[request.sign_type]);
    for (place, part) in signature.chunks_mut(4).zip(request.message.0.chunks(4)) {
        sum = crc32(part) ^ sum.rotate_left(7);
        for (place, byte) in place.iter_mut().zip(sum.to_le_bytes()) {
            *place = byte;
        }
    }
    message(&SignMessage { signature: Bytes(signature) })
}

/// Whether a debug port wants to see messages of this command; the filter names those to leave out.
pub(in crate::sim) fn is_left_out(filter: DebugPortFilter, id: u8) -> bool {
    let flag = match CommandId::from(id) {
        CommandId::RealtimeData3 => DebugPortFilter::REALTIME_DATA_3,
        CommandId::RealtimeData4 => DebugPortFilter::REALTIME_DATA_4,
        CommandId::RealtimeDataCustom => DebugPortFilter::REALTIME_DATA_CUSTOM,
        CommandId::DebugVars3 => DebugPortFilter::DEBUG_VARS_3,
        CommandId::MavlinkDebug => DebugPortFilter::MAVLINK_DEBUG,
        CommandId::GetAngles => DebugPortFilter::GET_ANGLES,
        CommandId::GetAnglesExt => DebugPortFilter::GET_ANGLES_EXT,
        CommandId::BodeTestData => DebugPortFilter::BODE_TEST_DATA,
        CommandId::HelperData => DebugPortFilter::HELPER_DATA,
        CommandId::AhrsHelper => DebugPortFilter::AHRS_HELPER,
        CommandId::GyroCorrection => DebugPortFilter::GYRO_CORRECTION,
        CommandId::Control => DebugPortFilter::CONTROL,
        CommandId::SetAdjVarsVal => DebugPortFilter::SET_ADJ_VARS_VAL,
        CommandId::ApiVirtChControl => DebugPortFilter::API_VIRT_CH_CONTROL,
        CommandId::ApiVirtChHighRes => DebugPortFilter::API_VIRT_CH_HIGH_RES,
        _ => return false,
    };
    filter.contains(flag)
}
