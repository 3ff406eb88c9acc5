//! The rule by which every quantity that is in proportion to its raw number gets its type.

/// `value` in raw steps, rounded to the nearest, half away from zero.
pub(super) fn steps(value: f64, multiply: f64, divide: f64) -> f64 {
    let raw = value * divide / multiply;
    raw + if raw < 0.0 { -0.5 } else { 0.5 }
}

/// The documentation of a unit and its scale, for quantities with and without a symbol.
macro_rules! unit_doc {
    ("", $($scale:tt)*) => { concat!($($scale)*) };
    ($unit:tt, $($scale:tt)*) => { concat!("Unit: ", $unit, ". ", $($scale)*) };
}
pub(super) use unit_doc;

/// ` in` and the unit, where there is one.
macro_rules! in_unit {
    ("") => {
        ""
    };
    ($unit:tt) => {
        concat!(" in ", $unit)
    };
}
pub(super) use in_unit;

macro_rules! quantities {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident($integer:ident): $get:ident / $from:ident / $try_from:ident -> $float:ident,
        $unit:tt, $multiply:literal / $divide:literal
        $(, special { $($(#[doc = $special_doc:literal])+ $special:ident = $special_raw:literal;)* })?
        $(, names { $($(#[doc = $name_doc:literal])+ $named:ident = $name_raw:literal;)* })?;
    )*) => { $(
        $(#[doc = $doc])+
        #[doc = ""]
        #[doc = quantity::unit_doc!($unit, "Value = raw × ", $multiply, " / ", $divide, ".")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        pub struct $name(pub $integer);

        impl $name {
            $($(
                $(#[doc = $special_doc])+
                pub const $special: Self = Self($special_raw);
            )*)?

            $(
                $(
                    $(#[doc = $name_doc])+
                    pub const $named: Self = Self($name_raw);
                )*

                /// Names of some values.
                pub const NAMES: &'static [crate::wire::Label] = &[
                    $(crate::wire::Label {
                        value: $name_raw,
                        name: stringify!($named),
                        doc: crate::declare::first_doc!($($name_doc)+),
                    }),*
                ];

                /// Name of the value, if it has one.
                pub fn name(self) -> Option<&'static str> {
                    let label = Self::NAMES.iter().find(|label| label.value == i64::from(self.0))?;
                    Some(label.name)
                }
            )?

            #[doc = concat!("The physical value", quantity::in_unit!($unit), ".")]
            #[allow(clippy::cast_possible_truncation, clippy::cast_lossless, clippy::cast_precision_loss,
                reason = "the float type was chosen to hold every raw number")]
            pub fn $get(self) -> $float {
                (f64::from(self.0) * $multiply as f64 / $divide as f64) as $float
            }

            #[doc = concat!("The nearest raw number for a value", quantity::in_unit!($unit),
                ", saturating at the limits of the wire; NaN becomes 0.")]
            #[allow(clippy::cast_possible_truncation, clippy::cast_lossless, clippy::cast_precision_loss,
                clippy::cast_sign_loss, reason = "the cast from float to integer is the saturation that is wanted")]
            pub fn $from(value: $float) -> Self {
                Self(quantity::steps(f64::from(value), $multiply as f64, $divide as f64) as $integer)
            }

            #[doc = concat!("The nearest raw number for a value", quantity::in_unit!($unit), ".")]
            #[doc = ""]
            #[doc = "# Errors"]
            #[doc = "If the value is NaN or beyond what the wire can hold."]
            #[allow(clippy::cast_lossless, clippy::cast_precision_loss, reason = "limits of 32 bits fit a float")]
            pub fn $try_from(value: $float) -> Result<Self, crate::OutOfRange> {
                let raw = quantity::steps(f64::from(value), $multiply as f64, $divide as f64);
                // The cast cuts off what is behind the point: only a whole step beyond the limits is out of them.
                let (least, most) = ($integer::MIN as f64 - 1.0, $integer::MAX as f64 + 1.0);
                if raw > least && raw < most { Ok(Self::$from(value)) } else { Err(Self::LIMITS) }
            }

            /// The physical values of the smallest and the largest raw number.
            #[allow(clippy::cast_lossless, clippy::cast_precision_loss, reason = "limits of 32 bits fit a float")]
            const LIMITS: crate::OutOfRange = crate::OutOfRange {
                minimum: $integer::MIN as f64 * $multiply as f64 / $divide as f64,
                maximum: $integer::MAX as f64 * $multiply as f64 / $divide as f64,
                unit: $unit,
            };

            /// The raw numbers that are names rather than quantities; most types have none.
            pub const LABELS: &'static [crate::wire::Label] = &[
                $($(crate::wire::Label {
                    value: $special_raw,
                    name: stringify!($special),
                    doc: crate::declare::first_doc!($($special_doc)+),
                }),*)?
            ];
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                core::fmt::Display::fmt(&self.$get(), f)?;
                if $unit.is_empty() { Ok(()) } else { write!(f, " {}", $unit) }
            }
        }

        crate::declare::number_type!($name: $integer, read |raw| $name(raw), raw |value| value.0);

        #[cfg(feature = "reflect")]
        impl crate::reflect::NumberType for $name {
            const NUMBER: crate::reflect::Number = crate::reflect::Number {
                scalar: crate::reflect::Scalar::$integer,
                unit: $unit,
                multiply: $multiply as f64,
                divide: $divide as f64,
                meaning: if Self::LABELS.is_empty() {
                    crate::reflect::Meaning::Plain
                } else {
                    crate::reflect::Meaning::Special(Self::LABELS)
                },
            };

            fn raw_number(&self) -> i64 {
                i64::from(self.0)
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                raw.try_into().ok().map(Self)
            }
        }

        #[cfg(feature = "serde")]
        crate::serde_support::quantity!($name: $integer, $multiply, $divide);
    )*

        #[cfg(test)]
        mod every_quantity {
            $(
                #[test]
                #[allow(non_snake_case, reason = "named after the type")]
                #[allow(clippy::cast_possible_truncation, clippy::cast_lossless, clippy::cast_precision_loss,
                    clippy::useless_conversion, clippy::unnecessary_fallible_conversions,
                    trivial_numeric_casts, reason = "some of the types need what others do not")]
                fn $name() {
                    use super::$name;

                    let number = |raw: i64| $name(raw.try_into().unwrap());
                    super::tests::check_quantity(&super::tests::Quantity {
                        limits: (i64::from($integer::MIN), i64::from($integer::MAX)),
                        step: $multiply as f64 / $divide as f64,
                        get: &|raw| f64::from(number(raw).$get()),
                        from: &|value| i64::from($name::$from(value as $float).0),
                        try_from: &|value| $name::$try_from(value as $float).ok().map(|value| i64::from(value.0)),
                    });
                }
            )*
        }
    };
}
pub(super) use quantities;
