//! The version of the firmware as a number on the wire.

use crate::version::FirmwareVersion;

#[cfg(feature = "serde")]
crate::serde_support::shown!(FirmwareVersion(u16), "a version such as 2.68b7 or 2.73.5");

crate::declare::number_type!(
    FirmwareVersion: u16, read |raw| FirmwareVersion(raw), raw |value| value.0,
    meaning crate::reflect::Meaning::Shown {
        show: |raw, f| match u16::try_from(raw) {
            Ok(raw) => core::fmt::Display::fmt(&FirmwareVersion(raw), f),
            Err(_) => Ok(()),
        },
        read: |text| text.parse::<FirmwareVersion>().ok().map(|version| version.0.into()),
    }
);
