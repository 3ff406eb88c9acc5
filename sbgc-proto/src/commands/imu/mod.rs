//! Inertial sensors: selection, support of the attitude estimation, and external sensors.
//!
//! A flight controller that knows attitude and heading can support the gimbal in one of two ways. The preferred way is
//! to send the attitude of the frame with [`AhrsHelperRequest`], 20 to 50 times per second. The gimbal can then do
//! without its accelerometer, but still needs its gyroscope. This requires the exact attitude, so it does not suit
//! gimbals mounted on dampers. The other way is to send linear accelerations with [`HelperData`], 10 to 20 times per
//! second: the gimbal still estimates its attitude itself, but no longer drifts when accelerated. Both messages can
//! include the heading.
//!
//! Vectors are in the East, North, down coordinate system. To convert from or to North, East, down, swap X and Y.

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
