//! Repeated elements that stay as they are on the wire.

use core::marker::PhantomData;

use heapless::Vec;

use super::{Fault, FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

/// A type whose values can stand in a [`Packed`] list.
pub trait Element: Layout {
    /// The same type, read from bytes that live for `'x`.
    type At<'x>: FromWire<'x> + ToWire;
}

/// Elements one after the other in up to `N` bytes, each of which is read when it is asked for.
///
/// Long lists take no more memory than on the wire this way, so that the messages that have them stay small enough to
/// be moved. Without a count of its own it reaches to the end of the payload.
///
/// ```
/// use sbgc_proto::commands::{AdjustableVariable, SaveParams3Extended};
///
/// let mut request = SaveParams3Extended::default();
/// request.adj_var_id.push(&AdjustableVariable::RcSpeedYaw)?;
/// assert!(request.adj_var_id.iter().eq([AdjustableVariable::RcSpeedYaw]));
/// # Ok::<(), sbgc_proto::EncodeError>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Packed<T, const N: usize> {
    /// Whole elements, and nothing behind them.
    bytes: Vec<u8, N, u8>,
    element: PhantomData<T>,
}

/// Reads the elements of a [`Packed`] list.
#[derive(Clone, Debug)]
pub struct Elements<'l, T> {
    rest: &'l [u8],
    element: PhantomData<T>,
}

impl<T, const N: usize> Packed<T, N> {
    /// No elements.
    pub const fn new() -> Self {
        Self { bytes: Vec::new(), element: PhantomData }
    }

    /// The elements as they stand on the wire.
    pub fn as_bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }
}

impl<T: Element, const N: usize> Packed<T, N> {
    /// The elements in order.
    pub fn iter(&self) -> Elements<'_, T> {
        Elements { rest: &self.bytes, element: PhantomData }
    }

    /// The number of elements.
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// The element at `index`.
    pub fn get(&self, index: usize) -> Option<T::At<'_>> {
        self.iter().nth(index)
    }

    /// Appends an element.
    ///
    /// # Errors
    /// If there is no room for it, or it cannot be written. Nothing is changed then.
    pub fn push(&mut self, element: &T::At<'_>) -> Result<(), EncodeError> {
        let start = self.bytes.len();
        // Never more than there is room for.
        let _ = self.bytes.resize(N, 0);
        let mut writer = Writer::after(&mut self.bytes, start);
        let result = element.write((), &mut writer);
        let end = if result.is_ok() { writer.len() } else { start };
        self.bytes.truncate(end);
        result
    }

    /// Reads `count` elements, or fewer where the payload ends after one.
    pub(crate) fn read_at_most<'a>(
        count: usize,
        _field: &'static str,
        input: &'a [u8],
        (): (),
    ) -> Read<'a, Self> {
        let mut elements = Elements::<T> { rest: input, element: PhantomData };
        let mut length = 0;
        for _ in 0..count {
            let is_whole = elements.next().is_some();
            let read = input.len().saturating_sub(elements.rest.len());
            if !is_whole || read > N {
                break;
            }
            length = read;
        }
        match input.split_at_checked(length) {
            Some((bytes, rest)) => {
                let bytes = Vec::from_slice(bytes).unwrap_or_default();
                Ok((rest, Self { bytes, element: PhantomData }))
            }
            None => Fault::short(length, input),
        }
    }

    pub(crate) fn write_at_most(
        &self,
        count: usize,
        field: &'static str,
        (): (),
        out: &mut Writer<'_>,
    ) -> Result<(), EncodeError> {
        let got = self.len();
        if got > count {
            return Err(EncodeError::Count { field, expected: count, got });
        }
        out.put(&self.bytes)
    }
}

impl<'l, T: Element> Iterator for Elements<'l, T> {
    type Item = T::At<'l>;

    fn next(&mut self) -> Option<T::At<'l>> {
        if self.rest.is_empty() {
            return None;
        }
        let (rest, element) = T::At::read(self.rest, ()).ok()?;
        self.rest = rest;
        Some(element)
    }
}

impl<'l, T: Element, const N: usize> IntoIterator for &'l Packed<T, N> {
    type Item = T::At<'l>;
    type IntoIter = Elements<'l, T>;

    fn into_iter(self) -> Elements<'l, T> {
        self.iter()
    }
}

/// Takes elements as long as there is room for them.
impl<'x, T: Element, const N: usize> FromIterator<T::At<'x>> for Packed<T, N> {
    fn from_iter<I: IntoIterator<Item = T::At<'x>>>(elements: I) -> Self {
        let mut list = Self::new();
        let _ = elements.into_iter().try_for_each(|element| list.push(&element));
        list
    }
}

impl<T, const N: usize> Default for Packed<T, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Element, const N: usize> core::fmt::Debug for Packed<T, N>
where
    for<'x> T::At<'x>: core::fmt::Debug,
{
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self).finish()
    }
}

/// As bytes: what formats them may not know the elements.
#[cfg(feature = "defmt")]
impl<T, const N: usize> defmt::Format for Packed<T, N> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=[u8]:x}", &self.bytes);
    }
}

impl<T: Layout, const N: usize> Layout for Packed<T, N> {
    const MIN_LEN: usize = 0;
    const MAX_LEN: usize = N;
}

/// Reads whole elements up to the end of the payload; what is too short for one more is left over.
impl<'a, T: Element, const N: usize> FromWire<'a> for Packed<T, N> {
    fn read(input: &'a [u8], (): ()) -> Read<'a, Self> {
        Self::read_at_most(usize::MAX, "", input, ())
    }
}

impl<T, const N: usize> ToWire for Packed<T, N> {
    fn write(&self, (): (), out: &mut Writer<'_>) -> Result<(), EncodeError> {
        out.put(&self.bytes)
    }
}

#[cfg(feature = "serde")]
impl<T: Element, const N: usize> serde::Serialize for Packed<T, N>
where
    for<'x> T::At<'x>: serde::Serialize,
{
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeSeq;

        let mut list = serializer.serialize_seq(Some(self.len()))?;
        self.iter().try_for_each(|element| list.serialize_element(&element))?;
        list.end()
    }
}

#[cfg(feature = "serde")]
impl<'de, T: Element, const N: usize> serde::Deserialize<'de> for Packed<T, N>
where
    T::At<'de>: serde::Deserialize<'de>,
{
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor<T, const N: usize>(PhantomData<T>);

        impl<'de, T: Element, const N: usize> serde::de::Visitor<'de> for Visitor<T, N>
        where
            T::At<'de>: serde::Deserialize<'de>,
        {
            type Value = Packed<T, N>;

            fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "a list that takes at most {N} bytes")
            }

            fn visit_seq<A: serde::de::SeqAccess<'de>>(
                self,
                mut elements: A,
            ) -> Result<Self::Value, A::Error> {
                let mut list = Packed::new();
                while let Some(element) = elements.next_element::<T::At<'de>>()? {
                    list.push(&element).map_err(serde::de::Error::custom)?;
                }
                Ok(list)
            }
        }

        deserializer.deserialize_seq(Visitor(PhantomData))
    }
}
