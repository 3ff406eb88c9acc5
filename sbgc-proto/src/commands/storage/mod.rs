//! What the board keeps: EEPROM, files, user data, and the state that outlives a restart.

mod eeprom;
#[cfg(test)]
mod tests;

pub use eeprom::*;
