//! `sbgc file`: the board's internal file system.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use sbgc_host::Gimbal;
use sbgc_host::storage::file_portions;
use sbgc_proto::commands::{FileId, FileType, FsErrorCode, WriteFileDelete};
use serde_json::{Value, json};

use super::bytes::differences;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::progress::Bar;
use crate::{act, files, talk, text, values};

const EXAMPLES: &str = "Examples:
  sbgc --dry-run file delete script:0
  sbgc --dry-run --json file delete 0x0301";

/// Read, write and delete files of the board
///
/// ID is TYPE:INDEX (script:3), a TYPE alone (index 0), or a number whose low byte is the type (0x0301). Types:
/// script, imu_calib, cogging_correction, adj_var_lut, profile_set, params, tune, candrv. Indices count from 0: the
/// script in slot 1 is script:0.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct File {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Read a file to another, or to standard output
    #[command(after_help = "Examples:
  sbgc encode RESET | sbgc --port sim:board file write script:3 - --yes
  sbgc --port sim:board file read script:3
  sbgc --port sim:board file read 0x0301 copy.bin")]
    Read {
        /// File of the board
        #[arg(value_parser = id)]
        id: FileId,
        /// File to write [default: standard output]
        file: Option<PathBuf>,
    },
    /// Write a file and read it back (asks first)
    #[command(after_help = "Examples:
  sbgc encode RESET | sbgc file write script:3 - --yes
  sbgc encode RESET | sbgc file write 0x0301 - --dry-run")]
    Write {
        /// File of the board
        #[arg(value_parser = id)]
        id: FileId,
        /// File to read; - is standard input
        file: PathBuf,
    },
    /// Delete a file (asks first)
    #[command(after_help = "Examples:
  sbgc file delete script:0 --dry-run
  sbgc --dry-run --json file delete 0x0301")]
    Delete {
        /// File of the board
        #[arg(value_parser = id)]
        id: FileId,
    },
}

const PREFIX: &str = "FILE_TYPE_";

fn short(name: &str) -> String {
    name.strip_prefix(PREFIX).unwrap_or(name).to_ascii_lowercase()
}

fn id(text: &str) -> Result<FileId, String> {
    if text.starts_with(|first: char| first.is_ascii_digit()) {
        let number = values::number(text)?;
        return u16::try_from(number)
            .map(FileId)
            .map_err(|_| format!("{text} is out of range; expected 0 to 0xffff"));
    }
    let (name, index) = text.split_once(':').unwrap_or((text, "0"));
    let wanted = short(&name.to_ascii_uppercase().replace('-', "_"));
    let Some(label) = FileType::LABELS.iter().find(|label| short(label.name) == wanted) else {
        let names: Vec<String> = FileType::LABELS.iter().map(|label| short(label.name)).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let unknown = text::unknown("type of file", name, names.iter().copied());
        return Err(format!("{unknown}; available: {}", names.join(", ")));
    };
    let index: u8 =
        index.parse().map_err(|_| format!("index \"{index}\" is out of range; expected 0 to 255"))?;
    Ok(FileId::new(FileType::from(u8::try_from(label.value).unwrap_or_default()), index))
}

/// A file as it is typed.
fn name(id: FileId) -> String {
    let kind = id.file_type();
    let label = FileType::LABELS.iter().find(|label| label.value == i64::from(kind.raw()));
    label.map_or_else(|| format!("{:#06x}", id.0), |label| format!("{}:{}", short(label.name), id.number()))
}

impl File {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Read { id, file } => read(global, output, id, file.as_deref()).await,
            What::Write { id, file } => write(global, output, id, &file).await,
            What::Delete { id } => delete(global, output, id).await,
        }
    }
}

async fn read(global: &Global, output: &mut Output, id: FileId, file: Option<&Path>) -> Result<(), Failure> {
    let data = with_board(global, async |gimbal, _| {
        let bar = Bar::bytes(global, "reading");
        Ok(gimbal.file_read(id, |done, all| bar.show(done, all)).await?)
    })
    .await?;
    match file {
        Some(file) => files::write(file, &data)?,
        None if !output.is_json() => {
            use std::io::Write as _;
            return Ok(output.writer().write_all(&data)?);
        }
        None => {}
    }
    let bytes = file.is_none().then(|| hex::encode(&data));
    let own = json!({"id": name(id), "size": data.len(), "state": "done"});
    finish(output, own, bytes, format_args!("{}: {} bytes", name(id), data.len()))
}

/// What is there now; nothing if there is no such file.
pub(super) async fn present(gimbal: &Gimbal, id: FileId) -> Result<Option<Vec<u8>>, Failure> {
    match gimbal.file_read(id, |_, _| {}).await {
        Ok(data) => Ok(Some(data)),
        Err(error) if error.file_error() == Some(FsErrorCode::FileNotFound) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Says what would change, and asks.
pub(super) async fn ask_to_write(
    global: &Global,
    gimbal: &Gimbal,
    what: &str,
    id: FileId,
    data: &[u8],
) -> Result<(), Failure> {
    match present(gimbal, id).await? {
        None => talk::say(format_args!("{what}: {} bytes in a new file", data.len())),
        Some(before) => {
            let (count, _) = differences(&before, data);
            let (old, new) = (before.len(), data.len());
            talk::say(format_args!("{what}: {new} bytes replace {old}; {count} of them differ"));
        }
    }
    act::ask(global, "Write it to the board?").await
}

async fn write(global: &Global, output: &mut Output, id: FileId, file: &Path) -> Result<(), Failure> {
    let data = files::read(file)?;
    // Whatever cannot be written is refused before the board is asked anything.
    drop(file_portions(id, &data)?);
    with_board(global, async |gimbal, _| {
        if global.dry_run {
            for portion in file_portions(id, &data)? {
                act::show(output, gimbal.version(), &portion)?;
            }
            return Ok(());
        }
        ask_to_write(global, &gimbal, &name(id), id, &data).await?;
        let bar = Bar::bytes(global, "writing");
        gimbal.file_write(id, &data, |done, all| bar.show(done, all)).await?;
        drop(bar);
        let own = json!({"id": name(id), "size": data.len(), "state": "done"});
        finish(output, own, None, format_args!("{}: {} bytes written and verified", name(id), data.len()))
    })
    .await
}

async fn delete(global: &Global, output: &mut Output, id: FileId) -> Result<(), Failure> {
    with_board(global, async |gimbal, _| {
        if global.dry_run {
            let command = WriteFileDelete { file_id: id, ..WriteFileDelete::default() };
            return act::show(output, gimbal.version(), &command);
        }
        let size = present(&gimbal, id).await?.map_or(0, |data| data.len());
        talk::say(format_args!("{}: {size} bytes are deleted", name(id)));
        act::ask(global, "Delete the file from the board?").await?;
        gimbal.file_delete(id).await?;
        let own = json!({"id": name(id), "size": size, "state": "done"});
        finish(output, own, None, format_args!("{}: deleted", name(id)))
    })
    .await
}

fn finish(
    output: &mut Output,
    mut own: Value,
    bytes: Option<String>,
    text: impl std::fmt::Display,
) -> Result<(), Failure> {
    if !output.is_json() {
        return Ok(output.line(text)?);
    }
    if let (Some(bytes), Some(object)) = (bytes, own.as_object_mut()) {
        object.insert("data".into(), bytes.into());
    }
    Ok(output.object(&own)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_by_type_and_index_or_number() {
        for (text, number) in [
            ("script:3", 0x0301),
            ("SCRIPT", 0x0001),
            ("FILE_TYPE_IMU_CALIB:1", 0x0103),
            ("adj-var-lut:2", 0x0205),
            ("0x0301", 0x0301),
            ("769", 0x0301),
        ] {
            assert_eq!(id(text), Ok(FileId(number)), "{text}");
        }
        assert_eq!(name(FileId(0x0301)), "script:3");
        assert_eq!(name(FileId(0x0163)), "0x0163");
        for text in ["scrpt:1", "script:256", "script:x", "65536", ""] {
            assert!(id(text).is_err(), "{text}");
        }
        assert!(id("scrpt").unwrap_err().contains("did you mean script"));
    }
}
