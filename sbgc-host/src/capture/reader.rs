//! Captures of any format to frames.

use std::time::Duration;

use sbgc_proto::Direction;
use sbgc_proto::frame::{Cause, Decoder, Event, Skipped, Version, Versions};
use thiserror::Error;

use super::hex::{BOM, HexError, HexReader};
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
pub enum Captured {
    /// A frame.
    Frame {
        /// Offset of its first byte; in a log the number of the line, from 1 on.
        at: u64,
        /// When it passed, where a log says; counted from whatever the log counts from.
        time: Option<Duration>,
        /// Version of its framing; the logs of others do not say.
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
    beginning: Beginning,
    decoder: Decoder,
    hex: HexReader,
    line: Vec<u8>,
    /// Bytes of the present line, of which `line` keeps no more than a log can have.
    line_length: usize,
    lines: u64,
    skipped: Option<Skipped>,
}

impl Reader {
    /// Reads captures of `format`.
    pub fn new(format: Format) -> Self {
        Reader {
            format,
            beginning: Beginning::default(),
            decoder: Decoder::new(Versions::Both),
            hex: HexReader::default(),
            line: Vec::new(),
            line_length: 0,
            lines: 0,
            skipped: None,
        }
    }

    /// Takes the next piece and hands what it completes to `item`.
    ///
    /// # Errors
    /// When the capture is not what its format says.
    pub fn feed(&mut self, piece: &[u8], item: &mut dyn FnMut(Captured)) -> Result<(), ReadError> {
        if self.format != Format::Auto {
            return self.read(piece, item);
        }
        match self.beginning.feed(piece) {
            Some(format) => self.begin(format, item),
            None => Ok(()),
        }
    }

    /// The format is known: what waited for that is read.
    fn begin(&mut self, format: Format, item: &mut dyn FnMut(Captured)) -> Result<(), ReadError> {
        self.format = format;
        let beginning = std::mem::take(&mut self.beginning);
        self.read(&beginning.seen, item)
    }

    fn read(&mut self, piece: &[u8], item: &mut dyn FnMut(Captured)) -> Result<(), ReadError> {
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

    /// After so long without bytes from a pipe that is still open, [`idle`](Self::idle) should be called: the gap that
    /// ends a false start of a frame.
    pub const GAP: Duration = Duration::from_millis(100);

    /// Whether bytes wait for more, because they may be the beginning of a frame.
    pub fn is_waiting(&self) -> bool {
        self.decoder.pending() > 0
    }

    /// Reports the frames behind a false start whose bytes have stopped coming.
    ///
    /// A beginning with no whole frame behind it goes on waiting, so that a frame that comes slowly stays whole.
    pub fn idle(&mut self, item: &mut dyn FnMut(Captured)) {
        while holds_frame(self.decoder.clone()) {
            loop {
                let event = match self.decoder.next(&mut &[][..]) {
                    Some(event) => event,
                    None => match self.decoder.skip_candidate() {
                        Some(skipped) => Event::Skipped(skipped),
                        None => return,
                    },
                };
                report(&mut self.skipped, &event, item);
                if matches!(event, Event::Frame { .. }) {
                    break;
                }
            }
        }
    }

    /// Ends the capture: what waits for more bytes gets none.
    ///
    /// # Errors
    /// When the capture is not what its format says.
    pub fn finish(&mut self, item: &mut dyn FnMut(Captured)) -> Result<(), ReadError> {
        if self.format == Format::Auto {
            let format = self.beginning.at_end();
            self.begin(format, item)?;
        }
        if self.line_length > 0 {
            self.end_line(item);
        }
        while let Some(event) = self.decoder.finish() {
            report(&mut self.skipped, &event, item);
        }
        flush(&mut self.skipped, item);
        self.hex.finish()?;
        Ok(())
    }

    fn bytes(&mut self, mut bytes: &[u8], item: &mut dyn FnMut(Captured)) {
        while let Some(event) = self.decoder.next(&mut bytes) {
            report(&mut self.skipped, &event, item);
        }
    }

    fn log(&mut self, piece: &[u8], item: &mut dyn FnMut(Captured)) {
        for part in piece.split_inclusive(|byte| *byte == b'\n') {
            self.line_length += part.len();
            let room = LONGEST_LINE.saturating_sub(self.line.len());
            self.line.extend_from_slice(part.get(..room).unwrap_or(part));
            if part.ends_with(b"\n") {
                self.end_line(item);
            }
        }
    }

    fn end_line(&mut self, item: &mut dyn FnMut(Captured)) {
        self.lines += 1;
        let (at, length) = (self.lines, std::mem::take(&mut self.line_length));
        let whole = length == self.line.len();
        let text = String::from_utf8_lossy(&self.line);
        let text = text.trim();
        match log::parse(text).filter(|_| whole) {
            Some(LogLine { time, version, direction, id, length, payload })
                if payload.len() == length && id != 0 =>
            {
                item(Captured::Frame { at, time, version, direction, id, payload });
            }
            Some(_) => item(Captured::Skipped { at, length, cause: Cause::Truncated }),
            None if whole && text.is_empty() => {}
            None => item(Captured::Skipped { at, length, cause: Cause::NoStartByte }),
        }
        self.line.clear();
    }
}

/// Whether a whole frame waits behind a false start.
fn holds_frame(mut decoder: Decoder) -> bool {
    loop {
        match decoder.next(&mut &[][..]) {
            Some(Event::Frame { .. }) => return true,
            Some(Event::Skipped(_)) => {}
            None => {
                if decoder.skip_candidate().is_none() {
                    return false;
                }
            }
        }
    }
}

/// A log line holds at most 255 bytes of payload; more than this is no log.
const LONGEST_LINE: usize = 4096;

/// Reports frames at once, and skipped bytes as whole runs, so that the pieces in which they came do not show.
fn report(run: &mut Option<Skipped>, event: &Event<'_>, item: &mut dyn FnMut(Captured)) {
    match event {
        Event::Frame { at, frame } => {
            flush(run, item);
            item(Captured::Frame {
                at: *at,
                time: None,
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

fn flush(run: &mut Option<Skipped>, item: &mut dyn FnMut(Captured)) {
    if let Some(Skipped { at, length, cause }) = run.take() {
        item(Captured::Skipped { at, length, cause });
    }
}

/// The beginning of a capture whose format is not known yet.
///
/// It is judged byte by byte, so that the pieces in which it comes do not matter, and as soon as it can be, so that
/// what comes through a pipe is shown at once:
/// - a line of a log makes it a log;
/// - as many hex digits as the shortest frame has, or a line of them, and nothing but separators between, make it hex;
/// - a control character, of which every frame has some, makes it raw; so does text that goes on and is none of these.
#[derive(Debug, Default)]
struct Beginning {
    seen: Vec<u8>,
    line_start: usize,
    digits: usize,
    not_hex: bool,
}

/// Hex digits of the shortest frame.
const HEX_DIGITS: usize = 10;

/// So much is looked at.
const LONGEST_BEGINNING: usize = 4096;

impl Beginning {
    /// Takes the next piece; the format, as soon as it is clear.
    fn feed(&mut self, piece: &[u8]) -> Option<Format> {
        let judged = self.seen.len();
        self.seen.extend_from_slice(piece);
        (judged..self.seen.len()).find_map(|at| self.judge(at))
    }

    fn judge(&mut self, at: usize) -> Option<Format> {
        let byte = *self.seen.get(at)?;
        let separates = byte.is_ascii_whitespace() || b"xX:,".contains(&byte) || BOM.get(at) == Some(&byte);
        self.digits += usize::from(byte.is_ascii_hexdigit());
        self.not_hex |= !separates && !byte.is_ascii_hexdigit();
        if byte == b'\n' {
            let line = self.seen.get(self.line_start..at).unwrap_or_default();
            if is_log_line(line) {
                return Some(Format::Log);
            }
            self.line_start = at + 1;
        }
        if !self.not_hex && (self.digits >= HEX_DIGITS || (byte == b'\n' && self.digits > 0)) {
            return Some(Format::Hex);
        }
        let control = byte.is_ascii_control() && !byte.is_ascii_whitespace();
        (control || at >= LONGEST_BEGINNING).then_some(Format::Bin)
    }

    /// Nothing more comes.
    fn at_end(&self) -> Format {
        if is_log_line(self.seen.get(self.line_start..).unwrap_or_default()) {
            Format::Log
        } else if !self.not_hex && self.digits > 0 {
            Format::Hex
        } else {
            Format::Bin
        }
    }
}

fn is_log_line(line: &[u8]) -> bool {
    log::parse(String::from_utf8_lossy(line).trim()).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(format: Format, capture: &[u8], piece: usize) -> Vec<Captured> {
        let (mut reader, mut items) = (Reader::new(format), Vec::new());
        for piece in capture.chunks(piece) {
            reader.feed(piece, &mut |item| items.push(item)).unwrap();
        }
        reader.finish(&mut |item| items.push(item)).unwrap();
        items
    }

    fn frame(at: u64, version: Version, id: u8, payload: &[u8]) -> Captured {
        Captured::Frame {
            at,
            time: None,
            version: Some(version),
            direction: None,
            id,
            payload: payload.to_vec(),
        }
    }

    #[test]
    fn formats_are_recognised() {
        let bytes = [0x3E, 0x52, 0x01, 0x53, 0x01, 0x01];
        let expected = [frame(0, Version::V1, 82, &[1])];
        assert_eq!(read(Format::Auto, &bytes, 100), expected);
        assert_eq!(read(Format::Auto, b"3E 52 01 53 01 01", 100), expected);
        let log = read(Format::Auto, b"12:00:01 out: [82,1] 01\nnoise\n12:00:02 in: [67,2] 16", 100);
        assert_eq!(log.len(), 3);
        assert!(matches!(
            &log[0],
            Captured::Frame { at: 1, direction: Some(Direction::Outgoing), id: 82, .. }
        ));
        assert_eq!(log[1], Captured::Skipped { at: 2, length: 6, cause: Cause::NoStartByte });
        assert_eq!(log[2], Captured::Skipped { at: 3, length: 22, cause: Cause::Truncated });
    }

    #[test]
    fn formats_are_recognised_in_whatever_pieces_they_come() {
        let bytes = [0x41, 0x3E, 0x52, 0x01, 0x53, 0x01, 0x01];
        for capture in [
            &bytes[..],
            b"3",
            b"3E 52 01 53 01 01",
            b"0x3E, 0x52,\n 0x01, 0x53, 0x01, 0x01",
            b"\xEF\xBB\xBFdebug log\r\n12:00:01 out: [82,1] 01\r\n\r\n12:00:01.5 in: [67,2] 5D FF\r\n",
            b"12:00:01 out: [82,1] 01",
            b"123456789 port1.in: [82,1] 01\n",
            b"just text\n",
            b"",
        ] {
            let collect = |piece: usize| {
                let (mut reader, mut items) = (Reader::new(Format::Auto), Vec::new());
                let mut results: Vec<_> = capture
                    .chunks(piece)
                    .map(|piece| reader.feed(piece, &mut |item| items.push(item)))
                    .collect();
                results.push(reader.finish(&mut |item| items.push(item)));
                (reader.format, items, results.pop())
            };
            let whole = collect(1000);
            for piece in 1..capture.len() {
                assert_eq!(collect(piece), whole, "{capture:?} in pieces of {piece}");
            }
        }
    }

    #[test]
    fn live_captures_are_shown_as_they_come() {
        let first = |capture: &[u8]| {
            let mut items = Vec::new();
            Reader::new(Format::Auto).feed(capture, &mut |item| items.push(item)).unwrap();
            items.len()
        };
        assert_eq!(first(b"3E 56 00 56 00"), 1);
        assert_eq!(first(&[0x3E, 0x56, 0x00, 0x56, 0x00]), 1);
        assert_eq!(first(b"12:00:01 out: [82,1] 01\n"), 1);
    }

    #[test]
    fn frames_behind_a_false_start_are_shown_after_a_gap() {
        let (mut reader, mut items) = (Reader::new(Format::Bin), Vec::new());
        // A start that announces 200 bytes, a frame, and half of another.
        let capture = [0x24, 0x20, 0xC8, 0xE8, 0x3E, 0x52, 0x01, 0x53, 0x01, 0x01, 0x3E, 0x52, 0x01];
        reader.feed(&capture, &mut |item| items.push(item)).unwrap();
        assert!(items.is_empty() && reader.is_waiting());
        reader.idle(&mut |item| items.push(item));
        assert_eq!(items.last(), Some(&frame(4, Version::V1, 82, &[1])));
        // The half stays whole however long it takes.
        items.clear();
        for byte in [0x53, 0x02, 0x02] {
            reader.idle(&mut |item| items.push(item));
            assert!(items.is_empty() && reader.is_waiting());
            reader.feed(&[byte], &mut |item| items.push(item)).unwrap();
        }
        assert_eq!(items, [frame(10, Version::V1, 82, &[2])]);
    }

    #[test]
    fn a_line_that_is_too_long_for_a_log_is_one_line() {
        let mut capture = vec![b'a'; 100_000];
        capture.extend_from_slice(b"\n1 in: [67,2] 5D FF\n");
        for piece in [1000, 4096, 65_536, 200_000] {
            let items = read(Format::Log, &capture, piece);
            assert_eq!(items[0], Captured::Skipped { at: 1, length: 100_001, cause: Cause::NoStartByte });
            assert!(matches!(&items[1], Captured::Frame { at: 2, id: 67, .. }), "{items:?}");
        }
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
            Some(Captured::Skipped { cause: Cause::Truncated | Cause::NoStartByte, .. })
        ));
        let skipped: usize = whole
            .iter()
            .map(|item| if let Captured::Skipped { length, .. } = item { *length } else { 0 })
            .sum();
        assert_eq!(skipped, capture.len() - 7, "every other byte is accounted for");
        for piece in 1..capture.len() {
            assert_eq!(read(Format::Bin, &capture, piece), whole, "pieces of {piece}");
        }
    }
}
