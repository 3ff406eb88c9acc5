//! Profiles and sets of them: names, storing, resetting.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::{Confirm, ProfileId};
use crate::wire::{FixedText, Reserved};

/// Requests the names of the profiles.
///
/// The specification's heading calls it `CMD_READ_PROFILE_NAMES_3`; there is one command only.
#[message(CMD_READ_PROFILE_NAMES, outgoing, size = 0, answer = ProfileNames)]
pub struct ReadProfileNames;

/// The names of the profiles.
#[message(CMD_READ_PROFILE_NAMES, incoming, size = 240)]
pub struct ProfileNames {
    /// The five names, in UTF-8.
    pub profile_name: [FixedText<48>; 5],
}

/// Stores the names of the profiles in EEPROM.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation. The
/// specification's heading calls it `CMD_WRITE_PROFILE_NAMES_3`; there is one command only.
#[message(CMD_WRITE_PROFILE_NAMES, outgoing, size = 240, answer = Confirm)]
pub struct WriteProfileNames(pub ProfileNames);

/// Resets the parameters of a profile to those of the factory, or all of the EEPROM.
///
/// Whether the board confirms it is unknown: the specification does not say, and the vendor's library does not wait
/// for it. Take a `CMD_CONFIRM` if it comes, and do not depend on it.
#[message(CMD_USE_DEFAULTS, outgoing, size = 1)]
pub struct UseDefaults {
    /// Profile to reset: [`ResetCurrent`](ProfileId::ResetCurrent) is the active one and
    /// [`EraseEeprom`](ProfileId::EraseEeprom) erases everything. The vendor's example passes
    /// [`Current`](ProfileId::Current), which the specification does not list for this command.
    pub profile_id: ProfileId,
}

/// Saves, clears or loads a whole set of profiles, with simple calibrations.
#[message(CMD_PROFILE_SET, outgoing, size = 10, since = "2.65", answer = Confirm)]
pub struct ProfileSet {
    /// Slot of the profile set.
    #[wire(range = 1..=6)]
    pub slot: ProfileSetSlot,
    /// Action to perform on it.
    pub action: ProfileSetAction,
    pub reserved: Reserved<8>,
}

/// Slot of a profile set. Spec: `PROFILE_SET_SLOT`.
#[open_enum(u8)]
pub enum ProfileSetSlot {
    /// First.
    #[wire(spec = "SLOT_1")]
    Slot1 = 1,
    /// Second.
    #[wire(spec = "SLOT_2")]
    Slot2 = 2,
    /// Third.
    #[wire(spec = "SLOT_3")]
    Slot3 = 3,
    /// Fourth.
    #[wire(spec = "SLOT_4")]
    Slot4 = 4,
    /// Fifth.
    #[wire(spec = "SLOT_5")]
    Slot5 = 5,
    /// The backup.
    Backup = 6,
}

/// Action on a profile set. Spec: `PROFILE_SET_ACTION`.
#[open_enum(u8, prefix = "PROFILE_SET_ACTION_")]
pub enum ProfileSetAction {
    /// The present parameters, of all profiles, are saved to the slot.
    Save = 1,
    /// The slot is cleared.
    Clear = 2,
    /// The parameters in the slot become the present ones.
    Load = 3,
}

/// Brackets a series of blocks that are written, so that the board restarts once instead of after each.
#[message(CMD_WRITE_PARAMS_SET, outgoing, size = 1, since = "2.70b4", answer = Confirm)]
pub struct WriteParamsSet {
    /// Whether the series begins or ends.
    pub action: WriteParamsSetAction,
}

/// Whether a series of blocks that are written begins or ends. Spec: `WRITE_PARAMS_SET_ACTION`.
#[open_enum(u8)]
pub enum WriteParamsSetAction {
    /// All blocks are written; the board may restart.
    Finish = 0,
    /// Blocks follow.
    Start = 1,
}
