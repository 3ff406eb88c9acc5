//! The parameters of the five profiles, as blocks of bytes.
//!
//! Real: every byte that is written comes back, what this program calls reserved included. What a block is written to
//! is the profile in its first byte.
//!
//! Simplified: of all parameters only those that map remote control to angles have an effect. What is written is not
//! checked. Block 1 from the factory is plausible; in the others everything is zero.

use std::collections::BTreeMap;

use sbgc_proto::commands::{
    MotorTuning, Params3, ParamsExt, ParamsExt2, ParamsExt3, PidTerm, ProfileId, ProfileNames, RcAxis,
    ReadParams3, ReadParamsExt, ReadParamsExt2, ReadParamsExt3,
};
use sbgc_proto::units::{AccelerationLimit, Angle, VoltageThreshold};
use sbgc_proto::wire::{FixedText, PerAxis};
use sbgc_proto::{CommandId, Message};

use super::answers::{Packet, Refusal};
use super::config::StoredBlock;

/// How many profiles there are.
pub(super) const PROFILES: u8 = 5;

#[derive(Debug)]
pub(super) struct Parameters {
    /// By the command that reads it and the profile.
    blocks: BTreeMap<(u8, u8), Vec<u8>>,
    names: ProfileNames,
    active: u8,
}

impl Parameters {
    pub(super) fn new(active: u8, stored: &[StoredBlock]) -> Self {
        let mut parameters = Self {
            blocks: BTreeMap::new(),
            names: ProfileNames { profile_name: [1, 2, 3, 4, 5].map(factory_name) },
            active: if active < PROFILES { active } else { 0 },
        };
        for profile in 0..PROFILES {
            parameters.restore(profile);
        }
        for block in stored {
            if let Some(place) = parameters.blocks.get_mut(&(block.id.raw(), block.profile))
                && place.len() == block.payload.len()
            {
                place.clone_from(&block.payload);
            }
        }
        parameters
    }

    /// Puts a profile back to what it was in the factory.
    pub(super) fn restore(&mut self, profile: u8) {
        let profile_id = ProfileId::from(profile);
        let factory = [
            (ReadParams3::ID, Packet::of(&factory_block(profile))),
            (ReadParamsExt::ID, Packet::of(&ParamsExt { profile_id, ..ParamsExt::default() })),
            (ReadParamsExt2::ID, Packet::of(&ParamsExt2 { profile_id, ..ParamsExt2::default() })),
            (ReadParamsExt3::ID, Packet::of(&ParamsExt3 { profile_id, ..ParamsExt3::default() })),
        ];
        for (id, packet) in factory {
            if let Ok(packet) = packet {
                self.blocks.insert((id.raw(), profile), packet.payload);
            }
        }
    }

    pub(super) fn names(&self) -> Result<Packet, Refusal> {
        Packet::of(&self.names)
    }

    pub(super) fn rename(&mut self, names: ProfileNames) {
        self.names = names;
    }

    /// The active profile.
    pub(super) fn active(&self) -> u8 {
        self.active
    }

    pub(super) fn activate(&mut self, profile: u8) {
        self.active = profile;
    }

    /// The block that this command reads.
    pub(super) fn read(&self, id: CommandId, profile: ProfileId) -> Result<Packet, Refusal> {
        let profile = self.number(profile);
        let mut payload = self.blocks.get(&(id.raw(), profile)).ok_or(Refusal::Parameters)?.clone();
        if let Some(first) = payload.first_mut() {
            *first = profile;
        }
        if id == ReadParams3::ID {
            let block = Params3::decode(&payload).map_err(|_| Refusal::Parameters)?;
            return Packet::of(&Params3 { cur_profile_id: self.active.into(), ..block });
        }
        Ok(Packet { id, payload })
    }

    /// Stores the block that this command reads.
    pub(super) fn write(&mut self, id: CommandId, payload: &[u8]) -> Result<(), Refusal> {
        let profile = self.number(payload.first().copied().unwrap_or_default().into());
        let block = self.blocks.get_mut(&(id.raw(), profile)).ok_or(Refusal::Parameters)?;
        if block.len() != payload.len() {
            return Err(Refusal::Size);
        }
        block.clear();
        block.extend_from_slice(payload);
        Ok(())
    }

    /// How the active profile maps remote control.
    pub(super) fn remote_control(&self) -> Option<PerAxis<RcAxis>> {
        let block = self.blocks.get(&(ReadParams3::ID.raw(), self.active))?;
        Params3::decode(block).ok().map(|block| block.rc)
    }

    /// Every number beyond the profiles is the active one.
    fn number(&self, profile: ProfileId) -> u8 {
        if profile.raw() < PROFILES { profile.raw() } else { self.active }
    }
}

fn factory_name(number: u8) -> FixedText<48> {
    FixedText::new(&format!("Profile {number}")).unwrap_or_default()
}

fn factory_block(profile: u8) -> Params3 {
    let motor = MotorTuning {
        p: PidTerm(30 + profile),
        i: PidTerm(20),
        d: PidTerm(40),
        power: 150,
        poles: 22,
        ..MotorTuning::default()
    };
    let axis = RcAxis { rc_min_angle: -90, rc_max_angle: 90, rc_lpf: 4, rc_speed: 60, ..RcAxis::default() };
    Params3 {
        profile_id: profile.into(),
        motors: [motor; 3].into(),
        acc_limiter_all: AccelerationLimit(60),
        rc: [axis; 3].into(),
        gyro_trust: 120,
        bat_threshold_alarm: VoltageThreshold(1080),
        bat_threshold_motors: VoltageThreshold(990),
        bat_comp_ref: VoltageThreshold(1260),
        rc_memory: [Angle(0); 3].into(),
        ..Params3::default()
    }
}
