//! Where a board is.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use crate::Error;

/// Where a board is: `tcp://HOST:PORT`, `udp://HOST:PORT`, `sim`, `sim:FILE`, or the path or name of a serial port.
///
/// ```
/// use sbgc_host::transport::Address;
///
/// let address: Address = "tcp://gimbal.local:4000".parse()?;
/// assert_eq!(address, Address::Tcp { host: "gimbal.local".into(), port: 4000 });
/// assert_eq!("COM3".parse::<Address>()?, Address::Serial("COM3".into()));
/// assert_eq!("sim:board.state".parse::<Address>()?, Address::SimFile("board.state".into()));
/// assert!("http://gimbal.local".parse::<Address>().is_err());
/// # Ok::<(), sbgc_host::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Address {
    /// A serial port, by its path or its name.
    Serial(String),
    /// A server that passes the bytes on.
    Tcp {
        /// Name or address of the host.
        host: String,
        /// Its port.
        port: u16,
    },
    /// A serial bridge that passes the bytes on in datagrams.
    Udp {
        /// Name or address of the host.
        host: String,
        /// Its port.
        port: u16,
    },
    /// A simulated board within this process, as it comes from the factory.
    Sim,
    /// A simulated board within this process that keeps its state in this file.
    SimFile(PathBuf),
}

impl Address {
    /// Whether it is a serial port, so that bit rate and parity matter.
    pub const fn is_serial(&self) -> bool {
        matches!(self, Self::Serial(_))
    }
}

impl FromStr for Address {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let bad = || Error::BadAddress { address: text.into() };
        match text.split_once("://") {
            Some(("tcp", rest)) => {
                let (host, port) = host_and_port(rest).ok_or_else(bad)?;
                Ok(Self::Tcp { host, port })
            }
            Some(("udp", rest)) => {
                let (host, port) = host_and_port(rest).ok_or_else(bad)?;
                Ok(Self::Udp { host, port })
            }
            Some(_) => Err(bad()),
            None if text == "sim" => Ok(Self::Sim),
            None => match text.strip_prefix("sim:") {
                Some("") => Err(bad()),
                Some(file) => Ok(Self::SimFile(file.into())),
                None if text.trim().is_empty() => Err(bad()),
                None => Ok(Self::Serial(text.into())),
            },
        }
    }
}

fn host_and_port(text: &str) -> Option<(String, u16)> {
    let (host, port) = text.rsplit_once(':')?;
    let port = port.parse().ok()?;
    let bare = host.strip_prefix('[').and_then(|host| host.strip_suffix(']'));
    // More colons belong to an IPv6 address, which must be bracketed.
    let valid = !bare.unwrap_or(host).is_empty() && (bare.is_some() || !host.contains([':', '/']));
    valid.then(|| (bare.unwrap_or(host).into(), port))
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Serial(name) => f.write_str(name),
            Self::Tcp { host, port } => write!(f, "tcp://{}:{port}", Host(host)),
            Self::Udp { host, port } => write!(f, "udp://{}:{port}", Host(host)),
            Self::Sim => f.write_str("sim"),
            Self::SimFile(file) => write!(f, "sim:{}", file.display()),
        }
    }
}

/// A host as it stands in an address.
struct Host<'a>(&'a str);

impl fmt::Display for Host<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.contains(':') { write!(f, "[{}]", self.0) } else { f.write_str(self.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        for text in [
            "/dev/ttyUSB0",
            "ttyACM1",
            "COM3",
            "sim",
            "tcp://10.0.0.1:23",
            "tcp://[::1]:4000",
            "udp://[::1]:7",
            "sim:/x/y",
        ] {
            assert_eq!(text.parse::<Address>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn what_is_no_address() {
        for text in [
            "",
            " ",
            "tcp://",
            "tcp://host",
            "tcp://:1",
            "tcp://host:99999",
            "tcp://::1:5",
            "http://x:1",
            "udp://x",
            "sim:",
        ] {
            let error = text.parse::<Address>().unwrap_err();
            assert!(matches!(&error, Error::BadAddress { address } if address == text), "{text}: {error}");
        }
    }
}
