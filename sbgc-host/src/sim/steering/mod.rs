//! What makes the axes move besides tasks of the board: serial control, remote control, and the frame in follow mode.
//!
//! Real: the modes of `CMD_CONTROL` per axis, a speed that is kept until told otherwise, the speed of the parameters
//! where none is given, special values of signals, dead band, trim, curve and inversion of remote control and what
//! skips them, filters, the second confirmation when all axes with AUTO_TASK are within a degree of their angles, the
//! time-out, priorities of ports, and that 15 zero bytes undo everything. Serial control goes before remote control.
//!
//! Not simulated: MIX_FOLLOW, TARGET_PRECISE and the order of Euler angles are taken and change nothing, since nothing
//! but their names is published.

mod remote;
mod shaping;

use std::collections::BTreeMap;
use std::time::Duration;

use sbgc_proto::commands::{
    ControlConfig, ControlConfigFlags, ControlMode, ControlModeKind, FollowMode, GeneralFlags2,
};
use sbgc_proto::units::ControlRate;

use super::motion::{Axis, Goal, Limits, Motion};
use super::parameters::Settings;
use super::rc::{RcInputs, coarse, high_res};
use remote::{expo_rate, follow_speed, rc_axis, rc_goal};
pub(super) use shaping::{Shaping, cutoff_time};
use shaping::{filter, lpf_time};

/// What one command says to one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Order {
    pub(super) mode: ControlMode,
    /// In degrees per second, if the command has it.
    pub(super) speed: Option<f64>,
    /// In degrees, if the command has it.
    pub(super) angle: Option<f64>,
    /// The number that stands for a signal in the modes of remote control.
    pub(super) signal: i16,
    /// What holds for the axis as long as this order does.
    pub(super) shaping: Shaping,
}

/// What serial control has told an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Told {
    Goal(Goal, Option<Task>),
    Rc { signal: Option<f64>, speed: Option<f64>, force_speed: bool },
}

/// An angle that is to be reported.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Task;

#[derive(Debug, Default)]
#[allow(clippy::struct_excessive_bools, reason = "each stands for itself")]
pub(super) struct Steering {
    told: [Option<Told>; 3],
    /// Whether an axis was driven by any source in the last look.
    driven: [bool; 3],
    /// The filtered signals of remote control.
    filtered: [Option<f64>; 3],
    /// The filtered speeds of following.
    followed: [Option<f64>; 3],
    /// The filtered angle and speed of serial control.
    smooth: [Option<(f64, f64)>; 3],
    last: Duration,
    timeout: Option<Duration>,
    no_confirm: bool,
    expo: Option<u8>,
    /// What `CMD_CONTROL_CONFIG` has set, and what came with the orders that hold.
    configured: [Shaping; 3],
    ordered: [Shaping; 3],
    /// By port.
    priorities: BTreeMap<u8, u8>,
    /// When the last command came, and on which port, if one is in force.
    since: Option<(Duration, u8)>,
    /// Whether angles are to be reported when they are reached.
    reporting: bool,
    /// Turned over by the menu.
    pub(super) follow_disabled: bool,
    pub(super) follow_forced: bool,
}

impl Steering {
    /// Whether commands are confirmed.
    pub(super) fn confirms(&self) -> bool {
        !self.no_confirm
    }

    /// Ends serial control and undoes its configuration.
    pub(super) fn finish(&mut self, reset: bool) {
        self.told = [None; 3];
        self.smooth = [None; 3];
        self.ordered = [Shaping::default(); 3];
        self.reporting = false;
        self.since = None;
        if reset {
            self.timeout = None;
            self.no_confirm = false;
            self.expo = None;
            self.configured = [Shaping::default(); 3];
            self.priorities.clear();
        }
    }

    /// The port that control comes from.
    pub(super) fn port(&self) -> u8 {
        self.since.map_or(0, |(_, port)| port)
    }

    /// Whether a command of this port is to be obeyed.
    pub(super) fn admits(&self, port: u8) -> bool {
        let priority = |port| self.priorities.get(&port).copied().unwrap_or_default();
        self.since.is_none_or(|(_, holder)| priority(port) >= priority(holder))
    }

    /// Takes in what a command says to the axes; `None` for an axis that it does not mention. False if one of the
    /// modes is not known, and nothing has changed then.
    pub(super) fn tell(
        &mut self,
        now: Duration,
        port: u8,
        orders: &[Option<Order>; 3],
        motion: &Motion,
    ) -> bool {
        let (mut told, mut ordered) = (self.told, self.ordered);
        for (index, order) in orders.iter().copied().enumerate() {
            let (Some(order), Some(place), Some(shaping)) =
                (order, told.get_mut(index), ordered.get_mut(index))
            else {
                continue;
            };
            let Some(axis) = motion.axes().into_array().get(index).copied() else { continue };
            let frame = motion.frame().into_array().get(index).copied().unwrap_or_default();
            match told_by(order, &axis, frame) {
                Some(Change::Keep) => {}
                Some(Change::Release) => {
                    *place = None;
                    *shaping = Shaping::default();
                }
                Some(Change::To(new)) => {
                    *shaping = order.shaping;
                    let kind = |told: &Option<Told>| told.as_ref().map(std::mem::discriminant);
                    if kind(place) != kind(&Some(new))
                        && let Some(smooth) = self.smooth.get_mut(index)
                    {
                        *smooth = None;
                    }
                    *place = Some(new);
                }
                None => return false,
            }
        }
        self.told = told;
        self.ordered = ordered;
        let is_task = |told: &Option<Told>| matches!(told, Some(Told::Goal(_, Some(Task))));
        self.reporting = self.told.iter().any(is_task);
        self.since = self.told.iter().any(Option::is_some).then_some((now, port));
        true
    }

    pub(super) fn configure(&mut self, now: Duration, port: u8, config: &ControlConfig) {
        self.timeout = (config.timeout_ms > 0).then(|| Duration::from_millis(config.timeout_ms.into()));
        self.no_confirm = config.flags.contains(ControlConfigFlags::NO_CONFIRM);
        if let Some((since, _)) = &mut self.since {
            *since = now;
        }
        let channels = [config.ch1_priority, config.ch2_priority, config.ch3_priority, config.ch4_priority];
        for (channel, priority) in (0..).zip(channels).chain([(port, config.this_ch_priority)]) {
            if priority > 0 {
                self.priorities.insert(channel, priority);
            }
        }
        if config.rc_expo_rate > 0 {
            self.expo = Some(config.rc_expo_rate);
        }
        for (shaping, axis) in self.configured.iter_mut().zip(config.axes.into_array()) {
            shaping.configure(axis, config.flags);
        }
    }

    /// What was configured for an axis.
    fn shaping(&self, index: usize) -> Shaping {
        let at = |all: &[Shaping; 3]| all.get(index).copied().unwrap_or_default();
        at(&self.ordered).or(at(&self.configured))
    }

    /// Whether something has to be looked at when the board next works through its queue.
    pub(super) fn is_busy(&self, settings: &Settings, rc: &RcInputs) -> bool {
        self.reporting
            || (self.timeout.is_some() && self.since.is_some())
            || self.driven.contains(&true) && !self.stands()
            || rc.moves(settings)
            || self.follows(settings).contains(&true)
    }

    /// Whether what drives the axes changes only by commands.
    fn stands(&self) -> bool {
        let fixed = |told: &Option<Told>| matches!(told, None | Some(Told::Goal(..)));
        self.told.iter().all(fixed) && !(0..3).any(|index| self.shaping(index).is_filtering())
    }

    fn follows(&self, settings: &Settings) -> [bool; 3] {
        let pitch = settings.params.follow_mode == FollowMode::Pitch;
        let yaw = settings.params.rc.yaw.rc_follow != 0;
        if self.follow_disabled {
            [false; 3]
        } else {
            [false, pitch || self.follow_forced, yaw || self.follow_forced]
        }
    }

    /// The axes that follow the frame.
    pub(super) fn following(&self, settings: &Settings) -> [bool; 3] {
        let told = self.told.map(|told| told.is_none()).into_iter();
        let mut follows = self.follows(settings);
        for (follow, free) in follows.iter_mut().zip(told) {
            *follow &= free;
        }
        follows
    }

    /// Lets all sources act on the axes. True if the angles have been reached that were to be reported.
    pub(super) fn poll(
        &mut self,
        now: Duration,
        settings: &Settings,
        rc: &RcInputs,
        held: bool,
        motion: &mut Motion,
    ) -> bool {
        let expired = |(since, _)| self.timeout.is_some_and(|timeout| now.saturating_sub(since) >= timeout);
        if self.since.is_some_and(expired) {
            self.finish(false);
        }
        let seconds = now.saturating_sub(self.last).as_secs_f64().min(0.1);
        self.last = now;
        let follows = self.following(settings);
        let frame = motion.frame().into_array();
        for (index, axis) in motion.each_mut().into_iter().enumerate() {
            let limits = limits(index, settings, self.shaping(index));
            axis.limits = limits;
            axis.task_acceleration = settings.ext2.auto_acc_limiter.degrees_per_second2().into();
            let goal = if held {
                None
            } else {
                let follow = follows.get(index) == Some(&true);
                let frame = frame.get(index).copied().unwrap_or_default();
                self.goal(index, settings, rc, axis, follow.then_some(frame), seconds)
            };
            let Some(driven) = self.driven.get_mut(index) else { continue };
            if axis.present {
                match goal {
                    Some(goal) => axis.goal = goal,
                    None if *driven => axis.goal = Goal::Rest,
                    None => {}
                }
            }
            *driven = goal.is_some();
        }
        let axes = motion.axes().into_array();
        let reached = self.told.iter().zip(axes).all(|(told, axis)| match told {
            Some(Told::Goal(goal, Some(Task))) => {
                !axis.present || axis.task.is_none() && axis.has_reached(*goal)
            }
            _ => true,
        });
        if self.reporting && reached {
            self.reporting = false;
            for told in &mut self.told {
                if let Some(Told::Goal(_, task)) = told {
                    *task = None;
                }
            }
            return true;
        }
        false
    }

    /// What an axis should do, if anything drives it.
    fn goal(
        &mut self,
        index: usize,
        settings: &Settings,
        rc: &RcInputs,
        axis: &mut Axis,
        follow: Option<f64>,
        seconds: f64,
    ) -> Option<Goal> {
        let shaping = self.shaping(index);
        let (signal, speed, force_speed) = match self.told.get(index).copied().flatten() {
            Some(Told::Goal(goal, task)) => {
                if task.is_some() {
                    axis.limits.acceleration = axis.task_acceleration;
                }
                let goal = auto_speed(goal, task, settings);
                return Some(self.smoothed(index, goal, shaping, axis, seconds));
            }
            Some(Told::Rc { signal, speed, force_speed }) => (signal, speed, force_speed),
            None => match (rc.of_axis(index, settings), follow) {
                (None, None) => return None,
                (None, Some(frame)) => {
                    let wanted = follow_speed(index, settings, axis, frame);
                    let lpf = settings.params.follow_lpf.into_array().get(index).copied();
                    let followed = self.followed.get_mut(index)?;
                    let time = lpf_time(lpf.unwrap_or_default(), is_extended(settings));
                    let speed = filter(*followed, wanted, time, seconds);
                    *followed = Some(speed);
                    return Some(Goal::Speed(speed));
                }
                (signal, _) => (signal, None, false),
            },
        };
        let own = || lpf_time(rc_axis(index, settings).rc_lpf, is_extended(settings));
        let time = shaping.rc_filter.unwrap_or_else(own);
        let Some(signal) = signal else {
            if let Some(filtered) = self.filtered.get_mut(index) {
                *filtered = None;
            }
            return Some(Goal::Rest);
        };
        let filtered = self.filtered.get_mut(index)?;
        let signal = filter(*filtered, signal, time, seconds);
        *filtered = Some(signal);
        let expo = self.expo.unwrap_or(expo_rate(index, settings));
        Some(rc_goal(index, settings, axis, signal, speed, force_speed, expo))
    }

    /// The goal of serial control, through the low-pass filters.
    fn smoothed(&mut self, index: usize, goal: Goal, shaping: Shaping, axis: &Axis, seconds: f64) -> Goal {
        let Some(smooth) = self.smooth.get_mut(index) else { return goal };
        let (angle, speed) = smooth.unwrap_or((axis.setpoint, axis.setpoint_speed));
        let angle_of =
            |wanted| filter(Some(angle), wanted, shaping.angle_filter.unwrap_or_default(), seconds);
        let speed_of =
            |wanted| filter(Some(speed), wanted, shaping.speed_filter.unwrap_or_default(), seconds);
        let (goal, now) = match goal {
            Goal::Angle { angle: wanted, speed: own } => {
                let angle = angle_of(wanted);
                (Goal::Angle { angle, speed: own }, (angle, speed))
            }
            Goal::Speed(wanted) => {
                let speed = speed_of(wanted);
                (Goal::Speed(speed), (angle, speed))
            }
            Goal::SpeedAngle { angle: wanted, speed: own } => {
                let (angle, speed) = (angle_of(wanted), speed_of(own));
                (Goal::SpeedAngle { angle, speed }, (angle, speed))
            }
            Goal::Rest => (Goal::Rest, (axis.setpoint, 0.0)),
        };
        *smooth = Some(now);
        goal
    }
}

/// What an order changes.
enum Change {
    Keep,
    Release,
    To(Told),
}

fn told_by(order: Order, axis: &Axis, frame: f64) -> Option<Change> {
    let told_speed = order.speed.unwrap_or_default();
    let speed = (told_speed != 0.0).then_some(told_speed.abs());
    let angle = order.angle.unwrap_or(axis.setpoint);
    let task = order.mode.auto_task().then_some(Task);
    let rc = |signal| Told::Rc { signal, speed, force_speed: order.mode.force_rc_speed() };
    let to_angle = |angle| Told::Goal(Goal::Angle { angle, speed }, task);
    Some(Change::To(match order.mode.kind() {
        ControlModeKind::NoControl => return Some(Change::Release),
        ControlModeKind::Ignore => return Some(Change::Keep),
        ControlModeKind::Speed => Told::Goal(Goal::Speed(told_speed), None),
        ControlModeKind::Angle => to_angle(unwrapped(angle, axis)),
        ControlModeKind::AngleRelFrame => to_angle(unwrapped(frame + angle, axis)),
        ControlModeKind::AngleShortest => {
            let way = angle - axis.setpoint;
            to_angle(axis.setpoint + (way + 180.0).rem_euclid(360.0) - 180.0)
        }
        ControlModeKind::SpeedAngle => {
            Told::Goal(Goal::SpeedAngle { speed: told_speed, angle: unwrapped(angle, axis) }, None)
        }
        ControlModeKind::Rc => rc(coarse(order.signal)),
        ControlModeKind::RcHighRes => rc(high_res(order.signal)),
        _ => return None,
    }))
}

/// The angle that is meant by a number that starts again after 720 degrees: the one that is nearest to the axis.
fn unwrapped(degrees: f64, axis: &Axis) -> f64 {
    const AROUND: f64 = 1440.0;
    if axis.setpoint.abs() <= AROUND / 2.0 {
        return degrees;
    }
    degrees + ((axis.setpoint - degrees) / AROUND).round() * AROUND
}

/// The speed of `RC_SPEED` and `AUTO_SPEED`, in degrees per second.
pub(super) fn speed_of(parameter: u8) -> f64 {
    ControlRate(i16::from(parameter) * 16).degrees_per_second().into()
}

fn auto_speed(goal: Goal, task: Option<Task>, settings: &Settings) -> Goal {
    match (goal, task) {
        (Goal::Angle { angle, speed: None }, Some(Task)) => {
            Goal::Angle { angle, speed: Some(speed_of(settings.ext2.auto_speed)) }
        }
        _ => goal,
    }
}

fn limits(index: usize, settings: &Settings, shaping: Shaping) -> Limits {
    let at = |values: [i16; 3]| values.get(index).copied().map(f64::from).unwrap_or_default();
    let least = at(settings.ext2.frame_cam_angle_min.into_array());
    let most = at(settings.ext2.frame_cam_angle_max.into_array());
    let own = settings.ext2.acc_limiter.into_array().get(index).copied().unwrap_or_default();
    let slope = settings.ext2.jerk_slope.into_array().get(index).copied().unwrap_or_default();
    Limits {
        speed: speed_of(rc_axis(index, settings).rc_speed),
        acceleration: shaping.acceleration.unwrap_or(own.degrees_per_second2().into()),
        jerk_time: shaping.jerk_time.unwrap_or(f64::from(slope) / 1000.0),
        range: (least < most).then_some((least, most)),
    }
}

/// Whether the numbers of filters in the parameters are those of the extended range.
fn is_extended(settings: &Settings) -> bool {
    settings.ext2.general_flags2.contains(GeneralFlags2::LPF_EXTENDED_RANGE)
}
