//! The rule by which every quantity that is in proportion to its raw number gets its type.
//!
//! Conversions compute in the float type that they return, or in integers: a microcontroller without a double-precision
//! unit pays for `f64` only where a quantity has more bits than an `f32` holds.

/// How many units `multiply / divide` make a raw step; as a fraction, because few scales are exact in a float.
#[derive(Clone, Copy)]
pub(super) struct Scale<F> {
    multiply: F,
    divide: F,
    /// `multiply / divide` where a float holds it.
    factor: Option<F>,
}

/// Both numbers without their common divisor.
const fn reduced(multiply: u32, divide: u32) -> (u32, u32) {
    let (mut divisor, mut rest) = (multiply, divide);
    while rest > 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    (multiply / divisor, divide / divisor)
}

macro_rules! scales {
    ($($float:ident)*) => { $(
        impl Scale<$float> {
            #[allow(clippy::cast_lossless, clippy::cast_precision_loss, reason = "scales are small numbers")]
            pub(super) const fn new(multiply: u32, divide: u32) -> Self {
                let (multiply, divide) = reduced(multiply, divide);
                let exact = divide.is_power_of_two();
                let (multiply, divide) = (multiply as $float, divide as $float);
                Self { multiply, divide, factor: if exact { Some(multiply / divide) } else { None } }
            }

            /// The value of so many steps, the nearest that the float type has.
            #[inline]
            pub(super) const fn value(self, steps: $float) -> $float {
                match self.factor {
                    Some(factor) => steps * factor,
                    // The product is exact, so only the division rounds.
                    None => steps * self.multiply / self.divide,
                }
            }

            /// A number that becomes the nearest number of steps where the digits behind its point are cut off, half
            /// away from zero.
            #[inline]
            pub(super) const fn steps(self, value: $float) -> $float {
                // The greatest number below 1/2: the sum of it and a number just below 1/2 is not rounded to 1.
                const HALF: $float = 0.5 - $float::EPSILON / 4.0;
                let steps = value * self.divide / self.multiply;
                steps + if steps < 0.0 { -HALF } else { HALF }
            }
        }
    )* };
}

scales!(f32 f64);

/// A [`Scale`] for whole numbers of a unit.
#[derive(Clone, Copy)]
pub(super) struct WholeScale {
    multiply: u32,
    divide: u32,
}

impl WholeScale {
    pub(super) const fn new(multiply: u32, divide: u32) -> Self {
        let (multiply, divide) = reduced(multiply, divide);
        Self { multiply, divide }
    }

    /// The scale of the way back.
    const fn inverse(self) -> Self {
        Self { multiply: self.divide, divide: self.multiply }
    }

    /// `number * multiply / divide`, rounded to the nearest, half away from zero. No number has a greater magnitude than
    /// `limit`, a constant: it decides whether 32 bits are enough.
    #[inline]
    #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "checked by the limit")]
    const fn scaled(self, number: i64, limit: i64) -> i64 {
        let (multiply, divide) = (self.multiply as i64, self.divide as i64);
        if limit * multiply + divide <= i32::MAX as i64 {
            let (product, divide) = (number as i32 * multiply as i32, divide as i32);
            let half = if product < 0 { -(divide / 2) } else { divide / 2 };
            ((product + half) / divide) as i64
        } else {
            let product = number * multiply;
            let half = if product < 0 { -(divide / 2) } else { divide / 2 };
            (product + half) / divide
        }
    }

    /// The value of `raw`, a raw number of the range `least..=most`.
    #[inline]
    #[allow(clippy::cast_possible_truncation, reason = "a scale is declared only where the values fit")]
    pub(super) const fn value(self, raw: i64, (least, most): (i64, i64)) -> i32 {
        self.scaled(raw, if most > -least { most } else { -least }) as i32
    }

    /// The raw number of the range `least..=most` that is nearest to `value`.
    #[inline]
    pub(super) const fn raw(self, value: i32, (least, most): (i64, i64)) -> i64 {
        // One further than the values of the limits, which are rounded.
        let (lower, upper) = (self.value(least, (least, most)) - 1, self.value(most, (least, most)) + 1);
        let value = if value < lower {
            lower
        } else if value > upper {
            upper
        } else {
            value
        };
        let limit = if upper > -lower { upper as i64 } else { -(lower as i64) };
        let raw = self.inverse().scaled(value as i64, limit);
        if raw < least {
            least
        } else if raw > most {
            most
        } else {
            raw
        }
    }
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
        $(, whole { $($whole:ident / $from_whole:ident: $part:literal, $whole_unit:literal;)* })?
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

            const SCALE: quantity::Scale<$float> = quantity::Scale::<$float>::new($multiply, $divide);

            #[doc = concat!("The physical value", quantity::in_unit!($unit), ".")]
            #[inline]
            #[allow(clippy::cast_lossless, reason = "the conversion from a trait is none for constants")]
            pub const fn $get(self) -> $float {
                Self::SCALE.value(self.0 as $float)
            }

            #[doc = concat!("The nearest raw number for a value", quantity::in_unit!($unit),
                ", saturating at the limits of the wire; NaN becomes 0.")]
            #[inline]
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss,
                reason = "the cast from float to integer is the saturation that is wanted")]
            pub const fn $from(value: $float) -> Self {
                Self(Self::SCALE.steps(value) as $integer)
            }

            #[doc = concat!("The nearest raw number for a value", quantity::in_unit!($unit), ".")]
            #[doc = ""]
            #[doc = "# Errors"]
            #[doc = "If the value is NaN or beyond what the wire can hold."]
            #[inline]
            #[allow(clippy::cast_lossless, reason = "limits fit the float")]
            pub const fn $try_from(value: $float) -> Result<Self, crate::OutOfRange> {
                let raw = Self::SCALE.steps(value);
                // The cast cuts off what is behind the point: only a whole step beyond the limits is out of them.
                let (least, most) = ($integer::MIN as $float - 1.0, $integer::MAX as $float + 1.0);
                if raw > least && raw < most { Ok(Self::$from(value)) } else { Err(Self::LIMITS) }
            }

            $($(
                #[doc = concat!("The value in ", $whole_unit, ", rounded to the nearest. Integers alone do it.")]
                #[inline]
                #[allow(clippy::cast_lossless, reason = "the conversion from a trait is none for constants")]
                pub const fn $whole(self) -> i32 {
                    const SCALE: quantity::WholeScale = quantity::WholeScale::new($multiply * $part, $divide);
                    SCALE.value(self.0 as i64, ($integer::MIN as i64, $integer::MAX as i64))
                }

                #[doc = concat!("The nearest raw number for a value in ", $whole_unit,
                    ", saturating at the limits of the wire. Integers alone do it.")]
                #[inline]
                #[allow(clippy::cast_lossless, reason = "the conversion from a trait is none for constants")]
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "kept within the limits")]
                pub const fn $from_whole(value: i32) -> Self {
                    const SCALE: quantity::WholeScale = quantity::WholeScale::new($multiply * $part, $divide);
                    Self(SCALE.raw(value, ($integer::MIN as i64, $integer::MAX as i64)) as $integer)
                }
            )*)?

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

        crate::declare::number_type!(
            $name: $integer, read |raw| $name(raw), raw |value| value.0,
            scale $unit, $multiply as f64, $divide as f64,
            meaning if Self::LABELS.is_empty() {
                crate::reflect::Meaning::Plain
            } else {
                crate::reflect::Meaning::Special(Self::LABELS)
            }
        );

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
                    let limits = (i64::from($integer::MIN), i64::from($integer::MAX));
                    super::tests::check_quantity(&super::tests::Quantity {
                        limits,
                        step: $multiply as f64 / $divide as f64,
                        get: &|raw| f64::from(number(raw).$get()),
                        nearest: &|raw| f64::from((raw as f64 * $multiply as f64 / $divide as f64) as $float),
                        from: &|value| i64::from($name::$from(value as $float).0),
                        try_from: &|value| $name::$try_from(value as $float).ok().map(|value| i64::from(value.0)),
                    });
                    $($(
                        super::tests::check_whole(&super::tests::WholeQuantity {
                            limits,
                            scale: ($multiply * $part, $divide),
                            get: &|raw| number(raw).$whole(),
                            from: &|value| i64::from($name::$from_whole(value).0),
                        });
                    )*)?
                }
            )*
        }
    };
}
pub(super) use quantities;
