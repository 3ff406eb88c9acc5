//! Calibrations: of the sensors, of the encoders, of motors and battery.
//!
//! Most start with one short message and end with a [`CMD_CONFIRM`](crate::CommandId::CONFIRM). Each message here says
//! how many confirmations there are, when they come, and whether the gimbal moves. From newer firmware a host can also
//! see what is going on in the calibration mode that `CMD_REALTIME_DATA_4` carries.

mod encoders;
mod imu;
mod info;
mod motors;
mod reference;
mod simple;
#[cfg(test)]
mod tests;

pub use encoders::*;
pub use imu::*;
pub use info::*;
pub use motors::*;
pub use reference::*;
pub use simple::*;
