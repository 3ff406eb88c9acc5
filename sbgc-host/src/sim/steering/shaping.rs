//! What configurations say of the motion of an axis besides the parameters: limits and low-pass filters.
//!
//! What the filters do exactly is not published. Here they are of first order, and their time grows with the square of
//! the number that is configured: 8 ms for 1, 1.8 s for 15. The extended range has finer steps up to the same time.

use std::f64::consts::TAU;

use sbgc_proto::commands::{ControlAxisConfig, ControlConfigFlags};
use sbgc_proto::units::JerkSlope;

/// What was configured for one axis; what is `None` the parameters say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::sim) struct Shaping {
    /// In degrees per second squared; 0 for no limit.
    pub(in crate::sim) acceleration: Option<f64>,
    /// The time in which an acceleration builds up, in seconds; 0 for none.
    pub(in crate::sim) jerk_time: Option<f64>,
    /// The time constants of the filters in seconds; 0 for none.
    pub(in crate::sim) angle_filter: Option<f64>,
    pub(in crate::sim) speed_filter: Option<f64>,
    pub(in crate::sim) rc_filter: Option<f64>,
}

impl Shaping {
    /// This, and what it does not say from `other`.
    pub(super) fn or(self, other: Self) -> Self {
        Self {
            acceleration: self.acceleration.or(other.acceleration),
            jerk_time: self.jerk_time.or(other.jerk_time),
            angle_filter: self.angle_filter.or(other.angle_filter),
            speed_filter: self.speed_filter.or(other.speed_filter),
            rc_filter: self.rc_filter.or(other.rc_filter),
        }
    }

    /// Whether values change by themselves, without a new command.
    pub(super) fn is_filtering(self) -> bool {
        self.angle_filter.or(self.speed_filter).is_some()
    }

    /// Takes in what `CMD_CONTROL_CONFIG` says of an axis; zeros change nothing.
    pub(super) fn configure(&mut self, config: ControlAxisConfig, flags: ControlConfigFlags) {
        let time = |value: u8| {
            if flags.contains(ControlConfigFlags::LPF_FREQUENCY_HZ) {
                cutoff_time(value.into())
            } else {
                lpf_time(value, flags.contains(ControlConfigFlags::LPF_EXT_RANGE))
            }
        };
        let given = |value: u8| (value > 0).then(|| time(value));
        let told = Self {
            acceleration: (config.acc_limit > 0).then(|| config.acc_limit.into()),
            jerk_time: match config.jerk_slope {
                JerkSlope::UNCHANGED => None,
                JerkSlope::OFF => Some(0.0),
                slope => Some(f64::from(slope.milliseconds()) / 1000.0),
            },
            angle_filter: given(config.angle_lpf),
            speed_filter: given(config.speed_lpf),
            rc_filter: given(config.rc_lpf),
        };
        *self = told.or(*self);
    }
}

/// The time constant of a filter by its number, in seconds.
pub(super) fn lpf_time(value: u8, extended: bool) -> f64 {
    let steps = if extended { f64::from(value) * 15.0 / 255.0 } else { f64::from(value.min(15)) };
    0.008 * steps * steps
}

/// The time constant of a filter by its cutoff frequency in Hz; 0 for none.
pub(in crate::sim) fn cutoff_time(frequency: f64) -> f64 {
    if frequency > 0.0 { 1.0 / (TAU * frequency) } else { 0.0 }
}

/// A step of a low-pass filter with a time constant in seconds.
pub(super) fn filter(before: Option<f64>, wanted: f64, time: f64, seconds: f64) -> f64 {
    let Some(before) = before.filter(|_| time > 0.0) else { return wanted };
    let next = before + (wanted - before) * (1.0 - (-seconds / time).exp());
    if (next - wanted).abs() < 1e-4 { wanted } else { next }
}
