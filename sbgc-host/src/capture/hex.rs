//! Hex digits to bytes, in whatever way people write them down.

use thiserror::Error;

/// A character that does not belong into a hex dump.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum HexError {
    /// Neither a hex digit nor a separator.
    #[error(
        "line {line}, column {column}: {found:?} is not a hex digit; bytes are two digits each, with white space, `0x`, `:` or `,` between them"
    )]
    NoDigit {
        /// Line, from 1 on.
        line: usize,
        /// Column, from 1 on.
        column: usize,
        /// What stands there.
        found: char,
    },
    /// A byte of one digit.
    #[error("line {line}, column {column}: a byte has two hex digits, here is one")]
    HalfByte {
        /// Line, from 1 on.
        line: usize,
        /// Column after the digit, from 1 on.
        column: usize,
    },
}

/// The byte order mark of UTF-8.
pub(super) const BOM: [u8; 3] = [0xEF, 0xBB, 0xBF];

/// Reads a hex dump piece by piece.
#[derive(Clone, Debug)]
pub(crate) struct HexReader {
    half: Option<u8>,
    line: usize,
    column: usize,
}

impl Default for HexReader {
    fn default() -> Self {
        HexReader { half: None, line: 1, column: 0 }
    }
}

impl HexReader {
    /// Appends the bytes that `text` holds to `bytes`.
    pub(crate) fn feed(&mut self, text: &[u8], bytes: &mut Vec<u8>) -> Result<(), HexError> {
        for character in text {
            self.column += 1;
            // Some editors mark text as UTF-8 in front.
            if self.line == 1 && BOM.get(self.column - 1) == Some(character) {
                continue;
            }
            self.next(*character, bytes)?;
            if *character == b'\n' {
                self.line += 1;
                self.column = 0;
            }
        }
        Ok(())
    }

    /// Nothing more follows.
    pub(crate) fn finish(&self) -> Result<(), HexError> {
        match self.half {
            Some(_) => Err(HexError::HalfByte { line: self.line, column: self.column + 1 }),
            None => Ok(()),
        }
    }

    fn next(&mut self, character: u8, bytes: &mut Vec<u8>) -> Result<(), HexError> {
        let digit = char::from(character).to_digit(16).and_then(|digit| u8::try_from(digit).ok());
        match (digit, self.half) {
            (Some(low), Some(high)) => {
                bytes.push(high << 4 | low);
                self.half = None;
            }
            (Some(high), None) => self.half = Some(high),
            (None, Some(0)) if matches!(character, b'x' | b'X') => self.half = None,
            (None, half) if character.is_ascii_whitespace() || matches!(character, b':' | b',') => {
                if half.is_some() {
                    return Err(HexError::HalfByte { line: self.line, column: self.column });
                }
            }
            (None, _) => {
                let found = char::from(character);
                return Err(HexError::NoDigit { line: self.line, column: self.column, found });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<u8>, HexError> {
        let (mut reader, mut bytes) = (HexReader::default(), Vec::new());
        // A character at a time, as the worst pipe would bring it.
        text.as_bytes().chunks(1).try_for_each(|piece| reader.feed(piece, &mut bytes))?;
        reader.finish().map(|()| bytes)
    }

    #[test]
    fn bytes_are_found_however_they_are_written() {
        for text in ["3E 52 01", "3e5201", "0x3E,0x52,0x01", "3E:52:01\n", "0x3e 0X52\t01\r\n"] {
            assert_eq!(read(text), Ok(vec![0x3E, 0x52, 0x01]), "{text:?}");
        }
        assert_eq!(read("00 0x00"), Ok(vec![0, 0]));
        assert_eq!(read("\u{FEFF}3E 52"), Ok(vec![0x3E, 0x52]));
        assert!(read("3E \u{FEFF}52").is_err());
    }

    #[test]
    fn errors_name_the_place() {
        assert_eq!(read("3E 5"), Err(HexError::HalfByte { line: 1, column: 5 }));
        assert_eq!(read("3E\n5 2"), Err(HexError::HalfByte { line: 2, column: 2 }));
        assert_eq!(read("3E\n52 zz"), Err(HexError::NoDigit { line: 2, column: 4, found: 'z' }));
    }
}
