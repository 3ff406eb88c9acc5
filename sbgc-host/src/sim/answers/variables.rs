//! Adjustable variables and variables for debugging.

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    AdjVarsVal, AdjustableVariable, ConfirmData, DebugVarAxis, DebugVarInfo, DebugVarKind, DebugVarType,
    DebugVars3, DebugVars3ExtendedRequest, DebugVars3Masked, DebugVarsInfo3,
};
use sbgc_proto::wire::{List, Reserved, Text};

use super::{Packet, Refusal, Replies, confirm, message, send};
use crate::sim::machine::Machine;
use crate::sim::motion::CYCLE;

/// A variable that the board shows for debugging.
struct Shown {
    name: &'static str,
    kind: DebugVarKind,
    value: Vec<u8>,
}

impl Machine {
    pub(super) fn set_variables(&mut self, AdjVarsVal { params }: &AdjVarsVal) -> Replies {
        self.variables.set(params)?;
        confirm(CommandId::SetAdjVarsVal, ConfirmData::U8(0))
    }

    pub(super) fn variables(&self, asked: &[AdjustableVariable]) -> Replies {
        let mut params = List::new();
        for variable in asked {
            params.push(self.variables.get(*variable)?).map_err(|_| Refusal::Parameters)?;
        }
        message(&AdjVarsVal { params })
    }

    /// Stores some of the variables, or all.
    pub(super) fn save_variables(&mut self, which: Option<&[AdjustableVariable]>) -> Replies {
        match which {
            Some(variables) => self.variables.store(variables),
            None => self.variables.store_all(),
        }
        confirm(CommandId::SaveParams3, ConfirmData::U8(0))
    }

    /// The descriptions from the variable `start` on; all of them fit one message.
    pub(super) fn debug_variables_info(&self, start: u8) -> Replies {
        let shown = self.shown();
        let describe = |shown: &Shown| DebugVarInfo {
            var_name: Text(shown.name.as_bytes()),
            var_type: shown.kind,
            reserved: Reserved::default(),
        };
        let vars: List<_, 63> = shown.iter().skip(start.into()).map(describe).collect();
        message(&DebugVarsInfo3 { debug_vars_num: vars.count(), vars })
    }

    /// The values, all or those that are asked for.
    pub(super) fn debug_variables(&self, request: Option<&DebugVars3ExtendedRequest>) -> Replies {
        let shown = self.shown();
        let Some(request) = request else {
            let values: Vec<u8> = shown.into_iter().flat_map(|shown| shown.value).collect();
            return message(&DebugVars3 { var_value: &values });
        };
        let asked = request.variables().filter_map(|index| shown.get(index));
        let values: Vec<u8> = asked.flat_map(|shown| shown.value.iter().copied()).collect();
        let masked = DebugVars3Masked { selected_mask: request.selected_mask.clone(), var_value: &values };
        send(Packet::with(&masked, request.selected_mask.len()))
    }

    fn shown(&self) -> Vec<Shown> {
        let kind = |var_type| DebugVarKind::default().with_var_type(var_type);
        let cycle = u16::try_from(CYCLE.as_micros()).unwrap_or_default();
        let mut shown = vec![
            Shown { name: "CYCLE_TIME", kind: kind(DebugVarType::U16), value: cycle.to_le_bytes().into() },
            Shown {
                name: "MOTORS_ON",
                kind: kind(DebugVarType::U8),
                value: vec![u8::from(self.motion.motors_on())],
            },
        ];
        let axes = [DebugVarAxis::Roll, DebugVarAxis::Pitch, DebugVarAxis::Yaw];
        for (axis, place) in self.motion.axes().into_array().iter().zip(axes) {
            let angle = kind(DebugVarType::I16).with_axis(place).with_is_angle(true);
            shown.push(Shown { name: "ANGLE", kind: angle, value: axis.wire_angle().0.to_le_bytes().into() });
            #[allow(clippy::cast_possible_truncation, reason = "the wire has no more precision")]
            let speed = (axis.speed as f32).to_le_bytes().into();
            shown.push(Shown { name: "SPEED", kind: kind(DebugVarType::F32).with_axis(place), value: speed });
        }
        shown
    }
}
