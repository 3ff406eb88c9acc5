//! Reflection of the types that know nothing of gimbals: integers, floats, groups, lists, blocks, texts.

use super::{
    Assign, AssignError, Describe, FieldInfo, Input, Number, NumberType, Place, Raw, Scalar, Shape, Steps,
    Visitor, hex_bytes, text_bytes, walk_elements,
};
use crate::EncodeError;
use crate::wire::{Bytes, Element, FixedText, Float, List, Packed, PerAxis, PerXyz, Reserved, Text, U24};

/// Makes a [`NumberType`] a leaf of messages.
macro_rules! reflect_number {
    ($name:ty) => {
        const _: () = {
            use $crate::reflect::{
                Assign, AssignError, Describe, FieldInfo, Input, NumberType, Place, Raw, Shape, Steps,
                Visitor,
            };

            impl Describe for $name {
                const SHAPE: Shape = Shape::Number(<$name as NumberType>::NUMBER);

                fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
                    let number = &<$name as NumberType>::NUMBER;
                    place.leaf(number.scalar.size(), Some(number), Raw::Number(self.raw_number()), visitor)
                }
            }

            impl<'a> Assign<'a> for $name {
                fn assign(
                    &mut self,
                    path: Steps<'_>,
                    value: Input<'a>,
                    field: &'static FieldInfo,
                ) -> Result<(), AssignError> {
                    let number = &<$name as NumberType>::NUMBER;
                    let raw = path.number(number, value, field)?;
                    *self = <$name as NumberType>::from_raw_number(raw)
                        .ok_or_else(|| number.out_of_range(None, field))?;
                    Ok(())
                }
            }
        };
    };
}
pub(crate) use reflect_number;

macro_rules! integers {
    ($($integer:ident)*) => { $(
        impl NumberType for $integer {
            const NUMBER: Number = Number::plain(Scalar::$integer);

            fn raw_number(&self) -> i64 {
                i64::from(*self)
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                raw.try_into().ok()
            }
        }

        reflect_number!($integer);
    )* };
}

integers!(u8 i8 u16 i16 u32 i32);

impl NumberType for U24 {
    const NUMBER: Number = Number::plain(Scalar::u24);

    fn raw_number(&self) -> i64 {
        i64::from(self.get())
    }

    fn from_raw_number(raw: i64) -> Option<Self> {
        u32::try_from(raw).ok()?.try_into().ok()
    }
}

reflect_number!(U24);

impl NumberType for Float {
    const NUMBER: Number = Number::plain(Scalar::f32);

    fn raw_number(&self) -> i64 {
        i64::from(self.bits())
    }

    fn from_raw_number(raw: i64) -> Option<Self> {
        raw.try_into().ok().map(Self::from_bits)
    }
}

reflect_number!(Float);

macro_rules! groups {
    ($($group:ident { $($part:ident),* })*) => { $(
        impl<T: Describe> Describe for $group<T> {
            const SHAPE: Shape = Shape::Group {
                names: &[$(stringify!($part)),*],
                element: &T::SHAPE,
            };

            fn walk(
                &self,
                place: &Place<'_>,
                visitor: &mut dyn Visitor,
            ) -> usize {
                let mut size = 0;
                $(size += place.part(stringify!($part), size).walk(&self.$part, visitor);)*
                size
            }
        }

        impl<'a, T: Assign<'a>> Assign<'a> for $group<T> {
            fn assign(
                &mut self,
                mut path: Steps<'_>,
                value: Input<'a>,
                field: &'static FieldInfo,
            ) -> Result<(), AssignError> {
                let mut parts = [$((stringify!($part), &mut self.$part)),*];
                let index = path.next_of(&[$(stringify!($part)),*])?;
                match parts.get_mut(index) {
                    Some((_, part)) => part.assign(path, value, field),
                    None => Err(AssignError::NoParts),
                }
            }
        }
    )* };
}

groups! {
    PerAxis { roll, pitch, yaw }
    PerXyz { x, y, z }
}

impl<T: Describe, const N: usize> Describe for [T; N] {
    const SHAPE: Shape = Shape::Array { count: N, element: &T::SHAPE };

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        walk_elements(self, place, visitor)
    }
}

impl<'a, T: Assign<'a>, const N: usize> Assign<'a> for [T; N] {
    fn assign(
        &mut self,
        mut path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        match self.get_mut(path.next_index(N)?) {
            Some(element) => element.assign(path, value, field),
            None => Err(AssignError::TooMany { most: N }),
        }
    }
}

impl<T: Default, const N: usize> List<T, N> {
    /// Sets the count byte: elements are added or dropped at the end.
    pub(crate) fn assign_count(&mut self, path: Steps<'_>, value: Input<'_>) -> Result<(), AssignError> {
        let mut count = 0_u8;
        Assign::assign(&mut count, path, value, &FieldInfo::UNNAMED)?;
        if usize::from(count) > N {
            return Err(AssignError::TooMany { most: N });
        }
        self.resize(usize::from(count));
        Ok(())
    }
}

impl<T: Describe, const N: usize> Describe for List<T, N> {
    const SHAPE: Shape = Shape::List { most: N, element: &T::SHAPE };

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        walk_elements(self, place, visitor)
    }
}

impl<'a, T: Assign<'a> + Default, const N: usize> Assign<'a> for List<T, N> {
    fn assign(
        &mut self,
        mut path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        // One more than there are: setting the first that is missing appends it.
        let index = path.next_index(N.min(self.len().saturating_add(1)))?;
        if let Some(element) = self.get_mut(index) {
            return element.assign(path, value, field);
        }
        let mut element = T::default();
        element.assign(path, value, field)?;
        self.push(element).map_err(|_| AssignError::TooMany { most: N })
    }
}

impl<T: Element, const N: usize> Packed<T, N> {
    /// The most elements that there can be.
    const MOST: usize = match N.checked_div(T::MIN_LEN) {
        Some(most) => most,
        None => N,
    };
}

impl<T: Element, const N: usize> Describe for Packed<T, N>
where
    for<'x> T::At<'x>: Describe,
{
    const SHAPE: Shape = Shape::List { most: Self::MOST, element: &<T::At<'static> as Describe>::SHAPE };

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        let mut size = 0;
        for (index, element) in self.iter().enumerate() {
            size += place.element(index, size).walk(&element, visitor);
        }
        size
    }
}

impl<'a, T: Element, const N: usize> Assign<'a> for Packed<T, N>
where
    for<'x> T::At<'x>: Assign<'x> + Default,
{
    fn assign(
        &mut self,
        mut path: Steps<'_>,
        value: Input<'a>,
        field: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        // One more than there are: setting the first that is missing appends it.
        let index = path.next_index(Self::MOST.min(self.len().saturating_add(1)))?;
        let full = |error| match error {
            EncodeError::BufferTooSmall { needed, .. } => AssignError::Length { expected: N, got: needed },
            _ => AssignError::TooMany { most: Self::MOST },
        };
        let mut changed = Self::new();
        {
            let mut elements = self.iter();
            for element in elements.by_ref().take(index) {
                changed.push(&element).map_err(full)?;
            }
            let mut element = elements.next().unwrap_or_default();
            element.assign(path, value, field)?;
            changed.push(&element).map_err(full)?;
            for element in elements {
                changed.push(&element).map_err(full)?;
            }
        }
        *self = changed;
        Ok(())
    }
}

macro_rules! blocks {
    ($($block:ident: $shape:expr, $raw:path, $read:ident, $shorter:literal;)*) => { $(
        impl<const N: usize> Describe for $block<N> {
            const SHAPE: Shape = $shape;

            fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
                place.leaf(N, None, $raw(&self.0), visitor)
            }
        }

        impl<'a, const N: usize> Assign<'a> for $block<N> {
            fn assign(
                &mut self,
                path: Steps<'_>,
                value: Input<'a>,
                _: &'static FieldInfo,
            ) -> Result<(), AssignError> {
                path.end()?;
                let mut block = [0; N];
                let got = match value {
                    Input::Text(text) => $read(text, &mut block)?.len(),
                    Input::Bytes(bytes) => {
                        if let Some(place) = block.get_mut(..bytes.len()) {
                            place.copy_from_slice(bytes);
                        }
                        bytes.len()
                    }
                    Input::Raw(_) | Input::Value(_) => return Err(AssignError::NotBytes),
                };
                // A text is filled up with zeros.
                if got > N || (got < N && !$shorter) {
                    return Err(AssignError::Length { expected: N, got });
                }
                self.0 = block;
                Ok(())
            }
        }
    )* };
}

blocks! {
    Bytes: Shape::Bytes { least: N, most: N }, Raw::Bytes, hex_bytes, false;
    Reserved: Shape::Bytes { least: N, most: N }, Raw::Bytes, hex_bytes, false;
    FixedText: Shape::Text { most: N }, Raw::Text, text_bytes, true;
}

impl Describe for Text<'_> {
    const SHAPE: Shape = Shape::Text { most: 255 };

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        place.leaf(self.0.len() + 1, None, Raw::Text(self.0), visitor)
    }
}

impl Describe for &[u8] {
    const SHAPE: Shape = Shape::Bytes { least: 0, most: 255 };

    fn walk(&self, place: &Place<'_>, visitor: &mut dyn Visitor) -> usize {
        place.leaf(self.len(), None, Raw::Bytes(self), visitor)
    }
}

impl<'a> Assign<'a> for Text<'a> {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        _: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        path.end()?;
        let bytes = match value {
            Input::Bytes(bytes) => bytes,
            Input::Text(text) => match text.strip_prefix('"').and_then(|text| text.strip_suffix('"')) {
                None => text.as_bytes(),
                Some(quoted) if !quoted.contains(['\\', '"']) => quoted.as_bytes(),
                Some(_) => return Err(AssignError::Borrowed { text: true }),
            },
            Input::Raw(_) | Input::Value(_) => return Err(AssignError::NotBytes),
        };
        if bytes.len() > 255 {
            return Err(AssignError::Length { expected: 255, got: bytes.len() });
        }
        self.0 = bytes;
        Ok(())
    }
}

impl<'a> Assign<'a> for &'a [u8] {
    fn assign(
        &mut self,
        path: Steps<'_>,
        value: Input<'a>,
        _: &'static FieldInfo,
    ) -> Result<(), AssignError> {
        path.end()?;
        *self = match value {
            Input::Bytes(bytes) => bytes,
            Input::Text("" | "-") => &[],
            Input::Text(_) => return Err(AssignError::Borrowed { text: false }),
            Input::Raw(_) | Input::Value(_) => return Err(AssignError::NotBytes),
        };
        Ok(())
    }
}
