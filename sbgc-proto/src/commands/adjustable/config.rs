//! Mapping of control signals to menu commands and adjustable variables.

use sbgc_proto_macros::{bit_fields, message, record};

use super::AdjustableVariable;
use crate::commands::{Confirm, MenuCommand, RcSource};
use crate::wire::Reserved;

/// Requests the mapping of control signals to menu commands and adjustable variables.
#[message(CMD_READ_ADJ_VARS_CFG, outgoing, size = 0, answer = AdjVarsCfg)]
pub struct ReadAdjVarsCfg;

/// Stores the mapping of control signals to menu commands and adjustable variables.
#[message(CMD_WRITE_ADJ_VARS_CFG, outgoing, size = 128, answer = Confirm)]
pub struct WriteAdjVarsCfg(pub AdjVarsCfg);

/// Mapping of control signals to menu commands and adjustable variables.
#[message(CMD_READ_ADJ_VARS_CFG, incoming, size = 128)]
pub struct AdjVarsCfg {
    /// Trigger slots: signals that run menu commands.
    #[wire(group)]
    pub trigger_slots: [TriggerSlot; 10],
    /// Analog slots: signals that change variables.
    #[wire(group)]
    pub analog_slots: [AnalogSlot; 15],
    pub reserved: Reserved<8>,
}

/// Signal that runs menu commands, depending on its level.
#[record(size = 6)]
#[derive(Copy)]
pub struct TriggerSlot {
    /// Signal source.
    pub trigger_src_ch: RcSource,
    /// Menu commands for the five equal parts of the signal range, lowest first.
    pub trigger_action: [MenuCommand; 5],
}

/// Signal that changes a variable.
#[record(size = 4)]
#[derive(Copy)]
pub struct AnalogSlot {
    /// Signal source.
    pub analog_src_ch: RcSource,
    /// Variable to change, and how the signal changes it.
    pub var_id: VariableTarget,
    /// Lower end of the working range, where 0 to 255 stands for the full range of the variable.
    pub min_val: u8,
    /// Upper end of the working range, where 0 to 255 stands for the full range of the variable.
    pub max_val: u8,
}

/// Variable, and how a signal changes it.
#[bit_fields(u8)]
pub struct VariableTarget {
    /// Variable to change.
    #[wire(bits = 0..=6, spec = "VAR_ID")]
    pub variable: AdjustableVariable,
    /// Whether the signal multiplies the value of the variable instead of replacing it.
    #[wire(bits = 7, spec = "MULTIPLIER", since = "2.62b6")]
    pub multiplies: bool,
}
