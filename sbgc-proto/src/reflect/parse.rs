//! Raw numbers from what people and files say: values, names, and all that is shown of a number.

use super::{AssignError, BitPart, FieldInfo, Input, Meaning, Number, Scalar};
use crate::OutOfRange;
use crate::wire::Label;

impl Number {
    /// The raw number for `input`: exactly what it says, or for a scaled number the nearest.
    pub(super) fn raw_of(&self, input: Input<'_>, field: &'static FieldInfo) -> Result<i64, AssignError> {
        match input {
            Input::Raw(raw) => Ok(raw),
            Input::Value(value) => self.raw_of_value(value, field),
            Input::Text(text) => match shown_with_note(text.trim()) {
                Some((shown, note)) => self.raw_of_both(shown, note, field),
                None => self.raw_of_text(text.trim(), field),
            },
            Input::Bytes(_) => Err(AssignError::NotANumber { number: *self }),
        }
    }

    /// The documented range that `raw` is outside of, if any.
    pub(super) fn outside(&self, raw: i64, field: &'static FieldInfo) -> Option<OutOfRange> {
        if matches!(self.meaning, Meaning::Special(labels) if labels.iter().any(|label| label.value == raw)) {
            return None;
        }
        #[allow(clippy::cast_precision_loss, reason = "raw integers have 32 bits")]
        let number = if self.scalar == Scalar::f32 { self.value(raw) } else { raw as f64 };
        let (minimum, maximum) = field.range?;
        let inside = (minimum..=maximum).contains(&number);
        (!inside).then(|| self.range(Some((minimum, maximum)), field))
    }

    /// The error for a value outside of `range`, which are raw numbers; without one, those that the wire can hold.
    pub(crate) fn out_of_range(&self, range: Option<(f64, f64)>, field: &'static FieldInfo) -> AssignError {
        AssignError::OutOfRange(self.range(range, field))
    }

    fn range(&self, range: Option<(f64, f64)>, field: &'static FieldInfo) -> OutOfRange {
        let limits = match self.scalar {
            Scalar::f32 => (f32::MIN.into(), f32::MAX.into()),
            scalar => scalar.limits(),
        };
        let (minimum, maximum) = range.unwrap_or(limits);
        let unit = if self.unit.is_empty() { field.unit } else { self.unit };
        let physical = |raw: f64| raw * self.multiply / self.divide;
        OutOfRange { minimum: physical(minimum), maximum: physical(maximum), unit }
    }

    #[allow(clippy::cast_possible_truncation, reason = "checked against the limits before")]
    fn raw_of_value(&self, value: f64, field: &'static FieldInfo) -> Result<i64, AssignError> {
        if self.scalar == Scalar::f32 {
            let float = value as f32;
            if value.is_finite() && float.is_infinite() {
                return Err(self.out_of_range(None, field));
            }
            if value != 0.0 && float == 0.0 {
                return Err(AssignError::Inexact);
            }
            return Ok(i64::from(float.to_bits()));
        }
        let steps = value * self.divide / self.multiply;
        let nearest = steps + if steps < 0.0 { -0.5 } else { 0.5 };
        let (minimum, maximum) = self.scalar.limits();
        // The cast cuts off what is behind the point: only a whole step beyond the limits is out of them.
        if !(nearest > minimum - 1.0 && nearest < maximum + 1.0) {
            return Err(self.out_of_range(None, field));
        }
        let raw = nearest as i64;
        #[allow(clippy::cast_precision_loss, reason = "raw integers have 32 bits")]
        let rounding = (steps - raw as f64).abs();
        // Units bring rounding with them, whole numbers do not; the tolerance is for factors like 1000.
        if !self.is_scaled() && rounding > 1e-9 * steps.abs() {
            return Err(AssignError::Inexact);
        }
        Ok(raw)
    }

    fn raw_of_text(&self, text: &str, field: &'static FieldInfo) -> Result<i64, AssignError> {
        if let Some(raw) = self.raw_of_name(text).or_else(|| hexadecimal(text)) {
            return Ok(raw);
        }
        if let Meaning::Shown { read, .. } = self.meaning {
            // What is nearly a version is not to pass as a number.
            let raw = read(text).or_else(|| text.parse().ok());
            return raw.ok_or(AssignError::NotANumber { number: *self });
        }
        let unit = if self.unit.is_empty() { field.unit } else { self.unit };
        match value_in(text, unit) {
            Some(value) => self.raw_of_value(value, field),
            None => Err(AssignError::NotANumber { number: *self }),
        }
    }

    /// The raw number that both texts stand for: a number and its names, or names and their number.
    fn raw_of_both(&self, shown: &str, note: &str, field: &'static FieldInfo) -> Result<i64, AssignError> {
        let raw = self.raw_of_text(shown, field)?;
        let noted = self.raw_of_name(note).or_else(|| hexadecimal(note)).or_else(|| note.parse().ok());
        let noted = noted.ok_or(AssignError::NotANumber { number: *self })?;
        // Every NaN is shown as such; its bits are in the note.
        let both_nan = self.scalar == Scalar::f32 && self.value(raw).is_nan() && self.value(noted).is_nan();
        if raw == noted || both_nan { Ok(noted) } else { Err(AssignError::Contradiction) }
    }

    /// The raw number that has these names.
    pub(crate) fn raw_of_name(&self, text: &str) -> Option<i64> {
        match self.meaning {
            Meaning::Enum(labels) | Meaning::Special(labels) => raw_of_label(labels, text),
            Meaning::Flags(labels) => {
                let mut names = text.split(['|', '+']).map(str::trim);
                names.try_fold(0, |raw, name| {
                    Some(raw | raw_of_label(labels, name).or_else(|| hexadecimal(name))?)
                })
            }
            Meaning::Bits(parts, names) => raw_of_label(names, text).or_else(|| raw_of_parts(parts, text)),
            Meaning::Plain | Meaning::Shown { .. } => None,
        }
    }
}

/// Splits `45 (NAME)` into `45` and `NAME`.
fn shown_with_note(text: &str) -> Option<(&str, &str)> {
    text.strip_suffix(')')?.split_once(" (")
}

fn raw_of_label(labels: &[Label], name: &str) -> Option<i64> {
    labels.iter().find(|label| label.name.eq_ignore_ascii_case(name)).map(|label| label.value)
}

/// The number for `NAME=VALUE` of some parts, the names of values that only one part has, names of single bits, and hex
/// for bits that no part takes; what is not named is zero.
fn raw_of_parts(parts: &[BitPart], text: &str) -> Option<i64> {
    let mut words = text.split(['|', ' ', ',']).filter(|word| !word.is_empty()).peekable();
    words.peek()?;
    let mut raw = 0;
    // Nothing may be said twice.
    let mut said = 0;
    for word in words {
        let (bits, mask) = match word.split_once('=') {
            Some((name, value)) => {
                let part = parts.iter().find(|part| part.name.eq_ignore_ascii_case(name))?;
                let value = raw_of_label(part.labels, value)
                    .or_else(|| value.parse().ok())
                    .filter(|value| (0..=part.mask()).contains(value))?;
                (value << part.low, part.mask() << part.low)
            }
            None => match hexadecimal(word) {
                Some(bits) => (bits, bits),
                None => raw_of_word(parts, word)?,
            },
        };
        if said & mask != 0 {
            return None;
        }
        (raw, said) = (raw | bits, said | mask);
    }
    Some(raw)
}

/// What one name says by itself: the value of the only part that has it, or that a bit is set. With it the bits that it
/// speaks of.
fn raw_of_word(parts: &[BitPart], word: &str) -> Option<(i64, i64)> {
    // Some values are called "24": by itself that is the number.
    if word.parse::<i64>().is_ok() {
        return None;
    }
    let mut meanings = parts.iter().filter_map(|part| {
        let is_bit = part.width == 1 && part.name.eq_ignore_ascii_case(word);
        let value = if is_bit { Some(1) } else { raw_of_label(part.labels, word) };
        value.map(|value| (value << part.low, part.mask() << part.low))
    });
    let only = meanings.next();
    only.filter(|_| meanings.next().is_none())
}

fn hexadecimal(text: &str) -> Option<i64> {
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))?;
    // No sign, as from_str_radix would take one.
    let only_digits = digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    i64::from_str_radix(digits, 16).ok().filter(|_| only_digits)
}

/// The value in `unit` of a number that may be followed by that unit or by the same one with another prefix, as 0.5 s
/// for 500 ms.
fn value_in(text: &str, unit: &str) -> Option<f64> {
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    if unit.is_empty() {
        return None;
    }
    let tail = text.len().checked_sub(unit.len()).and_then(|at| text.split_at_checked(at));
    if let Some((number, _)) = tail.filter(|(_, tail)| tail.eq_ignore_ascii_case(unit)) {
        return number.trim_end().parse().ok();
    }
    let end = text.rfind(|character: char| character.is_ascii_digit() || character == '.')? + 1;
    let (number, written) = text.split_at_checked(end)?;
    let (given, same) = prefix_of(written.trim_start())?;
    let (wanted, base) = prefix_of(unit)?;
    let value: f64 = number.parse().ok()?;
    (base == same).then(|| value * given / wanted)
}

/// The factor of a unit's prefix, and the unit without it.
fn prefix_of(unit: &str) -> Option<(f64, &str)> {
    const BASES: [&str; 6] = ["s", "V", "A", "Hz", "Ohm", "rad/s"];

    if BASES.contains(&unit) {
        return Some((1.0, unit));
    }
    let prefixes = [("m", 1e-3), ("u", 1e-6), ("µ", 1e-6), ("k", 1e3)];
    prefixes.into_iter().find_map(|(prefix, factor)| {
        let base = unit.strip_prefix(prefix)?;
        BASES.contains(&base).then_some((factor, base))
    })
}
