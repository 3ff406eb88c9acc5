//! Angles and speeds in arguments, within what can be sent.

use sbgc_proto::OutOfRange;
use sbgc_proto::units::ControlRate;

use crate::values;

/// An angle that can be sent, in degrees.
pub(super) fn angle(text: &str) -> Result<f32, String> {
    values::angle(text).and_then(|_| values::degrees(text))
}

/// A speed that can be sent, of either direction, in degrees per second.
pub(super) fn rate(text: &str) -> Result<f32, String> {
    values::rate(text).and_then(|_| values::degrees_per_second(text))
}

/// The speed of a move: its direction is for the angle to say.
pub(super) fn speed(text: &str) -> Result<f32, String> {
    let value = values::degrees_per_second(text)?;
    let slowest = f64::from(ControlRate(1).degrees_per_second());
    let range = match ControlRate::try_from_degrees_per_second(value) {
        Ok(rate) if rate.0 > 0 => return Ok(value),
        Ok(_) => {
            let maximum = f64::from(ControlRate(i16::MAX).degrees_per_second());
            OutOfRange { minimum: slowest, maximum, unit: "deg/s" }
        }
        Err(range) => OutOfRange { minimum: slowest, ..range },
    };
    Err(format!("{text} is {range}"))
}
