//! Physical quantities as types: the raw number of the wire with its unit and scale.
//!
//! Each holds the raw number, which stays reachable as field `0`, and converts to and from the physical value. From a
//! value, `from_…` goes to the nearest raw number and stops at the ends of the wire's range; `try_from_…` refuses what
//! is beyond them, and NaN. Both are `const`, and compute in the float type that they take: `f32` for raw numbers of
//! up to 16 bits, whose values it gives exactly as they would be rounded from more digits, `f64` for longer ones.
//!
//! Angles and rates also come in whole numbers of their unit or of a thousandth of it, for processors on which even an
//! `f32` is computed in software.
//!
//! ```
//! use sbgc_proto::units::Angle;
//!
//! assert_eq!(Angle::from_degrees(90.0), Angle(4096));
//! assert_eq!(Angle(-2048).degrees(), -45.0);
//! assert_eq!(Angle::from_whole_degrees(-45), Angle(-2048));
//! assert_eq!(Angle(1).millidegrees(), 22);
//! assert!(Angle::try_from_degrees(1000.0).is_err());
//! ```

mod curves;
mod encoder;
mod firmware;
mod packed_quaternion;
mod quantity;
#[cfg(test)]
mod tests;

pub use curves::{
    InverseQuality, PidGain, PidTerm, ServoFactor, ServoTerm, ShakeFrequency, ShakePause, ShakeRange,
    ShakeResonance,
};
pub use encoder::EncoderAngle;
pub use packed_quaternion::PackedQuaternion;

pub use crate::version::{FirmwareVersion, ParseVersionError};

use quantity::quantities;

quantities! {
    /// Angle in units of 1/16384 turn.
    Angle(i16): degrees / from_degrees / try_from_degrees -> f32, "deg", 360 / 16384, whole {
        whole_degrees / from_whole_degrees: 1, "deg";
        millidegrees / from_millidegrees: 1000, "thousandths of a deg";
    };

    /// Angle over several turns, in units of 1/16384 turn.
    LongAngle(i32): degrees / from_degrees / try_from_degrees -> f64, "deg", 360 / 16384, whole {
        whole_degrees / from_whole_degrees: 1, "deg";
    };

    /// High-resolution angle in units of 1/1048576 turn.
    FineAngle(i32): degrees / from_degrees / try_from_degrees -> f64, "deg", 360 / 1_048_576, whole {
        whole_degrees / from_whole_degrees: 1, "deg";
        millidegrees / from_millidegrees: 1000, "thousandths of a deg";
    };

    /// Distance to a limit, in units of 1/16384 turn.
    LimitDistance(i16): degrees / from_degrees / try_from_degrees -> f32, "deg", 360 / 16384, whole {
        whole_degrees / from_whole_degrees: 1, "deg";
        millidegrees / from_millidegrees: 1000, "thousandths of a deg";
    }, special {
        /// No limit, or unknown.
        UNKNOWN = 32767;
    };

    /// Period of a correction curve over one motor turn.
    CorrectionPeriod(u16): degrees / from_degrees / try_from_degrees -> f32, "deg", 1 / 1, special {
        /// Determined by the board.
        AUTO = 0;
    };

    /// Heading of the frame relative to North.
    FrameHeading(i16): degrees / from_degrees / try_from_degrees -> f32, "deg", 360 / 16384, whole {
        whole_degrees / from_whole_degrees: 1, "deg";
        millidegrees / from_millidegrees: 1000, "thousandths of a deg";
    }, special {
        /// Stops using the heading as a reference.
        STOP_REFERENCE = 32767;
    };

    /// Angular rate in control commands, in units of 0.1220740379 degrees per second.
    ControlRate(i16): degrees_per_second / from_degrees_per_second / try_from_degrees_per_second -> f32,
        "deg/s", 4000 / 32767, whole {
        whole_degrees_per_second / from_whole_degrees_per_second: 1, "deg/s";
        millidegrees_per_second / from_millidegrees_per_second: 1000, "thousandths of a deg/s";
    };

    /// Limit of the angular rate, in the unit of control commands.
    ControlRateLimit(u16): degrees_per_second / from_degrees_per_second / try_from_degrees_per_second -> f32,
        "deg/s", 4000 / 32767, whole {
        whole_degrees_per_second / from_whole_degrees_per_second: 1, "deg/s";
        millidegrees_per_second / from_millidegrees_per_second: 1000, "thousandths of a deg/s";
    };

    /// Angular rate in high-resolution control commands, in units of 0.001 degrees per second.
    FineControlRate(i16): degrees_per_second / from_degrees_per_second / try_from_degrees_per_second -> f32,
        "deg/s", 1 / 1000, whole {
        whole_degrees_per_second / from_whole_degrees_per_second: 1, "deg/s";
    };

    /// Angular rate reported by sensors, in units of 0.06103701895 degrees per second.
    SensorRate(i16): degrees_per_second / from_degrees_per_second / try_from_degrees_per_second -> f32,
        "deg/s", 2000 / 32767, whole {
        whole_degrees_per_second / from_whole_degrees_per_second: 1, "deg/s";
        millidegrees_per_second / from_millidegrees_per_second: 1000, "thousandths of a deg/s";
    };

    /// Angular rate in units of 0.001 degrees per second, in 32 bits.
    FineRate(i32): degrees_per_second / from_degrees_per_second / try_from_degrees_per_second -> f64,
        "deg/s", 1 / 1000, whole {
        whole_degrees_per_second / from_whole_degrees_per_second: 1, "deg/s";
    };

    /// Angular rate in units of 0.000001 radians per second.
    MicroRate(i32): radians_per_second / from_radians_per_second / try_from_radians_per_second -> f64,
        "rad/s", 1 / 1_000_000;

    /// Maximum speed of an auxiliary motor.
    MotorSpeedLimit(u16): degrees_per_second / from_degrees_per_second / try_from_degrees_per_second -> f32,
        "deg/s", 2 / 1;

    /// Maximum acceleration of an auxiliary motor.
    MotorAccelerationLimit(u16): degrees_per_second2 / from_degrees_per_second2 / try_from_degrees_per_second2
        -> f32, "deg/s^2", 2 / 1;

    /// Acceleration reported by sensors.
    Acceleration(i16): g / from_g / try_from_g -> f32, "g", 1 / 512;

    /// Peak acceleration, at low resolution.
    PeakAcceleration(u8): g / from_g / try_from_g -> f32, "g", 1 / 16;

    /// Limit of angular acceleration; 0 disables it.
    AccelerationLimit(u8): degrees_per_second2 / from_degrees_per_second2 / try_from_degrees_per_second2 -> f32,
        "deg/s^2", 5 / 1;

    /// Voltage.
    Voltage(u16): volts / from_volts / try_from_volts -> f32, "V", 1 / 100;

    /// Voltage threshold; a negative value disables it.
    VoltageThreshold(i16): volts / from_volts / try_from_volts -> f32, "V", 1 / 100;

    /// Attitude error.
    AttitudeError(u8): degrees / from_degrees / try_from_degrees -> f32, "deg", 1 / 10;

    /// Amplitude of the stabilization error.
    StabilizationError(u16): degrees / from_degrees / try_from_degrees -> f32, "deg", 1 / 1000;

    /// Interval between messages of a data stream.
    StreamInterval(u16): milliseconds / from_milliseconds / try_from_milliseconds -> f32, "ms", 1 / 1, special {
        /// Stops the stream.
        UNREGISTER = 0;
        /// Once per cycle of the firmware, 0.8 ms.
        EVERY_CYCLE = 1;
    };

    /// Repetition rate of servo outputs.
    ServoRate(u8): hertz / from_hertz / try_from_hertz -> f32, "Hz", 10 / 1;

    /// Sampling time of a calibration.
    CalibrationTime(u16): milliseconds / from_milliseconds / try_from_milliseconds -> f32, "ms", 1 / 1, special {
        /// Default of the board, about 4 s for the gyroscope.
        DEFAULT = 0;
    };

    /// Minimum frequency of a test.
    TestFrequencyFrom(u8): hertz / from_hertz / try_from_hertz -> f32, "Hz", 1 / 10;

    /// Maximum frequency of a test.
    TestFrequencyTo(u8): hertz / from_hertz / try_from_hertz -> f32, "Hz", 2 / 1;

    /// Angle of a test position, in units of 3 degrees.
    TestAngle(i8): degrees / from_degrees / try_from_degrees -> f32, "deg", 3 / 1;

    /// Gain margin.
    GainMargin(u8): decibels / from_decibels / try_from_decibels -> f32, "dB", 1 / 10;

    /// Jerk slope: time in which an acceleration builds up.
    JerkSlope(u8): milliseconds / from_milliseconds / try_from_milliseconds -> f32, "ms", 20 / 1, special {
        /// Leaves the current one unchanged.
        UNCHANGED = 0;
        /// Accelerations start immediately.
        OFF = 1;
    };

    /// Dead band of a gyroscope, in gyroscope units.
    GyroDeadband(u8): units / from_units / try_from_units -> f32, "gyro units", 1 / 10;

    /// Zero of a gyroscope, in gyroscope units.
    GyroZero(i16): units / from_units / try_from_units -> f32, "gyro units", 1 / 1000;

    /// RC signal at high resolution, -16384 to 16384.
    RcSignal(i16): fraction / from_fraction / try_from_fraction -> f32, "of full scale", 1 / 16384, special {
        /// No signal.
        UNDEFINED = -32768;
        /// No signal, in some messages of older firmware.
        UNDEFINED_OLD = -32767;
    };

    /// RC signal, nominally -500 to 500; slightly larger values are allowed.
    CoarseRcSignal(i16): fraction / from_fraction / try_from_fraction -> f32, "of full scale", 1 / 500, special {
        /// No signal.
        UNDEFINED = -10000;
    };

    /// Pulse time of a servo output; negative values release the pin.
    ServoTime(i16): microseconds / from_microseconds / try_from_microseconds -> f32, "us", 1 / 1, special {
        /// The pin floats.
        FLOATING = -1;
        /// The pin is held low.
        LOW = 0;
    };

    /// Time in samples of the sound generator.
    SoundTime(u8): milliseconds / from_milliseconds / try_from_milliseconds -> f32, "ms", 8 / 1;

    /// Frequency of a note; values above 21000 are pauses.
    NoteFrequency(u16): hertz / from_hertz / try_from_hertz -> f32, "Hz", 1 / 1, special {
        /// Restarts the envelope.
        RESTART = 21000;
    };

    /// Board version, such as 3.0 for raw 30. Some versions have a name.
    BoardVersion(u8): number / from_number / try_from_number -> f32, "", 1 / 10, names {
        /// Tiny rev. C with the GD32 processor.
        TINY_REV_C_GD32 = 25;
        /// Extended, long, with the GD32 processor.
        EXTENDED_LONG_GD32 = 27;
        /// Regular.
        REGULAR = 30;
        /// Tiny.
        TINY = 31;
        /// OEM.
        OEM = 34;
        /// Extended.
        EXTENDED = 36;
        /// Pro.
        PRO = 41;
        /// Controller of the CAN family.
        CAN_MCU = 50;
    };

    /// Version of a module on the CAN bus, such as 1.23 for raw 123.
    ModuleVersion(u16): number / from_number / try_from_number -> f32, "", 1 / 100;

    /// Size of the flash memory.
    FlashSize(u8): kibibytes / from_kibibytes / try_from_kibibytes -> f32, "KiB", 32 / 1;

    /// Offset in a file, in pages of 64 bytes.
    PageOffset(u16): bytes / from_bytes / try_from_bytes -> f32, "byte", 64 / 1;

    /// Center frequency of a notch filter.
    NotchFrequency(u8): hertz / from_hertz / try_from_hertz -> f32, "Hz", 2 / 1;

    /// Cut-off frequency of a filter for slow signals.
    SlowFilterFrequency(u16): hertz / from_hertz / try_from_hertz -> f32, "Hz", 1 / 100;

    /// Cut-off frequency of a filter for fast signals.
    FastFilterFrequency(u8): hertz / from_hertz / try_from_hertz -> f32, "Hz", 10 / 1;

    /// Time in units of 10 ms.
    ShortTime(u8): milliseconds / from_milliseconds / try_from_milliseconds -> f32, "ms", 10 / 1;

    /// Angle at low resolution.
    CoarseAngle(i8): degrees / from_degrees / try_from_degrees -> f32, "deg", 3 / 1;

    /// Gear ratio of a motor, as a fixed-point number with 8 fractional bits.
    Gearing(u16): ratio / from_ratio / try_from_ratio -> f32, "", 1 / 256;

    /// Gear ratio of an encoder, in thousandths.
    GearRatio(u16): ratio / from_ratio / try_from_ratio -> f32, "", 1 / 1000;

    /// Strength of the magnetic link between rotor and stator of a motor.
    MagneticLink(u16): strength / from_strength / try_from_strength -> f32, "", 1 / 100;

    /// Correction angle for the mounting of a sensor.
    CorrectionAngle(i16): degrees / from_degrees / try_from_degrees -> f32, "deg", 1 / 100, whole {
        whole_degrees / from_whole_degrees: 1, "deg";
        millidegrees / from_millidegrees: 1000, "thousandths of a deg";
    };

    /// Share of a duration.
    TimeShare(u8): percent / from_percent / try_from_percent -> f32, "%", 1 / 5;

    /// Dependence of a moment of inertia on the angle.
    Ellipticity(u8): factor / from_factor / try_from_factor -> f32, "", 1 / 20;

    /// Threshold of a control signal.
    SignalThreshold(i8): level / from_level / try_from_level -> f32, "", 1 / 10;

    /// Delay in units of 100 ms.
    Delay(u8): milliseconds / from_milliseconds / try_from_milliseconds -> f32, "ms", 100 / 1;

    /// Phase resistance of a motor.
    PhaseResistance(u8): milliohms / from_milliohms / try_from_milliohms -> f32, "mOhm", 100 / 1;

    /// Current limit.
    CurrentLimit(u16): milliamperes / from_milliamperes / try_from_milliamperes -> f32, "mA", 10 / 1;

    /// Current at which a protection trips.
    TripCurrent(u8): amperes / from_amperes / try_from_amperes -> f32, "A", 1 / 2;

    /// Width of a soft limit.
    LimitWidth(u8): degrees / from_degrees / try_from_degrees -> f32, "deg", 1 / 10;

    /// Gain of a resonance.
    ResonanceGain(u8): decibels / from_decibels / try_from_decibels -> f32, "dB", 1 / 5;

    /// Shunt resistance.
    ShuntResistance(u16): ohms / from_ohms / try_from_ohms -> f32, "Ohm", 1 / 100;
}

impl RcSignal {
    /// Fraction of full scale, -1 to 1; `None` if there is no signal.
    pub fn signal(self) -> Option<f32> {
        (self != Self::UNDEFINED && self != Self::UNDEFINED_OLD).then(|| self.fraction())
    }
}
