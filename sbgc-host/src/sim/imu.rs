//! The inertial sensors: what they measure, and what corrects them from outside.
//!
//! Real: vectors in the system of the protocol (X right, Y forward, Z down), noise of gyroscope and accelerometer,
//! attitudes that `CMD_AHRS_HELPER` replaces or corrects, headings and inclinations by `CMD_HELPER_DATA`.
//!
//! Simplified: the estimated attitude has no error of its own, and calibrations change nothing that is measured.

use std::time::Duration;

use sbgc_proto::commands::{
    AhrsDebugInfo, AhrsHelperMode, AhrsRefSrc, CalibMode, ExtImuState, ExtImuStatus, ImuRefSrc,
};
use sbgc_proto::units::{Acceleration, AttitudeError, SensorRate};
use sbgc_proto::wire::{Float, PerAxis, PerXyz};

use super::motion::Motion;
use super::noise::Noise;

/// Spread of the noise of the gyroscope in degrees per second, and of the accelerometer in g.
const GYRO_NOISE: f64 = 0.03;
const ACC_NOISE: f64 = 0.002;

/// How much a reference corrects the attitude with each message.
const CORRECTION: f64 = 0.1;

/// How long a reference counts as there.
const FRESH: Duration = Duration::from_secs(1);

#[derive(Debug)]
pub(super) struct Imu {
    noise: Noise,
    /// The camera's attitude was given from outside at this time, as a reference or instead of the sensor's own.
    main_external: Option<Duration>,
    main_replaced: bool,
    frame_external: Option<Duration>,
    /// The errors that the last reference corrected, in degrees.
    errors: (f64, f64),
    /// The acceleration of the frame that was told, in g.
    frame_acc: PerXyz<f64>,
    heading_known: bool,
    /// Whether the sensor answers.
    pub(super) connected: bool,
    pub(super) calib_mode: CalibMode,
}

impl Imu {
    pub(super) fn new(seed: u64) -> Self {
        Self {
            noise: Noise::new(seed),
            main_external: None,
            main_replaced: false,
            frame_external: None,
            errors: (0.0, 0.0),
            frame_acc: [0.0; 3].into(),
            heading_known: false,
            connected: true,
            calib_mode: CalibMode::None,
        }
    }

    /// Forgets what was told.
    pub(super) fn reset(&mut self) {
        let noise = self.noise.clone();
        *self = Self { noise, connected: self.connected, ..Self::new(0) };
    }

    /// The gyroscope of the camera.
    pub(super) fn gyro(&mut self, motion: &Motion) -> [SensorRate; 3] {
        motion.axes().into_array().map(|axis| {
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            let rate = (axis.speed + self.noise.bell() * GYRO_NOISE) as f32;
            SensorRate::from_degrees_per_second(rate)
        })
    }

    /// The accelerometer of the camera.
    pub(super) fn acc(&mut self, motion: &Motion) -> PerXyz<Acceleration> {
        let down = vectors(motion.axes().map(|axis| axis.angle)).0;
        down.map(|part| acceleration(part + self.noise.bell() * ACC_NOISE))
    }

    /// The sensors of the frame.
    pub(super) fn frame_sensors(&mut self, motion: &Motion) -> ([SensorRate; 3], PerXyz<Acceleration>) {
        let gyro = [(); 3].map(|()| {
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            SensorRate::from_degrees_per_second((self.noise.bell() * GYRO_NOISE) as f32)
        });
        let down = vectors(motion.frame()).0;
        (gyro, down.map(|part| acceleration(part + self.noise.bell() * ACC_NOISE)))
    }

    /// Takes in an attitude from outside, as two vectors.
    pub(super) fn help(
        &mut self,
        now: Duration,
        mode: AhrsHelperMode,
        down: PerXyz<f64>,
        north: PerXyz<f64>,
        motion: &mut Motion,
    ) {
        let told = angles(down, north);
        let weight = if mode.use_as_reference() { CORRECTION } else { 1.0 };
        let blend = |from: PerAxis<f64>| {
            let level = if mode.h_only() { 0.0 } else { weight };
            let heading = if mode.z_only() { 0.0 } else { weight };
            PerAxis {
                roll: from.roll + turn(told.roll - from.roll) * level,
                pitch: from.pitch + turn(told.pitch - from.pitch) * level,
                yaw: from.yaw + turn(told.yaw - from.yaw) * heading,
            }
        };
        if mode.frame_imu() {
            let before = motion.frame();
            let after = blend(before);
            motion.turn_frame(after);
            self.frame_external = Some(now);
            if mode.translate() {
                // What the frame is off, the camera is too.
                let shift = PerAxis {
                    roll: after.roll - before.roll,
                    pitch: after.pitch - before.pitch,
                    yaw: after.yaw - before.yaw,
                };
                self.main_external = Some(now);
                self.main_replaced = false;
                self.note(shift);
            }
        } else {
            let before = motion.axes().map(|axis| axis.angle);
            let after = blend(before);
            for (axis, angle) in motion.each_mut().into_iter().zip(after.into_array()) {
                let shift = angle - axis.angle;
                axis.shift(shift);
            }
            self.main_external = Some(now);
            self.main_replaced = !mode.use_as_reference();
            self.note(PerAxis {
                roll: turn(told.roll - before.roll),
                pitch: turn(told.pitch - before.pitch),
                yaw: turn(told.yaw - before.yaw),
            });
        }
    }

    fn note(&mut self, error: PerAxis<f64>) {
        self.errors = (error.roll.abs().max(error.pitch.abs()), error.yaw.abs());
    }

    /// Takes in the acceleration of the frame, and its inclination where that is not 0.
    pub(super) fn help_frame(&mut self, acc: PerXyz<f64>, roll: f64, pitch: f64, motion: &mut Motion) {
        self.frame_acc = acc;
        let frame = motion.frame();
        if roll != 0.0 || pitch != 0.0 {
            motion.turn_frame(PerAxis { roll, pitch, yaw: frame.yaw });
        }
    }

    /// Takes in the heading of the frame: the first one turns the camera's heading too, as its angle to the frame is
    /// known. `None` ends the reference.
    pub(super) fn help_heading(&mut self, heading: Option<f64>, motion: &mut Motion) {
        let Some(heading) = heading else {
            self.heading_known = false;
            return;
        };
        let frame = motion.frame();
        let way = turn(heading - frame.yaw);
        if !self.heading_known {
            self.heading_known = true;
            let [_, _, yaw] = motion.each_mut();
            yaw.shift(way);
        }
        motion.turn_frame(PerAxis { yaw: frame.yaw + way, ..frame });
    }

    /// The error between gravity as estimated and as measured, and that of the heading.
    pub(super) fn reference_errors(&self) -> (AttitudeError, AttitudeError) {
        let PerXyz { x, y, z } = self.frame_acc;
        // The frame does not accelerate here, so what is told of it leads the measured gravity astray.
        let astray = x.hypot(y).atan2(1.0 - z).to_degrees();
        #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
        let error = |degrees: f64| AttitudeError::from_degrees(degrees as f32);
        (error(0.2 + astray), error(0.4))
    }

    /// What is known of the references.
    pub(super) fn debug_info(&self, now: Duration) -> AhrsDebugInfo {
        let fresh = |time: Option<Duration>| time.is_some_and(|time| now.saturating_sub(time) <= FRESH);
        let source = |external: bool, replaced: bool| {
            let reference = if external { AhrsRefSrc::External } else { AhrsRefSrc::Internal };
            ImuRefSrc::default()
                .with_attitude(reference)
                .with_heading(reference)
                .with_internal_sensor(self.connected && !replaced)
                .with_enabled(true)
        };
        let (z_error, h_error) = self.reference_errors();
        #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
        let external = |degrees: f64| AttitudeError::from_degrees(degrees as f32);
        AhrsDebugInfo {
            main_imu_ref_src: source(fresh(self.main_external), self.main_replaced),
            frame_imu_ref_src: source(fresh(self.frame_external), false),
            main_imu_z_ref_err: z_error,
            main_imu_h_ref_err: h_error,
            frame_imu_z_ref_err: z_error,
            frame_imu_h_ref_err: h_error,
            ext_imu_status: ExtImuState::default().with_status(ExtImuStatus::Disabled),
            ext_corr_h_err: external(self.errors.1),
            ext_corr_z_err: external(self.errors.0),
            ..AhrsDebugInfo::default()
        }
    }
}

/// The difference of two angles as the shorter way.
fn turn(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

/// Where down and north are, seen by the camera: its right, its front, its underside.
pub(super) fn vectors(angles: PerAxis<f64>) -> (PerXyz<f64>, PerXyz<f64>) {
    let PerAxis { roll, pitch, yaw } = angles.map(|angle| angle.to_radians().sin_cos());
    let ((sin_roll, cos_roll), (sin_pitch, cos_pitch), (sin_yaw, cos_yaw)) = (roll, pitch, yaw);
    let down = [sin_roll * cos_pitch, sin_pitch, cos_roll * cos_pitch];
    let (right, under) = (-sin_yaw, -cos_yaw * sin_pitch);
    let north =
        [right * cos_roll + under * sin_roll, cos_yaw * cos_pitch, under * cos_roll - right * sin_roll];
    (down.into(), north.into())
}

/// The angles that such vectors mean.
pub(super) fn angles(down: PerXyz<f64>, north: PerXyz<f64>) -> PerAxis<f64> {
    let pitch = down.y.clamp(-1.0, 1.0).asin();
    let roll = down.x.atan2(down.z);
    // The part of north to the right when the roll is taken back.
    let right = north.x * roll.cos() - north.z * roll.sin();
    let yaw = (-right).atan2(north.y / pitch.cos().max(1e-6));
    PerAxis { roll, pitch, yaw }.map(f64::to_degrees)
}

/// The quaternion w, x, y, z of angles that turn yaw first, then pitch, then roll.
#[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
pub(super) fn quaternion(angles: PerAxis<f64>) -> [f32; 4] {
    let PerAxis { roll, pitch, yaw } = angles.map(|angle| (angle.to_radians() / 2.0).sin_cos());
    // X points right, Y forward, Z down: roll turns about Y, pitch about X, yaw about Z.
    let turns = [[yaw.1, 0.0, 0.0, yaw.0], [pitch.1, pitch.0, 0.0, 0.0], [roll.1, 0.0, roll.0, 0.0]];
    turns.into_iter().fold([1.0, 0.0, 0.0, 0.0], product).map(|part| part as f32)
}

/// The angles of a quaternion, as [`quaternion`] has them.
pub(super) fn angles_of_quaternion([w, x, y, z]: [f64; 4]) -> PerAxis<f64> {
    let length = (w * w + x * x + y * y + z * z).sqrt().max(1e-9);
    let [w, x, y, z] = [w, x, y, z].map(|part| part / length);
    let pitch = (2.0 * (w * x + y * z)).clamp(-1.0, 1.0).asin();
    let roll = (2.0 * (w * y - x * z)).atan2(1.0 - 2.0 * (x * x + y * y));
    let yaw = (2.0 * (w * z - x * y)).atan2(1.0 - 2.0 * (x * x + z * z));
    PerAxis { roll, pitch, yaw }.map(f64::to_degrees)
}

#[allow(clippy::many_single_char_names, reason = "they are the parts of quaternions")]
fn product(left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
    let ([a, b, c, d], [w, x, y, z]) = (left, right);
    [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    ]
}

#[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
pub(super) fn float(value: f64) -> Float {
    Float::from(value as f32)
}

#[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
pub(super) fn acceleration(value: f64) -> Acceleration {
    Acceleration::from_g(value as f32)
}

#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
pub(super) fn short(value: f64) -> i16 {
    value.round() as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_and_quaternions_mean_the_angles_that_they_are_made_of() {
        for (roll, pitch, yaw) in
            [(0.0, 0.0, 0.0), (10.0, 20.0, 30.0), (-40.0, 60.0, -170.0), (0.0, -80.0, 90.0)]
        {
            let made = PerAxis { roll, pitch, yaw };
            let (down, north) = vectors(made);
            let near = |found: PerAxis<f64>, tolerance: f64| {
                for (found, made) in found.into_array().into_iter().zip(made.into_array()) {
                    assert!(
                        (found - made).abs() < tolerance,
                        "{found} instead of {made} of {roll} {pitch} {yaw}"
                    );
                }
            };
            near(angles(down, north), 1e-6);
            near(angles_of_quaternion(quaternion(made).map(f64::from)), 1e-3);
        }
    }
}
