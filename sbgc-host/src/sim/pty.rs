//! The board on a pseudo-terminal.
//!
//! The other side is held open here, so that the settings are not lost and reading does not fail when a host closes
//! it. The kernel then never drops what nobody reads; so who comes and who goes is watched, and what was meant for
//! the one before is thrown away. Whether a host has the bit rate of the board is seen in the settings.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::os::unix::fs::{OpenOptionsExt, symlink};
use std::path::{Path, PathBuf};

use bytes::{Bytes, BytesMut};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, QueueSelector, ioctl_tiocnxcl, tcflush, tcgetattr, tcsetattr};
use tokio_serial::{SerialPort, SerialStream};

use super::noise::Noise;
use super::serve::Gate;
use super::{SharedBoard, watch::Watch};

/// The bit rate of the board's own line on a pseudo-terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineRate {
    /// Hosts with any other rate get garbage.
    Only(u32),
    /// Whatever the host has set.
    Any,
}

/// A pseudo-terminal that a board can be served on.
///
/// It is there as long as this is, whoever opens and closes it. What the board sends while nobody has it open is lost.
#[derive(Debug)]
pub struct Pty {
    master: SerialStream,
    slave: File,
    path: PathBuf,
    link: Option<Link>,
    line: LineRate,
    watch: Watch,
}

impl Pty {
    /// Opens a pseudo-terminal, and lets `link` point to it if there is one. The link goes when this goes.
    ///
    /// # Errors
    /// If the system has no more pseudo-terminals, or `link` is there already and not a link that was left over from
    /// one: then it is not touched.
    ///
    /// # Panics
    /// Outside of a tokio runtime, as all of tokio's input and output does.
    pub fn open(link: Option<&Path>, rate: LineRate) -> io::Result<Self> {
        let (master, slave) = SerialStream::pair()?;
        let path = slave.name().map(PathBuf::from).ok_or(io::ErrorKind::Unsupported)?;
        let no_controlling_terminal = i32::try_from(OFlags::NOCTTY.bits()).map_err(io::Error::other)?;
        let kept =
            OpenOptions::new().read(true).write(true).custom_flags(no_controlling_terminal).open(&path)?;
        drop(slave);
        let link = link.map(|link| Link::new(link, &path)).transpose()?;
        set_up(&kept, rate)?;
        let watch = Watch::new(&path)?;
        Ok(Self { master, slave: kept, path, link, line: rate, watch })
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
    /// If the terminal fails, or the state of the board cannot be saved.
    pub async fn serve(&mut self, board: &SharedBoard) -> io::Result<()> {
        let mut gate = Terminal {
            slave: &self.slave,
            watch: &mut self.watch,
            line: self.line,
            speed: 0,
            present: false,
            noise: Noise::new(0),
        };
        board.serve_gated(0, &mut self.master, &mut gate).await
    }
}

/// Raw, with the bit rate of the board: as a host finds it that sets nothing.
fn set_up(slave: &File, line: LineRate) -> io::Result<()> {
    let mut settings = tcgetattr(slave)?;
    settings.make_raw();
    let rate = match line {
        LineRate::Only(rate) => rate,
        LineRate::Any => 115_200,
    };
    settings.set_speed(rate)?;
    Ok(tcsetattr(slave, OptionalActions::Now, &settings)?)
}

/// The terminal between a host and the board.
struct Terminal<'p> {
    slave: &'p File,
    watch: &'p mut Watch,
    line: LineRate,
    /// The bit rate that the host has set.
    speed: u32,
    present: bool,
    noise: Noise,
}

impl Terminal<'_> {
    fn is_understood(&self) -> bool {
        match self.line {
            LineRate::Only(rate) => self.speed == rate,
            LineRate::Any => true,
        }
    }

    /// What bytes look like that were read at another rate: anything but the beginning of a frame.
    fn garble(&mut self, bytes: &mut [u8]) {
        for byte in bytes {
            *byte = self.noise.byte();
            if matches!(*byte, b'>' | b'$') {
                *byte = 0xFF;
            }
        }
    }
}

impl Gate for Terminal<'_> {
    fn look(&mut self) -> io::Result<bool> {
        let seen = self.watch.look()?;
        self.present = seen.open;
        let left = seen.came || seen.left;
        if left {
            // What the one before has not read is not for the next one.
            tcflush(self.slave, QueueSelector::IFlush)?;
        }
        if seen.left && !seen.open {
            // One that was killed leaves the terminal locked, and only its last closing would lift that.
            let _ = ioctl_tiocnxcl(self.slave);
            set_up(self.slave, self.line)?;
        }
        self.speed = tcgetattr(self.slave)?.output_speed();
        Ok(left)
    }

    fn ready(&mut self) -> impl Future<Output = io::Result<()>> + Send {
        self.watch.ready()
    }

    fn incoming(&mut self, bytes: &mut [u8]) {
        if !self.is_understood() {
            self.garble(bytes);
        }
    }

    fn outgoing(&mut self, bytes: Bytes) -> Bytes {
        if !self.present {
            return Bytes::new();
        }
        if self.is_understood() || bytes.is_empty() {
            return bytes;
        }
        let mut garbled = BytesMut::from(&bytes[..]);
        self.garble(&mut garbled);
        garbled.freeze()
    }

    fn rate(&self) -> Option<u32> {
        // Nobody can have a rate of 0.
        (self.line == LineRate::Any && self.speed > 0).then_some(self.speed)
    }
}

/// A symbolic link that is removed with this.
#[derive(Debug)]
struct Link(PathBuf, PathBuf);

impl Link {
    fn new(link: &Path, target: &Path) -> io::Result<Self> {
        if fs::symlink_metadata(link).is_ok() {
            if !is_stale(link) {
                let message = "path exists and is not a link to a terminal; remove it first";
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
