//! Parameters of a board that is connected: reading, writing by plan, and what it does with whole profiles.

use std::collections::BTreeMap;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{
    BoardInfo, ErrorCode, ExecuteMenu, MenuCommand, Params3, ProfileId, ProfileNames, ProfileSet,
    ProfileSetAction, ProfileSetSlot, ReadAdjVarsCfg, ReadParams3, ReadParamsExt, ReadParamsExt2,
    ReadParamsExt3, ReadProfileNames, UseDefaults, WriteParamsSet, WriteParamsSetAction,
};
use sbgc_proto::wire::FixedText;
use sbgc_proto::{CommandId, Message};
use tokio::time::sleep;

use super::block::{Block, Place, Profile, has};
use super::catalog::Catalog;
use super::error::{ParamsError, Result};
use super::parameter::text_of;
use super::plan::{Plan, PlannedBlock};
use super::set::{Blocks, Snapshot, differences};
use crate::{Error, Gimbal};

/// How often a block is asked for when it is read back: some changes make the board restart.
const VERIFYING: u32 = 8;

/// How long a board may take to switch to another profile, and how often it is asked whether it has.
const SWITCHING: (u32, Duration) = (20, Duration::from_millis(50));

/// The parameters of a board that is connected.
#[derive(Clone, Debug)]
pub struct Parameters {
    gimbal: Gimbal,
    info: BoardInfo,
}

impl Parameters {
    /// Parameters of the board identified by `info`.
    pub const fn new(gimbal: Gimbal, info: BoardInfo) -> Self {
        Self { gimbal, info }
    }

    /// Identification of the board.
    pub const fn info(&self) -> &BoardInfo {
        &self.info
    }

    /// The board.
    pub const fn gimbal(&self) -> &Gimbal {
        &self.gimbal
    }

    /// Catalog of the parameters of a profile in this firmware.
    pub fn catalog(&self) -> Catalog {
        Catalog::of_profile(self.info.firmware_ver)
    }

    /// Catalog of the settings that belong to no profile.
    pub fn shared_catalog(&self) -> Catalog {
        Catalog::of_board(self.info.firmware_ver)
    }

    /// An empty plan for this firmware.
    pub const fn plan(&self) -> Plan {
        Plan::new(self.info.firmware_ver)
    }

    /// Reads the number of the active profile.
    ///
    /// # Errors
    /// If the board does not answer, or answers with a number that is not that of a profile.
    pub async fn active(&self) -> Result<Profile> {
        let params: Params3 = self.gimbal.request(&ReadParams3 { profile_id: ProfileId::Current }).await?;
        Profile::from_id(params.cur_profile_id)
            .ok_or(ParamsError::NoActiveProfile(params.cur_profile_id.raw()))
    }

    /// Reads all blocks of a profile.
    ///
    /// # Errors
    /// If the board does not answer, or refuses the first block.
    pub async fn read(&self, profile: Profile) -> Result<Blocks> {
        let mut blocks = Blocks::default();
        for block in Block::OF_PROFILE {
            self.read_into(&mut blocks, Place { profile: Some(profile), block }).await?;
        }
        Ok(blocks)
    }

    /// Reads the settings that belong to no profile.
    ///
    /// # Errors
    /// If the board does not answer.
    pub async fn read_shared(&self) -> Result<Blocks> {
        let mut blocks = Blocks::default();
        for block in Block::OF_BOARD {
            self.read_into(&mut blocks, Place { profile: None, block }).await?;
        }
        Ok(blocks)
    }

    /// Reads some profiles and the settings that belong to none.
    ///
    /// # Errors
    /// If the board does not answer.
    pub async fn snapshot(&self, profiles: impl IntoIterator<Item = Profile>) -> Result<Snapshot> {
        let shared = self.read_shared().await?;
        let mut read = BTreeMap::new();
        for profile in profiles {
            read.insert(profile, self.read(profile).await?);
        }
        let (board, firmware) = (self.info.board_ver, self.info.firmware_ver);
        Ok(Snapshot { board, firmware, shared, profiles: read })
    }

    /// Reads a block that the firmware may have.
    async fn read_into(&self, blocks: &mut Blocks, place: Place) -> Result<()> {
        if !place.block.is_in(self.info.firmware_ver) {
            return Ok(());
        }
        match self.read_block(&self.gimbal, place).await {
            Ok(payload) => blocks.insert(place.block, payload.to_vec()),
            // The first block is in every firmware; of the others not all say since when they are.
            Err(Error::Refused { code, .. }) if place.block != Block::Params3 && is_missing(code) => {}
            Err(error) => return Err(error.into()),
        }
        Ok(())
    }

    async fn read_block(&self, gimbal: &Gimbal, place: Place) -> crate::Result<Bytes> {
        let profile_id = place.profile.map_or(ProfileId::Current, Profile::id);
        Ok(match place.block {
            Block::Params3 => gimbal.exchange(&ReadParams3 { profile_id }).await?.payload().clone(),
            Block::Ext => gimbal.exchange(&ReadParamsExt { profile_id }).await?.payload().clone(),
            Block::Ext2 => gimbal.exchange(&ReadParamsExt2 { profile_id }).await?.payload().clone(),
            Block::Ext3 => gimbal.exchange(&ReadParamsExt3 { profile_id }).await?.payload().clone(),
            Block::ProfileNames => gimbal.exchange(&ReadProfileNames {}).await?.payload().clone(),
            Block::AdjustableConfig => gimbal.exchange(&ReadAdjVarsCfg {}).await?.payload().clone(),
        })
    }

    /// Carries out a plan: writes its blocks, between `CMD_WRITE_PARAMS_SET` where the firmware has it, and reads
    /// them back. `written` is called for each block written.
    ///
    /// If the board then holds other values, the previous ones are restored. If this future is dropped midway, the
    /// bracket is still closed, so that the board does not wait for more.
    ///
    /// # Errors
    /// If writing ends on the way, if the blocks cannot be read back, or if the board holds something else.
    pub async fn write(&self, plan: &Plan, mut written: impl FnMut(&PlannedBlock)) -> Result<()> {
        self.write_steps(plan, &mut written).await?;
        let places = || plan.steps().iter().map(|step| step.place).collect();
        match self.verify(plan).await {
            Ok(differences) if differences.is_empty() => Ok(()),
            Ok(differences) => {
                let undone = plan.undone();
                let restored = self.write_steps(&undone, &mut |_| {}).await.is_ok()
                    && self.verify(&undone).await.is_ok_and(|left| left.is_empty());
                Err(ParamsError::Mismatch { differences, restored })
            }
            Err(source) => Err(ParamsError::NotVerified { written: places(), source }),
        }
    }

    async fn write_steps(&self, plan: &Plan, written: &mut impl FnMut(&PlannedBlock)) -> Result<()> {
        let bracket = if plan.is_bracketed() { self.open_bracket().await? } else { None };
        for (at, step) in plan.steps().iter().enumerate() {
            if let Err(source) = self.write_step(step).await {
                let (before, left) = plan.steps().split_at_checked(at).unwrap_or_default();
                let places = |steps: &[PlannedBlock]| steps.iter().map(|step| step.place).collect();
                return Err(ParamsError::Interrupted { written: places(before), left: places(left), source });
            }
            written(step);
        }
        if let Some(bracket) = bracket {
            bracket.close().await;
        }
        Ok(())
    }

    /// Tells the board that blocks follow. A board that refuses gets them without.
    async fn open_bracket(&self) -> Result<Option<Bracket>> {
        let bracket = Bracket { gimbal: self.gimbal.clone(), open: true };
        match self.gimbal.confirm(&WriteParamsSet { action: WriteParamsSetAction::Start }).await {
            Err(Error::Refused { .. }) => Ok(None),
            // It may have come all the same.
            Ok(_) | Err(Error::Timeout { .. }) => Ok(Some(bracket)),
            Err(error) => Err(error.into()),
        }
    }

    /// Writes a block. A write whose confirmation does not come is looked after, and repeated when it did not come.
    async fn write_step(&self, step: &PlannedBlock) -> crate::Result<()> {
        let Err(error) = self.send_step(step).await else { return Ok(()) };
        if !matches!(error, Error::Timeout { .. }) {
            return Err(error);
        }
        if self.read_block(&self.gimbal, step.place).await.is_ok_and(|payload| step.is_done(&payload)) {
            return Ok(());
        }
        match self.send_step(step).await {
            // The board is there, so reading back decides.
            Err(Error::Timeout { .. }) => match self.read_block(&self.gimbal, step.place).await {
                Ok(payload) if step.is_done(&payload) => Ok(()),
                _ => Err(error),
            },
            outcome => outcome,
        }
    }

    async fn send_step(&self, step: &PlannedBlock) -> crate::Result<()> {
        let payload = Bytes::copy_from_slice(&step.after);
        self.gimbal.request_raw(step.place.block.write_id(), payload, CommandId::CONFIRM).await.map(drop)
    }

    /// What the board holds other than planned.
    async fn verify(&self, plan: &Plan) -> crate::Result<Vec<super::Difference>> {
        let patient = self.gimbal.with_attempts(VERIFYING.max(self.gimbal.options().attempts));
        let mut wrong = Vec::new();
        for step in plan.steps() {
            let payload = self.read_block(&patient, step.place).await?;
            if !step.is_done(&payload) {
                wrong.extend(differences(step.place, plan.firmware(), &step.after, &payload));
            }
        }
        Ok(wrong)
    }

    /// Reads the names of the five profiles.
    ///
    /// # Errors
    /// If the board does not answer.
    pub async fn names(&self) -> Result<Vec<String>> {
        let names: ProfileNames = self.gimbal.request(&ReadProfileNames {}).await?;
        Ok(names.profile_name.iter().map(|name| text_of(name.as_bytes())).collect())
    }

    /// Plans naming a profile.
    ///
    /// # Errors
    /// If the name is too long or the board does not answer.
    pub async fn plan_name(&self, profile: Profile, name: &str) -> Result<Plan> {
        if FixedText::<48>::new(name).is_err() {
            return Err(ParamsError::NameTooLong(name.len()));
        }
        let before = self.read_shared().await?;
        let path = format!("profile_name[{}]", profile.number() - 1);
        let parameter = self.shared_catalog().one(&path)?.clone();
        let bytes = parameter.parse(name).map_err(|source| ParamsError::Value {
            path,
            value: name.to_owned(),
            source: Box::new(source),
        })?;
        let mut after = before.clone();
        after.set(&parameter, &bytes);
        let mut plan = self.plan();
        plan.change(None, &before, &after);
        Ok(plan)
    }

    /// Plans copying all parameters of one profile to another.
    ///
    /// # Errors
    /// If the board does not answer.
    pub async fn plan_copy(&self, from: Profile, to: Profile) -> Result<Plan> {
        let (source, before) = (self.read(from).await?, self.read(to).await?);
        let mut plan = self.plan();
        plan.change(Some(to), &before, &before.copied_from(&source));
        Ok(plan)
    }

    /// Makes a profile the active one and waits until it is.
    ///
    /// # Errors
    /// If the board refuses, does not answer, or keeps its profile.
    pub async fn activate(&self, profile: Profile) -> Result<()> {
        match self.gimbal.confirm(&activation(profile)).await {
            // It may have come all the same.
            Ok(_) | Err(Error::Timeout { .. }) => {}
            Err(error) => return Err(error.into()),
        }
        let (times, pause) = SWITCHING;
        for _ in 0..times {
            if self.active().await? == profile {
                return Ok(());
            }
            sleep(pause).await;
        }
        let after = pause * times;
        Err(Error::Timeout { command: ExecuteMenu::SPEC, after, attempts: 1 }.into())
    }

    /// Resets a profile to the factory values.
    ///
    /// Not all boards confirm that, so it has worked when the board answers again and has not refused.
    ///
    /// # Errors
    /// If the board refuses or does not answer.
    pub async fn reset(&self, profile: Profile) -> Result<()> {
        let command = use_defaults(profile);
        let payload = Bytes::copy_from_slice(&[command.profile_id.raw()]);
        match self.gimbal.request_raw(UseDefaults::ID, payload, CommandId::CONFIRM).await {
            Ok(_) | Err(Error::Timeout { .. }) => {}
            Err(error) => return Err(error.into()),
        }
        let patient = self.gimbal.with_attempts(VERIFYING);
        self.read_block(&patient, Place { profile: Some(profile), block: Block::Params3 }).await?;
        Ok(())
    }

    /// Saves all profiles to a slot, loads them from it, or clears it.
    ///
    /// # Errors
    /// If the firmware does not have sets, or the board refuses or does not answer.
    pub async fn profile_set(&self, slot: ProfileSetSlot, action: ProfileSetAction) -> Result<()> {
        if !has(self.info.firmware_ver, ProfileSet::SINCE) {
            return Err(ParamsError::Firmware {
                what: ProfileSet::SPEC,
                since: ProfileSet::SINCE.unwrap_or_default(),
                firmware: self.info.firmware_ver,
            });
        }
        self.gimbal.confirm(&profile_set(slot, action)).await?;
        Ok(())
    }
}

/// The command that makes a profile the active one.
pub fn activation(profile: Profile) -> ExecuteMenu {
    let cmd_id = match profile.number() {
        1 => MenuCommand::Profile1,
        2 => MenuCommand::Profile2,
        3 => MenuCommand::Profile3,
        4 => MenuCommand::Profile4,
        _ => MenuCommand::Profile5,
    };
    ExecuteMenu { cmd_id }
}

/// The command that resets a profile to the factory values.
pub fn use_defaults(profile: Profile) -> UseDefaults {
    UseDefaults { profile_id: profile.id() }
}

/// The command that does something with a set of profiles.
pub fn profile_set(slot: ProfileSetSlot, action: ProfileSetAction) -> ProfileSet {
    ProfileSet { slot, action, ..ProfileSet::default() }
}

/// Whether an error code means that the firmware lacks the command.
fn is_missing(code: u8) -> bool {
    matches!(ErrorCode::from(code), ErrorCode::UnknownCommand | ErrorCode::NotSupported)
}

/// An open `CMD_WRITE_PARAMS_SET`, closed when it is dropped.
struct Bracket {
    gimbal: Gimbal,
    open: bool,
}

impl Bracket {
    /// The command that ends it.
    const FINISH: WriteParamsSet = WriteParamsSet { action: WriteParamsSetAction::Finish };

    /// Ends it and waits for the confirmation; without one, what is read back decides.
    async fn close(mut self) {
        let closed = self.gimbal.confirm(&Self::FINISH).await;
        self.open = closed.is_err();
    }
}

impl Drop for Bracket {
    fn drop(&mut self) {
        if self.open {
            // Nobody can wait here; the newest of a kind that is set goes out as soon as it can, and before a close.
            let _ = self.gimbal.set(&Self::FINISH);
        }
    }
}
