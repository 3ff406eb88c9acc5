//! What a board stores: files, scripts, the EEPROM as plain memory, the user's data; and devices on its I2C buses.
//!
//! Everything here is a method of [`Gimbal`]. Whatever is longer than a message goes in portions;
//! whatever is written is read back and compared. A portion whose confirmation was lost is looked at before it is
//! written again.

use crate::Gimbal;

mod eeprom;
mod files;
mod i2c;
mod scripts;
mod user_data;

pub use eeprom::{EEPROM_PAGE, eeprom_portions};
pub use files::{MAX_FILE, file_portions};
pub use scripts::{SCRIPT_SLOTS, script_file};

/// The longest portion: the most whole pages of 64 bytes that fit every message.
const PORTION: usize = 192;

/// Receives how many bytes of how many are done.
pub trait Progress: FnMut(usize, usize) {}

impl<F: FnMut(usize, usize)> Progress for F {}

/// A handle for writing again: until the late confirmation of the first write can no longer be taken for that of the
/// second, the second is held back, and its time runs.
fn patient(gimbal: &Gimbal) -> Gimbal {
    gimbal.with_timeout(gimbal.options().timeout.saturating_mul(4))
}
