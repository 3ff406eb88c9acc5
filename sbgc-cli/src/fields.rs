//! Fields of messages as text and as JSON, from what they say of themselves.

use sbgc_proto::reflect::{self, Describe, Leaf, Meaning, Plain, Quoted, Raw, Scalar};
use serde_json::{Map, Number, Value, json};

/// One field as JSON.
pub(crate) fn to_json(leaf: &Leaf<'_>) -> Value {
    json!({
        "path": leaf.path.to_string(),
        "spec": leaf.field.spec,
        "offset": leaf.offset,
        "size": leaf.size,
        "type": leaf.type_name(),
        "raw": raw_json(leaf),
        "value": value_json(leaf),
        "unit": Some(leaf.unit()).filter(|unit| !unit.is_empty()),
        "label": leaf.label().map(|label| label.to_string()),
    })
}

/// One field as a line of text: path, value, unit, names.
pub(crate) fn to_text(leaf: &Leaf<'_>) -> String {
    format!("{} = {}", leaf.path, value_text(leaf))
}

/// The value of a field with its unit and names.
pub(crate) fn value_text(leaf: &Leaf<'_>) -> String {
    let label = leaf.label().map(|label| label.to_string());
    match (leaf.raw, label) {
        (Raw::Bytes([]), _) => String::from("-"),
        (Raw::Bytes(bytes), _) => hex::encode(bytes),
        (Raw::Text(text), _) => Quoted(text_of(leaf, text)).to_string(),
        (Raw::Number(raw), Some(label)) if has_names(leaf) => format!("{label} ({raw})"),
        (Raw::Number(raw), Some(label)) => format!("{raw} ({label})"),
        (Raw::Number(raw), None) => {
            let unit = leaf.unit();
            let number = if is_float(leaf) { exact_float(raw) } else { trim_zeros(number_text(leaf)) };
            // The unit of what is not a number says nothing.
            if unit.is_empty() || number.ends_with(')') { number } else { format!("{number} {unit}") }
        }
    }
}

/// The value of a field by its name alone, where it has one.
pub(crate) fn label_text(leaf: &Leaf<'_>) -> String {
    match leaf.label() {
        Some(label) if has_names(leaf) => label.to_string(),
        _ => value_text(leaf),
    }
}

/// The value of a number with as many digits as tell it from its neighbours, so that no binary fractions show.
pub(crate) fn number_text(leaf: &Leaf<'_>) -> String {
    let value = leaf.value().unwrap_or_default();
    match leaf.number {
        _ if is_float(leaf) => float_text(value),
        Some(number) if number.is_scaled() => {
            let step = (number.multiply / number.divide).abs();
            let digits = (0..12).find(|&digits| step * 10_f64.powi(digits) >= 0.999).unwrap_or(12);
            format!("{value:.*}", usize::try_from(digits).unwrap_or_default())
        }
        _ => format!("{value}"),
    }
}

fn float_text(value: f64) -> String {
    if value == 0.0 || !value.is_finite() || (1e-4..1e9).contains(&value.abs()) {
        format!("{value:.6}")
    } else {
        format!("{value:.6e}")
    }
}

/// A float in the fewest digits that say it exactly.
fn exact_float(raw: i64) -> String {
    let bits = u32::try_from(raw).unwrap_or_default();
    let value = f32::from_bits(bits);
    if value.is_nan() {
        // Which of them is in the bits.
        format!("NaN ({bits:#010x})")
    } else if value == 0.0 || value.is_infinite() || (1e-4..1e9).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

fn trim_zeros(number: String) -> String {
    match number.trim_end_matches('0').trim_end_matches('.') {
        _ if !number.contains('.') || number.contains('e') => number,
        "-0" => String::from("0"),
        trimmed => trimmed.to_owned(),
    }
}

fn raw_json(leaf: &Leaf<'_>) -> Value {
    match leaf.raw {
        Raw::Bytes(bytes) | Raw::Text(bytes) => hex::encode(bytes).into(),
        Raw::Number(raw) if is_float(leaf) => {
            // JSON has no NaN; its bits are what came.
            leaf.value()
                .and_then(Number::from_f64)
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
        Raw::Number(_) => leaf.value().and_then(Number::from_f64).map_or(Value::Null, Value::Number),
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

/// Whether a value is shown by its name alone.
fn has_names(leaf: &Leaf<'_>) -> bool {
    leaf.number.is_some_and(|number| {
        matches!(number.meaning, Meaning::Enum(_) | Meaning::Special(_) | Meaning::Shown { .. })
    })
}
