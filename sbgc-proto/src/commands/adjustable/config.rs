//! Which signals run actions and change variables.

use sbgc_proto_macros::{message, record};

use super::AdjustableVariable;
use crate::commands::{Confirm, MenuCommand, RcSource};
use crate::wire::{Reserved, bit_fields};

/// Asks which signals run actions and change variables.
#[message(CMD_READ_ADJ_VARS_CFG, outgoing, size = 0, answer = AdjVarsCfg)]
pub struct ReadAdjVarsCfg {}

/// Stores which signals run actions and change variables.
#[message(CMD_WRITE_ADJ_VARS_CFG, outgoing, size = 128, answer = Confirm)]
pub struct WriteAdjVarsCfg(pub AdjVarsCfg);

/// Which signals run actions and change variables.
#[message(CMD_READ_ADJ_VARS_CFG, incoming, size = 128)]
pub struct AdjVarsCfg {
    /// Signals that run actions.
    #[wire(group)]
    pub trigger_slots: [TriggerSlot; 10],
    /// Signals that change variables.
    #[wire(group)]
    pub analog_slots: [AnalogSlot; 15],
    pub reserved: Reserved<8>,
}

/// A signal that runs actions by its level.
#[record(size = 6)]
#[derive(Copy)]
pub struct TriggerSlot {
    /// The signal.
    pub trigger_src_ch: RcSource,
    /// What is done in each fifth of the signal's range, from the lowest.
    pub trigger_action: [MenuCommand; 5],
}

/// A signal that changes a variable.
#[record(size = 4)]
#[derive(Copy)]
pub struct AnalogSlot {
    /// The signal.
    pub analog_src_ch: RcSource,
    /// The variable, and how it changes.
    pub var_id: VariableTarget,
    /// Lower end of the working range, which stands for the variable's own range.
    pub min_val: u8,
    /// Upper end of the working range, which stands for the variable's own range.
    pub max_val: u8,
}

bit_fields! {
    /// A variable, and how a signal changes it.
    pub struct VariableTarget: u8 {
        /// The variable.
        0..=6 => variable / with_variable "VAR_ID": AdjustableVariable,
        /// Whether the signal multiplies the variable instead of being its value. Firmware 2.62b6 and later.
        7..=7 => multiplies / with_multiplies "MULTIPLIER": bool,
    }
}
