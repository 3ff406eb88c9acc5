//! Every example in the help of every command and in the README, as printed, against the simulated board.
#![cfg(unix)]

mod common;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use common::{all_commands, sbgc, stdout};

/// What runs until it is stopped; being interrupted is its usual end.
fn runs_on(line: &str) -> bool {
    let until_stopped =
        ["sbgc stream", "sbgc events", "sbgc proxy", "sbgc sim", "sbgc script trace", "sbgc record"];
    let last = line.rsplit("&&").next().unwrap_or(line).trim();
    let ends = last.contains("--count") || last.contains("--for");
    !ends && until_stopped.iter().any(|command| last.starts_with(command))
}

/// What needs a person at a terminal; tested elsewhere.
fn is_interactive(line: &str) -> bool {
    line.starts_with("sbgc monitor") || line.starts_with("sbgc control jog")
}

/// Runs a line with a shell; says what went wrong.
fn try_line(line: &str, directory: &Path) -> Result<(), String> {
    let program = Path::new(env!("CARGO_BIN_EXE_sbgc"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let end = if runs_on(line) { "timeout -s INT --preserve-status 3 " } else { "timeout -s INT 60 " };
    let script = line.replacen("sbgc ", &format!("{end}sbgc "), 1);
    let began = Instant::now();
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(directory)
        .env("PATH", path)
        .env("HOME", directory)
        .env("XDG_CONFIG_HOME", directory)
        .env("XDG_STATE_HOME", directory.join("state"))
        .env("SBGC_PORT", "sim")
        .env("SBGC_YES", "1")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let talk = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => Ok(()),
        code => Err(format!("{line}\n  ended with {code:?} after {:?}: {}", began.elapsed(), talk.trim())),
    }
}

fn try_all(lines: impl Iterator<Item = String>) {
    let lines: Vec<String> = lines.filter(|line| !is_interactive(line)).collect();
    let directory = tempfile::tempdir().unwrap();
    let failed: Vec<String> =
        lines.iter().filter_map(|line| try_line(line, directory.path()).err()).collect();
    assert!(failed.is_empty(), "{} of {} examples fail:\n{}", failed.len(), lines.len(), failed.join("\n"));
}

#[test]
fn examples_in_help_work_as_printed() {
    let mut lines = Vec::new();
    for path in all_commands() {
        let help = stdout(&sbgc().args(&path).arg("--help").env("COLUMNS", "200").output().unwrap());
        let examples =
            help.lines().filter(|line| line.starts_with("  sbgc ")).map(|line| line.trim().to_owned());
        for example in examples {
            if !lines.contains(&example) {
                lines.push(example);
            }
        }
    }
    assert!(lines.len() > 40, "{lines:?}");
    try_all(lines.into_iter());
}

#[test]
fn examples_in_the_readme_work_as_printed() {
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md")).unwrap();
    let mut lines = Vec::new();
    // Lines of shell blocks, and code in the tables.
    for (index, block) in readme.split("```").enumerate() {
        if index % 2 == 1 {
            let shell = block.strip_prefix("sh\n").into_iter().flat_map(str::lines);
            let ours = shell.map(|line| line.replace("cargo run --release -- ", "sbgc "));
            lines.extend(ours.filter(|line| line.starts_with("sbgc ") || line.starts_with("printf ")));
        } else {
            let rows = block.lines().filter(|line| line.starts_with("| `sbgc "));
            let code = rows.flat_map(|row| row.split('`').skip(1).step_by(2));
            lines.extend(code.filter(|code| code.starts_with("sbgc ")).map(str::to_owned));
        }
    }
    assert!(lines.len() > 10, "{lines:?}");
    try_all(lines.into_iter().map(|line| line.split("  #").next().unwrap_or_default().trim().to_owned()));
}

#[test]
fn what_runs_until_it_is_stopped_is_known() {
    assert!(runs_on("sbgc stream") && !runs_on("sbgc stream --count 3"));
    assert!(!runs_on("sbgc record a.log --for 1s && sbgc replay a.log"));
}
