//! Immediate actions: motors, menu commands, restart, pins, sounds and virtual RC channels.

mod channels;
mod motors;
mod pins;
mod restart;
mod sound;
#[cfg(test)]
mod tests;

pub use channels::*;
pub use motors::*;
pub use pins::*;
pub use restart::*;
pub use sound::*;
