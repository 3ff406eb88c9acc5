//! Flag sets, and numbers that are made of several smaller ones.

/// A value that takes some bits of a number.
pub(crate) trait BitField: Sized {
    fn from_bits(bits: u32) -> Self;
    fn into_bits(self) -> u32;
}

impl BitField for bool {
    fn from_bits(bits: u32) -> Self {
        bits != 0
    }

    fn into_bits(self) -> u32 {
        u32::from(self)
    }
}

impl BitField for u8 {
    fn from_bits(bits: u32) -> Self {
        u8::try_from(bits).unwrap_or(u8::MAX)
    }

    fn into_bits(self) -> u32 {
        u32::from(self)
    }
}

/// Declares a set of flags that keeps the bits it does not know.
///
/// ```text
/// flags! {
///     /// What it is. Spec: `NAME`.
///     pub struct Name: u8 {
///         /// What it means.
///         const NAME = 1 << 0;
///         /// With the spec's name, where it is another.
///         const OTHER "SOMETHING_ELSE" = 1 << 1;
///     }
/// }
/// ```
///
/// After the integer may stand `prefix "…"`, which the spec's names have before those here.
macro_rules! flags {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident: $integer:ident { $($body:tt)* }
    ) => {
        $crate::declare::flags! { $(#[$attribute])* pub struct $name: $integer, prefix "" { $($body)* } }
    };
    (
        $(#[$attribute:meta])*
        pub struct $name:ident: $integer:ident, prefix $prefix:literal {
            $($(#[doc = $doc:literal])+ const $flag:ident $($spec:literal)? = $value:expr;)*
        }
    ) => {
        bitflags::bitflags! {
            $(#[$attribute])*
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
            pub struct $name: $integer {
                $(
                    $(#[doc = $doc])+
                    #[doc = ""]
                    #[doc = concat!(
                        "Spec: `", $crate::declare::spec_name!($prefix, $flag $($spec)?), "` = `", stringify!($value), "`."
                    )]
                    const $flag = $value;
                )*
                // Every bit is known to the set, so that no operation drops one.
                const _ = !0;
            }
        }

        impl $name {
            /// The named flags with the spec's names.
            pub const LABELS: &'static [$crate::wire::Label] = &[
                $($crate::wire::Label {
                    value: $value,
                    name: $crate::declare::spec_name!($prefix, $flag $($spec)?),
                    doc: $crate::declare::first_doc!($($doc)+),
                }),*
            ];
        }

        $crate::declare::number_type!(
            $name: $integer, read |raw| $name::from_bits_retain(raw), raw |flags| flags.bits()
        );

        #[cfg(feature = "reflect")]
        impl $crate::reflect::NumberType for $name {
            const NUMBER: $crate::reflect::Number = $crate::reflect::Number {
                meaning: $crate::reflect::Meaning::Flags(Self::LABELS),
                ..$crate::reflect::Number::plain($crate::reflect::Scalar::$integer)
            };

            fn raw_number(&self) -> i64 {
                i64::from(self.bits())
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                raw.try_into().ok().map(Self::from_bits_retain)
            }
        }

        #[cfg(feature = "defmt")]
        impl defmt::Format for $name {
            fn format(&self, f: defmt::Formatter<'_>) {
                defmt::write!(f, "{}({=u32:#x})", stringify!($name), u32::from(self.bits()));
            }
        }
    };
}
pub(crate) use flags;

/// The spec's name of a flag: its own behind the prefix, or the one that is given.
macro_rules! spec_name {
    ($prefix:literal, $flag:ident) => {
        concat!($prefix, stringify!($flag))
    };
    ($prefix:literal, $flag:ident $spec:literal) => {
        $spec
    };
}
pub(crate) use spec_name;

/// The first of several lines of documentation.
macro_rules! first_doc {
    ($doc:literal $($more:literal)*) => {
        $doc.trim_ascii()
    };
}
pub(crate) use first_doc;

/// Declares a number that is made of several smaller ones, lowest bits first. Bits that no part takes are kept.
///
/// ```text
/// bit_fields! {
///     /// What it is.
///     pub struct Name: u8 {
///         /// What it means.
///         0..=4 => channel / with_channel "CHANNEL": u8,
///         /// What it means.
///         5..=6 => kind / with_kind "TYPE": Kind,
///         /// What it means.
///         7 => is_set / with_set "SET": bool,
///     }
///     // If some values have names as a whole.
///     names {
///         /// What it means.
///         NOTHING = 0;
///     }
/// }
/// ```
///
/// Each part gets a reader of its name and a `with_` method, which turns a value too large for the bits into the
/// maximum that they hold.
macro_rules! bit_fields {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident: $integer:ident {
            $($(#[doc = $doc:literal])+ $low:literal $(..= $high:literal)? => $part:ident / $with:ident $spec:literal: $ty:ty,)*
        }
        $(names { $($(#[doc = $name_doc:literal])+ $named:ident = $value:literal;)* })?
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        pub struct $name(pub $integer);

        impl $name {
            $($(
                $(#[doc = $name_doc])+
                #[doc = ""]
                #[doc = concat!("Spec: `", stringify!($named), "` = ", $value, ".")]
                pub const $named: Self = Self($value);
            )*)?

            $(
                $(#[doc = $doc])+
                #[doc = ""]
                #[doc = concat!("Spec: `", $spec, "`, ", $crate::declare::bit_words!($low $($high)?), ".")]
                pub fn $part(self) -> $ty {
                    let mask = u32::MAX >> (32 - $crate::declare::bit_width!($low $($high)?));
                    <$ty as $crate::declare::BitField>::from_bits((u32::from(self.0) >> $low) & mask)
                }

                #[doc = concat!("Returns a copy with [`", stringify!($part), "`](Self::", stringify!($part),
                    ") replaced; a value too large for its bits becomes the maximum they hold.")]
                #[must_use]
                pub fn $with(self, value: $ty) -> Self {
                    let mask = u32::MAX >> (32 - $crate::declare::bit_width!($low $($high)?));
                    let part = $crate::declare::BitField::into_bits(value).min(mask) << $low;
                    let bits = (u32::from(self.0) & !(mask << $low)) | part;
                    // No bit of `bits` is beyond those of the integer.
                    Self($integer::try_from(bits).unwrap_or($integer::MAX))
                }
            )*
        }

        $crate::declare::number_type!($name: $integer, read |raw| $name(raw), raw |value| value.0);

        #[cfg(feature = "serde")]
        $crate::serde_support::parts!($name($integer));

        #[cfg(feature = "reflect")]
        impl $crate::reflect::NumberType for $name {
            const NUMBER: $crate::reflect::Number = $crate::reflect::Number {
                meaning: $crate::reflect::Meaning::Bits(&[
                    $($crate::reflect::BitPart {
                        name: $spec,
                        low: $low,
                        width: $crate::declare::bit_width!($low $($high)?),
                        labels: <$ty as $crate::declare::BitLabels>::LABELS,
                        doc: $crate::declare::first_doc!($($doc)+),
                    }),*
                ], &[$($($crate::wire::Label {
                    value: $value,
                    name: stringify!($named),
                    doc: $crate::declare::first_doc!($($name_doc)+),
                }),*)?]),
                ..$crate::reflect::Number::plain($crate::reflect::Scalar::$integer)
            };

            fn raw_number(&self) -> i64 {
                i64::from(self.0)
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                raw.try_into().ok().map(Self)
            }
        }
    };
}
pub(crate) use bit_fields;

/// The bits of a part in words.
macro_rules! bit_words {
    ($bit:literal) => {
        concat!("bit ", $bit)
    };
    ($low:literal $high:literal) => {
        concat!("bits ", $low, " to ", $high)
    };
}
pub(crate) use bit_words;

/// How many bits a part has.
macro_rules! bit_width {
    ($bit:literal) => {
        1
    };
    ($low:literal $high:literal) => {
        $high - $low + 1
    };
}
pub(crate) use bit_width;

/// Labels of a type that can be a part of a number: none for plain ones.
#[cfg(feature = "reflect")]
pub(crate) trait BitLabels {
    const LABELS: &'static [crate::wire::Label] = &[];
}

#[cfg(feature = "reflect")]
impl BitLabels for u8 {}

#[cfg(feature = "reflect")]
impl BitLabels for bool {}

/// Lets open enumerations of one byte be parts of a number.
macro_rules! bit_enums {
    ($($name:ty),* $(,)?) => { $(
        impl $crate::declare::BitField for $name {
            fn from_bits(bits: u32) -> Self {
                Self::from_raw(<u8 as $crate::declare::BitField>::from_bits(bits))
            }

            fn into_bits(self) -> u32 {
                u32::from(self.raw())
            }
        }

        #[cfg(feature = "reflect")]
        impl $crate::declare::BitLabels for $name {
            const LABELS: &'static [$crate::wire::Label] = <$name>::LABELS;
        }
    )* };
}
pub(crate) use bit_enums;
