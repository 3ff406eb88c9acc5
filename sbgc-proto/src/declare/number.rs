//! The rule by which every type that is one number on the wire gets its codec.

/// Gives a type that is one number on the wire its codec: `Type: integer, read |raw| value, raw |value| raw`.
///
/// With `labelled` it also gets a human-readable serde form that is the name of the value where it has one; without,
/// the caller says how serde sees it.
macro_rules! number_type {
    ($name:ty: $integer:ty, read |$raw:ident| $from:expr, raw |$value:ident| $into:expr, labelled) => {
        $crate::declare::number_type!($name: $integer, read |$raw| $from, raw |$value| $into);

        #[cfg(feature = "serde")]
        $crate::serde_support::labelled!($name: $integer, |$raw| $from, |$value| $into);
    };
    ($name:ty: $integer:ty, read |$raw:ident| $from:expr, raw |$value:ident| $into:expr) => {
        impl $crate::wire::Layout for $name {
            const MIN_LEN: usize = <$integer as $crate::wire::Layout>::MIN_LEN;
            const MAX_LEN: usize = <$integer as $crate::wire::Layout>::MAX_LEN;
        }

        impl<'a> $crate::wire::FromWire<'a> for $name {
            #[inline]
            fn read(input: &'a [u8], (): ()) -> $crate::wire::Read<'a, Self> {
                let (input, $raw) = <$integer as $crate::wire::FromWire>::read(input, ())?;
                Ok((input, $from))
            }

            #[inline]
            fn read_fixed(input: &'a [u8], (): ()) -> Option<Self> {
                let $raw = <$integer as $crate::wire::FromWire>::read_fixed(input, ())?;
                Some($from)
            }
        }

        impl $crate::wire::ToWire for $name {
            #[inline]
            fn write(&self, (): (), out: &mut $crate::wire::Writer<'_>) -> Result<(), $crate::EncodeError> {
                let $value = *self;
                $crate::wire::ToWire::write(&$into, (), out)
            }
        }

        #[cfg(feature = "reflect")]
        $crate::reflect::reflect_number!($name);
    };
}
pub(crate) use number_type;
