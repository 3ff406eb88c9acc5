//! Times in logs. Only the distance of two of them matters, so each kind has a zero of its own.

use std::time::Duration;

const DAY: u64 = 86_400;

/// A time since 1970 as `2026-11-21T18:22:16.123456Z`.
pub(super) fn iso(since_1970: Duration) -> String {
    let (seconds, micros) = (since_1970.as_secs(), since_1970.subsec_micros());
    let (year, month, day) = date(seconds / DAY);
    let (hour, minute, second) = (seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{micros:06}Z")
}

/// Reads the time at the beginning of a log line.
///
/// Known are those of our own recordings, times of day (`12:34:56.789`), seconds with a fraction, and whole numbers,
/// which count milliseconds as the board does.
pub(super) fn parse(text: &str) -> Option<Duration> {
    let text = text.trim();
    if let Some((date, time)) = text.trim_end_matches('Z').split_once('T') {
        let mut parts = date.split('-').map(str::parse::<u64>);
        let (year, month, day) = (parts.next()?.ok()?, parts.next()?.ok()?, parts.next()?.ok()?);
        let days = days(year, month, day)?;
        return of_day(time)?.checked_add(Duration::from_secs(days.checked_mul(DAY)?));
    }
    if text.contains(':') {
        return of_day(text);
    }
    match text.parse::<u64>() {
        Ok(milliseconds) => Some(Duration::from_millis(milliseconds)),
        Err(_) => seconds(text),
    }
}

fn of_day(text: &str) -> Option<Duration> {
    let mut parts = text.splitn(3, ':');
    let (hours, minutes, rest) = (parts.next()?, parts.next()?, parts.next().unwrap_or("0"));
    let minutes = hours.parse::<u64>().ok()?.checked_mul(60)?.checked_add(minutes.parse().ok()?)?;
    Duration::from_secs(minutes.checked_mul(60)?).checked_add(seconds(rest)?)
}

fn seconds(text: &str) -> Option<Duration> {
    let number: f64 = text.replace(',', ".").parse().ok()?;
    Duration::try_from_secs_f64(number).ok()
}

/// Days from 1970 to a date of the Gregorian calendar.
fn days(year: u64, month: u64, day: u64) -> Option<u64> {
    if !(1970..=9999).contains(&year) || !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // Years that begin in March have their leap day at the end.
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    Some(year * 365 + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + day - 1 - TO_1970)
}

/// Days from the first of March in the year 0 to 1970.
const TO_1970: u64 = 719_468;

/// The date so many days after the beginning of 1970.
fn date(days: u64) -> (u64, u64, u64) {
    let days = days + TO_1970;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let year = era * 400 + year;
    if month < 10 { (year, month + 3, day) } else { (year + 1, month - 9, day) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_from_other_programs() {
        // By `date -u -d @N +%FT%T`.
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00"),
            (951_782_400, "2000-02-29T00:00:00"),
            (1_709_251_199, "2024-02-29T23:59:59"),
            (1_795_285_336, "2026-11-21T18:22:16"),
            (4_107_542_400, "2100-03-01T00:00:00"),
        ] {
            let time = Duration::new(seconds, 123_456_000);
            assert_eq!(iso(time), format!("{text}.123456Z"));
            assert_eq!(parse(&iso(time)), Some(time));
        }
    }

    #[test]
    fn times_of_other_logs() {
        assert_eq!(parse("12:34:56.789"), Some(Duration::from_millis(45_296_789)));
        assert_eq!(parse("12:34:56,5"), Some(Duration::from_millis(45_296_500)));
        assert_eq!(parse("12:34"), Some(Duration::from_mins(754)));
        assert_eq!(parse("123456"), Some(Duration::from_millis(123_456)));
        assert_eq!(parse("1.5"), Some(Duration::from_millis(1500)));
        for text in ["", "noon", "-1", "1970-13-01T00:00:00Z", "99999999999999999999:1:1", "nan"] {
            assert_eq!(parse(text), None, "{text}");
        }
    }
}
