//! Files that commands read and write as a whole.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::text;

/// More is not for a board.
const MOST: u64 = 16 << 20;

/// The bytes of a file; of standard input for `-`.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut data = Vec::new();
    let read = if path.as_os_str() == "-" {
        io::stdin().lock().take(MOST).read_to_end(&mut data)
    } else {
        File::open(path).and_then(|file| file.take(MOST).read_to_end(&mut data))
    };
    read.map(|_| data).map_err(|source| failure(path, source))
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
    let written = file.write_all(data).and_then(|()| file.sync_all());
    let moved = written.and_then(|()| std::fs::rename(&new, &path));
    moved.inspect_err(|_| drop(std::fs::remove_file(&new)))
}

fn failure(path: &Path, source: io::Error) -> Failure {
    Failure::File { place: text::escape(&path.display().to_string()).into_owned(), source }
}
