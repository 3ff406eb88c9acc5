//! Monitoring of the traffic on other ports.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::CommandId;
use crate::commands::Confirm;
use crate::declare::flags;
use crate::wire::Reserved;

/// Starts or stops sending copies of the messages on other ports.
///
/// Confirmed on success.
#[message(CMD_SET_DEBUG_PORT, outgoing, size = 16, since = "2.66b4", answer = Confirm)]
pub struct SetDebugPortRequest {
    /// Action to perform.
    pub action: DebugPortAction,
    /// Messages to omit.
    pub cmd_filter: DebugPortFilter,
    pub reserved: Reserved<11>,
}

/// Copy of a message on another port.
///
/// Only intact messages are reported. How the board handles payloads longer than the 251 bytes available here is
/// unknown.
#[message(CMD_SET_DEBUG_PORT, incoming, size = 4..=255, since = "2.66b4")]
pub struct SetDebugPort<'a> {
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub time_ms: u16,
    /// Port and direction of the message.
    pub port_and_dir: PortAndDirection,
    /// Command of the message.
    pub cmd_id: CommandId,
    /// Payload of the message.
    pub payload: &'a [u8],
}

/// Port and direction of a message.
#[bit_fields(u8)]
pub struct PortAndDirection {
    /// Port number.
    #[wire(bits = 0..=6)]
    pub port: u8,
    /// Direction. The meaning of 0 and 1 is unknown.
    #[wire(bits = 7, spec = "DIR")]
    pub direction: bool,
}

/// Starts or stops the monitoring of other ports. Spec: `DEBUG_PORT_ACTION`.
#[open_enum(u8)]
pub enum DebugPortAction {
    /// Stops sending copies.
    Stop = 0,
    /// Sends copies to the port that receives this command.
    Start = 1,
}

flags! {
    /// Messages to omit; a set bit suppresses a message. Spec: `DEBUG_PORT_FILTER`.
    ///
    /// Evaluated by firmware for "plus" boards only.
    pub struct DebugPortFilter: u32, prefix "CMD_" {
        /// Real-time data.
        const REALTIME_DATA_3 = 1 << 0;
        /// Extended real-time data.
        const REALTIME_DATA_4 = 1 << 1;
        /// Custom real-time data.
        const REALTIME_DATA_CUSTOM = 1 << 2;
        /// Debug variables.
        const DEBUG_VARS_3 = 1 << 3;
        /// MAVLink debug information.
        const MAVLINK_DEBUG = 1 << 4;
        /// Angles.
        const GET_ANGLES = 1 << 5;
        /// Extended angles.
        const GET_ANGLES_EXT = 1 << 6;
        /// Data of the Bode test.
        const BODE_TEST_DATA = 1 << 7;
        /// Helper data from a flight controller.
        const HELPER_DATA = 1 << 8;
        /// Attitude exchanged with another system.
        const AHRS_HELPER = 1 << 9;
        /// Corrections of the gyroscope.
        const GYRO_CORRECTION = 1 << 10;
        /// Control commands.
        const CONTROL = 1 << 11;
        /// Changes of adjustable variables.
        const SET_ADJ_VARS_VAL = 1 << 12;
        /// Virtual channels.
        const API_VIRT_CH_CONTROL = 1 << 13;
        /// Virtual channels at high resolution.
        const API_VIRT_CH_HIGH_RES = 1 << 14;
    }
}
