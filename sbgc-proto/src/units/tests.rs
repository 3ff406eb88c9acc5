//! Quantities at the ends of their ranges, between two steps, and over all raw numbers.

use std::ops::RangeInclusive;

use proptest::prelude::*;

use super::*;

/// What the tests of all quantities need to know of one.
pub(super) struct Quantity<'f> {
    pub(super) limits: (i64, i64),
    pub(super) step: f64,
    pub(super) get: &'f dyn Fn(i64) -> f64,
    pub(super) from: &'f dyn Fn(f64) -> i64,
    pub(super) try_from: &'f dyn Fn(f64) -> Option<i64>,
}

/// That every raw number comes back from its value, and that nothing else passes the ends of the range.
#[allow(clippy::cast_precision_loss, reason = "raw numbers have 32 bits at most")]
pub(super) fn check_quantity(quantity: &Quantity<'_>) {
    let (least, most) = quantity.limits;
    let returns = |raw: i64| {
        let value = (quantity.get)(raw);
        assert_eq!((quantity.from)(value), raw, "{value}");
        assert_eq!((quantity.try_from)(value), Some(raw), "{value}");
    };
    if most - least < 1 << 16 {
        (least..=most).for_each(returns);
    } else {
        let powers = (0..31).flat_map(|shift| [1 << shift, -(1 << shift), (1 << shift) - 1]);
        powers.chain([least, least + 1, most - 1, most]).for_each(returns);
        proptest!(|(raw in RangeInclusive::new(least, most))| returns(raw));
    }

    let beyond = |raw: i64, steps: f64| (raw as f64 + steps) * quantity.step;
    for (value, nearest) in [
        (f64::INFINITY, most),
        (f64::NEG_INFINITY, least),
        (f64::MAX, most),
        (f64::MIN, least),
        (beyond(most, 0.75), most),
        (beyond(least, -0.75), least),
        (f64::NAN, 0),
    ] {
        assert_eq!((quantity.from)(value), nearest, "{value}");
        assert_eq!((quantity.try_from)(value), None, "{value}");
    }
    for (value, nearest) in [(beyond(most, 0.25), most), (beyond(least, -0.25), least)] {
        assert_eq!((quantity.from)(value), nearest, "{value}");
        assert_eq!((quantity.try_from)(value), Some(nearest), "{value}");
    }
}

#[test]
fn values_between_two_steps_go_to_the_nearest_and_halves_away_from_zero() {
    // A step is 45/2048 degrees, which a float holds.
    let step = Angle(1).degrees();
    for (steps, raw) in [
        (0.0, 0),
        (-0.0, 0),
        (0.25, 0),
        (-0.25, 0),
        (0.5, 1),
        (-0.5, -1),
        (0.75, 1),
        (-0.75, -1),
        (1.5, 2),
        (-1.5, -2),
        (2.5, 3),
        (-2.5, -3),
        (32766.5, 32767),
        (32767.25, 32767),
        (-32767.5, -32768),
        (-32768.0, -32768),
        (-32768.25, -32768),
    ] {
        assert_eq!(Angle::from_degrees(steps * step), Angle(raw), "{steps}");
        assert_eq!(Angle::try_from_degrees(steps * step), Ok(Angle(raw)), "{steps}");
    }
    for steps in [32767.5, 32768.0, -32768.5, -32769.0, f32::NAN] {
        let error = Angle::try_from_degrees(steps * step).unwrap_err();
        assert_eq!(error.to_string(), "out of range; expected -720 to 719.978 deg", "{steps}");
    }
}

#[test]
fn unsigned_quantities_begin_at_zero() {
    for (volts, raw) in [(0.0, Ok(0)), (-0.004, Ok(0)), (-0.006, Err(())), (-12.0, Err(()))] {
        assert_eq!(Voltage::try_from_volts(volts).map_err(drop), raw.map(Voltage), "{volts}");
        assert_eq!(Voltage::from_volts(volts), Voltage(0), "{volts}");
    }
    assert_eq!(Voltage::try_from_volts(655.35), Ok(Voltage(u16::MAX)));
    let error = Voltage::try_from_volts(655.36).unwrap_err();
    assert_eq!(error.to_string(), "out of range; expected 0 to 655.35 V");
    assert_eq!(Voltage::from_volts(1e9), Voltage(u16::MAX));
}

#[test]
fn angles_of_encoders_go_round() {
    for raw in (0..1 << 24).step_by(4099).chain([1, (1 << 24) - 1]) {
        let angle = EncoderAngle(raw.try_into().unwrap());
        assert_eq!(EncoderAngle::from_degrees(angle.degrees()), angle);
    }
    for (degrees, same) in [(-90.0, 270.0), (720.0, 0.0), (-0.0, 0.0), (359.999_999_9, 0.0), (-1e-9, 0.0)] {
        assert_eq!(EncoderAngle::from_degrees(degrees), EncoderAngle::from_degrees(same), "{degrees}");
    }
    for degrees in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(EncoderAngle::from_degrees(degrees), EncoderAngle::default(), "{degrees}");
    }
}

#[test]
fn versions_are_read_as_they_are_shown() {
    for raw in 0..=u16::MAX {
        let version = FirmwareVersion(raw);
        assert_eq!(version.to_string().parse(), Ok(version), "{raw}");
        let (major, minor, last) = version.parts();
        assert_eq!(FirmwareVersion::new(major, minor, last), version);
    }
    for text in
        ["", "2", "2.", ".7", "2.100", "2.70b10", "2.70.", "65.53.6", "66.00", "-2.70", "2.7x", "+2.70"]
    {
        let error = text.parse::<FirmwareVersion>().unwrap_err();
        assert!(error.to_string().contains("invalid firmware version"), "{text}");
    }
    assert_eq!(FirmwareVersion::new(66, 0, 0), FirmwareVersion(u16::MAX));
    assert_eq!(FirmwareVersion::new(u16::MAX, u16::MAX, u16::MAX), FirmwareVersion(u16::MAX));
}
