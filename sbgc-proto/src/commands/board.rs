//! Board identity, versions and features.

use sbgc_proto_macros::message;

use crate::declare::flags;
use crate::units::{BoardVersion, FirmwareVersion, FlashSize};
use crate::wire::{Bytes, Reserved};

/// Requests board and firmware version.
#[message(CMD_BOARD_INFO, outgoing, form = "simple", default, size = 0, length = 0, answer = BoardInfo)]
pub struct BoardInfoRequest;

/// Requests board and firmware version, and configures the driver of the port that receives the request.
///
/// The board does not check the bytes after the first two.
#[message(CMD_BOARD_INFO, outgoing, form = "extended", size = 2..=255, answer = BoardInfo, acts)]
pub struct BoardInfoExtendedRequest<'a> {
    /// On a UART, period between 20-byte packets for Bluetooth Low Energy; ignored on USB.
    #[wire(unit = "ms")]
    pub cfg: u16,
    /// Password that unlocks a protected port: its length, 1 to 32, then its bytes. Firmware 2.73.6+.
    ///
    /// See [`password`](Self::password). Published in the vendor's Python library only.
    pub reserved: &'a [u8],
}

impl<'a> BoardInfoExtendedRequest<'a> {
    /// The password; `None` if it is absent or truncated.
    pub fn password(&self) -> Option<&'a [u8]> {
        let (length, rest) = self.reserved.split_first()?;
        rest.get(..usize::from(*length)).filter(|password| !password.is_empty())
    }
}

/// Board and firmware version, firmware state and board features.
#[message(CMD_BOARD_INFO, incoming, size = 18)]
pub struct BoardInfo {
    /// Hardware version.
    pub board_ver: BoardVersion,
    /// Firmware version.
    pub firmware_ver: FirmwareVersion,
    /// Start-up progress and other firmware state flags.
    pub state_flags1: StateFlags1,
    /// Features of the board.
    pub board_features: BoardFeatures,
    /// How the board is connected.
    pub connection_flag: ConnectionFlags,
    /// Id of a special build; otherwise unused.
    pub frw_extra_id: u32,
    /// Further features of the board. Newer firmware.
    pub board_features_ext: BoardFeaturesExt,
    /// Sensor model of the main IMU. The numbers are not published. Newer firmware.
    pub main_imu_sens_model: u8,
    /// Sensor model of the frame IMU. The numbers are not published. Newer firmware.
    pub frame_imu_sens_model: u8,
    /// Build number.
    #[wire(since = "2.73")]
    pub build_number: u8,
    /// Version of the regular firmware on which special firmware is based. Newer firmware.
    pub base_frw_ver: FirmwareVersion,
}

/// Requests further board information.
#[message(CMD_BOARD_INFO_3, outgoing, size = 0, answer = BoardInfo3)]
pub struct BoardInfo3Request;

/// Further board information: device ids, memory sizes, script slots and profile sets.
#[message(CMD_BOARD_INFO_3, incoming, size = 69)]
pub struct BoardInfo3 {
    /// Unique id of the controller, as used by the licensing system.
    pub device_id: Bytes<9>,
    /// Unique id of the microcontroller.
    pub mcu_id: Bytes<12>,
    /// Size of the EEPROM, 32768 on most boards.
    #[wire(unit = "byte")]
    pub eeprom_size: u32,
    /// Size of the script in slot 1; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot1_size: u16,
    /// Size of the script in slot 2; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot2_size: u16,
    /// Size of the script in slot 3; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot3_size: u16,
    /// Size of the script in slot 4; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot4_size: u16,
    /// Size of the script in slot 5; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot5_size: u16,
    /// Profile sets that contain data.
    pub profile_set_slots: ProfileSetSlots,
    /// Active profile set.
    #[wire(range = 1..=6)]
    pub profile_set_cur: u8,
    /// Size of the flash memory. Newer firmware.
    pub flash_size: FlashSize,
    /// Calibration state of the IMUs. The format is not published. Newer firmware.
    pub imu_calib_info: Bytes<2>,
    /// Size of the script in slot 6; 0 is an empty slot. Newer firmware.
    #[wire(unit = "byte")]
    pub script_slot6_size: u16,
    /// Size of the script in slot 7; 0 is an empty slot. Newer firmware.
    #[wire(unit = "byte")]
    pub script_slot7_size: u16,
    /// Size of the script in slot 8; 0 is an empty slot. Newer firmware.
    #[wire(unit = "byte")]
    pub script_slot8_size: u16,
    /// Size of the script in slot 9; 0 is an empty slot. Newer firmware.
    #[wire(unit = "byte")]
    pub script_slot9_size: u16,
    /// Size of the script in slot 10; 0 is an empty slot. Newer firmware.
    #[wire(unit = "byte")]
    pub script_slot10_size: u16,
    /// Hardware options of the board. Newer firmware.
    pub hw_flags: HardwareFlags,
    /// Further features of the board.
    #[wire(since = "2.73")]
    pub board_features_ext2: BoardFeaturesExt2,
    /// Maximum number of CAN drivers for main motors that the licence allows.
    #[wire(since = "2.72.3")]
    pub can_drv_main_limit: u8,
    /// Maximum number of CAN drivers for auxiliary motors that the licence allows.
    #[wire(since = "2.72.3")]
    pub can_drv_aux_limit: u8,
    /// Total number of adjustable variables.
    #[wire(since = "2.73")]
    pub adj_vars_total_num: u8,
    pub reserved: Reserved<10>,
}

impl BoardInfo3 {
    /// Sizes of the scripts in slots 1 to 10, in bytes.
    pub const fn script_slot_sizes(&self) -> [u16; 10] {
        [
            self.script_slot1_size,
            self.script_slot2_size,
            self.script_slot3_size,
            self.script_slot4_size,
            self.script_slot5_size,
            self.script_slot6_size,
            self.script_slot7_size,
            self.script_slot8_size,
            self.script_slot9_size,
            self.script_slot10_size,
        ]
    }
}

flags! {
    /// Start-up progress and other firmware state flags. Spec: `STATE_FLAGS1`.
    pub struct StateFlags1: u8 {
        /// For internal use.
        const DEBUG_MODE = 1 << 0;
        /// The frame is upside down. Firmware 2.66+.
        const IS_FRAME_INVERTED = 1 << 1;
        /// Basic sensors are initialized, and frame inversion is applied. Firmware 2.66+.
        const INIT_STEP1_DONE = 1 << 2;
        /// RC inputs and adjustable variables are initialized; automatic positioning starts. Firmware 2.66+.
        const INIT_STEP2_DONE = 1 << 3;
        /// Positioning and calibrations at start-up are complete. Firmware 2.66+.
        const STARTUP_AUTO_ROUTINE_DONE = 1 << 4;
        /// Power management is enabled. Newer firmware.
        const POWER_MANAGER_ENABLED = 1 << 5;
    }
}

flags! {
    /// Features of the board. Spec: `BOARD_FEATURE`.
    ///
    /// Flags above [`CURRENT_SENSOR`](Self::CURRENT_SENSOR) are reported by newer firmware only.
    pub struct BoardFeatures: u16, prefix "BOARD_FEATURE_" {
        /// Three-axis stabilization.
        const THREE_AXES "BOARD_FEATURE_3AXIS" = 1 << 0;
        /// Battery monitoring.
        const BAT_MONITORING = 1 << 1;
        /// Motor encoders.
        const ENCODERS = 1 << 2;
        /// Bode test.
        const BODE_TEST = 1 << 3;
        /// User scripts.
        const SCRIPTING = 1 << 4;
        /// Current sensor.
        const CURRENT_SENSOR = 1 << 5;
        /// Magnetometer.
        const MAG_SENSOR = 1 << 6;
        /// Supports the axis order of the Letus gimbal.
        const ORDER_OF_AXES_LETUS = 1 << 7;
        /// The main IMU has an EEPROM of its own.
        const IMU_EEPROM = 1 << 8;
        /// The frame IMU has an EEPROM of its own.
        const FRAME_IMU_EEPROM = 1 << 9;
        /// CAN port.
        const CAN_PORT = 1 << 10;
        /// Estimation of moments of inertia.
        const MOMENTUM = 1 << 11;
        /// Cogging correction.
        const COGGING_CORRECTION = 1 << 12;
        /// Control of a fourth motor.
        const MOTOR4_CONTROL = 1 << 13;
        /// Automatic calibration of the accelerometer.
        const ACC_AUTO_CALIB = 1 << 14;
        /// Larger flash memory.
        const BIG_FLASH = 1 << 15;
    }
}

flags! {
    /// Further features of the board. Newer firmware. Spec: `BOARD_FEATURE_EXT`.
    pub struct BoardFeaturesExt: u16 {
        /// External IMU.
        const EXT_IMU = 1 << 0;
        /// State variables, see `CMD_READ_STATE_VARS`.
        const STATE_VARS = 1 << 2;
        /// Power management.
        const POWER_MANAGEMENT = 1 << 3;
        /// Advanced calibration of the gyroscope.
        const GYRO_ADVANCED_CALIB = 1 << 4;
        /// Limited version of the board.
        const LIMITED_VERSION = 1 << 5;
        /// Undocumented; only the name is published.
        const REACTION = 1 << 6;
        /// Lookup tables for encoders.
        const ENCODER_LUT = 1 << 7;
    }
}

flags! {
    /// Further features of the board. Spec: `BOARD_FEATURE_EXT2`.
    pub struct BoardFeaturesExt2: u32 {
        /// "Plus" version of the board.
        const PLUS_VER = 1 << 0;
        /// Shake generator.
        const SHAKE_GENERATOR = 1 << 1;
        /// Control of auxiliary motors.
        const EXT_MOTORS = 1 << 2;
        /// Control by quaternion, see `CMD_CONTROL_QUAT`.
        const QUAT_CONTROL = 1 << 3;
        /// Fourth analog input.
        const ADC4 = 1 << 4;
    }
}

flags! {
    /// How the board is connected. Spec: `CONNECTION_FLAG`.
    pub struct ConnectionFlags: u8, prefix "CONNECTION_" {
        /// Connected over USB.
        const USB = 1 << 0;
    }
}

flags! {
    /// Hardware options of the board. Spec: `HARDWARE_FLAGS`.
    pub struct HardwareFlags: u16 {
        /// One-wire encryption chip.
        const ONE_WIRE_CRYPTO_IC = 1 << 0;
    }
}

flags! {
    /// Profile sets. Spec: `PROFILE_SET_SLOTS`.
    ///
    /// One passage of the specification assigns bit 2 to set 2; in fact the sets use bits 0 to 5 in order.
    pub struct ProfileSetSlots: u8, prefix "PROFILE_" {
        /// Set 1.
        const SET_1 = 1 << 0;
        /// Set 2.
        const SET_2 = 1 << 1;
        /// Set 3.
        const SET_3 = 1 << 2;
        /// Set 4.
        const SET_4 = 1 << 3;
        /// Set 5.
        const SET_5 = 1 << 4;
        /// Backup set.
        const BACKUP "PROFILE_SET_BACKUP" = 1 << 5;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Message;

    /// Made by hand from the layout.
    #[test]
    fn info_names_the_bytes_of_newer_firmware() {
        let payload = [41, 0xAF, 0x0A, 0x9E, 0x05, 0x84, 1, 4, 3, 2, 1, 0x85, 0x80, 7, 8, 9, 0x01, 0x09];
        let info = BoardInfo::decode(&payload).unwrap();
        assert_eq!(info.board_ver, BoardVersion::PRO);
        assert_eq!(info.firmware_ver.to_string(), "2.73.5");
        assert_eq!(info.state_flags1.bits(), 0x9E);
        assert_eq!(
            info.board_features,
            BoardFeatures::THREE_AXES
                | BoardFeatures::ENCODERS
                | BoardFeatures::CAN_PORT
                | BoardFeatures::BIG_FLASH
        );
        assert_eq!(info.connection_flag, ConnectionFlags::USB);
        assert_eq!(info.frw_extra_id, 0x0102_0304);
        assert_eq!(info.board_features_ext.bits(), 0x8085);
        assert_eq!((info.main_imu_sens_model, info.frame_imu_sens_model, info.build_number), (7, 8, 9));
        assert_eq!(info.base_frw_ver.to_string(), "2.30b5");
        assert_eq!(info.encode(&mut [0; 18]), Ok(&payload[..]));
        assert!(BoardInfo::decode(&payload[..17]).is_err());
    }

    /// Made by hand from the layout: every byte is its own offset.
    #[test]
    fn info_3_has_every_byte_in_its_place() {
        let payload: [u8; 69] = core::array::from_fn(|index| u8::try_from(index).unwrap());
        let info = BoardInfo3::decode(&payload).unwrap();
        assert_eq!(info.device_id.0, [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(info.mcu_id.0[0], 9);
        assert_eq!(info.eeprom_size, 0x1817_1615);
        assert_eq!(info.script_slot_sizes()[4], 0x2221);
        assert_eq!((info.profile_set_slots.bits(), info.profile_set_cur), (35, 36));
        assert_eq!((info.flash_size, info.imu_calib_info.0), (FlashSize(37), [38, 39]));
        assert_eq!(info.script_slot_sizes()[5], 0x2928);
        assert_eq!(info.script_slot_sizes()[9], 0x3130);
        assert_eq!(info.hw_flags.bits(), 0x3332);
        assert_eq!(info.board_features_ext2.bits(), 0x3736_3534);
        assert_eq!((info.can_drv_main_limit, info.can_drv_aux_limit, info.adj_vars_total_num), (56, 57, 58));
        assert_eq!(info.reserved.0[0], 59);
        assert_eq!(info.encode(&mut [0; 69]), Ok(&payload[..]));
        assert!(BoardInfo3::decode(&payload[..68]).is_err());
    }

    #[test]
    fn requests_differ_by_length() {
        assert!(BoardInfoRequest::accepts(0) && !BoardInfoRequest::accepts(2));
        let payload = [20, 0, 3, b'a', b'b', b'c', 0xFF];
        let request = BoardInfoExtendedRequest::decode(&payload).unwrap();
        assert_eq!((request.cfg, request.password()), (20, Some(&b"abc"[..])));
        assert_eq!(request.encode(&mut [0; 255]), Ok(&payload[..]));
        for none in [&[20, 0][..], &[20, 0, 0], &[20, 0, 9, 1]] {
            assert_eq!(BoardInfoExtendedRequest::decode(none).unwrap().password(), None);
        }
        assert!(BoardInfoExtendedRequest::decode(&[20]).is_err());
    }
}
