//! Ways to a board: serial ports, TCP and UDP.
//!
//! Here live addresses, what ports there are, and how they are opened. What goes over them is the business of
//! [`Gimbal`](crate::Gimbal), which takes any `AsyncRead + AsyncWrite`.

mod address;
mod ports;
#[cfg(feature = "serial")]
mod serial;
mod tcp;
mod udp;

use tokio::io::{AsyncRead, AsyncWrite};

pub use address::Address;
pub use ports::{PortInfo, PortKind, ports};
#[cfg(feature = "serial")]
pub use serial::open_serial;
pub use tcp::connect_tcp;
pub use udp::{UdpStream, connect_udp};

use crate::Result;

/// What a link can run over.
pub trait Port: AsyncRead + AsyncWrite + Unpin + Send {}

impl<T: AsyncRead + AsyncWrite + Unpin + Send> Port for T {}

/// An open way to a board, whatever kind it is.
pub type Io = Box<dyn Port>;

/// Parity of a serial line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Parity {
    /// None. Boards start with this.
    #[default]
    None,
    /// Even. Boards detect it by themselves.
    Even,
}

/// How a serial line is set. Eight data bits and one stop bit are all that boards know.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Line {
    /// Bits a second.
    pub baud: u32,
    /// Parity.
    pub parity: Parity,
}

impl Line {
    /// The speeds that boards know, most common first.
    pub const BAUDS: [u32; 6] = [115_200, 57_600, 38_400, 19_200, 9600, 256_000];
}

impl Default for Line {
    fn default() -> Self {
        Self { baud: 115_200, parity: Parity::None }
    }
}

impl Address {
    /// Opens it. The line is for serial ports alone.
    ///
    /// With the feature `sim`, `sim` starts a simulated board as it comes from the factory; it ends with the link.
    ///
    /// ```no_run
    /// # async fn example() -> sbgc_host::Result<()> {
    /// use sbgc_host::transport::{Address, Line};
    /// use sbgc_host::{Gimbal, Options};
    ///
    /// let address: Address = "/dev/ttyUSB0".parse()?;
    /// let line = Line::default();
    /// let gimbal = Gimbal::spawn(address.open(line).await?, Options { baud: address.baud(line), ..Options::default() });
    /// println!("{}", gimbal.handshake().await?.firmware_ver);
    /// # Ok(())
    /// # }
    /// ```
    pub async fn open(&self, line: Line) -> Result<Io> {
        match self {
            Self::Tcp { host, port } => Ok(Box::new(connect_tcp(host, *port).await?)),
            Self::Udp { host, port } => Ok(Box::new(connect_udp(host, *port).await?)),
            #[cfg(feature = "serial")]
            Self::Serial(name) => Ok(Box::new(open_serial(name, line)?)),
            #[cfg(not(feature = "serial"))]
            Self::Serial(_) => {
                let _ = line;
                Err(crate::Error::NotBuilt { address: self.to_string(), feature: "serial" })
            }
            #[cfg(feature = "sim")]
            Self::Sim => Ok(Box::new(crate::sim::in_process(crate::sim::Config::default()))),
            #[cfg(feature = "sim")]
            Self::SimFile(file) => {
                match crate::sim::simulate_with_state(file, &crate::sim::Config::default()) {
                    Ok((_, line)) => Ok(Box::new(line)),
                    Err(source) => Err(crate::Error::Open { address: self.to_string(), source }),
                }
            }
            #[cfg(not(feature = "sim"))]
            Self::Sim | Self::SimFile(_) => {
                Err(crate::Error::NotBuilt { address: self.to_string(), feature: "sim" })
            }
        }
    }

    /// The speed at which its bytes go, where that is known: for [`Options::baud`](crate::Options::baud).
    pub const fn baud(&self, line: Line) -> Option<u32> {
        match self {
            Self::Serial(_) => Some(line.baud),
            _ => None,
        }
    }
}
