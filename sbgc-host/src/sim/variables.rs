//! Which parameter each adjustable variable is.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use sbgc_proto::Message;
use sbgc_proto::commands::{AdjustableVariable as Var, Params3, ParamsExt, ParamsExt2, ParamsExt3};
use sbgc_proto::reflect::{Describe, Leaf, Scalar, walk};

use super::eeprom::Block;

/// Where the value of a variable stands in the blocks of a profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Home {
    block: Block,
    path: &'static str,
    /// A step of the parameter in units of the variable.
    step: f64,
    /// The value of the variable for a raw 0.
    zero: f64,
    /// The bits of the parameter that are meant.
    mask: u8,
}

const fn plain(block: Block, path: &'static str) -> Home {
    Home { block, path, step: 1.0, zero: 0.0, mask: 0xFF }
}

const fn stepped(block: Block, path: &'static str, step: f64) -> Home {
    Home { block, path, step, zero: 0.0, mask: 0xFF }
}

const fn masked(block: Block, path: &'static str, mask: u8) -> Home {
    Home { block, path, step: 1.0, zero: 0.0, mask }
}

/// The homes of a variable; more than one where it stands for all axes, none where no parameter holds it.
#[rustfmt::skip]
#[allow(clippy::too_many_lines, reason = "it is a list")]
pub(super) fn homes(variable: Var) -> &'static [Home] {
    use Block::{Ext, Ext2, Ext3, Params3};
    macro_rules! home { ($($home:expr),*) => { const { &[$($home),*] } }; }
    match variable {
        Var::PRoll => home![plain(Params3, "motors.roll.p")],
        Var::PPitch => home![plain(Params3, "motors.pitch.p")],
        Var::PYaw => home![plain(Params3, "motors.yaw.p")],
        Var::IRoll => home![plain(Params3, "motors.roll.i")],
        Var::IPitch => home![plain(Params3, "motors.pitch.i")],
        Var::IYaw => home![plain(Params3, "motors.yaw.i")],
        Var::DRoll => home![plain(Params3, "motors.roll.d")],
        Var::DPitch => home![plain(Params3, "motors.pitch.d")],
        Var::DYaw => home![plain(Params3, "motors.yaw.d")],
        Var::PowerRoll => home![plain(Params3, "motors.roll.power")],
        Var::PowerPitch => home![plain(Params3, "motors.pitch.power")],
        Var::PowerYaw => home![plain(Params3, "motors.yaw.power")],
        Var::AccLimiter => home![
            stepped(Ext2, "acc_limiter.roll", 5.0),
            stepped(Ext2, "acc_limiter.pitch", 5.0),
            stepped(Ext2, "acc_limiter.yaw", 5.0)
        ],
        Var::FollowSpeedRoll => home![plain(Params3, "follow_speed.roll")],
        Var::FollowSpeedPitch => home![plain(Params3, "follow_speed.pitch")],
        Var::FollowSpeedYaw => home![plain(Params3, "follow_speed.yaw")],
        Var::FollowLpfRoll => home![plain(Params3, "follow_lpf.roll")],
        Var::FollowLpfPitch => home![plain(Params3, "follow_lpf.pitch")],
        Var::FollowLpfYaw => home![plain(Params3, "follow_lpf.yaw")],
        Var::RcSpeedRoll => home![plain(Params3, "rc.roll.rc_speed")],
        Var::RcSpeedPitch => home![plain(Params3, "rc.pitch.rc_speed")],
        Var::RcSpeedYaw => home![plain(Params3, "rc.yaw.rc_speed")],
        Var::RcLpfRoll => home![plain(Params3, "rc.roll.rc_lpf")],
        Var::RcLpfPitch => home![plain(Params3, "rc.pitch.rc_lpf")],
        Var::RcLpfYaw => home![plain(Params3, "rc.yaw.rc_lpf")],
        Var::RcTrimRoll => home![plain(Params3, "rc_trim.roll")],
        Var::RcTrimPitch => home![plain(Params3, "rc_trim.pitch")],
        Var::RcTrimYaw => home![plain(Params3, "rc_trim.yaw")],
        Var::RcDeadband => home![plain(Params3, "rc_deadband")],
        Var::RcExpoRate => home![plain(Params3, "rc_expo_rate")],
        Var::FollowPitch => home![stepped(Params3, "follow_mode", 0.5)],
        Var::FollowYawPitch => home![plain(Params3, "rc.yaw.rc_follow")],
        Var::FollowDeadband => home![plain(Params3, "follow_deadband")],
        Var::FollowExpoRate => home![plain(Params3, "follow_expo_rate")],
        Var::FollowRollMixStart => home![plain(Params3, "follow_roll_mix_start")],
        Var::FollowRollMixRange => home![plain(Params3, "follow_roll_mix_range")],
        Var::GyroTrust => home![plain(Params3, "gyro_trust")],
        Var::AccLimiterRoll => home![stepped(Ext2, "acc_limiter.roll", 5.0)],
        Var::AccLimiterPitch => home![stepped(Ext2, "acc_limiter.pitch", 5.0)],
        Var::AccLimiterYaw => home![stepped(Ext2, "acc_limiter.yaw", 5.0)],
        Var::PidGainRoll => home![plain(Ext2, "pid_gain.roll")],
        Var::PidGainPitch => home![plain(Ext2, "pid_gain.pitch")],
        Var::PidGainYaw => home![plain(Ext2, "pid_gain.yaw")],
        Var::LpfFreqRoll => home![plain(Ext, "lpf_freq.roll")],
        Var::LpfFreqPitch => home![plain(Ext, "lpf_freq.pitch")],
        Var::LpfFreqYaw => home![plain(Ext, "lpf_freq.yaw")],
        Var::TimelapseTime => home![plain(Ext2, "timelapse_time")],
        Var::MavCtrlMode => home![plain(Ext2, "mav_ctrl_mode")],
        Var::SwLimMinRoll => home![plain(Ext2, "frame_cam_angle_min.roll")],
        Var::SwLimMaxRoll => home![plain(Ext2, "frame_cam_angle_max.roll")],
        Var::SwLimMinPitch => home![plain(Ext2, "frame_cam_angle_min.pitch")],
        Var::SwLimMaxPitch => home![plain(Ext2, "frame_cam_angle_max.pitch")],
        Var::SwLimMinYaw => home![plain(Ext2, "frame_cam_angle_min.yaw")],
        Var::SwLimMaxYaw => home![plain(Ext2, "frame_cam_angle_max.yaw")],
        Var::FollowRangeRoll => home![plain(Ext2, "follow_range.roll")],
        Var::FollowRangePitch => home![plain(Ext2, "follow_range.pitch")],
        Var::FollowRangeYaw => home![plain(Ext2, "follow_range.yaw")],
        Var::AutoPidTarget => home![plain(Ext2, "auto_pid_gain")],
        Var::RcModeRoll => home![masked(Params3, "rc.roll.rc_mode", 0x07)],
        Var::RcModePitch => home![masked(Params3, "rc.pitch.rc_mode", 0x07)],
        Var::RcModeYaw => home![masked(Params3, "rc.yaw.rc_mode", 0x07)],
        Var::EulerOrder => home![masked(Params3, "euler_order", 0x0F)],
        Var::FollowInDband => home![plain(Ext, "follow_inside_deadband")],
        Var::RcLimitMinRoll => home![plain(Params3, "rc.roll.rc_min_angle")],
        Var::RcLimitMaxRoll => home![plain(Params3, "rc.roll.rc_max_angle")],
        Var::RcLimitMinPitch => home![plain(Params3, "rc.pitch.rc_min_angle")],
        Var::RcLimitMaxPitch => home![plain(Params3, "rc.pitch.rc_max_angle")],
        Var::RcLimitMinYaw => home![plain(Params3, "rc.yaw.rc_min_angle")],
        Var::RcLimitMaxYaw => home![plain(Params3, "rc.yaw.rc_max_angle")],
        Var::RcDeadbandPitch => home![plain(Ext3, "rc_deadband_pitch")],
        Var::RcDeadbandYaw => home![plain(Ext3, "rc_deadband_yaw")],
        Var::RcExpoRatePitch => home![plain(Ext3, "rc_expo_rate_pitch")],
        Var::RcExpoRateYaw => home![plain(Ext3, "rc_expo_rate_yaw")],
        Var::ShakeAmpRoll => home![plain(Ext3, "shake_amplitude[0]")],
        Var::ShakeAmpTilt => home![plain(Ext3, "shake_amplitude[1]")],
        Var::ShakeAmpPan => home![plain(Ext3, "shake_amplitude[2]")],
        Var::ShakeFreq => home![plain(Ext3, "shake_base_freq")],
        Var::ShakeFreqRange => home![plain(Ext3, "shake_freq_range")],
        Var::ShakePausePeriod => {
            home![Home { step: 20.0, zero: 500.0, ..plain(Ext3, "shake_pause_period") }]
        }
        Var::ShakePauseBalance => home![plain(Ext3, "shake_pause_balance")],
        Var::ShakePauseRandomness => home![plain(Ext3, "shake_pause_randomness")],
        Var::ShakeResonanceGainRoll => home![plain(Ext3, "shake_resonance_gain[0]")],
        Var::ShakeResonanceGainTilt => home![plain(Ext3, "shake_resonance_gain[1]")],
        Var::ShakeResonanceGainPan => home![plain(Ext3, "shake_resonance_gain[2]")],
        Var::ShakeFreqShiftRoll => home![plain(Ext3, "shake_freq_shift[0]")],
        Var::ShakeFreqShiftTilt => home![plain(Ext3, "shake_freq_shift[1]")],
        Var::ShakeFreqShiftPan => home![plain(Ext3, "shake_freq_shift[2]")],
        Var::OuterPRoll => home![plain(Ext, "outer_p.roll")],
        Var::OuterPPitch => home![plain(Ext, "outer_p.pitch")],
        Var::OuterPYaw => home![plain(Ext, "outer_p.yaw")],
        Var::DLpfFreqRoll => home![plain(Ext, "d_term_lpf_freq.roll")],
        Var::DLpfFreqPitch => home![plain(Ext, "d_term_lpf_freq.pitch")],
        Var::DLpfFreqYaw => home![plain(Ext, "d_term_lpf_freq.yaw")],
        Var::ImuAngleCorrRoll => home![plain(Ext3, "imu_angle_corr_r")],
        Var::ImuAngleCorrPitch => home![plain(Ext3, "imu_angle_corr_p")],
        Var::SwLimWidthRoll => home![plain(Ext3, "soft_limit_width.roll")],
        Var::SwLimWidthPitch => home![plain(Ext3, "soft_limit_width.pitch")],
        Var::SwLimWidthYaw => home![plain(Ext3, "soft_limit_width.yaw")],
        // What corrects the attitude from outside, the master gain of the shake generator, and what is not known.
        _ => &[],
    }
}

/// The minimum and the maximum of a variable; `None` for one that is not known.
pub(super) fn range(variable: Var) -> Option<(f64, f64)> {
    let facts = variable.facts()?;
    let (least, most) = facts.range.unwrap_or(match variable {
        Var::EulerOrder => (0, 5),
        _ => (0, 2),
    });
    Some((f64::from(least), f64::from(facts.newer_most.unwrap_or(most))))
}

type Places = BTreeMap<(u8, String), (usize, Scalar)>;

fn places() -> &'static Places {
    static PLACES: OnceLock<Places> = OnceLock::new();
    PLACES.get_or_init(|| {
        let mut places = Places::new();
        collect(&mut places, Block::Params3, &Params3::default());
        collect(&mut places, Block::Ext, &ParamsExt::default());
        collect(&mut places, Block::Ext2, &ParamsExt2::default());
        collect(&mut places, Block::Ext3, &ParamsExt3::default());
        places
    })
}

fn collect<M: Describe + Message>(places: &mut Places, block: Block, message: &M) {
    walk(message, &mut |leaf: &Leaf<'_>| {
        if let Some(number) = leaf.number {
            places.insert((block as u8, leaf.path.to_string()), (leaf.offset, number.scalar));
        }
    });
}

impl Home {
    pub(super) fn block(self) -> Block {
        self.block
    }

    /// The bytes of the parameter in its block.
    fn place(self) -> Option<(std::ops::Range<usize>, Scalar)> {
        let (offset, scalar) = *places().get(&(self.block as u8, self.path.to_owned()))?;
        Some((offset..offset + scalar.size(), scalar))
    }

    /// The value of the variable in a block.
    pub(super) fn read(self, block: &[u8]) -> Option<f64> {
        let (range, scalar) = self.place()?;
        let raw = match (block.get(range)?, scalar) {
            ([low], Scalar::i8) => i32::from(low.cast_signed()),
            ([low], _) => i32::from(low & self.mask),
            ([low, high], Scalar::i16) => i32::from(i16::from_le_bytes([*low, *high])),
            ([low, high], _) => i32::from(u16::from_le_bytes([*low, *high])),
            _ => return None,
        };
        Some(f64::from(raw) * self.step + self.zero)
    }

    /// Puts the value of the variable into a block, as near as the parameter can hold it.
    pub(super) fn write(self, block: &mut [u8], value: f64) {
        let Some((range, scalar)) = self.place() else { return };
        let raw = ((value - self.zero) / self.step).round();
        let (least, most) = scalar.limits();
        #[allow(clippy::cast_possible_truncation, reason = "it is within the limits of 16 bits")]
        let raw = raw.clamp(least, most) as i32;
        let [low, high, ..] = raw.to_le_bytes();
        match block.get_mut(range) {
            Some([place]) => *place = *place & !self.mask | low & self.mask,
            Some([first, second]) => [*first, *second] = [low, high],
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::factory;

    #[test]
    fn every_home_is_a_parameter_and_keeps_values() {
        let mut homeless = Vec::new();
        for facts in Var::ALL {
            let homes = homes(facts.variable);
            if homes.is_empty() {
                homeless.push(facts.variable);
            }
            for home in homes {
                let mut block = factory::block(0, home.block(), 0);
                let (least, most) = range(facts.variable).unwrap();
                for value in [least, most.min(least + 100.0)] {
                    home.write(&mut block, value);
                    let read = home.read(&block).unwrap_or_else(|| panic!("{}: {}", facts.name, home.path));
                    assert!((read - value).abs() <= home.step / 2.0, "{}: {value}, {read}", facts.name);
                }
            }
        }
        assert_eq!(Var::ALL.len(), 102);
        assert_eq!(
            homeless,
            [Var::FrameHeadingAngle, Var::GyroHeadingCorrection, Var::HCorrFactor, Var::ShakeMasterGain]
        );
    }
}
