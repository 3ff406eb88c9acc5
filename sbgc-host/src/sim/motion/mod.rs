//! How the camera turns.
//!
//! Real: each axis moves toward where it should be with limited speed and limited acceleration, in steps of the board's
//! control cycle, and stops at its limits; the camera follows its set-point with a small delay, so that the two differ
//! while it moves; with the motors off it coasts to rest, unless they brake it; angles are kept over many turns and leave the board
//! as the 14-bit numbers of the protocol.
//!
//! Simplified: the axes do not disturb one another, and the camera is in perfect balance: it neither sags with the
//! motors off nor shakes with them on.

mod axis;

use std::time::Duration;

use sbgc_proto::wire::PerAxis;

pub(super) use axis::wire_angle;
pub use axis::{Axis, Goal, Limits};

/// The time of one control cycle of the board.
pub const CYCLE: Duration = Duration::from_micros(800);

/// All axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    axes: PerAxis<Axis>,
    motors_on: bool,
    now: Duration,
    /// How the frame stands, in degrees.
    frame: PerAxis<f64>,
    record: Option<Vec<Moment>>,
}

/// How the axes moved in one control cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// When it ended.
    pub time: Duration,
    /// The angles, in degrees over many turns.
    pub angles: PerAxis<f64>,
    /// The speeds, in degrees per second.
    pub speeds: PerAxis<f64>,
}

/// How many cycles are recorded at most: 80 seconds of motion.
const RECORDED: usize = 100_000;

impl Motion {
    /// Axes that stand at 0. Of `present` motors the first is pitch, the second roll, the third yaw.
    pub fn new(present: u8, motors_on: bool) -> Self {
        let resting = |place| Axis::resting(present >= place);
        let axes = PerAxis { roll: resting(2), pitch: resting(1), yaw: resting(3) };
        Self { axes, motors_on, now: Duration::ZERO, frame: [0.0; 3].into(), record: None }
    }

    /// Whether the motors are on.
    pub fn motors_on(&self) -> bool {
        self.motors_on
    }

    /// Up to when it has moved on.
    pub(super) fn now(&self) -> Duration {
        self.now
    }

    /// The axes.
    pub fn axes(&self) -> &PerAxis<Axis> {
        &self.axes
    }

    /// How the frame stands, in degrees.
    pub fn frame(&self) -> PerAxis<f64> {
        self.frame
    }

    /// Turns the frame. The camera stays where it is, as long as the motors hold it.
    pub(super) fn turn_frame(&mut self, frame: PerAxis<f64>) {
        if !self.motors_on {
            let turned = frame.into_array().into_iter().zip(self.frame.into_array());
            for (axis, (new, old)) in self.each_mut().into_iter().zip(turned) {
                axis.put(axis.angle + new - old);
            }
        }
        self.frame = frame;
    }

    /// The angles of the joints: of the camera against the frame.
    pub fn joints(&self) -> PerAxis<f64> {
        let [roll, pitch, yaw] = self.axes.map(|axis| axis.angle).into_array();
        PerAxis { roll: roll - self.frame.roll, pitch: pitch - self.frame.pitch, yaw: yaw - self.frame.yaw }
    }

    /// The cycles in which something moved since recording began, up to 80 seconds of them.
    pub fn recorded(&self) -> &[Moment] {
        self.record.as_deref().unwrap_or_default()
    }

    /// Begins a new record, or ends recording.
    pub(super) fn set_recording(&mut self, on: bool) {
        self.record = on.then(Vec::new);
    }

    /// Whether an axis is still on its way, or turns as it was told.
    pub fn is_moving(&self) -> bool {
        self.motors_on && self.axes.into_array().iter().any(|axis| axis.present && !axis.is_settled())
    }

    /// The axes in the order of the wire, to be told something.
    pub(super) fn each_mut(&mut self) -> [&mut Axis; 3] {
        let PerAxis { roll, pitch, yaw } = &mut self.axes;
        [roll, pitch, yaw]
    }

    /// Starts anew where the camera stands: no goals, no tasks.
    pub(super) fn restart(&mut self, motors_on: bool) {
        for axis in self.each_mut() {
            axis.goal = Goal::Rest;
            axis.task = None;
        }
        self.motors_on = motors_on;
        self.brake();
    }

    /// Turns the motors on, or lets the camera go.
    pub(super) fn set_motors(&mut self, on: bool) {
        self.motors_on = on;
        for axis in self.each_mut() {
            if on {
                axis.put(axis.angle);
            } else {
                axis.release();
            }
        }
    }

    /// Brings all axes to rest at once, as motors do whose windings are shorted.
    pub(super) fn brake(&mut self) {
        for axis in self.each_mut() {
            axis.put(axis.angle);
        }
    }

    /// Moves on to `now`, by whole cycles.
    pub(super) fn advance(&mut self, now: Duration) {
        let seconds = CYCLE.as_secs_f64();
        while now.saturating_sub(self.now) >= CYCLE {
            let motors_on = self.motors_on;
            let moving =
                |axis: &Axis| axis.present && if motors_on { !axis.is_settled() } else { axis.speed != 0.0 };
            if !self.axes.into_array().iter().any(moving) {
                // Nothing moves until the next command: the cycles up to then are alike.
                let cycles = now.saturating_sub(self.now).as_nanos() / CYCLE.as_nanos();
                let cycles = u32::try_from(cycles).unwrap_or(u32::MAX);
                self.now = self.now.saturating_add(CYCLE.saturating_mul(cycles));
                continue;
            }
            self.now += CYCLE;
            let frame = self.frame.into_array();
            for (axis, frame) in self.each_mut().into_iter().zip(frame) {
                if moving(axis) && motors_on {
                    axis.step(seconds, frame);
                } else if moving(axis) {
                    axis.coast(seconds);
                }
            }
            let moment = Moment {
                time: self.now,
                angles: self.axes.map(|axis| axis.angle),
                speeds: self.axes.map(|axis| axis.speed),
            };
            if let Some(record) = self.record.as_mut().filter(|record| record.len() < RECORDED) {
                record.push(moment);
            }
        }
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
                    // It comes to rest where the task led, unless another source moves it on.
                    axis.goal = task;
                    axis.task = None;
                }
                None => {}
            }
        }
        finished
    }

    /// Gives an axis a task of the board itself, which goes before commands.
    pub(super) fn give_task(&mut self, tasks: PerAxis<Option<Goal>>) {
        for (axis, task) in self.each_mut().into_iter().zip(tasks.into_array()) {
            if task.is_some() && axis.present {
                axis.task = task;
            }
        }
    }

    /// Ends all tasks where the axes are.
    pub(super) fn drop_tasks(&mut self) {
        for axis in self.each_mut() {
            if axis.task.take().is_some() {
                axis.goal = Goal::Rest;
            }
        }
    }
}
