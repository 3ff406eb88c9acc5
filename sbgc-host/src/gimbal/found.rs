//! What was found at the other end of a port.

use std::fmt;
use std::time::Duration;

use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;

use crate::transport::{Address, Line, Parity};

/// What was found at the other end of a port.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Where.
    pub address: Address,
    /// How the serial line is set; `None` where there is none.
    pub line: Option<Line>,
    /// Version of the framing that is spoken.
    pub version: Version,
    /// What the board reports of itself.
    pub board: BoardInfo,
    /// The id of the device, where the firmware reports one; `None` if a lost port is not opened again, since nobody
    /// asks for it then.
    pub device_id: Option<[u8; 9]>,
    /// How long it took to find it.
    pub after: Duration,
}

/// One line, such as `firmware 2.73.5 at 115200 baud, no parity, version 2 (found in 31 ms)`.
impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "firmware {}", self.board.firmware_ver)?;
        if let Some(Line { baud, parity }) = self.line {
            let parity = if parity == Parity::Even { "even" } else { "no" };
            write!(f, " at {baud} baud, {parity} parity")?;
        }
        write!(f, ", version {} (found in {} ms)", self.version.number(), self.after.as_millis())
    }
}
