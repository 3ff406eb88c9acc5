//! List of the adjustable variables that the firmware supports.

use sbgc_proto_macros::{message, record};

use super::AdjustableVariable;
use crate::wire::{Element, Packed, Text};

/// Requests the list of adjustable variables.
///
/// One answer contains as many variables as fit. To get the following ones, request them starting after the last.
#[message(CMD_ADJ_VARS_INFO, outgoing, size = 0..=1, since = "2.73", answer = AdjVarsInfo<'answer>, echo = from(start_id => vars.var_id))]
pub struct AdjVarsInfoRequest {
    /// First variable to describe; 0 if absent. The vendor's library always sends it, a third-party library may omit
    /// it.
    pub start_id: Option<AdjustableVariable>,
}

/// List of the adjustable variables that the firmware supports.
#[message(CMD_ADJ_VARS_INFO, incoming, size = 1..=255, since = "2.73")]
pub struct AdjVarsInfo<'a> {
    /// Total number of variables in the firmware, not in this message.
    pub total_number: u8,
    /// Variables described in this message.
    #[wire(group)]
    pub vars: Packed<VariableInfo<'a>, 254>,
}

/// Description of an adjustable variable, as reported by the firmware.
#[record]
pub struct VariableInfo<'a> {
    /// Adjustable variable.
    pub var_id: AdjustableVariable,
    /// Name, at most 16 characters.
    pub name: Text<'a>,
    /// Minimum raw value.
    pub range_min: i16,
    /// Maximum raw value.
    pub range_max: i16,
    /// Current raw value.
    pub value: i32,
}

impl Element for VariableInfo<'_> {
    type At<'x> = VariableInfo<'x>;
}
