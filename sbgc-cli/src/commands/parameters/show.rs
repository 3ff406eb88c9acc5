//! Parameters, their values and differences as text and as JSON.

use sbgc_host::params::{Difference, Parameter, Value};
use serde_json::{Number, Value as Json, json};

use crate::text;

/// A value as JSON: a number in its unit, text, or bytes as hex.
pub(super) fn value(value: &Value) -> Json {
    match value {
        Value::Integer(number) => (*number).into(),
        Value::Number(number) => self::number(*number),
        Value::Text(text) => text.as_str().into(),
        Value::Bytes(bytes) => hex::encode(bytes).into(),
    }
}

/// A number as JSON, without a point where it has no fraction.
pub(super) fn number(number: f64) -> Json {
    #[allow(clippy::cast_possible_truncation, reason = "checked just before")]
    if number.fract() == 0.0 && number.abs() < 1e15 {
        return (number as i64).into();
    }
    Number::from_f64(number).map_or(Json::Null, Json::Number)
}

/// A unit as JSON.
pub(super) fn unit(unit: &str) -> Json {
    if unit.is_empty() { Json::Null } else { unit.into() }
}

/// A parameter with its value, or without where no board was asked.
pub(super) fn parameter(parameter: &Parameter, bytes: Option<&[u8]>) -> Json {
    let range = parameter.range();
    let raw = bytes.map(|bytes| match parameter.raw(bytes) {
        Some(raw) => raw.into(),
        None if parameter.is_text => value(&parameter.value(bytes)),
        None => hex::encode(bytes).into(),
    });
    json!({
        "path": parameter.path,
        "block": parameter.block.spec(),
        "spec": parameter.field.spec,
        "value": bytes.map_or(Json::Null, |bytes| value(&parameter.value(bytes))),
        "unit": unit(parameter.unit()),
        "raw": raw,
        "label": bytes.and_then(|bytes| parameter.label(bytes)),
        "min": range.map_or(Json::Null, |(least, _)| number(least)),
        "max": range.map_or(Json::Null, |(_, most)| number(most)),
    })
}

/// A difference as a line: `rc_memory.pitch: 0 deg -> 45 deg`.
pub(super) fn difference(difference: &Difference) -> String {
    let (a, b) = (difference.show(&difference.a), difference.show(&difference.b));
    let profile = difference.profile.map_or_else(String::new, |profile| format!("{profile}: "));
    text::escape(&format!("{profile}{}: {a} -> {b}", difference.path)).into_owned()
}

/// A difference as JSON.
pub(super) fn difference_json(difference: &Difference) -> Json {
    json!({
        "profile": difference.profile.map(sbgc_host::params::Profile::number),
        "path": difference.path,
        "a": value(&difference.value(&difference.a)),
        "b": value(&difference.value(&difference.b)),
        "unit": unit(difference.unit()),
    })
}
