//! Values of individual adjustable variables.

use sbgc_proto_macros::{message, record};

use super::AdjustableVariable;
use crate::commands::Confirm;
use crate::wire::{Float, List};

/// Changes adjustable variables immediately, without storing them in EEPROM.
///
/// Confirmed on success. [`SaveParams3`](super::SaveParams3) stores the values.
#[message(CMD_SET_ADJ_VARS_VAL, outgoing, size = 1..=201, answer = Confirm)]
pub struct SetAdjVarsVal(pub AdjVarsVal);

/// Values of adjustable variables.
#[message(CMD_SET_ADJ_VARS_VAL, incoming, size = 1..=201)]
pub struct AdjVarsVal {
    /// Variables, 1 to 40.
    #[wire(group, counted_by = "NUM_PARAMS")]
    pub params: List<VariableValue, 40>,
}

/// Requests the values of adjustable variables.
#[message(CMD_GET_ADJ_VARS_VAL, outgoing, size = 1..=41, answer = AdjVarsVal, echo = each(param_id => params.param_id))]
pub struct GetAdjVarsVal {
    /// Variables, 1 to 40.
    #[wire(counted_by = "NUM_PARAMS")]
    pub param_id: List<AdjustableVariable, 40>,
}

/// Adjustable variable and its value.
#[record(size = 5)]
pub struct VariableValue {
    /// Adjustable variable.
    pub param_id: AdjustableVariable,
    /// Raw value, extended to four bytes. The specification allows floats, but all variables that it lists are
    /// integers.
    pub param_value: i32,
}

/// Changes adjustable variables immediately, with float values.
///
/// Confirmed on success. A third-party library calls the command `CMD_SET_ADJ_VARS_F`.
#[message(CMD_SET_ADJ_VARS_VAL_F, outgoing, size = 1..=201, since = "2.73.4", answer = Confirm)]
pub struct SetAdjVarsValF(pub AdjVarsValF);

/// Values of adjustable variables as floats.
#[message(CMD_SET_ADJ_VARS_VAL_F, incoming, size = 1..=201, since = "2.73.4")]
pub struct AdjVarsValF {
    /// Variables, 1 to 40.
    #[wire(group, counted_by = "NUM_PARAMS")]
    pub params: List<VariableValueF, 40>,
}

/// Requests the values of adjustable variables as floats.
#[message(CMD_GET_ADJ_VARS_VAL_F, outgoing, size = 1..=41, since = "2.73.4", answer = AdjVarsValF, echo = each(param_id => params.param_id))]
pub struct GetAdjVarsValF {
    /// Variables, 1 to 40.
    #[wire(counted_by = "NUM_PARAMS")]
    pub param_id: List<AdjustableVariable, 40>,
}

/// Adjustable variable and its value as a float.
#[record(size = 5)]
pub struct VariableValueF {
    /// Adjustable variable.
    pub param_id: AdjustableVariable,
    /// Value as a float.
    pub param_value: Float,
}
