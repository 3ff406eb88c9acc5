//! Storing what was adjusted.

use sbgc_proto_macros::message;

use super::AdjustableVariable;
use crate::commands::Confirm;
use crate::wire::List;

/// Stores all variables that are in use in EEPROM, those of a profile in the active one.
///
/// The specification is silent on the answer; the vendor's library waits for it.
#[message(CMD_SAVE_PARAMS_3, outgoing, form = "simple", default, size = 0, length = 0, answer = Confirm)]
pub struct SaveParams3 {}

/// Stores some variables in EEPROM, those of a profile in the active one.
///
/// The specification is silent on the answer; the vendor's library waits for it.
#[message(
    CMD_SAVE_PARAMS_3,
    outgoing,
    form = "extended",
    size = 0..=255,
    length = 1..,
    since = "2.68b9",
    answer = Confirm
)]
pub struct SaveParams3Extended {
    /// The variables. Without any it would be the other form, which stores all.
    pub adj_var_id: List<AdjustableVariable, 255>,
}
