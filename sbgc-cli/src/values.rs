//! Numbers with units in arguments: times, rates, angles.
//!
//! Each function is a value parser of clap. Arguments that take them should have `allow_hyphen_values`, so that
//! `--pitch -30deg` works as it stands.

use std::time::Duration;

use sbgc_proto::units::{Angle, ControlRate};

/// A time: `200ms`, `0.5s`, `2m`; without a unit seconds. For `--for` and `--patience`.
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    time(text, 1.0).and_then(|time| positive(text, time))
}

/// A time: `200ms`, `0.5s`; without a unit milliseconds. For `--timeout`: 1 ms to 10 minutes.
pub(crate) fn timeout(text: &str) -> Result<Duration, String> {
    let time = time(text, 1e-3)?;
    let range = Duration::from_millis(1)..=Duration::from_mins(10);
    if range.contains(&time) { Ok(time) } else { Err(format!("{text} is out of range; expected 1ms to 10m")) }
}

/// A delay that the board counts in milliseconds of 16 bits: `100ms`, `1s`.
pub(crate) fn delay(text: &str) -> Result<Duration, String> {
    let time = time(text, 1e-3)?;
    let range = Duration::from_millis(1)..=Duration::from_millis(u16::MAX.into());
    if range.contains(&time) {
        Ok(time)
    } else {
        Err(format!("{text} is out of range; expected 1ms to 65535ms"))
    }
}

/// A time or a rate, in milliseconds as the board counts them: `20`, `20ms`, `50Hz`. For `--interval`.
pub(crate) fn interval(text: &str) -> Result<u16, String> {
    let (number, unit) = split(text).ok_or_else(|| expected_interval(text))?;
    let milliseconds = match unit.to_ascii_lowercase().as_str() {
        "hz" => 1000.0 / number,
        "khz" => 1.0 / number,
        _ => time(text, 1e-3).map_err(|_| expected_interval(text))?.as_secs_f64() * 1000.0,
    };
    // The board's own cycle of 0.8 ms is what 1 stands for.
    let range = 0.8..=65_535.0;
    if range.contains(&milliseconds) {
        Ok(to_u16(milliseconds.round().max(1.0)))
    } else {
        Err(format!("{text} is out of range; expected 1ms to 65535ms, or 0.0153Hz to 1250Hz"))
    }
}

fn expected_interval(text: &str) -> String {
    format!("expected a time such as 20ms or a rate such as 50Hz, got \"{text}\"")
}

/// An angle in degrees: `45`, `-30deg`.
pub(crate) fn degrees(text: &str) -> Result<f32, String> {
    let expected = || format!("expected an angle in degrees such as 45 or -30deg, got \"{text}\"");
    let (number, unit) = split(text).ok_or_else(expected)?;
    match unit.to_ascii_lowercase().as_str() {
        "" | "deg" | "°" => Ok(to_f32(number)),
        _ => Err(expected()),
    }
}

/// An angle that control commands can carry.
pub(crate) fn angle(text: &str) -> Result<Angle, String> {
    Angle::try_from_degrees(degrees(text)?).map_err(|error| format!("{text} is {error}"))
}

/// A speed in degrees per second: `20`, `-5deg/s`.
pub(crate) fn degrees_per_second(text: &str) -> Result<f32, String> {
    let expected = || format!("expected a speed in degrees per second such as 20 or 20deg/s, got \"{text}\"");
    let (number, unit) = split(text).ok_or_else(expected)?;
    match unit.to_ascii_lowercase().as_str() {
        "" | "deg/s" | "°/s" => Ok(to_f32(number)),
        _ => Err(expected()),
    }
}

/// A speed that control commands can carry, of either direction.
pub(crate) fn rate(text: &str) -> Result<ControlRate, String> {
    ControlRate::try_from_degrees_per_second(degrees_per_second(text)?)
        .map_err(|error| format!("{text} is {error}"))
}

/// A number of 32 bits, decimal or hexadecimal after `0x`.
pub(crate) fn number(text: &str) -> Result<u32, String> {
    let number = match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        Some(digits) => u32::from_str_radix(digits, 16),
        None => text.parse(),
    };
    number.map_err(|_| format!("expected a 32-bit number, decimal or 0x hex, got \"{text}\""))
}

/// Bytes in hex, as `decode --from hex` reads them: white space, `:`, `,` and `0x` between bytes allowed.
pub(crate) fn bytes(text: &str) -> Result<Vec<u8>, String> {
    let digits: String = text
        .split(|separator: char| separator.is_whitespace() || separator == ':' || separator == ',')
        .map(|part| part.strip_prefix("0x").unwrap_or(part))
        .collect();
    hex::decode(digits).map_err(|error| format!("expected bytes in hex: {error}"))
}

/// A time as people write it: `200ms`, `0.5s`, `2m`.
pub(crate) fn time_text(time: Duration) -> String {
    let milliseconds = time.as_secs_f64() * 1000.0;
    match time.as_millis() {
        0 if time.is_zero() => String::from("0s"),
        0..1000 => format!("{milliseconds}ms"),
        millis if millis % 60_000 == 0 => format!("{}m", millis / 60_000),
        _ => format!("{}s", milliseconds / 1000.0),
    }
}

/// A number as it was typed, without the digits that a wider type adds.
pub(crate) fn plain(value: f32) -> f64 {
    value.to_string().parse().unwrap_or_else(|_| value.into())
}

fn time(text: &str, without_unit: f64) -> Result<Duration, String> {
    let expected = || format!("expected a time such as 200ms, 0.5s or 2m, got \"{text}\"");
    let (number, unit) = split(text).ok_or_else(expected)?;
    let scale = match unit.to_ascii_lowercase().as_str() {
        "" => without_unit,
        "us" | "µs" => 1e-6,
        "ms" => 1e-3,
        "s" | "sec" => 1.0,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err(expected()),
    };
    Duration::try_from_secs_f64(number * scale)
        .ok()
        .filter(|time| *time <= LONGEST)
        .ok_or_else(|| format!("{text} is out of range; expected a time of 0s to 8760h"))
}

/// A year.
const LONGEST: Duration = Duration::from_hours(365 * 24);

fn positive(text: &str, time: Duration) -> Result<Duration, String> {
    if time.is_zero() { Err(format!("{text} is out of range; expected more than 0s")) } else { Ok(time) }
}

/// A finite number and what follows it.
fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let digits = |character: char| !(character.is_ascii_digit() || "+-.".contains(character));
    let end = text.find(digits).unwrap_or(text.len());
    // 1e3 is a number, 1e is not.
    let end = match text.get(end..) {
        Some(rest) if rest.starts_with(['e', 'E']) => {
            let exponent = rest.get(1..).unwrap_or_default();
            let length = exponent.find(digits).unwrap_or(exponent.len());
            if length > 0 { end + 1 + length } else { end }
        }
        _ => end,
    };
    let (number, unit) = text.split_at_checked(end)?;
    let number: f64 = number.parse().ok()?;
    number.is_finite().then_some((number, unit.trim_start()))
}

#[allow(clippy::cast_possible_truncation, reason = "the nearest f32 is what is asked for")]
fn to_f32(number: f64) -> f32 {
    number as f32
}

/// A whole number.
fn to_u16(number: f64) -> u16 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
    let whole = number as u16;
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times() {
        for (text, milliseconds) in [
            ("200ms", 200),
            ("0.5s", 500),
            ("2m", 120_000),
            ("3", 3000),
            ("1h", 3_600_000),
            ("1e1 s", 10_000),
        ] {
            assert_eq!(seconds(text), Ok(Duration::from_millis(milliseconds)), "{text}");
        }
        assert_eq!(timeout("200"), Ok(Duration::from_millis(200)));
        for text in ["", "s", "-1s", "0", "1x", "nan", "inf", "1e400", "1e99"] {
            assert!(seconds(text).is_err(), "{text}");
        }
        for text in ["0", "11m", "18446744073709551615", "200Hz"] {
            assert!(timeout(text).is_err(), "{text}");
        }
    }

    #[test]
    fn delays_fit_the_board() {
        assert_eq!(delay("65535ms"), Ok(Duration::from_millis(65_535)));
        assert_eq!(delay("2"), Ok(Duration::from_millis(2)));
        for text in ["0", "66s", "65536"] {
            assert!(delay(text).unwrap_err().contains("65535ms"), "{text}");
        }
    }

    #[test]
    fn intervals_are_times_or_rates() {
        for (text, milliseconds) in
            [("20", 20), ("20ms", 20), ("50Hz", 20), ("50 hz", 20), ("1s", 1000), ("1250Hz", 1), ("30Hz", 33)]
        {
            assert_eq!(interval(text), Ok(milliseconds), "{text}");
        }
        for text in ["0", "0Hz", "-5", "2000Hz", "65536", "2m", "Hz", "5 apples"] {
            assert!(interval(text).is_err(), "{text}");
        }
    }

    #[test]
    fn angles_and_speeds() {
        assert_eq!(degrees("-45deg"), Ok(-45.0));
        assert_eq!(degrees("45"), Ok(45.0));
        assert_eq!(degrees_per_second("-2.5 deg/s"), Ok(-2.5));
        assert_eq!(angle("-30").map(Angle::degrees), Ok(Angle::from_degrees(-30.0).degrees()));
        assert!(angle("1000").is_err() && degrees("1rad").is_err() && rate("1e9").is_err());
    }

    #[test]
    fn times_are_shown_as_they_are_read() {
        for text in ["500ms", "1.5s", "2m", "20s"] {
            assert_eq!(time_text(seconds(text).unwrap()), text);
        }
    }

    #[test]
    fn hexadecimal_bytes() {
        assert_eq!(bytes("0x3E, 52:01 ff"), Ok(vec![0x3E, 0x52, 1, 0xFF]));
        assert!(bytes("3").is_err() && bytes("zz").is_err());
    }
}
