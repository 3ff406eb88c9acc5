//! Adjustable variables: parameters that signals, buttons and hosts can change at run time.
//!
//! [`AdjustableVariable`] lists them. [`SetAdjVarsVal`] changes them immediately, without storing the values;
//! [`SaveParams3`] stores them in EEPROM. [`AdjVarsCfg`] maps signals to variables.

mod config;
mod info;
mod save;
mod state;
#[cfg(test)]
mod tests;
mod values;
mod variables;

pub use config::*;
pub use info::*;
pub use save::*;
pub use state::*;
pub use values::*;
pub use variables::*;
