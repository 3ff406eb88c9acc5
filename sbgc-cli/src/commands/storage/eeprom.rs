//! `sbgc eeprom`: the EEPROM as plain memory.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use sbgc_host::Gimbal;
use sbgc_host::storage::{EEPROM_PAGE, eeprom_portions};
use serde_json::json;

use super::bytes::{differences, dump};
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::progress::Bar;
use crate::{act, files, talk, values};

const EXAMPLES: &str = "Examples:
  sbgc eeprom read 0x40 64
  sbgc eeprom read 0x100 16 --json
  sbgc eeprom backup board.eeprom";

/// Read, write, back up and restore the EEPROM
///
/// It holds settings and calibrations, and the board does not validate what is written: make a backup first. Blocks
/// are multiples of 64 bytes at multiples of 64; reading may start and end anywhere.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Eeprom {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Print bytes
    #[command(after_help = "Examples:
  sbgc eeprom read 0x40 64
  sbgc eeprom read 256 16 --json")]
    Read {
        /// First address, decimal or 0x hex
        #[arg(value_parser = values::number)]
        address: u32,
        /// Number of bytes
        #[arg(value_parser = values::number)]
        length: u32,
    },
    /// Write blocks of 64 bytes and read them back (asks first)
    #[command(after_help = "Examples:
  sbgc eeprom backup all.bin && sbgc eeprom write 0 all.bin --yes
  sbgc eeprom backup all.bin && sbgc eeprom write 0 all.bin --dry-run")]
    Write {
        /// First address, a multiple of 64
        #[arg(value_parser = values::number)]
        address: u32,
        /// Bytes in hex, or a file with the bytes
        #[arg(value_name = "HEX|FILE")]
        data: String,
    },
    /// Write the whole EEPROM to a file
    #[command(after_help = "Examples:
  sbgc eeprom backup board.eeprom
  sbgc eeprom backup board.eeprom --json")]
    Backup {
        /// File to write
        file: PathBuf,
    },
    /// Write a backup to the EEPROM, only blocks that differ (asks first)
    #[command(after_help = "Examples:
  sbgc eeprom backup board.eeprom && sbgc eeprom restore board.eeprom --yes
  sbgc eeprom backup board.eeprom && sbgc eeprom restore board.eeprom --dry-run")]
    Restore {
        /// File to read
        file: PathBuf,
    },
}

impl Eeprom {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Read { address, length } => read(global, output, address, length).await,
            What::Write { address, data } => write(global, output, address, &bytes(&data)?).await,
            What::Backup { file } => backup(global, output, &file).await,
            What::Restore { file } => restore(global, output, &file).await,
        }
    }
}

/// The bytes of a file of that name, or of hex digits.
fn bytes(text: &str) -> Result<Vec<u8>, Failure> {
    if Path::new(text).exists() {
        return files::read(Path::new(text));
    }
    values::bytes(text).map_err(|error| Failure::Usage(format!("there is no file of that name, and {error}")))
}

async fn read(global: &Global, output: &mut Output, address: u32, length: u32) -> Result<(), Failure> {
    if length == 0 || address.checked_add(length).is_none() {
        return Err(Failure::Usage(format!("{length} is out of range; expected 1 byte or more")));
    }
    let size = usize::try_from(length).unwrap_or(usize::MAX);
    let data = with_board(global, async |gimbal, _| read_all(global, &gimbal, address, size).await).await?;
    if output.is_json() {
        return show(output, address, &data);
    }
    Ok(dump(output, address, &data)?)
}

async fn read_all(global: &Global, gimbal: &Gimbal, address: u32, length: usize) -> Result<Vec<u8>, Failure> {
    let bar = Bar::bytes(global, "reading");
    Ok(gimbal.eeprom_read(address, length, |done, all| bar.show(done, all)).await?)
}

async fn write(global: &Global, output: &mut Output, address: u32, data: &[u8]) -> Result<(), Failure> {
    if data.is_empty() {
        return Err(Failure::Usage(String::from("there is nothing to write")));
    }
    drop(eeprom_portions(address, data)?);
    with_board(global, async |gimbal, _| {
        if global.dry_run {
            return dry(output, &gimbal, address, data);
        }
        let before = read_all(global, &gimbal, address, data.len()).await?;
        let (count, first) = differences(&before, data);
        let Some(first) = first else {
            talk::say("the board has these bytes already");
            return done(output, address, data, "nothing to write");
        };
        let at = address as usize + first;
        talk::say(format_args!("{count} of {} bytes change, the first at {at:#x}", data.len()));
        act::ask(global, "Write them to the EEPROM?").await?;
        let bar = Bar::bytes(global, "writing");
        gimbal.eeprom_write(address, data, |done, all| bar.show(done, all)).await?;
        drop(bar);
        done(output, address, data, "written and verified")
    })
    .await
}

async fn backup(global: &Global, output: &mut Output, file: &Path) -> Result<(), Failure> {
    with_board(global, async |gimbal, _| {
        let size = usize::try_from(gimbal.eeprom_size().await?).unwrap_or(usize::MAX);
        let data = read_all(global, &gimbal, 0, size).await?;
        files::write(file, &data)?;
        done(output, 0, &data, "saved")
    })
    .await
}

async fn restore(global: &Global, output: &mut Output, file: &Path) -> Result<(), Failure> {
    let data = files::read(file)?;
    if data.is_empty() || data.len() % EEPROM_PAGE != 0 {
        let length = data.len();
        return Err(Failure::Failed(format!("not a backup: expected a multiple of 64 bytes, got {length}")));
    }
    with_board(global, async |gimbal, _| {
        let size = usize::try_from(gimbal.eeprom_size().await?).unwrap_or(usize::MAX);
        if data.len() != size {
            let length = data.len();
            return Err(Failure::Failed(format!(
                "the backup is of another board: it has {length} bytes, the EEPROM {size}"
            )));
        }
        let before = read_all(global, &gimbal, 0, size).await?;
        let blocks: Vec<(u32, &[u8])> = (0..)
            .step_by(EEPROM_PAGE)
            .zip(data.chunks(EEPROM_PAGE).zip(before.chunks(EEPROM_PAGE)))
            .filter(|(_, (after, before))| after != before)
            .map(|(address, (after, _))| (address, after))
            .collect();
        if global.dry_run {
            return blocks.iter().try_for_each(|(address, block)| dry(output, &gimbal, *address, block));
        }
        let Some((first, _)) = blocks.first() else {
            talk::say("the board has these bytes already");
            return done(output, 0, &data, "nothing to write");
        };
        let (changed, _) = differences(&before, &data);
        let count = blocks.len();
        talk::say(format_args!("{changed} bytes in {count} blocks of 64 change, the first at {first:#x}"));
        act::ask(global, "Write them to the EEPROM?").await?;
        let bar = Bar::bytes(global, "writing");
        for (index, (address, block)) in blocks.iter().enumerate() {
            bar.show(index * EEPROM_PAGE, count * EEPROM_PAGE);
            gimbal.eeprom_write(*address, block, |_, _| {}).await.inspect_err(|_| {
                talk::say(format_args!(
                    "{index} of {count} blocks are written; run the same command again to complete it"
                ));
            })?;
        }
        drop(bar);
        done(output, 0, &data, "restored and verified")
    })
    .await
}

fn dry(output: &mut Output, gimbal: &Gimbal, address: u32, data: &[u8]) -> Result<(), Failure> {
    for portion in eeprom_portions(address, data)? {
        act::show(output, gimbal.version(), &portion)?;
    }
    Ok(())
}

fn done(output: &mut Output, address: u32, data: &[u8], text: &str) -> Result<(), Failure> {
    if output.is_json() {
        return show(output, address, data);
    }
    Ok(output.line(format_args!("{} bytes at {address:#x}: {text}", data.len()))?)
}

fn show(output: &mut Output, address: u32, data: &[u8]) -> Result<(), Failure> {
    Ok(output.object(&json!({"address": address, "length": data.len(), "data": hex::encode(data)}))?)
}
