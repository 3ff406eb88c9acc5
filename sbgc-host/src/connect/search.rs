//! Going through the settings of a port until a board answers.

use std::ops::ControlFlow;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::BoardInfo;
use sbgc_proto::frame::Version;
use tokio::time::Instant;

use super::options::{ConnectOptions, Reconnect, Wrap};
use super::peek::Peeked;
use crate::error::{Error, Result};
use crate::foreign::{Foreign, recognise};
use crate::gimbal::{Found, Gimbal, Options, VersionChoice, knows_version_2};
use crate::machine::LinkCounters;
use crate::task::{Dial, Redial};
use crate::transport::{Address, Io, Line, Parity};

/// How long an answer may take while many combinations are to be tried.
const PATIENCE: Duration = Duration::from_millis(200);

/// How many of the first bytes an error shows.
const SHOWN: usize = 16;

/// One combination that was tried, and what came of it.
#[derive(Debug)]
pub struct Tried {
    /// Where.
    pub address: Address,
    /// How the serial line was set; `None` where there is none.
    pub line: Option<Line>,
    /// The board that was found, or why none was.
    pub outcome: Result<Found>,
    /// How long it took.
    pub took: Duration,
    /// What passed the port.
    pub counters: LinkCounters,
    /// The first bytes that came.
    pub heard: Bytes,
}

impl Tried {
    /// Whether the port itself cannot be used, so that other settings are of no help.
    pub fn is_hopeless(&self) -> bool {
        !matches!(self.outcome, Ok(_) | Err(Error::Timeout { .. } | Error::Refused { .. } | Error::Decode(_)))
    }

    /// What else talks on the port, if that is recognised.
    pub fn foreign(&self) -> Option<Foreign> {
        recognise(&self.heard)
    }
}

/// Looks for a board at an address, and gives the port back.
///
/// Serial lines are tried with all bit rates and parities that boards know, likeliest first, unless they are chosen.
/// Each is asked in version 1 first, because a board that has once seen version 2 takes nothing else until it
/// restarts. `tried` is called for every combination.
///
/// # Errors
/// If the port cannot be opened, or no board answers.
pub async fn detect(
    address: &Address,
    options: ConnectOptions,
    mut tried: impl FnMut(&Tried),
) -> Result<Found> {
    let mut search = Search::new(address, ConnectOptions { reconnect: Reconnect::Never, ..options });
    for line in search.lines() {
        let outcome = match search.try_line(line, None).await {
            Ok((gimbal, report)) => {
                gimbal.close().await;
                tried(&report);
                report.outcome
            }
            Err(report) => {
                tried(&report);
                return report.outcome;
            }
        };
        if outcome.is_ok() {
            return outcome;
        }
    }
    Err(search.failed())
}

/// Tries all combinations that the options leave open, also after a board was found, as long as `tried` says so: a board
/// on USB answers at every bit rate. It ends as well when the port cannot be opened; `tried` is told that, too.
pub async fn survey(
    address: &Address,
    options: ConnectOptions,
    mut tried: impl FnMut(Tried) -> ControlFlow<()>,
) {
    let mut search = Search::new(address, ConnectOptions { reconnect: Reconnect::Never, ..options });
    for line in search.lines() {
        let (report, hopeless) = match search.try_line(line, None).await {
            Ok((gimbal, report)) => {
                gimbal.close().await;
                (report, false)
            }
            Err(report) => (report, true),
        };
        if tried(report).is_break() || hopeless {
            return;
        }
    }
}

/// The search for a board at one address.
pub(super) struct Search<'a> {
    address: &'a Address,
    options: ConnectOptions,
    began: Instant,
    lines: Vec<Option<Line>>,
    /// What came from the port, and whether that was recognised or was a frame of a board.
    heard: Bytes,
    foreign: Option<Foreign>,
    frames: bool,
}

impl<'a> Search<'a> {
    pub(super) fn new(address: &'a Address, options: ConnectOptions) -> Self {
        Self {
            address,
            options,
            began: Instant::now(),
            lines: combinations(address, options),
            heard: Bytes::new(),
            foreign: None,
            frames: false,
        }
    }

    /// What is to be tried, likeliest first.
    pub(super) fn lines(&self) -> Vec<Option<Line>> {
        self.lines.clone()
    }

    /// Tries one combination. An `Err` is a port that cannot be used.
    pub(super) async fn try_line(
        &mut self,
        line: Option<Line>,
        wrap: Option<&Wrap>,
    ) -> std::result::Result<(Gimbal, Tried), Tried> {
        let began = Instant::now();
        let opened = self.address.open(line.unwrap_or_default()).await;
        let report = |outcome| Tried {
            address: self.address.clone(),
            line,
            outcome,
            took: began.elapsed(),
            counters: LinkCounters::default(),
            heard: Bytes::new(),
        };
        let (peeked, io) = match opened {
            Ok(io) => Peeked::new(wrapped(io, wrap)),
            Err(error) => return Err(report(Err(error))),
        };
        let settings = Options { baud: line.map(|line| line.baud), ..self.options.link };
        let redial = self.options.reconnect.within().map(|within| {
            let wrap = wrap.cloned();
            Redial { dial: dial(self.address, line, wrap), within }
        });
        let (gimbal, connection) = Gimbal::with_dial(Box::new(io), settings, redial);
        connection.spawn();
        let identified = self.identify(&gimbal).await;
        let outcome = identified.map(|board| Found {
            address: self.address.clone(),
            line,
            version: match settings.version {
                VersionChoice::Auto if knows_version_2(&board) => Version::V2,
                _ => gimbal.version(),
            },
            board,
            device_id: None,
            after: self.began.elapsed(),
        });
        let tried = Tried { counters: gimbal.counters(), heard: peeked.bytes(), ..report(outcome) };
        tracing::debug!(
            address = %self.address,
            ?line,
            found = tried.outcome.is_ok(),
            took_ms = tried.took.as_millis(),
            "tried a port"
        );
        if tried.is_hopeless() {
            return Err(tried);
        }
        self.note(&tried);
        Ok((gimbal, tried))
    }

    /// Bytes at a wrong bit rate are noise, so those in which something is recognised count.
    fn note(&mut self, tried: &Tried) {
        let foreign = tried.foreign();
        if self.heard.is_empty() || (self.foreign.is_none() && foreign.is_some()) {
            self.heard.clone_from(&tried.heard);
        }
        self.foreign = self.foreign.or(foreign);
        self.frames |= tried.counters.received.frames > 0;
    }

    async fn identify(&self, gimbal: &Gimbal) -> Result<BoardInfo> {
        if self.lines.len() == 1 && self.options.patience.is_none() {
            return gimbal.probe(Version::V1).await;
        }
        // In both versions once.
        let timeout = self.options.patience.unwrap_or_else(|| gimbal.options().timeout.min(PATIENCE));
        let regular = u32::from(gimbal.options().version != VersionChoice::Auto);
        gimbal.with_timeout(timeout).probe_times(Version::V1, regular).await
    }

    /// Why no board was found.
    pub(super) fn failed(&self) -> Error {
        let address = self.address.to_string();
        // A board that sends frames and does not answer is a board all the same.
        if !self.heard.is_empty() && !self.frames {
            let first = self.heard.slice(..self.heard.len().min(SHOWN));
            return Error::OtherProtocol { address, foreign: self.foreign, first };
        }
        let lines =
            self.lines.iter().flatten().map(|line| (line.baud, line.parity == Parity::Even)).collect();
        let version = self.options.link.version.only().map(Version::number);
        Error::Silent { address, lines, version, after: self.began.elapsed() }
    }
}

fn wrapped(io: Io, wrap: Option<&Wrap>) -> Io {
    match wrap {
        Some(wrap) => wrap(io),
        None => io,
    }
}

pub(super) fn combinations(address: &Address, options: ConnectOptions) -> Vec<Option<Line>> {
    if !address.is_serial() {
        return vec![None];
    }
    let parities = options.parity.map_or(vec![Parity::None, Parity::Even], |parity| vec![parity]);
    let bauds = options.baud.map_or(Line::BAUDS.to_vec(), |baud| vec![baud]);
    let lines =
        parities.iter().flat_map(|&parity| bauds.iter().map(move |&baud| Some(Line { baud, parity })));
    lines.collect()
}

fn dial(address: &Address, line: Option<Line>, wrap: Option<Wrap>) -> Dial {
    let address = address.clone();
    Box::new(move || {
        let (address, wrap) = (address.clone(), wrap.clone());
        Box::pin(async move {
            let io = address.open(line.unwrap_or_default()).await?;
            Ok(wrapped(io, wrap.as_ref()))
        })
    })
}
