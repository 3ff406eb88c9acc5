//! What serial ports there are.

use std::fmt;
#[cfg(target_os = "linux")]
use std::path::Path;

/// How a serial port is connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PortKind {
    /// Over USB, as boards are.
    Usb,
    /// Over Bluetooth.
    Bluetooth,
    /// Built in, or not known.
    Other,
}

/// A serial port that there is.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PortInfo {
    /// What it is opened by: a path, on Windows a name.
    pub name: String,
    /// How it is connected.
    pub kind: PortKind,
    /// What the device calls itself.
    pub product: Option<String>,
    /// A path that stays the same when devices are plugged in in another order.
    pub by_id: Option<String>,
}

impl fmt::Display for PortInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)?;
        self.product.as_ref().map_or(Ok(()), |product| write!(f, " ({product})"))
    }
}

impl PortInfo {
    #[cfg(any(target_os = "linux", feature = "serial"))]
    fn new(name: String, kind: PortKind) -> Self {
        Self { name, kind, product: None, by_id: None }
    }
}

/// The serial ports that there are, those first that a board is likely to be on.
///
/// On Linux these are the ports that the kernel lists with a device behind them and all of `/dev/ttyUSB*` and
/// `/dev/ttyACM*`. Pseudo-terminals, and UARTs of a computer's own chip, may be missing, and can be opened all the
/// same.
pub fn ports() -> Vec<PortInfo> {
    let mut ports = listed();
    #[cfg(target_os = "linux")]
    {
        add_devices(&mut ports, Path::new("/dev"));
        add_ids(&mut ports, Path::new("/dev/serial/by-id"));
    }
    ports.sort_by(|one, other| (one.kind, &one.name).cmp(&(other.kind, &other.name)));
    ports
}

#[cfg(feature = "serial")]
fn listed() -> Vec<PortInfo> {
    use serialport::SerialPortType;

    // The library panics without this directory.
    #[cfg(target_os = "linux")]
    if !Path::new("/sys/class/tty").is_dir() {
        return Vec::new();
    }
    let ports = serialport::available_ports().unwrap_or_else(|error| {
        tracing::debug!(%error, "serial ports cannot be listed");
        Vec::new()
    });
    let info = |port: serialport::SerialPortInfo| {
        let (kind, product) = match port.port_type {
            SerialPortType::UsbPort(usb) => (PortKind::Usb, usb.product),
            SerialPortType::BluetoothPort => (PortKind::Bluetooth, None),
            SerialPortType::PciPort | SerialPortType::Unknown => (PortKind::Other, None),
        };
        PortInfo { product, ..PortInfo::new(port.port_name, kind) }
    };
    ports.into_iter().map(info).collect()
}

#[cfg(not(feature = "serial"))]
fn listed() -> Vec<PortInfo> {
    Vec::new()
}

/// Adds USB devices that are not listed, as in containers that see `/dev` but not all of `/sys`.
#[cfg(target_os = "linux")]
fn add_devices(ports: &mut Vec<PortInfo>, directory: &Path) {
    let Ok(entries) = directory.read_dir() else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let usb = name.to_str().is_some_and(|name| name.starts_with("ttyUSB") || name.starts_with("ttyACM"));
        let path = entry.path().display().to_string();
        if usb && !ports.iter().any(|port| port.name == path) {
            ports.push(PortInfo::new(path, PortKind::Usb));
        }
    }
}

/// Adds to each port the lasting path that leads to it.
#[cfg(target_os = "linux")]
fn add_ids(ports: &mut [PortInfo], directory: &Path) {
    let Ok(entries) = directory.read_dir() else { return };
    for entry in entries.flatten() {
        let Ok(device) = entry.path().canonicalize() else { continue };
        if let Some(port) = ports.iter_mut().find(|port| Path::new(&port.name) == device) {
            port.by_id = Some(entry.path().display().to_string());
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn devices_and_their_lasting_names() {
        let directory = std::env::temp_dir().join(format!("sbgc-ports-{}", std::process::id()));
        let ids = directory.join("by-id");
        std::fs::create_dir_all(&ids).unwrap();
        for name in ["ttyUSB3", "ttyACM0", "tty7"] {
            std::fs::write(directory.join(name), "").unwrap();
        }
        std::os::unix::fs::symlink(directory.join("ttyUSB3"), ids.join("usb-Basecam")).unwrap();
        let mut ports = Vec::new();
        add_devices(&mut ports, &directory.canonicalize().unwrap());
        add_ids(&mut ports, &ids);
        ports.sort_by(|one, other| one.name.cmp(&other.name));
        std::fs::remove_dir_all(&directory).unwrap();
        assert_eq!(ports.len(), 2);
        assert!(ports[0].name.ends_with("ttyACM0") && ports[0].by_id.is_none());
        assert!(ports[1].name.ends_with("ttyUSB3") && ports[1].by_id.is_some());
    }

    #[test]
    fn listing_does_not_fail() {
        let ports = ports();
        assert!(ports.is_sorted_by_key(|port| port.kind));
    }
}
