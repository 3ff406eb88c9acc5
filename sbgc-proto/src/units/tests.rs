//! Quantities at the ends of their ranges, between two steps, and over all raw numbers.

use std::ops::RangeInclusive;

use proptest::prelude::*;

use super::*;

/// What the tests of all quantities need to know of one.
pub(super) struct Quantity<'f> {
    pub(super) limits: (i64, i64),
    pub(super) step: f64,
    pub(super) get: &'f dyn Fn(i64) -> f64,
    /// What `get` should be: the value in double precision, rounded once.
    pub(super) nearest: &'f dyn Fn(i64) -> f64,
    pub(super) from: &'f dyn Fn(f64) -> i64,
    pub(super) try_from: &'f dyn Fn(f64) -> Option<i64>,
}

/// That every raw number comes back from its value, and that nothing else passes the ends of the range.
#[allow(clippy::cast_precision_loss, reason = "raw numbers have 32 bits at most")]
pub(super) fn check_quantity(quantity: &Quantity<'_>) {
    let (least, most) = quantity.limits;
    let returns = |raw: i64| {
        let value = (quantity.get)(raw);
        assert_eq!(value.to_bits(), (quantity.nearest)(raw).to_bits(), "{raw}");
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

/// What the tests of whole numbers need to know of a quantity.
pub(super) struct WholeQuantity<'f> {
    pub(super) limits: (i64, i64),
    /// Value of a step as a fraction.
    pub(super) scale: (i64, i64),
    pub(super) get: &'f dyn Fn(i64) -> i32,
    pub(super) from: &'f dyn Fn(i32) -> i64,
}

/// That whole numbers are the nearest in both directions, and saturate.
pub(super) fn check_whole(quantity: &WholeQuantity<'_>) {
    let (least, most) = quantity.limits;
    let (multiply, divide) = quantity.scale;
    let nearest = |number: i64, multiply: i64, divide: i64| {
        let (product, divide) = (2 * i128::from(number) * i128::from(multiply), i128::from(divide));
        let rounded = (product.abs() + divide) / (2 * divide) * product.signum();
        i64::try_from(rounded).unwrap()
    };
    let check_value = |raw: i64| {
        assert_eq!(i64::from((quantity.get)(raw)), nearest(raw, multiply, divide), "{raw}");
    };
    let check_raw = |value: i32| {
        let raw = nearest(value.into(), divide, multiply).clamp(least, most);
        assert_eq!((quantity.from)(value), raw, "{value}");
    };
    let ends = [least, least + 1, -1, 0, 1, most - 1, most];
    ends.into_iter().filter(|raw| (least..=most).contains(raw)).for_each(check_value);
    for value in [i32::MIN, -360_001, -180, -1, 0, 1, 45, 180, 360, 720, 1000, 360_001, i32::MAX] {
        check_raw(value);
    }
    proptest!(|(raw in RangeInclusive::new(least, most), near in -800_000..800_000, any in any::<i32>())| {
        check_value(raw);
        check_raw(near);
        check_raw(any);
    });
}

#[test]
fn conversions_are_constants() {
    const DOWN: Angle = Angle::from_degrees(-45.0);
    const FAST: ControlRate = ControlRate::from_whole_degrees_per_second(30);
    const LEVEL: f32 = DOWN.degrees();
    assert_eq!((DOWN, LEVEL, FAST), (Angle(-2048), -45.0, ControlRate::from_degrees_per_second(30.0)));
    assert_eq!(Angle::from_whole_degrees(i32::MAX), Angle(i16::MAX));
    assert_eq!(Angle::from_millidegrees(-500).millidegrees(), -505);
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
        (0.499_999_97, 0),
        (-0.499_999_97, 0),
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
fn angles_of_encoders_in_whole_numbers() {
    for raw in (0..1 << 24).step_by(997).chain([1, (1 << 24) - 1]) {
        let angle = EncoderAngle(raw.try_into().unwrap());
        let degrees = angle.degrees();
        assert!((f64::from(angle.whole_degrees()) - degrees).abs() <= 0.5, "{raw}");
        assert!((f64::from(angle.millidegrees()) - degrees * 1000.0).abs() <= 0.5, "{raw}");
    }
    for (degrees, raw) in [(90, 1 << 22), (-90, 3 << 22), (720, 0), (i32::MAX, 127 * (1 << 24) / 360)] {
        let angle = EncoderAngle::from_whole_degrees(degrees);
        assert!(angle.0.get().abs_diff(raw) <= 1, "{degrees}");
    }
    for millidegrees in (0..360_000).step_by(37) {
        let angle = EncoderAngle::from_millidegrees(millidegrees);
        assert_eq!(angle, EncoderAngle::from_degrees(f64::from(millidegrees) / 1000.0), "{millidegrees}");
        assert_eq!(angle.millidegrees(), millidegrees);
    }
    assert_eq!(EncoderAngle::from_millidegrees(-90_000), EncoderAngle::from_degrees(270.0));
}

#[test]
fn curves_go_through_their_formulas() {
    let logarithmic = |raw: f64| 5.0 * (raw * 52_f64.ln() / 255.0).exp() - 5.0;
    for raw in 0..=255 {
        let number = f64::from(raw);
        for (value, expected) in [
            (PidTerm(raw).logarithmic(), logarithmic(number)),
            (PidGain(raw).gain(), 0.1 + number * 0.02),
            (PidGain(raw).logarithmic(), logarithmic(number)),
            (PidGain(raw).centered(), 50_f64.powf((number - 1.0) / 127.0) / 50.0),
            (InverseQuality(raw).inverse_quality(), 0.2 + number * 0.02),
            (ServoFactor(raw).factor(), 0.1 * (number * 500_f64.ln() / 255.0).exp()),
            (ServoTerm(raw).term(), logarithmic(number)),
            (ShakeFrequency(raw).hertz(), 0.3 + number * 0.05),
            (ShakeResonance(raw).hertz(), 0.3 + number * 0.1),
            (ShakeRange(raw).multiple(), 1.5 + number * 0.1),
            (ShakePause(raw).milliseconds(), 500.0 + number * 20.0),
        ] {
            assert!(
                (f64::from(value) - expected).abs() <= expected.abs() * 1e-7,
                "{raw}: {value} {expected}"
            );
        }
        assert_eq!(PidTerm::from_logarithmic(PidTerm(raw).logarithmic()), PidTerm(raw));
        assert_eq!(PidGain::from_gain(PidGain(raw).gain()), PidGain(raw));
        assert_eq!(PidGain::from_centered(PidGain(raw).centered()), PidGain(raw));
        assert_eq!(ServoFactor::from_factor(ServoFactor(raw).factor()), ServoFactor(raw));
        assert_eq!(ShakePause::from_milliseconds(ShakePause(raw).milliseconds()), ShakePause(raw));
    }
    for (value, raw) in [(f32::NEG_INFINITY, 0), (-1.0, 0), (1e9, 255), (f32::INFINITY, 255), (f32::NAN, 0)] {
        assert_eq!(PidTerm::from_logarithmic(value), PidTerm(raw), "{value}");
        assert_eq!(PidGain::from_gain(value), PidGain(raw), "{value}");
    }
    assert_eq!(
        (ShakePause::from_milliseconds(509.0), ShakePause::from_milliseconds(511.0)),
        (ShakePause(0), ShakePause(1))
    );
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
