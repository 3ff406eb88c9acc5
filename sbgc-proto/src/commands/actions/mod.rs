//! Things that the board does at once: motors, menu, restart, pins, sounds, signals in place of radio control.

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
