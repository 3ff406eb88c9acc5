//! A file or a pipe in pieces, as they come.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::time::Duration;

use crate::failure::Failure;

/// The pieces of an input that a thread reads, so that waiting for the next one can end.
pub(super) struct Pieces {
    receiver: Receiver<io::Result<Vec<u8>>>,
    /// What is read, as errors name it.
    place: String,
    /// Whether bytes come in time, as through a pipe.
    is_live: bool,
}

/// What came.
pub(super) enum Piece {
    Bytes(Vec<u8>),
    /// Nothing, for the time that was allowed.
    Gap,
    End,
}

impl Pieces {
    /// Opens `path`; standard input when there is none, or for `-`.
    pub(super) fn open(path: Option<&Path>) -> Result<Self, Failure> {
        let (input, place, is_live): (Box<dyn Read + Send>, _, _) = match path {
            Some(path) if path.as_os_str() != "-" => {
                let place = path.display().to_string();
                match File::open(path) {
                    Ok(file) => {
                        let is_live = file.metadata().is_ok_and(|metadata| !metadata.is_file());
                        (Box::new(file), place, is_live)
                    }
                    Err(source) => return Err(Failure::File { place, source }),
                }
            }
            _ => (Box::new(io::stdin()), String::from("standard input"), !stdin_is_file()),
        };
        let (sender, receiver) = mpsc::sync_channel(WAITING);
        std::thread::spawn(move || read(input, &sender));
        Ok(Self { receiver, place, is_live })
    }

    /// The next piece. With a `gap`, a pipe is waited for no longer than that.
    pub(super) fn next(&self, gap: Option<Duration>) -> Result<Piece, Failure> {
        let received = match gap.filter(|_| self.is_live) {
            Some(gap) => self.receiver.recv_timeout(gap),
            None => self.receiver.recv().map_err(|_| RecvTimeoutError::Disconnected),
        };
        match received {
            Ok(Ok(bytes)) => Ok(Piece::Bytes(bytes)),
            Ok(Err(source)) => Err(Failure::File { place: self.place.clone(), source }),
            Err(RecvTimeoutError::Timeout) => Ok(Piece::Gap),
            Err(RecvTimeoutError::Disconnected) => Ok(Piece::End),
        }
    }
}

/// Pieces that may wait for the one who decodes them.
const WAITING: usize = 4;

const LONGEST_PIECE: usize = 64 * 1024;

/// Reads until the end, an error, or until nobody wants more.
fn read(mut input: Box<dyn Read + Send>, sender: &SyncSender<io::Result<Vec<u8>>>) {
    loop {
        let mut piece = vec![0; LONGEST_PIECE];
        let read = match input.read(&mut piece) {
            Ok(0) => return,
            Ok(length) => {
                piece.truncate(length);
                Ok(piece)
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => Err(error),
        };
        let failed = read.is_err();
        if sender.send(read).is_err() || failed {
            return;
        }
    }
}

/// Whether standard input is a file, whose bytes are all there already.
#[cfg(unix)]
fn stdin_is_file() -> bool {
    use std::os::fd::AsFd as _;

    let copy = io::stdin().as_fd().try_clone_to_owned();
    copy.and_then(|copy| File::from(copy).metadata()).is_ok_and(|metadata| metadata.is_file())
}

#[cfg(not(unix))]
fn stdin_is_file() -> bool {
    false
}
