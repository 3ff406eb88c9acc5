//! Persistent state variables: statistics and maintenance data.

use sbgc_proto_macros::message;

use crate::commands::{Confirm, SystemSubError};
use crate::units::PeakAcceleration;
use crate::wire::{Float, Reserved};

/// Requests the persistent state variables.
///
/// Available on boards of the extended family only.
#[message(CMD_READ_STATE_VARS, outgoing, size = 0, since = "2.68b7", answer = StateVars)]
pub struct ReadStateVars;

/// Persistent state variables: statistics and maintenance data.
#[message(CMD_READ_STATE_VARS, incoming, size = 192, since = "2.68b7")]
pub struct StateVars {
    /// States of the six step signals.
    pub step_signal_val: [u8; 6],
    /// Reason for the last emergency stop of the motors; 0 if there was none.
    pub sub_error: SystemSubError,
    /// Maximum acceleration recorded.
    pub max_acc: PeakAcceleration,
    /// Total operating time of the board.
    #[wire(unit = "s")]
    pub work_time: u32,
    /// Number of starts.
    pub startup_cnt: u16,
    /// Maximum current recorded.
    #[wire(unit = "mA")]
    pub max_current: u16,
    /// Minimum temperature of the IMU. All documents declare this and the other temperatures unsigned, so the
    /// representation of negative values is unknown.
    #[wire(unit = "degC")]
    pub imu_temp_min: u8,
    /// Maximum temperature of the IMU.
    #[wire(unit = "degC")]
    pub imu_temp_max: u8,
    /// Minimum temperature of the microcontroller.
    #[wire(unit = "degC")]
    pub mcu_temp_min: u8,
    /// Maximum temperature of the microcontroller.
    #[wire(unit = "degC")]
    pub mcu_temp_max: u8,
    /// Number of shocks in each of four classes.
    pub shock_cnt: [u8; 4],
    /// Time over which the energy was measured.
    #[wire(unit = "s")]
    pub energy_time: u32,
    /// Energy consumed.
    #[wire(unit = "Wh")]
    pub energy: Float,
    /// Time over which the current was averaged.
    #[wire(unit = "s")]
    pub avg_current_time: u32,
    /// Average current.
    #[wire(unit = "A")]
    pub avg_current: Float,
    pub reserved: Reserved<152>,
}

/// Writes the persistent state variables.
///
/// Read them first, and change only what is needed. Confirmed on success.
#[message(CMD_WRITE_STATE_VARS, outgoing, size = 192, since = "2.68b7", answer = Confirm)]
pub struct WriteStateVars(pub StateVars);
