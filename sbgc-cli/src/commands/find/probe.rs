//! Trying ports, rates, parities and versions.

use std::time::Duration;

use sbgc_host::transport::{self, Address, Io, Line};
use sbgc_host::{Error, Gimbal, LinkCounters, Options, VersionChoice};
use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::time::{Instant, timeout_at};

use crate::options::{Baud, Global, Parity, Protocol, Setting};

/// What may be tried: all that the options leave open.
#[derive(Clone, Debug)]
pub(super) struct Scope {
    rates: Vec<u32>,
    parities: Vec<transport::Parity>,
    version: VersionChoice,
    timeout: Duration,
}

/// How long one attempt may take, unless the options say. A board answers within a few milliseconds.
const PATIENCE: Duration = Duration::from_millis(200);

/// A combination that a board answered.
pub(super) struct Found {
    pub(super) line: Option<Line>,
    pub(super) version: Version,
    pub(super) info: BoardInfo,
    pub(super) counters: LinkCounters,
}

impl Scope {
    pub(super) fn of(global: &Global) -> Self {
        let is_default = |name: &str| {
            let same = |setting: &&Setting| setting.name == name;
            global.settings.iter().find(same).is_some_and(|setting| setting.source == "default")
        };
        let rates = match global.baud {
            Baud::Rate(rate) if !is_default("baud") => vec![rate],
            _ => Line::BAUDS.to_vec(),
        };
        let parities = match global.parity {
            Parity::None if !is_default("parity") => vec![transport::Parity::None],
            Parity::Even => vec![transport::Parity::Even],
            _ => vec![transport::Parity::None, transport::Parity::Even],
        };
        let version = match global.protocol {
            Protocol::Auto => VersionChoice::Auto,
            Protocol::V1 => VersionChoice::Only(Version::V1),
            Protocol::V2 => VersionChoice::Only(Version::V2),
        };
        let timeout = if is_default("timeout") { PATIENCE } else { global.timeout };
        Self { rates, parities, version, timeout }
    }

    /// The settings of the line, most likely first.
    pub(super) fn lines(&self, address: &Address) -> Vec<Line> {
        if !matches!(address, Address::Serial(_)) {
            return vec![Line::default()];
        }
        let of_parity = |&parity| self.rates.iter().map(move |&baud| Line { baud, parity });
        self.parities.iter().flat_map(of_parity).collect()
    }

    /// The versions of the protocol that are tried, in words.
    pub(super) fn versions(&self) -> &'static str {
        match self.version {
            VersionChoice::Auto => "versions 2 and 1",
            VersionChoice::Only(Version::V1) => "version 1",
            VersionChoice::Only(Version::V2) => "version 2",
        }
    }

    /// Tries one combination.
    pub(super) async fn probe(&self, address: &Address, line: Line) -> Result<Found, (Error, LinkCounters)> {
        let io = address.open(line).await.map_err(|error| (error, LinkCounters::default()))?;
        let options = Options {
            version: self.version,
            timeout: self.timeout,
            attempts: 1,
            baud: address.baud(line),
            ..Options::default()
        };
        let gimbal = Gimbal::spawn(io, options);
        let outcome = gimbal.handshake().await;
        let (version, counters) = (gimbal.version(), gimbal.counters());
        gimbal.close().await;
        match outcome {
            Ok(info) => {
                let line = matches!(address, Address::Serial(_)).then_some(line);
                Ok(Found { line, version, info, counters })
            }
            Err(error) => Err((error, counters)),
        }
    }
}

/// What comes from a port by itself, for a while, and after a line end that a console would answer.
pub(super) async fn listen(address: &Address, line: Line) -> Vec<u8> {
    let Ok(mut io): Result<Io, _> = address.open(line).await else { return Vec::new() };
    let (mut heard, end) = (Vec::new(), Instant::now() + Duration::from_millis(500));
    let _ = io.write_all(b"\r\n").await;
    let mut piece = [0; 512];
    while heard.len() < 4096 {
        match timeout_at(end, io.read(&mut piece)).await {
            Ok(Ok(length @ 1..)) => heard.extend_from_slice(piece.get(..length).unwrap_or_default()),
            _ => break,
        }
    }
    heard
}

/// The parity as the options call it.
pub(super) fn parity_name(parity: transport::Parity) -> &'static str {
    match parity {
        transport::Parity::None => "none",
        transport::Parity::Even => "even",
    }
}
