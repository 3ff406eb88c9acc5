//! Storing adjusted variables.

use sbgc_proto_macros::message;

use super::AdjustableVariable;
use crate::commands::Confirm;
use crate::wire::List;

/// Stores all variables that are in use in EEPROM, those of a profile in the active one.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_SAVE_PARAMS_3, outgoing, form = "simple", default, size = 0, length = 0, answer = Confirm)]
pub struct SaveParams3;

/// Stores some variables in EEPROM, those of a profile in the active one.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
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
    /// Variables to store; at least one, since the form without any stores all.
    pub adj_var_id: List<AdjustableVariable, 255>,
}
