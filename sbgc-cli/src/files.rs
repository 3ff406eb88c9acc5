//! Files that commands read and write as a whole.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::text;

/// More is not for a board.
const MOST: usize = 16 << 20;

/// The bytes of a file; of standard input for `-`.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let read = if path.as_os_str() == "-" { limited(io::stdin().lock()) } else { open(path) };
    read.map_err(|source| failure(path, source))
}

/// The text of a file; of standard input for `-`.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    String::from_utf8(read(path)?).map_err(|error| {
        let valid = error.as_bytes().get(..error.utf8_error().valid_up_to()).unwrap_or_default();
        let line = valid.split(|byte| *byte == b'\n').count();
        Failure::Usage(format!("{}:{line}: not UTF-8 text", text::escape(&path.display().to_string())))
    })
}

fn open(path: &Path) -> io::Result<Vec<u8>> {
    limited(File::open(path)?)
}

/// All bytes, unless they are more than anything for a board has: a device may have no end.
fn limited(reader: impl io::Read) -> io::Result<Vec<u8>> {
    let mut data = Vec::new();
    reader.take(MOST as u64 + 1).read_to_end(&mut data)?;
    if data.len() > MOST {
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, "larger than 16 MiB"));
    }
    Ok(data)
}

/// Writes a file beside its place and moves it there, so that one that was there is replaced by a whole one or not at
/// all. What is not a regular file is written to as it is.
pub(crate) fn write(path: &Path, data: &[u8]) -> Result<(), Failure> {
    let special = path.metadata().is_ok_and(|metadata| !metadata.is_file());
    let written = if special { std::fs::write(path, data) } else { replace(path, data) };
    written.map_err(|source| failure(path, source))
}

fn replace(path: &Path, data: &[u8]) -> io::Result<()> {
    // A link stays one, and what it leads to is replaced.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.new", std::process::id()));
    let new: PathBuf = path.with_file_name(name);
    let mut file = File::create_new(&new)?;
    // Who may read the old one may read the new one, and nobody else.
    if let Ok(old) = path.metadata() {
        let _ = file.set_permissions(old.permissions());
    }
    let written = file.write_all(data).and_then(|()| file.sync_all());
    let moved = written.and_then(|()| std::fs::rename(&new, &path));
    moved.inspect_err(|_| drop(std::fs::remove_file(&new)))
}

fn failure(path: &Path, source: io::Error) -> Failure {
    Failure::File { place: text::escape(&path.display().to_string()).into_owned(), source }
}
