//! Calibration of sensors, encoders, motors and battery monitoring.
//!
//! Most calibrations start with one short message and end with a [`CMD_CONFIRM`](crate::CommandId::CONFIRM). Each
//! message documents how many confirmations to expect and when, and whether the gimbal moves. Newer firmware also
//! reports the current calibration mode in `CMD_REALTIME_DATA_4`.

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
