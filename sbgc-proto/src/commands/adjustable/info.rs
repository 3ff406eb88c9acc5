//! What variables the firmware has.

use sbgc_proto_macros::{message, record};

use super::AdjustableVariable;
use crate::wire::{List, Text};

/// Asks what variables the firmware has.
///
/// One answer has as many as fit; ask again from the next for more.
#[message(CMD_ADJ_VARS_INFO, outgoing, size = 0..=1, since = "2.73", answer = AdjVarsInfo<'answer>, echo = from(start_id => vars.var_id))]
pub struct AdjVarsInfoRequest {
    /// The first that is wanted. The vendor's library always sends it; a third-party one may leave it
    /// out, which stands for 0.
    pub start_id: Option<AdjustableVariable>,
}

/// What variables the firmware has.
#[message(CMD_ADJ_VARS_INFO, incoming, size = 1..=255, since = "2.73")]
pub struct AdjVarsInfo<'a> {
    /// How many the firmware has in all, not in this message.
    pub total_number: u8,
    /// Those of this message.
    #[wire(group)]
    pub vars: List<VariableInfo<'a>, 25>,
}

/// What the firmware says of a variable.
#[record]
pub struct VariableInfo<'a> {
    /// Which one.
    pub var_id: AdjustableVariable,
    /// Its name, of 16 letters at most.
    pub name: Text<'a>,
    /// The least raw value.
    pub range_min: i16,
    /// The greatest raw value.
    pub range_max: i16,
    /// The present raw value.
    pub value: i32,
}
