//! Fields whose width or list of names is their own.

use super::{AutoPid2Error, ConfirmData, ErrorCode, ErrorData, FailureCode, FsErrorCode};
use crate::reflect::{
    Assign, AssignError, Describe, FieldInfo, Input, Place, Raw, Shape, Steps, Visitor, hex_bytes,
};
use crate::wire::{Layout as _, U24};

/// The width is a part of the path: `data.u16`. No bytes are no field.
const WIDTHS: &[FieldInfo] = &[
    FieldInfo::new("u8", "U8", u8::SHAPE),
    FieldInfo::new("u16", "U16", u16::SHAPE),
    FieldInfo::new("u24", "U24", U24::SHAPE),
    FieldInfo::new("u32", "U32", u32::SHAPE),
];

impl Describe for ConfirmData {
    const SHAPE: Shape = u32::SHAPE;

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        match self {
            ConfirmData::None => 0,
            ConfirmData::U8(value) => place.part("u8", 0).walk(value, visitor),
            ConfirmData::U16(value) => place.part("u16", 0).walk(value, visitor),
            ConfirmData::U24(value) => place.part("u24", 0).walk(value, visitor),
            ConfirmData::U32(value) => place.part("u32", 0).walk(value, visitor),
        }
    }
}

/// Without a width in the path it stays as wide as it is; what has no bytes yet becomes as wide as it must.
impl<'a> Assign<'a> for ConfirmData {
    fn assign(
        &mut self,
        mut path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        let mut data = match *self {
            _ if !path.is_at_end() => match path.next_name(WIDTHS)? {
                "u8" => ConfirmData::U8(0),
                "u16" => ConfirmData::U16(0),
                "u24" => ConfirmData::U24(U24::default()),
                _ => ConfirmData::U32(0),
            },
            ConfirmData::None => {
                let mut number = 0_u32;
                number.assign(path, value, field)?;
                match number {
                    ..=0xFF => ConfirmData::U8(0),
                    0x100..=0xFFFF => ConfirmData::U16(0),
                    0x1_0000..=0xFF_FFFF => ConfirmData::U24(U24::default()),
                    _ => ConfirmData::U32(0),
                }
            }
            data => data,
        };
        match &mut data {
            ConfirmData::None => {}
            ConfirmData::U8(number) => number.assign(path, value, field)?,
            ConfirmData::U16(number) => number.assign(path, value, field)?,
            ConfirmData::U24(number) => number.assign(path, value, field)?,
            ConfirmData::U32(number) => number.assign(path, value, field)?,
        }
        *self = data;
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

/// Takes the names of the list that it has now, and what is in another list alone.
impl<'a> Assign<'a> for FailureCode {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        let mut lists = [
            *self,
            FailureCode::General(ErrorCode::default()),
            FailureCode::Files(FsErrorCode::default()),
            FailureCode::AutoPid2(AutoPid2Error::from(0)),
        ];
        let mut first_error = None;
        for list in &mut lists {
            let assigned = match list {
                FailureCode::General(code) => code.assign(path, value, field),
                FailureCode::Files(code) => code.assign(path, value, field),
                FailureCode::AutoPid2(code) => code.assign(path, value, field),
            };
            match assigned {
                Ok(()) => {
                    *self = *list;
                    return Ok(());
                }
                Err(error) => first_error = first_error.or(Some(error)),
            }
        }
        first_error.map_or(Ok(()), Err)
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
        let mut buffer = [0; Self::MAX_LEN];
        let bytes = match value {
            Input::Text(text) => hex_bytes(text, &mut buffer)?,
            Input::Bytes(bytes) => bytes,
            Input::Raw(_) | Input::Value(_) => return Err(AssignError::NotBytes),
        };
        if bytes.len() > Self::MAX_LEN {
            return Err(AssignError::Length { expected: Self::MAX_LEN, got: bytes.len() });
        }
        *self = Self::new(bytes);
        Ok(())
    }
}
