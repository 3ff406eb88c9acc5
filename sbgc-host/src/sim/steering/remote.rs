//! What a signal of remote control, or the frame in follow mode, makes an axis do.

use sbgc_proto::commands::{ProfileFlags2, RcAxis, RcMode};

use super::super::motion::{Axis, Goal};
use super::super::parameters::Settings;

pub(super) fn rc_axis(index: usize, settings: &Settings) -> RcAxis {
    settings.params.rc.into_array().get(index).copied().unwrap_or_default()
}

fn is_split(settings: &Settings) -> bool {
    settings.ext3.profile_flags2.contains(ProfileFlags2::RC_EXPO_DEADBAND_SPLIT)
}

pub(super) fn expo_rate(index: usize, settings: &Settings) -> u8 {
    match index {
        1 if is_split(settings) => settings.ext3.rc_expo_rate_pitch,
        2 if is_split(settings) => settings.ext3.rc_expo_rate_yaw,
        _ => settings.params.rc_expo_rate,
    }
}

fn dead_band(index: usize, settings: &Settings) -> f64 {
    f64::from(match index {
        1 if is_split(settings) => settings.ext3.rc_deadband_pitch,
        2 if is_split(settings) => settings.ext3.rc_deadband_yaw,
        _ => settings.params.rc_deadband,
    }) / 500.0
}

/// What a signal makes an axis do.
pub(super) fn rc_goal(
    index: usize,
    settings: &Settings,
    axis: &Axis,
    signal: f64,
    speed: Option<f64>,
    force_speed: bool,
    expo: u8,
) -> Goal {
    let rc = rc_axis(index, settings);
    let trim = settings.params.rc_trim.into_array().get(index).copied().unwrap_or_default();
    let mut signal = signal;
    if !force_speed {
        signal += f64::from(trim) / 500.0;
        let band = dead_band(index, settings).min(0.99);
        signal =
            if signal.abs() <= band { 0.0 } else { (signal.abs() - band) / (1.0 - band) * signal.signum() };
        if rc.rc_mode.inverted() {
            signal = -signal;
        }
    }
    let signal = signal.clamp(-1.0, 1.0);
    let signal = bend(signal, expo);
    if force_speed || rc.rc_mode.mode() == RcMode::Speed {
        return Goal::Speed(signal * speed.unwrap_or(axis.limits.speed));
    }
    let (least, most) = (f64::from(rc.rc_min_angle), f64::from(rc.rc_max_angle));
    Goal::Angle { angle: least + (most - least) * (signal + 1.0) / 2.0, speed }
}

/// How fast the set-point follows the frame.
///
/// What the parameters do exactly is not published. Here it follows with `FOLLOW_SPEED` / 50 degrees per second for each
/// degree beyond the dead band of 0.1 degrees per step, and the curve lowers that within `FOLLOW_RANGE`.
pub(super) fn follow_speed(index: usize, settings: &Settings, axis: &Axis, frame: f64) -> f64 {
    let params = &settings.params;
    let at = |values: [u8; 3]| f64::from(values.get(index).copied().unwrap_or_default());
    let offset = params.follow_offset.into_array().get(index).copied().unwrap_or_default();
    let rate = at(params.follow_speed.into_array()) / 50.0;
    let range = at(settings.ext2.follow_range.into_array()).max(1.0);
    let error = frame + f64::from(offset) - axis.setpoint;
    let beyond = (error.abs() - f64::from(params.follow_deadband) * 0.1).max(0.0);
    let share = bend((beyond / range).min(1.0), params.follow_expo_rate);
    (share * range + (beyond - range).max(0.0)) * rate * error.signum()
}

/// A curve that lowers what is between 0 and full scale.
fn bend(signal: f64, expo: u8) -> f64 {
    let bend = f64::from(expo.min(100)) / 100.0;
    signal * (1.0 - bend + bend * signal * signal)
}
