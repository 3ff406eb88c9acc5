//! Immediate actions: motors, menu, restart, pins, sounds, and signals that replace radio control.

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
