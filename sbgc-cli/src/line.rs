//! A line of output while it is put together: numbers, hex and JSON without a detour.

use std::fmt::{self, Display, Write as _};
use std::io;
use std::ops::Range;

use serde::Serialize as _;

use crate::text::ForTerminals;

/// Bytes of UTF-8 that grow at the end and are used again.
#[derive(Debug, Default)]
pub(crate) struct Line(Vec<u8>);

impl Line {
    pub(crate) fn as_bytes(&self) -> &[u8] {
        &self.0
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    pub(crate) fn into_text(self) -> String {
        String::from_utf8(self.0).unwrap_or_default()
    }

    pub(crate) fn push(&mut self, text: &str) {
        self.0.extend_from_slice(text.as_bytes());
    }

    /// Appends what `shown` shows.
    pub(crate) fn show(&mut self, shown: impl Display) {
        // A vector takes everything.
        let _ = write!(self, "{shown}");
    }

    pub(crate) fn integer(&mut self, number: impl itoa::Integer) {
        self.push(itoa::Buffer::new().format(number));
    }

    /// Appends bytes as hex digits.
    pub(crate) fn hex(&mut self, bytes: &[u8]) {
        let digit = |value: u8| if value < 10 { b'0' + value } else { b'a' - 10 + value };
        self.0.extend(bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]));
    }

    /// Appends a number as JSON has it; `null` for one that JSON does not have.
    pub(crate) fn json_number(&mut self, number: f64) {
        if serde_json::to_writer(&mut *self, &number).is_err() {
            self.push("null");
        }
    }

    /// Appends a string of JSON.
    pub(crate) fn json_text(&mut self, text: &str) {
        // A vector takes everything.
        let _ = text.serialize(&mut serde_json::Serializer::with_formatter(self, ForTerminals));
    }

    /// Appends a name, which needs no escapes, as a string of JSON; `null` for none.
    pub(crate) fn json_name(&mut self, name: Option<&str>) {
        match name {
            Some(name) => {
                self.push("\"");
                self.push(name);
                self.push("\"");
            }
            None => self.push("null"),
        }
    }

    /// Appends once more what is in the line at `range`.
    pub(crate) fn repeat(&mut self, range: Range<usize>) {
        if range.end <= self.0.len() {
            self.0.extend_from_within(range);
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }
}

impl fmt::Write for Line {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.push(text);
        Ok(())
    }
}

impl io::Write for Line {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
