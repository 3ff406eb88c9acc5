//! One axis: its set-point, which the limits shape, and the camera, which follows it.

use sbgc_proto::units::{Angle, ControlRate, LongAngle, SensorRate};

/// How near a target has to be to count as reached, in degrees.
const REACHED: f64 = 1.0;

/// The delay with which the camera follows its set-point, in seconds.
const DELAY: f64 = 0.02;

/// The time in which friction takes most of the speed of an axis without motor, in seconds.
const COASTING: f64 = 0.3;

/// How strongly the outer loop of speed with angle corrects: per second, and per second squared.
const OUTER_P: f64 = 5.0;
const OUTER_I: f64 = 6.0;

/// Limits of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Speed in degrees per second.
    pub speed: f64,
    /// Acceleration in degrees per second squared; 0 for no limit.
    pub acceleration: f64,
    /// The time in which an acceleration builds up to its limit, in seconds; 0 for at once.
    pub jerk_time: f64,
    /// The lowest and highest angle of the joint in degrees, if it is limited.
    pub range: Option<(f64, f64)>,
}

/// What an axis should do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Goal {
    /// Stand still where it comes to rest.
    #[default]
    Rest,
    /// Turn with this speed in degrees per second.
    Speed(f64),
    /// Go to an angle.
    Angle {
        /// The angle in degrees, over many turns.
        angle: f64,
        /// The speed to go there with in degrees per second; `None` for the axis's own.
        speed: Option<f64>,
    },
    /// Turn with a speed, and correct the distance to an angle by the outer loop.
    SpeedAngle {
        /// The speed in degrees per second.
        speed: f64,
        /// The angle in degrees, over many turns.
        angle: f64,
    },
}

/// One axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Where it is, in degrees over many turns.
    pub angle: f64,
    /// How fast it turns, in degrees per second.
    pub speed: f64,
    /// Where it should be by now, as the limits of speed and acceleration allow.
    pub setpoint: f64,
    /// How fast the set-point moves, in degrees per second.
    pub setpoint_speed: f64,
    /// What it was told by commands or remote control.
    pub goal: Goal,
    /// What a task of the board itself makes it do, which goes before commands.
    pub task: Option<Goal>,
    /// Limits where a command says nothing.
    pub limits: Limits,
    /// The acceleration that tasks use instead, in degrees per second squared; 0 for no limit.
    pub task_acceleration: f64,
    /// Whether there is a motor.
    pub present: bool,
    /// What the outer loop has summed up, in degrees per second.
    correction: f64,
    /// By how much the set-point's speed changed in the last step, in degrees per second.
    surge: f64,
}

impl Axis {
    pub(super) fn resting(present: bool) -> Self {
        Self {
            angle: 0.0,
            speed: 0.0,
            setpoint: 0.0,
            setpoint_speed: 0.0,
            goal: Goal::Rest,
            task: None,
            limits: Limits { speed: 60.0, acceleration: 300.0, jerk_time: 0.0, range: None },
            task_acceleration: 300.0,
            present,
            correction: 0.0,
            surge: 0.0,
        }
    }

    /// Puts it somewhere, at rest.
    pub(in crate::sim) fn put(&mut self, angle: f64) {
        self.angle = angle;
        self.setpoint = angle;
        self.speed = 0.0;
        self.setpoint_speed = 0.0;
        self.correction = 0.0;
        self.surge = 0.0;
    }

    /// Lets it go: it turns on freely, and nothing drives it any more.
    pub(super) fn release(&mut self) {
        let speed = self.speed;
        self.put(self.angle);
        self.speed = speed;
    }

    /// Turns on freely for a step.
    pub(super) fn coast(&mut self, seconds: f64) {
        self.angle += self.speed * seconds;
        self.setpoint = self.angle;
        self.speed *= (-seconds / COASTING).exp();
        if self.speed.abs() < 0.01 {
            self.speed = 0.0;
        }
    }

    /// Moves where it is thought to be, while what it was told stays.
    pub(in crate::sim) fn shift(&mut self, way: f64) {
        self.angle += way;
        self.setpoint += way;
    }

    fn acceleration(&self) -> f64 {
        let given = if self.task.is_some() { self.task_acceleration } else { self.limits.acceleration };
        if given > 0.0 { given } else { f64::INFINITY }
    }

    /// The angle within the limits of the joint.
    fn limited(&self, angle: f64, frame: f64) -> f64 {
        self.limits.range.map_or(angle, |(least, most)| angle.clamp(frame + least, frame + most))
    }

    pub(super) fn step(&mut self, seconds: f64, frame: f64) {
        self.step_setpoint(seconds, frame);
        let before = self.angle;
        let rest = self.setpoint - self.angle;
        self.angle = if self.setpoint_speed == 0.0 && rest.abs() < 1e-3 {
            self.setpoint
        } else {
            self.angle + rest * (1.0 - (-seconds / DELAY).exp())
        };
        self.speed = (self.angle - before) / seconds;
        if self.setpoint_speed == 0.0 && self.speed.abs() < 1e-6 {
            self.speed = 0.0;
        }
    }

    fn step_setpoint(&mut self, seconds: f64, frame: f64) {
        let acceleration = self.acceleration();
        let jerk_time = if acceleration.is_finite() { self.limits.jerk_time } else { 0.0 };
        let target = self.task.unwrap_or(self.goal);
        let (most, end) = match target {
            Goal::Rest => (0.0, None),
            Goal::Speed(speed) => match self.limits.range {
                Some((_, most)) if speed > 0.0 => (speed, Some(frame + most)),
                Some((least, _)) if speed < 0.0 => (-speed, Some(frame + least)),
                _ => (speed, None),
            },
            Goal::Angle { angle, speed } => {
                (speed.unwrap_or(self.limits.speed).abs(), Some(self.limited(angle, frame)))
            }
            Goal::SpeedAngle { speed, angle } => {
                (self.outer_loop(speed, self.limited(angle, frame), seconds), None)
            }
        };
        let wanted = match end {
            Some(end) => {
                let way = end - self.setpoint;
                // The speed that can be lost step by step on the way that is left.
                let braking = if jerk_time > 0.0 {
                    // Braking has to build up, too, and may have to undo an acceleration before.
                    let (gentle, half) = (acceleration / 2.0, jerk_time);
                    gentle * ((half * half + 2.0 * way.abs() / gentle).sqrt() - half)
                } else if acceleration.is_finite() {
                    let half = acceleration * seconds / 2.0;
                    (half * half + 2.0 * acceleration * way.abs()).sqrt() - half
                } else {
                    f64::INFINITY
                };
                most.min(braking).min(way.abs() / seconds).copysign(way)
            }
            None => most,
        };
        let change = acceleration * seconds;
        let mut surge = (wanted - self.setpoint_speed).clamp(-change, change);
        if jerk_time > 0.0 {
            // It grows and falls by so much in each step, and is gone when the speed is reached.
            let slope = change * seconds / jerk_time;
            let difference = (wanted - self.setpoint_speed).abs();
            let most = (slope * slope / 4.0 + 2.0 * slope * difference).sqrt() - slope / 2.0;
            let step = surge.clamp(-most, most) - self.surge;
            surge = self.surge + step.clamp(-slope, slope);
        }
        self.surge = surge;
        self.setpoint_speed += surge;
        self.setpoint += self.setpoint_speed * seconds;
        let near = if change.is_finite() { change * seconds } else { 1e-6 };
        if let Some(end) = end
            && (end - self.setpoint).abs() <= near
            && self.setpoint_speed.abs() <= 2.0 * change
        {
            self.setpoint = end;
            self.setpoint_speed = 0.0;
            self.surge = 0.0;
        }
    }

    /// The speed with which speed with angle goes on.
    fn outer_loop(&mut self, speed: f64, angle: f64, seconds: f64) -> f64 {
        let error = angle - self.setpoint;
        let most = (speed.abs() * 1.25).max(5.0);
        let wanted = speed + OUTER_P * error + self.correction;
        // On the way there it sums up nothing: that would carry it beyond the angle.
        if wanted.abs() < most {
            self.correction = (self.correction + OUTER_I * error * seconds).clamp(-most, most);
        }
        let wanted = wanted.clamp(-most, most);
        // It has come to rest at the angle.
        if error.abs() < 1e-3 && wanted.abs() < 1e-2 { 0.0 } else { wanted }
    }

    /// Whether it stands and nothing makes it move.
    #[allow(clippy::float_cmp, reason = "a step ends exactly on the target")]
    pub(super) fn is_settled(&self) -> bool {
        let there = match self.task.unwrap_or(self.goal) {
            Goal::Rest => true,
            Goal::Speed(speed) => speed == 0.0,
            // What the limits keep it from is not reached, and costs the time of a look at each cycle.
            Goal::Angle { angle, .. } => angle == self.setpoint,
            Goal::SpeedAngle { .. } => false,
        };
        there && self.setpoint_speed == 0.0 && self.speed == 0.0 && self.angle == self.setpoint
    }

    /// Whether the angle it was told is reached within a degree; true where it was told none.
    pub(in crate::sim) fn has_reached(&self, goal: Goal) -> bool {
        match goal {
            Goal::Angle { angle, .. } => {
                (angle - self.angle).abs() <= REACHED || self.is_stopped_by_limit(angle)
            }
            Goal::Rest | Goal::Speed(_) | Goal::SpeedAngle { .. } => true,
        }
    }

    /// Whether it stands at a limit that keeps it from an angle beyond.
    fn is_stopped_by_limit(&self, angle: f64) -> bool {
        self.limits.range.is_some_and(|(least, most)| {
            let beyond = !(least..=most).contains(&angle);
            beyond && self.setpoint_speed == 0.0 && self.speed == 0.0
        })
    }

    /// Where it should be in the end, in degrees.
    pub fn target(&self) -> f64 {
        match self.task.unwrap_or(self.goal) {
            Goal::Angle { angle, .. } => {
                self.limits.range.map_or(angle, |(least, most)| angle.clamp(least, most))
            }
            Goal::Rest | Goal::Speed(_) | Goal::SpeedAngle { .. } => self.setpoint,
        }
    }

    /// Where it is as the protocol has it.
    pub fn wire_angle(&self) -> Angle {
        wire_angle(self.angle)
    }

    /// Where it is over many turns.
    pub fn long_angle(&self) -> LongAngle {
        LongAngle::from_degrees(self.angle)
    }

    /// How fast it should turn, as control commands have it.
    #[allow(clippy::cast_possible_truncation, reason = "precision is not needed")]
    pub fn control_rate(&self) -> ControlRate {
        ControlRate::from_degrees_per_second(self.setpoint_speed as f32)
    }

    /// How fast it turns, as sensors have it.
    #[allow(clippy::cast_possible_truncation, reason = "precision is not needed")]
    pub fn sensor_rate(&self) -> SensorRate {
        SensorRate::from_degrees_per_second(self.speed as f32)
    }
}

/// An angle as the protocol has it: angles on the wire start again after 720 degrees.
pub(in crate::sim) fn wire_angle(degrees: f64) -> Angle {
    let [low, high, ..] = LongAngle::from_degrees(degrees).0.to_le_bytes();
    Angle(i16::from_le_bytes([low, high]))
}
