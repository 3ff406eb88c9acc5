//! Versions of the firmware. They stand below [`reflect`](crate::reflect), whose descriptions name them;
//! [`units`](crate::units) makes a number on the wire of them.

use core::fmt;

/// Version of the firmware as the board reports it: 2305 is 2.30 beta 5, and from 2.73 on the last digit is a patch
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
    /// `major.minor`, with the beta or patch number; a version beyond the maximum, 65.53.5, becomes that.
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

/// Parses what is displayed: `2.30`, `2.30b5`, `2.73.5`.
impl core::str::FromStr for FirmwareVersion {
    type Err = ParseVersionError;

    fn from_str(text: &str) -> Result<Self, ParseVersionError> {
        Self::parse(text.trim()).ok_or(ParseVersionError(()))
    }
}

impl FirmwareVersion {
    /// The version of a declaration.
    #[expect(clippy::panic, reason = "this ends the compilation, not a program")]
    pub(crate) const fn declared(text: &str) -> Self {
        match Self::parse(text) {
            Some(version) => version,
            None => panic!("a firmware version is written as 2.68, 2.68b7 or 2.73.5"),
        }
    }

    const fn parse(text: &str) -> Option<Self> {
        let (mut major, mut minor, mut last) = (0_u16, 0_u16, 0_u16);
        let (mut part, mut has_digits) = (0, false);
        let mut rest = text.as_bytes();
        while let [byte, tail @ ..] = rest {
            rest = tail;
            match (byte, part) {
                (b'0'..=b'9', _) => {
                    let number = match part {
                        0 => &mut major,
                        1 => &mut minor,
                        _ => &mut last,
                    };
                    *number = number.saturating_mul(10).saturating_add((*byte - b'0') as u16);
                    has_digits = true;
                }
                (b'.', 0) | (b'b' | b'.', 1) if has_digits => {
                    part += 1;
                    has_digits = false;
                }
                _ => return None,
            }
        }
        let is_complete = part > 0 && has_digits;
        if !is_complete || minor > 99 || last > 9 {
            return None;
        }
        let Some(thousands) = major.checked_mul(1000) else { return None };
        match thousands.checked_add(minor * 10 + last) {
            Some(raw) => Some(Self(raw)),
            None => None,
        }
    }
}
