//! Adjustable variables: parameters that signals, buttons and hosts change at run time.
//!
//! [`AdjustableVariable`] lists them. Hosts change them with [`SetAdjVarsVal`] at once, without storing them;
//! [`SaveParams3`] stores them. [`AdjVarsCfg`] says which signals change which.

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
