//! Mapping of signals to actions and variables.

use sbgc_proto_macros::{bit_fields, message, record};

use super::AdjustableVariable;
use crate::commands::{Confirm, MenuCommand, RcSource};
use crate::wire::Reserved;

/// Requests the mapping of signals to actions and variables.
#[message(CMD_READ_ADJ_VARS_CFG, outgoing, size = 0, answer = AdjVarsCfg)]
pub struct ReadAdjVarsCfg;

/// Stores the mapping of signals to actions and variables.
#[message(CMD_WRITE_ADJ_VARS_CFG, outgoing, size = 128, answer = Confirm)]
pub struct WriteAdjVarsCfg(pub AdjVarsCfg);

/// Mapping of signals to actions and variables.
#[message(CMD_READ_ADJ_VARS_CFG, incoming, size = 128)]
pub struct AdjVarsCfg {
    /// Trigger slots: signals that run actions.
    #[wire(group)]
    pub trigger_slots: [TriggerSlot; 10],
    /// Analog slots: signals that change variables.
    #[wire(group)]
    pub analog_slots: [AnalogSlot; 15],
    pub reserved: Reserved<8>,
}

/// A signal that runs actions by its level.
#[record(size = 6)]
#[derive(Copy)]
pub struct TriggerSlot {
    /// Signal source.
    pub trigger_src_ch: RcSource,
    /// Actions for the five fifths of the signal's range, lowest first.
    pub trigger_action: [MenuCommand; 5],
}

/// A signal that changes a variable.
#[record(size = 4)]
#[derive(Copy)]
pub struct AnalogSlot {
    /// Signal source.
    pub analog_src_ch: RcSource,
    /// The variable, and how it changes.
    pub var_id: VariableTarget,
    /// Lower end of the working range; the range of the variable itself is mapped to 0 to 255.
    pub min_val: u8,
    /// Upper end of the working range; the range of the variable itself is mapped to 0 to 255.
    pub max_val: u8,
}

/// A variable, and how a signal changes it.
#[bit_fields(u8)]
pub struct VariableTarget {
    /// The variable.
    #[wire(bits = 0..=6, spec = "VAR_ID")]
    pub variable: AdjustableVariable,
    /// Whether the signal multiplies the variable instead of being its value.
    #[wire(bits = 7, spec = "MULTIPLIER", since = "2.62b6")]
    pub multiplies: bool,
}
