//! Fields that may be absent, and fields that say their name when they cannot be read.

use super::{Fault, FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

/// Reads a field that is always there.
#[inline]
pub(crate) fn read_field<'a, T: FromWire<'a, C>, C>(
    field: &'static str,
    input: &'a [u8],
    context: C,
) -> Read<'a, T> {
    T::read(input, context).map_err(|fault| fault.named(field))
}

/// Reads a value of fixed length and returns what follows it.
#[inline]
pub(crate) fn read_whole<'a, T: FromWire<'a, C>, C>(input: &'a [u8], context: C) -> Read<'a, T> {
    match (T::read_fixed(input, context), input.get(T::MIN_LEN..)) {
        (Some(value), Some(rest)) => Ok((rest, value)),
        _ => Fault::short(T::MIN_LEN, input),
    }
}

/// Writes a value of fixed length.
#[inline]
pub(crate) fn write_whole<T: Layout + ToWire<C>, C>(
    value: &T,
    context: C,
    out: &mut Writer<'_>,
) -> Result<(), EncodeError> {
    out.put_with(T::MIN_LEN, |place| value.write_fixed(context, place))
}

/// Reads a field that is there when `present`.
#[inline]
pub(crate) fn read_when<'a, T: FromWire<'a, C>, C>(
    present: bool,
    field: &'static str,
    input: &'a [u8],
    context: C,
) -> Read<'a, Option<T>> {
    if !present {
        return Ok((input, None));
    }
    read_field(field, input, context).map(|(rest, value)| (rest, Some(value)))
}

/// Reads a field that is there unless the payload ends before it.
#[inline]
pub(crate) fn read_tail<'a, T: FromWire<'a, C>, C>(
    field: &'static str,
    input: &'a [u8],
    context: C,
) -> Read<'a, Option<T>> {
    read_when(!input.is_empty(), field, input, context)
}

/// Writes a field that must be there exactly when `expected`.
pub(crate) fn write_when<T: ToWire<C>, C>(
    expected: bool,
    field: &'static str,
    value: Option<&T>,
    context: C,
    out: &mut Writer<'_>,
) -> Result<(), EncodeError> {
    match value {
        Some(value) if expected => value.write(context, out),
        None if !expected => Ok(()),
        _ => Err(EncodeError::Presence { field, expected }),
    }
}

/// Writes a field of an optional tail; `ended` names the first field of it that was absent.
pub(crate) fn write_tail<T: ToWire<C>, C>(
    ended: &mut Option<&'static str>,
    field: &'static str,
    value: Option<&T>,
    context: C,
    out: &mut Writer<'_>,
) -> Result<(), EncodeError> {
    match (value, *ended) {
        (Some(value), None) => value.write(context, out),
        (Some(_), Some(absent)) => Err(EncodeError::Gap { field, absent }),
        (None, _) => {
            ended.get_or_insert(field);
            Ok(())
        }
    }
}
