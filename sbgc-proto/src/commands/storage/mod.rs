//! What the board keeps: EEPROM, files, user data, and the state that outlives a restart.

mod eeprom;
mod files;
mod state_vars;
#[cfg(test)]
mod tests;
mod user_data;

pub use eeprom::*;
pub use files::*;
pub use state_vars::*;
pub use user_data::*;
