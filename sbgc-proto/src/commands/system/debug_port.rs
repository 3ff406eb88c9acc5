//! Listening to what goes over the other ports.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::CommandId;
use crate::commands::Confirm;
use crate::declare::flags;
use crate::wire::Reserved;

/// Has the board send a copy of what goes over its other ports, or stop that.
///
/// The board confirms it.
#[message(CMD_SET_DEBUG_PORT, outgoing, size = 16, since = "2.66b4", answer = Confirm)]
pub struct SetDebugPortRequest {
    /// Action to perform.
    pub action: DebugPortAction,
    /// Messages to omit.
    pub cmd_filter: DebugPortFilter,
    pub reserved: Reserved<11>,
}

/// A message that went over another port.
///
/// Only such as were intact are sent.
///
/// What the board does with a payload too long for the 251 bytes that are left for it is not known.
#[message(CMD_SET_DEBUG_PORT, incoming, size = 4..=255, since = "2.66b4")]
pub struct SetDebugPort<'a> {
    /// When it was seen: the time since the start, which begins again after 65.5 s.
    #[wire(unit = "ms")]
    pub time_ms: u16,
    /// Over which port it went, and which way.
    pub port_and_dir: PortAndDirection,
    /// Its command.
    pub cmd_id: CommandId,
    /// Its payload.
    pub payload: &'a [u8],
}

/// A port, and which way a message went over it.
#[bit_fields(u8)]
pub struct PortAndDirection {
    /// Number of the port.
    #[wire(bits = 0..=6)]
    pub port: u8,
    /// Direction. Which direction 1 means is unknown.
    #[wire(bits = 7, spec = "DIR")]
    pub direction: bool,
}

/// Starts or stops the copy. Spec: `DEBUG_PORT_ACTION`.
#[open_enum(u8)]
pub enum DebugPortAction {
    /// Send it no longer.
    Stop = 0,
    /// Send it to the port that this command comes on.
    Start = 1,
}

flags! {
    /// Messages to omit: a set bit suppresses them. Only the `plus` firmware evaluates this. Spec:
    /// `DEBUG_PORT_FILTER`.
    pub struct DebugPortFilter: u32, prefix "CMD_" {
        /// Real-time data.
        const REALTIME_DATA_3 = 1 << 0;
        /// Extended real-time data.
        const REALTIME_DATA_4 = 1 << 1;
        /// Real-time data chosen by flags.
        const REALTIME_DATA_CUSTOM = 1 << 2;
        /// Debug variables.
        const DEBUG_VARS_3 = 1 << 3;
        /// Debug information of MAVLink.
        const MAVLINK_DEBUG = 1 << 4;
        /// Angles.
        const GET_ANGLES = 1 << 5;
        /// Extended angles.
        const GET_ANGLES_EXT = 1 << 6;
        /// Data of the Bode test.
        const BODE_TEST_DATA = 1 << 7;
        /// Helper data from a flight controller.
        const HELPER_DATA = 1 << 8;
        /// Attitude from or to another system.
        const AHRS_HELPER = 1 << 9;
        /// Corrections of the gyroscope.
        const GYRO_CORRECTION = 1 << 10;
        /// Control.
        const CONTROL = 1 << 11;
        /// Changes of adjustable variables.
        const SET_ADJ_VARS_VAL = 1 << 12;
        /// Virtual channels.
        const API_VIRT_CH_CONTROL = 1 << 13;
        /// Virtual channels in high resolution.
        const API_VIRT_CH_HIGH_RES = 1 << 14;
    }
}
