//! External sensors: what they report, and messages that the board passes on to and from them.

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
/// It may also be sent unsolicited: newer documents call it a notification.
#[message(CMD_EXT_IMU_DEBUG_INFO, incoming, size = 74, since = "2.66")]
pub struct ExtImuDebugInfo {
    /// State of the estimate of attitude.
    pub ahrs_debug_info: AhrsDebugInfo,
    /// Rotation matrix that came from the sensor, in coordinates East, North, down.
    ///
    /// The order is not stated; a third-party library has it row after row.
    #[wire(range = -1.0..=1.0)]
    pub dcm: [Float; 9],
    /// Linear acceleration without gravity, in the sensor's own coordinates. The unit is not stated.
    pub acc_body: PerXyz<Float>,
}

/// Passes a message on to the external inertial sensor, a GPS_IMU.
///
/// If the sensor answers, that comes as [`ExtImuCmd`].
#[message(CMD_EXT_IMU_CMD, outgoing, size = 1..=255)]
pub struct ExtImuCmdRequest<'a> {
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

/// A message from the external inertial sensor, a GPS_IMU.
#[message(CMD_EXT_IMU_CMD, incoming, size = 1..=255)]
pub struct ExtImuCmd<'a> {
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

/// Passes a message on to a GPS_IMU, on boards of the extended family.
///
/// If the sensor answers, that comes as [`ExtSensCmd`]. A remark in one of the vendor's libraries leaves out the
/// flags; its own code and the other libraries have them.
#[message(CMD_EXT_SENS_CMD, outgoing, size = 2..=255, since = "2.68b7")]
pub struct ExtSensCmdRequest<'a> {
    /// Options for forwarding the message.
    pub flags: ExtSensFlags,
    /// Command of the sensor's own protocol.
    pub cmd_id: GpsImuCmd,
    /// Payload of that command.
    pub data: &'a [u8],
}

/// A message from a GPS_IMU, on boards of the extended family.
///
/// This direction has no flags.
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
        /// Before others.
        const HIGH_PRIORITY = 1 << 0;
    }
}

/// A command of the GPS_IMU's own protocol, whose payloads are not part of this one. Spec: `GPS_IMU_CMD`.
#[open_enum(u8)]
pub enum GpsImuCmd {
    /// Confirms a command.
    Confirm = 1,
    /// Resets the sensor.
    Reset = 2,
    /// Tells of a reset.
    ResetNotify = 3,
    /// Asks what the sensor is.
    GetDeviceInfo = 4,
    /// Sensor type.
    DeviceInfo = 5,
    /// Requests data.
    GetData = 6,
    /// Requests a stream of data.
    GetDataStream = 7,
    /// Data.
    Data = 8,
    /// Calibrates.
    Calib = 9,
    /// Goes to the boot loader.
    BootMode = 10,
    /// Logs data of the user.
    UserDataLog = 11,
    /// Requests the configuration of the user's log.
    GetUserConfLog = 12,
    /// The configuration of the user's log.
    UserConfLog = 13,
}
