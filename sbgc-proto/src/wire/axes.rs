//! Groups of three: by axis of the gimbal and by component of a vector; and plain arrays.

use super::{FromWire, Layout, Read, ToWire, Writer};
use crate::EncodeError;

macro_rules! groups {
    ($($(#[$attribute:meta])* $group:ident { $($(#[$doc:meta])* $part:ident),* })*) => { $(
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $group<T> {
            $($(#[$doc])* pub $part: T,)*
        }

        impl<T> $group<T> {
            /// Returns a group with each value converted by `make`.
            pub fn map<U>(self, mut make: impl FnMut(T) -> U) -> $group<U> {
                $group { $($part: make(self.$part),)* }
            }

            /// Returns the three values in wire order.
            pub fn into_array(self) -> [T; 3] {
                [$(self.$part),*]
            }
        }

        impl<T> From<[T; 3]> for $group<T> {
            fn from([$($part),*]: [T; 3]) -> Self {
                Self { $($part),* }
            }
        }

        impl<T: Layout> Layout for $group<T> {
            const MIN_LEN: usize = 3 * T::MIN_LEN;
            const MAX_LEN: usize = 3 * T::MAX_LEN;
        }

        impl<'a, T: FromWire<'a, C>, C: Copy> FromWire<'a, C> for $group<T> {
            #[inline]
            fn read(input: &'a [u8], context: C) -> Read<'a, Self> {
                if Self::FIXED {
                    return super::read_whole(input, context);
                }
                $(let (input, $part) = T::read(input, context)?;)*
                Ok((input, Self { $($part),* }))
            }

            #[inline]
            fn read_fixed(input: &'a [u8], context: C) -> Option<Self> {
                let mut input = input.get(..Self::MIN_LEN)?;
                $(
                    let $part = T::read_fixed(input, context)?;
                    input = input.get(T::MIN_LEN..)?;
                )*
                let _ = input;
                Some(Self { $($part),* })
            }
        }

        impl<T: Layout + ToWire<C>, C: Copy> ToWire<C> for $group<T> {
            #[inline]
            fn write(&self, context: C, out: &mut Writer<'_>) -> Result<(), EncodeError> {
                $(self.$part.write(context, out)?;)*
                Ok(())
            }

            #[inline]
            fn write_fixed(&self, context: C, place: &mut [u8]) -> Option<()> {
                $(
                    let (here, place) = place.split_at_mut_checked(T::MIN_LEN)?;
                    self.$part.write_fixed(context, here)?;
                )*
                let _ = place;
                Some(())
            }
        }
    )* };
}

groups! {
    /// One value for each axis of the gimbal, in wire order.
    PerAxis {
        /// Rotation about the optical axis.
        roll,
        /// Rotation up and down.
        pitch,
        /// Rotation left and right.
        yaw
    }
    /// One value for each component of a vector, in wire order.
    PerXyz {
        /// X: right or East.
        x,
        /// Y: forward or North.
        y,
        /// Z: down.
        z
    }
}

impl<T: Layout, const N: usize> Layout for [T; N] {
    const MIN_LEN: usize = N * T::MIN_LEN;
    const MAX_LEN: usize = N * T::MAX_LEN;
}

impl<'a, T: FromWire<'a, C> + Default + Copy, C: Copy, const N: usize> FromWire<'a, C> for [T; N] {
    #[inline]
    fn read(mut input: &'a [u8], context: C) -> Read<'a, Self> {
        if Self::FIXED {
            return super::read_whole(input, context);
        }
        let mut elements = [T::default(); N];
        for element in &mut elements {
            (input, *element) = T::read(input, context)?;
        }
        Ok((input, elements))
    }

    #[inline]
    fn read_fixed(input: &'a [u8], context: C) -> Option<Self> {
        let mut input = input.get(..Self::MIN_LEN)?;
        let mut elements = [T::default(); N];
        for element in &mut elements {
            *element = T::read_fixed(input, context)?;
            input = input.get(T::MIN_LEN..)?;
        }
        Some(elements)
    }
}

impl<T: Layout + ToWire<C>, C: Copy, const N: usize> ToWire<C> for [T; N] {
    fn write(&self, context: C, out: &mut Writer<'_>) -> Result<(), EncodeError> {
        self.iter().try_for_each(|element| element.write(context, out))
    }

    #[inline]
    fn write_fixed(&self, context: C, mut place: &mut [u8]) -> Option<()> {
        for element in self {
            let (here, rest) = place.split_at_mut_checked(T::MIN_LEN)?;
            element.write_fixed(context, here)?;
            place = rest;
        }
        Some(())
    }
}
