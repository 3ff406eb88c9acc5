//! From an address to a board that answers: opening, detection, and opening again.

mod mavlink;
mod peek;

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::CommandId;
use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;
use tokio::time::Instant;

use crate::error::{Error, Result};
use crate::gimbal::{Found, Gimbal, Options, VersionChoice, knows_version_2};
use crate::machine::Identity;
use crate::task::Dial;
use crate::transport::{Address, Line, Parity};
use peek::Peeked;

/// How long an answer may take while many combinations are to be tried.
const PATIENCE: Duration = Duration::from_millis(200);

/// How a board is looked for and connected.
///
/// ```
/// use sbgc_host::ConnectOptions;
/// use sbgc_host::transport::Parity;
///
/// let options = ConnectOptions { baud: Some(115_200), parity: Some(Parity::None), ..ConnectOptions::default() };
/// assert!(options.reconnect);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConnectOptions {
    /// Bits per second of a serial line; `None` finds them.
    pub baud: Option<u32>,
    /// Parity of a serial line; `None` finds it.
    pub parity: Option<Parity>,
    /// How the link is set up. The bit rate comes from the line.
    pub link: Options,
    /// Whether a port that is lost is opened again, until the link is closed.
    pub reconnect: bool,
}

impl Default for ConnectOptions {
    fn default() -> Self {
        Self { baud: None, parity: None, link: Options::default(), reconnect: true }
    }
}

/// One combination that was tried, and what came of it.
#[derive(Debug)]
pub struct Tried {
    /// Where.
    pub address: Address,
    /// How the serial line was set; `None` where there is none.
    pub line: Option<Line>,
    /// The board that was found, or why none was.
    pub outcome: Result<Found>,
}

/// Looks for a board at an address, and gives the port back.
///
/// Serial lines are tried with all bit rates and parities that boards know, likeliest first, unless they are chosen.
/// Each is asked in version 1 first, because a board that has once seen version 2 takes nothing else until it
/// restarts. `tried` is called for every combination.
///
/// # Errors
/// If the port cannot be opened, or no board answers.
pub async fn detect(address: &Address, options: ConnectOptions, tried: impl FnMut(&Tried)) -> Result<Found> {
    let (gimbal, found) = search(address, options, false, tried).await?;
    gimbal.close().await;
    Ok(found)
}

impl Gimbal {
    /// Opens an address, finds the board there, and goes on with the same board when the port was lost.
    ///
    /// ```
    /// # #[cfg(feature = "sim")]
    /// # #[tokio::main(flavor = "current_thread")]
    /// # async fn main() -> sbgc_host::Result<()> {
    /// use sbgc_host::Gimbal;
    ///
    /// let gimbal = Gimbal::connect(&"sim".parse()?).await?;
    /// assert!(gimbal.found().is_some_and(|found| found.device_id.is_some()));
    /// # gimbal.close().await;
    /// # Ok(())
    /// # }
    /// # #[cfg(not(feature = "sim"))]
    /// # fn main() {}
    /// ```
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub async fn connect(address: &Address) -> Result<Self> {
        Self::connect_with(address, ConnectOptions::default()).await
    }

    /// Like [`connect`](Self::connect), with options.
    ///
    /// # Errors
    /// If the port cannot be opened, or no board answers.
    pub async fn connect_with(address: &Address, options: ConnectOptions) -> Result<Self> {
        let (gimbal, mut found) = search(address, options, options.reconnect, |_| {}).await?;
        gimbal.prefer_version_2(&found.board).await;
        found.version = gimbal.version();
        tracing::info!("{address}: {found}");
        gimbal.remember(found).await;
        Ok(gimbal)
    }

    /// Keeps who the board is.
    async fn remember(&self, mut found: Found) {
        let identity = match self.board_info3().await {
            Ok(info) => {
                found.device_id = Some(info.device_id.0);
                let front = Bytes::copy_from_slice(&info.device_id.0);
                Identity { command: CommandId::BoardInfo3.raw(), front }
            }
            // Old firmware has no identity. What answers there is taken for the same.
            Err(_) => Identity { command: CommandId::BoardInfo.raw(), front: Bytes::new() },
        };
        self.link().call(|machine, _| machine.set_identity(identity));
        self.set_found(found);
    }
}

/// Goes through the combinations until a board answers.
async fn search(
    address: &Address,
    options: ConnectOptions,
    redial: bool,
    mut tried: impl FnMut(&Tried),
) -> Result<(Gimbal, Found)> {
    let began = Instant::now();
    let lines = combinations(address, options);
    let mut heard: Option<Bytes> = None;
    for line in &lines {
        let (peeked, io) = Peeked::new(address.open(line.unwrap_or_default()).await?);
        let link = Options { baud: line.map(|line| line.baud), ..options.link };
        let (gimbal, connection) =
            Gimbal::with_dial(Box::new(io), link, redial.then(|| dial(address, *line)));
        connection.spawn();
        let outcome = identify(&gimbal, lines.len() > 1).await.map(|board| Found {
            address: address.clone(),
            line: *line,
            version: if knows_version_2(&board) { Version::V2 } else { gimbal.version() },
            board,
            device_id: None,
            after: began.elapsed(),
        });
        let report = Tried { address: address.clone(), line: *line, outcome };
        tried(&report);
        match report.outcome {
            Ok(found) => return Ok((gimbal, found)),
            Err(error @ (Error::Disconnected | Error::Closed)) => return Err(error),
            Err(_) => {}
        }
        gimbal.close().await;
        let bytes = peeked.bytes();
        // Bytes at a wrong bit rate are noise, so those in which something is recognised count.
        if heard.as_ref().is_none_or(|heard| heard.is_empty() || mavlink::is_in(&bytes)) {
            heard = Some(bytes);
        }
    }
    let after = began.elapsed();
    let address = address.to_string();
    match heard {
        Some(first) if !first.is_empty() => {
            let mavlink = mavlink::is_in(&first);
            Err(Error::OtherProtocol { address, mavlink, first: first.slice(..first.len().min(16)) })
        }
        _ => {
            let lines = lines.iter().flatten().map(|line| (line.baud, line.parity == Parity::Even)).collect();
            let version = options.link.version.only().map(Version::number);
            Err(Error::Silent { address, lines, version, after })
        }
    }
}

async fn identify(gimbal: &Gimbal, hurried: bool) -> Result<BoardInfo> {
    let timeout = gimbal.options().timeout;
    if hurried {
        // In both versions once.
        let regular = u32::from(gimbal.options().version != VersionChoice::Auto);
        return gimbal.with_timeout(timeout.min(PATIENCE)).probe_times(Version::V1, regular).await;
    }
    gimbal.probe(Version::V1).await
}

fn combinations(address: &Address, options: ConnectOptions) -> Vec<Option<Line>> {
    if !address.is_serial() {
        return vec![None];
    }
    let parities = options.parity.map_or(vec![Parity::None, Parity::Even], |parity| vec![parity]);
    let bauds = options.baud.map_or(Line::BAUDS.to_vec(), |baud| vec![baud]);
    let lines =
        parities.iter().flat_map(|&parity| bauds.iter().map(move |&baud| Some(Line { baud, parity })));
    lines.collect()
}

fn dial(address: &Address, line: Option<Line>) -> Dial {
    let address = address.clone();
    Box::new(move || {
        let address = address.clone();
        Box::pin(async move { address.open(line.unwrap_or_default()).await })
    })
}

#[cfg(test)]
mod tests;
