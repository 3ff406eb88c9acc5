//! Pins, servo outputs, the inputs of remote control, and bridges between serial ports.
//!
//! Real: bridged ports carry raw bytes to each other and no messages, until the board resets or one of them is given
//! back.

use sbgc_proto::commands::{
    ConfirmData, RcInputs as RcInputsMessage, ReadRcInputs, TriggerPin, TriggerPinState,
};
use sbgc_proto::units::RcSignal;
use sbgc_proto::wire::List;
use sbgc_proto::{CommandId, OutgoingCommand};

use crate::sim::machine::{Call, Machine};
use crate::sim::pins::SERVOS;
use crate::sim::rc::wire_signal;
use crate::sim::reply::{Refusal, Replies, Reply, confirm, done, message, silence};

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::TriggerPin(request) => trigger(machine, request),
        OutgoingCommand::ServoOut(servos) => {
            for (index, time) in servos.servo_time.into_iter().enumerate() {
                machine.pins.set_servo(index, time);
            }
            silence()
        }
        OutgoingCommand::ServoOutExt(servos) => {
            let bits = servos.servo_bits.bits();
            let outputs = (0..32).filter(|bit| bits >> bit & 1 != 0);
            for (index, time) in outputs.zip(servos.servo_time.iter()) {
                if index < SERVOS {
                    machine.pins.set_servo(index, *time);
                }
            }
            silence()
        }
        OutgoingCommand::SetTranspProxy(request) => {
            let ports = [request.port1, request.port2].map(|port| port.checked_sub(1).unwrap_or(call.port));
            if ports[0] == ports[1] { Err(Refusal::Parameters) } else { Ok(vec![Reply::Bridge { ports }]) }
        }
        OutgoingCommand::ReadRcInputs(request) => read_inputs(machine, request),
        _ => return None,
    })
}

/// A pin that has another function, or that the board does not have, is not driven and nothing is answered.
fn trigger(machine: &mut Machine, request: &TriggerPin) -> Replies {
    let TriggerPin { pin_id, state } = *request;
    let known = match state {
        TriggerPinState::Low | TriggerPinState::High | TriggerPinState::Floating => true,
        TriggerPinState::PulledUp | TriggerPinState::PulledDown => machine.config().has("2.74.3"),
        _ => false,
    };
    if !known || !machine.pins.is_free(pin_id, machine.settings()) {
        return silence();
    }
    machine.pins.set(pin_id, state);
    if matches!(state, TriggerPinState::PulledUp | TriggerPinState::PulledDown) {
        let level = machine.pins.level(pin_id).to_le_bytes();
        return confirm(
            CommandId::TriggerPin,
            ConfirmData::U16(u16::from_le_bytes([pin_id.raw(), level[0]])),
        );
    }
    done(CommandId::TriggerPin)
}

fn read_inputs(machine: &Machine, request: &ReadRcInputs) -> Replies {
    let mut rc_val = List::new();
    for source in &*request.rc_src {
        let signal = machine.rc.signal(*source, machine.settings());
        // This message has a number of its own for a signal that is not there.
        let value = if signal.is_some() { wire_signal(signal) } else { RcSignal::UNDEFINED_OLD };
        rc_val.push(value).map_err(|_| Refusal::Parameters)?;
    }
    message(&RcInputsMessage { rc_val })
}
