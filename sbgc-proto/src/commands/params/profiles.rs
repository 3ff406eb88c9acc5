//! Profiles and profile sets: names, reset and storage.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{Confirm, ProfileId};
use crate::wire::{FixedText, Reserved};

/// Requests the names of the profiles.
///
/// A heading of the specification calls it `CMD_READ_PROFILE_NAMES_3`; it is the same command.
#[message(CMD_READ_PROFILE_NAMES, outgoing, size = 0, answer = ProfileNames)]
pub struct ReadProfileNames;

/// Names of the profiles.
#[message(CMD_READ_PROFILE_NAMES, incoming, size = 240)]
pub struct ProfileNames {
    /// Names of profiles 1 to 5, in UTF-8.
    pub profile_name: [FixedText<48>; 5],
}

/// Stores the names of the profiles in EEPROM.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation. A heading of the
/// specification calls it `CMD_WRITE_PROFILE_NAMES_3`; it is the same command.
#[message(CMD_WRITE_PROFILE_NAMES, outgoing, size = 240, answer = Confirm)]
pub struct WriteProfileNames(pub ProfileNames);

/// Resets the parameters of a profile to factory defaults, or erases the whole EEPROM.
///
/// Whether the board confirms is unknown: the specification does not define it, and the vendor's library does not wait
/// for an answer. Accept a `CMD_CONFIRM`, but do not rely on one.
#[message(CMD_USE_DEFAULTS, outgoing, size = 1)]
pub struct UseDefaults {
    /// Profile to reset: [`ResetCurrent`](ProfileId::ResetCurrent) selects the active one,
    /// [`EraseEeprom`](ProfileId::EraseEeprom) erases everything. An example of the vendor uses
    /// [`Current`](ProfileId::Current), which the specification does not list for this command.
    pub profile_id: ProfileId,
}

/// Saves, clears or loads a set of all profiles, including simple calibrations.
#[message(CMD_PROFILE_SET, outgoing, size = 10, since = "2.65", answer = Confirm)]
pub struct ProfileSet {
    /// Slot of the profile set.
    #[wire(range = 1..=6)]
    pub slot: ProfileSetSlot,
    /// Action to perform on the slot.
    pub action: ProfileSetAction,
    pub reserved: Reserved<8>,
}

/// Slot of a profile set. Spec: `PROFILE_SET_SLOT`.
#[open_enum(u8)]
pub enum ProfileSetSlot {
    /// Slot 1.
    #[wire(spec = "SLOT_1")]
    Slot1 = 1,
    /// Slot 2.
    #[wire(spec = "SLOT_2")]
    Slot2 = 2,
    /// Slot 3.
    #[wire(spec = "SLOT_3")]
    Slot3 = 3,
    /// Slot 4.
    #[wire(spec = "SLOT_4")]
    Slot4 = 4,
    /// Slot 5.
    #[wire(spec = "SLOT_5")]
    Slot5 = 5,
    /// Backup slot.
    Backup = 6,
}

/// Action on a profile set. Spec: `PROFILE_SET_ACTION`.
#[open_enum(u8, prefix = "PROFILE_SET_ACTION_")]
pub enum ProfileSetAction {
    /// Saves the current parameters of all profiles to the slot.
    Save = 1,
    /// Clears the slot.
    Clear = 2,
    /// Loads the parameters from the slot.
    Load = 3,
}

/// Starts or finishes writing a series of parameter blocks, so that the board restarts only once.
#[message(CMD_WRITE_PARAMS_SET, outgoing, size = 1, since = "2.70b4", answer = Confirm)]
pub struct WriteParamsSet {
    /// Start or end of the series.
    pub action: WriteParamsSetAction,
}

/// Start or end of a series of parameter blocks. Spec: `WRITE_PARAMS_SET_ACTION`.
#[open_enum(u8)]
pub enum WriteParamsSetAction {
    /// All blocks were written; the board may restart.
    Finish = 0,
    /// Parameter blocks follow.
    Start = 1,
}
