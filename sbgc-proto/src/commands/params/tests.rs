//! Blocks of parameters byte by byte.
#![allow(clippy::float_cmp, reason = "the values are exact")]

use super::*;
use crate::commands::*;
use crate::frame::Version;
use crate::units::*;
use crate::wire::{PerAxis, Reserved, ToWire};
use crate::{DecodeError, Message};

/// A payload in which every byte has another value, as far as there are values: made by hand from the layout.
fn ramp<const N: usize>() -> [u8; N] {
    core::array::from_fn(|index| u8::try_from(index % 256).unwrap())
}

/// `payload` decodes, encodes to itself, and is refused when a byte is missing.
fn whole<'p, M: Message + crate::wire::FromWire<'p> + ToWire>(payload: &'p [u8]) -> M {
    let (message, rest) = M::decode_prefix(payload).unwrap();
    assert!(rest.is_empty());
    assert_eq!(message.encode(&mut [0; 255]), Ok(payload));
    if M::MIN_LEN > 0 && M::MIN_LEN == payload.len() {
        let got = payload.len() - 1;
        let error = DecodeError::TooShort { command: M::SPEC, needed: payload.len(), got };
        assert_eq!(M::decode(&payload[..got]).err(), Some(error));
    }
    message
}

#[test]
fn block_3_has_its_fields_in_place() {
    let payload = ramp::<134>();
    let params: Params3 = whole(&payload);
    assert_eq!(params.profile_id, ProfileId::Profile1);
    // Axis by axis, not field by field.
    let pitch = MotorTuning {
        p: PidTerm(7),
        i: PidTerm(8),
        d: PidTerm(9),
        power: 10,
        invert: Switch::Unknown(11),
        poles: 12,
    };
    assert_eq!(params.motors.pitch, pitch);
    assert_eq!(params.acc_limiter_all.degrees_per_second2(), 95.0);
    assert_eq!(params.ext_fc_gain, [20, 21]);
    assert_eq!(params.rc.yaw.rc_min_angle, 0x2726);
    assert_eq!(params.rc.yaw.rc_mode.mode(), RcMode::Tracking);
    assert!(params.rc.yaw.rc_mode.inverted());
    assert_eq!(params.rc.yaw.rc_follow, 45);
    assert_eq!(params.pwm_freq, PwmFrequency::Unknown(48));
    assert_eq!(params.rc_trim, PerAxis { roll: 50, pitch: 51, yaw: 52 });
    assert_eq!(params.rc_map_fc_pitch.kind(), RcSourceKind::Analog);
    assert_eq!(params.rc_mix_fc_roll.rate(), 62);
    assert_eq!(params.rc_mix_fc_roll.target(), FcMixTarget::NoMix);
    assert_eq!(params.follow_offset.roll, 67);
    assert_eq!(params.gyro_deadband.units(), 7.5);
    assert_eq!(params.rc_cmd_low, MenuCommand::ServoModeOn);
    assert_eq!(params.menu_cmd_long, MenuCommand::Unknown(87));
    assert_eq!(params.bat_threshold_alarm, VoltageThreshold(0x5C5B));
    assert_eq!(params.beeper_modes.bits(), 97);
    assert_eq!(params.frame_angle_from_motors, Switch::Unknown(106));
    assert_eq!(params.rc_memory.roll, Angle(0x6C6B));
    assert_eq!(params.servo_rate.hertz(), 1170.0);
    assert_eq!(params.follow_lpf.yaw, 124);
    assert_eq!(params.general_flags1.bits(), 0x7E7D);
    assert_eq!(params.profile_flags1.bits(), 0x807F);
    assert_eq!(params.euler_order.order(), EulerOrder::RollPitchMotorYawMotor);
    assert_eq!(params.cur_imu, ImuType::Unknown(132));
    assert_eq!(params.cur_profile_id, ProfileId::Unknown(133));

    let write: WriteParams3 = whole(&payload);
    assert_eq!(write.0, params);
}

#[test]
fn signed_bytes_are_signed() {
    let mut payload = [0; 134];
    payload[29] = 0x81;
    payload[71] = 0xFE;
    payload[93..95].copy_from_slice(&(-1_i16).to_le_bytes());
    let params: Params3 = whole(&payload);
    assert_eq!(params.rc.roll.rc_follow, -127);
    assert_eq!(params.axis_right, AxisOrientation::NegativeY);
    assert_eq!(params.bat_threshold_motors.volts(), -0.01);
}

#[test]
fn ext_has_three_notch_filters_an_axis() {
    let payload = ramp::<104>();
    let params: ParamsExt = whole(&payload);
    assert_eq!(params.notch_filters.pitch.notch_freq[2].hertz(), 18.0);
    assert_eq!(params.notch_filters.yaw.notch_width, [16, 17, 18]);
    assert_eq!(params.lpf_freq.roll, 0x1413);
    assert_eq!(
        params.filters_en.roll,
        FiltersEnabled::NOTCH1 | FiltersEnabled::LPF | FiltersEnabled::from_bits_retain(16)
    );
    assert_eq!(params.encoder_manual_set_time.roll.milliseconds(), 400.0);
    assert_eq!(params.follow_inside_deadband, 51);
    assert_eq!(params.motor_gearing.roll, Gearing(0x3837));
    assert_eq!(params.encoder_limit_min.roll.degrees(), 183.0);
    assert_eq!(params.notch3_gain.yaw, 75);
    assert_eq!(params.encoder_gear_ratio.roll, GearRatio(0x4E4D));
    // 83 is 0x53.
    assert!(params.encoder_type.roll.skip_detection() && !params.encoder_type.roll.geared());
    assert_eq!(params.encoder_type.roll.encoder_type(), EncoderType::As5048Pwm);
    assert_eq!(params.outer_p.roll, 89);
    assert_eq!(params.mag_axis_right, AxisOrientation::Unknown(96));
    assert_eq!(params.acc_lpf_freq, SlowFilterFrequency(0x6463));
    assert_eq!(params.d_term_lpf_freq.yaw.hertz(), 1030.0);

    let write: WriteParamsExt = whole(&payload);
    assert_eq!(write.0, params);
}

#[test]
fn ext2_has_its_groups_in_place() {
    let payload = ramp::<151>();
    let params: ParamsExt2 = whole(&payload);
    let second = MavChannel {
        mav_src: DevicePort::Unknown(9),
        mav_sys_id: 10,
        mav_comp_id: 11,
        mav_cfg_flags: MavConfig(12),
        mav_reserved: Reserved([13, 14, 15, 16]),
    };
    assert_eq!(params.mav_channels[1], second);
    assert_eq!(second.mav_cfg_flags.baud(), SerialSpeed::Baud9600);
    assert!(second.mav_cfg_flags.parity_even() && !second.mav_cfg_flags.heartbeat());
    assert_eq!(params.motor_mag_link_fine.roll, MagneticLink(0x1211));
    assert_eq!(params.pid_gain.roll, PidGain(26));
    assert_eq!(params.frame_cam_angle_max.roll, 0x2726);
    assert_eq!(params.imu_orientation_corr.x, CorrectionAngle(0x3130));
    assert_eq!(params.emergency_stop_restart_delay, 0x3938);
    assert_eq!(params.timelapse_acc_part.percent(), 11.6);
    assert_eq!(params.stab_axis.roll.axis(), StabAxis::Pitch);
    assert!(params.stab_axis.roll.auto_pitch());
    assert_eq!(params.startup_action[0].action(), MenuCommand::ShakeGeneratorOn);
    assert_eq!(params.startup_action_src[1], [RcSource(86), RcSource(87), RcSource(88), RcSource(89)]);
    assert_eq!(params.startup_action_threshold[1][3].level(), 9.7);
    assert_eq!(params.force_position_cfg.roll.snap(), SnapAngle::Degrees90);
    assert!(params.force_position_cfg.roll.ignores_limits());
    assert_eq!(
        params.step_signals[5],
        StepSignal { step_signal_src: RcSource(111), step_signal_cfg: StepSignalConfig(112) }
    );
    assert_eq!(params.step_signals[5].step_signal_cfg.mode(), StepSignalMode::High);
    assert_eq!(params.rc_calibs[4].rc_calib_offset, -126);
    assert_eq!(params.interrupt_cfg, InterruptConfig(0x8887));
    assert_eq!(params.interrupt_cfg.with_pin(TriggerPinId::Aux3), InterruptConfig(0x8892));
    assert_eq!(params.overload_time.milliseconds(), 13_700.0);
    assert_eq!(params.jerk_slope.roll, 139);
    assert_eq!(params.uart2_speed, SerialSpeed::Unknown(144));
    assert_eq!(params.motor_res.roll.milliohms(), 14_500.0);
    assert_eq!(params.current_limit, CurrentLimit(0x9594));
    assert_eq!(params.middle_mot_tilt_angle, -106);

    let write: WriteParamsExt2 = whole(&payload);
    assert_eq!(write.0, params);
}

#[test]
fn ext3_has_the_newer_fields_in_place() {
    let payload = ramp::<221>();
    let params: ParamsExt3 = whole(&payload);
    assert_eq!(params.ext_imu_type, ExtImuType::Unknown(22));
    assert_eq!(params.ext_imu_orientation, 25);
    assert_eq!(params.ext_imu_flags.bits(), 0x1B1A);
    assert_eq!(params.soft_limit_width.roll.degrees(), 4.0);
    assert_eq!(params.glock_mid_mot_pos_corr_rate, 46);
    assert_eq!(params.extra_btn_cfg[0].pin(), TriggerPinId::Unknown(15));
    assert_eq!(params.power_ctrl_overcurrent_protection.amperes(), 26.0);
    assert_eq!(params.lpf_q_inv.roll.inverse_quality(), 1.4);
    assert_eq!(params.profile_flags2.bits(), 0x4140);
    assert_eq!(params.general_flags3.bits(), 0x4847_4645);
    assert_eq!(params.follow_offset_ext.yaw, Angle(0x4E4D));
    assert_eq!(params.rc_expo_rate_yaw, 94);
    assert_eq!(params.default_profile, ProfileId::Unknown(99));
    assert_eq!(params.retracted_angle.roll, 0x6564);
    assert_eq!(params.shake_base_freq.hertz(), 5.75);
    assert_eq!(params.shake_pause_period.milliseconds(), 2720.0);
    assert_eq!(params.shake_freq_shift, [120, 121, 122]);
    assert_eq!(params.ext_motor_drv_ids, [128, 129, 130, 131, 132, 133, 134]);
    // 0x8887.
    assert_eq!(params.encoder_cfg_ext.roll.resolution(), 7);
    assert_eq!(params.encoder_cfg_ext.roll.multi_turn(), MultiTurn::Bits24);
    assert_eq!(params.ext_sens_params.0[15], 156);
    assert_eq!(params.imu_angle_corr_p, CorrectionAngle(0xA09F_u16.cast_signed()));
    assert_eq!(params.servo_outer_i, ServoTerm(165));
    assert_eq!(params.ext_pwr_sw_shunt_r, ShuntResistance(0xA7A6));
    assert_eq!(params.general_flags4.bits(), 0xABAA_A9A8);
    assert_eq!(params.auto_motion_timeout, 172);
    assert_eq!(params.reserved4.0[47], 220);

    let write: WriteParamsExt3 = whole(&payload);
    assert_eq!(write.0, params);
}

#[test]
fn profiles_are_asked_for_by_number() {
    // From the specification's example of a frame: read Profile2.
    let mut buffer = [0; 16];
    let frame = ReadParams { profile_id: ProfileId::Profile2 }.encode_frame(Version::V1, &mut buffer);
    assert_eq!(frame, Ok(&[0x3E, 0x52, 0x01, 0x53, 0x01, 0x01][..]));

    for raw in [0, 4, 5, 253, 254, 255] {
        assert_eq!(whole::<ReadParamsExt2>(&[raw]).profile_id, ProfileId::from(raw));
        assert_eq!(whole::<UseDefaults>(&[raw]).profile_id, ProfileId::from(raw));
    }
    assert_eq!(whole::<WriteParamsSet>(&[1]).action, WriteParamsSetAction::Start);
    assert_eq!(whole::<Params<'_>>(&[1, 2, 3]).data, [1, 2, 3]);
}

#[test]
fn sets_of_profiles_are_loaded() {
    let payload = [6, 3, 9, 8, 7, 6, 5, 4, 3, 2];
    let set: ProfileSet = whole(&payload);
    assert_eq!(set.slot, ProfileSetSlot::Backup);
    assert_eq!(set.action, ProfileSetAction::Load);
    assert_eq!(set.reserved.0, payload[2..]);
}

#[test]
fn names_are_48_bytes_each() {
    let mut payload = [0; 240];
    payload[48..53].copy_from_slice("Höhe".as_bytes());
    // What stands behind the first zero is not the name's, but it stays.
    payload[54] = 7;
    payload[239] = 0xFF;
    let names: ProfileNames = whole(&payload);
    assert_eq!(names.profile_name[0].as_str(), Ok(""));
    assert_eq!(names.profile_name[1].as_str(), Ok("Höhe"));
    assert_eq!(whole::<WriteProfileNames>(&payload).0, names);
}

#[test]
fn curves_go_through_their_points() {
    assert_eq!(PidTerm(0).logarithmic(), 0.0);
    assert_eq!(PidGain(0).gain(), 0.1);
    assert_eq!(PidGain(128).centered(), 1.0);
    assert_eq!(PidGain(1).centered(), 0.02);
    assert_eq!(ServoFactor(0).factor(), 0.1);
    assert_eq!(ServoFactor(255).factor(), 50.0);
    for raw in 0..=255 {
        assert_eq!(PidTerm::from_logarithmic(PidTerm(raw).logarithmic()), PidTerm(raw));
        assert_eq!(PidGain::from_gain(PidGain(raw).gain()), PidGain(raw));
        assert_eq!(PidGain::from_centered(PidGain(raw).centered()), PidGain(raw));
        let exact = 5.0 * (f64::from(raw) * 52_f64.ln() / 255.0).exp() - 5.0;
        assert!((f64::from(PidTerm(raw).logarithmic()) - exact).abs() < 1e-4);
    }
    assert_eq!(PidTerm::from_logarithmic(f32::NAN), PidTerm(0));
    assert_eq!(PidTerm::from_logarithmic(1e9), PidTerm(255));
}
