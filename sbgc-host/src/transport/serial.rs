//! Serial ports.

use std::io;
use std::path::{Path, PathBuf};

use serialport::{ClearBuffer, ErrorKind, SerialPort as _};
use tokio_serial::{SerialPortBuilderExt, SerialStream};

use super::{Line, Parity, PortInfo, ports};
use crate::{Error, Result};

/// Opens a serial port for this program alone, by its path (`/dev/ttyUSB0`) or its name (`ttyUSB0`, `COM3`).
///
/// Must be called on a tokio runtime.
pub fn open_serial(name: &str, line: Line) -> Result<SerialStream> {
    let path = path_of(name);
    let parity = match line.parity {
        Parity::None => serialport::Parity::None,
        Parity::Even => serialport::Parity::Even,
    };
    let stream = tokio_serial::new(path.to_string_lossy(), line.baud)
        .data_bits(serialport::DataBits::Eight)
        .parity(parity)
        .stop_bits(serialport::StopBits::One)
        .flow_control(serialport::FlowControl::None)
        .open_native_async()
        .map_err(|error| explain(name, path, &error))?;
    // What came for the program before could pass for an answer. A port that cannot forget it is good all the same.
    if let Err(error) = stream.clear(ClearBuffer::Input) {
        tracing::debug!(%error, "old input stays");
    }
    Ok(stream)
}

/// A name without a directory is one in `/dev`, unless there is such a file right here.
fn path_of(name: &str) -> PathBuf {
    let path = PathBuf::from(name);
    let bare = cfg!(unix) && path.components().count() == 1 && !path.exists();
    if bare { Path::new("/dev").join(path) } else { path }
}

fn names(ports: &[PortInfo]) -> Vec<String> {
    ports.iter().map(ToString::to_string).collect()
}

fn explain(name: &str, path: PathBuf, error: &serialport::Error) -> Error {
    match error.kind() {
        ErrorKind::Io(io::ErrorKind::PermissionDenied) => {
            let group = group_of(&path);
            Error::PermissionDenied { path, group }
        }
        ErrorKind::Io(io::ErrorKind::NotFound) => {
            // A link that was left behind is there, and what it leads to is not.
            let name = match path.read_link() {
                Ok(target) => format!("{name} (a link to {}, which is gone)", target.display()),
                Err(_) => name.into(),
            };
            Error::NoSuchPort { name, available: names(&ports()) }
        }
        // The library says so of a port that is locked and, on Windows, of one that is not there.
        ErrorKind::NoDevice => {
            let available = ports();
            if path.exists() || available.iter().any(|port| port.name.eq_ignore_ascii_case(name)) {
                Error::PortBusy { path }
            } else {
                Error::NoSuchPort { name: name.into(), available: names(&available) }
            }
        }
        ErrorKind::Io(_) | ErrorKind::InvalidInput | ErrorKind::Unknown => {
            // What the system says of a file that is opened like a terminal helps nobody.
            let source = if is_device(&path) {
                io::Error::other(error.to_string())
            } else {
                io::Error::new(io::ErrorKind::InvalidInput, "it is no serial port")
            };
            Error::Open { address: path.display().to_string(), source }
        }
    }
}

#[cfg(unix)]
fn is_device(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;

    path.metadata().is_ok_and(|metadata| metadata.file_type().is_char_device())
}

#[cfg(not(unix))]
fn is_device(_path: &Path) -> bool {
    true
}

/// The group whose members may read and write a device.
#[cfg(unix)]
fn group_of(path: &Path) -> Option<String> {
    use std::os::unix::fs::MetadataExt;

    let metadata = path.metadata().ok()?;
    let may = metadata.mode() & 0o060 == 0o060;
    let groups = std::fs::read_to_string("/etc/group").ok()?;
    may.then(|| group_name(&groups, metadata.gid())).flatten()
}

#[cfg(not(unix))]
fn group_of(_path: &Path) -> Option<String> {
    None
}

/// The name of a group in the text of `/etc/group`. Nobody should be told to join root's.
#[cfg(unix)]
fn group_name(groups: &str, gid: u32) -> Option<String> {
    let name = groups.lines().find_map(|line| {
        let mut fields = line.split(':');
        let (name, _password, number) = (fields.next()?, fields.next()?, fields.next()?);
        (number.parse() == Ok(gid)).then_some(name)
    })?;
    (gid != 0).then(|| name.into())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn groups_by_number() {
        let groups = "root:x:0:\ndialout:x:20:anna,bert\nbroken\nuucp:x:14:\n";
        assert_eq!(group_name(groups, 20).as_deref(), Some("dialout"));
        assert_eq!(group_name(groups, 14).as_deref(), Some("uucp"));
        assert_eq!(group_name(groups, 0), None);
        assert_eq!(group_name(groups, 99), None);
    }

    #[tokio::test]
    async fn a_port_that_is_not_there() {
        let error = open_serial("ttyNotThere9", Line::default()).unwrap_err();
        assert!(matches!(&error, Error::NoSuchPort { name, .. } if name == "ttyNotThere9"), "{error}");
        assert_eq!(path_of("ttyNotThere9"), Path::new("/dev/ttyNotThere9"));
        assert_eq!(path_of("/x/ttyUSB0"), Path::new("/x/ttyUSB0"));
    }

    #[tokio::test]
    async fn a_file_is_no_port() {
        let file = std::env::temp_dir().join(format!("sbgc-file-{}", std::process::id()));
        std::fs::write(&file, "").unwrap();
        let opened = open_serial(file.to_str().unwrap(), Line::default());
        std::fs::remove_file(&file).unwrap();
        let text = opened.unwrap_err().to_string();
        assert_eq!(text, format!("cannot open {}: it is no serial port", file.display()));
    }

    #[tokio::test]
    async fn a_link_that_leads_nowhere_says_where() {
        let link = std::env::temp_dir().join(format!("sbgc-link-{}", std::process::id()));
        std::os::unix::fs::symlink("/dev/pts/none", &link).unwrap();
        let opened = open_serial(link.to_str().unwrap(), Line::default());
        std::fs::remove_file(&link).unwrap();
        let text = opened.unwrap_err().to_string();
        assert!(text.contains("(a link to /dev/pts/none, which is gone)"), "{text}");
    }

    #[tokio::test]
    async fn what_came_for_another_is_forgotten() {
        use tokio::io::{AsyncReadExt, AsyncWriteExt};

        let (mut board, kept) = SerialStream::pair().unwrap();
        let path = serialport::SerialPort::name(&kept).unwrap();
        drop(kept);
        let another = open_serial(&path, Line::default()).unwrap();
        board.write_all(b"old").await.unwrap();
        another.readable().await.unwrap();
        // A terminal that nobody has open forgets by itself, so this one stays open.
        let still_open = std::fs::File::open(&path);
        drop(another);
        let mut port = open_serial(&path, Line::default()).unwrap();
        board.write_all(b"new").await.unwrap();
        let mut read = [0; 3];
        port.read_exact(&mut read).await.unwrap();
        assert_eq!(&read, b"new");
        drop(still_open);
    }

    #[tokio::test]
    async fn a_port_is_opened_for_one_only() {
        let (first, second) = SerialStream::pair().unwrap();
        let path = serialport::SerialPort::name(&second).unwrap();
        drop(second);
        let open = open_serial(&path, Line::default()).unwrap();
        // Root may open a locked terminal, but not lock it as well.
        let error = open_serial(&path, Line::default()).unwrap_err();
        assert!(matches!(&error, Error::PortBusy { .. }), "{error}");
        drop((open, first));
    }
}
