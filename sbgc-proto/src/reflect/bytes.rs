//! Bytes and texts in human-readable form: hex digits, and text that can represent every byte.

use core::fmt::{self, Write as _};

use super::AssignError;

/// Displays text bytes in quotes, so that [`text_bytes`] returns the same bytes.
///
/// Non-printable characters and bytes that are not UTF-8 are escaped.
#[derive(Clone, Copy, Debug)]
pub struct Quoted<'b>(pub &'b [u8]);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('"')?;
        for chunk in self.0.utf8_chunks() {
            for character in chunk.valid().chars() {
                match character {
                    '\'' => f.write_char('\'')?,
                    character => write!(f, "{}", character.escape_debug())?,
                }
            }
            for byte in chunk.invalid() {
                write!(f, "\\x{byte:02x}")?;
            }
        }
        f.write_char('"')
    }
}

/// Displays text bytes without quotes if [`text_bytes`] understands them, otherwise like [`Quoted`].
#[derive(Clone, Copy, Debug)]
pub struct Plain<'b>(pub &'b [u8]);

impl fmt::Display for Plain<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match core::str::from_utf8(self.0) {
            // An argument of a program cannot hold a zero.
            Ok(text) if !text.starts_with('"') && !text.contains('\0') => f.write_str(text),
            _ => Quoted(self.0).fmt(f),
        }
    }
}

/// Decodes `text` for a text field to the start of `out` and returns the bytes.
///
/// Quoted text may contain escapes: `\\`, `\"`, `\n`, `\r`, `\t`, `\0`, `\x` with two hex digits for a byte, `\u{…}`
/// for a character. Any other text is used literally.
///
/// # Errors
/// If there is an unknown escape, or the bytes do not fit.
pub fn text_bytes<'o>(text: &str, out: &'o mut [u8]) -> Result<&'o [u8], AssignError> {
    let mut sink = Sink { out, length: 0, total: 0 };
    match text.strip_prefix('"').and_then(|text| text.strip_suffix('"')) {
        None => sink.put(text.as_bytes()),
        Some(quoted) => {
            let mut rest = quoted.chars();
            while let Some(character) = rest.next() {
                match character {
                    '\\' => sink.escape(&mut rest).ok_or(AssignError::Escape)?,
                    '"' => return Err(AssignError::Escape),
                    character => sink.character(character),
                }
            }
        }
    }
    sink.finish()
}

/// Decodes hex digits to the start of `out` and returns the bytes.
///
/// Whitespace, `:` and `,` may separate bytes; `-` stands for no bytes.
///
/// # Errors
/// If there are other characters, or the bytes do not fit.
pub fn hex_bytes<'o>(text: &str, out: &'o mut [u8]) -> Result<&'o [u8], AssignError> {
    let mut sink = Sink { out, length: 0, total: 0 };
    let text = text.trim();
    let text = if text == "-" { "" } else { text.strip_prefix("0x").unwrap_or(text) };
    for bytes in text.split(|character: char| character.is_whitespace() || ":,".contains(character)) {
        let (pairs, odd) = bytes.as_bytes().as_chunks::<2>();
        if !odd.is_empty() {
            return Err(AssignError::NotHex);
        }
        for [high, low] in pairs {
            let digit = |digit: u8| char::from(digit).to_digit(16).and_then(|digit| u8::try_from(digit).ok());
            match (digit(*high), digit(*low)) {
                (Some(high), Some(low)) => sink.put(&[high << 4 | low]),
                _ => return Err(AssignError::NotHex),
            }
        }
    }
    sink.finish()
}

/// Takes bytes, and counts those that do not fit.
struct Sink<'o> {
    out: &'o mut [u8],
    length: usize,
    total: usize,
}

impl<'o> Sink<'o> {
    fn put(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.total += 1;
            if let Some(place) = self.out.get_mut(self.length) {
                *place = *byte;
                self.length += 1;
            }
        }
    }

    fn character(&mut self, character: char) {
        self.put(character.encode_utf8(&mut [0; 4]).as_bytes());
    }

    fn escape(&mut self, rest: &mut core::str::Chars<'_>) -> Option<()> {
        match rest.next()? {
            'n' => self.put(b"\n"),
            'r' => self.put(b"\r"),
            't' => self.put(b"\t"),
            '0' => self.put(b"\0"),
            same @ ('\\' | '"' | '\'') => self.character(same),
            'x' => {
                let digits = rest.next()?.to_digit(16)? << 4 | rest.next()?.to_digit(16)?;
                self.put(&[u8::try_from(digits).ok()?]);
            }
            'u' => {
                let (digits, after) = rest.as_str().strip_prefix('{')?.split_once('}')?;
                self.character(char::from_u32(u32::from_str_radix(digits, 16).ok()?)?);
                *rest = after.chars();
            }
            _ => return None,
        }
        Some(())
    }

    fn finish(self) -> Result<&'o [u8], AssignError> {
        let Sink { out, length, total } = self;
        if total > length {
            return Err(AssignError::Length { expected: out.len(), got: total });
        }
        Ok(out.get(..length).unwrap_or_default())
    }
}
