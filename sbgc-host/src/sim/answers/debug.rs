//! Variables that the board shows for debugging.

use sbgc_proto::OutgoingCommand;
use sbgc_proto::commands::{
    DebugVarAxis, DebugVarInfo, DebugVarKind, DebugVarType, DebugVars3, DebugVars3ExtendedRequest,
    DebugVars3Masked, DebugVarsInfo3,
};
use sbgc_proto::wire::{Packed, Reserved, Text};

use crate::sim::machine::{Call, Machine};
use crate::sim::motion::CYCLE;
use crate::sim::reply::{Packet, Replies, message, send};

pub(super) fn answer(machine: &mut Machine, _: &Call<'_>, command: &OutgoingCommand<'_>) -> Option<Replies> {
    Some(match command {
        OutgoingCommand::DebugVarsInfo3Request(_) => info(machine, 0),
        OutgoingCommand::DebugVarsInfo3ExtendedRequest(request) => info(machine, request.start_idx),
        OutgoingCommand::DebugVars3Request(_) => values(machine, None),
        OutgoingCommand::DebugVars3ExtendedRequest(request) => values(machine, Some(request)),
        _ => return None,
    })
}

/// A variable that the board shows.
struct Shown {
    name: &'static str,
    kind: DebugVarKind,
    value: Vec<u8>,
}

/// The descriptions from the variable `start` on; all of them fit one message.
fn info(machine: &Machine, start: u8) -> Replies {
    let shown = shown(machine);
    let mut vars = Packed::new();
    for shown in shown.iter().skip(start.into()) {
        let info = DebugVarInfo {
            var_name: Text(shown.name.as_bytes()),
            var_type: shown.kind,
            reserved: Reserved::default(),
        };
        if vars.push(&info).is_err() {
            break;
        }
    }
    let debug_vars_num = u8::try_from(vars.len()).unwrap_or(u8::MAX);
    message(&DebugVarsInfo3 { debug_vars_num, vars })
}

/// The values, all or those that are asked for.
fn values(machine: &Machine, request: Option<&DebugVars3ExtendedRequest>) -> Replies {
    let shown = shown(machine);
    let Some(request) = request else {
        let values: Vec<u8> = shown.into_iter().flat_map(|shown| shown.value).collect();
        return message(&DebugVars3 { var_value: &values });
    };
    let asked = request.variables().filter_map(|index| shown.get(index));
    let values: Vec<u8> = asked.flat_map(|shown| shown.value.iter().copied()).collect();
    let masked = DebugVars3Masked { selected_mask: request.selected_mask.clone(), var_value: &values };
    send(Packet::with(&masked, request.selected_mask.len()))
}

fn shown(machine: &Machine) -> Vec<Shown> {
    let kind = |var_type| DebugVarKind::default().with_var_type(var_type);
    let cycle = u16::try_from(CYCLE.as_micros()).unwrap_or_default();
    let mut shown = vec![
        Shown { name: "CYCLE_TIME", kind: kind(DebugVarType::U16), value: cycle.to_le_bytes().into() },
        Shown {
            name: "MOTORS_ON",
            kind: kind(DebugVarType::U8),
            value: vec![u8::from(machine.motion.motors_on())],
        },
    ];
    let axes = [DebugVarAxis::Roll, DebugVarAxis::Pitch, DebugVarAxis::Yaw];
    for (axis, place) in machine.motion.axes().into_array().iter().zip(axes) {
        let angle = kind(DebugVarType::I16).with_axis(place).with_is_angle(true);
        shown.push(Shown { name: "ANGLE", kind: angle, value: axis.wire_angle().0.to_le_bytes().into() });
        #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
        let speed = (axis.speed as f32).to_le_bytes().into();
        shown.push(Shown { name: "SPEED", kind: kind(DebugVarType::F32).with_axis(place), value: speed });
    }
    shown
}
