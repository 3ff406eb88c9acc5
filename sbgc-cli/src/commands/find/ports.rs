//! `sbgc ports`: the serial ports of this computer.

use clap::Args;
use sbgc_host::transport::{PortInfo, PortKind, ports};
use serde_json::json;

use crate::failure::Failure;
use crate::output::Output;
use crate::{talk, text};

const EXAMPLES: &str = "Examples:
  sbgc ports
  sbgc ports --json";

/// List serial ports
///
/// Likely ports come first: boards are USB serial devices. Pseudo-terminals and on-board UARTs may not be listed, but
/// can be opened.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Ports {}

impl Ports {
    #[allow(clippy::unused_self, reason = "commands are alike")]
    pub(crate) fn run(self, output: &mut Output) -> Result<(), Failure> {
        let ports = ports();
        let width = ports.iter().map(|port| port.name.chars().count()).max().unwrap_or_default();
        for port in &ports {
            if output.is_json() {
                output.object(&json!({
                    "port": port.name,
                    "kind": kind(port),
                    "description": port.product,
                    "likely": is_likely(port),
                }))?;
            } else {
                let product =
                    port.product.as_deref().map_or(String::new(), |name| text::escape(name).into_owned());
                let by_id = port.by_id.as_deref().unwrap_or_default();
                let likely = if is_likely(port) { "likely" } else { "" };
                let line =
                    format!("{:<width$}  {:<9}  {likely:<6}  {product}  {by_id}", port.name, kind(port));
                output.line(line.trim_end())?;
            }
        }
        if ports.is_empty() {
            talk::say("no serial ports found; check that the board is plugged in and powered");
        }
        Ok(())
    }
}

fn kind(port: &PortInfo) -> &'static str {
    match port.kind {
        PortKind::Usb => "usb",
        PortKind::Bluetooth => "bluetooth",
        PortKind::Other => "other",
    }
}

/// Whether a board may be there.
pub(super) fn is_likely(port: &PortInfo) -> bool {
    port.kind == PortKind::Usb
}
