//! Adjustable variables, and what drives them.

use std::time::Duration;

use sbgc_proto::commands::{
    AdjVarsCfg, AdjVarsInfo, AdjVarsState, AdjVarsStateLegacy, AdjVarsStateLegacyRequest,
    AdjVarsStateRequest, AdjVarsVal, AdjVarsValF, AdjustableVariable as Var, MenuCommand, RcSource,
    VariableInfo, VariableValue, VariableValueF, WriteAdjVarsCfg,
};
use sbgc_proto::frame::MAX_PAYLOAD;
use sbgc_proto::wire::{List, Packed, Text};
use sbgc_proto::{CommandId, Message, OutgoingCommand};

use crate::sim::eeprom::Region;
use crate::sim::imu::float;
use crate::sim::machine::{Call, Machine, MenuRequest};
use crate::sim::rc::wire_signal;
use crate::sim::reply::{Packet, Refusal, Replies, Reply, done, message, send};
use crate::sim::variables::range;

pub(super) fn answer(
    machine: &mut Machine,
    call: &Call<'_>,
    command: &OutgoingCommand<'_>,
) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::SetAdjVarsVal(values) => {
            let values = values.0.params.iter();
            let values = values.map(|value| (value.param_id, f64::from(value.param_value))).collect();
            set(machine, call, values)
        }
        OutgoingCommand::SetAdjVarsValF(values) => {
            let values = values.0.params.iter();
            let values = values.map(|value| (value.param_id, value.param_value.get().into())).collect();
            set(machine, call, values)
        }
        OutgoingCommand::GetAdjVarsVal(request) => get(machine, &request.param_id),
        OutgoingCommand::GetAdjVarsValF(request) => get_f(machine, &request.param_id),
        OutgoingCommand::SaveParams3(_) => save(machine, None),
        OutgoingCommand::SaveParams3Extended(request) => {
            save(machine, Some(&request.adj_var_id.iter().collect::<Vec<_>>()))
        }
        OutgoingCommand::ReadAdjVarsCfg(_) => {
            let payload = machine.parameters.eeprom.region(Region::VariableSlots).to_vec();
            send(Ok(Packet { id: CommandId::ReadAdjVarsCfg, payload }))
        }
        OutgoingCommand::WriteAdjVarsCfg(slots) => configure(machine, slots),
        OutgoingCommand::AdjVarsStateRequest(request) => state(machine, request),
        OutgoingCommand::AdjVarsStateLegacyRequest(request) => state_of_old(machine, request),
        OutgoingCommand::AdjVarsInfoRequest(request) => info(machine, request.start_id),
        _ => return None,
    })
}

/// Sets all of them, or none if one is not known or out of its range.
fn set(machine: &mut Machine, call: &Call<'_>, values: Vec<(Var, f64)>) -> Replies {
    let fits = |(variable, value): &(Var, f64)| {
        let range = range(*variable).filter(|_| machine.knows_variable(*variable));
        range.is_some_and(|(least, most)| (least..=most).contains(value))
    };
    if values.is_empty() || !values.iter().all(fits) {
        return Err(Refusal::Parameters);
    }
    for (variable, value) in values {
        machine.parameters.set_variable(variable, value);
    }
    machine.steer(call.now);
    done(call.id.into())
}

fn value(machine: &Machine, variable: Var) -> Result<f64, Refusal> {
    let known = machine.knows_variable(variable);
    machine.parameters.variable(variable).filter(|_| known).ok_or(Refusal::Parameters)
}

#[allow(clippy::cast_possible_truncation, reason = "variables have 16 bits")]
fn whole(value: f64) -> i32 {
    value.round() as i32
}

fn get(machine: &Machine, asked: &[Var]) -> Replies {
    let mut params = List::new();
    for variable in asked {
        let param_value = whole(value(machine, *variable)?);
        let value = VariableValue { param_id: *variable, param_value };
        params.push(value).map_err(|_| Refusal::Parameters)?;
    }
    if params.is_empty() { Err(Refusal::Parameters) } else { message(&AdjVarsVal { params }) }
}

fn get_f(machine: &Machine, asked: &[Var]) -> Replies {
    let mut params = List::new();
    for variable in asked {
        let param_value = float(value(machine, *variable)?);
        let value = VariableValueF { param_id: *variable, param_value };
        params.push(value).map_err(|_| Refusal::Parameters)?;
    }
    if params.is_empty() { Err(Refusal::Parameters) } else { message(&AdjVarsValF { params }) }
}

fn save(machine: &mut Machine, which: Option<&[Var]>) -> Replies {
    if which.is_some_and(|which| which.iter().any(|variable| !machine.knows_variable(*variable))) {
        return Err(Refusal::Parameters);
    }
    machine.parameters.save_variables(which);
    done(CommandId::SaveParams3)
}

fn configure(machine: &mut Machine, WriteAdjVarsCfg(slots): &WriteAdjVarsCfg) -> Replies {
    let payload = Packet::of(slots)?.payload;
    machine.parameters.eeprom.set_region(Region::VariableSlots, &payload);
    machine.trigger_levels = [None; 10];
    done(CommandId::WriteAdjVarsCfg)
}

fn slots(machine: &Machine) -> AdjVarsCfg {
    AdjVarsCfg::decode(machine.parameters.eeprom.region(Region::VariableSlots)).unwrap_or_default()
}

fn signal(machine: &Machine, source: RcSource) -> Option<f64> {
    machine.rc.signal(source, machine.settings())
}

fn state(machine: &Machine, request: &AdjVarsStateRequest) -> Replies {
    let slots = slots(machine);
    let index = usize::from(request.trigger_slot);
    let slot = slots.trigger_slots.get(index).ok_or(Refusal::Parameters)?;
    let value = |variable| value(machine, variable).map(float).unwrap_or_default();
    // A signal that is not there reads as the middle: the range of these fields has no other number for it.
    let level = |source| wire_signal(Some(signal(machine, source).unwrap_or_default()));
    message(&AdjVarsState {
        trigger_rc_data: level(slot.trigger_src_ch),
        trigger_action: MenuCommand::from(machine.triggered.get(index).copied().unwrap_or_default()),
        analog_src_value: level(request.analog_src_id.source()),
        analog_var_value: value(request.analog_var_id),
        lut_src_value: level(request.lut_src_id.source()),
        lut_var_value: value(request.lut_var_id),
    })
}

fn state_of_old(machine: &Machine, request: &AdjVarsStateLegacyRequest) -> Replies {
    let slots = slots(machine);
    let index = usize::from(request.trigger_slot);
    let trigger = slots.trigger_slots.get(index).ok_or(Refusal::Parameters)?;
    let analog = slots.analog_slots.get(usize::from(request.analog_slot)).ok_or(Refusal::Parameters)?;
    #[allow(clippy::cast_possible_truncation, reason = "it is within -500 to 500")]
    let level = |source| (signal(machine, source).unwrap_or_default().clamp(-1.0, 1.0) * 500.0) as i16;
    message(&AdjVarsStateLegacy {
        trigger_rc_data: level(trigger.trigger_src_ch),
        trigger_action: MenuCommand::from(machine.triggered.get(index).copied().unwrap_or_default()),
        analog_rc_data: level(analog.analog_src_ch),
        analog_value: value(machine, analog.var_id.variable()).map(whole).unwrap_or_default(),
        ..AdjVarsStateLegacy::default()
    })
}

/// As many variables from `start` on as fit one message.
fn info(machine: &Machine, start: Option<Var>) -> Replies {
    let mut vars = Packed::new();
    let mut length = 1;
    let first = start.map_or(0, Var::raw);
    for facts in Var::ALL.iter().filter(|facts| facts.variable.raw() >= first) {
        length += 1 + 1 + facts.name.len() + 2 + 2 + 4;
        let (least, most) = range(facts.variable).unwrap_or_default();
        let short = |value: f64| i16::try_from(whole(value)).unwrap_or(i16::MAX);
        let info = VariableInfo {
            var_id: facts.variable,
            name: Text(facts.name.as_bytes()),
            range_min: short(least),
            range_max: short(most),
            value: value(machine, facts.variable).map(whole).unwrap_or_default(),
        };
        if length > MAX_PAYLOAD || vars.push(&info).is_err() {
            break;
        }
    }
    message(&AdjVarsInfo { total_number: u8::try_from(Var::ALL.len()).unwrap_or(u8::MAX), vars })
}

/// Lets signals drive the variables of analog slots, and run the actions of trigger slots.
pub(super) fn poll(machine: &mut Machine, now: Duration, _: &mut Vec<(u8, Reply)>) {
    poll_command_channel(machine);
    let slots = slots(machine);
    let mut changed = false;
    for slot in slots.analog_slots {
        if slot.analog_src_ch == RcSource::NOT_ASSIGNED {
            continue;
        }
        let variable = slot.var_id.variable();
        if let (Some(level), Some((least, most))) = (signal(machine, slot.analog_src_ch), range(variable)) {
            let (from, to) = (f64::from(slot.min_val) / 255.0, f64::from(slot.max_val) / 255.0);
            let share = from + (to - from) * (level.clamp(-1.0, 1.0) + 1.0) / 2.0;
            let value = (least + (most - least) * share).round();
            // A multiplier of the variable stands for up to twice its value.
            let value = if slot.var_id.multiplies() {
                (machine.parameters.saved_variable(variable).unwrap_or(value) * share * 2.0)
                    .clamp(least, most)
            } else {
                value
            };
            if machine.parameters.variable(variable) != Some(value) {
                changed |= machine.parameters.set_variable(variable, value);
            }
        }
    }
    if changed {
        machine.steer(now);
    }
    for (index, slot) in slots.trigger_slots.iter().enumerate() {
        if slot.trigger_src_ch == RcSource::NOT_ASSIGNED {
            continue;
        }
        let level = signal(machine, slot.trigger_src_ch).map(|signal| level_of(signal, 5));
        let (Some(before), Some(triggered)) =
            (machine.trigger_levels.get_mut(index), machine.triggered.get_mut(index))
        else {
            continue;
        };
        if level == *before {
            continue;
        }
        *before = level;
        let action = level.and_then(|level| slot.trigger_action.get(usize::from(level)).copied());
        if let Some(command) = action.filter(|action| *action != MenuCommand::No) {
            *triggered = command.raw();
            machine.menu.push_back(MenuRequest { command, port: 0 });
        }
    }
}

/// Runs the actions of the command channel of remote control, whose range has three levels.
fn poll_command_channel(machine: &mut Machine) {
    let params = &machine.settings().params;
    let actions = [params.rc_cmd_low, params.rc_cmd_mid, params.rc_cmd_high];
    let source = params.rc_map_cmd;
    let level = signal(machine, source).map(|signal| level_of(signal, 3));
    if level == machine.command_level {
        return;
    }
    machine.command_level = level;
    let action = level.and_then(|level| actions.get(usize::from(level)).copied());
    if let Some(command) = action.filter(|action| *action != MenuCommand::No) {
        machine.menu.push_back(MenuRequest { command, port: 0 });
    }
}

/// Which of so many levels, which share the range evenly, a signal is in.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is within 0 to the count")]
fn level_of(signal: f64, count: u8) -> u8 {
    let place = f64::midpoint(signal.clamp(-1.0, 1.0), 1.0) * f64::from(count);
    (place as u8).min(count - 1)
}
