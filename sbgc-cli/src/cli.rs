//! The command line as a whole: what is accepted, what help says, and how mistakes are reported.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{self, IsTerminal as _, Write as _};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Arg, ArgAction, Args as _, CommandFactory as _, FromArgMatches as _, Parser};
use serde_json::json;

use crate::commands::{self, Command};
use crate::failure::Failure;
use crate::options::{Color, Common, Global, variable};
use crate::{talk, text};

#[derive(Debug, Parser)]
#[command(name = "sbgc", about = ABOUT, version, arg_required_else_help = true)]
#[command(disable_help_subcommand = true, max_term_width = 120)]
struct Arguments {
    #[command(subcommand)]
    command: Command,

    #[command(flatten)]
    common: Common,
}

/// The first line of help.
const ABOUT: &str = "Configure, move, watch and record SimpleBGC32 camera gimbals";

/// The last line of the help of each command.
const ELSEWHERE: &str = "Common options (--port, --json, --yes, --dry-run, ...): see sbgc --help";

const EXIT_CODES: &str = "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 no answer from a board, 4 refused by the \
    board, 5 not confirmed";

/// Reads the arguments.
///
/// # Errors
/// If there is nothing to carry out: what was to be said is said, and this is the exit code.
pub(crate) fn parse() -> Result<(Command, Global), ExitCode> {
    let words: Vec<OsString> = std::env::args_os().collect();
    let parsed = interface()
        .try_get_matches_from(&words)
        .and_then(|mut matches| Arguments::from_arg_matches_mut(&mut matches));
    match parsed {
        Ok(Arguments { command, common }) => match common.settle(interface) {
            Ok(global) => Ok((command, global)),
            Err(failure) => Err(failure.report(wants_json(&words))),
        },
        Err(error) => Err(end(&error, wants_json(&words), &words)),
    }
}

/// All that the command line accepts, with its help.
pub(crate) fn interface() -> clap::Command {
    let mut interface = compact(Arguments::command());
    let names: Vec<String> =
        interface.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    for name in names {
        let full = format!("sbgc {name}");
        interface = interface.mut_subcommand(name, |command| helpful(command, &full));
    }
    interface.help_template(front_page())
}

/// One page of help for `-h` and `--help` alike, without empty lines between the options.
fn compact(command: clap::Command) -> clap::Command {
    let help = Arg::new("help").short('h').long("help").action(ArgAction::HelpShort).help("Print help");
    command.disable_help_flag(true).disable_help_subcommand(true).arg(help)
}

/// The help of a command and of its own commands: what it does in full, and where the common options are explained.
/// `name` is the command with those before it.
fn helpful(command: clap::Command, name: &str) -> clap::Command {
    let names: Vec<String> = command.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let command = names.into_iter().fold(compact(command), |command, own| {
        let full = format!("{name} {own}");
        command.mut_subcommand(own, |command| helpful(command, &full))
    });
    let width = text::width();
    let about = command.get_long_about().or(command.get_about()).map(ToString::to_string).unwrap_or_default();
    let mut after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    if !after.is_empty() {
        after.push_str("\n\n");
    }
    after.push_str(ELSEWHERE);
    // Usage is not wrapped by the library.
    let usage = command.clone().bin_name(name).render_usage().to_string();
    let usage = text::wrap(usage.trim_start_matches("Usage:"), width.saturating_sub(USAGE));
    let template = format!(
        "{}\n\n{{usage-heading}} {}\n\n{{all-args}}\n\n{}\n",
        wrapped(&about, width),
        usage.join(&format!("\n{:USAGE$}", "")),
        wrapped(&after, width),
    );
    // Beside a long option there would be no room for its explanation.
    command.help_template(template).next_line_help(width < NARROW)
}

/// Fewer columns than this are too few for two columns of text.
const NARROW: usize = 40;

/// Columns of `Usage: `.
const USAGE: usize = 7;

/// Text of several lines for this width; examples stay as they are, to be copied.
fn wrapped(text: &str, width: usize) -> String {
    let line = |line: &str| {
        if line.starts_with(' ') { line.to_owned() } else { text::wrap(line, width).join("\n") }
    };
    let lines: Vec<String> = text.lines().map(line).collect();
    lines.join("\n")
}

/// What `sbgc --help` shows: all commands by group, and the options of all of them.
fn front_page() -> String {
    let width = text::width();
    let mut page = format!("{}\n\n{{usage-heading}} {{usage}}\n\n", text::wrap(ABOUT, width).join("\n"));
    let groups = commands::groups();
    let about = |command: &clap::Command| command.get_about().map(ToString::to_string).unwrap_or_default();
    let longest = |lengths: &mut dyn Iterator<Item = usize>| lengths.max().unwrap_or_default();
    let left = longest(&mut groups.iter().map(|(heading, _)| heading.len()));
    let middle = longest(
        &mut groups
            .iter()
            .flat_map(|(_, group)| group.get_subcommands())
            .map(|command| command.get_name().len()),
    );
    let abouts =
        groups.iter().flat_map(|(_, group)| group.get_subcommands()).map(|command| about(command).len());
    // A narrow terminal has no room for the groups.
    let left = if left + middle + 4 + longest(&mut abouts.into_iter()) > width { 0 } else { left + 2 };
    let indent = left + middle + 2;
    for (heading, group) in &groups {
        let mut heading = if left == 0 { "" } else { heading };
        for command in group.get_subcommands() {
            let lines = text::wrap(&about(command), width.saturating_sub(indent).max(16));
            let first = format!("{heading:<left$}{:<middle$}  ", command.get_name());
            page.push_str(&first);
            page.push_str(&lines.join(&format!("\n{:indent$}", "")));
            page.push('\n');
            heading = "";
        }
    }
    let mut options = Common::augment_args(compact(clap::Command::new("sbgc").version("0")))
        .mut_args(|argument| argument.hide(false))
        .term_width(width)
        .help_template("{options}");
    let _ = writeln!(page, "\nOptions of all commands:\n{}", options.render_help().to_string().trim_end());
    for line in text::wrap(EXIT_CODES, width) {
        page.push_str(&line);
        page.push('\n');
    }
    page.push_str("Example: sbgc --port sim info");
    page
}

/// Whether errors are to be JSON, as far as that can be told when the arguments are wrong.
fn wants_json(words: &[OsString]) -> bool {
    let typed = words.iter().take_while(|word| *word != "--").any(|word| word == "--json");
    typed
        || std::env::var(variable("json"))
            .is_ok_and(|value| matches!(value.as_str(), "1" | "true" | "yes" | "on"))
}

/// The choice of colors, as far as that can be told before the arguments are read.
fn color(words: &[OsString]) -> Color {
    let mut words = words.iter().filter_map(|word| word.to_str());
    let chosen = words.by_ref().find_map(|word| match word.strip_prefix("--color=") {
        Some(choice) => Some(choice.to_owned()),
        None if word == "--color" => Some(String::new()),
        None => None,
    });
    let chosen =
        chosen.map(|choice| if choice.is_empty() { words.next().unwrap_or_default().into() } else { choice });
    match chosen.or_else(|| std::env::var(variable("color")).ok()).as_deref() {
        Some("always") => Color::Always,
        Some("never") => Color::Never,
        _ => Color::Auto,
    }
}

/// Prints help, the version, or what is wrong with the arguments.
fn end(error: &clap::Error, json: bool, words: &[OsString]) -> ExitCode {
    let rendered = error.render();
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            let mut out = io::stdout();
            let printed = if color(words).is_on(out.is_terminal()) {
                write!(out, "{}", rendered.ansi())
            } else {
                write!(out, "{rendered}")
            };
            match printed.and_then(|()| out.flush()) {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => Failure::Output(error).report(json),
            }
        }
        kind if json => {
            let text = rendered.to_string();
            let message = if kind == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
                "a command is missing; see --help"
            } else {
                let end = text.find("\n\nUsage:").or_else(|| text.find("\n\nFor more information"));
                let text = text.get(..end.unwrap_or(text.len())).unwrap_or_default();
                text.strip_prefix("error: ").unwrap_or(text).trim()
            };
            let message = text::escape_lines(message);
            let error = json!({"error": {"kind": "usage", "message": message, "code": 2}});
            talk::say(text::json(&error));
            ExitCode::from(2)
        }
        _ => {
            if color(words).is_on(io::stderr().is_terminal()) {
                talk::print(rendered.ansi());
            } else {
                talk::print(text::escape_lines(&rendered.to_string()));
            }
            ExitCode::from(2)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interface_is_consistent() {
        interface().debug_assert();
    }
}
