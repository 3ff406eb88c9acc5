//! Control by quaternion: what `CMD_CONTROL_QUAT` and its configuration have said.

use std::time::Duration;

use sbgc_proto::commands::{ControlQuatFlags, ControlQuatMode};
use sbgc_proto::wire::{PerAxis, PerXyz};

/// After this time a task that cannot finish ends.
pub(super) const TASK_TIMEOUT: Duration = Duration::from_secs(10);

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct QuatControl {
    pub(super) mode: ControlQuatMode,
    pub(super) flags: ControlQuatFlags,
    /// The attitude that it should have, as angles in degrees.
    pub(super) target: Option<PerAxis<f64>>,
    /// The speed about X, Y and Z in degrees per second.
    pub(super) speed: PerXyz<f64>,
    /// The port that is told when the target is reached, and since when it waits.
    pub(super) task: Option<(u8, Duration)>,
    /// Limits that the configuration has set, in degrees per second and per second squared.
    pub(super) max_speed: Option<PerXyz<f64>>,
    pub(super) acceleration: Option<PerXyz<f64>>,
    /// The time in which an acceleration builds up, in seconds.
    pub(super) jerk_time: Option<PerXyz<f64>>,
    /// The time constants of its filters, in seconds.
    pub(super) attitude_filter: Option<f64>,
    pub(super) speed_filter: Option<f64>,
}

impl QuatControl {
    /// Ends it; its configuration stays.
    pub(super) fn stop(&mut self) {
        *self = Self {
            max_speed: self.max_speed,
            acceleration: self.acceleration,
            jerk_time: self.jerk_time,
            attitude_filter: self.attitude_filter,
            speed_filter: self.speed_filter,
            ..Self::default()
        };
    }
}
