//! Battery, currents, temperatures, and the errors that follow from them.
//!
//! Real: no current flows through motors that are off; what moves needs more; below the alarm threshold of the
//! parameters the first low-battery error is set, below the other one the motors go off; an emergency stop turns the
//! motors off, tells why, and ends after `EMERGENCY_STOP_RESTART_DELAY` once its cause is gone.
//!
//! Simplified: the battery is full and does not empty until the fault `low-battery` makes it; then it loses 0.1 V each
//! second. Temperatures creep up to what they settle at.

use std::time::Duration;

use sbgc_proto::commands::{SystemErrors, SystemSubError};
use sbgc_proto::units::Voltage;

use super::motion::Motion;
use super::parameters::Settings;

/// A full battery of four cells.
const FULL: f64 = 16.4;

/// Resistance of the battery in ohms, and what the board itself needs in amperes.
const RESISTANCE: f64 = 0.06;
const OWN_CURRENT: f64 = 0.09;

/// What a motor needs to hold, and more for each degree per second.
const HOLDING: f64 = 0.18;
const PER_SPEED: f64 = 0.004;

/// The voltage that a fault takes each second.
const LOSS: f64 = 0.1;

#[derive(Debug)]
pub(super) struct Power {
    /// Since when the battery empties.
    empties_since: Option<Duration>,
    /// The cause of an emergency stop, and since when.
    stop: Option<(SystemSubError, Duration)>,
    /// What turned the motors off, for as long as it lasts.
    low: (bool, bool),
    /// Errors of the I2C bus and of serial lines.
    pub(super) i2c_errors: u16,
    pub(super) serial_errors: u16,
    /// How long and how hard the board has worked: seconds, and ampere seconds.
    worked: Duration,
    max_current: f64,
}

impl Power {
    pub(super) fn new() -> Self {
        Self {
            empties_since: None,
            stop: None,
            low: (false, false),
            i2c_errors: 0,
            serial_errors: 0,
            worked: Duration::ZERO,
            max_current: 0.0,
        }
    }

    /// Forgets errors, as a reset does; the battery stays as it is.
    pub(super) fn reset(&mut self) {
        self.stop = None;
        self.low = (false, false);
        self.i2c_errors = 0;
        self.serial_errors = 0;
    }

    /// Lets the battery empty from now on, or fills it.
    pub(super) fn empty(&mut self, since: Option<Duration>) {
        self.empties_since = since;
    }

    /// The current through a motor in amperes.
    pub(super) fn motor_current(motion: &Motion, index: usize) -> f64 {
        let axes = motion.axes().into_array();
        axes.get(index)
            .filter(|axis| motion.motors_on() && axis.present)
            .map_or(0.0, |axis| HOLDING + PER_SPEED * axis.speed.abs())
    }

    /// The whole current in amperes.
    pub(super) fn current(motion: &Motion) -> f64 {
        OWN_CURRENT + (0..3).map(|index| Self::motor_current(motion, index)).sum::<f64>()
    }

    pub(super) fn voltage(&self, now: Duration, motion: &Motion) -> f64 {
        let lost = self.empties_since.map_or(0.0, |since| now.saturating_sub(since).as_secs_f64() * LOSS);
        (FULL - lost - Self::current(motion) * RESISTANCE).max(6.0)
    }

    /// The voltage as the sensor shows it.
    pub(super) fn shown_voltage(&self, now: Duration, motion: &Motion, scale: u8) -> Voltage {
        #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
        let volts = (self.voltage(now, motion) * f64::from(scale) / 128.0) as f32;
        Voltage::from_volts(volts)
    }

    /// The temperature of the main IMU, and of the board.
    pub(super) fn temperatures(now: Duration) -> (i8, i8) {
        let warm = 1.0 - (-now.as_secs_f64() / 300.0).exp();
        #[allow(clippy::cast_possible_truncation, reason = "it is about 40")]
        let celsius = |start: f64, more: f64| (start + more * warm).round() as i8;
        (celsius(34.0, 4.0), celsius(36.0, 9.0))
    }

    pub(super) fn motor_temperature(motion: &Motion, index: usize) -> i8 {
        #[allow(clippy::cast_possible_truncation, reason = "it is about 40")]
        let more = (Self::motor_current(motion, index) * 20.0).round() as i8;
        30 + more
    }

    /// The emergency stop that is in force.
    pub(super) fn stop(&self) -> Option<SystemSubError> {
        self.stop.map(|(cause, _)| cause)
    }

    pub(super) fn set_stop(&mut self, now: Duration, cause: SystemSubError) {
        self.stop = Some((cause, now));
    }

    pub(super) fn end_stop(&mut self) {
        self.stop = None;
    }

    /// Whether an emergency stop has lasted as long as the parameters want.
    pub(super) fn stop_is_over(&self, now: Duration, settings: &Settings) -> bool {
        let delay = settings.ext2.emergency_stop_restart_delay;
        let over = |since: Duration| now.saturating_sub(since) >= Duration::from_millis(delay.into());
        delay > 0 && self.stop.is_some_and(|(_, since)| over(since))
    }

    /// Whether the battery is too low for the motors.
    pub(super) fn is_exhausted(&self) -> bool {
        self.low.1
    }

    /// Compares the battery with the thresholds; true if the motors have to go off now.
    pub(super) fn watch(&mut self, now: Duration, settings: &Settings, motion: &Motion, scale: u8) -> bool {
        self.max_current = self.max_current.max(Self::current(motion));
        self.worked = now;
        let shown = i32::from(self.shown_voltage(now, motion, scale).0);
        let below = |threshold: i16| threshold > 0 && shown < i32::from(threshold);
        let was_exhausted = self.low.1;
        self.low =
            (below(settings.params.bat_threshold_alarm.0), below(settings.params.bat_threshold_motors.0));
        self.low.1 && !was_exhausted
    }

    /// Whether something changes without a command.
    pub(super) fn is_changing(&self) -> bool {
        self.empties_since.is_some() || self.stop.is_some()
    }

    pub(super) fn errors(&self, sensor: bool) -> SystemErrors {
        let mut errors = SystemErrors::empty();
        errors.set(SystemErrors::NO_SENSOR, !sensor);
        errors.set(SystemErrors::LOW_BAT1, self.low.0);
        errors.set(SystemErrors::LOW_BAT2, self.low.1);
        errors.set(SystemErrors::EMERGENCY_STOP, self.stop.is_some());
        errors
    }

    /// How long it has worked, and the highest current in milliamperes.
    pub(super) fn statistics(&self) -> (u32, u16) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is a few amperes")]
        let most = (self.max_current * 1000.0) as u16;
        (u32::try_from(self.worked.as_secs()).unwrap_or(u32::MAX), most)
    }
}
