//! The raw angle of encoders, whose 24 bits no integer of Rust has.

use core::fmt;

use super::quantity::steps;
use crate::wire::U24;

/// The raw angle of an encoder, in steps of 24 bits per turn.
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

    /// The angle in deg, from 0 to a full turn.
    pub fn degrees(self) -> f64 {
        f64::from(self.0.get()) * 360.0 / f64::from(Self::STEPS)
    }

    /// The nearest raw number for an angle in deg, of any number of turns; 0 for NaN.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a turn")]
    pub fn from_degrees(value: f64) -> Self {
        let turn = value % 360.0;
        let turn = if turn < 0.0 { turn + 360.0 } else { turn };
        let raw = steps(turn, 360.0, f64::from(Self::STEPS)) as u32;
        Self((raw % Self::STEPS).try_into().unwrap_or(U24::MAX))
    }
}

impl fmt::Display for EncoderAngle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.degrees().fmt(f)?;
        f.write_str(" deg")
    }
}

crate::declare::number_type!(EncoderAngle: U24, read |raw| EncoderAngle(raw), raw |value| value.0);

#[cfg(feature = "reflect")]
impl crate::reflect::NumberType for EncoderAngle {
    const NUMBER: crate::reflect::Number = crate::reflect::Number {
        unit: "deg",
        multiply: 360.0,
        divide: 16_777_216.0,
        ..crate::reflect::Number::plain(crate::reflect::Scalar::u24)
    };

    fn raw_number(&self) -> i64 {
        i64::from(self.0.get())
    }

    fn from_raw_number(raw: i64) -> Option<Self> {
        U24::from_raw_number(raw).map(Self)
    }
}

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
