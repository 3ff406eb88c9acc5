//! Who the board is.

use sbgc_proto::OutgoingCommand;
use sbgc_proto::commands::{
    AdjustableVariable, BoardFeatures, BoardFeaturesExt, BoardFeaturesExt2, BoardInfo, BoardInfo3,
    ConnectionFlags, FileId, FileType, GeneralFlags1, ProfileSetSlots, StateFlags1,
};
use sbgc_proto::units::FlashSize;
use sbgc_proto::wire::Bytes;

use crate::sim::DEVICE_ID;
use crate::sim::files::Files;
use crate::sim::machine::{Call, Machine};
use crate::sim::reply::{Replies, message};

pub(super) fn answer(machine: &mut Machine, _: &Call<'_>, command: &OutgoingCommand<'_>) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::BoardInfoRequest(_) | OutgoingCommand::BoardInfoExtendedRequest(_) => info(machine),
        OutgoingCommand::BoardInfo3Request(_) => info_3(machine),
        _ => return None,
    })
}

fn info(machine: &Machine) -> Replies {
    let config = machine.config();
    let usb = if config.bit_rate.is_none() { ConnectionFlags::USB } else { ConnectionFlags::empty() };
    let mut state_flags1 = StateFlags1::INIT_STEP1_DONE | StateFlags1::INIT_STEP2_DONE;
    state_flags1.set(StateFlags1::STARTUP_AUTO_ROUTINE_DONE, !machine.starting);
    let flags = machine.settings().params.general_flags1;
    state_flags1.set(StateFlags1::IS_FRAME_INVERTED, flags.contains(GeneralFlags1::IS_UPSIDE_DOWN));
    message(&BoardInfo {
        board_ver: config.board,
        firmware_ver: config.firmware,
        state_flags1,
        board_features: features(machine),
        connection_flag: usb,
        board_features_ext: BoardFeaturesExt::EXT_IMU | BoardFeaturesExt::STATE_VARS,
        base_frw_ver: config.firmware,
        ..BoardInfo::default()
    })
}

/// What the board has, and what its data therefore show.
fn features(machine: &Machine) -> BoardFeatures {
    let mut features = BoardFeatures::BAT_MONITORING
        | BoardFeatures::ENCODERS
        | BoardFeatures::BODE_TEST
        | BoardFeatures::SCRIPTING
        | BoardFeatures::CURRENT_SENSOR
        | BoardFeatures::MAG_SENSOR
        | BoardFeatures::CAN_PORT
        | BoardFeatures::MOMENTUM
        | BoardFeatures::COGGING_CORRECTION
        | BoardFeatures::MOTOR4_CONTROL
        | BoardFeatures::BIG_FLASH;
    features.set(BoardFeatures::THREE_AXES, machine.config().axes >= 3);
    features
}

fn info_3(machine: &mut Machine) -> Replies {
    let new = machine.config().has("2.73");
    let sets = machine.parameters.sets();
    let current = machine.parameters.current_set();
    let eeprom_size = u32::try_from(machine.parameters.eeprom.len()).unwrap_or(u32::MAX);
    let mut size = |slot| {
        let files = Files(&mut machine.parameters.eeprom);
        files.size(FileId::new(FileType::Script, slot)).unwrap_or_default()
    };
    message(&BoardInfo3 {
        device_id: Bytes(DEVICE_ID),
        mcu_id: Bytes(*b"SIMULATEDMCU"),
        eeprom_size,
        script_slot1_size: size(0),
        script_slot2_size: size(1),
        script_slot3_size: size(2),
        script_slot4_size: size(3),
        script_slot5_size: size(4),
        profile_set_slots: ProfileSetSlots::from_bits_retain(sets),
        profile_set_cur: current,
        flash_size: FlashSize(16),
        script_slot6_size: size(5),
        script_slot7_size: size(6),
        script_slot8_size: size(7),
        script_slot9_size: size(8),
        script_slot10_size: size(9),
        board_features_ext2: if new {
            BoardFeaturesExt2::EXT_MOTORS
                | BoardFeaturesExt2::QUAT_CONTROL
                | BoardFeaturesExt2::SHAKE_GENERATOR
        } else {
            BoardFeaturesExt2::empty()
        },
        adj_vars_total_num: if new {
            u8::try_from(AdjustableVariable::ALL.len()).unwrap_or(u8::MAX)
        } else {
            0
        },
        ..BoardInfo3::default()
    })
}
