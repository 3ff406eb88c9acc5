//! Automatic tuning of the PID loops, in the form that the firmware has, and Bode tests.

use bytes::Bytes;
use sbgc_proto::commands::{
    AutoPid2Action, AutoPid2Axis, AutoPid2AxisFlags, AutoPid2CmdFlags, AutoPid2GeneralFlags,
    AutoPid2LegacyAxis, AutoPid2LegacyRequest, AutoPid2Request, AutoPid2SimpleRequest, AutoPidAction,
    AutoPidFlags, AutoPidRequest, Axis, BodeStimulusType, BodeTestStartStopRequest, BodeTestSystem,
    ProfileId,
};
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::wire::{PerAxis, ToWire};
use sbgc_proto::{CommandId, Message};

use crate::error::Result;
use crate::gimbal::encode;

/// The first firmware with the second version of tuning, and the first with its present layout.
const SECOND_SINCE: FirmwareVersion = FirmwareVersion::new(2, 70, 0);
const PRESENT_SINCE: FirmwareVersion = FirmwareVersion::new(2, 73, 0);

/// What automatic tuning is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tuning {
    /// The axes to tune.
    pub axes: PerAxis<bool>,
    /// 0 for stability, 255 for performance.
    pub gain: u8,
    /// Strength of the test signal; firmware before 2.73 takes up to 255, before 2.70 none.
    pub stimulus: u16,
    /// Tunes the gain only. Firmware 2.70+.
    pub gain_only: bool,
    /// Starts from the present values.
    pub from_current: bool,
    /// Saves the result to all profiles.
    pub all_profiles: bool,
}

impl Default for Tuning {
    /// All axes, between stability and performance, from the beginning.
    fn default() -> Self {
        Self {
            axes: [true; 3].into(),
            gain: 128,
            stimulus: 100,
            gain_only: false,
            from_current: false,
            all_profiles: false,
        }
    }
}

impl Tuning {
    pub(super) fn command(self, firmware: FirmwareVersion) -> Result<(CommandId, Bytes)> {
        if firmware < SECOND_SINCE {
            return frame(&self.first());
        }
        let mut general_flags = AutoPid2GeneralFlags::AUTO_SAVE;
        general_flags.set(AutoPid2GeneralFlags::START_FROM_CURRENT, self.from_current);
        general_flags.set(AutoPid2GeneralFlags::SAVE_TO_ALL_PROFILES, self.all_profiles);
        general_flags.set(AutoPid2GeneralFlags::TUNE_GAIN_ONLY, self.gain_only);
        let flags = |enabled| AutoPid2AxisFlags::default().with_enabled(enabled);
        if firmware < PRESENT_SINCE {
            let stimulus = u8::try_from(self.stimulus).unwrap_or(u8::MAX);
            let axis = AutoPid2LegacyAxis { gain: self.gain, stimulus, ..AutoPid2LegacyAxis::default() };
            return frame(&AutoPid2LegacyRequest {
                action: AutoPid2Action::Start,
                cfg_version: 1,
                axes: self.axes.map(|enabled| AutoPid2LegacyAxis { axis_flags: flags(enabled), ..axis }),
                general_flags,
                ..AutoPid2LegacyRequest::default()
            });
        }
        let axis = AutoPid2Axis { gain: self.gain, stimulus_gain: self.stimulus, ..AutoPid2Axis::default() };
        frame(&AutoPid2Request {
            action: AutoPid2Action::Start,
            cmd_flags: AutoPid2CmdFlags::SEND_PARAMS_ON_FINISH,
            cfg_version: 1,
            axes: self.axes.map(|enabled| AutoPid2Axis { axis_flags: flags(enabled), ..axis }),
            general_flags,
            ..AutoPid2Request::default()
        })
    }

    fn first(self) -> AutoPidRequest {
        let PerAxis { roll, pitch, yaw } = self.axes;
        let mut cfg_flags = AutoPidFlags::SEND_GUI;
        cfg_flags.set(AutoPidFlags::ROLL, roll);
        cfg_flags.set(AutoPidFlags::PITCH, pitch);
        cfg_flags.set(AutoPidFlags::YAW, yaw);
        cfg_flags.set(AutoPidFlags::KEEP_CURRENT, self.from_current);
        cfg_flags.set(AutoPidFlags::ALL_PROFILES, self.all_profiles);
        AutoPidRequest {
            profile_id: ProfileId::Current,
            cfg_flags,
            gain_vs_stability: self.gain,
            action: AutoPidAction::Start,
            ..AutoPidRequest::default()
        }
    }
}

/// The command that stops tuning.
pub(super) fn stop_tuning(firmware: FirmwareVersion) -> Result<(CommandId, Bytes)> {
    if firmware < SECOND_SINCE {
        return frame(&AutoPidRequest::default());
    }
    frame(&AutoPid2SimpleRequest { action: AutoPid2Action::Stop, ..AutoPid2SimpleRequest::default() })
}

/// A Bode test: an axis is driven by a test signal, and signal and response come back as
/// [`BodeTestData`](sbgc_proto::commands::BodeTestData).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodeTest {
    /// The axis.
    pub axis: Axis,
    /// Strength of the test signal, at least 1.
    pub gain: u16,
    /// Number of samples of 0.8 ms.
    pub samples: u32,
    /// Lowest and highest frequency, in Hz.
    pub frequencies: (u16, u16),
}

impl BodeTest {
    pub(super) fn command(self) -> BodeTestStartStopRequest {
        BodeTestStartStopRequest {
            axis: self.axis,
            stimulus_type: BodeStimulusType::ExponentialSineSweep,
            stimulus_gain: self.gain,
            start_freq: self.frequencies.0,
            end_freq: self.frequencies.1,
            system: BodeTestSystem::OverallSystemResponse,
            samples_num: self.samples,
            ..BodeTestStartStopRequest::default()
        }
    }
}

/// The id and the payload of a command.
pub(super) fn frame<M: Message + ToWire>(command: &M) -> Result<(CommandId, Bytes)> {
    Ok((M::ID, encode(command)?))
}
