//! Numbers whose value is not in proportion to the raw number: gains with an offset, or on a logarithmic scale.
//!
//! The raw number is all that is on the wire. What it stands for depends on the firmware in some cases, so these types
//! show and store the raw number, and convert when they are asked to.

use super::quantity::Scale;

/// The values of a curve for all raw numbers, computed by the compiler.
type Table = [f32; 256];

/// `factor * base^raw - less`
#[allow(clippy::indexing_slicing, reason = "only the compiler runs it")]
#[allow(clippy::cast_possible_truncation, reason = "a float of 32 bits tells all steps apart")]
const fn exponential(factor: f64, base: f64, less: f64) -> Table {
    let mut table = [0.0; 256];
    let mut raw = 0;
    while raw < table.len() {
        let (mut power, mut square, mut exponent) = (1.0, base, raw);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power *= square;
            }
            square *= square;
            exponent >>= 1;
        }
        table[raw] = (factor * power - less) as f32;
        raw += 1;
    }
    table
}

/// The 255th root of 52: each step of a scale from 0 to 255 on which `value + 5` grows evenly in its logarithm.
const ROOT_OF_52: f64 = 1.015_615_744_519_757_1;

/// The 255th root of 500.
const ROOT_OF_500: f64 = 1.024_670_412_549_888_6;

/// The 127th root of 50.
const ROOT_OF_50: f64 = 1.031_282_662_354_534;

/// `5 * exp(raw * ln(52) / 255) - 5`: 0 for 0, 255 for 255.
static LOGARITHMIC: Table = exponential(5.0, ROOT_OF_52, 5.0);

/// `50^((raw - 1) / 127) / 50`
static CENTERED: Table = exponential(1.0 / ROOT_OF_50 / 50.0, ROOT_OF_50, 0.0);

/// `0.1 * exp(raw * ln(500) / 255)`
static FACTOR: Table = exponential(0.1, ROOT_OF_500, 0.0);

fn value_of(table: &Table, raw: u8) -> f32 {
    table.get(usize::from(raw)).copied().unwrap_or_default()
}

/// The raw number whose value is nearest; all tables ascend.
fn nearest(table: &Table, value: f32) -> u8 {
    let is_nearer = |pair: &[f32]| matches!(pair, [low, high] if value * 2.0 >= low + high);
    let raw = table.windows(2).take_while(|pair| is_nearer(pair)).count();
    u8::try_from(raw).unwrap_or(u8::MAX)
}

/// The raw number on a line of which `offset` steps lie before 0.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "kept within the limits")]
const fn nearest_on_line(offset: i32, scale: Scale<f32>, value: f32) -> u8 {
    let raw = (scale.steps(value) as i32).saturating_sub(offset);
    if raw < 0 {
        0
    } else if raw > u8::MAX as i32 {
        u8::MAX
    } else {
        raw as u8
    }
}

macro_rules! curve {
    ($(#[doc = $doc:literal])+ $get:ident / $from:ident table $table:ident) => {
        $(#[doc = $doc])+
        #[doc = ""]
        #[doc = "It is looked up in a table of 1 KiB."]
        pub fn $get(self) -> f32 {
            value_of(&$table, self.0)
        }

        #[doc = concat!("The raw number whose [`", stringify!($get), "`](Self::", stringify!($get),
            ") is nearest to `value`; 0 for NaN.")]
        pub fn $from(value: f32) -> Self {
            Self(nearest(&$table, value))
        }
    };
    ($(#[doc = $doc:literal])+ $get:ident / $from:ident line $offset:literal, $multiply:literal / $divide:literal) => {
        $(#[doc = $doc])+
        #[allow(clippy::cast_lossless, reason = "the conversion from a trait is none for constants")]
        pub const fn $get(self) -> f32 {
            Scale::<f32>::new($multiply, $divide).value((self.0 as u16 + $offset) as f32)
        }

        #[doc = concat!("The raw number whose [`", stringify!($get), "`](Self::", stringify!($get),
            ") is nearest to `value`; 0 for NaN.")]
        pub const fn $from(value: f32) -> Self {
            Self(nearest_on_line($offset, Scale::<f32>::new($multiply, $divide), value))
        }
    };
}

macro_rules! curves {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident {
            $($(#[doc = $get_doc:literal])+ $get:ident / $from:ident = $kind:ident($($curve:tt)+);)+
        }
    )*) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name(pub u8);

        impl $name {
            $(curve!($(#[doc = $get_doc])+ $get / $from $kind $($curve)+);)+
        }

        crate::declare::number_type!($name: u8, read |raw| $name(raw), raw |value| value.0);
    )* };
}

curves! {
    /// Term of a PID controller: P, I or D.
    ///
    /// Before firmware 2.73.1, the raw number is the term. From 2.73.1 on, the scale is logarithmic.
    ///
    /// ```
    /// use sbgc_proto::units::PidTerm;
    ///
    /// assert_eq!(PidTerm(255).logarithmic(), 255.0);
    /// assert_eq!(PidTerm::from_logarithmic(3.0), PidTerm(30));
    /// ```
    PidTerm {
        /// Term in firmware 2.73.1+: `5 * exp(raw * ln(52) / 255) - 5`.
        logarithmic / from_logarithmic = table(LOGARITHMIC);
    }

    /// Gain that multiplies all terms of a PID controller.
    ///
    /// ```
    /// use sbgc_proto::units::PidGain;
    ///
    /// assert_eq!(PidGain(70).gain(), 1.5);
    /// assert_eq!(PidGain::from_gain(1.5), PidGain(70));
    /// ```
    PidGain {
        /// Gain in firmware up to 2.73.0: `0.1 + raw * 0.02`.
        gain / from_gain = line(5, 1 / 50);
        /// Gain in firmware 2.73.1+, if the formula of the terms applies: `5 * exp(raw * ln(52) / 255) - 5`.
        ///
        /// The vendor publishes this formula together with an inverse that does not match it, but
        /// [`centered`](Self::centered). Which one is correct is unknown.
        logarithmic / from_logarithmic = table(LOGARITHMIC);
        /// Gain in firmware 2.73.1+, if the vendor's inverse formula is correct: `50^((raw - 1) / 127) / 50`, which is
        /// 1 for raw 128. See [`logarithmic`](Self::logarithmic).
        centered / from_centered = table(CENTERED);
    }

    /// Inverse quality of a low-pass filter.
    InverseQuality {
        /// Inverse quality: `0.2 + raw * 0.02`.
        inverse_quality / from_inverse_quality = line(10, 1 / 50);
    }

    /// Factor of the proportional term of the outer loop in servo mode.
    ServoFactor {
        /// Factor: `0.1 * exp(raw * ln(500) / 255)`.
        factor / from_factor = table(FACTOR);
    }

    /// Integral term of the outer loop in servo mode.
    ServoTerm {
        /// Term: `5 * exp(raw * ln(52) / 255) - 5`.
        term / from_term = table(LOGARITHMIC);
    }

    /// Base frequency of the shake generator.
    ShakeFrequency {
        /// Frequency in Hz: `0.3 + raw * 0.05`.
        hertz / from_hertz = line(6, 1 / 20);
    }

    /// Resonance frequency of the shake generator.
    ShakeResonance {
        /// Frequency in Hz: `0.3 + raw * 0.1`.
        hertz / from_hertz = line(3, 1 / 10);
    }

    /// Frequency range of the shake generator, as a multiple of its base frequency.
    ShakeRange {
        /// Multiple: `1.5 + raw * 0.1`.
        multiple / from_multiple = line(15, 1 / 10);
    }

    /// Pause period of the shake generator.
    ShakePause {
        /// Period in milliseconds: `500 + raw * 20`.
        milliseconds / from_milliseconds = line(25, 20 / 1);
    }
}
