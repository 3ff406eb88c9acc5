//! Storage on the board: EEPROM, files, user data and state variables.

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
