//! Versions of the firmware.

use core::fmt;

/// The version of the firmware as the board gives it: 2305 is 2.30 beta 5, and from 2.73 on the last digit is a patch
/// number, so that 2735 is 2.73.5.
///
/// ```
/// use sbgc_proto::units::FirmwareVersion;
///
/// assert_eq!(FirmwareVersion(2305).to_string(), "2.30b5");
/// assert_eq!(FirmwareVersion(2730).to_string(), "2.73.0");
/// assert!(FirmwareVersion(2687) >= FirmwareVersion::new(2, 68, 7));
/// assert_eq!("2.68b7".parse(), Ok(FirmwareVersion(2687)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FirmwareVersion(pub u16);

impl FirmwareVersion {
    /// `major.minor`, with beta or patch number; the maximum version there is for what is beyond that, 65.53.5.
    pub const fn new(major: u16, minor: u16, last: u16) -> Self {
        Self(major.saturating_mul(1000).saturating_add(minor.saturating_mul(10)).saturating_add(last))
    }

    /// Major number, minor number, and the last digit: beta number before 2.73, patch number from there on.
    pub const fn parts(self) -> (u16, u16, u16) {
        (self.0 / 1000, self.0 % 1000 / 10, self.0 % 10)
    }
}

impl fmt::Display for FirmwareVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (major, minor, last) = self.parts();
        if self.0 >= 2730 {
            write!(f, "{major}.{minor:02}.{last}")
        } else if last == 0 {
            write!(f, "{major}.{minor:02}")
        } else {
            write!(f, "{major}.{minor:02}b{last}")
        }
    }
}

/// A text that is not a firmware version.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ParseVersionError(());

impl fmt::Display for ParseVersionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("invalid firmware version; expected MAJOR.MINOR with beta or patch number, such as 2.68b7 or 2.73.5")
    }
}

impl core::error::Error for ParseVersionError {}

/// Reads what is shown: `2.30`, `2.30b5`, `2.73.5`.
impl core::str::FromStr for FirmwareVersion {
    type Err = ParseVersionError;

    fn from_str(text: &str) -> Result<Self, ParseVersionError> {
        let number = |digits: &str| {
            let only_digits = digits.bytes().all(|digit| digit.is_ascii_digit());
            digits.parse::<u16>().ok().filter(|_| only_digits)
        };
        let read = || {
            let (major, rest) = text.trim().split_once('.')?;
            let (minor, last) = rest.split_once(['b', '.']).unwrap_or((rest, "0"));
            let minor = number(minor).filter(|minor| *minor <= 99)?;
            let last = number(last).filter(|last| *last <= 9)?;
            number(major)?.checked_mul(1000)?.checked_add(minor * 10 + last)
        };
        read().map(Self).ok_or(ParseVersionError(()))
    }
}

#[cfg(feature = "serde")]
crate::serde_support::shown!(FirmwareVersion(u16), "a version such as 2.68b7 or 2.73.5");

crate::declare::number_type!(FirmwareVersion: u16, read |raw| FirmwareVersion(raw), raw |value| value.0);

#[cfg(feature = "reflect")]
impl crate::reflect::NumberType for FirmwareVersion {
    const NUMBER: crate::reflect::Number = crate::reflect::Number {
        meaning: crate::reflect::Meaning::Shown {
            show: |raw, f| match u16::try_from(raw) {
                Ok(raw) => fmt::Display::fmt(&FirmwareVersion(raw), f),
                Err(_) => Ok(()),
            },
            read: |text| text.parse::<FirmwareVersion>().ok().map(|version| version.0.into()),
        },
        ..crate::reflect::Number::plain(crate::reflect::Scalar::u16)
    };

    fn raw_number(&self) -> i64 {
        i64::from(self.0)
    }

    fn from_raw_number(raw: i64) -> Option<Self> {
        raw.try_into().ok().map(Self)
    }
}
