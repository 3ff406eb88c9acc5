//! A file that keeps the state of a board: its EEPROM, with parameters, files and calibrations.
//!
//! It is replaced as a whole (written beside, synchronized, renamed), so that a program that is killed leaves the old
//! or the new state. While it is in use it is locked.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::Board;
use super::config::Config;

/// What a state file begins with.
const MAGIC: [u8; 8] = *b"SBGCSIM1";

/// The bytes before the image: what it begins with, sum, length.
const HEADER: usize = 16;

/// No state is larger.
const MOST: u64 = 1 << 20;

/// The state of a simulated board in a file.
#[derive(Debug)]
pub struct StateFile {
    path: PathBuf,
    /// The file as it is now, locked.
    file: File,
    /// The change of the board's EEPROM that it holds.
    saved: u64,
}

impl StateFile {
    /// Opens the state of a board, and gives the board with it. A file that does not exist is made.
    ///
    /// ```
    /// # use sbgc_host::sim::{Config, StateFile};
    /// # let directory = std::env::temp_dir().join(format!("sbgc-doc-{}", std::process::id()));
    /// # std::fs::create_dir_all(&directory)?;
    /// let path = directory.join("gimbal.state");
    /// let (state, board) = StateFile::open(&path, &Config::default())?;
    /// assert!(path.exists() && StateFile::open(&path, &Config::default()).is_err(), "it is in use");
    /// # drop((state, board));
    /// # std::fs::remove_dir_all(directory)?;
    /// # Ok::<(), std::io::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the file is in use, is not a state, is damaged, or cannot be read or made. It is left alone then.
    pub fn open(path: &Path, config: &Config) -> io::Result<(Self, Board)> {
        // A link is followed, so that what it leads to is replaced and not the link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        loop {
            // A pipe would be waited for, and a device may have no end.
            if path.metadata().is_ok_and(|found| !found.is_file()) {
                return Err(damaged());
            }
            match File::open(&path) {
                Ok(mut file) => {
                    lock(&file)?;
                    if !is_at(&file, &path) {
                        // It was replaced before it was locked.
                        continue;
                    }
                    let image = image(&mut file)?;
                    remove_leftovers(&path);
                    let board = Board::with_eeprom(config.clone(), image).ok_or_else(damaged)?;
                    let saved = board.eeprom_changes();
                    return Ok((Self { path, file, saved }, board));
                }
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    let board = Board::new(config.clone());
                    let beside = beside(&path);
                    let file = write(&beside, board.eeprom())?;
                    // Unlike renaming this fails if somebody else has made it meanwhile.
                    let linked = fs::hard_link(&beside, &path);
                    let _ = fs::remove_file(&beside);
                    match linked {
                        Ok(()) => {
                            sync_directory(&path)?;
                            let saved = board.eeprom_changes();
                            return Ok((Self { path, file, saved }, board));
                        }
                        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                        Err(error) => return Err(error),
                    }
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Saves what has changed; true if something had.
    ///
    /// # Errors
    /// If the file cannot be replaced. The old one is still there then.
    pub fn save(&mut self, board: &Board) -> io::Result<bool> {
        if board.eeprom_changes() == self.saved {
            return Ok(false);
        }
        let beside = beside(&self.path);
        let file = write(&beside, board.eeprom())?;
        fs::rename(&beside, &self.path)?;
        sync_directory(&self.path)?;
        self.file = file;
        self.saved = board.eeprom_changes();
        Ok(true)
    }
}

/// Where the new file is written.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(format!(".new-{}", std::process::id()));
    name.into()
}

/// Removes what programs that were killed have left beside the file, which is locked: nobody else writes there now.
fn remove_leftovers(path: &Path) {
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let (Ok(entries), Some(name)) = (fs::read_dir(directory.unwrap_or(Path::new("."))), path.file_name())
    else {
        return;
    };
    for entry in entries.flatten() {
        let other = entry.file_name();
        let rest = other.as_encoded_bytes().strip_prefix(name.as_encoded_bytes());
        let number = rest.and_then(|rest| rest.strip_prefix(b".new-"));
        if number.is_some_and(|number| !number.is_empty() && number.iter().all(u8::is_ascii_digit)) {
            // What stays does no harm.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Writes a whole state, to the disk, and locks it before anybody sees it.
fn write(path: &Path, image: &[u8]) -> io::Result<File> {
    let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(true).open(path)?;
    file.write_all(&content(image))?;
    file.sync_all()?;
    lock(&file)?;
    Ok(file)
}

fn content(image: &[u8]) -> Vec<u8> {
    let length = u32::try_from(image.len()).unwrap_or(u32::MAX).to_le_bytes();
    let sum = sum(image).to_le_bytes();
    [&MAGIC[..], &sum, &length, image].concat()
}

/// A sum over the image that no single damage leaves as it is (FNV-1a).
fn sum(image: &[u8]) -> u32 {
    image.iter().fold(0x811C_9DC5, |sum, byte| (sum ^ u32::from(*byte)).wrapping_mul(0x0100_0193))
}

/// The image in a state file.
fn image(file: &mut File) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(MOST).read_to_end(&mut bytes)?;
    let (header, image) = bytes.split_at_checked(HEADER).ok_or_else(damaged)?;
    if content(image).get(..HEADER) == Some(header) { Ok(image.to_vec()) } else { Err(damaged()) }
}

fn damaged() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidData,
        "not a state of a simulated board, or damaged; move it away to start with a new one",
    )
}

fn lock(file: &File) -> io::Result<()> {
    file.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => {
            io::Error::new(io::ErrorKind::ResourceBusy, "in use by another simulated board")
        }
        TryLockError::Error(error) => error,
    })
}

/// Whether this is the file that is at the path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    match (file.metadata(), fs::metadata(path)) {
        (Ok(open), Ok(there)) => identity(open) == identity(there),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    // A file that is open cannot be replaced there.
    true
}

/// Makes sure that the name of a file is on the disk, too.
fn sync_directory(path: &Path) -> io::Result<()> {
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    if cfg!(unix) { File::open(directory.unwrap_or(Path::new(".")))?.sync_all() } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    struct Directory(PathBuf);

    impl Directory {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("sbgc-{name}-{}", std::process::id()));
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn state(&self) -> PathBuf {
            self.0.join("state")
        }
    }

    impl Drop for Directory {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    /// Changes the profile, which is kept in the EEPROM.
    fn use_profile(board: &mut Board, number: u8) {
        let now = Duration::from_secs(u64::from(number));
        board.receive(now, &[0x3E, 69, 1, 70, number, number]);
        board.advance(now + Duration::from_millis(8));
    }

    #[test]
    fn what_was_saved_is_there_again() {
        let directory = Directory::new("kept");
        let (mut state, mut board) = StateFile::open(&directory.state(), &Config::default()).unwrap();
        assert!(!state.save(&board).unwrap());
        use_profile(&mut board, 3);
        assert!(state.save(&board).unwrap());
        let kept = board.eeprom().to_vec();
        let busy = StateFile::open(&directory.state(), &Config::default()).unwrap_err();
        assert_eq!(busy.kind(), io::ErrorKind::ResourceBusy);
        drop(state);
        let (_, board) = StateFile::open(&directory.state(), &Config::default()).unwrap();
        assert_eq!(board.eeprom(), kept);
        assert_eq!(fs::read_dir(&directory.0).unwrap().count(), 1, "nothing is left beside it");
    }

    /// One of these has no end.
    #[test]
    #[cfg(unix)]
    fn what_is_not_a_file_is_refused() {
        for place in ["/dev/zero", "/dev/full", "/"] {
            let error = StateFile::open(Path::new(place), &Config::default()).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::InvalidData, "{place}: {error}");
        }
    }

    #[test]
    fn what_is_damaged_is_refused_and_left_alone() {
        let directory = Directory::new("damaged");
        drop(StateFile::open(&directory.state(), &Config::default()).unwrap());
        let good = fs::read(directory.state()).unwrap();
        let mut flipped = good.clone();
        flipped[5000] ^= 1;
        for bad in [&[][..], b"text", &good[..good.len() - 1], &good[..HEADER], &flipped] {
            fs::write(directory.state(), bad).unwrap();
            let error = StateFile::open(&directory.state(), &Config::default()).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::InvalidData, "{error}");
            assert_eq!(fs::read(directory.state()).unwrap(), bad);
        }
    }

    #[test]
    fn a_kill_while_saving_leaves_the_old_state_or_the_new_one() {
        let directory = Directory::new("killed");
        let (mut state, mut board) = StateFile::open(&directory.state(), &Config::default()).unwrap();
        let old = fs::read(directory.state()).unwrap();
        use_profile(&mut board, 2);
        let new = content(board.eeprom());
        // Up to the rename only the file beside it changes, however far it has come.
        for written in (0..new.len()).step_by(997).chain([new.len()]) {
            fs::write(beside(&directory.state()), &new[..written]).unwrap();
            assert_eq!(fs::read(directory.state()).unwrap(), old);
        }
        state.save(&board).unwrap();
        assert_eq!(fs::read(directory.state()).unwrap(), new);
        drop(state);
        // What a killed program has left is removed, and nothing else.
        for beside in ["state.new-1", "state.new-4000000000", "state.new-", "state.newer", "other.new-1"] {
            fs::write(directory.0.join(beside), b"half").unwrap();
        }
        StateFile::open(&directory.state(), &Config::default()).unwrap();
        let mut left: Vec<_> =
            fs::read_dir(&directory.0).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        left.sort();
        assert_eq!(left, ["other.new-1", "state", "state.new-", "state.newer"]);
    }
}
