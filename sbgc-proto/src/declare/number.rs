//! The rule by which every type that is one number on the wire gets its codec and its reflection.

/// Gives a type that is one number on the wire its codec and its reflection:
/// `Type: integer, read |raw| value, raw |value| raw`.
///
/// What raw numbers mean may follow: `scale "unit", multiply, divide`, `meaning` with a
/// [`Meaning`](crate::reflect::Meaning), or both. With `labelled` at the end the type also gets a human-readable serde
/// form that is the name of the value where it has one; without, the caller says how serde sees it.
macro_rules! number_type {
    (
        $name:ty: $integer:ty, read |$raw:ident| $from:expr, raw |$value:ident| $into:expr
        $(, scale $unit:expr, $multiply:expr, $divide:expr)? $(, meaning $meaning:expr)?, labelled
    ) => {
        $crate::declare::number_type!(
            $name: $integer, read |$raw| $from, raw |$value| $into
            $(, scale $unit, $multiply, $divide)? $(, meaning $meaning)?
        );

        #[cfg(feature = "serde")]
        $crate::serde_support::labelled!($name: $integer, |$raw| $from, |$value| $into);
    };
    (
        $name:ty: $integer:ty, read |$raw:ident| $from:expr, raw |$value:ident| $into:expr
        $(, scale $unit:expr, $multiply:expr, $divide:expr)? $(, meaning $meaning:expr)?
    ) => {
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

            #[inline]
            fn write_fixed(&self, (): (), place: &mut [u8]) -> Option<()> {
                let $value = *self;
                $crate::wire::ToWire::write_fixed(&$into, (), place)
            }
        }

        #[cfg(feature = "reflect")]
        impl $crate::reflect::NumberType for $name {
            const NUMBER: $crate::reflect::Number = $crate::reflect::Number {
                $(unit: $unit, multiply: $multiply, divide: $divide,)?
                $(meaning: $meaning,)?
                ..<$integer as $crate::reflect::NumberType>::NUMBER
            };

            fn raw_number(&self) -> i64 {
                let $value = *self;
                $crate::reflect::NumberType::raw_number(&$into)
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                let $raw = <$integer as $crate::reflect::NumberType>::from_raw_number(raw)?;
                Some($from)
            }
        }

        #[cfg(feature = "reflect")]
        $crate::reflect::reflect_number!($name);
    };
}
pub(crate) use number_type;
