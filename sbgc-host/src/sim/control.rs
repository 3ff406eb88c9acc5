//! What `CMD_CONTROL` has told the board, and until when it holds.
//!
//! Real: the modes, the speed of each axis or its own, the second confirmation when all axes with AUTO_TASK are within
//! a degree of their angles, the timeout, the flag against confirmations, and that 15 zero bytes undo everything.
//!
//! Simplified: speed with angle goes to the angle with at most that speed, instead of following both; angles are the
//! same against the frame and the ground, since the frame is level; remote control is a straight line from the signal
//! to the angle or speed of the parameters, without dead band, curve and filter; MIX_FOLLOW and TARGET_PRECISE change
//! nothing; filters, priorities and jerk slopes of `CMD_CONTROL_CONFIG` are taken and not used.

use std::time::Duration;

use sbgc_proto::commands::{
    Control, ControlAxis, ControlConfig, ControlConfigFlags, ControlMode, ControlModeKind, RcAxis, RcMode,
};
use sbgc_proto::units::{Angle, LongAngle};
use sbgc_proto::wire::PerAxis;

use super::answers::Refusal;
use super::motion::{Axis, Goal, Motion};

#[derive(Debug, Default)]
pub(super) struct Steering {
    timeout: Option<Duration>,
    no_confirm: bool,
    /// When the last command came, if one is in force.
    since: Option<Duration>,
    /// The axes whose angles are to be reported once they are reached.
    task: Option<PerAxis<bool>>,
}

impl Steering {
    /// Takes a command in; true if it is to be confirmed.
    pub(super) fn control(
        &mut self,
        now: Duration,
        command: &Control,
        rc: Option<PerAxis<RcAxis>>,
        motion: &mut Motion,
    ) -> Result<bool, Refusal> {
        let confirmed = !self.no_confirm;
        if *command == Control::release() {
            *self = Self::default();
            release(motion);
            return Ok(confirmed);
        }
        let rc = rc.map_or([None; 3], |rc| rc.map(Some).into_array());
        let modes = command.control_mode.into_array();
        let mut goals = [None; 3];
        let told = modes.into_iter().zip(command.axes.into_array()).zip(motion.axes().into_array()).zip(rc);
        for (place, (((mode, told), axis), rc)) in goals.iter_mut().zip(told) {
            *place = goal(mode, told, &axis, rc)?;
        }
        for (axis, goal) in motion.each_mut().into_iter().zip(goals) {
            if let Some(goal) = goal.filter(|_| axis.present) {
                axis.goal = goal;
            }
        }
        let tasks = command.control_mode.map(|mode| {
            let by_angle = matches!(
                mode.kind(),
                ControlModeKind::Angle | ControlModeKind::AngleRelFrame | ControlModeKind::AngleShortest
            );
            by_angle && mode.auto_task()
        });
        self.task = tasks.into_array().contains(&true).then_some(tasks);
        self.since = Some(now);
        Ok(confirmed)
    }

    pub(super) fn configure(&mut self, now: Duration, config: &ControlConfig, motion: &mut Motion) {
        self.timeout = (config.timeout_ms > 0).then(|| Duration::from_millis(config.timeout_ms.into()));
        self.no_confirm = config.flags.contains(ControlConfigFlags::NO_CONFIRM);
        if self.since.is_some() {
            self.since = Some(now);
        }
        for (axis, config) in motion.each_mut().into_iter().zip(config.axes.into_array()) {
            if config.acc_limit > 0 {
                axis.limits.acceleration = config.acc_limit.into();
            }
        }
    }

    /// Whether it waits for something.
    pub(super) fn is_waiting(&self) -> bool {
        self.task.is_some() || (self.timeout.is_some() && self.since.is_some())
    }

    /// Ends what has come to its end; true if the angles have been reached that were to be reported.
    pub(super) fn poll(&mut self, now: Duration, motion: &mut Motion) -> bool {
        let expired =
            |since: Duration| self.timeout.is_some_and(|timeout| now.saturating_sub(since) >= timeout);
        if self.since.is_some_and(expired) {
            self.since = None;
            self.task = None;
            release(motion);
        }
        let reached = self.task.is_some_and(|axes| motion.commands_reached(axes));
        if reached {
            self.task = None;
        }
        reached
    }
}

fn release(motion: &mut Motion) {
    for axis in motion.each_mut() {
        axis.goal = Goal::Rest;
    }
}

/// What a command tells an axis; nothing if it is to go on as before.
fn goal(
    mode: ControlMode,
    told: ControlAxis,
    axis: &Axis,
    rc: Option<RcAxis>,
) -> Result<Option<Goal>, Refusal> {
    let told_speed = f64::from(told.speed_in(mode));
    let speed = (told_speed != 0.0).then_some(told_speed.abs());
    let goal = match mode.kind() {
        ControlModeKind::NoControl => Goal::Rest,
        ControlModeKind::Ignore => return Ok(None),
        ControlModeKind::Speed => Goal::Speed(told_speed),
        ControlModeKind::Angle | ControlModeKind::SpeedAngle | ControlModeKind::AngleRelFrame => {
            Goal::Angle { angle: unwrapped(told.angle, axis), speed }
        }
        ControlModeKind::AngleShortest => {
            let way = f64::from(told.angle.degrees()) - axis.angle;
            Goal::Angle { angle: axis.angle + (way + 180.0).rem_euclid(360.0) - 180.0, speed }
        }
        ControlModeKind::Rc => remote(f64::from(told.as_rc_signal().0) / 500.0, mode, speed, axis, rc),
        ControlModeKind::RcHighRes => {
            remote(f64::from(told.as_high_res_rc_signal().0) / 16384.0, mode, speed, axis, rc)
        }
        ControlModeKind::Unknown(_) => return Err(Refusal::Parameters),
    };
    Ok(Some(goal))
}

/// An angle of the wire, in the four turns that the axis is in.
fn unwrapped(angle: Angle, axis: &Axis) -> f64 {
    let wrapped = LongAngle(i32::from(axis.wire_angle().0)).degrees();
    axis.long_angle().degrees() - wrapped + f64::from(angle.degrees())
}

/// What a signal from -1 to 1 tells an axis.
fn remote(signal: f64, mode: ControlMode, speed: Option<f64>, axis: &Axis, rc: Option<RcAxis>) -> Goal {
    let Some(rc) = rc else { return Goal::Rest };
    let signal = signal.clamp(-1.0, 1.0) * if rc.rc_mode.inverted() { -1.0 } else { 1.0 };
    if mode.force_rc_speed() || rc.rc_mode.mode() == RcMode::Speed {
        return Goal::Speed(signal * speed.unwrap_or(axis.limits.speed));
    }
    let (least, most) = (f64::from(rc.rc_min_angle), f64::from(rc.rc_max_angle));
    Goal::Angle { angle: least + (most - least) * (signal + 1.0) / 2.0, speed }
}
