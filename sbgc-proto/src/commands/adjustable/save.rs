//! Storing the values of adjustable variables.

use sbgc_proto_macros::message;

use super::AdjustableVariable;
use crate::commands::Confirm;
use crate::wire::{Element, Packed};

/// Stores the values of all adjustable variables in use in EEPROM; values that belong to a profile go to the active
/// one.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_SAVE_PARAMS_3, outgoing, form = "simple", default, size = 0, length = 0, answer = Confirm)]
pub struct SaveParams3;

/// Stores the values of some adjustable variables in EEPROM; values that belong to a profile go to the active one.
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
    /// Variables to store, at least one: the form without variables stores all.
    pub adj_var_id: Packed<AdjustableVariable, 255>,
}

impl Element for AdjustableVariable {
    type At<'x> = Self;
}
