//! The inputs of remote control: pins, analog inputs, serial receivers and virtual channels.
//!
//! Real: sources as the protocol numbers them, virtual channels by `CMD_API_VIRT_CH_CONTROL` and its finer form,
//! corrections of the parameters (`RC_CALIB`). Nothing is connected to pins and receivers until the program that runs
//! the board connects it; an input without a signal is undefined.
//!
//! Simplified: step signals are not simulated and have no signal.

use std::collections::BTreeMap;

use sbgc_proto::commands::{RcSource, RcSourceKind};
use sbgc_proto::units::RcSignal;

use super::parameters::Settings;

/// How many virtual channels there are.
pub(super) const VIRTUAL_CHANNELS: usize = 32;

#[derive(Debug, Default)]
pub(super) struct RcInputs {
    virtual_channels: [Option<f64>; VIRTUAL_CHANNELS],
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

    /// Forgets virtual channels, as a reset does.
    pub(super) fn reset(&mut self) {
        self.virtual_channels = [None; VIRTUAL_CHANNELS];
    }

    /// The signal of a source, -1 to 1 and slightly beyond.
    pub(super) fn signal(&self, source: RcSource, settings: &Settings) -> Option<f64> {
        let raw = match virtual_channel(source) {
            Some(channel) => *self.virtual_channels.get(channel)?,
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
        Self::assigned(settings).iter().take(3).any(|source| self.signal(*source, settings).is_some())
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
