//! Numbers whose value is not in proportion to the raw number: gains with an offset, or on a logarithmic scale.
//!
//! The raw number is all that is on the wire. What it stands for depends on the firmware in some cases, so these types
//! show and store the raw number, and convert when they are asked to.

/// `base` to the power of `exponent`.
fn power(mut base: f64, mut exponent: u8) -> f64 {
    let mut result = 1.0;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result *= base;
        }
        base *= base;
        exponent >>= 1;
    }
    result
}

/// The 255th root of 52: each step of a scale from 0 to 255 on which `value + 5` grows evenly in its logarithm.
const ROOT_OF_52: f64 = 1.015_615_744_519_757_1;

/// The 255th root of 500.
const ROOT_OF_500: f64 = 1.024_670_412_549_888_6;

/// The 127th root of 50.
const ROOT_OF_50: f64 = 1.031_282_662_354_534;

/// `5 * exp(raw * ln(52) / 255) - 5`: 0 for 0, 255 for 255.
fn logarithmic(raw: u8) -> f64 {
    5.0 * power(ROOT_OF_52, raw) - 5.0
}

macro_rules! curves {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident {
            $($(#[doc = $get_doc:literal])+ $get:ident / $from:ident = $curve:expr;)+
        }
    )*) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name(pub u8);

        impl $name {
            $(
                $(#[doc = $get_doc])+
                #[allow(clippy::cast_possible_truncation, reason = "a float of 32 bits tells all steps apart")]
                pub fn $get(self) -> f32 {
                    let curve: fn(u8) -> f64 = $curve;
                    curve(self.0) as f32
                }

                #[doc = concat!("The raw number whose [`", stringify!($get), "`](Self::", stringify!($get),
                    ") is nearest to `value`; 0 for NaN.")]
                pub fn $from(value: f32) -> Self {
                    let curve: fn(u8) -> f64 = $curve;
                    let value = f64::from(value);
                    let nearest = |raw: &u8| value.is_nan() || value * 2.0 < curve(*raw) + curve(*raw + 1);
                    // All curves ascend.
                    Self((0..u8::MAX).find(nearest).unwrap_or(u8::MAX))
                }
            )+
        }

        crate::declare::number_type!($name: u8, read |raw| $name(raw), raw |value| value.0);

        #[cfg(feature = "reflect")]
        impl crate::reflect::NumberType for $name {
            const NUMBER: crate::reflect::Number =
                crate::reflect::Number::plain(crate::reflect::Scalar::u8);

            fn raw_number(&self) -> i64 {
                i64::from(self.0)
            }

            fn from_raw_number(raw: i64) -> Option<Self> {
                raw.try_into().ok().map(Self)
            }
        }
    )* };
}

curves! {
    /// A term of a PID controller: P, I or D.
    ///
    /// Before firmware 2.73.1 the raw number itself is the term. From there on the scale is logarithmic.
    ///
    /// ```
    /// use sbgc_proto::units::PidTerm;
    ///
    /// assert_eq!(PidTerm(255).logarithmic(), 255.0);
    /// assert_eq!(PidTerm::from_logarithmic(3.0), PidTerm(30));
    /// ```
    PidTerm {
        /// The term as firmware 2.73.1+ has it: `5 * exp(raw * ln(52) / 255) - 5`.
        logarithmic / from_logarithmic = logarithmic;
    }

    /// The gain that multiplies all terms of a PID controller.
    ///
    /// ```
    /// use sbgc_proto::units::PidGain;
    ///
    /// assert_eq!(PidGain(70).gain(), 1.5);
    /// assert_eq!(PidGain::from_gain(1.5), PidGain(70));
    /// ```
    PidGain {
        /// The gain as firmware up to 2.73.0 has it: `0.1 + raw * 0.02`.
        gain / from_gain = |raw| 0.1 + f64::from(raw) * 0.02;
        /// The gain as firmware 2.73.1+ has it, if the formula is that of the single terms:
        /// `5 * exp(raw * ln(52) / 255) - 5`.
        ///
        /// The vendor gives this formula, and an inverse that does not belong to it but to
        /// [`centered`](Self::centered). Which is right is unknown.
        logarithmic / from_logarithmic = logarithmic;
        /// The gain as firmware 2.73.1+ has it, if the vendor's inverse formula is right:
        /// `50^((raw - 1) / 127) / 50`, which is 1 for raw 128. See [`logarithmic`](Self::logarithmic).
        centered / from_centered = |raw| power(ROOT_OF_50, raw) / ROOT_OF_50 / 50.0;
    }

    /// The quality of a low-pass filter, as its inverse.
    InverseQuality {
        /// The inverse of the quality: `0.2 + raw * 0.02`.
        inverse_quality / from_inverse_quality = |raw| 0.2 + f64::from(raw) * 0.02;
    }

    /// The factor of the outer loop's proportional term in servo mode.
    ServoFactor {
        /// The factor: `0.1 * exp(raw * ln(500) / 255)`.
        factor / from_factor = |raw| 0.1 * power(ROOT_OF_500, raw);
    }

    /// The outer loop's integral term in servo mode.
    ServoTerm {
        /// The term: `5 * exp(raw * ln(52) / 255) - 5`.
        term / from_term = logarithmic;
    }

    /// The base frequency of the shake generator.
    ShakeFrequency {
        /// The frequency in Hz: `0.3 + raw * 0.05`.
        hertz / from_hertz = |raw| 0.3 + f64::from(raw) * 0.05;
    }

    /// The frequency of resonance of the shake generator.
    ShakeResonance {
        /// The frequency in Hz: `0.3 + raw * 0.1`.
        hertz / from_hertz = |raw| 0.3 + f64::from(raw) * 0.1;
    }

    /// The range of frequencies of the shake generator, as a multiple of its base frequency.
    ShakeRange {
        /// The multiple: `1.5 + raw * 0.1`.
        multiple / from_multiple = |raw| 1.5 + f64::from(raw) * 0.1;
    }

    /// The period of pauses of the shake generator.
    ShakePause {
        /// The period in milliseconds: `500 + raw * 20`.
        milliseconds / from_milliseconds = |raw| 500.0 + f64::from(raw) * 20.0;
    }
}
