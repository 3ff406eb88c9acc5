//! Captures of any format to frames.

use sbgc_proto::Direction;
use sbgc_proto::frame::{Cause, Decoder, Event, Skipped, Version, Versions};
use thiserror::Error;

use super::hex::{HexError, HexReader};
use super::log::{self, LogLine};

/// How a capture is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Whichever of the others the beginning looks like.
    #[default]
    Auto,
    /// Raw bytes.
    Bin,
    /// Hex digits, with white space, `0x`, `:` or `,` between the bytes.
    Hex,
    /// Lines of the GUI's debug log, or our own recordings.
    Log,
}

/// What a capture holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Item {
    /// A frame.
    Frame {
        /// Offset of its first byte; in a log the number of the line, from 1 on.
        at: u64,
        /// Version of its framing; a log does not say.
        version: Option<Version>,
        /// Which way it went, where the capture says.
        direction: Option<Direction>,
        /// Id of the command.
        id: u8,
        /// The payload.
        payload: Vec<u8>,
    },
    /// Bytes that are no frame.
    Skipped {
        /// Offset of the first; in a log the number of the line, from 1 on.
        at: u64,
        /// How many.
        length: usize,
        /// Why.
        cause: Cause,
    },
}

/// A capture that is not what its format says.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReadError {
    /// Not hex.
    #[error(transparent)]
    Hex(#[from] HexError),
}

/// Reads a capture piece by piece, so that it can be a pipe that never ends.
#[derive(Debug)]
pub struct Reader {
    format: Format,
    decoder: Decoder,
    hex: HexReader,
    line: Vec<u8>,
    lines: u64,
    skipped: Option<Skipped>,
}

impl Reader {
    /// Reads captures of `format`.
    pub fn new(format: Format) -> Self {
        Reader {
            format,
            decoder: Decoder::new(Versions::Both),
            hex: HexReader::default(),
            line: Vec::new(),
            lines: 0,
            skipped: None,
        }
    }

    /// Takes the next piece and hands what it completes to `item`.
    ///
    /// # Errors
    /// When the capture is not what its format says.
    pub fn feed(&mut self, piece: &[u8], item: &mut dyn FnMut(Item)) -> Result<(), ReadError> {
        if self.format == Format::Auto {
            if piece.is_empty() {
                return Ok(());
            }
            self.format = looks_like(piece);
        }
        match self.format {
            Format::Auto | Format::Bin => self.bytes(piece, item),
            Format::Hex => {
                let mut bytes = Vec::with_capacity(piece.len() / 2);
                let result = self.hex.feed(piece, &mut bytes);
                self.bytes(&bytes, item);
                result?;
            }
            Format::Log => self.log(piece, item),
        }
        Ok(())
    }

    /// Ends the capture: what waits for more bytes gets none.
    ///
    /// # Errors
    /// When the capture is not what its format says.
    pub fn finish(&mut self, item: &mut dyn FnMut(Item)) -> Result<(), ReadError> {
        if !self.line.is_empty() {
            self.end_line(item);
        }
        while let Some(event) = self.decoder.finish() {
            report(&mut self.skipped, &event, item);
        }
        flush(&mut self.skipped, item);
        self.hex.finish()?;
        Ok(())
    }

    fn bytes(&mut self, mut bytes: &[u8], item: &mut dyn FnMut(Item)) {
        while let Some(event) = self.decoder.next(&mut bytes) {
            report(&mut self.skipped, &event, item);
        }
    }

    fn log(&mut self, piece: &[u8], item: &mut dyn FnMut(Item)) {
        for part in piece.split_inclusive(|byte| *byte == b'\n') {
            self.line.extend_from_slice(part);
            if part.ends_with(b"\n") || self.line.len() > LONGEST_LINE {
                self.end_line(item);
            }
        }
    }

    fn end_line(&mut self, item: &mut dyn FnMut(Item)) {
        self.lines += 1;
        let (at, length) = (self.lines, self.line.len());
        let text = String::from_utf8_lossy(&self.line);
        let text = text.trim();
        match log::parse(text) {
            Some(LogLine { direction, id, length, payload }) if payload.len() == length && id != 0 => {
                item(Item::Frame { at, version: None, direction, id, payload });
            }
            Some(_) => item(Item::Skipped { at, length, cause: Cause::Truncated }),
            None if text.is_empty() => {}
            None => item(Item::Skipped { at, length, cause: Cause::NoStartByte }),
        }
        self.line.clear();
    }
}

/// A log line holds at most 255 bytes of payload; more than this is no log.
const LONGEST_LINE: usize = 4096;

/// Reports frames at once, and skipped bytes as whole runs, so that the pieces in which they came do not show.
fn report(run: &mut Option<Skipped>, event: &Event<'_>, item: &mut dyn FnMut(Item)) {
    match event {
        Event::Frame { at, frame } => {
            flush(run, item);
            item(Item::Frame {
                at: *at,
                version: Some(frame.version),
                direction: None,
                id: frame.id,
                payload: frame.payload.to_vec(),
            });
        }
        Event::Skipped(skipped) => {
            if let Some(joined) = run.and_then(|run| run.join(*skipped)) {
                *run = Some(joined);
            } else {
                flush(run, item);
                *run = Some(*skipped);
            }
        }
    }
}

fn flush(run: &mut Option<Skipped>, item: &mut dyn FnMut(Item)) {
    if let Some(Skipped { at, length, cause }) = run.take() {
        item(Item::Skipped { at, length, cause });
    }
}

/// Text of hex digits and separators is hex, other text with a log line in it is a log, all else is raw.
fn looks_like(beginning: &[u8]) -> Format {
    let is_hex = |byte: &u8| byte.is_ascii_hexdigit() || byte.is_ascii_whitespace() || b"xX:,".contains(byte);
    if beginning.iter().all(is_hex) && beginning.iter().any(u8::is_ascii_hexdigit) {
        return Format::Hex;
    }
    let text = String::from_utf8_lossy(beginning);
    if text.lines().any(|line| log::parse(line.trim()).is_some()) { Format::Log } else { Format::Bin }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(format: Format, capture: &[u8], piece: usize) -> Vec<Item> {
        let (mut reader, mut items) = (Reader::new(format), Vec::new());
        for piece in capture.chunks(piece) {
            reader.feed(piece, &mut |item| items.push(item)).unwrap();
        }
        reader.finish(&mut |item| items.push(item)).unwrap();
        items
    }

    fn frame(at: u64, version: Version, id: u8, payload: &[u8]) -> Item {
        Item::Frame { at, version: Some(version), direction: None, id, payload: payload.to_vec() }
    }

    #[test]
    fn formats_are_recognised() {
        let bytes = [0x3E, 0x52, 0x01, 0x53, 0x01, 0x01];
        let expected = [frame(0, Version::V1, 82, &[1])];
        assert_eq!(read(Format::Auto, &bytes, 100), expected);
        assert_eq!(read(Format::Auto, b"3E 52 01 53 01 01", 100), expected);
        let log = read(Format::Auto, b"12:00:01 out: [82,1] 01\nnoise\n12:00:02 in: [67,2] 16", 100);
        assert_eq!(log.len(), 3);
        assert!(matches!(&log[0], Item::Frame { at: 1, direction: Some(Direction::Outgoing), id: 82, .. }));
        assert_eq!(log[1], Item::Skipped { at: 2, length: 6, cause: Cause::NoStartByte });
        assert_eq!(log[2], Item::Skipped { at: 3, length: 22, cause: Cause::Truncated });
    }

    #[test]
    fn pieces_do_not_show() {
        let capture = [
            &[9, 9, 9, 0x3E, 0x52, 0x01, 0x53, 0x01, 0x02, 7, 7][..],
            &[0x24, 0x52, 0x01, 0x53, 0x01, 0x12, 0x3D, 0x3E, 0x52],
        ]
        .concat();
        let whole = read(Format::Bin, &capture, capture.len());
        assert!(whole.contains(&frame(11, Version::V2, 82, &[1])));
        assert!(matches!(
            whole.last(),
            Some(Item::Skipped { cause: Cause::Truncated | Cause::NoStartByte, .. })
        ));
        let skipped: usize =
            whole.iter().map(|item| if let Item::Skipped { length, .. } = item { *length } else { 0 }).sum();
        assert_eq!(skipped, capture.len() - 7, "every other byte is accounted for");
        for piece in 1..capture.len() {
            assert_eq!(read(Format::Bin, &capture, piece), whole, "pieces of {piece}");
        }
    }
}
