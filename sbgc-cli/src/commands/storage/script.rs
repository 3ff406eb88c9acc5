//! `sbgc script`: scripts that the board runs by itself.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use sbgc_host::Gimbal;
use sbgc_host::storage::{file_portions, script_file};
use sbgc_host::streams::Item;
use sbgc_proto::commands::{FsErrorCode, RunScript, RunScriptMode, ScriptDebug, WriteFileDelete};
use serde_json::json;

use super::file;
use crate::connect::{with_board, with_followed_board};
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::progress::Bar;
use crate::{act, files, talk};

const EXAMPLES: &str = "Examples:
  sbgc script stop 1
  sbgc --dry-run script delete 2";

/// Upload, run, stop, trace and delete scripts
///
/// Slots count from 1. Scripts are uploaded as the vendor's GUI compiles them.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Script {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Store a compiled script in a slot (asks first)
    #[command(after_help = "Examples:
  sbgc encode RESET > program.bin && sbgc script upload 3 program.bin --yes
  sbgc encode RESET | sbgc script upload 3 - --dry-run")]
    Upload {
        #[command(flatten)]
        slot: Slot,
        /// File with the compiled script; - is standard input
        file: PathBuf,
    },
    /// Start the script in a slot
    #[command(after_help = "Examples:
  sbgc encode RESET | sbgc --port sim:board script upload 1 - --yes
  sbgc --port sim:board script run 1 --dry-run")]
    Run {
        #[command(flatten)]
        slot: Slot,
    },
    /// Stop the script in a slot
    #[command(after_help = "Examples:
  sbgc script stop 1
  sbgc script stop 2 --json")]
    Stop {
        #[command(flatten)]
        slot: Slot,
    },
    /// Delete the script in a slot (asks first)
    #[command(after_help = "Examples:
  sbgc script delete 2 --dry-run
  sbgc --json --dry-run script delete 2")]
    Delete {
        #[command(flatten)]
        slot: Slot,
    },
    /// Show the steps of a running script until interrupted
    #[command(after_help = "Examples:
  sbgc script trace
  sbgc script trace --json")]
    Trace {
        /// Slot of the script to start [default: trace the running one]
        #[arg(value_parser = clap::value_parser!(u8).range(1..=10))]
        slot: Option<u8>,
    },
}

#[derive(Args, Debug)]
struct Slot {
    /// Slot, 1 to 10
    #[arg(value_parser = clap::value_parser!(u8).range(1..=10))]
    slot: u8,
}

impl Script {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Upload { slot, file } => upload(global, output, slot.slot, &file).await,
            What::Run { slot } => run(global, output, slot.slot).await,
            What::Stop { slot } => stop(global, output, slot.slot).await,
            What::Delete { slot } => delete(global, output, slot.slot).await,
            What::Trace { slot } => until_stopped(trace(global, output, slot).await),
        }
    }
}

async fn upload(
    global: &Global,
    output: &mut Output,
    slot: u8,
    file: &std::path::Path,
) -> Result<(), Failure> {
    let script = files::read(file)?;
    let id = script_file(slot)?;
    // Whatever cannot be written is refused before the board is asked anything.
    drop(file_portions(id, &script)?);
    with_board(global, async |gimbal, _| {
        if global.dry_run {
            for portion in file_portions(id, &script)? {
                act::show(output, gimbal.version(), &portion)?;
            }
            return Ok(());
        }
        file::ask_to_write(global, &gimbal, &format!("script slot {slot}"), id, &script).await?;
        let bar = Bar::bytes(global, "writing");
        gimbal.script_upload(slot, &script, |done, all| bar.show(done, all)).await?;
        drop(bar);
        let size = script.len();
        finish(
            output,
            slot,
            Some(size),
            "done",
            format_args!("slot {slot}: {size} bytes written and verified"),
        )
    })
    .await
}

async fn run(global: &Global, output: &mut Output, slot: u8) -> Result<(), Failure> {
    with_board(global, async |gimbal, _| {
        let size = gimbal.script_size(slot).await?;
        if size == 0 {
            return Err(sbgc_host::Error::EmptySlot { slot }.into());
        }
        if global.dry_run {
            return dry(output, &gimbal, slot, RunScriptMode::Start);
        }
        gimbal.script_run(slot, false).await?;
        finish(output, slot, Some(size.into()), "accepted", format_args!("slot {slot}: started"))
    })
    .await
}

async fn stop(global: &Global, output: &mut Output, slot: u8) -> Result<(), Failure> {
    with_board(global, async |gimbal, _| {
        if global.dry_run {
            return dry(output, &gimbal, slot, RunScriptMode::Stop);
        }
        gimbal.script_stop(slot).await?;
        let size = gimbal.script_size(slot).await.ok().map(usize::from);
        finish(output, slot, size, "stopped", format_args!("slot {slot}: stopped"))
    })
    .await
}

async fn delete(global: &Global, output: &mut Output, slot: u8) -> Result<(), Failure> {
    let id = script_file(slot)?;
    with_board(global, async |gimbal, _| {
        if global.dry_run {
            let command = WriteFileDelete { file_id: id, ..WriteFileDelete::default() };
            return act::show(output, gimbal.version(), &command);
        }
        let size = file::present(&gimbal, id).await?.map_or(0, |data| data.len());
        talk::say(format_args!("script slot {slot}: {size} bytes are deleted"));
        act::ask(global, "Delete the script from the board?").await?;
        gimbal.script_delete(slot).await?;
        finish(output, slot, Some(size), "done", format_args!("slot {slot}: deleted"))
    })
    .await
}

async fn trace(global: &Global, output: &mut Output, slot: Option<u8>) -> Result<(), Failure> {
    with_followed_board(global, async |gimbal, _| {
        let mut steps = gimbal.script_trace();
        if let Some(slot) = slot {
            if global.dry_run {
                return dry(output, &gimbal, slot, RunScriptMode::StartWithDebug);
            }
            gimbal.script_run(slot, true).await?;
        }
        while let Some(step) = steps.next().await {
            match step {
                Item::Message(ScriptDebug { cmd_count, err_code }) => {
                    step_line(output, slot, cmd_count, err_code)?;
                }
                Item::Lagged(count) => talk::say(format_args!("{count} steps were lost")),
                Item::Undecoded(error) => talk::say(error),
                Item::Interrupted(_) | Item::Resumed(_) | Item::WrongLength { .. } => {}
            }
            output.flush()?;
        }
        Err(sbgc_host::Error::Disconnected.into())
    })
    .await
}

fn step_line(output: &mut Output, slot: Option<u8>, step: u16, code: FsErrorCode) -> Result<(), Failure> {
    let label = FsErrorCode::LABELS.iter().find(|label| label.value == i64::from(code.raw()));
    let name = label.map_or_else(|| code.raw().to_string(), |label| label.name.to_owned());
    let failed = code != FsErrorCode::NoError;
    if output.is_json() {
        let state = if failed { "failed" } else { "running" };
        return Ok(output.object(&json!({
            "slot": slot, "size": null, "state": state, "cmd_count": step, "err_code": name,
        }))?);
    }
    let error = if failed { format!("  {name}") } else { String::new() };
    Ok(output.line(format_args!("step {step}{error}"))?)
}

fn dry(output: &mut Output, gimbal: &Gimbal, slot: u8, mode: RunScriptMode) -> Result<(), Failure> {
    let command = RunScript { mode, slot: script_file(slot)?.number(), ..RunScript::default() };
    act::show(output, gimbal.version(), &command)
}

fn finish(
    output: &mut Output,
    slot: u8,
    size: Option<usize>,
    state: &str,
    text: impl std::fmt::Display,
) -> Result<(), Failure> {
    if output.is_json() {
        return Ok(output.object(&json!({"slot": slot, "size": size, "state": state}))?);
    }
    Ok(output.line(text)?)
}
