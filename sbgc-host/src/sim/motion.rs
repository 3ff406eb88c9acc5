//! How the camera turns.
//!
//! Real: each axis moves toward where it should be with limited speed and limited acceleration, in steps of the board's
//! control cycle; it hangs where it is while the motors are off; angles are kept over many turns and leave the board as
//! the 14-bit numbers of the protocol.
//!
//! Simplified: the frame stands still and level, so angles relative to it and to the ground are the same and the joints
//! have the angles of the camera. While the motors are on, the camera is exactly where the limiter has its target;
//! there is neither overshoot nor drift nor noise, and the axes do not disturb one another. An unbalanced camera does
//! not sag.

use std::time::Duration;

use sbgc_proto::units::{Angle, ControlRate, LongAngle, SensorRate};
use sbgc_proto::wire::PerAxis;

/// The time of one control cycle of the board.
pub const CYCLE: Duration = Duration::from_micros(800);

/// How near a target has to be to count as reached, in degrees.
const REACHED: f64 = 1.0;

/// Limits of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Speed in degrees a second.
    pub speed: f64,
    /// Acceleration in degrees a second, each second; 0 for no limit.
    pub acceleration: f64,
}

/// What an axis should do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Goal {
    /// Stand still where it comes to rest.
    #[default]
    Rest,
    /// Turn with this speed in degrees a second.
    Speed(f64),
    /// Go to an angle.
    Angle {
        /// The angle in degrees, over many turns.
        angle: f64,
        /// The speed to go there with in degrees a second; `None` for the axis's own.
        speed: Option<f64>,
    },
}

/// One axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Where it is, in degrees over many turns.
    pub angle: f64,
    /// How fast it turns, in degrees a second.
    pub speed: f64,
    /// What it was told by commands.
    pub goal: Goal,
    /// What a task of the board itself makes it do, which goes before commands.
    pub task: Option<Goal>,
    /// Limits where a command says nothing.
    pub limits: Limits,
    /// Whether there is a motor.
    pub present: bool,
}

impl Axis {
    fn step(&mut self, seconds: f64) {
        let target = self.task.unwrap_or(self.goal);
        let (wanted, end) = match target {
            Goal::Rest => (0.0, None),
            Goal::Speed(speed) => (speed, None),
            Goal::Angle { angle, speed } => {
                let way = angle - self.angle;
                let most = speed.unwrap_or(self.limits.speed).abs();
                // The speed that can be lost step by step on the way that is left.
                let braking = if self.limits.acceleration > 0.0 {
                    let half = self.limits.acceleration * seconds / 2.0;
                    (half * half + 2.0 * self.limits.acceleration * way.abs()).sqrt() - half
                } else {
                    f64::INFINITY
                };
                (most.min(braking).min(way.abs() / seconds).copysign(way), Some(angle))
            }
        };
        let change =
            if self.limits.acceleration > 0.0 { self.limits.acceleration * seconds } else { f64::INFINITY };
        self.speed += (wanted - self.speed).clamp(-change, change);
        self.angle += self.speed * seconds;
        let near = if change.is_finite() { change * seconds } else { 1e-6 };
        if let Some(end) = end
            && (end - self.angle).abs() <= near
            && self.speed.abs() <= 2.0 * change
        {
            self.angle = end;
            self.speed = 0.0;
        }
    }

    /// Whether it stands and nothing makes it move.
    fn is_settled(&self) -> bool {
        let there = match self.task.unwrap_or(self.goal) {
            Goal::Rest | Goal::Speed(0.0) => true,
            Goal::Speed(_) => false,
            #[allow(clippy::float_cmp, reason = "a step ends exactly on the target")]
            Goal::Angle { angle, .. } => angle == self.angle,
        };
        there && self.speed == 0.0
    }

    /// Whether the angle it was told is reached within a degree; true where it was told none.
    fn has_reached(&self, goal: Goal) -> bool {
        match goal {
            Goal::Angle { angle, .. } => (angle - self.angle).abs() <= REACHED,
            Goal::Rest | Goal::Speed(_) => true,
        }
    }

    /// Where it is as the protocol has it.
    pub fn wire_angle(&self) -> Angle {
        Angle(wrapped(LongAngle::from_degrees(self.angle).0))
    }

    /// Where it is over many turns.
    pub fn long_angle(&self) -> LongAngle {
        LongAngle::from_degrees(self.angle)
    }

    /// How fast it turns, as control commands have it.
    #[allow(clippy::cast_possible_truncation, reason = "precision is not needed")]
    pub fn control_rate(&self) -> ControlRate {
        ControlRate::from_degrees_per_second(self.speed as f32)
    }

    /// How fast it turns, as sensors have it.
    #[allow(clippy::cast_possible_truncation, reason = "precision is not needed")]
    pub fn sensor_rate(&self) -> SensorRate {
        SensorRate::from_degrees_per_second(self.speed as f32)
    }
}

/// The low 16 bits: angles on the wire start again after 720 degrees.
fn wrapped(raw: i32) -> i16 {
    let [low, high, ..] = raw.to_le_bytes();
    i16::from_le_bytes([low, high])
}

/// All axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    axes: PerAxis<Axis>,
    motors_on: bool,
    now: Duration,
}

impl Motion {
    /// Axes that stand at 0. Of `present` motors the first is pitch, the second roll, the third yaw.
    pub fn new(limits: PerAxis<Limits>, present: u8, motors_on: bool) -> Self {
        let resting = |limits, place| Axis {
            angle: 0.0,
            speed: 0.0,
            goal: Goal::Rest,
            task: None,
            limits,
            present: present >= place,
        };
        let axes = PerAxis {
            roll: resting(limits.roll, 2),
            pitch: resting(limits.pitch, 1),
            yaw: resting(limits.yaw, 3),
        };
        Self { axes, motors_on, now: Duration::ZERO }
    }

    /// Whether the motors are on.
    pub fn motors_on(&self) -> bool {
        self.motors_on
    }

    /// The axes.
    pub fn axes(&self) -> &PerAxis<Axis> {
        &self.axes
    }

    /// The axes in the order of the wire, to be told something.
    pub(super) fn each_mut(&mut self) -> [&mut Axis; 3] {
        let PerAxis { roll, pitch, yaw } = &mut self.axes;
        [roll, pitch, yaw]
    }

    /// Starts anew where the camera stands: no goals, no tasks.
    pub(super) fn restart(&mut self, limits: PerAxis<Limits>, motors_on: bool) {
        for (axis, limits) in self.each_mut().into_iter().zip(limits.into_array()) {
            axis.limits = limits;
            axis.goal = Goal::Rest;
            axis.task = None;
        }
        self.set_motors(motors_on);
    }

    pub(super) fn set_motors(&mut self, on: bool) {
        self.motors_on = on;
        for axis in self.each_mut() {
            axis.speed = 0.0;
        }
    }

    /// Moves on to `now`, by whole cycles.
    pub(super) fn advance(&mut self, now: Duration) {
        let seconds = CYCLE.as_secs_f64();
        while now.saturating_sub(self.now) >= CYCLE {
            let motors_on = self.motors_on;
            let moving = |axis: &Axis| motors_on && axis.present && !axis.is_settled();
            if !self.axes.into_array().iter().any(moving) {
                // Nothing moves until the next command: the cycles up to then are alike.
                let cycles = now.saturating_sub(self.now).as_nanos() / CYCLE.as_nanos();
                let cycles = u32::try_from(cycles).unwrap_or(u32::MAX);
                self.now = self.now.saturating_add(CYCLE.saturating_mul(cycles));
                continue;
            }
            self.now += CYCLE;
            for axis in self.each_mut() {
                if moving(axis) {
                    axis.step(seconds);
                }
            }
        }
    }

    /// Whether all of these axes are at the angles that commands told them.
    pub(super) fn commands_reached(&self, which: PerAxis<bool>) -> bool {
        let axes = self.axes.into_array();
        axes.iter().zip(which.into_array()).all(|(axis, wanted)| {
            !wanted || !axis.present || (axis.task.is_none() && axis.has_reached(axis.goal))
        })
    }

    pub(super) fn has_tasks(&self) -> bool {
        self.axes.into_array().iter().any(|axis| axis.task.is_some())
    }

    /// Ends the tasks whose angles are reached; true when none is left.
    pub(super) fn finish_tasks(&mut self) -> bool {
        let mut finished = true;
        for axis in self.each_mut() {
            match axis.task {
                Some(task) if axis.present && !axis.has_reached(task) => finished = false,
                Some(task) => {
                    axis.task = None;
                    axis.goal = task;
                }
                None => {}
            }
        }
        finished
    }
}
