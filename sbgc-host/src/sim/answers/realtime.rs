//! How the camera stands and moves.
//!
//! Consistent with the motion: angles, targets, speeds, joints, vectors, accelerometer, gyroscope. Plausible and fixed:
//! battery, temperatures, cycle time. Nothing is connected to the inputs of remote control. What stands in other
//! groups of `CMD_REALTIME_DATA_CUSTOM` is not simulated, and asking for it is refused.

use std::time::Duration;

use sbgc_proto::commands::{
    Angles, AnglesExt, AxisAngles, AxisAnglesExt, CommErrors, ImuType, RealtimeData3, RealtimeData4,
    RealtimeDataCustom, RealtimeDataCustomFlags as Flags, RtDataFlags, SensorAxis,
};
use sbgc_proto::units::{Acceleration, EncoderAngle, FineAngle, RcSignal, Voltage};
use sbgc_proto::wire::{Float, PerAxis, PerXyz, Reserved};

use super::{Packet, Refusal, Replies, message};
use crate::sim::machine::Machine;
use crate::sim::motion::{Axis, CYCLE};

/// The groups that are simulated.
const SUPPORTED: Flags = Flags::IMU_ANGLES
    .union(Flags::TARGET_ANGLES)
    .union(Flags::TARGET_SPEED)
    .union(Flags::STATOR_ROTOR_ANGLE)
    .union(Flags::GYRO_DATA)
    .union(Flags::RC_DATA)
    .union(Flags::Z_VECTOR_H_VECTOR)
    .union(Flags::RC_CHANNELS)
    .union(Flags::ACC_DATA)
    .union(Flags::ENCODER_RAW24)
    .union(Flags::IMU_ANGLES_RAD)
    .union(Flags::FRAME_CAM_RATE)
    .union(Flags::IMU_ANGLES_20)
    .union(Flags::TARGET_ANGLES_20)
    .union(Flags::COMM_ERRORS)
    .union(Flags::FRAME_CAM_ANGLE_20)
    .union(Flags::INCLUDE_FLAGS);

/// The longest payload that is sent, so that the frame fits the buffer in both versions.
const LONGEST: usize = 249;

impl Machine {
    pub(super) fn angles(&self) -> Replies {
        let axes = self.motion.axes().map(|axis| AxisAngles {
            imu_angle: axis.wire_angle(),
            target_angle: axis.wire_angle(),
            target_speed: axis.control_rate(),
        });
        message(&Angles { axes })
    }

    pub(super) fn angles_ext(&self) -> Replies {
        let axes = self.motion.axes().map(|axis| AxisAnglesExt {
            imu_angle: axis.wire_angle(),
            target_angle: axis.wire_angle(),
            stator_rotor_angle: axis.long_angle(),
            reserved: Reserved::default(),
        });
        message(&AnglesExt { axes })
    }

    pub(in crate::sim) fn realtime_3(&self) -> Result<Packet, Refusal> {
        Packet::of(&self.data_3())
    }

    pub(in crate::sim) fn realtime_4(&self) -> Result<Packet, Refusal> {
        let angles = self.motion.axes().map(|axis| axis.wire_angle());
        Packet::of(&RealtimeData4 {
            realtime_data_3: self.data_3(),
            stator_rotor_angle: angles,
            current: if self.motion.motors_on() { 650 } else { 90 },
            mag_data: vectors(self.motion.axes()).1.map(|part| short(part * 1000.0)),
            imu_temperature: 38,
            frame_imu_temperature: 35,
            calib_mode: self.calibration_mode(),
            actual_angle: angles,
            ..RealtimeData4::default()
        })
    }

    pub(in crate::sim) fn realtime_custom(&self, now: Duration, flags: Flags) -> Result<Packet, Refusal> {
        if !SUPPORTED.contains(flags) {
            return Err(Refusal::NotSupported);
        }
        if flags.payload_len() > LONGEST {
            return Err(Refusal::Parameters);
        }
        let axes = self.motion.axes();
        let angles = axes.map(|axis| axis.wire_angle());
        let fine = axes.map(|axis| FineAngle::from_degrees(axis.angle));
        let rates = axes.map(|axis| axis.sensor_rate());
        let (down, north) = vectors(axes);
        let [low, high, ..] = now.as_millis().to_le_bytes();
        let data = RealtimeDataCustom {
            timestamp_ms: u16::from_le_bytes([low, high]),
            flags: flags.contains(Flags::INCLUDE_FLAGS).then_some(flags),
            imu_angles: flags.contains(Flags::IMU_ANGLES).then_some(angles),
            target_angles: flags.contains(Flags::TARGET_ANGLES).then_some(angles),
            target_speed: flags.contains(Flags::TARGET_SPEED).then_some(rates),
            stator_rotor_angle: flags.contains(Flags::STATOR_ROTOR_ANGLE).then_some(angles),
            gyro_data: flags.contains(Flags::GYRO_DATA).then_some(rates.into_array().into()),
            rc_data: flags.contains(Flags::RC_DATA).then_some([RcSignal::UNDEFINED; 6]),
            z_vector: flags.contains(Flags::Z_VECTOR_H_VECTOR).then_some(down.map(float)),
            h_vector: flags.contains(Flags::Z_VECTOR_H_VECTOR).then_some(north.map(float)),
            rc_channels: flags.contains(Flags::RC_CHANNELS).then_some([RcSignal::UNDEFINED; 18]),
            acc_data: flags.contains(Flags::ACC_DATA).then_some(down.map(acceleration)),
            encoder_raw24: flags
                .contains(Flags::ENCODER_RAW24)
                .then_some(axes.map(|axis| EncoderAngle::from_degrees(axis.angle.rem_euclid(360.0)))),
            imu_angles_rad: flags
                .contains(Flags::IMU_ANGLES_RAD)
                .then_some(axes.map(|axis| float(f64::from(axis.wire_angle().degrees()).to_radians()))),
            frame_cam_rate: flags.contains(Flags::FRAME_CAM_RATE).then_some(rates),
            imu_angles_20: flags.contains(Flags::IMU_ANGLES_20).then_some(fine),
            target_angles_20: flags.contains(Flags::TARGET_ANGLES_20).then_some(fine),
            comm_errors: flags.contains(Flags::COMM_ERRORS).then(CommErrors::default),
            frame_cam_angle_20: flags.contains(Flags::FRAME_CAM_ANGLE_20).then_some(fine),
            ..RealtimeDataCustom::default()
        };
        Packet::with(&data, flags)
    }

    fn data_3(&self) -> RealtimeData3 {
        let motion = &self.motion;
        let angles = motion.axes().map(|axis| axis.wire_angle());
        let [x, y, z] = vectors(motion.axes()).0.into_array().map(acceleration);
        let [roll, pitch, yaw] = motion.axes().map(|axis| axis.sensor_rate()).into_array();
        let sensor = |acc_data, gyro_data| SensorAxis { acc_data, gyro_data };
        RealtimeData3 {
            axes: PerAxis { roll: sensor(x, roll), pitch: sensor(y, pitch), yaw: sensor(z, yaw) },
            imu_angle: angles,
            target_angle: angles,
            cycle_time: u16::try_from(CYCLE.as_micros()).unwrap_or_default(),
            bat_level: Voltage(1480),
            rt_data_flags: if motion.motors_on() { RtDataFlags::MOTORS_ON } else { RtDataFlags::empty() },
            cur_imu: ImuType::Main,
            cur_profile: self.parameters.active().into(),
            motor_power: [if motion.motors_on() { 150 } else { 0 }; 3].into(),
            ..RealtimeData3::default()
        }
    }
}

/// Where down and north are, seen by the camera: its right, its front, its underside.
fn vectors(axes: &PerAxis<Axis>) -> (PerXyz<f64>, PerXyz<f64>) {
    let PerAxis { roll, pitch, yaw } = axes.map(|axis| axis.angle.to_radians().sin_cos());
    let ((sin_roll, cos_roll), (sin_pitch, cos_pitch), (sin_yaw, cos_yaw)) = (roll, pitch, yaw);
    let down = [sin_roll * cos_pitch, sin_pitch, cos_roll * cos_pitch];
    let (right, under) = (-sin_yaw, -cos_yaw * sin_pitch);
    let north =
        [right * cos_roll + under * sin_roll, cos_yaw * cos_pitch, under * cos_roll - right * sin_roll];
    (down.into(), north.into())
}

#[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
fn float(value: f64) -> Float {
    Float::from(value as f32)
}

#[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
fn acceleration(value: f64) -> Acceleration {
    Acceleration::from_g(value as f32)
}

#[allow(clippy::cast_possible_truncation, reason = "the cast saturates")]
fn short(value: f64) -> i16 {
    value.round() as i16
}
