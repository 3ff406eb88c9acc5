//! `sbgc decode`: captured traffic, explained.

use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use sbgc_host::capture::{Captured, Format, Reader};
use sbgc_proto::Direction;

use super::explain::Explainer;
use super::pieces::{Piece, Pieces};
use super::summary::Summary;
use crate::failure::Failure;
use crate::output::Output;
use crate::{signals, values};

const EXAMPLES: &str = "Examples:
  sbgc encode BOARD_INFO | sbgc decode
  sbgc encode CONFIRM cmd_id=1 --direction incoming | sbgc decode --json
  sbgc record capture.log --count 5 && sbgc decode capture.log --summary";

/// Explain captured traffic
///
/// Shows each frame with all its fields, and each run of bytes that belongs to no frame, with the cause. Piped input
/// is shown as it arrives. Replies that depend on their request are decoded using requests seen earlier.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Decode {
    /// Capture file; standard input if omitted or `-`
    file: Option<PathBuf>,

    /// Format of the capture
    #[arg(long, value_enum, default_value_t)]
    from: From,

    /// Direction of the messages
    #[arg(long, value_enum, default_value_t)]
    direction: Way,

    /// Flags of CMD_REALTIME_DATA_CUSTOM, where the capture has no request for it
    #[arg(long, value_name = "N", value_parser = values::number)]
    custom_flags: Option<u32>,

    /// Print frames and bytes per command and skipped bytes per cause instead
    ///
    /// Bytes are those of whole frames; of payloads where the capture does not say the version.
    #[arg(long)]
    summary: bool,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum From {
    /// Detect from the first bytes
    #[default]
    Auto,
    /// Raw bytes
    Bin,
    /// Hex digits; white space, 0x, : and , between bytes
    Hex,
    /// Debug log of the GUI, or a recording
    Log,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Way {
    /// From the capture, or inferred from id and length
    #[default]
    Auto,
    /// Host to controller
    Outgoing,
    /// Controller to host
    Incoming,
}

impl Decode {
    pub(crate) fn run(self, output: &mut Output) -> Result<(), Failure> {
        let pieces = Pieces::open(self.file.as_deref())?;
        let reader = Reader::new(self.from.into());
        let direction = match self.direction {
            Way::Auto => None,
            Way::Outgoing => Some(Direction::Outgoing),
            Way::Incoming => Some(Direction::Incoming),
        };
        if self.summary {
            let mut summary = Summary::new(self.custom_flags, direction);
            let read = read(&pieces, reader, &mut summary, |summary, item| {
                if let Some(item) = item {
                    summary.count(item);
                }
                Ok(())
            });
            summary.print(output)?;
            return read;
        }
        let mut explainer = Explainer::new(self.custom_flags, direction, output);
        read(&pieces, reader, &mut explainer, |explainer, item| match item {
            Some(item) => explainer.print(item),
            None => explainer.output.flush(),
        })
    }
}

impl std::convert::From<From> for Format {
    fn from(from: From) -> Self {
        match from {
            From::Auto => Format::Auto,
            From::Bin => Format::Bin,
            From::Hex => Format::Hex,
            From::Log => Format::Log,
        }
    }
}

/// Reads a capture to its end and hands its items to `take`, and `None` when no more are there at the moment.
fn read<T>(
    pieces: &Pieces,
    mut reader: Reader,
    taker: &mut T,
    take: fn(&mut T, Option<Captured>) -> io::Result<()>,
) -> Result<(), Failure> {
    // Once is enough: what still waits then has nothing behind it.
    let mut is_idle = false;
    loop {
        let mut result = Ok(());
        let mut item = |item| {
            if result.is_ok() {
                result = take(taker, Some(item));
            }
        };
        let gap = (reader.is_waiting() && !is_idle).then_some(Reader::GAP);
        let (fed, ended) = match pieces.next(gap)? {
            Piece::Bytes(bytes) => {
                is_idle = false;
                (reader.feed(&bytes, &mut item), false)
            }
            Piece::Gap => {
                is_idle = true;
                reader.idle(&mut item);
                (Ok(()), false)
            }
            Piece::End => (reader.finish(&mut item), true),
        };
        result.and_then(|()| take(taker, None))?;
        fed?;
        if ended {
            return Ok(());
        }
    }
}

/// Reads a capture as a whole.
pub(super) fn read_all(path: &Path, format: Format) -> Result<Vec<Captured>, Failure> {
    signals::blocking(|| {
        let mut items = Vec::new();
        read(&Pieces::open(Some(path))?, Reader::new(format), &mut items, |items, item| {
            items.extend(item);
            Ok(())
        })?;
        Ok(items)
    })
}
