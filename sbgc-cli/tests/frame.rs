//! What holds for all commands: errors, output, configuration, questions, signals, help.
#![cfg(unix)]

mod common;

use std::fs::{self, File};
use std::io::{Read as _, Write as _};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::{Board, all_commands, objects, run, run_with_input, sbgc, stderr, stdout};
use serde_json::Value;

/// The error that a program reads.
fn error(output: &std::process::Output) -> Value {
    let text = stderr(output);
    let value: Value =
        serde_json::from_str(text.trim()).unwrap_or_else(|_| panic!("one line of JSON: {text}"));
    assert_eq!(text.lines().count(), 1, "{text}");
    let error = value["error"].clone();
    let keys: Vec<_> = error.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["kind", "message", "code"]);
    assert_eq!(error["code"].as_i64().unwrap(), i64::from(output.status.code().unwrap()));
    assert!(!error["message"].as_str().unwrap().is_empty());
    error
}

#[test]
fn errors_are_json_where_json_was_asked_for() {
    for (arguments, kind, code, part) in [
        (&["--json", "ifno"][..], "usage", 2, "info"),
        (&["stream", "--intervall", "5", "--json"], "usage", 2, "--interval"),
        (&["--json", "--port", "sim", "control", "angle", "--pitch", "1000"], "usage", 2, "1000"),
        (&["--json"], "usage", 2, "command"),
        (&["--json", "--port", "/dev/ttyNOWHERE7", "info"], "port", 1, "ttyNOWHERE7"),
        (&["--json", "--port", "tcp://nowhere", "info"], "usage", 2, "tcp://nowhere"),
        (&["--json", "decode", "/nonexistent/file"], "file", 1, "/nonexistent/file"),
        (&["--json", "stream", "--csv", "--port", "sim"], "usage", 2, "--csv"),
    ] {
        let output = run(arguments);
        let error = error(&output);
        assert_eq!(
            (error["kind"].as_str(), error["code"].as_i64()),
            (Some(kind), Some(code)),
            "{arguments:?}"
        );
        assert!(error["message"].as_str().unwrap().contains(part), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}

#[test]
fn misspelled_names_get_the_nearest_real_ones() {
    for (arguments, nearest) in [
        (&["strem"][..], "stream"),
        (&["stream", "custom", "--data", "IMU_ANGELS"], "IMU_ANGLES"),
        (&["stream", "atitude"], "attitude"),
        (&["stream", "--fields", "imu_angels.roll"], "imu_angles.roll"),
        (&["events", "motor-stat"], "MOTOR_STATE"),
        (&["man", "detec"], "detect"),
    ] {
        let output = sbgc().env("SBGC_PORT", "sim").args(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(nearest), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn output_that_cannot_be_written_is_an_error() {
    for arguments in [
        &["--help"][..],
        &["--version"],
        &["info", "--help"],
        &["--port", "sim", "info"],
        &["config", "--json"],
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = sbgc().args(arguments).stdout(full).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(stderr(&output).contains("standard output"), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn standard_error_that_nobody_can_read_changes_nothing() {
    let program = env!("CARGO_BIN_EXE_sbgc");
    for (redirect, arguments, code) in [
        ("2>/dev/full", "--port sim -vv info", 0),
        ("2>&-", "--port sim -vv info", 0),
        ("2>/dev/full", "--port sim nonsense", 2),
        ("2>&-", "--port sim nonsense", 2),
        ("2>/dev/full", "--port /dev/ttyNOWHERE7 info", 1),
        ("2>&-", "--json --port /dev/ttyNOWHERE7 info", 1),
    ] {
        let status = Command::new("sh")
            .args(["-c", &format!("exec {program} {arguments} {redirect}")])
            .env("XDG_CONFIG_HOME", "/nonexistent")
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(code), "{arguments} {redirect}");
    }
}

#[test]
fn settings_come_from_option_environment_file_and_default() {
    let home = tempfile::tempdir().unwrap();
    fs::create_dir(home.path().join("sbgc")).unwrap();
    let file = home.path().join("sbgc/config.toml");
    fs::write(&file, "# mine\nport = \"sim\"\nbaud = 57600\ntimeout = \"0.7s\"\n").unwrap();
    let in_home = || {
        let mut command = sbgc();
        command.env("XDG_CONFIG_HOME", home.path());
        command
    };
    let output =
        in_home().env("SBGC_BAUD", "9600").args(["config", "--json", "--timeout", "2s"]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let settings = objects(&output);
    let setting = |name: &str| settings.iter().find(|setting| setting["name"] == name).unwrap().clone();
    let all = |name: &str| {
        let setting = setting(name);
        assert_eq!(
            setting.as_object().unwrap().keys().collect::<Vec<_>>(),
            ["name", "value", "source", "place"]
        );
        [setting["value"].clone(), setting["source"].clone(), setting["place"].clone()]
    };
    let place = format!("{}:2", file.display());
    assert_eq!(all("port"), ["sim".into(), "file".into(), Value::from(place)]);
    assert_eq!(all("baud"), ["9600", "environment", "SBGC_BAUD"].map(Value::from));
    assert_eq!(all("timeout"), ["2s", "option", "--timeout"].map(Value::from));
    assert_eq!(all("parity"), ["none".into(), "default".into(), Value::Null]);
    // The file is really used.
    assert!(in_home().arg("angles").output().unwrap().status.success());

    for (content, parts) in [
        ("port = \"sim\"\nbuad = 5\n", ["config.toml:2", "\"buad\"", "baud"]),
        ("\n\nbaud = \"fast\"\n", ["config.toml:3", "baud", "fast"]),
        ("port = \n", ["config.toml:1", "", ""]),
    ] {
        fs::write(&file, content).unwrap();
        let output = in_home().arg("info").output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{content}");
        for part in parts {
            assert!(stderr(&output).contains(part), "{part:?} is not in: {}", stderr(&output));
        }
    }
    let output = sbgc().env("SBGC_TIMEOUT", "soon").args(["--port", "sim", "info"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("SBGC_TIMEOUT") && stderr(&output).contains("200ms"),
        "{}",
        stderr(&output)
    );
}

/// A recording with a command that is asked about, and one that is not.
const DANGEROUS: &[u8] = b"0.0 out: [77,0]\n0.1 out: [36,2] 0000\n";

#[test]
fn without_a_terminal_nothing_dangerous_is_done_unconfirmed() {
    let replay = ["--port", "sim", "replay", "-"];
    let output = run_with_input(&replay, DANGEROUS);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("CMD_SERVO_OUT") && stderr(&output).contains("--yes"),
        "{}",
        stderr(&output)
    );
    assert!(output.stdout.is_empty());
    let output = run_with_input(&["--port", "sim", "--yes", "replay", "-", "--json"], DANGEROUS);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let outcome = objects(&output).pop().unwrap();
    assert_eq!((outcome["command"].as_str(), outcome["state"].as_str()), (Some("replay"), Some("done")));
}

#[test]
fn a_dry_run_prints_frames_and_sends_nothing() {
    let output = run_with_input(&["--dry-run", "--yes", "replay", "-", "--json"], DANGEROUS);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let frames = objects(&output);
    assert_eq!(frames.len(), 2);
    assert_eq!(frames[0]["name"], "CMD_MOTORS_ON");
    assert_eq!(frames[0]["id"], 77);
    assert!(frames[0]["frame"].as_str().unwrap().starts_with("244d004d"), "{}", frames[0]);
    let output = run(&["--port", "sim", "--dry-run", "motors", "on"]);
    assert!(stdout(&output).starts_with("24 4D 00 4D"), "{}", stdout(&output));
}

/// Answers the question of a program on a terminal and returns its exit code.
fn answered(answer: &[u8]) -> i32 {
    use std::os::unix::fs::OpenOptionsExt as _;

    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("dangerous.log");
    fs::write(&file, DANGEROUS).unwrap();
    let (mut master, name) = common::terminal();
    // Not as its controlling terminal.
    let terminal = || File::options().read(true).write(true).custom_flags(0o400).open(&name).unwrap();
    let mut child = sbgc()
        .args(["--port", "sim", "replay"])
        .arg(&file)
        .stdin(terminal())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut talk = child.stderr.take().unwrap();
    let (mut asked, mut piece) = (String::new(), [0; 256]);
    while !asked.contains("[y/N]") {
        let length = talk.read(&mut piece).unwrap();
        assert!(length > 0, "it asks: {asked}");
        asked.push_str(std::str::from_utf8(&piece[..length]).unwrap());
    }
    assert!(asked.contains("CMD_SERVO_OUT"), "what would happen is shown: {asked}");
    if answer == b"interrupt" {
        common::signal(child.id(), "INT");
    } else {
        master.write_all(answer).unwrap();
    }
    std::thread::spawn(move || std::io::copy(&mut talk, &mut std::io::sink()));
    child.wait().unwrap().code().unwrap()
}

#[test]
fn only_yes_is_yes() {
    assert_eq!(answered(b"y\n"), 0);
    for no in [&b"\n"[..], b"n\n", b"\x04", b"perhaps\n", b"interrupt"] {
        assert_eq!(answered(no), 5, "{no:?}");
    }
}

#[test]
fn signals_end_a_command_with_their_number() {
    for (signal, code) in [("INT", 130), ("TERM", 143), ("HUP", 129), ("QUIT", 131)] {
        // A terminal that nobody answers on, so the command waits.
        let (master, name) = common::terminal();
        let mut child = sbgc()
            .args(["--port", &name, "--timeout", "20s", "-v", "info"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut piece = [0; 64];
        // The handlers are there before anything is printed.
        assert!(child.stderr.as_mut().unwrap().read(&mut piece).unwrap() > 0);
        common::signal(child.id(), signal);
        assert_eq!(child.wait().unwrap().code(), Some(code), "{signal}");
        drop(master);
    }
}

#[test]
fn a_signal_right_after_the_first_line_leaves_no_link() {
    for round in 0..10 {
        for signal in ["TERM", "INT", "HUP", "QUIT"] {
            let board = Board::start();
            let link = board.link();
            board.signal(signal);
            let (code, directory) = board.wait();
            assert!(link.symlink_metadata().is_err(), "round {round}, {signal}");
            assert_eq!(code, if signal == "QUIT" { 131 } else { 0 }, "{signal}");
            drop(directory);
        }
    }
}

#[test]
fn every_help_fits_a_page_and_has_examples() {
    let help = |path: &[String], width: &str| {
        let output = sbgc().args(path).arg("--help").env("COLUMNS", width).output().unwrap();
        assert!(output.status.success(), "{path:?}");
        stdout(&output)
    };
    let is_example = |line: &&str| line.starts_with("  sbgc ");
    let mut all = all_commands();
    all.push(Vec::new());
    for path in &all {
        for width in ["60", "72", "80"] {
            let text = help(path, width);
            let lines = text.lines().count();
            assert!(lines <= 60, "{path:?} has {lines} lines in {width} columns:\n{text}");
            for line in text.lines().filter(|line| !is_example(line)) {
                let columns: usize = width.parse().unwrap();
                assert!(line.chars().count() <= columns, "{path:?} in {width} columns: {line}");
            }
        }
        let text = help(path, "80");
        for option in [
            "--port <",
            "--baud <",
            "--parity <",
            "--protocol <",
            "--timeout <",
            "--json  ",
            "--yes  ",
            "--dry-run  ",
            "--color <",
        ] {
            assert_eq!(text.contains(option), path.is_empty(), "{path:?}: {option} is explained once");
        }
        if path.is_empty() {
            continue;
        }
        assert_eq!(text.matches("see sbgc --help").count(), 1, "{path:?}");
        let examples: Vec<_> = text.lines().filter(is_example).collect();
        assert!((2..=3).contains(&examples.len()), "{path:?} has {} examples:\n{text}", examples.len());
        // They can be copied from a terminal of 80 columns.
        assert!(examples.iter().all(|example| example.len() <= 80), "{path:?}: {examples:?}");
    }
}

#[test]
fn completions_and_the_manual_cover_every_command() {
    let directory = tempfile::tempdir().unwrap();
    let pages = directory.path().join("man1");
    assert!(run(&["man", "--dir", pages.to_str().unwrap()]).status.success());
    for path in all_commands() {
        let page = pages.join(format!("sbgc-{}.1", path.join("-")));
        assert!(fs::read_to_string(&page).unwrap().contains(".SH NAME"), "{}", page.display());
    }
    let page = stdout(&run(&["man", "stream"]));
    assert!(page.contains(".SH NAME") && page.contains("interval"), "{page}");
    for shell in ["bash", "zsh", "fish"] {
        let script = stdout(&run(&["completions", shell]));
        assert!(script.contains("sbgc") && script.contains("COMPLETE"), "{shell}: {script}");
    }
    // What the shell's script does when a word is to be completed.
    let complete = |words: &[&str]| {
        let output = sbgc().env("COMPLETE", "fish").args(["--", "sbgc"]).args(words).output().unwrap();
        stdout(&output)
    };
    assert!(complete(&["str"]).contains("stream"), "{}", complete(&["str"]));
    for (words, completed) in [
        (&["--port", "si"][..], "sim:"),
        (&["--port", "tcp"], "tcp://"),
        (&["params", "get", "rc_mem"], "rc_memory.pitch"),
        (&["params", "set", "servo_r"], "servo_rate"),
        (&["params", "describe", "motors.roll.p"], "motors.roll.poles"),
        (&["menu", "home"], "home"),
        (&["menu", "motor-t"], "motor-toggle"),
        (&["adj", "get", "P_RO"], "P_ROLL"),
        (&["encode", "BOARD_INFO"], "BOARD_INFO_3"),
        (&["send", "GET_A"], "GET_ANGLES_EXT"),
        (&["pin", "au"], "aux1"),
        (&["stream", "--data", "IMU_A"], "IMU_ANGLES"),
        (&["stream", "real"], "realtime3"),
        (&["control", "ang"], "angle"),
        (&["calibrate", "encoder"], "encoder-field-offset"),
    ] {
        let found = complete(words);
        assert!(found.contains(completed), "{words:?}: {found}");
    }
}

#[test]
fn the_first_byte_goes_out_soon() {
    let (mut master, name) = common::terminal();
    let began = Instant::now();
    let mut child =
        sbgc().args(["--port", &name, "info"]).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let mut byte = [0; 1];
    while master.read(&mut byte).unwrap_or(0) == 0 {
        assert!(began.elapsed() < Duration::from_secs(10), "something is sent");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    // The measure is 10 ms of an optimized program on a quiet machine; this one is neither.
    assert!(began.elapsed() < Duration::from_secs(2), "{:?}", began.elapsed());
}

/// But for examples, which are to be copied.
#[test]
fn help_fits_a_narrow_terminal() {
    for command in ["decode", "stream", "calibrate"] {
        let output = sbgc().args([command, "--help"]).env("COLUMNS", "30").output().unwrap();
        let help = stdout(&output);
        for line in help.lines().filter(|line| !line.starts_with("  sbgc ")) {
            let words = line.split_whitespace().count();
            assert!(line.chars().count() <= 30 || words == 1, "{command}: {line:?}");
        }
    }
}
