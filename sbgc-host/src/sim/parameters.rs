//! The parameters of the five profiles, and the adjustable variables, which are the parameters of the active one.
//!
//! Real: every byte that is written comes back, what this program calls reserved included. Adjustable variables act at
//! once, are saved into the active profile only when that is asked for, and are lost by a change of profile or a reset.
//! Which changes restart the board is not published; here those of outputs, sensors, encoders and ports do.
//!
//! Flags with "general" in their name and the default profile belong to no profile: writing them to one writes them to
//! all.

use std::collections::BTreeMap;

use sbgc_proto::Message;
use sbgc_proto::commands::{
    AdjustableVariable as Var, FileId, FileType, GeneralFlags1, Params3, ParamsExt, ParamsExt2, ParamsExt3,
    ProfileId,
};

use super::config::{Config, StoredBlock};
use super::eeprom::{Block, Cell, Eeprom, Region};
use super::factory;
use super::files::Files;
use super::reply::{Packet, Refusal};
use super::variables::{homes, range};

/// How many profiles there are.
pub(super) const PROFILES: u8 = 5;

/// How many slots for profile sets there are, the backup included.
const SETS: u8 = 6;

/// The parameters that are in force, decoded.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Settings {
    pub(super) params: Params3,
    pub(super) ext: ParamsExt,
    pub(super) ext2: ParamsExt2,
    pub(super) ext3: ParamsExt3,
}

#[derive(Debug)]
pub(super) struct Parameters {
    pub(super) eeprom: Eeprom,
    active: u8,
    /// The blocks of the active profile with the variables that were set.
    live: [Vec<u8>; 4],
    settings: Settings,
    /// The variables that were set and not saved.
    set: BTreeMap<u8, f64>,
    /// The values of variables that no parameter holds.
    loose: BTreeMap<u8, f64>,
    /// Whether a series of writes is going on, and whether one of them asks for a restart.
    series: bool,
    restart_wanted: bool,
}

impl Parameters {
    /// What is in `eeprom`; one that is erased gets what the board has from the factory.
    pub(super) fn new(mut eeprom: Eeprom, config: &Config) -> Self {
        if !eeprom.is_formatted() {
            format(&mut eeprom, config);
        }
        let mut parameters = Self {
            eeprom,
            active: 0,
            live: Default::default(),
            settings: Settings::default(),
            set: BTreeMap::new(),
            loose: BTreeMap::new(),
            series: false,
            restart_wanted: false,
        };
        parameters.start(config);
        parameters
    }

    /// Reads the EEPROM anew, as the board does when it starts.
    pub(super) fn start(&mut self, config: &Config) {
        if !self.eeprom.is_formatted() {
            format(&mut self.eeprom, config);
        }
        self.series = false;
        self.restart_wanted = false;
        self.loose.clear();
        self.load(0);
        let flags = self.settings.params.general_flags1;
        let profile = if flags.contains(GeneralFlags1::REMEMBER_LAST_USED_PROFILE) {
            self.eeprom.cell(Cell::ActiveProfile)
        } else {
            self.settings.ext3.default_profile.raw()
        };
        self.load(if profile < PROFILES { profile } else { 0 });
    }

    fn load(&mut self, profile: u8) {
        self.active = profile;
        self.set.clear();
        for (live, block) in self.live.iter_mut().zip(Block::ALL) {
            *live = self.eeprom.region(Region::Block(profile, block)).to_vec();
        }
        self.decode();
    }

    fn decode(&mut self) {
        let [params, ext, ext2, ext3] = &self.live;
        if let (Ok(params), Ok(ext), Ok(ext2), Ok(ext3)) = (
            Params3::decode(params),
            ParamsExt::decode(ext),
            ParamsExt2::decode(ext2),
            ParamsExt3::decode(ext3),
        ) {
            self.settings = Settings { params, ext, ext2, ext3 };
        }
    }

    /// What is in force.
    pub(super) fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The active profile.
    pub(super) fn active(&self) -> u8 {
        self.active
    }

    /// Changes to a profile; what was not saved is lost.
    pub(super) fn activate(&mut self, profile: u8) {
        if profile < PROFILES {
            self.load(profile);
            self.eeprom.set_cell(Cell::ActiveProfile, profile);
        }
    }

    /// Every number beyond the profiles is the active one.
    pub(super) fn number(&self, profile: ProfileId) -> u8 {
        if profile.raw() < PROFILES { profile.raw() } else { self.active }
    }

    /// A block as a command reads it, which is what is saved.
    pub(super) fn read(&self, block: Block, profile: ProfileId) -> Result<Vec<u8>, Refusal> {
        let profile = self.number(profile);
        let mut payload = self.eeprom.region(Region::Block(profile, block)).to_vec();
        if let Some(first) = payload.first_mut() {
            *first = profile;
        }
        if block == Block::Params3 {
            let params = Params3::decode(&payload).map_err(|_| Refusal::Parameters)?;
            let selected = self.eeprom.cell(Cell::SelectedImu).max(1);
            let shown = Params3 { cur_profile_id: self.active.into(), cur_imu: selected.into(), ..params };
            payload = Packet::of(&shown)?.payload;
        }
        Ok(payload)
    }

    /// Saves a block, and lets it act if it is of the active profile. True if the board has to restart for it.
    pub(super) fn write(&mut self, block: Block, payload: &[u8]) -> bool {
        let profile = self.number(payload.first().copied().unwrap_or_default().into());
        let before = self.saved(profile);
        let mut payload = payload.to_vec();
        if let Some(first) = payload.first_mut() {
            *first = profile;
        }
        self.eeprom.set_region(Region::Block(profile, block), &payload);
        let after = self.saved(profile);
        self.share(profile, &after);
        if profile == self.active {
            let index = block as usize;
            if let Some(live) = self.live.get_mut(index) {
                *live = payload;
            }
            self.set.retain(|id, _| homes(Var::from(*id)).iter().all(|home| home.block() != block));
            self.decode();
        }
        let restart = needs_restart(&before, &after);
        self.restart_wanted |= restart && self.series;
        restart && !self.series
    }

    /// Begins or ends a series of writes. True if the board has to restart now that it is over.
    pub(super) fn series(&mut self, begins: bool) -> bool {
        self.series = begins;
        !begins && std::mem::take(&mut self.restart_wanted)
    }

    /// The saved parameters of a profile, decoded.
    fn saved(&self, profile: u8) -> Settings {
        let region = |block| self.eeprom.region(Region::Block(profile, block));
        Settings {
            params: Params3::decode(region(Block::Params3)).unwrap_or_default(),
            ext: ParamsExt::decode(region(Block::Ext)).unwrap_or_default(),
            ext2: ParamsExt2::decode(region(Block::Ext2)).unwrap_or_default(),
            ext3: ParamsExt3::decode(region(Block::Ext3)).unwrap_or_default(),
        }
    }

    /// Copies what belongs to no profile to all of them.
    fn share(&mut self, from: u8, settings: &Settings) {
        for profile in (0..PROFILES).filter(|profile| *profile != from) {
            let mut other = self.saved(profile);
            other.params.general_flags1 = settings.params.general_flags1;
            other.ext2.general_flags2 = settings.ext2.general_flags2;
            other.ext3.general_flags3 = settings.ext3.general_flags3;
            other.ext3.general_flags4 = settings.ext3.general_flags4;
            other.ext3.default_profile = settings.ext3.default_profile;
            self.save(profile, &other);
        }
        if from != self.active {
            self.settings.params.general_flags1 = settings.params.general_flags1;
            self.settings.ext2.general_flags2 = settings.ext2.general_flags2;
        }
    }

    /// Saves decoded parameters of a profile.
    fn save(&mut self, profile: u8, settings: &Settings) {
        let blocks = [
            (Block::Params3, Packet::of(&settings.params)),
            (Block::Ext, Packet::of(&settings.ext)),
            (Block::Ext2, Packet::of(&settings.ext2)),
            (Block::Ext3, Packet::of(&settings.ext3)),
        ];
        for (block, packet) in blocks {
            if let Ok(packet) = packet {
                self.eeprom.set_region(Region::Block(profile, block), &packet.payload);
            }
        }
    }

    /// Changes the saved parameters of the active profile, as calibrations and tuning do.
    pub(super) fn change(&mut self, change: impl FnOnce(&mut Settings)) {
        self.change_in(self.active, change);
    }

    /// Changes the saved parameters of a profile.
    pub(super) fn change_in(&mut self, profile: u8, change: impl FnOnce(&mut Settings)) {
        let mut settings = self.saved(profile);
        change(&mut settings);
        self.save(profile, &settings);
        if profile == self.active {
            self.load(profile);
        }
    }

    /// Puts a profile back to what it was in the factory.
    pub(super) fn restore(&mut self, profile: u8) {
        let default = self.settings.ext3.default_profile.raw();
        for block in Block::ALL {
            self.eeprom.set_region(Region::Block(profile, block), &factory::block(profile, block, default));
        }
        let settings = self.saved(profile);
        self.share(profile, &settings);
        if profile == self.active {
            self.load(profile);
        }
    }

    /// The value of a variable.
    pub(super) fn variable(&self, variable: Var) -> Option<f64> {
        let (least, most) = range(variable)?;
        let held = match variable {
            // Following the pitch is a mode of its own, following the yaw a rate that is not 0.
            Var::FollowYawPitch => {
                let yaw = self.settings.params.rc.yaw.rc_follow != 0;
                let pitch = self.settings.params.follow_mode.raw() == 2;
                Some(if yaw { 1.0 + f64::from(u8::from(pitch)) } else { 0.0 })
            }
            Var::FollowPitch => Some(f64::from(u8::from(self.settings.params.follow_mode.raw() == 2))),
            _ => homes(variable).first().and_then(|home| home.read(self.live.get(home.block() as usize)?)),
        };
        let loose = || self.loose.get(&variable.raw()).copied();
        let own = self.set.get(&variable.raw()).copied();
        let value = own.or(held).or_else(loose).unwrap_or(0.0);
        Some(value.clamp(least, most))
    }

    /// The value of a variable that is saved in the active profile.
    pub(super) fn saved_variable(&self, variable: Var) -> Option<f64> {
        let home = homes(variable).first()?;
        home.read(self.eeprom.region(Region::Block(self.active, home.block())))
    }

    /// Sets a variable, which acts at once; false if it is not known or the value is out of its range.
    pub(super) fn set_variable(&mut self, variable: Var, value: f64) -> bool {
        let Some((least, most)) = range(variable) else { return false };
        if !(least..=most).contains(&value) {
            return false;
        }
        self.set.insert(variable.raw(), value);
        if homes(variable).is_empty() {
            self.loose.insert(variable.raw(), value);
            return true;
        }
        put(&mut self.live, variable, value);
        // A variable for all axes and those for each are the same parameters.
        match variable {
            Var::AccLimiter => {
                for each in [Var::AccLimiterRoll, Var::AccLimiterPitch, Var::AccLimiterYaw] {
                    self.set.insert(each.raw(), value);
                }
            }
            Var::AccLimiterRoll => {
                self.set.insert(Var::AccLimiter.raw(), value);
            }
            Var::FollowPitch | Var::FollowYawPitch => {
                self.set.remove(
                    &if variable == Var::FollowPitch { Var::FollowYawPitch } else { Var::FollowPitch }.raw(),
                );
            }
            _ => {}
        }
        self.decode();
        true
    }

    /// Saves these variables into the active profile, or all that were set.
    pub(super) fn save_variables(&mut self, which: Option<&[Var]>) {
        let values: Vec<(Var, f64)> = match which {
            Some(variables) => variables
                .iter()
                .filter_map(|variable| self.variable(*variable).map(|value| (*variable, value)))
                .collect(),
            None => self.set.iter().map(|(id, value)| (Var::from(*id), *value)).collect(),
        };
        let mut blocks =
            Block::ALL.map(|block| self.eeprom.region(Region::Block(self.active, block)).to_vec());
        for (variable, value) in &values {
            put(&mut blocks, *variable, *value);
        }
        for (block, payload) in Block::ALL.into_iter().zip(&blocks) {
            self.eeprom.set_region(Region::Block(self.active, block), payload);
        }
        for (variable, _) in values {
            self.set.remove(&variable.raw());
        }
    }

    /// Which slots hold a profile set, a bit each.
    pub(super) fn sets(&mut self) -> u8 {
        let files = Files(&mut self.eeprom);
        (0..SETS).filter(|slot| files.size(set_file(*slot)).is_some()).fold(0, |bits, slot| bits | 1 << slot)
    }

    /// The profile set that was loaded last, 1 to 6.
    pub(super) fn current_set(&self) -> u8 {
        self.eeprom.cell(Cell::ProfileSet).clamp(1, SETS)
    }

    /// Saves all profiles with their names into a slot, counted from 1.
    pub(super) fn save_set(&mut self, slot: u8) -> Result<(), Refusal> {
        let parts = [Region::Profiles, Region::Names, Region::VariableSlots];
        let content: Vec<u8> = parts.iter().flat_map(|region| self.eeprom.region(*region)).copied().collect();
        let file = self.set_slot(slot)?;
        Files(&mut self.eeprom).replace(file, &content).map_err(|_| Refusal::Failed)
    }

    /// Empties a slot; one that is empty already stays so.
    pub(super) fn clear_set(&mut self, slot: u8) -> Result<(), Refusal> {
        let file = self.set_slot(slot)?;
        let _ = Files(&mut self.eeprom).delete(file);
        Ok(())
    }

    /// Loads all profiles with their names from a slot; an empty one cannot be loaded.
    pub(super) fn load_set(&mut self, slot: u8) -> Result<(), Refusal> {
        let file = self.set_slot(slot)?;
        let content = Files(&mut self.eeprom).content(file).map_err(|_| Refusal::Failed)?;
        let mut rest = content.as_slice();
        for region in [Region::Profiles, Region::Names, Region::VariableSlots] {
            let size = self.eeprom.region(region).len();
            let (part, more) = rest.split_at_checked(size).ok_or(Refusal::Failed)?;
            self.eeprom.set_region(region, part);
            rest = more;
        }
        self.eeprom.set_cell(Cell::ProfileSet, slot);
        self.load(self.active);
        Ok(())
    }

    #[allow(clippy::unused_self, reason = "it belongs to the slots of this board")]
    fn set_slot(&self, slot: u8) -> Result<FileId, Refusal> {
        if (1..=SETS).contains(&slot) { Ok(set_file(slot - 1)) } else { Err(Refusal::Parameters) }
    }
}

fn set_file(index: u8) -> FileId {
    FileId::new(FileType::ProfileSet, index)
}

fn put(blocks: &mut [Vec<u8>; 4], variable: Var, value: f64) {
    if variable == Var::FollowYawPitch {
        put_follow(blocks, value);
        return;
    }
    for home in homes(variable) {
        if let Some(block) = blocks.get_mut(home.block() as usize) {
            home.write(block, value);
        }
    }
}

/// 0 follows nothing, 1 the yaw, 2 the yaw and the pitch.
fn put_follow(blocks: &mut [Vec<u8>; 4], value: f64) {
    for (variable, value) in
        [(Var::FollowYawPitch, value.min(1.0)), (Var::FollowPitch, (value - 1.0).max(0.0))]
    {
        for home in homes(variable) {
            if let Some(block) = blocks.get_mut(home.block() as usize) {
                home.write(block, value);
            }
        }
    }
}

/// Lays out an erased EEPROM as the factory does.
fn format(eeprom: &mut Eeprom, config: &Config) {
    eeprom.format();
    eeprom.set_region(Region::Names, &factory::names());
    eeprom.set_region(Region::VariableSlots, &[0; 128]);
    eeprom.set_region(Region::StateVars, &[0; 192]);
    eeprom.set_cell(Cell::ActiveProfile, config.profile);
    eeprom.set_cell(Cell::ProfileSet, 1);
    eeprom.set_cell(Cell::SelectedImu, 1);
    eeprom.set_cell(Cell::VoltageScale, 128);
    for profile in 0..PROFILES {
        for block in Block::ALL {
            eeprom.set_region(Region::Block(profile, block), &factory::block(profile, block, config.profile));
        }
    }
    for StoredBlock { id, profile, payload } in &config.parameters {
        let block = Block::ALL.into_iter().find(|block| block.read_by() == *id);
        if let Some(block) = block.filter(|block| block.size() == payload.len() && *profile < PROFILES) {
            eeprom.set_region(Region::Block(*profile, block), payload);
        }
    }
    Files(eeprom).clear();
}

/// Whether the board has to set up something anew that it does only at its start.
fn needs_restart(before: &Settings, after: &Settings) -> bool {
    let of = |settings: &Settings| {
        let Settings { params, ext, ext2, ext3 } = settings;
        (
            (params.pwm_freq, params.serial_speed, params.motor_output, params.i2c_speed_fast),
            (params.axis_top, params.axis_right, params.frame_axis_top, params.frame_axis_right),
            (params.frame_imu_pos, params.order_of_axes, params.rc_virt_mode),
            (ext.encoder_type, ext.encoder_cfg, ext2.rc_serial_speed, ext2.uart2_speed),
            (ext3.ext_imu_type, ext3.ext_imu_port),
        )
    };
    of(before) != of(after)
}
