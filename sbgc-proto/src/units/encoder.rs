//! The raw angle of encoders, whose 24 bits no integer of Rust has.

use core::fmt;

use super::quantity::{Scale, WholeScale};
use crate::wire::U24;

/// Raw angle of an encoder, in units of 1/16777216 turn.
///
/// ```
/// use sbgc_proto::units::EncoderAngle;
///
/// assert_eq!(EncoderAngle::from_degrees(90.0).0.get(), 1 << 22);
/// assert_eq!(EncoderAngle::from_degrees(90.0).degrees(), 90.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EncoderAngle(pub U24);

impl EncoderAngle {
    const STEPS: u32 = 1 << 24;
    const SCALE: Scale<f64> = Scale::<f64>::new(360, Self::STEPS);
    const WHOLE: WholeScale = WholeScale::new(360, Self::STEPS);
    const MILLI: WholeScale = WholeScale::new(360_000, Self::STEPS);
    const LIMITS: (i64, i64) = (0, Self::STEPS as i64);

    /// Angle in degrees, from 0 to a full turn.
    pub const fn degrees(self) -> f64 {
        Self::SCALE.value(self.0.get() as f64)
    }

    /// Nearest raw number for an angle in degrees over any number of turns; NaN becomes 0.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a turn")]
    pub const fn from_degrees(value: f64) -> Self {
        let turn = value % 360.0;
        let turn = if turn < 0.0 { turn + 360.0 } else { turn };
        Self::of_steps(Self::SCALE.steps(turn) as u32)
    }

    /// Angle in degrees, rounded to the nearest integer from 0 to 360. Uses integer arithmetic only.
    pub const fn whole_degrees(self) -> i32 {
        Self::WHOLE.value(self.0.get() as i64, Self::LIMITS)
    }

    /// Angle in thousandths of a degree, rounded to the nearest integer from 0 to 360000. Uses integer arithmetic only.
    pub const fn millidegrees(self) -> i32 {
        Self::MILLI.value(self.0.get() as i64, Self::LIMITS)
    }

    /// Nearest raw number for an angle in degrees over any number of turns. Uses integer arithmetic only.
    pub const fn from_whole_degrees(value: i32) -> Self {
        Self::of_turn(Self::WHOLE.raw(value.rem_euclid(360), Self::LIMITS))
    }

    /// Nearest raw number for an angle in thousandths of a degree over any number of turns. Uses integer arithmetic
    /// only.
    pub const fn from_millidegrees(value: i32) -> Self {
        Self::of_turn(Self::MILLI.raw(value.rem_euclid(360_000), Self::LIMITS))
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a turn")]
    const fn of_turn(steps: i64) -> Self {
        Self::of_steps(steps as u32)
    }

    /// A full turn is none.
    const fn of_steps(steps: u32) -> Self {
        let [low, middle, high, _] = steps.to_le_bytes();
        Self(U24::from_le_bytes([low, middle, high]))
    }
}

impl fmt::Display for EncoderAngle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.degrees().fmt(f)?;
        f.write_str(" deg")
    }
}

crate::declare::number_type!(
    EncoderAngle: U24, read |raw| EncoderAngle(raw), raw |value| value.0,
    scale "deg", 360.0, 16_777_216.0
);

#[cfg(feature = "serde")]
impl serde::Serialize for EncoderAngle {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            serializer.serialize_f64(self.degrees())
        } else {
            self.0.serialize(serializer)
        }
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for EncoderAngle {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if !deserializer.is_human_readable() {
            return U24::deserialize(deserializer).map(Self);
        }
        let steps = f64::from(Self::STEPS);
        let limits = (0.0, steps - 1.0);
        let visitor =
            crate::serde_support::QuantityVisitor { labels: &[], multiply: 360.0, divide: steps, limits };
        let raw = u32::try_from(deserializer.deserialize_any(visitor)?).map_err(serde::de::Error::custom)?;
        U24::try_from(raw).map(Self).map_err(serde::de::Error::custom)
    }
}
