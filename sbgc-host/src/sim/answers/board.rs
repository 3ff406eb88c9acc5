//! Who the board is.

use sbgc_proto::commands::{BoardFeatures, BoardInfo, BoardInfo3, ConnectionFlags};

use sbgc_proto::units::FlashSize;
use sbgc_proto::wire::Bytes;

use super::{Replies, message};
use crate::sim::machine::Machine;

impl Machine {
    pub(super) fn board_info(&self) -> Replies {
        let config = self.config();
        message(&BoardInfo {
            board_ver: config.board,
            firmware_ver: config.firmware,
            board_features: if config.axes >= 3 { BoardFeatures::THREE_AXES } else { BoardFeatures::empty() },
            connection_flag: if config.bit_rate.is_none() {
                ConnectionFlags::USB
            } else {
                ConnectionFlags::empty()
            },
            ..BoardInfo::default()
        })
    }

    pub(super) fn board_info_3(&self) -> Replies {
        message(&BoardInfo3 {
            device_id: Bytes(*b"SIMULATED"),
            mcu_id: Bytes(*b"SIMULATEDMCU"),
            eeprom_size: u32::try_from(self.eeprom.len()).unwrap_or(u32::MAX),
            profile_set_cur: 1,
            flash_size: FlashSize(16),
            ..BoardInfo3::default()
        })
    }
}
