//! What can be compared and restored: files, the board, one of its profiles, factory values.

use std::fs;
use std::path::PathBuf;

use sbgc_host::params::{Blocks, Catalog, ParameterFile, Parameters, Profile, Snapshot};
use sbgc_host::{Gimbal, Options, sim};
use sbgc_proto::commands::BoardInfo;

use super::document::Document;
use crate::failure::Failure;
use crate::{files, places, talk};

/// Something that has parameters.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// A file of parameters.
    File(PathBuf),
    /// What the board has.
    Board,
    /// One of the board's profiles.
    Profile(Profile),
    /// What a profile has after a reset.
    Defaults,
}

/// A file, `board`, `defaults` or `profile:N`. A value parser of clap.
pub(super) fn source(text: &str) -> Result<Source, String> {
    match text.split_once(':') {
        _ if text == "board" => Ok(Source::Board),
        _ if text == "defaults" => Ok(Source::Defaults),
        Some(("profile", number)) => super::arguments::profile(number).map(Source::Profile),
        _ => Ok(Source::File(PathBuf::from(text))),
    }
}

/// Where the factory values of a board are kept once they were seen.
fn defaults_path(info: &BoardInfo) -> Option<PathBuf> {
    let name = format!("{:.1}-{}.toml", info.board_ver.number(), info.firmware_ver);
    Some(places::state()?.join("defaults").join(name))
}

/// Keeps what a profile has after a reset: the protocol has no command that reads factory values.
pub(super) fn keep_defaults(info: &BoardInfo, blocks: &Blocks) {
    let Some(path) = defaults_path(info) else { return };
    let snapshot = Snapshot {
        board: info.board_ver,
        firmware: info.firmware_ver,
        shared: Blocks::default(),
        profiles: Profile::all().take(1).map(|profile| (profile, blocks.clone())).collect(),
    };
    let made = path.parent().is_some_and(|directory| fs::create_dir_all(directory).is_ok());
    if !made || files::write(&path, ParameterFile::document(&snapshot).as_bytes()).is_err() {
        talk::say("the factory values could not be kept for `params diff defaults`");
    }
}

/// The factory values of a board: those of a simulated one, or those that were kept.
pub(super) async fn defaults(parameters: &Parameters) -> Result<Document, Failure> {
    if let Some(simulated) = of_simulated(parameters).await? {
        return Ok(simulated);
    }
    let info = parameters.info();
    let path = defaults_path(info).filter(|path| path.is_file()).ok_or_else(|| {
        Failure::Failed(format!(
            "the factory values of firmware {} on board {:.1} are unknown: no command reads them. \
             `sbgc profile reset N` keeps those that it finds",
            info.firmware_ver,
            info.board_ver.number(),
        ))
    })?;
    Document::read(&path, &[])
}

/// What a simulated board of the same kind has when it is new; nothing for a real board.
async fn of_simulated(parameters: &Parameters) -> Result<Option<Document>, Failure> {
    match parameters.gimbal().board_info3().await {
        Ok(more) if more.device_id.0 == sim::DEVICE_ID => {}
        // Boards of the first generations do not know the command.
        Ok(_) | Err(sbgc_host::Error::Timeout { .. } | sbgc_host::Error::Refused { .. }) => return Ok(None),
        Err(error) => return Err(error.into()),
    }
    let info = parameters.info();
    let config = sim::Config { board: info.board_ver, firmware: info.firmware_ver, ..sim::Config::default() };
    let new = Gimbal::spawn(sim::in_process(config), Options::default());
    let factory = Parameters::new(new.clone(), new.handshake().await?);
    let snapshot = factory.snapshot(Profile::all()).await?;
    new.close().await;
    Document::parse(&ParameterFile::document(&snapshot), "defaults", &[]).map(Some)
}

/// Factory values laid over a profile.
pub(super) fn over(
    defaults: &Document,
    profile: Profile,
    blocks: &Blocks,
    catalog: &Catalog,
) -> Result<Blocks, Failure> {
    let parts = defaults.profiles(Some(profile), None)?;
    Ok(parts
        .first()
        .map_or_else(|| blocks.clone(), |(own, _)| defaults.lay(*own, blocks, catalog, "defaults")))
}
