//! What the board is: identity, versions, features.

use sbgc_proto_macros::message;

use crate::units::{BoardVersion, FirmwareVersion, FlashSize};
use crate::wire::{Bytes, Reserved, flags};

/// Asks what the board is.
#[message(CMD_BOARD_INFO, outgoing, form = "simple", default, size = 0, length = 0, answer = BoardInfo)]
pub struct BoardInfoRequest {}

/// Asks what the board is, and sets up the driver of the port on which it comes.
///
/// The board does not check what follows the first two bytes.
#[message(CMD_BOARD_INFO, outgoing, form = "extended", size = 2..=255, answer = BoardInfo, acts)]
pub struct BoardInfoExtendedRequest<'a> {
    /// On a UART the time between packets of 20 bytes, as Bluetooth Low Energy wants them; without meaning on USB.
    #[wire(unit = "ms")]
    pub cfg: u16,
    /// From firmware 2.73.6 on a password that opens a protected port: its length, 1 to 32, then its bytes.
    ///
    /// See [`password`](Self::password). Published in the vendor's Python library only.
    pub reserved: &'a [u8],
}

impl<'a> BoardInfoExtendedRequest<'a> {
    /// The password, `None` where there is none, or not all of it.
    pub fn password(&self) -> Option<&'a [u8]> {
        let (length, rest) = self.reserved.split_first()?;
        rest.get(..usize::from(*length)).filter(|password| !password.is_empty())
    }
}

/// What the board is.
#[message(CMD_BOARD_INFO, incoming, size = 18)]
pub struct BoardInfo {
    /// Version of the hardware.
    pub board_ver: BoardVersion,
    /// Version of the firmware.
    pub firmware_ver: FirmwareVersion,
    /// How far the start has come, and other states of the firmware.
    pub state_flags1: StateFlags1,
    /// What the board can do.
    pub board_features: BoardFeatures,
    /// How the board is connected.
    pub connection_flag: ConnectionFlags,
    /// Marks special builds; without meaning otherwise.
    pub frw_extra_id: u32,
    /// More of what the board can do, in newer firmware.
    pub board_features_ext: BoardFeaturesExt,
    /// Model of the sensor of the main IMU, in newer firmware. The numbers are not published.
    pub main_imu_sens_model: u8,
    /// Model of the sensor of the frame IMU, in newer firmware. The numbers are not published.
    pub frame_imu_sens_model: u8,
    /// Number of the build.
    #[wire(since = "2.73")]
    pub build_number: u8,
    /// Version of the firmware on which a special one is based, in newer firmware.
    pub base_frw_ver: FirmwareVersion,
}

/// Asks for more about the board.
#[message(CMD_BOARD_INFO_3, outgoing, size = 0, answer = BoardInfo3)]
pub struct BoardInfo3Request {}

/// More about the board: ids, memory, scripts, sets of profiles, and what newer firmware tells.
#[message(CMD_BOARD_INFO_3, incoming, size = 69)]
pub struct BoardInfo3 {
    /// The controller's id in the licensing system; no two are the same.
    pub device_id: Bytes<9>,
    /// The processor's id; no two are the same.
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
    /// The sets of profiles that are not empty.
    pub profile_set_slots: ProfileSetSlots,
    /// The set of profiles in use.
    #[wire(range = 1..=6)]
    pub profile_set_cur: u8,
    /// Size of the flash memory, in newer firmware.
    pub flash_size: FlashSize,
    /// What the IMUs are calibrated for, in newer firmware. The bytes are not published.
    pub imu_calib_info: Bytes<2>,
    /// Size of the script in slot 6, in newer firmware; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot6_size: u16,
    /// Size of the script in slot 7, in newer firmware; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot7_size: u16,
    /// Size of the script in slot 8, in newer firmware; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot8_size: u16,
    /// Size of the script in slot 9, in newer firmware; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot9_size: u16,
    /// Size of the script in slot 10, in newer firmware; 0 is an empty slot.
    #[wire(unit = "byte")]
    pub script_slot10_size: u16,
    /// What is on the board, in newer firmware.
    pub hw_flags: HardwareFlags,
    /// Still more of what the board can do.
    #[wire(since = "2.73")]
    pub board_features_ext2: BoardFeaturesExt2,
    /// How many CAN drivers of main motors the licence allows.
    #[wire(since = "2.72.3")]
    pub can_drv_main_limit: u8,
    /// How many CAN drivers of auxiliary motors the licence allows.
    #[wire(since = "2.72.3")]
    pub can_drv_aux_limit: u8,
    /// How many adjustable variables there are.
    #[wire(since = "2.73")]
    pub adj_vars_total_num: u8,
    pub reserved: Reserved<10>,
}

impl BoardInfo3 {
    /// Sizes of the scripts in all ten slots, in bytes.
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
    /// How far the start has come, and other states of the firmware. Spec: `STATE_FLAGS1`.
    pub struct StateFlags1: u8 {
        /// For internal use.
        const DEBUG_MODE = 1 << 0;
        /// The frame is upside down. Firmware 2.66 and later.
        const IS_FRAME_INVERTED = 1 << 1;
        /// Basic sensors are ready, and the frame's inversion is applied. Firmware 2.66 and later.
        const INIT_STEP1_DONE = 1 << 2;
        /// Radio control and adjustable variables are ready, and positioning begins. Firmware 2.66 and later.
        const INIT_STEP2_DONE = 1 << 3;
        /// Positioning and calibrations at the start are done. Firmware 2.66 and later.
        const STARTUP_AUTO_ROUTINE_DONE = 1 << 4;
        /// Power management is on. Newer firmware.
        const POWER_MANAGER_ENABLED = 1 << 5;
    }
}

flags! {
    /// What the board can do. Those above [`CURRENT_SENSOR`](Self::CURRENT_SENSOR) are told by newer firmware.
    ///
    /// Spec: `BOARD_FEATURE`.
    pub struct BoardFeatures: u16 {
        /// It controls three axes.
        const THREE_AXES "BOARD_FEATURE_3AXIS" = 1 << 0;
        /// It measures the battery.
        const BAT_MONITORING "BOARD_FEATURE_BAT_MONITORING" = 1 << 1;
        /// It has encoders on the motors.
        const ENCODERS "BOARD_FEATURE_ENCODERS" = 1 << 2;
        /// It runs the Bode test.
        const BODE_TEST "BOARD_FEATURE_BODE_TEST" = 1 << 3;
        /// It runs scripts.
        const SCRIPTING "BOARD_FEATURE_SCRIPTING" = 1 << 4;
        /// It measures the current.
        const CURRENT_SENSOR "BOARD_FEATURE_CURRENT_SENSOR" = 1 << 5;
        /// It has a magnetometer.
        const MAG_SENSOR "BOARD_FEATURE_MAG_SENSOR" = 1 << 6;
        /// Its axes can have the order of the Letus gimbal.
        const ORDER_OF_AXES_LETUS "BOARD_FEATURE_ORDER_OF_AXES_LETUS" = 1 << 7;
        /// The main IMU has its own EEPROM.
        const IMU_EEPROM "BOARD_FEATURE_IMU_EEPROM" = 1 << 8;
        /// The frame IMU has its own EEPROM.
        const FRAME_IMU_EEPROM "BOARD_FEATURE_FRAME_IMU_EEPROM" = 1 << 9;
        /// It has a CAN port.
        const CAN_PORT "BOARD_FEATURE_CAN_PORT" = 1 << 10;
        /// It knows the moments of inertia.
        const MOMENTUM "BOARD_FEATURE_MOMENTUM" = 1 << 11;
        /// It corrects cogging.
        const COGGING_CORRECTION "BOARD_FEATURE_COGGING_CORRECTION" = 1 << 12;
        /// It controls a fourth motor.
        const MOTOR4_CONTROL "BOARD_FEATURE_MOTOR4_CONTROL" = 1 << 13;
        /// It calibrates the accelerometer by itself.
        const ACC_AUTO_CALIB "BOARD_FEATURE_ACC_AUTO_CALIB" = 1 << 14;
        /// It has the larger flash memory.
        const BIG_FLASH "BOARD_FEATURE_BIG_FLASH" = 1 << 15;
    }
}

flags! {
    /// More of what the board can do, as newer firmware tells. Spec: `BOARD_FEATURE_EXT`.
    pub struct BoardFeaturesExt: u16 {
        /// It takes an external IMU.
        const EXT_IMU = 1 << 0;
        /// It keeps the state variables of `CMD_READ_STATE_VARS`.
        const STATE_VARS = 1 << 2;
        /// It manages power.
        const POWER_MANAGEMENT = 1 << 3;
        /// It has the advanced calibration of the gyroscope.
        const GYRO_ADVANCED_CALIB = 1 << 4;
        /// It is a limited version.
        const LIMITED_VERSION = 1 << 5;
        /// The spec has only the name.
        const REACTION = 1 << 6;
        /// It has look-up tables for encoders.
        const ENCODER_LUT = 1 << 7;
    }
}

flags! {
    /// Still more of what the board can do. Spec: `BOARD_FEATURE_EXT2`.
    pub struct BoardFeaturesExt2: u32 {
        /// It is a Plus version.
        const PLUS_VER = 1 << 0;
        /// It has the shake generator.
        const SHAKE_GENERATOR = 1 << 1;
        /// It controls auxiliary motors.
        const EXT_MOTORS = 1 << 2;
        /// It takes attitudes as quaternions: `CMD_CONTROL_QUAT`.
        const QUAT_CONTROL = 1 << 3;
        /// It has a fourth analog input.
        const ADC4 = 1 << 4;
    }
}

flags! {
    /// How the board is connected. Spec: `CONNECTION_FLAG`.
    pub struct ConnectionFlags: u8 {
        /// Over USB.
        const USB "CONNECTION_USB" = 1 << 0;
    }
}

flags! {
    /// What is on the board. Spec: `HARDWARE_FLAGS`.
    pub struct HardwareFlags: u16 {
        /// A one-wire chip for encryption.
        const ONE_WIRE_CRYPTO_IC = 1 << 0;
    }
}

flags! {
    /// Sets of profiles. Spec: `PROFILE_SET_SLOTS`.
    ///
    /// One place of the spec has bit 2 for set 2; the sets take the bits 0 to 5 in order.
    pub struct ProfileSetSlots: u8 {
        /// Set 1.
        const SET_1 "PROFILE_SET_1" = 1 << 0;
        /// Set 2.
        const SET_2 "PROFILE_SET_2" = 1 << 1;
        /// Set 3.
        const SET_3 "PROFILE_SET_3" = 1 << 2;
        /// Set 4.
        const SET_4 "PROFILE_SET_4" = 1 << 3;
        /// Set 5.
        const SET_5 "PROFILE_SET_5" = 1 << 4;
        /// The backup.
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
