//! What `monitor` shows, without how it looks.

use std::collections::VecDeque;
use std::time::Duration;

use sbgc_host::LinkCounters;
use sbgc_proto::commands::{BoardInfo, RealtimeData3, RtDataFlags};
use sbgc_proto::frame::Version;
use sbgc_proto::reflect::{self, Leaf};
use sbgc_proto::wire::PerAxis;

use crate::{fields, text};

/// How much of the past the plots show, in seconds.
pub(super) const PAST: f64 = 30.0;

/// One axis over time and now.
#[derive(Debug, Default)]
pub(super) struct Axis {
    pub(super) angle: f64,
    pub(super) target: f64,
    /// Power of the motor in percent.
    pub(super) power: f64,
    /// Angles as points of time and degrees.
    pub(super) angles: VecDeque<(f64, f64)>,
    pub(super) targets: VecDeque<(f64, f64)>,
}

/// The state of the picture.
#[derive(Debug)]
pub(super) struct View {
    pub(super) title: String,
    pub(super) colored: bool,
    pub(super) axes: [Axis; 3],
    /// The time of the newest sample, in seconds.
    pub(super) now: f64,
    pub(super) battery: Option<f64>,
    pub(super) motors_on: bool,
    pub(super) profile: String,
    pub(super) errors: Option<String>,
    pub(super) i2c_errors: u16,
    pub(super) serial_errors: u16,
    pub(super) link: LinkCounters,
    pub(super) lost: u64,
    /// Samples per second, over the last ones.
    pub(super) rate: f64,
    pub(super) paused: bool,
    arrivals: VecDeque<f64>,
}

/// The names of the axes, in their order.
pub(super) const NAMES: [&str; 3] = ["ROLL", "PITCH", "YAW"];

impl View {
    pub(super) fn new(port: &str, info: &BoardInfo, version: Version, colored: bool) -> Self {
        let (board, firmware, version) = (info.board_ver.number(), info.firmware_ver, version.number());
        let port = text::escape(port);
        Self {
            title: format!("{port}: board {board}, firmware {firmware}, version {version}"),
            colored,
            axes: Default::default(),
            now: 0.0,
            battery: None,
            motors_on: false,
            profile: String::from("-"),
            errors: None,
            i2c_errors: 0,
            serial_errors: 0,
            link: LinkCounters::default(),
            lost: 0,
            rate: 0.0,
            paused: false,
            arrivals: VecDeque::new(),
        }
    }

    /// Takes a sample that came at this time.
    pub(super) fn add(&mut self, time: Duration, data: &RealtimeData3) {
        let now = time.as_secs_f64();
        self.arrivals.push_back(now);
        while self.arrivals.front().is_some_and(|first| now - first > 2.0) {
            self.arrivals.pop_front();
        }
        if let (Some(first), count @ 2..) = (self.arrivals.front(), self.arrivals.len()) {
            #[allow(clippy::cast_precision_loss, reason = "fewer samples than that")]
            let intervals = (count - 1) as f64;
            self.rate = intervals / (now - first).max(0.001);
        }
        if self.paused {
            return;
        }
        self.now = now;
        let PerAxis { roll, pitch, yaw } = data.imu_angle;
        let angles = [roll, pitch, yaw].map(|angle| f64::from(angle.degrees()));
        let PerAxis { roll, pitch, yaw } = data.target_angle;
        let targets = [roll, pitch, yaw].map(|angle| f64::from(angle.degrees()));
        let PerAxis { roll, pitch, yaw } = data.motor_power;
        let powers = [roll, pitch, yaw].map(|power| f64::from(power) / 2.55);
        for (((axis, angle), target), power) in self.axes.iter_mut().zip(angles).zip(targets).zip(powers) {
            (axis.angle, axis.target, axis.power) = (angle, target, power);
            for (points, value) in [(&mut axis.angles, angle), (&mut axis.targets, target)] {
                points.push_back((now, value));
                while points.front().is_some_and(|first| now - first.0 > PAST) {
                    points.pop_front();
                }
            }
        }
        self.battery = Some(f64::from(data.bat_level.volts()));
        self.motors_on = data.rt_data_flags.contains(RtDataFlags::MOTORS_ON);
        (self.i2c_errors, self.serial_errors) = (data.i2c_error_count, data.serial_err_cnt);
        self.errors = None;
        let any = !data.system_error.is_empty();
        reflect::walk(data, &mut |leaf: &Leaf<'_>| match leaf.path.to_string().as_str() {
            "system_error" if any => self.errors = Some(fields::label_text(leaf)),
            "cur_profile" => self.profile = fields::label_text(leaf),
            _ => {}
        });
    }

    /// Takes how the link does.
    pub(super) fn link(&mut self, counters: &LinkCounters) {
        self.link = *counters;
    }

    pub(super) fn lose(&mut self, lost: u64) {
        self.lost += lost;
    }

    pub(super) fn pause(&mut self) {
        self.paused = !self.paused;
    }

    pub(super) fn clear(&mut self) {
        for axis in &mut self.axes {
            axis.angles.clear();
            axis.targets.clear();
        }
    }
}
