//! What is going to be written, before anything is: it can be shown, printed as frames, and carried out.

use bytes::Bytes;
use sbgc_proto::commands::{WriteParamsSet, WriteParamsSetAction};
use sbgc_proto::units::FirmwareVersion;
use sbgc_proto::{CommandId, Message};

use super::block::{Place, has};
use super::parameter::parameters_of;
use super::set::{Blocks, Difference, differences};

/// Blocks that are going to be written: those that change, and no others.
#[derive(Clone, Debug)]
pub struct Plan {
    firmware: FirmwareVersion,
    steps: Vec<PlannedBlock>,
}

/// A block that is going to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedBlock {
    /// Which one.
    pub place: Place,
    /// The payload that the board has.
    pub before: Vec<u8>,
    /// The payload that it is going to have.
    pub after: Vec<u8>,
}

impl PlannedBlock {
    /// Whether `payload` is what was to be written, leaving out what the board sets by itself.
    pub(super) fn is_done(&self, payload: &[u8]) -> bool {
        let mut expected = self.after.clone();
        for parameter in parameters_of(self.place.block).iter().filter(|parameter| parameter.is_state()) {
            if let Some(bytes) = parameter.of(payload) {
                parameter.put(&mut expected, bytes);
            }
        }
        expected == payload
    }

    /// The step back.
    pub(super) fn undone(&self) -> Self {
        Self { place: self.place, before: self.after.clone(), after: self.before.clone() }
    }
}

/// A command that carries out a part of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedCommand {
    /// Its id.
    pub id: CommandId,
    /// Its payload.
    pub payload: Bytes,
}

impl Plan {
    /// A plan that changes nothing, for a board with this firmware.
    pub const fn new(firmware: FirmwareVersion) -> Self {
        Self { firmware, steps: Vec::new() }
    }

    /// Adds those blocks of `profile` that differ between `before` and `after`.
    pub fn change(&mut self, profile: Option<super::Profile>, before: &Blocks, after: &Blocks) {
        for (block, payload) in after.iter() {
            if let Some(held) = before.get(block)
                && held != payload
            {
                let place = Place { profile, block };
                self.steps.push(PlannedBlock { place, before: held.to_vec(), after: payload.to_vec() });
            }
        }
    }

    /// Whether nothing is going to be written.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The blocks that are going to be written, in their order.
    pub fn steps(&self) -> &[PlannedBlock] {
        &self.steps
    }

    /// The version of the firmware for which it was made.
    pub const fn firmware(&self) -> FirmwareVersion {
        self.firmware
    }

    /// What is going to change.
    pub fn differences(&self) -> Vec<Difference> {
        let of_step = |step: &PlannedBlock| differences(step.place, self.firmware, &step.before, &step.after);
        self.steps.iter().flat_map(of_step).collect()
    }

    /// Whether the blocks go out between the two commands that hold back the board's restart.
    pub(super) fn is_bracketed(&self) -> bool {
        has(self.firmware, WriteParamsSet::SINCE)
            && self.steps.iter().any(|step| step.place.block.is_of_profile())
    }

    /// The commands that carry it out, in their order.
    pub fn commands(&self) -> Vec<PlannedCommand> {
        let mut commands: Vec<_> = self
            .steps
            .iter()
            .map(|step| PlannedCommand {
                id: step.place.block.write_id(),
                payload: Bytes::copy_from_slice(&step.after),
            })
            .collect();
        if self.is_bracketed() {
            let bracket = |action: WriteParamsSetAction| PlannedCommand {
                id: WriteParamsSet::ID,
                payload: Bytes::copy_from_slice(&[action.raw()]),
            };
            commands.insert(0, bracket(WriteParamsSetAction::Start));
            commands.push(bracket(WriteParamsSetAction::Finish));
        }
        commands
    }

    /// The plan that takes back what this one does.
    pub(super) fn undone(&self) -> Self {
        Self { firmware: self.firmware, steps: self.steps.iter().rev().map(PlannedBlock::undone).collect() }
    }
}
