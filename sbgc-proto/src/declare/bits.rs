//! Flag sets, and what the parts of a number can be.

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
            /// Named flags with their spec names.
            pub const LABELS: &'static [$crate::wire::Label] = &[
                $($crate::wire::Label {
                    value: $value,
                    name: $crate::declare::spec_name!($prefix, $flag $($spec)?),
                    doc: $crate::declare::first_doc!($($doc)+),
                }),*
            ];
        }

        $crate::declare::number_type!(
            $name: $integer, read |raw| $name::from_bits_retain(raw), raw |flags| flags.bits(),
            meaning $crate::reflect::Meaning::Flags(Self::LABELS)
        );

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

/// Labels of a type that can be a part of a number: none for plain ones.
#[cfg(feature = "reflect")]
pub(crate) trait BitLabels {
    const LABELS: &'static [crate::wire::Label] = &[];
}

#[cfg(feature = "reflect")]
impl BitLabels for u8 {}

#[cfg(feature = "reflect")]
impl BitLabels for bool {}
