//! Options that all commands share, and where each gets its value from: the command line, the environment, the
//! configuration file, or a default.

use std::fmt;
use std::time::Duration;

use clap::{Args, ValueEnum};
use clap_complete::engine::{ArgValueCandidates, CompletionCandidate};
use sbgc_host::transport::{self, Address, ports};
use sbgc_host::{ConnectOptions, Options, VersionChoice};
use sbgc_proto::frame::Version;

use crate::config_file::ConfigFile;
use crate::failure::Failure;
use crate::{text, values};

/// The shared options as they are typed. `sbgc --help` explains them; other help names them in one line.
#[derive(Args, Debug)]
pub(crate) struct Common {
    /// Device, tcp:// or udp://HOST:PORT, sim, sim:FILE
    #[arg(long, short, global = true, hide = true, value_name = "PORT", add = ArgValueCandidates::new(port_candidates))]
    port: Option<String>,

    /// Baud rate, or auto [default: 115200]
    #[arg(long, global = true, hide = true, value_name = "N", value_parser = baud)]
    baud: Option<Baud>,

    /// none, even or auto [default: none]
    #[arg(long, global = true, hide = true, value_name = "P", value_enum, hide_possible_values = true)]
    parity: Option<Parity>,

    /// 1, 2 or auto [default: auto]
    #[arg(long, global = true, hide = true, value_name = "V", value_enum, hide_possible_values = true)]
    protocol: Option<Protocol>,

    /// Wait for an answer [default: 500ms]
    #[arg(long, global = true, hide = true, value_name = "TIME", value_parser = values::timeout)]
    timeout: Option<Duration>,

    /// Print JSON Lines, errors too
    #[arg(long, global = true, hide = true)]
    json: bool,

    /// Answer yes to questions
    #[arg(long, short, global = true, hide = true)]
    yes: bool,

    /// Print the frames, change nothing
    #[arg(long, global = true, hide = true)]
    dry_run: bool,

    /// Log the link; -vv: every frame
    #[arg(long, short, global = true, hide = true, action = clap::ArgAction::Count)]
    verbose: u8,

    /// auto, always, never [default: auto]
    #[arg(long, global = true, hide = true, value_name = "WHEN", value_enum, hide_possible_values = true)]
    color: Option<Color>,
}

/// The shared options with all sources taken into account.
#[derive(Debug)]
pub(crate) struct Global {
    pub(crate) port: Option<String>,
    pub(crate) baud: Baud,
    pub(crate) parity: Parity,
    pub(crate) protocol: Protocol,
    pub(crate) timeout: Duration,
    pub(crate) json: bool,
    pub(crate) yes: bool,
    pub(crate) dry_run: bool,
    pub(crate) verbose: u8,
    pub(crate) color: Color,
    /// Each option with its source.
    pub(crate) settings: Vec<Setting>,
    /// The whole command line interface, for what describes it.
    pub(crate) interface: fn() -> clap::Command,
}

impl Global {
    /// How a board is looked for. What takes a time that is typed takes it for each combination as well.
    pub(crate) fn connect_options(&self) -> ConnectOptions {
        let version = match self.protocol {
            Protocol::Auto => VersionChoice::Auto,
            Protocol::V1 => VersionChoice::Only(Version::V1),
            Protocol::V2 => VersionChoice::Only(Version::V2),
        };
        let auto = self.baud == Baud::Auto || self.parity == Parity::Auto;
        ConnectOptions {
            baud: match self.baud {
                Baud::Auto => None,
                Baud::Rate(rate) => Some(rate),
            },
            parity: match self.parity {
                Parity::Auto => None,
                Parity::None => Some(transport::Parity::None),
                Parity::Even => Some(transport::Parity::Even),
            },
            link: Options { version, timeout: self.timeout, ..Options::default() },
            patience: Some(self.timeout).filter(|_| auto && !self.is_default("timeout")),
            ..ConnectOptions::default()
        }
    }

    /// Whether an option has its default, not a value that somebody chose.
    pub(crate) fn is_default(&self, name: &str) -> bool {
        let setting = self.settings.iter().find(|setting| setting.name == name);
        setting.is_some_and(|setting| setting.source == "default")
    }
}

/// One option, its value and where that comes from.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    pub(crate) name: &'static str,
    pub(crate) value: Option<String>,
    /// `option`, `environment`, `file` or `default`.
    pub(crate) source: &'static str,
    /// The name of the option or variable, or file and line.
    pub(crate) place: Option<String>,
}

/// Bits per second of a serial port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Baud {
    /// Whichever the board answers at.
    Auto,
    Rate(u32),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Parity {
    None,
    Even,
    /// Whichever the board answers with
    Auto,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Protocol {
    /// Whichever the board speaks
    Auto,
    /// Version 1, for firmware before 2.68
    #[value(name = "1")]
    V1,
    /// Version 2
    #[value(name = "2")]
    V2,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    Always,
    Never,
}

impl Color {
    /// Whether to use colors on something that is a terminal or not.
    pub(crate) fn is_on(self, terminal: bool) -> bool {
        let unwanted = || {
            let set = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
            set || std::env::var_os("TERM").is_some_and(|value| value == "dumb")
        };
        match self {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => terminal && !unwanted(),
        }
    }
}

/// The names of all shared options that have a value.
pub(crate) const NAMES: [&str; 10] =
    ["port", "baud", "parity", "protocol", "timeout", "json", "yes", "dry-run", "verbose", "color"];

impl Common {
    /// Settles what was typed with environment and file.
    pub(crate) fn settle(self, interface: fn() -> clap::Command) -> Result<Global, Failure> {
        let mut sources = Sources { file: ConfigFile::read(&NAMES)?, settings: Vec::new() };
        let json = sources.pick("json", self.json.then_some(true), false, boolean)?;
        Ok(Global {
            port: sources.pick("port", self.port.map(Port), Port(String::new()), port)?.given(),
            baud: sources.pick("baud", self.baud, Baud::Rate(115_200), baud)?,
            parity: sources.pick("parity", self.parity.map(Named), Named(Parity::None), named)?.0,
            protocol: sources.pick("protocol", self.protocol.map(Named), Named(Protocol::Auto), named)?.0,
            timeout: sources
                .pick("timeout", self.timeout.map(Time), Time(Duration::from_millis(500)), time)?
                .0,
            json,
            yes: sources.pick("yes", self.yes.then_some(true), false, boolean)?,
            dry_run: sources.pick("dry-run", self.dry_run.then_some(true), false, boolean)?,
            verbose: sources.pick("verbose", (self.verbose > 0).then_some(self.verbose), 0, verbosity)?,
            color: sources.pick("color", self.color.map(Named), Named(Color::Auto), named)?.0,
            settings: sources.in_order(),
            interface,
        })
    }
}

impl Global {
    /// The version in which frames are built where no board says which it speaks.
    pub(crate) fn version(&self) -> Version {
        if self.protocol == Protocol::V1 { Version::V1 } else { Version::V2 }
    }
}

/// The environment variable of an option.
pub(crate) fn variable(name: &str) -> String {
    format!("SBGC_{}", name.to_ascii_uppercase().replace('-', "_"))
}

struct Sources {
    file: ConfigFile,
    settings: Vec<Setting>,
}

impl Sources {
    fn in_order(mut self) -> Vec<Setting> {
        self.settings.sort_by_key(|setting| NAMES.iter().position(|name| *name == setting.name));
        self.settings
    }

    fn pick<T: fmt::Display>(
        &mut self,
        name: &'static str,
        option: Option<T>,
        default: T,
        parse: fn(&str) -> Result<T, String>,
    ) -> Result<T, Failure> {
        let variable = variable(name);
        let environment = std::env::var_os(&variable).filter(|value| !value.is_empty());
        let environment = environment.map(|value| value.to_string_lossy().into_owned());
        let parse_at = |place: &str, value: &str| {
            parse(value).map_err(|error| {
                Failure::Usage(format!("{place}: invalid value \"{}\": {error}", text::escape(value)))
            })
        };
        // A mistake in the file is reported also where something else takes precedence.
        let file = match self.file.get(name) {
            Some((text, place)) => Some((parse_at(&format!("{place}: {name}"), text)?, place)),
            None => None,
        };
        let (value, source, place) = if let Some(value) = option {
            (value, "option", Some(format!("--{name}")))
        } else if let Some(text) = environment {
            (parse_at(&variable, &text)?, "environment", Some(variable))
        } else if let Some((value, place)) = file {
            (value, "file", Some(place))
        } else {
            (default, "default", None)
        };
        let text = Some(value.to_string()).filter(|text| !text.is_empty());
        self.settings.push(Setting { name, value: text, source, place });
        Ok(value)
    }
}

/// A port; empty when none was given.
struct Port(String);
struct Time(Duration);
struct Named<T>(T);

impl Port {
    fn given(self) -> Option<String> {
        Some(self.0).filter(|port| !port.is_empty())
    }
}

impl fmt::Display for Port {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&values::time_text(self.0))
    }
}

impl<T: ValueEnum> fmt::Display for Named<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.to_possible_value().as_ref().map_or("", |value| value.get_name()))
    }
}

impl fmt::Display for Baud {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Baud::Auto => f.write_str("auto"),
            Baud::Rate(rate) => write!(f, "{rate}"),
        }
    }
}

fn port(text: &str) -> Result<Port, String> {
    text.parse::<Address>().map_err(|error| error.to_string())?;
    Ok(Port(text.to_owned()))
}

fn baud(text: &str) -> Result<Baud, String> {
    if text.eq_ignore_ascii_case("auto") {
        return Ok(Baud::Auto);
    }
    match text.parse() {
        Ok(rate @ 300..=4_000_000) => Ok(Baud::Rate(rate)),
        _ => Err(String::from("expected 300 to 4000000 bits per second, or auto")),
    }
}

fn time(text: &str) -> Result<Time, String> {
    values::timeout(text).map(Time)
}

fn verbosity(text: &str) -> Result<u8, String> {
    text.parse().map_err(|_| String::from("expected a number of 0 to 255"))
}

fn boolean(text: &str) -> Result<bool, String> {
    match text.to_ascii_lowercase().as_str() {
        "1" | "true" | "yes" | "on" => Ok(true),
        "0" | "false" | "no" | "off" => Ok(false),
        _ => Err(String::from("expected true or false")),
    }
}

fn named<T: ValueEnum>(text: &str) -> Result<Named<T>, String> {
    T::from_str(text, true).map(Named).map_err(|_| {
        let names: Vec<_> = T::value_variants().iter().filter_map(ValueEnum::to_possible_value).collect();
        let names: Vec<_> = names.iter().map(clap::builder::PossibleValue::get_name).collect();
        format!("expected {}", text::join(&names, "or"))
    })
}

/// Ports to offer when a shell completes `--port`.
fn port_candidates() -> Vec<CompletionCandidate> {
    let listed = ports().into_iter().map(|port| {
        let help = port.product.clone().map(|product| text::escape(&product).into_owned().into());
        CompletionCandidate::new(port.name).help(help)
    });
    listed.chain(["sim", "sim:", "tcp://", "udp://"].map(CompletionCandidate::new)).collect()
}
