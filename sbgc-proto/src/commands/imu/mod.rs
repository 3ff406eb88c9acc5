//! The inertial sensors: choosing one, helping its estimate of attitude, and external sensors.
//!
//! A flight controller that knows attitude and heading can help the gimbal in one of two ways. The first choice is to
//! give the attitude of the frame, by [`AhrsHelperRequest`], 20 to 50 times per second; the accelerometer may then be
//! left out, the gyroscope stays in use. It takes the exact attitude, so it does not suit a gimbal that hangs on
//! dampers. The other is to give linear accelerations, by [`HelperData`], 10 to 20 times per second: the gimbal still
//! finds its attitude itself, and no longer drifts when accelerated. Both can give the heading.
//!
//! Vectors are in the system East, North, down. To convert from or to North, East, down, swap X and Y.

mod ahrs;
mod external;
mod helper;
mod select;
#[cfg(test)]
mod tests;

pub use ahrs::*;
pub use external::*;
pub use helper::*;
pub use select::*;
