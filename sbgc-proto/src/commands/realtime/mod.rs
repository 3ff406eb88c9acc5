//! Real-time data: sensors, angles, errors and power.
//!
//! Messages with a fixed layout are in `fixed`, those with angles only in `angles`. In `custom` and `custom2` the host
//! selects the fields and needs the selection again to decode the answer; the records they consist of are in `blocks`.

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
