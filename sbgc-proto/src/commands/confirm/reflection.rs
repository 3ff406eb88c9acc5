//! Fields whose width or list of names is their own.

use super::{ConfirmData, ErrorCode, ErrorData, FailureCode};
use crate::reflect::{Assign, AssignError, Describe, FieldInfo, Input, Place, Raw, Shape, Steps, Visitor};
use crate::wire::U24;

impl Describe for ConfirmData {
    const SHAPE: Shape = u32::SHAPE;

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        match self {
            ConfirmData::None => 0,
            ConfirmData::U8(value) => value.walk(place, visitor),
            ConfirmData::U16(value) => value.walk(place, visitor),
            ConfirmData::U24(value) => value.walk(place, visitor),
            ConfirmData::U32(value) => value.walk(place, visitor),
        }
    }
}

/// Stays as wide as it is where the value fits, and becomes as wide as it must otherwise.
impl<'a> Assign<'a> for ConfirmData {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        let mut number = 0_u32;
        number.assign(path, value, field)?;
        // Hex digits tell the width too.
        if let Input::Text(text) = value {
            *self = match text.trim().strip_prefix("0x").map(str::len) {
                Some(3..=4) => ConfirmData::U16(0),
                Some(5..=6) => ConfirmData::U24(U24::default()),
                Some(7..) => ConfirmData::U32(0),
                _ => *self,
            };
        }
        let (bytes, halves) = (u8::try_from(number), u16::try_from(number));
        *self = match (*self, bytes, halves, U24::try_from(number)) {
            (ConfirmData::None | ConfirmData::U8(_), Ok(byte), _, _) => ConfirmData::U8(byte),
            (ConfirmData::None | ConfirmData::U8(_) | ConfirmData::U16(_), _, Ok(half), _) => {
                ConfirmData::U16(half)
            }
            (ConfirmData::U32(_), ..) | (_, _, _, Err(_)) => ConfirmData::U32(number),
            (_, _, _, Ok(number)) => ConfirmData::U24(number),
        };
        Ok(())
    }
}

impl Describe for FailureCode {
    const SHAPE: Shape = ErrorCode::SHAPE;

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        match self {
            FailureCode::General(code) => code.walk(place, visitor),
            FailureCode::Files(code) => code.walk(place, visitor),
            FailureCode::AutoPid2(code) => code.walk(place, visitor),
        }
    }
}

/// Takes the names of the list that it has now.
impl<'a> Assign<'a> for FailureCode {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        match self {
            FailureCode::General(code) => code.assign(path, value, field),
            FailureCode::Files(code) => code.assign(path, value, field),
            FailureCode::AutoPid2(code) => code.assign(path, value, field),
        }
    }
}

impl Describe for ErrorData {
    const SHAPE: Shape = Shape::Bytes { least: 0, most: 4 };

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        let bytes = self.as_bytes();
        place.leaf(bytes.len(), None, Raw::Bytes(bytes), visitor)
    }
}

impl<'a> Assign<'a> for ErrorData {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        _: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        path.end()?;
        let (bytes, _) = value.bytes()?;
        let data = Self::new(bytes);
        if data.as_bytes() != bytes {
            return Err(AssignError::Length { expected: 4, got: bytes.len() });
        }
        *self = data;
        Ok(())
    }
}
