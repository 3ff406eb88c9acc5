//! Fields of messages as text and as JSON, from what they say of themselves.

use sbgc_proto::reflect::{self, Describe, Leaf, Meaning, Number, Plain, Quoted, Raw, Scalar};
use serde_json::{Map, Value, json};

use crate::line::Line;

/// Appends one field as JSON.
pub(crate) fn write_json(leaf: &Leaf<'_>, line: &mut Line) {
    line.push(r#"{"path":""#);
    // A vector takes everything.
    let _ = leaf.path.write_to(line);
    line.push(r#"","spec":""#);
    line.push(leaf.field.spec);
    line.push(r#"","offset":"#);
    line.integer(leaf.offset);
    line.push(r#","size":"#);
    line.integer(leaf.size);
    line.push(r#","type":""#);
    line.push(leaf.type_name());
    line.push(r#"","raw":"#);
    let start = line.len();
    match leaf.raw {
        Raw::Bytes(bytes) | Raw::Text(bytes) => {
            line.push("\"");
            line.hex(bytes);
            line.push("\"");
        }
        Raw::Number(raw) if is_float(leaf) => match leaf.value() {
            Some(value) if value.is_finite() => line.json_number(value),
            // JSON has no NaN; its bits are what came.
            _ => line.show(format_args!("\"{raw:#010x}\"")),
        },
        Raw::Number(raw) => line.integer(raw),
    }
    let end = line.len();
    line.push(r#","value":"#);
    match (leaf.raw, leaf.number) {
        (Raw::Bytes(_), _) => line.push("null"),
        (Raw::Text(text), _) => line.json_text(&Plain(text_of(leaf, text)).to_string()),
        (Raw::Number(_), Some(number)) if !is_float(leaf) && !number.is_scaled() => line.repeat(start..end),
        (Raw::Number(_), _) => match leaf.value() {
            Some(value) if !value.is_finite() => line.push("null"),
            Some(_) if is_float(leaf) => line.repeat(start..end),
            value => line.json_number(value.unwrap_or_default()),
        },
    }
    line.push(r#","unit":"#);
    line.json_name(Some(leaf.unit()).filter(|unit| !unit.is_empty()));
    line.push(r#","label":"#);
    match name_of(leaf) {
        Some(name) => line.json_name(Some(name)),
        None => match leaf.label() {
            Some(label) => {
                line.push("\"");
                line.show(label);
                line.push("\"");
            }
            None => line.push("null"),
        },
    }
    line.push("}");
}

/// Appends one field as text: path, value, unit, names.
pub(crate) fn write_text(leaf: &Leaf<'_>, line: &mut Line) {
    // A vector takes everything.
    let _ = leaf.path.write_to(line);
    line.push(" = ");
    write_value(leaf, line);
}

/// Appends the value of a field with its unit and names.
fn write_value(leaf: &Leaf<'_>, line: &mut Line) {
    match leaf.raw {
        Raw::Bytes([]) => line.push("-"),
        Raw::Bytes(bytes) => line.hex(bytes),
        Raw::Text(text) => line.show(Quoted(text_of(leaf, text))),
        Raw::Number(raw) => match (name_of(leaf), leaf.label()) {
            (Some(name), _) => {
                line.push(name);
                line.push(" (");
                line.integer(raw);
                line.push(")");
            }
            (None, Some(label)) if has_names(leaf) => line.show(format_args!("{label} ({raw})")),
            (None, Some(label)) => {
                line.integer(raw);
                line.push(" (");
                line.show(label);
                line.push(")");
            }
            (None, None) => write_number(leaf, raw, line),
        },
    }
}

/// Appends a number without names exactly, with its unit.
fn write_number(leaf: &Leaf<'_>, raw: i64, line: &mut Line) {
    match leaf.number {
        Some(_) if is_float(leaf) => {
            let bits = u32::try_from(raw).unwrap_or_default();
            let value = f32::from_bits(bits);
            if value.is_nan() {
                // Which of them is in the bits; a unit would say nothing.
                return line.show(format_args!("NaN ({bits:#010x})"));
            }
            if value == 0.0 || value.is_infinite() || (1e-4..1e9).contains(&value.abs()) {
                line.show(value);
            } else {
                line.show(format_args!("{value:e}"));
            }
        }
        Some(number) if number.is_scaled() => write_scaled(number, raw, true, line),
        _ => line.integer(raw),
    }
    let unit = leaf.unit();
    if !unit.is_empty() {
        line.push(" ");
        line.push(unit);
    }
}

/// Appends a scaled number with as many digits as tell it from its neighbours, so that no binary fractions show.
fn write_scaled(number: &Number, raw: i64, trimmed: bool, line: &mut Line) {
    let step = (number.multiply / number.divide).abs();
    let digits = POWERS.iter().position(|power| step * power >= 0.999).unwrap_or(POWERS.len() - 1);
    match in_tenths(number, raw, digits) {
        Some((value, power)) => {
            if value < 0 {
                line.push("-");
            }
            let (whole, mut rest) = (value.unsigned_abs() / power, value.unsigned_abs() % power);
            line.integer(whole);
            let mut width = digits;
            while trimmed && width > 0 && rest % 10 == 0 {
                (rest, width) = (rest / 10, width - 1);
            }
            if width > 0 {
                line.show(format_args!(".{rest:0width$}"));
            }
        }
        None => line.show(format_args!("{:.digits$}", number.value(raw))),
    }
}

/// The value in units of the last of `digits` digits, rounded half to even as formatting does, and how many of those
/// make 1. `None` where whole numbers do not reach.
#[allow(clippy::cast_possible_truncation, clippy::float_cmp, reason = "checked to be whole and small")]
fn in_tenths(number: &Number, raw: i64, digits: usize) -> Option<(i64, u64)> {
    let whole = |factor: f64| (factor.fract() == 0.0 && factor.abs() < 1e12).then_some(factor as i64);
    let (multiply, divide) = (whole(number.multiply)?, whole(number.divide).filter(|divide| *divide > 0)?);
    let power = 10_i64.checked_pow(u32::try_from(digits).ok()?)?;
    let steps = raw.checked_mul(multiply)?.checked_mul(power)?;
    let (quotient, rest) = (steps.div_euclid(divide), steps.rem_euclid(divide));
    let up = rest * 2 > divide || (rest * 2 == divide && quotient % 2 != 0);
    Some((quotient + i64::from(up), power.unsigned_abs()))
}

/// Powers of ten, by their number of zeros.
const POWERS: [f64; 13] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// The value of a field with its unit and names.
pub(crate) fn value_text(leaf: &Leaf<'_>) -> String {
    let mut line = Line::default();
    write_value(leaf, &mut line);
    line.into_text()
}

/// The value of a field by its name alone, where it has one.
pub(crate) fn label_text(leaf: &Leaf<'_>) -> String {
    match leaf.label() {
        Some(label) if has_names(leaf) => label.to_string(),
        _ => value_text(leaf),
    }
}

/// The value of a number with as many digits for each raw number, for columns.
pub(crate) fn number_text(leaf: &Leaf<'_>) -> String {
    let mut line = Line::default();
    match (leaf.raw, leaf.number) {
        _ if is_float(leaf) => line.push(&float_text(leaf.value().unwrap_or_default())),
        (Raw::Number(raw), Some(number)) if number.is_scaled() => write_scaled(number, raw, false, &mut line),
        _ => line.show(leaf.value().unwrap_or_default()),
    }
    line.into_text()
}

fn float_text(value: f64) -> String {
    if value == 0.0 || !value.is_finite() || (1e-4..1e9).contains(&value.abs()) {
        format!("{value:.6}")
    } else {
        format!("{value:.6e}")
    }
}

fn raw_json(leaf: &Leaf<'_>) -> Value {
    match leaf.raw {
        Raw::Bytes(bytes) | Raw::Text(bytes) => hex::encode(bytes).into(),
        Raw::Number(raw) if is_float(leaf) => {
            // JSON has no NaN; its bits are what came.
            leaf.value()
                .and_then(serde_json::Number::from_f64)
                .map_or_else(|| json!(format!("{raw:#010x}")), Value::Number)
        }
        Raw::Number(raw) => raw.into(),
    }
}

fn value_json(leaf: &Leaf<'_>) -> Value {
    match leaf.raw {
        Raw::Bytes(_) => Value::Null,
        Raw::Text(text) => Plain(text_of(leaf, text)).to_string().into(),
        Raw::Number(raw) if leaf.number.is_some_and(|number| !number.is_scaled()) && !is_float(leaf) => {
            raw.into()
        }
        Raw::Number(_) => {
            leaf.value().and_then(serde_json::Number::from_f64).map_or(Value::Null, Value::Number)
        }
    }
}

fn is_float(leaf: &Leaf<'_>) -> bool {
    leaf.number.is_some_and(|number| number.scalar == Scalar::f32)
}

/// The text without the zeros that fill up one of fixed length.
fn text_of<'t>(leaf: &Leaf<'_>, mut text: &'t [u8]) -> &'t [u8] {
    let has_length = leaf.size > text.len();
    while let [rest @ .., 0] = text
        && !has_length
    {
        text = rest;
    }
    text
}

/// The fields of `message` as members of `object`: path to value or name.
pub(crate) fn add_to_object<M: Describe>(object: &mut Map<String, Value>, message: &M) {
    reflect::walk(message, &mut |leaf: &Leaf<'_>| {
        if !leaf.field.reserved {
            add_leaf(object, leaf);
        }
    });
}

/// One field as a member of `object`.
pub(crate) fn add_leaf(object: &mut Map<String, Value>, leaf: &Leaf<'_>) {
    let value = match (leaf.label(), leaf.raw) {
        (Some(label), Raw::Number(_)) if has_names(leaf) => label.to_string().into(),
        (_, Raw::Number(_) | Raw::Text(_)) => value_json(leaf),
        _ => raw_json(leaf),
    };
    object.insert(leaf.path.to_string(), value);
}

/// Paths and values of the fields of `message` that are not zero, and how many are.
pub(crate) fn that_say_something<M: Describe>(message: &M) -> (Vec<(String, String)>, usize) {
    let (mut lines, mut zeros) = (Vec::new(), 0);
    reflect::walk(message, &mut |leaf: &Leaf<'_>| {
        let silent = match leaf.raw {
            Raw::Number(raw) => raw == 0,
            Raw::Bytes(bytes) | Raw::Text(bytes) => bytes.iter().all(|byte| *byte == 0),
        };
        if leaf.field.reserved {
        } else if silent {
            zeros += 1;
        } else {
            lines.push((leaf.path.to_string(), value_text(leaf)));
        }
    });
    (lines, zeros)
}

/// The name of the value, where that is all that it stands for.
fn name_of(leaf: &Leaf<'_>) -> Option<&'static str> {
    match leaf.raw {
        Raw::Number(raw) => leaf.number.and_then(|number| number.name(raw)),
        _ => None,
    }
}

/// Whether a value is shown by its name alone.
fn has_names(leaf: &Leaf<'_>) -> bool {
    leaf.number.is_some_and(|number| {
        matches!(number.meaning, Meaning::Enum(_) | Meaning::Special(_) | Meaning::Shown { .. })
    })
}

#[cfg(test)]
mod tests;
