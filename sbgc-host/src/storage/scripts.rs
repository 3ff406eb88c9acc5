//! Scripts that the board runs by itself.

use sbgc_proto::CommandId;
use sbgc_proto::commands::{FileId, FileType, RunScript, RunScriptMode, ScriptDebug};

use super::Progress;
use crate::{Error, Gimbal, Result, TypedStream};

/// Slots for scripts, numbered from 1 here. Firmware before 2.73 has the first five.
pub const SCRIPT_SLOTS: u8 = 10;

impl Gimbal {
    /// Stores a compiled script in a slot, 1 to [`SCRIPT_SLOTS`].
    ///
    /// # Errors
    /// If there is no such slot; otherwise as [`file_write`](Self::file_write).
    pub async fn script_upload(&self, slot: u8, script: &[u8], progress: impl Progress) -> Result<()> {
        self.file_write(script_file(slot)?, script, progress).await
    }

    /// Deletes the script in a slot.
    ///
    /// # Errors
    /// If there is no such slot, or no script in it.
    pub async fn script_delete(&self, slot: u8) -> Result<()> {
        self.file_delete(script_file(slot)?).await
    }

    /// Size of the script in a slot in bytes; 0 for an empty one.
    ///
    /// # Errors
    /// If there is no such slot, or the board does not answer.
    pub async fn script_size(&self, slot: u8) -> Result<u16> {
        let index = slot_index(slot)?;
        let sizes = self.board_info3().await?.script_slot_sizes();
        Ok(sizes.get(usize::from(index)).copied().unwrap_or_default())
    }

    /// Starts the script in a slot; with `trace` the board reports each step, see
    /// [`script_trace`](Self::script_trace).
    ///
    /// # Errors
    /// If there is no such slot, if it is empty ([`Error::EmptySlot`]), or if the board refuses it.
    pub async fn script_run(&self, slot: u8, trace: bool) -> Result<()> {
        if self.script_size(slot).await? == 0 {
            return Err(Error::EmptySlot { slot });
        }
        let mode = if trace { RunScriptMode::StartWithDebug } else { RunScriptMode::Start };
        self.run_script(slot, mode).await
    }

    /// Stops the script in a slot.
    ///
    /// # Errors
    /// If there is no such slot, or the board refuses it.
    pub async fn script_stop(&self, slot: u8) -> Result<()> {
        self.run_script(slot, RunScriptMode::Stop).await
    }

    async fn run_script(&self, slot: u8, mode: RunScriptMode) -> Result<()> {
        let command = RunScript { mode, slot: slot_index(slot)?, ..RunScript::default() };
        self.send_checked(&command).await.map(drop)
    }

    /// The steps of a script that was started with a trace, as they come. Nothing is sent for it.
    pub fn script_trace(&self) -> TypedStream<ScriptDebug> {
        self.listen(CommandId::ScriptDebug).typed()
    }
}

fn slot_index(slot: u8) -> Result<u8> {
    match slot {
        1..=SCRIPT_SLOTS => Ok(slot - 1),
        _ => Err(Error::OutOfRange {
            what: "script slot",
            value: slot.into(),
            minimum: 1.0,
            maximum: SCRIPT_SLOTS.into(),
            unit: "",
        }),
    }
}

/// The file that holds the script of a slot: slots count from 1, files from 0.
///
/// # Errors
/// If there is no such slot.
pub fn script_file(slot: u8) -> Result<FileId> {
    Ok(FileId::new(FileType::Script, slot_index(slot)?))
}
