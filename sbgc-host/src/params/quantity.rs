//! Numbers with units: `45deg`, `0.5 s`, and as many digits as a value has.

use sbgc_proto::reflect::{Number, Scalar};

/// Units of one quantity that convert into each other, each with its size in the first.
const QUANTITIES: [&[(&str, f64)]; 8] = [
    &[("s", 1.0), ("ms", 0.001), ("us", 0.000_001), ("min", 60.0), ("m", 60.0)],
    &[("deg", 1.0), ("°", 1.0), ("rad", 180.0 / std::f64::consts::PI)],
    &[("deg/s", 1.0), ("°/s", 1.0), ("rad/s", 180.0 / std::f64::consts::PI)],
    &[("deg/s^2", 1.0), ("deg/s2", 1.0), ("°/s²", 1.0)],
    &[("V", 1.0), ("mV", 0.001)],
    &[("A", 1.0), ("mA", 0.001)],
    &[("Hz", 1.0), ("kHz", 1000.0)],
    &[("Ohm", 1.0), ("mOhm", 0.001), ("uOhm", 0.000_001)],
];

/// A unit that does not belong to a value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnitError {
    /// The value has another unit.
    #[error("expected a value in {expected}, got {got:?}")]
    Other {
        /// The unit of the value.
        expected: &'static str,
        /// What was given.
        got: String,
    },
    /// The value has no unit.
    #[error("expected a number without a unit, got {got:?}")]
    Unexpected {
        /// What was given.
        got: String,
    },
}

/// A number and what follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Amount<'t> {
    number: f64,
    unit: &'t str,
}

impl<'t> Amount<'t> {
    /// The number at the beginning of `text`; none when there is none.
    pub(super) fn split(text: &'t str) -> Option<Self> {
        let number_end = |character: char| !(character.is_ascii_digit() || "+-.".contains(character));
        let mut end = text.find(number_end).unwrap_or(text.len());
        // An exponent, unless the letter begins a unit.
        if let Some(rest) = text.get(end..).and_then(|rest| rest.strip_prefix(['e', 'E'])) {
            let digits = rest.find(number_end).unwrap_or(rest.len());
            if digits > 0 {
                end += 1 + digits;
            }
        }
        let (number, unit) = text.split_at_checked(end)?;
        Some(Self { number: number.parse().ok()?, unit: unit.trim() })
    }

    /// The number in `unit`.
    pub(super) fn in_unit(self, unit: &'static str) -> Result<f64, UnitError> {
        if self.unit.is_empty() || self.unit.eq_ignore_ascii_case(unit) {
            return Ok(self.number);
        }
        let got = self.unit.to_owned();
        if unit.is_empty() {
            return Err(UnitError::Unexpected { got });
        }
        let size = |units: &[(&str, f64)], wanted: &str| {
            let exact = units.iter().find(|(name, _)| *name == wanted);
            exact
                .or_else(|| units.iter().find(|(name, _)| name.eq_ignore_ascii_case(wanted)))
                .map(|(_, size)| *size)
        };
        QUANTITIES
            .iter()
            .find_map(|units| Some(self.number * size(units, self.unit)? / size(units, unit)?))
            .ok_or(UnitError::Other { expected: unit, got })
    }
}

/// The value of `raw` with as many digits as tell it from its neighbors, and at least as many as give it back.
pub(super) fn digits(number: &Number, raw: i64) -> String {
    let value = number.value(raw);
    if number.scalar == Scalar::f32 {
        #[allow(clippy::cast_possible_truncation, reason = "it came from 32 bits")]
        let value = value as f32;
        return format!("{value}");
    }
    if !number.is_scaled() {
        return format!("{value}");
    }
    let step = number.multiply / number.divide;
    let first = (0..12).find(|&digits| step.abs() * 10_f64.powi(digits) >= 0.999).unwrap_or(12);
    let text = |digits: i32| format!("{value:.*}", usize::try_from(digits).unwrap_or_default());
    let gives_back = |text: &String| {
        #[allow(clippy::cast_precision_loss, reason = "raw integers have 32 bits")]
        let raw = raw as f64;
        text.parse::<f64>().is_ok_and(|value| ((value / step) - raw).abs() < 0.499)
    };
    let text = (first..first + 4).map(text).find(gives_back).unwrap_or_else(|| format!("{value}"));
    match text.trim_end_matches('0').trim_end_matches('.') {
        _ if !text.contains('.') => text,
        "-0" => String::from("0"),
        trimmed => trimmed.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert_within_their_quantity() {
        let read = |text, unit| Amount::split(text).unwrap().in_unit(unit);
        assert_eq!(read("45deg", "deg"), Ok(45.0));
        assert_eq!(read("0.5 s", "ms"), Ok(500.0));
        assert_eq!(read("-1e3 mV", "V"), Ok(-1.0));
        assert_eq!(read("2m", "s"), Ok(120.0));
        assert_eq!(read("12", "V"), Ok(12.0));
        assert_eq!(read("3s", "deg"), Err(UnitError::Other { expected: "deg", got: "s".into() }));
        assert_eq!(read("3s", ""), Err(UnitError::Unexpected { got: "s".into() }));
        assert_eq!(Amount::split("fast"), None);
        assert_eq!(Amount::split("--3"), None);
    }
}
