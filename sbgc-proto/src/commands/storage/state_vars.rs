//! The state that outlives a restart: counters and extremes for maintenance.

use sbgc_proto_macros::message;

use crate::commands::{Confirm, SystemSubError};
use crate::units::PeakAcceleration;
use crate::wire::{Float, Reserved};

/// Asks for the state that outlives a restart.
///
/// Only boards of the extended family have it.
#[message(CMD_READ_STATE_VARS, outgoing, size = 0, since = "2.68b7", answer = StateVars)]
pub struct ReadStateVars {}

/// The state that outlives a restart.
#[message(CMD_READ_STATE_VARS, incoming, size = 192, since = "2.68b7")]
pub struct StateVars {
    /// The states of the six step signals.
    pub step_signal_val: [u8; 6],
    /// Why the board stopped the motors the last time it did so in an emergency; 0 when it never did.
    pub sub_error: SystemSubError,
    /// The greatest acceleration so far.
    pub max_acc: PeakAcceleration,
    /// How long the board has worked in all.
    #[wire(unit = "s")]
    pub work_time: u32,
    /// How often it was started.
    pub startup_cnt: u16,
    /// The greatest current so far.
    #[wire(unit = "mA")]
    pub max_current: u16,
    /// The lowest temperature of the inertial measurement unit. All documents have this and the other temperatures
    /// unsigned, so how one below zero is shown is not known.
    #[wire(unit = "degC")]
    pub imu_temp_min: u8,
    /// The highest temperature of the inertial measurement unit.
    #[wire(unit = "degC")]
    pub imu_temp_max: u8,
    /// The lowest temperature of the controller.
    #[wire(unit = "degC")]
    pub mcu_temp_min: u8,
    /// The highest temperature of the controller.
    #[wire(unit = "degC")]
    pub mcu_temp_max: u8,
    /// How many shocks there were, in four classes.
    pub shock_cnt: [u8; 4],
    /// Over what time the energy was counted.
    #[wire(unit = "s")]
    pub energy_time: u32,
    /// The energy that was used.
    #[wire(unit = "Wh")]
    pub energy: Float,
    /// Over what time the average of the current was taken.
    #[wire(unit = "s")]
    pub avg_current_time: u32,
    /// The average current.
    #[wire(unit = "A")]
    pub avg_current: Float,
    pub reserved: Reserved<152>,
}

/// Writes back the state that outlives a restart.
///
/// Read it first and change what is needed; the board confirms it.
#[message(CMD_WRITE_STATE_VARS, outgoing, size = 192, since = "2.68b7", answer = Confirm)]
pub struct WriteStateVars(pub StateVars);
