//! Modules on the CAN bus: discovery, versions and firmware updates.
//!
//! These layouts are published in newer documents only.

use sbgc_proto_macros::{bit_fields, message, open_enum, record};

use crate::commands::Confirm;

use crate::units::ModuleVersion;
use crate::wire::{Bytes, List, Reserved};

/// Scans the CAN bus for devices.
///
/// A board that rejects the scan sends `CMD_ERROR`.
#[message(CMD_CAN_DEVICE_SCAN, outgoing, size = 0, answer = CanDeviceScan, acts, slow)]
pub struct CanDeviceScanRequest;

/// Scans the CAN bus for uDrv modules, locates their IMUs and assigns ids.
///
/// This changes the roles of devices.
///
/// Published in the vendor's Python library only.
#[message(CMD_UDRV_DEVICE_SCAN, outgoing, size = 0, answer = CanDeviceScan, acts, slow)]
pub struct UdrvDeviceScan;

/// Devices found on the CAN bus.
#[message(CMD_CAN_DEVICE_SCAN, incoming, size = 0..=252)]
pub struct CanDeviceScan {
    /// Devices found; empty if none responded.
    #[wire(group)]
    pub devices: List<CanDevice, 18>,
}

/// A device on the CAN bus.
#[record(size = 14)]
#[derive(Copy)]
pub struct CanDevice {
    /// Unique id of the device.
    pub uid: Bytes<12>,
    /// Role of the device.
    pub id: CanDeviceId,
    /// Type of the device.
    #[wire(spec = "TYPE")]
    pub device_type: CanDeviceTypeByte,
}

/// Type of a device on the CAN bus, and the origin of its id.
#[bit_fields(u8)]
pub struct CanDeviceTypeByte {
    /// Type of the device.
    #[wire(bits = 0..=6, spec = "CAN_DEVICE_TYPE")]
    pub kind: CanDeviceType,
    /// Whether the id is set in hardware.
    #[wire(bits = 7)]
    pub hardware_id: bool,
}

/// Type of a device on the CAN bus. Spec: `CAN_DEVICE_TYPE`.
#[open_enum(u8)]
pub enum CanDeviceType {
    /// A motor driver.
    MotorDriver = 1,
    /// An IMU.
    Imu = 2,
}

/// Role of a device on the CAN bus. Spec: `CAN_DEVICE_ID`.
///
/// These are not the numbers of [`CanModuleId`].
#[open_enum(u8, prefix = "CAN_")]
pub enum CanDeviceId {
    /// Not assigned.
    #[wire(spec = "NOT_ASSIGNED")]
    NotAssigned = 0,
    /// Main IMU.
    ImuMain = 5,
    /// Frame IMU.
    ImuFrame = 6,
    /// GPS_IMU used as the main IMU.
    #[wire(spec = "GPS_IMU_MAIN")]
    GpsImuMain = 7,
    /// Motor driver 1.
    #[wire(spec = "CAN_DRV1")]
    Drv1 = 17,
    /// Motor driver 2.
    #[wire(spec = "CAN_DRV2")]
    Drv2 = 18,
    /// Motor driver 3.
    #[wire(spec = "CAN_DRV3")]
    Drv3 = 19,
    /// Motor driver 4.
    #[wire(spec = "CAN_DRV4")]
    Drv4 = 20,
    /// Motor driver 5.
    #[wire(spec = "CAN_DRV5")]
    Drv5 = 21,
    /// Motor driver 6.
    #[wire(spec = "CAN_DRV6")]
    Drv6 = 22,
    /// Motor driver 7.
    #[wire(spec = "CAN_DRV7")]
    Drv7 = 23,
    /// Main IMU, older type.
    ImuMainOld = 28,
    /// Frame IMU, older type.
    ImuFrameOld = 29,
}

/// Requests the versions of the modules on the CAN bus.
///
/// The board must have [`BoardFeatures::CAN_PORT`](crate::commands::BoardFeatures::CAN_PORT).
#[message(CMD_MODULE_LIST, outgoing, size = 0, answer = ModuleList)]
pub struct ModuleListRequest;

/// Versions of the modules on the CAN bus.
#[message(CMD_MODULE_LIST, incoming, size = 1..=248)]
pub struct ModuleList {
    /// Modules; entries with id 0 are unused.
    #[wire(group, counted_by = "DEVICE_NUM")]
    pub devices: List<CanModule, 19>,
}

/// A module on the CAN bus.
#[record(size = 13)]
#[derive(Copy)]
pub struct CanModule {
    /// Module that the entry describes.
    pub id: CanModuleId,
    /// Hardware version.
    pub board_ver: ModuleVersion,
    /// Bootloader version.
    pub bootloader_ver: ModuleVersion,
    /// Firmware version.
    pub firmware_ver: ModuleVersion,
    pub reserved: Reserved<6>,
}

/// Module on the CAN bus, by its position in the list of modules. Spec: `CAN_MODULE_ID`.
///
/// Ids up to 17 are valid; those above 13 have no published names.
#[open_enum(u8, prefix = "CAN_")]
pub enum CanModuleId {
    /// Main IMU.
    ImuMain = 1,
    /// Frame IMU.
    ImuFrame = 2,
    /// Motor driver 1.
    #[wire(spec = "CAN_DRV1")]
    Drv1 = 3,
    /// Motor driver 2.
    #[wire(spec = "CAN_DRV2")]
    Drv2 = 4,
    /// Motor driver 3.
    #[wire(spec = "CAN_DRV3")]
    Drv3 = 5,
    /// Motor driver 4.
    #[wire(spec = "CAN_DRV4")]
    Drv4 = 6,
    /// Motor driver 5.
    #[wire(spec = "CAN_DRV5")]
    Drv5 = 7,
    /// Motor driver 6.
    #[wire(spec = "CAN_DRV6")]
    Drv6 = 8,
    /// Motor driver 7.
    #[wire(spec = "CAN_DRV7")]
    Drv7 = 9,
    /// GPS_IMU.
    #[wire(spec = "GPS_IMU")]
    GpsImu = 10,
    /// Hub with a satellite navigation receiver.
    HubGnss = 11,
    /// Hub 1.
    #[wire(spec = "CAN_HUB1")]
    Hub1 = 12,
    /// Hub 2.
    #[wire(spec = "CAN_HUB2")]
    Hub2 = 13,
}

/// Starts a firmware update of a module.
///
/// Published in the vendor's Python library only.
#[message(CMD_MODULE_FLASH_START, outgoing, size = 5, answer = Confirm)]
pub struct ModuleFlashStart {
    /// Module to update.
    #[wire(range = 1..=17)]
    pub device_id: CanModuleId,
    /// Firmware size in 32-bit words.
    pub firmware_size: u32,
}

/// Writes one packet of module firmware.
///
/// Wait for the confirmation of each packet before sending the next. The data of an error contains the device id and
/// the packet number, 2 bytes each. Published in the vendor's Python library only.
#[message(CMD_MODULE_FLASH_WRITE, outgoing, size = 14..=138, answer = Confirm)]
pub struct ModuleFlashWrite<'a> {
    /// Module to update.
    #[wire(range = 1..=17)]
    pub device_id: CanModuleId,
    /// Packet number, counted from 0 and wrapping after 255.
    pub packet_id: u8,
    /// Offset of the packet in the firmware file, a multiple of 4.
    #[wire(unit = "byte")]
    pub address: u32,
    /// CRC-32/ISO-HDLC of the data.
    pub data_crc32: u32,
    /// Packet data: 4 to 128 bytes, a multiple of 4.
    pub data: &'a [u8],
}

/// Finishes a firmware update of a module.
///
/// Published in the vendor's Python library only.
#[message(CMD_MODULE_FLASH_FINISH, outgoing, size = 5, answer = Confirm)]
pub struct ModuleFlashFinish {
    /// Module to update.
    #[wire(range = 1..=17)]
    pub device_id: CanModuleId,
    /// CRC-32/ISO-HDLC of the whole firmware file.
    pub file_crc32: u32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Message;

    /// Made by hand from the layout.
    #[test]
    fn scans_find_any_number() {
        let device = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 17, 0x81];
        let other = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 99, 0x7F];
        let payload = [device, other].concat();
        let scan = CanDeviceScan::decode(&payload).unwrap();
        assert_eq!(scan.devices[0].id, CanDeviceId::Drv1);
        assert_eq!(scan.devices[0].device_type.kind(), CanDeviceType::MotorDriver);
        assert!(scan.devices[0].device_type.hardware_id());
        assert_eq!(scan.devices[1].device_type.kind(), CanDeviceType::Unknown(0x7F));
        assert_eq!(scan.encode(&mut [0; 255]), Ok(&payload[..]));
        assert_eq!(CanDeviceScan::decode(&[]).unwrap().devices.len(), 0);
        assert_eq!(CanDeviceScan::decode(&[0xFF; 252]).unwrap().devices.len(), 18);
        assert_eq!(CanDeviceScan::decode_prefix(&payload[..27]).unwrap().1, &other[..13]);
    }

    /// Made by hand from the layout.
    #[test]
    fn modules_are_counted() {
        let payload = [1, 4, 0x2C, 1, 0x65, 0, 0x0A, 0, 1, 2, 3, 4, 5, 6];
        let list = ModuleList::decode(&payload).unwrap();
        let module = list.devices[0];
        assert_eq!(module.id, CanModuleId::Drv2);
        assert!((module.board_ver.number() - 3.0).abs() < 1e-6);
        assert!((module.bootloader_ver.number() - 1.01).abs() < 1e-6);
        assert_eq!(module.reserved.0, [1, 2, 3, 4, 5, 6]);
        assert_eq!(list.encode(&mut [0; 255]), Ok(&payload[..]));
        assert!(ModuleList::decode(&payload[..13]).is_err());
        assert!(ModuleList::decode(&[20]).is_err());
    }

    /// Made by hand from the layout.
    #[test]
    fn firmware_goes_in_pieces() {
        let start = ModuleFlashStart { device_id: CanModuleId::ImuMain, firmware_size: 0x0102_0304 };
        assert_eq!(start.encode(&mut [0; 5]), Ok(&[1, 4, 3, 2, 1][..]));
        let payload = [3, 255, 0, 1, 0, 0, 0xEF, 0xBE, 0xAD, 0xDE, 9, 8, 7, 6];
        let write = ModuleFlashWrite::decode(&payload).unwrap();
        assert_eq!((write.packet_id, write.address, write.data_crc32), (255, 256, 0xDEAD_BEEF));
        assert_eq!(write.data, [9, 8, 7, 6]);
        assert_eq!(write.encode(&mut [0; 255]), Ok(&payload[..]));
        let finish = ModuleFlashFinish { device_id: CanModuleId::Unknown(17), file_crc32: 5 };
        assert_eq!(finish.encode(&mut [0; 5]), Ok(&[17, 5, 0, 0, 0][..]));
    }
}
