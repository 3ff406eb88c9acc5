//! External sensors: debug information, and messages forwarded to and from them.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::AhrsDebugInfo;
use crate::declare::flags;
use crate::wire::{Float, PerXyz};

/// Requests debug information of the external IMU.
///
/// The specification defines only the answer; the vendor's libraries request it like this.
#[message(CMD_EXT_IMU_DEBUG_INFO, outgoing, size = 0, since = "2.66", answer = ExtImuDebugInfo)]
pub struct ExtImuDebugInfoRequest;

/// Debug information of the external IMU.
///
/// It may also be sent unsolicited; newer documents call it a notification.
#[message(CMD_EXT_IMU_DEBUG_INFO, incoming, size = 74, since = "2.66")]
pub struct ExtImuDebugInfo {
    /// State of the attitude and heading reference system.
    pub ahrs_debug_info: AhrsDebugInfo,
    /// Rotation matrix reported by the sensor, in East, North, down coordinates.
    ///
    /// The order of elements is not documented; a third-party library reads it row by row.
    #[wire(range = -1.0..=1.0)]
    pub dcm: [Float; 9],
    /// Linear acceleration without gravity, in sensor coordinates. The unit is not documented.
    pub acc_body: PerXyz<Float>,
}

/// Forwards a message to the external IMU, a GPS_IMU.
///
/// An answer of the sensor is reported as [`ExtImuCmd`].
#[message(CMD_EXT_IMU_CMD, outgoing, size = 1..=255)]
pub struct ExtImuCmdRequest<'a> {
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

/// Message from the external IMU, a GPS_IMU.
#[message(CMD_EXT_IMU_CMD, incoming, size = 1..=255)]
pub struct ExtImuCmd<'a> {
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

/// Forwards a message to a GPS_IMU, on boards of the extended family.
///
/// An answer of the sensor is reported as [`ExtSensCmd`]. A comment in one of the vendor's libraries omits the flags,
/// but its code and the other libraries have them.
#[message(CMD_EXT_SENS_CMD, outgoing, size = 2..=255, since = "2.68b7")]
pub struct ExtSensCmdRequest<'a> {
    /// Options for forwarding the message.
    pub flags: ExtSensFlags,
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

/// Message from a GPS_IMU, on boards of the extended family.
///
/// There are no flags in this direction.
#[message(CMD_EXT_SENS_CMD, incoming, size = 1..=255, since = "2.68b7")]
pub struct ExtSensCmd<'a> {
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

flags! {
    /// Options for forwarding a message to a sensor.
    pub struct ExtSensFlags: u8 {
        /// Sends the message before others.
        const HIGH_PRIORITY = 1 << 0;
    }
}

/// Command of the protocol of the GPS_IMU, whose payloads are not decoded here. Spec: `GPS_IMU_CMD`.
#[open_enum(u8)]
pub enum GpsImuCmd {
    /// Confirms a command.
    Confirm = 1,
    /// Resets the sensor.
    Reset = 2,
    /// Notice of a reset.
    ResetNotify = 3,
    /// Requests device information.
    GetDeviceInfo = 4,
    /// Device information.
    DeviceInfo = 5,
    /// Requests data.
    GetData = 6,
    /// Requests a stream of data.
    GetDataStream = 7,
    /// Data.
    Data = 8,
    /// Calibrates the sensor.
    Calib = 9,
    /// Enters the bootloader.
    BootMode = 10,
    /// User data for the log.
    UserDataLog = 11,
    /// Requests the configuration of the user data log.
    GetUserConfLog = 12,
    /// Configuration of the user data log.
    UserConfLog = 13,
}
