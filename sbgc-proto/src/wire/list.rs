//! Lists whose length the payload determines.

use heapless::Vec;
use nom::Parser;
use nom::combinator::complete;
use nom::error::{ErrorKind, ParseError};

use super::{Fault, FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

/// List of up to `N` elements. Without a count, it extends to the end of the payload.
#[derive(Clone, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct List<T, const N: usize>(Vec<T, N>);

impl<T, const N: usize> List<T, N> {
    /// Creates an empty list.
    pub const fn new() -> Self {
        Self(Vec::new())
    }

    /// Appends an element.
    ///
    /// # Errors
    /// If the list already has `N` elements. The error contains the element.
    pub fn push(&mut self, element: T) -> Result<(), T> {
        self.0.push(element)
    }

    /// Number of elements, as in a count byte.
    pub fn count(&self) -> u8 {
        u8::try_from(self.0.len()).unwrap_or(u8::MAX)
    }
}

impl<T, const N: usize> Default for List<T, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: core::fmt::Debug, const N: usize> core::fmt::Debug for List<T, N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.fmt(f)
    }
}

impl<T, const N: usize> core::ops::Deref for List<T, N> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T, const N: usize> core::ops::DerefMut for List<T, N> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<'l, T, const N: usize> IntoIterator for &'l List<T, N> {
    type Item = &'l T;
    type IntoIter = core::slice::Iter<'l, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

/// Collects at most `N` elements; further ones are dropped.
impl<T, const N: usize> FromIterator<T> for List<T, N> {
    fn from_iter<I: IntoIterator<Item = T>>(elements: I) -> Self {
        Self(elements.into_iter().take(N).collect())
    }
}

/// A [`Fault`] as nom carries it.
struct Unparsed(Fault);

impl ParseError<&[u8]> for Unparsed {
    fn from_error_kind(input: &[u8], _kind: ErrorKind) -> Self {
        Self(Fault { field: "", needed: input.len().saturating_add(1), left: input.len() })
    }

    fn append(_input: &[u8], _kind: ErrorKind, other: Self) -> Self {
        other
    }
}

impl<T: Layout, const N: usize> Layout for List<T, N> {
    const MIN_LEN: usize = 0;
    const MAX_LEN: usize = N * T::MAX_LEN;
}

impl<T, const N: usize> List<T, N> {
    /// Reads a count byte, then so many elements.
    pub(crate) fn read_counted<'a, C: Copy>(
        field: &'static str,
        input: &'a [u8],
        context: C,
    ) -> Read<'a, Self>
    where
        T: FromWire<'a, C>,
    {
        let (input, count) = u8::read(input, ()).map_err(|fault| fault.named(field))?;
        Self::read_exactly(usize::from(count), field, input, context)
    }

    /// Reads `count` elements.
    pub(crate) fn read_exactly<'a, C: Copy>(
        count: usize,
        field: &'static str,
        input: &'a [u8],
        context: C,
    ) -> Read<'a, Self>
    where
        T: FromWire<'a, C>,
    {
        if count > N {
            // More than the longest payload could hold.
            return Err(Fault { field, needed: count.saturating_mul(T::MIN_LEN), left: input.len() });
        }
        Self::read_some(count, count, input, context).map_err(|fault| fault.named(field))
    }

    fn read_some<'a, C: Copy>(least: usize, most: usize, input: &'a [u8], context: C) -> Read<'a, Self>
    where
        T: FromWire<'a, C>,
    {
        let mut element = complete(|input: &'a [u8]| {
            // An element of no bytes would repeat for ever.
            let element = if input.is_empty() {
                Fault::short(T::MIN_LEN.max(1), input)
            } else {
                T::read(input, context)
            };
            element.map_err(|fault| nom::Err::Error(Unparsed(fault)))
        });
        // Not by `nom::multi::fold`, which would move the whole list on for each element.
        let (mut list, mut rest) = (Self::new(), input);
        while list.len() < most {
            match element.parse(rest) {
                Ok((after, value)) => {
                    rest = after;
                    // `most` is within the capacity.
                    let _ = list.push(value);
                }
                Err(nom::Err::Error(Unparsed(fault)) | nom::Err::Failure(Unparsed(fault))) => {
                    if list.len() < least {
                        return Err(fault);
                    }
                    break;
                }
                // No parser here asks for more input.
                Err(nom::Err::Incomplete(_)) => break,
            }
        }
        Ok((rest, list))
    }

    fn write_all<C: Copy>(&self, context: C, out: &mut Writer<'_>) -> Result<(), EncodeError>
    where
        T: ToWire<C>,
    {
        self.0.iter().try_for_each(|element| element.write(context, out))
    }

    pub(crate) fn write_counted<C: Copy>(
        &self,
        _field: &'static str,
        context: C,
        out: &mut Writer<'_>,
    ) -> Result<(), EncodeError>
    where
        T: ToWire<C>,
    {
        self.count().write((), out)?;
        self.write_all(context, out)
    }

    pub(crate) fn write_exactly<C: Copy>(
        &self,
        count: usize,
        field: &'static str,
        context: C,
        out: &mut Writer<'_>,
    ) -> Result<(), EncodeError>
    where
        T: ToWire<C>,
    {
        if self.len() != count {
            return Err(EncodeError::Count { field, expected: count, got: self.len() });
        }
        self.write_all(context, out)
    }
}

/// Reads whole elements up to the end of the payload; what is too short for one more is left over.
impl<'a, T: FromWire<'a, C>, C: Copy, const N: usize> FromWire<'a, C> for List<T, N> {
    fn read(input: &'a [u8], context: C) -> Read<'a, Self> {
        Self::read_some(0, N, input, context)
    }
}

impl<T: ToWire<C>, C: Copy, const N: usize> ToWire<C> for List<T, N> {
    fn write(&self, context: C, out: &mut Writer<'_>) -> Result<(), EncodeError> {
        self.write_all(context, out)
    }
}

impl<T: Default, const N: usize> List<T, N> {
    /// Adds default elements or drops elements at the end, up to `count` elements and `N` at most.
    #[cfg(feature = "reflect")]
    pub(crate) fn resize(&mut self, count: usize) {
        self.0.truncate(count);
        while self.0.len() < count && self.0.push(T::default()).is_ok() {}
    }
}
