//! Trying ports, rates, parities and versions.

use std::time::Duration;

use sbgc_host::transport::{self, Address, Io, Line};
use sbgc_host::{ConnectOptions, VersionChoice};
use sbgc_proto::frame::Version;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::time::{Instant, timeout_at};

use crate::options::Global;

/// How long one attempt may take, unless the options say. A board answers within a few milliseconds.
const PATIENCE: Duration = Duration::from_millis(200);

/// What may be tried: all that the options leave open, and the defaults leave all open.
pub(super) fn scope(global: &Global) -> ConnectOptions {
    let chosen = global.connect_options();
    ConnectOptions {
        baud: chosen.baud.filter(|_| !global.is_default("baud")),
        parity: chosen.parity.filter(|_| !global.is_default("parity")),
        patience: Some(if global.is_default("timeout") { PATIENCE } else { global.timeout }),
        ..chosen
    }
}

/// The versions of the protocol that are tried, in words.
pub(super) fn versions(options: &ConnectOptions) -> &'static str {
    match options.link.version {
        VersionChoice::Auto => "versions 1 and 2",
        VersionChoice::Only(Version::V1) => "version 1",
        VersionChoice::Only(Version::V2) => "version 2",
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
