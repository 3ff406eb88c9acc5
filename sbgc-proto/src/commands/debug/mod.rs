//! Debug variables of the firmware.
//!
//! The values come without a description, which must be requested first: [`DebugVarsInfo3`] contains names and types,
//! [`DebugVars3`] the values in the same order.

#[cfg(test)]
mod tests;

use sbgc_proto_macros::{bit_fields, message, open_enum, record};

use crate::wire::{Element, Float, FromWire, List, Packed, Reserved, Text};
use crate::{DecodeError, Message, OutOfRange};

/// Requests names and types of the debug variables.
#[message(
    CMD_DEBUG_VARS_INFO_3, outgoing, form = "simple", size = 0, length = 0, answer = DebugVarsInfo3<'answer>
)]
#[derive(Copy)]
pub struct DebugVarsInfo3Request;

/// Requests names and types of the debug variables, starting at an index.
///
/// One answer may not contain all: continue with the first variable not yet described until an answer contains none.
#[message(
    CMD_DEBUG_VARS_INFO_3, outgoing, form = "extended", default, size = 1, since = "2.72b0", answer = DebugVarsInfo3<'answer>
)]
#[derive(Copy)]
pub struct DebugVarsInfo3ExtendedRequest {
    /// First variable to describe, counted from 0.
    pub start_idx: u8,
}

/// Names and types of the debug variables.
#[message(CMD_DEBUG_VARS_INFO_3, incoming, size = 1..=255)]
pub struct DebugVarsInfo3<'a> {
    /// Number of variables.
    ///
    /// According to the specification, the number in this message. Newer firmware may report more than the message
    /// contains, so the list ends with the payload.
    pub debug_vars_num: u8,
    /// Variables, in the order of their values.
    #[wire(group, at_most = usize::from(*debug_vars_num))]
    pub vars: Packed<DebugVarInfo<'a>, 254>,
}

/// Name and type of a debug variable.
#[record]
#[derive(Copy)]
pub struct DebugVarInfo<'a> {
    /// Name of the variable.
    pub var_name: Text<'a>,
    /// Wire type and meaning of the value.
    pub var_type: DebugVarKind,
    pub reserved: Reserved<2>,
}

impl Element for DebugVarInfo<'_> {
    type At<'x> = DebugVarInfo<'x>;
}

/// Wire type and meaning of a debug variable.
#[bit_fields(u8)]
pub struct DebugVarKind {
    /// Type of the value.
    #[wire(bits = 0..=3)]
    pub var_type: DebugVarType,
    /// Axis that the variable belongs to.
    #[wire(bits = 4..=5, spec = "VAR_FLAG_AXIS")]
    pub axis: DebugVarAxis,
    /// The value is an angle in units of 1/16384 turn.
    #[wire(bits = 6, spec = "VAR_FLAG_ANGLE14")]
    pub is_angle: bool,
}

impl DebugVarKind {
    /// Converts a value to a number, in degrees for angles.
    pub fn physical(self, value: DebugVarValue) -> f64 {
        if self.is_angle() { value.to_f64() * 360.0 / 16_384.0 } else { value.to_f64() }
    }
}

/// Type of a debug variable. Spec: `DEBUG_VAR_TYPE`.
#[open_enum(u8)]
pub enum DebugVarType {
    /// Unsigned, 1 byte.
    #[wire(spec = "VAR_TYPE_UINT8")]
    U8 = 1,
    /// Signed, 1 byte.
    #[wire(spec = "VAR_TYPE_INT8")]
    I8 = 2,
    /// Unsigned, 2 bytes.
    #[wire(spec = "VAR_TYPE_UINT16")]
    U16 = 3,
    /// Signed, 2 bytes.
    #[wire(spec = "VAR_TYPE_INT16")]
    I16 = 4,
    /// Unsigned, 4 bytes.
    #[wire(spec = "VAR_TYPE_UINT32")]
    U32 = 5,
    /// Signed, 4 bytes.
    #[wire(spec = "VAR_TYPE_INT32")]
    I32 = 6,
    /// Float, 4 bytes.
    #[wire(spec = "VAR_TYPE_FLOAT")]
    F32 = 7,
}

/// Axis of a debug variable: the values of `DEBUG_VAR_FLAG`, shifted right by four bits.
#[open_enum(u8, prefix = "VAR_FLAG_")]
pub enum DebugVarAxis {
    /// No axis.
    #[wire(spec = "NONE")]
    None = 0,
    /// ROLL.
    Roll = 1,
    /// PITCH.
    Pitch = 2,
    /// YAW.
    Yaw = 3,
}

/// Requests the values of all debug variables.
#[message(CMD_DEBUG_VARS_3, outgoing, form = "simple", default, size = 0, length = 0, answer = DebugVars3<'answer>)]
#[derive(Copy)]
pub struct DebugVars3Request;

/// Requests the values of selected debug variables.
///
/// The answer repeats the masks before the values.
#[message(
    CMD_DEBUG_VARS_3, outgoing, form = "extended", size = 4..=32, length = 4.., since = "2.72b0",
    answer = DebugVars3Masked<'answer>,
    given = self.selected_mask.len(), echo = selected_mask
)]
pub struct DebugVars3ExtendedRequest {
    /// Selection masks: bit i of mask k selects variable 32 k + i. Send as many masks as the last selected variable
    /// requires.
    pub selected_mask: List<u32, 8>,
}

impl DebugVars3ExtendedRequest {
    /// Creates a request for the variables with these numbers, counted from 0.
    ///
    /// # Errors
    /// If one of them is greater than 255.
    pub fn new(variables: impl IntoIterator<Item = usize>) -> Result<Self, OutOfRange> {
        let mut request = Self::default();
        for variable in variables {
            while request.selected_mask.len() <= variable / 32 {
                request.selected_mask.push(0).map_err(|_| OutOfRange::plain(0.0, 255.0))?;
            }
            if let Some(mask) = request.selected_mask.get_mut(variable / 32) {
                *mask |= 1 << (variable % 32);
            }
        }
        Ok(request)
    }

    /// Numbers of the selected variables, in the order of their values in the answer.
    pub fn variables(&self) -> impl Iterator<Item = usize> {
        chosen(&self.selected_mask)
    }
}

/// Values of all debug variables, one after the other.
#[message(CMD_DEBUG_VARS_3, incoming, size = 0..=255)]
#[derive(Copy)]
pub struct DebugVars3<'a> {
    /// Values, preceded by the masks in the answer to a request with masks.
    pub var_value: &'a [u8],
}

impl<'a> DebugVars3<'a> {
    /// Decodes the values with the kinds of the variables, which must be in the same order. The iterator ends with the
    /// payload, with the kinds, or after an error.
    ///
    /// ```
    /// use sbgc_proto::commands::{DebugVarKind, DebugVarValue, DebugVars3};
    ///
    /// let message = DebugVars3 { var_value: &[200, 0x00, 0xF0] };
    /// let mut values = message.values([DebugVarKind(1), DebugVarKind(100)]);
    /// assert_eq!(values.next(), Some(Ok(DebugVarValue::U8(200))));
    /// assert_eq!(values.next(), Some(Ok(DebugVarValue::I16(-4096))));
    /// assert_eq!(values.next(), None);
    /// ```
    pub fn values<K: IntoIterator<Item = DebugVarKind>>(&self, kinds: K) -> DebugVarValues<'a, K::IntoIter> {
        DebugVarValues { payload: self.var_value, rest: self.var_value, kinds: kinds.into_iter() }
    }

    /// Interprets the payload as the answer to a request with this number of masks.
    ///
    /// # Errors
    /// If the payload is shorter than the masks.
    pub fn masked(&self, masks: usize) -> Result<DebugVars3Masked<'a>, DecodeError> {
        DebugVars3Masked::decode_with(self.var_value, masks).map(|(message, _)| message)
    }
}

#[cfg(feature = "reflect")]
impl DebugVars3<'_> {
    /// Visits the values as numbers of these kinds, each as `var_value[index]`.
    ///
    /// # Errors
    /// If a kind is unknown, or the payload ends within a value. The values before it were visited.
    pub fn walk_values(
        &self,
        kinds: impl IntoIterator<Item = DebugVarKind>,
        visitor: &mut dyn crate::reflect::Visitor,
    ) -> Result<(), DecodeError> {
        use crate::reflect::{Describe, Place, Shape};

        let Shape::Struct(fields) = Self::SHAPE else { return Ok(()) };
        walk_values(self.values(kinds), 0.., &Place::ROOT.field(fields, 0, 0), visitor)
    }
}

#[cfg(feature = "reflect")]
impl DebugVars3Masked<'_> {
    /// Visits the masks, then the values as numbers of these kinds, each as `var_value[index]` with the number of its
    /// variable.
    ///
    /// # Errors
    /// If a kind is unknown, or the payload ends within a value. The values before it were visited.
    pub fn walk_values(
        &self,
        kinds: impl IntoIterator<Item = DebugVarKind>,
        visitor: &mut dyn crate::reflect::Visitor,
    ) -> Result<(), DecodeError> {
        use crate::reflect::{Describe, Place, Shape};

        let Shape::Struct(fields) = Self::SHAPE else { return Ok(()) };
        let size = Place::ROOT.field(fields, 0, 0).walk(&self.selected_mask, visitor);
        let variables = chosen(&self.selected_mask);
        walk_values(self.values(kinds), variables, &Place::ROOT.field(fields, 1, size), visitor)
    }
}

/// Visits values of the variables with these numbers as elements of `list`.
#[cfg(feature = "reflect")]
fn walk_values<K: Iterator<Item = DebugVarKind>>(
    values: DebugVarValues<'_, K>,
    variables: impl Iterator<Item = usize>,
    list: &crate::reflect::Place<'_>,
    visitor: &mut dyn crate::reflect::Visitor,
) -> Result<(), DecodeError> {
    use crate::reflect::Describe;

    let mut offset = 0;
    for (variable, value) in variables.zip(values) {
        let place = list.element(variable, offset);
        offset += match value? {
            DebugVarValue::U8(value) => value.walk(&place, visitor),
            DebugVarValue::I8(value) => value.walk(&place, visitor),
            DebugVarValue::U16(value) => value.walk(&place, visitor),
            DebugVarValue::I16(value) => value.walk(&place, visitor),
            DebugVarValue::U32(value) => value.walk(&place, visitor),
            DebugVarValue::I32(value) => value.walk(&place, visitor),
            DebugVarValue::F32(value) => value.walk(&place, visitor),
        };
    }
    Ok(())
}

/// The numbers of the variables that `masks` choose.
fn chosen(masks: &[u32]) -> impl Iterator<Item = usize> {
    let masks = masks.iter().zip((0..).step_by(32));
    masks
        .flat_map(|(mask, first)| (0..32).filter(move |bit| mask >> bit & 1 != 0).map(move |bit| first + bit))
}

/// Values of selected debug variables.
///
/// The masks come first, according to newer documents; the vendor's C library skips them in a way that cannot be
/// correct.
#[message(
    CMD_DEBUG_VARS_3, incoming, form = "masked", size = 4..=255, since = "2.72b0", context(masks: usize)
)]
pub struct DebugVars3Masked<'a> {
    /// Masks, as in the request.
    #[wire(count = *masks)]
    pub selected_mask: List<u32, 8>,
    /// Values of the selected variables.
    pub var_value: &'a [u8],
}

impl<'a> DebugVars3Masked<'a> {
    /// Decodes the values with the kinds of the selected variables.
    pub fn values<K: IntoIterator<Item = DebugVarKind>>(&self, kinds: K) -> DebugVarValues<'a, K::IntoIter> {
        DebugVars3 { var_value: self.var_value }.values(kinds)
    }
}

/// Value of a debug variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[allow(missing_docs, reason = "the variants are the types")]
pub enum DebugVarValue {
    U8(u8),
    I8(i8),
    U16(u16),
    I16(i16),
    U32(u32),
    I32(i32),
    F32(Float),
}

impl DebugVarValue {
    /// Value as a 64-bit float, which represents all of them exactly.
    pub fn to_f64(self) -> f64 {
        match self {
            DebugVarValue::U8(value) => value.into(),
            DebugVarValue::I8(value) => value.into(),
            DebugVarValue::U16(value) => value.into(),
            DebugVarValue::I16(value) => value.into(),
            DebugVarValue::U32(value) => value.into(),
            DebugVarValue::I32(value) => value.into(),
            DebugVarValue::F32(value) => value.get().into(),
        }
    }
}

/// Iterator over the values of a message. Created by [`DebugVars3::values`].
#[derive(Clone, Debug)]
pub struct DebugVarValues<'a, K> {
    payload: &'a [u8],
    rest: &'a [u8],
    kinds: K,
}

impl<'a, K> DebugVarValues<'a, K> {
    /// Remaining payload bytes.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    fn take<T: FromWire<'a>>(&mut self, make: fn(T) -> DebugVarValue) -> Result<DebugVarValue, DecodeError> {
        match T::read(self.rest, ()) {
            Ok((rest, value)) => {
                self.rest = rest;
                Ok(make(value))
            }
            Err(_) => Err(DecodeError::Truncated {
                command: DebugVars3::SPEC,
                field: "VAR_VALUE",
                offset: self.payload.len() - self.rest.len(),
                needed: T::MIN_LEN,
                got: core::mem::take(&mut self.rest).len(),
            }),
        }
    }
}

impl<K: Iterator<Item = DebugVarKind>> Iterator for DebugVarValues<'_, K> {
    type Item = Result<DebugVarValue, DecodeError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        Some(match self.kinds.next()?.var_type() {
            DebugVarType::U8 => self.take(DebugVarValue::U8),
            DebugVarType::I8 => self.take(DebugVarValue::I8),
            DebugVarType::U16 => self.take(DebugVarValue::U16),
            DebugVarType::I16 => self.take(DebugVarValue::I16),
            DebugVarType::U32 => self.take(DebugVarValue::U32),
            DebugVarType::I32 => self.take(DebugVarValue::I32),
            DebugVarType::F32 => self.take(DebugVarValue::F32),
            DebugVarType::Unknown(raw) => {
                self.rest = &[];
                Err(DecodeError::UnknownType { command: DebugVars3::SPEC, field: "VAR_TYPE", raw })
            }
        })
    }
}
