//! The board on a pseudo-terminal.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::os::unix::fs::{OpenOptionsExt, symlink};
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::fs::OFlags;
use rustix::termios::ioctl_tiocnxcl;
use tokio::time::{Instant, interval};
use tokio_serial::{SerialPort, SerialStream};

use super::{Board, serve};

/// How often a lock is lifted that a host may have left behind.
const UNLOCK: Duration = Duration::from_millis(200);

/// A pseudo-terminal that a board can be served on.
///
/// It is there as long as this is, whoever opens and closes it; what is sent while nobody has it open waits, up to the
/// few thousand bytes that the system keeps.
#[derive(Debug)]
pub struct Pty {
    master: SerialStream,
    /// Keeps the other side open, so that neither the settings are lost nor reading fails when a host closes it.
    slave: File,
    path: PathBuf,
    link: Option<Link>,
}

impl Pty {
    /// Opens a pseudo-terminal, and lets `link` point to it if there is one. The link goes when this goes.
    ///
    /// # Errors
    /// When the system has no more pseudo-terminals, or `link` is there already and not a link that was left over from
    /// one: then it is not touched.
    ///
    /// # Panics
    /// Outside of a tokio runtime, as all of tokio's input and output does.
    pub fn open(link: Option<&Path>) -> io::Result<Self> {
        let (master, slave) = SerialStream::pair()?;
        let path = slave.name().map(PathBuf::from).ok_or(io::ErrorKind::Unsupported)?;
        let no_controlling_terminal = i32::try_from(OFlags::NOCTTY.bits()).map_err(io::Error::other)?;
        let kept =
            OpenOptions::new().read(true).write(true).custom_flags(no_controlling_terminal).open(&path)?;
        drop(slave);
        let link = link.map(|link| Link::new(link, &path)).transpose()?;
        Ok(Self { master, slave: kept, path, link })
    }

    /// The device that a host opens.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The link to it.
    pub fn link(&self) -> Option<&Path> {
        self.link.as_ref().map(|link| link.0.as_path())
    }

    /// Serves `board` on it, until the terminal fails or this is cancelled.
    ///
    /// # Errors
    /// When the terminal fails.
    pub async fn serve(&mut self, board: &mut Board) -> io::Result<()> {
        let mut unlock = interval(UNLOCK);
        let slave = &self.slave;
        let unlocking = async {
            loop {
                unlock.tick().await;
                // A host that was killed leaves the terminal locked, and only its last closing would lift that.
                let _ = ioctl_tiocnxcl(slave);
            }
        };
        tokio::select! {
            served = serve(board, Instant::now(), &mut self.master) => served.map(drop),
            () = unlocking => Ok(()),
        }
    }
}

/// A symbolic link that is removed with this.
#[derive(Debug)]
struct Link(PathBuf, PathBuf);

impl Link {
    fn new(link: &Path, target: &Path) -> io::Result<Self> {
        if fs::symlink_metadata(link).is_ok() {
            if !is_stale(link) {
                let message = "there is something already that is no link to a terminal; move it away first";
                return Err(io::Error::new(io::ErrorKind::AlreadyExists, message));
            }
            fs::remove_file(link)?;
        }
        symlink(target, link)?;
        Ok(Self(link.to_path_buf(), target.to_path_buf()))
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        // Somebody else may have taken it over.
        if fs::read_link(&self.0).is_ok_and(|target| target == self.1) {
            let _ = fs::remove_file(&self.0);
        }
    }
}

/// Whether this is a link to a pseudo-terminal, or to a device that is gone, as an earlier board may have left it.
fn is_stale(link: &Path) -> bool {
    let Ok(target) = fs::read_link(link) else { return false };
    let is_pty = ["/dev/pts", "/dev/ttys"]
        .iter()
        .any(|place| target.to_str().is_some_and(|target| target.starts_with(place)));
    is_pty || (target.starts_with("/dev") && fs::metadata(link).is_err())
}
