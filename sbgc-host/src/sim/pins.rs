//! Output pins and servo outputs.
//!
//! Real: a pin is driven, and its command confirmed, only if nothing else uses it: inputs of remote control, a second
//! LED or buzzer, an interrupt output and extra buttons as far as the parameters assign them, and outputs of servos. AUX,
//! buzzer and Spektrum power are free otherwise. Servo outputs that the parameters assign put out a virtual channel.

use std::collections::BTreeMap;

use sbgc_proto::commands::{TriggerPinId, TriggerPinState};
use sbgc_proto::units::ServoTime;

use super::parameters::Settings;
use super::rc::RcInputs;

/// How many servo outputs there are.
pub(super) const SERVOS: usize = 4;

#[derive(Debug, Default)]
pub(super) struct Pins {
    states: BTreeMap<u8, u8>,
    servos: [Option<u16>; SERVOS],
}

impl Pins {
    /// Whether the board has this pin.
    pub(super) fn exists(pin: TriggerPinId) -> bool {
        matches!(pin.raw(), 1..=5 | 16..=18 | 32 | 33)
    }

    /// Whether a pin has no other function.
    pub(super) fn is_free(&self, pin: TriggerPinId, settings: &Settings) -> bool {
        let used_by_rc = RcInputs::assigned(settings).iter().any(|source| source.0 == pin.raw());
        let (ext2, ext3) = (&settings.ext2, &settings.ext3);
        let assigned =
            [ext2.ext_led_pin_id, ext2.interrupt_cfg.pin(), TriggerPinId::from(ext3.ext_buzzer_pin)];
        let button = ext3.extra_btn_cfg.iter().any(|button| button.pin() == pin);
        let servo = servo_of(pin)
            .is_some_and(|index| self.servo(index).is_some() || servo_channel(index, settings).is_some());
        Self::exists(pin) && !used_by_rc && !assigned.contains(&pin) && !button && !servo
    }

    pub(super) fn set(&mut self, pin: TriggerPinId, state: TriggerPinState) {
        self.states.insert(pin.raw(), state.raw());
    }

    /// What an input reads: what it is pulled to.
    pub(super) fn level(&self, pin: TriggerPinId) -> i8 {
        match self.states.get(&pin.raw()) {
            Some(1 | 3) => 1,
            Some(_) => 0,
            None => -1,
        }
    }

    /// Sets a servo output; below zero frees its pin.
    pub(super) fn set_servo(&mut self, index: usize, time: ServoTime) {
        if let Some(place) = self.servos.get_mut(index) {
            *place = u16::try_from(time.0).ok();
        }
    }

    /// The pulse of a servo output in microseconds; `None` while it floats.
    pub(super) fn servo(&self, index: usize) -> Option<u16> {
        self.servos.get(index).copied().flatten()
    }

    /// The state of the inputs, two bits each: 0 low, 1 high, 2 not available.
    pub(super) fn input_bits(&self) -> u16 {
        [16, 17, 18, 32, 33].into_iter().enumerate().fold(0, |bits, (index, pin)| {
            let level: u16 = match self.level(TriggerPinId::from(pin)) {
                1 => 1,
                0 => 0,
                _ => 2,
            };
            bits | level << (index * 2)
        })
    }

    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}

/// The virtual channel that the parameters put out on a servo output.
pub(super) fn servo_channel(index: usize, settings: &Settings) -> Option<u8> {
    let params = &settings.params;
    let outputs = [params.servo1_out, params.servo2_out, params.servo3_out, params.servo4_out];
    outputs.get(index).copied().filter(|channel| *channel > 0)
}

/// The servo output that shares a pin.
fn servo_of(pin: TriggerPinId) -> Option<usize> {
    [
        TriggerPinId::ExtFcInputRoll,
        TriggerPinId::ExtFcInputPitch,
        TriggerPinId::RcInputPitch,
        TriggerPinId::Aux1,
    ]
    .into_iter()
    .position(|servo| servo == pin)
}
