//! Which commands are asked about before they are sent as they are: those that other commands of the tool ask about.

use sbgc_proto::{CommandId, Direction, RequestInfo};

/// Commands that change what the board keeps, what is connected to it, or whether it starts.
const DANGEROUS: &[CommandId] = &[
    // Parameters and profiles.
    CommandId::WriteParams,
    CommandId::WriteParams3,
    CommandId::WriteParamsExt,
    CommandId::WriteParamsExt2,
    CommandId::WriteParamsExt3,
    CommandId::WriteParamsSet,
    CommandId::WriteProfileNames,
    CommandId::ProfileSet,
    CommandId::UseDefaults,
    // Adjustable variables.
    CommandId::SaveParams3,
    CommandId::WriteAdjVarsCfg,
    // Storage and buses.
    CommandId::EepromWrite,
    CommandId::WriteFile,
    CommandId::FsClearAll,
    CommandId::WriteExternalData,
    CommandId::I2cWriteRegBuf,
    // Outputs.
    CommandId::TriggerPin,
    CommandId::ServoOut,
    CommandId::ServoOutExt,
    // Start.
    CommandId::BootMode3,
    CommandId::ModuleFlashStart,
    CommandId::ModuleFlashWrite,
    CommandId::ModuleFlashFinish,
    CommandId::SetDeviceAddr,
    CommandId::PassProtectWrite,
    // Calibrations that move the motors, and tuning.
    CommandId::CalibPoles,
    CommandId::EncodersCalibOffset4,
    CommandId::EncodersCalibFldOffset4,
    CommandId::CalibEncoderLut,
    CommandId::EncIntCalib,
    CommandId::AutoPid,
    CommandId::AutoPid2,
];

/// The names of the commands among these that are asked about, each once.
pub(super) fn dangerous(commands: impl Iterator<Item = CommandId>) -> Vec<String> {
    let mut names = Vec::new();
    for command in commands.filter(|command| DANGEROUS.contains(command)) {
        let name = command.spec_name(Direction::Outgoing).unwrap_or("unknown command").to_owned();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Whether a command does more than ask, so that `--dry-run` shows it instead of sending it.
pub(super) fn changes(command: CommandId, payload: &[u8]) -> bool {
    RequestInfo::of_payload(command, payload).is_none_or(|info| info.acts)
}
