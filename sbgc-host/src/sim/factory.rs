//! What the board has from the factory: parameters of every block, each within the range that the protocol gives it.

use std::array;

use sbgc_proto::commands::{
    AxisOrientation, BeeperModes, DevicePort, EncoderSelection, EncoderType, ExtImuPosition, ExtImuType,
    FiltersEnabled, FrameImuPosition, GeneralFlags1, ImuType, MenuCommand, MotorOutput, MotorTuning,
    NotchFilters, Params3, ParamsExt, ParamsExt2, ParamsExt3, ProfileId, ProfileNames, RcAxis, RcCalibration,
    RcSource, Switch,
};
use sbgc_proto::units::{
    AccelerationLimit, CurrentLimit, Delay, Ellipticity, FastFilterFrequency, GearRatio, Gearing, LimitWidth,
    MagneticLink, NotchFrequency, PhaseResistance, PidGain, PidTerm, ServoRate, ShakeFrequency, ShakePause,
    ShakeRange, ShakeResonance, ShuntResistance, SlowFilterFrequency, TripCurrent, VoltageThreshold,
};
use sbgc_proto::wire::{FixedText, PerAxis};

use super::eeprom::Block;
use super::reply::Packet;

/// A block of a profile as its payload.
pub(super) fn block(profile: u8, block: Block, default_profile: u8) -> Vec<u8> {
    let packet = match block {
        Block::Params3 => Packet::of(&params_3(profile)),
        Block::Ext => Packet::of(&ext(profile)),
        Block::Ext2 => Packet::of(&ext_2(profile)),
        Block::Ext3 => Packet::of(&ext_3(profile, default_profile)),
    };
    packet.map(|packet| packet.payload).unwrap_or_default()
}

/// The names of the profiles.
pub(super) fn names() -> Vec<u8> {
    let name = |number| FixedText::new(&format!("Profile {number}")).unwrap_or_default();
    let names = ProfileNames { profile_name: [1, 2, 3, 4, 5].map(name) };
    Packet::of(&names).map(|packet| packet.payload).unwrap_or_default()
}

fn params_3(profile: u8) -> Params3 {
    let tuning = |p, power| MotorTuning {
        p: PidTerm(p + profile),
        i: PidTerm(20),
        d: PidTerm(40),
        power,
        invert: Switch::Off,
        poles: 22,
    };
    let output = |axis| MotorOutput::from(axis);
    Params3 {
        profile_id: profile.into(),
        motors: PerAxis { roll: tuning(30, 120), pitch: tuning(35, 150), yaw: tuning(40, 150) },
        acc_limiter_all: AccelerationLimit(60),
        rc: PerAxis { roll: rc_axis(profile), pitch: rc_axis(profile), yaw: rc_axis(profile) },
        gyro_trust: 120,
        rc_map_roll: RcSource::RC_INPUT_ROLL,
        rc_map_pitch: RcSource::RC_INPUT_PITCH,
        rc_map_yaw: RcSource::RC_INPUT_YAW,
        rc_map_fc_roll: RcSource::EXT_FC_INPUT_ROLL,
        rc_map_fc_pitch: RcSource::EXT_FC_INPUT_PITCH,
        follow_deadband: 5,
        axis_top: AxisOrientation::Z,
        axis_right: AxisOrientation::X,
        frame_axis_top: AxisOrientation::Z,
        frame_axis_right: AxisOrientation::X,
        frame_imu_pos: FrameImuPosition::AboveYaw,
        i2c_speed_fast: sbgc_proto::commands::I2cSpeed::Khz400,
        menu_cmd_1: MenuCommand::Profile1,
        menu_cmd_2: MenuCommand::Profile2,
        menu_cmd_3: MenuCommand::Profile3,
        menu_cmd_4: MenuCommand::CalibGyro,
        menu_cmd_5: MenuCommand::MotorToggle,
        menu_cmd_long: MenuCommand::CalibAcc,
        motor_output: PerAxis { roll: output(1), pitch: output(2), yaw: output(3) },
        bat_threshold_alarm: VoltageThreshold(1320),
        bat_threshold_motors: VoltageThreshold(1200),
        bat_comp_ref: VoltageThreshold(1680),
        beeper_modes: BeeperModes::CALIBRATE | BeeperModes::CONFIRM | BeeperModes::ERROR | BeeperModes::ALARM,
        follow_roll_mix_start: 40,
        follow_roll_mix_range: 20,
        follow_speed: [50; 3].into(),
        servo_rate: ServoRate(5),
        adaptive_pid_threshold: 50,
        adaptive_pid_rate: 20,
        adaptive_pid_recovery_factor: 3,
        follow_lpf: [5; 3].into(),
        general_flags1: GeneralFlags1::REMEMBER_LAST_USED_PROFILE,
        cur_imu: ImuType::Main,
        cur_profile_id: ProfileId::Profile1,
        ..Params3::default()
    }
}

/// About 60 degrees per second; each profile is a little slower than the one before.
fn rc_axis(profile: u8) -> RcAxis {
    RcAxis { rc_min_angle: -90, rc_max_angle: 90, rc_lpf: 0, rc_speed: 31 - profile, ..RcAxis::default() }
}

fn ext(profile: u8) -> ParamsExt {
    let notches = NotchFilters { notch_freq: [NotchFrequency(40); 3], notch_width: [10; 3] };
    let encoder = EncoderSelection::default().with_encoder_type(EncoderType::As5048a);
    ParamsExt {
        profile_id: profile.into(),
        notch_filters: [notches; 3].into(),
        lpf_freq: [150; 3].into(),
        filters_en: [FiltersEnabled::LPF; 3].into(),
        motor_heating_factor: [10; 3].into(),
        motor_cooling_factor: [10; 3].into(),
        follow_inside_deadband: 10,
        motor_gearing: [Gearing(256); 3].into(),
        notch1_gain: [20; 3].into(),
        notch2_gain: [20; 3].into(),
        notch3_gain: [20; 3].into(),
        beeper_volume: 50,
        encoder_gear_ratio: [GearRatio(1000); 3].into(),
        encoder_type: [encoder; 3].into(),
        outer_p: [100; 3].into(),
        outer_i: [0; 3].into(),
        mag_axis_top: AxisOrientation::Z,
        mag_axis_right: AxisOrientation::X,
        mag_trust: 100,
        acc_lpf_freq: SlowFilterFrequency(50),
        d_term_lpf_freq: [FastFilterFrequency(0); 3].into(),
        ..ParamsExt::default()
    }
}

fn ext_2(profile: u8) -> ParamsExt2 {
    let neutral = RcCalibration {
        rc_calib_src: RcSource::NOT_ASSIGNED,
        rc_calib_offset: 0,
        rc_calib_neg_scale: 20,
        rc_calib_pos_scale: 20,
    };
    ParamsExt2 {
        profile_id: profile.into(),
        motor_mag_link_fine: [MagneticLink(1000); 3].into(),
        acc_limiter: [AccelerationLimit(60); 3].into(),
        pid_gain: [PidGain(45); 3].into(),
        frame_imu_lpf_freq: 100,
        auto_pid_gain: 100,
        auto_speed: 31,
        auto_acc_limiter: AccelerationLimit(60),
        timelapse_time: 60,
        emergency_stop_restart_delay: 2000,
        momentum: [200; 3].into(),
        momentum_calib_stimulus: [50; 3].into(),
        momentum_ellipticity: [Ellipticity(20); 3].into(),
        follow_range: [90; 3].into(),
        rc_calibs: [neutral; 5],
        overload_time: Delay(20),
        auto_pid_momentum: 0,
        motor_res: [PhaseResistance(100); 3].into(),
        current_limit: CurrentLimit(500),
        ..ParamsExt2::default()
    }
}

fn ext_3(profile: u8, default_profile: u8) -> ParamsExt3 {
    ParamsExt3 {
        profile_id: profile.into(),
        ext_imu_type: ExtImuType::MavLink1,
        ext_imu_port: DevicePort::Disabled,
        ext_imu_position: ExtImuPosition::AboveOuter,
        soft_limit_width: [LimitWidth(20); 3].into(),
        power_ctrl_overcurrent_protection: TripCurrent(20),
        stab_threshold_angle: [30; 3].into(),
        enc_limit_return_speed: [20; 3].into(),
        default_profile: default_profile.into(),
        shake_base_freq: ShakeFrequency(14),
        shake_freq_range: ShakeRange(15),
        shake_pause_period: ShakePause(50),
        shake_pause_balance: 50,
        shake_pause_attenuation: 50,
        shake_pause_randomness: 50,
        shake_resonance_freq: ShakeResonance(30),
        ext_motor_drv_ids: array::from_fn(|index| u8::try_from(index + 1).unwrap_or_default()),
        can_imu_servo_rate: ServoRate(5),
        ext_pwr_sw_shunt_r: ShuntResistance(100),
        ..ParamsExt3::default()
    }
}

#[cfg(test)]
mod tests {
    use sbgc_proto::Message;
    use sbgc_proto::reflect::{Describe, Leaf, walk};

    use super::*;

    fn check(message: &impl Describe, profile: u8) {
        walk(message, &mut |leaf: &Leaf<'_>| {
            let (Some((least, most)), Some(value)) = (leaf.field.range, leaf.value()) else { return };
            let sbgc_proto::reflect::Raw::Number(raw) = leaf.raw else { return };
            #[allow(clippy::cast_precision_loss, reason = "parameters are small numbers")]
            let raw = raw as f64;
            let within = |value: f64| (least..=most).contains(&value);
            assert!(within(raw), "profile {profile}: {} is {value}, raw {raw}", leaf.path);
        });
    }

    #[test]
    fn every_parameter_is_within_its_range_and_has_a_name_where_it_needs_one() {
        for profile in 0..5 {
            let payload = |part| block(profile, part, 0);
            for part in Block::ALL {
                assert_eq!(payload(part).len(), part.size(), "{part:?}");
            }
            check(&Params3::decode(&payload(Block::Params3)).unwrap(), profile);
            check(&ParamsExt::decode(&payload(Block::Ext)).unwrap(), profile);
            check(&ParamsExt2::decode(&payload(Block::Ext2)).unwrap(), profile);
            check(&ParamsExt3::decode(&payload(Block::Ext3)).unwrap(), profile);
        }
        let params = params_3(0);
        for axis in [params.axis_top, params.axis_right, params.frame_axis_top, params.frame_axis_right] {
            assert!(!matches!(axis, AxisOrientation::Unknown(_)));
        }
        assert!(!matches!(params.cur_imu, ImuType::Unknown(_)));
    }
}
