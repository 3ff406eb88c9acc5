//! What the gimbal does right now: sensors, angles, errors, power.
//!
//! The blocks of fixed layout are in `fixed`, the angles alone in `angles`. In `custom` and `custom2` the host chooses
//! what an answer holds, and has to remember it to read the answer; the parts they are made of are in `blocks`.

mod angles;
mod blocks;
mod custom;
mod custom2;
mod fixed;
mod state;
#[cfg(test)]
mod tests;

pub use angles::*;
pub use blocks::*;
pub use custom::*;
pub use custom2::*;
pub use fixed::*;
pub use state::*;
