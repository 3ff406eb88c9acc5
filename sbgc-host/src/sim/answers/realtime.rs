//! How the camera stands and moves, and how the board is.

use std::time::Duration;

use sbgc_proto::OutgoingCommand;
use sbgc_proto::commands::{
    Angles, AnglesExt, AxisAngles, AxisAnglesExt, CommErrors, ImuType, LimitDistances, MainImuState,
    Motor4Control, MotorFlags, MotorPower, PowerState, RealtimeData3, RealtimeData4, RealtimeDataCustom,
    RealtimeDataCustom2, RealtimeDataCustom2Flags, RealtimeDataCustomFlags as Flags, RtDataFlags, SensorAxis,
    SystemPowerFlags, SystemPowerState, SystemStateBlock, SystemStateFlags,
};
use sbgc_proto::units::{
    Angle, EncoderAngle, FineAngle, LimitDistance, LongAngle, PackedQuaternion, StabilizationError,
};
use sbgc_proto::wire::{Float, PerAxis, Reserved};

use crate::sim::eeprom::Cell;
use crate::sim::imu::{float, quaternion, short, vectors};
use crate::sim::machine::{Call, Machine};
use crate::sim::motion::{CYCLE, wire_angle};
use crate::sim::power::Power;
use crate::sim::rc::{RcInputs, pulse, wire_signal};
use crate::sim::reply::{Packet, Refusal, Replies, message, send};

/// The longest payload that is sent, so that the frame fits the buffer in both versions.
const LONGEST: usize = 249;

/// The data that firmware 2.68 knows.
const OF_2_68: u32 = 0x7FFF;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::GetAngles(_) => angles(machine),
        OutgoingCommand::GetAnglesExt(_) => angles_ext(machine),
        OutgoingCommand::RealtimeDataRequest(_) | OutgoingCommand::RealtimeData3Request(_) => {
            send(data_3_packet(machine, call.now))
        }
        OutgoingCommand::RealtimeData4Request(_) => send(data_4_packet(machine, call.now)),
        OutgoingCommand::RealtimeDataCustomRequest(request) => {
            send(custom_packet(machine, call.now, request.flags))
        }
        OutgoingCommand::RealtimeDataCustom2Request(request) => {
            send(custom_2_packet(machine, call.now, request.flags))
        }
        _ => return None,
    })
}

fn targets(machine: &Machine) -> PerAxis<Angle> {
    machine.motion.axes().map(|axis| wire_angle(axis.target()))
}

fn joints(machine: &Machine) -> PerAxis<Angle> {
    machine.motion.joints().map(wire_angle)
}

fn angles(machine: &Machine) -> Replies {
    let axes = machine.motion.axes().map(|axis| AxisAngles {
        imu_angle: axis.wire_angle(),
        target_angle: wire_angle(axis.target()),
        target_speed: axis.control_rate(),
    });
    message(&Angles { axes })
}

fn angles_ext(machine: &Machine) -> Replies {
    let joints = machine.motion.joints().map(LongAngle::from_degrees).into_array();
    let mut joints = joints.into_iter();
    let axes = machine.motion.axes().map(|axis| AxisAnglesExt {
        imu_angle: axis.wire_angle(),
        target_angle: wire_angle(axis.target()),
        stator_rotor_angle: joints.next().unwrap_or_default(),
        reserved: Reserved::default(),
    });
    message(&AnglesExt { axes })
}

pub(super) fn data_3_packet(machine: &mut Machine, now: Duration) -> Result<Packet, Refusal> {
    Packet::of(&data_3(machine, now))
}

pub(super) fn data_4_packet(machine: &mut Machine, now: Duration) -> Result<Packet, Refusal> {
    let realtime_data_3 = data_3(machine, now);
    let motion = &machine.motion;
    let (imu_temperature, board) = Power::temperatures(now);
    let (gravity_error, heading_error) = machine.imu.reference_errors();
    let new = machine.config().has("2.72");
    let north = vectors(motion.axes().map(|axis| axis.angle)).1;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is a few amperes")]
    let current = (Power::current(motion) * 1000.0).round() as u16;
    Packet::of(&RealtimeData4 {
        realtime_data_3,
        stator_rotor_angle: joints(machine),
        current,
        mag_data: north.map(|part| short(part * 1000.0)),
        imu_temperature,
        frame_imu_temperature: board.saturating_sub(2),
        imu_g_err: gravity_error,
        imu_h_err: heading_error,
        motor_out: outputs(machine),
        calib_mode: machine.imu.calib_mode,
        actual_angle: if new { motion.axes().map(|axis| axis.wire_angle()) } else { PerAxis::default() },
        system_state_flags: if machine.config().has("2.73") {
            state_flags(machine)
        } else {
            SystemStateFlags::empty()
        },
        ..RealtimeData4::default()
    })
}

/// The torque of the motors: what holding needs and what turning adds.
fn outputs(machine: &Machine) -> PerAxis<i16> {
    [0, 1, 2].map(|index| short(Power::motor_current(&machine.motion, index) * 1500.0)).into()
}

fn state_flags(machine: &Machine) -> SystemStateFlags {
    let following = machine.steering.following(machine.settings());
    let mut flags = SystemStateFlags::INIT_STEP1_DONE
        | SystemStateFlags::INIT_STEP2_DONE
        | SystemStateFlags::STARTUP_AUTO_ROUTINE_DONE;
    flags |= machine.modes;
    flags.set(SystemStateFlags::FOLLOW_MODE_ROLL, following.first() == Some(&true));
    flags.set(SystemStateFlags::FOLLOW_MODE_PITCH, following.get(1) == Some(&true));
    flags.set(SystemStateFlags::FOLLOW_MODE_YAW, following.get(2) == Some(&true));
    flags
}

fn data_3(machine: &mut Machine, now: Duration) -> RealtimeData3 {
    let [x, y, z] = machine.imu.acc(&machine.motion).into_array();
    let [roll, pitch, yaw] = machine.imu.gyro(&machine.motion);
    let motion = &machine.motion;
    let sensor = |acc_data, gyro_data| SensorAxis { acc_data, gyro_data };
    let settings = machine.settings();
    let [rc_roll, rc_pitch, rc_yaw, rc_cmd, fc_roll, fc_pitch] =
        RcInputs::assigned(settings).map(|source| pulse(machine.rc.signal(source, settings)));
    let power = settings.params.motors.map(|motor| if motion.motors_on() { motor.power } else { 0 });
    RealtimeData3 {
        axes: PerAxis { roll: sensor(x, roll), pitch: sensor(y, pitch), yaw: sensor(z, yaw) },
        serial_err_cnt: machine.power.serial_errors,
        system_error: machine.power.errors(machine.imu.connected),
        system_sub_error: machine.power.stop().unwrap_or_default(),
        rc_roll,
        rc_pitch,
        rc_yaw,
        rc_cmd,
        ext_fc_roll: fc_roll,
        ext_fc_pitch: fc_pitch,
        imu_angle: motion.axes().map(|axis| axis.wire_angle()),
        frame_imu_angle: motion.frame().map(wire_angle),
        target_angle: targets(machine),
        cycle_time: u16::try_from(CYCLE.as_micros()).unwrap_or_default(),
        i2c_error_count: machine.power.i2c_errors,
        bat_level: machine.power.shown_voltage(now, motion, machine.voltage_scale()),
        rt_data_flags: if motion.motors_on() { RtDataFlags::MOTORS_ON } else { RtDataFlags::empty() },
        cur_imu: ImuType::from(machine.parameters.eeprom.cell(Cell::SelectedImu).max(1)),
        cur_profile: machine.parameters.active().into(),
        motor_power: power,
        ..RealtimeData3::default()
    }
}

/// Milliseconds as they stand in messages, where they start again after a minute.
pub(super) fn timestamp(now: Duration) -> u16 {
    let [low, high, ..] = now.as_millis().to_le_bytes();
    u16::from_le_bytes([low, high])
}

pub(super) fn custom_packet(machine: &mut Machine, now: Duration, flags: Flags) -> Result<Packet, Refusal> {
    let flags = if machine.config().has("2.70") {
        flags
    } else {
        // Flags that this firmware does not know are dropped.
        Flags::from_bits_retain(flags.bits() & OF_2_68)
    };
    if flags.payload_len() > LONGEST {
        return Err(Refusal::Parameters);
    }
    let acc = machine.imu.acc(&machine.motion);
    let gyro = machine.imu.gyro(&machine.motion);
    Packet::with(&custom(machine, now, flags, acc, gyro), flags)
}

fn custom(
    machine: &Machine,
    now: Duration,
    flags: Flags,
    acc: sbgc_proto::wire::PerXyz<sbgc_proto::units::Acceleration>,
    gyro: [sbgc_proto::units::SensorRate; 3],
) -> RealtimeDataCustom {
    let motion = &machine.motion;
    let axes = motion.axes();
    let settings = machine.settings();
    let degrees = axes.map(|axis| axis.angle);
    let wanted = axes.map(|axis| axis.target());
    let rates = axes.map(|axis| axis.sensor_rate());
    let (down, north) = vectors(degrees);
    let packed = |angles| PackedQuaternion::pack(quaternion(angles));
    let range = |index: usize| axes.into_array().get(index).and_then(|axis| axis.limits.range);
    let limit = |pick: fn((f64, f64)) -> f64, none: i32| -> PerAxis<LongAngle> {
        [0, 1, 2]
            .map(|index| range(index).map_or(LongAngle(none), |range| LongAngle::from_degrees(pick(range))))
            .into()
    };
    let has = |flag| flags.contains(flag);
    RealtimeDataCustom {
        timestamp_ms: timestamp(now),
        flags: has(Flags::INCLUDE_FLAGS).then_some(flags),
        imu_angles: has(Flags::IMU_ANGLES).then(|| degrees.map(wire_angle)),
        target_angles: has(Flags::TARGET_ANGLES).then(|| wanted.map(wire_angle)),
        target_speed: has(Flags::TARGET_SPEED).then(|| {
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            let rate = |speed: f64| sbgc_proto::units::SensorRate::from_degrees_per_second(speed as f32);
            axes.map(|axis| rate(axis.setpoint_speed))
        }),
        stator_rotor_angle: has(Flags::STATOR_ROTOR_ANGLE).then(|| joints(machine)),
        gyro_data: has(Flags::GYRO_DATA).then(|| gyro.into()),
        rc_data: has(Flags::RC_DATA).then(|| {
            RcInputs::assigned(settings).map(|source| wire_signal(machine.rc.signal(source, settings)))
        }),
        z_vector: has(Flags::Z_VECTOR_H_VECTOR).then(|| down.map(float)),
        h_vector: has(Flags::Z_VECTOR_H_VECTOR).then(|| north.map(float)),
        rc_channels: has(Flags::RC_CHANNELS).then(|| machine.rc.serial_channels(settings)),
        acc_data: has(Flags::ACC_DATA).then_some(acc),
        motor4_control: has(Flags::MOTOR4_CONTROL).then(Motor4Control::default),
        ahrs_debug_info: has(Flags::AHRS_DEBUG_INFO).then(|| machine.imu.debug_info(now)),
        encoder_raw24: has(Flags::ENCODER_RAW24)
            .then(|| motion.joints().map(|angle| EncoderAngle::from_degrees(angle.rem_euclid(360.0)))),
        imu_angles_rad: has(Flags::IMU_ANGLES_RAD)
            .then(|| degrees.map(|angle| float(f64::from(wire_angle(angle).degrees()).to_radians()))),
        script_vars_float: has(Flags::SCRIPT_VARS_FLOAT).then(|| [Float::from(0.0); 10]),
        script_vars_int16: has(Flags::SCRIPT_VARS_INT16).then_some([0; 10]),
        system_power_state: has(Flags::SYSTEM_POWER_STATE).then(|| power_state(machine, now)),
        frame_cam_rate: has(Flags::FRAME_CAM_RATE).then_some(rates),
        imu_angles_20: has(Flags::IMU_ANGLES_20).then(|| degrees.map(FineAngle::from_degrees)),
        target_angles_20: has(Flags::TARGET_ANGLES_20).then(|| wanted.map(FineAngle::from_degrees)),
        comm_errors: has(Flags::COMM_ERRORS).then(|| CommErrors {
            i2c_errors: machine.power.i2c_errors,
            serial_errors: machine.power.serial_errors,
            ..CommErrors::default()
        }),
        system_state: has(Flags::SYSTEM_STATE).then(|| SystemStateBlock {
            flags: state_flags(machine),
            calib_mode: machine.imu.calib_mode,
            reserved: Reserved::default(),
        }),
        imu_quat: has(Flags::IMU_QUAT).then(|| packed(degrees)),
        target_quat: has(Flags::TARGET_QUAT).then(|| packed(wanted)),
        imu_to_frame_quat: has(Flags::IMU_TO_FRAME_QUAT).then(|| packed(motion.joints())),
        adc_ch_raw: has(Flags::ADC_CH_RAW).then(|| adc(machine)),
        sw_limits_dist: has(Flags::SW_LIMITS_DIST).then(|| limit_distances(machine)),
        follow_dist: has(Flags::FOLLOW_DIST).then(|| joints(machine)),
        ext_target_limit_min: has(Flags::EXT_TARGET_LIMIT).then(|| limit(|range| range.0, i32::MIN)),
        ext_target_limit_max: has(Flags::EXT_TARGET_LIMIT).then(|| limit(|range| range.1, i32::MAX)),
        frame_cam_angle_20: has(Flags::FRAME_CAM_ANGLE_20)
            .then(|| motion.joints().map(FineAngle::from_degrees)),
        main_imu_state: has(Flags::MAIN_IMU_STATE).then(|| {
            let (g_error, h_error) = machine.imu.reference_errors();
            MainImuState { g_ref_err: g_error.0, h_ref_err: h_error.0, ..MainImuState::default() }
        }),
    }
}

/// The analog inputs as 12 bits; one that is not connected reads 0.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is within 0 to 4095")]
fn adc(machine: &Machine) -> [u16; 4] {
    [33, 34, 35, 36].map(|source| {
        let signal = machine.rc.signal(sbgc_proto::commands::RcSource(source), machine.settings());
        signal.map_or(0, |signal| (f64::midpoint(signal.clamp(-1.0, 1.0), 1.0) * 4095.0).round() as u16)
    })
}

fn limit_distances(machine: &Machine) -> PerAxis<LimitDistances> {
    let joints = machine.motion.joints().into_array();
    let axes = machine.motion.axes().into_array();
    let mut axes = axes.iter().zip(joints);
    #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
    let distance = |degrees: f64| LimitDistance::from_degrees(degrees as f32);
    [(); 3]
        .map(|()| match axes.next().and_then(|(axis, joint)| Some((axis.limits.range?, joint))) {
            Some(((least, most), joint)) => LimitDistances {
                sw_limit_dist_min: distance(joint - least),
                sw_limit_dist_max: distance(most - joint),
            },
            None => LimitDistances {
                sw_limit_dist_min: LimitDistance::UNKNOWN,
                sw_limit_dist_max: LimitDistance::UNKNOWN,
            },
        })
        .into()
}

fn power_state(machine: &Machine, now: Duration) -> SystemPowerState {
    let motion = &machine.motion;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is a few amperes")]
    let milliamperes = |amperes: f64| (amperes * 1000.0).round() as u16;
    let motor = |index| {
        let current = Power::motor_current(motion, index);
        let mut mot_flags = MotorFlags::empty();
        mot_flags.set(MotorFlags::DRIVER_ENABLED, motion.motors_on());
        MotorPower {
            mot_power: short(current * 1500.0),
            mot_current: milliamperes(current),
            mot_temp: Power::motor_temperature(motion, index),
            mot_flags,
            ..MotorPower::default()
        }
    };
    SystemPowerState {
        axes: [motor(0), motor(1), motor(2)].into(),
        system_power_state: if motion.motors_on() { PowerState::On } else { PowerState::Off },
        battery_voltage: machine.power.shown_voltage(now, motion, machine.voltage_scale()),
        total_current: milliamperes(Power::current(motion)),
        system_flags: SystemPowerFlags::empty(),
    }
}

pub(super) fn custom_2_packet(
    machine: &mut Machine,
    now: Duration,
    flags: RealtimeDataCustom2Flags,
) -> Result<Packet, Refusal> {
    use RealtimeDataCustom2Flags as Flags;
    let (gyro, acc) = machine.imu.frame_sensors(&machine.motion);
    let motion = &machine.motion;
    let north = vectors(motion.axes().map(|axis| axis.angle)).1;
    let has = |flag| flags.contains(flag);
    let data = RealtimeDataCustom2 {
        timestamp_ms: timestamp(now),
        flags: has(Flags::INCLUDE_FLAGS).then_some(flags),
        frame_imu_angles: has(Flags::FRAME_IMU_ANGLES).then(|| motion.frame().map(wire_angle)),
        frame_gyro: has(Flags::FRAME_GYRO).then(|| gyro.into()),
        frame_acc: has(Flags::FRAME_ACC).then_some(acc),
        debug: has(Flags::DEBUG).then_some([0; 4]),
        mag_sens_data: has(Flags::MAG_SENS_DATA).then(|| north.map(|part| short(part * 1000.0))),
        extra_buttons_state: has(Flags::PIN_STATE).then_some(0xAAAA),
        pin_state: has(Flags::PIN_STATE).then(|| machine.pins.input_bits()),
        pin_state_reserved: has(Flags::PIN_STATE).then(Reserved::default),
        stab_err_ampl: has(Flags::STAB_ERR_AMPL).then(|| {
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            motion.axes().map(|axis| {
                StabilizationError::from_degrees((axis.setpoint - axis.angle).abs() as f32 + 0.005)
            })
        }),
    };
    Packet::with(&data, flags)
}
