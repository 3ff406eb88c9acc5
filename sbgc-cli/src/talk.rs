//! Standard error: questions, progress, hints and errors.
//!
//! Whether somebody can read it changes nothing: it may be closed, or full.

use std::fmt::Display;
use std::io::{self, Write};

/// Prints a line.
pub(crate) fn say(text: impl Display) {
    print(format_args!("{text}\n"));
}

/// Prints text as it is, such as a question that is answered on the same line.
pub(crate) fn print(text: impl Display) {
    // In one piece, so that lines of several writers do not mix.
    let _ = Talk.write_all(text.to_string().as_bytes());
}

/// Standard error as a writer that never fails.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Talk;

impl Write for Talk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let _ = io::stderr().lock().write_all(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
