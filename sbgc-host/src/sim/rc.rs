//! The inputs of remote control: pins, analog inputs, serial receivers and virtual channels.
//!
//! Real: sources as the protocol numbers them, virtual channels by `CMD_API_VIRT_CH_CONTROL` and its finer form,
//! corrections of the parameters (`RC_CALIB`), signals of a flight controller that are mixed in (`RC_MIX_FC`), step
//! signals. Nothing is connected to pins and receivers until the program that runs the board connects it; an input
//! without a signal is undefined.
//!
//! Where the protocol leaves it open: a mix rate of 63 is the signal of the flight controller alone, and where only one
//! of the two is there, it counts alone. A step signal goes through its values from the lowest to the highest; its source
//! is high from half of full scale on, and low from there downwards. Counting in one direction, it begins again after the
//! highest value; counting up and down, it stops at the ends. No menu button is pressed, so signals that need one stand.

use std::collections::BTreeMap;

use sbgc_proto::commands::{FcMixTarget, RcSource, RcSourceKind, StepCount, StepSignal, StepSignalMode};
use sbgc_proto::units::RcSignal;

use super::parameters::Settings;

/// How many virtual channels there are.
pub(super) const VIRTUAL_CHANNELS: usize = 32;

/// How many step signals there are.
const STEP_SIGNALS: usize = 6;

/// A step signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Steps {
    config: StepSignal,
    /// Which of its values it has, from 0 on.
    position: u8,
    /// The half of full scale that its source was in last, if any.
    level: Option<bool>,
}

#[derive(Debug, Default)]
pub(super) struct RcInputs {
    virtual_channels: [Option<f64>; VIRTUAL_CHANNELS],
    steps: [Steps; STEP_SIGNALS],
    /// Pairs of axes whose sources the menu has swapped: pitch with roll, yaw with roll.
    pub(super) pitch_swapped: bool,
    pub(super) yaw_swapped: bool,
    /// What is connected to other sources, by their number.
    connected: BTreeMap<u8, f64>,
}

impl RcInputs {
    /// Connects a source to a signal of -1 to 1, or disconnects it.
    pub(super) fn connect(&mut self, source: RcSource, signal: Option<f64>) {
        if let Some(channel) = virtual_channel(source) {
            self.set_virtual(channel, signal);
        } else if let Some(signal) = signal {
            self.connected.insert(source.0, signal);
        } else {
            self.connected.remove(&source.0);
        }
    }

    pub(super) fn set_virtual(&mut self, channel: usize, signal: Option<f64>) {
        if let Some(place) = self.virtual_channels.get_mut(channel) {
            *place = signal;
        }
    }

    /// Forgets what is not connected, as a reset does.
    pub(super) fn reset(&mut self) {
        *self = Self { connected: std::mem::take(&mut self.connected), ..Self::default() };
    }

    /// Lets step signals follow their sources.
    pub(super) fn step(&mut self, settings: &Settings) {
        for (index, config) in settings.ext2.step_signals.into_iter().enumerate() {
            let source = config.step_signal_src;
            let steps = source.kind() != RcSourceKind::StepSignal;
            let signal = if steps { self.signal(source, settings) } else { None };
            let Some(place) = self.steps.get_mut(index) else { continue };
            if place.config != config {
                *place = Steps { config, position: first_step(config), level: None };
            }
            let level = match signal {
                Some(signal) if signal >= 0.5 => Some(true),
                Some(signal) if signal <= -0.5 => Some(false),
                _ => None,
            };
            if level != place.level && !config.step_signal_cfg.button_pressed() {
                place.position = next_step(config, place.position, level);
            }
            place.level = level;
        }
    }

    /// The value of a step signal.
    fn step_signal(&self, source: RcSource) -> Option<f64> {
        let steps = self.steps.get(usize::from(source.channel()).checked_sub(1)?)?;
        let assigned = steps.config.step_signal_src != RcSource::NOT_ASSIGNED;
        let last = step_count(steps.config).saturating_sub(1).max(1);
        assigned.then(|| f64::from(steps.position) / f64::from(last) * 2.0 - 1.0)
    }

    /// The signal that moves an axis.
    pub(super) fn of_axis(&self, index: usize, settings: &Settings) -> Option<f64> {
        let index = match index {
            0 if self.pitch_swapped => 1,
            1 if self.pitch_swapped => 0,
            0 if self.yaw_swapped => 2,
            2 if self.yaw_swapped => 0,
            index => index,
        };
        let [.., fc_roll, fc_pitch] = Self::assigned(settings);
        let own = self.signal(*Self::assigned(settings).get(index)?, settings);
        let params = &settings.params;
        let target = [FcMixTarget::Roll, FcMixTarget::Pitch, FcMixTarget::Yaw];
        let target = *target.get(index)?;
        let mixes = [(params.rc_mix_fc_roll, fc_roll), (params.rc_mix_fc_pitch, fc_pitch)];
        mixes.into_iter().filter(|(mix, _)| mix.target() == target).fold(own, |own, (mix, source)| {
            let share = f64::from(mix.rate()) / 63.0;
            match (own, self.signal(source, settings)) {
                (Some(own), Some(fc)) => Some(own * (1.0 - share) + fc * share),
                (own, fc) => own.or(fc),
            }
        })
    }

    /// The signal of a source, -1 to 1 and slightly beyond.
    pub(super) fn signal(&self, source: RcSource, settings: &Settings) -> Option<f64> {
        let raw = match virtual_channel(source) {
            Some(channel) => *self.virtual_channels.get(channel)?,
            None if source.kind() == RcSourceKind::StepSignal => self.step_signal(source),
            None => self.connected.get(&source.0).copied(),
        }?;
        let calibrations = settings.ext2.rc_calibs.iter();
        let own = calibrations
            .filter(|calibration| calibration.rc_calib_src == source && source != RcSource::NOT_ASSIGNED);
        Some(own.fold(raw, |signal, calibration| {
            let signal = signal + f64::from(calibration.rc_calib_offset) / 128.0;
            let scale =
                if signal > 0.0 { calibration.rc_calib_pos_scale } else { calibration.rc_calib_neg_scale };
            signal * (80.0 + f64::from(scale)) / 100.0
        }))
    }

    /// The sources that the parameters assign to roll, pitch, yaw, command and the two of a flight controller.
    pub(super) fn assigned(settings: &Settings) -> [RcSource; 6] {
        let params = &settings.params;
        [
            params.rc_map_roll,
            params.rc_map_pitch,
            params.rc_map_yaw,
            params.rc_map_cmd,
            params.rc_map_fc_roll,
            params.rc_map_fc_pitch,
        ]
    }

    /// Whether a signal is there that moves an axis.
    pub(super) fn moves(&self, settings: &Settings) -> bool {
        (0..3).any(|index| self.of_axis(index, settings).is_some())
    }

    /// The channels of a serial receiver.
    pub(super) fn serial_channels(&self, settings: &Settings) -> [RcSignal; 18] {
        std::array::from_fn(|index| {
            let channel = u8::try_from(index + 1).unwrap_or_default();
            let source = RcSource::default().with_kind(RcSourceKind::RcSerial).with_channel(channel);
            wire_signal(self.signal(source, settings))
        })
    }
}

/// The index of a virtual channel; they count from 1, and 32 is written as 0.
fn virtual_channel(source: RcSource) -> Option<usize> {
    let channel = usize::from(source.channel());
    (source.kind() == RcSourceKind::ApiVirt).then(|| (channel + VIRTUAL_CHANNELS - 1) % VIRTUAL_CHANNELS)
}

fn step_count(config: StepSignal) -> u8 {
    match config.step_signal_cfg.steps() {
        StepCount::Steps3 => 3,
        StepCount::Steps5 => 5,
        StepCount::Steps10 => 10,
        StepCount::Steps15 => 15,
        StepCount::Steps25 => 25,
        StepCount::Steps50 => 50,
        StepCount::Steps100 => 100,
        _ => 2,
    }
}

/// Where a step signal begins: at its lowest value, or at the one next to 0.
fn first_step(config: StepSignal) -> u8 {
    if config.step_signal_cfg.starts_at_zero() { step_count(config) / 2 } else { 0 }
}

/// Where a step signal is after its source has come to a level.
fn next_step(config: StepSignal, position: u8, level: Option<bool>) -> u8 {
    let count = step_count(config);
    match (config.step_signal_cfg.mode(), level) {
        (StepSignalMode::Low, Some(false)) | (StepSignalMode::High, Some(true)) => (position + 1) % count,
        (StepSignalMode::LowHigh, Some(true)) => (position + 1).min(count - 1),
        (StepSignalMode::LowHigh, Some(false)) => position.saturating_sub(1),
        _ => position,
    }
}

/// A signal as newer messages have it.
#[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
pub(super) fn wire_signal(signal: Option<f64>) -> RcSignal {
    signal.map_or(RcSignal::UNDEFINED, |signal| RcSignal::from_fraction(signal.clamp(-1.0, 1.0) as f32))
}

/// A signal as the pulse of a servo in microseconds; one that is not there shows as the middle.
#[allow(clippy::cast_possible_truncation, reason = "it is within 1000 to 2000")]
pub(super) fn pulse(signal: Option<f64>) -> i16 {
    (1500.0 + 500.0 * signal.unwrap_or_default().clamp(-1.0, 1.0)).round() as i16
}

/// A signal of the finer forms; the special values are no signal.
pub(super) fn high_res(raw: i16) -> Option<f64> {
    (!matches!(raw, -32768 | -32767)).then(|| f64::from(raw) / 16384.0)
}

/// A signal of the coarser forms; the special value is no signal.
pub(super) fn coarse(raw: i16) -> Option<f64> {
    (raw != -10_000).then(|| f64::from(raw) / 500.0)
}
