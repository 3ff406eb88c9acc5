//! Things that the board does at once: motors, menu, restart, pins, sounds, signals in place of radio control.

mod motors;
mod restart;
#[cfg(test)]
mod tests;

pub use motors::*;
pub use restart::*;
