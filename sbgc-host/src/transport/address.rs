//! Where a board is.

use std::fmt;
use std::str::FromStr;

use crate::Error;

/// Where a board is: `tcp://HOST:PORT`, `sim`, or the path or name of a serial port.
///
/// ```
/// use sbgc_host::transport::Address;
///
/// let address: Address = "tcp://gimbal.local:4000".parse()?;
/// assert_eq!(address, Address::Tcp { host: "gimbal.local".into(), port: 4000 });
/// assert_eq!("COM3".parse::<Address>()?, Address::Serial("COM3".into()));
/// assert!("udp://gimbal.local:4000".parse::<Address>().is_err());
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
    /// The simulated board within this process.
    Sim,
}

impl FromStr for Address {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let bad = || Error::BadAddress { address: text.into() };
        match text.split_once("://") {
            Some(("tcp", rest)) => {
                let (host, port) = rest.rsplit_once(':').ok_or_else(bad)?;
                let port = port.parse().map_err(|_| bad())?;
                let bare = host.strip_prefix('[').and_then(|host| host.strip_suffix(']'));
                // More colons belong to an IPv6 address, which must be bracketed.
                if bare.unwrap_or(host).is_empty() || (bare.is_none() && host.contains([':', '/'])) {
                    return Err(bad());
                }
                Ok(Self::Tcp { host: bare.unwrap_or(host).into(), port })
            }
            Some(_) => Err(bad()),
            None if text == "sim" => Ok(Self::Sim),
            None if text.trim().is_empty() => Err(bad()),
            None => Ok(Self::Serial(text.into())),
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Serial(name) => f.write_str(name),
            Self::Tcp { host, port } if host.contains(':') => write!(f, "tcp://[{host}]:{port}"),
            Self::Tcp { host, port } => write!(f, "tcp://{host}:{port}"),
            Self::Sim => f.write_str("sim"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        for text in ["/dev/ttyUSB0", "ttyACM1", "COM3", "sim", "tcp://10.0.0.1:23", "tcp://[::1]:4000"] {
            assert_eq!(text.parse::<Address>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn what_is_no_address() {
        for text in
            ["", " ", "tcp://", "tcp://host", "tcp://:1", "tcp://host:99999", "tcp://::1:5", "http://x:1"]
        {
            let error = text.parse::<Address>().unwrap_err();
            assert!(matches!(&error, Error::BadAddress { address } if address == text), "{text}: {error}");
        }
    }
}
