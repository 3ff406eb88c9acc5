//! Mistakes, as a person meets them: what is wrong, what would be right, and the exit code.

mod common;

use common::{run, stderr};

#[test]
fn wrong_usage_names_the_value_and_what_would_be_right() {
    for (arguments, expected) in [
        (&["--port", "sim", "params", "get", "servo_rate", "--profile", "9"][..], &["'9'", "1 to 5"][..]),
        (&["--port", "sim", "control", "angle", "--pitch", "abc"], &["'abc'", "--pitch", "degrees"]),
        (&["--port", "sim", "control", "angle", "--pitch", "1000"], &["'1000'", "-720"]),
        (&["--port", "sim", "control", "angle"], &["--pitch"]),
        (&["--port", "sim", "stream", "--data", "NONSENSE"], &["NONSENSE", "IMU_ANGLES"]),
        (&["--port", "sim", "stream", "--interval", "0"], &["--interval"]),
        (&["--port", "sim", "params", "get", "nonsense"], &["\"nonsense\""]),
        (&["--port", "tcp://nowhere", "info"], &["tcp://nowhere"]),
        (&["decode", "--from", "morse"], &["morse", "hex"]),
        (&["sim"], &["--pty"]),
    ] {
        let output = run(arguments);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        for part in expected {
            assert!(message.contains(part), "{arguments:?}: {part:?} is not in: {message}");
        }
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_port_that_does_not_exist_says_which_do() {
    let output = run(&["--port", "/dev/ttyNOWHERE7", "info"]);
    assert_eq!(output.status.code(), Some(1));
    let message = stderr(&output);
    assert!(message.contains("/dev/ttyNOWHERE7"), "{message}");
    assert!(message.contains("; available: "), "says which there are: {message}");
}

#[test]
fn refused_connections_are_said() {
    // Port 9 of the own machine: nobody listens there.
    let output = run(&["--port", "tcp://127.0.0.1:9", "info"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("127.0.0.1:9"), "{}", stderr(&output));
}

#[test]
fn help_shows_the_exit_codes() {
    let output = run(&["--help"]);
    assert!(output.status.success());
    assert!(common::stdout(&output).contains("3 no answer from a board"));
}

#[test]
fn what_cannot_be_waited_for_is_no_usage() {
    for (arguments, expected) in [
        (
            &["control", "angle", "--pitch", "1", "--wait", "--patience", "18446744073709551615"][..],
            "--patience",
        ),
        (&["--timeout", "18446744073709551615", "info"], "--timeout"),
        (&["--baud", "0", "info"], "--baud"),
        (&["stream", "--count", "0"], "--count"),
        (&["control", "angle", "--pitch", "1", "--speed", "-5"], "0.122 to 4000 deg/s"),
        (&["sim", "--tcp", "nowhere"], "127.0.0.1:4001"),
    ] {
        let output = common::sbgc().env("SBGC_PORT", "sim").args(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(expected), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn a_place_that_does_not_fit_is_named_once() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("file");
    std::fs::write(&file, "kept").unwrap();
    let path = file.to_str().unwrap();
    for arguments in [&["--port", path, "info"][..], &["sim", "--pty", "--link", path]] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(1));
        assert_eq!(stderr(&output).matches(path).count(), 1, "{}", stderr(&output));
    }
    assert_eq!(std::fs::read(&file).unwrap(), b"kept");
}

#[test]
fn a_board_that_refuses_is_told_from_one_that_is_silent() {
    // 251 bytes of data: with its frame that is more than the board's buffer.
    let data = "SYSTEM_POWER_STATE,RC_CHANNELS,Z_VECTOR_H_VECTOR,SCRIPT_VARS_FLOAT,SCRIPT_VARS_INT16,\
                AHRS_DEBUG_INFO,EXT_TARGET_LIMIT,RC_DATA,ENCODER_RAW24,IMU_ANGLES_RAD";
    let output = run(&["--port", "sim", "stream", "--data", data]);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let message = stderr(&output);
    assert!(message.contains("CMD_REALTIME_DATA_CUSTOM: the board refused with error "), "{message}");
}

#[test]
fn help_has_examples() {
    for command in ["stream", "params", "decode", "encode", "sim"] {
        let help = run(&[command, "--help"]);
        assert!(common::stdout(&help).contains("Examples:\n  "), "{command}");
    }
}

#[test]
fn delays_that_the_board_cannot_count_are_refused() {
    for command in ["reset", "boot"] {
        let output = run(&["--port", "sim", "--yes", command, "--delay", "66s"]);
        assert_eq!(output.status.code(), Some(2), "{command}");
        assert!(
            stderr(&output).contains("66s is out of range; expected 1ms to 65535ms"),
            "{}",
            stderr(&output)
        );
    }
}

#[test]
fn mistakes_in_the_configuration_are_found_whatever_takes_precedence() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("sbgc/config.toml");
    std::fs::create_dir(home.path().join("sbgc")).unwrap();
    for (content, expected) in [
        (&b"\nbaud = \"fast\"\n"[..], ":2: baud: invalid value \"fast\""),
        (b"port = \"\"\n", ":1: port: invalid value \"\""),
        (b"port = \"http://gimbal:1\"\n", ":1: port: "),
        (b"# gimbal\n# \xFF\n", ":2: not UTF-8 text"),
    ] {
        std::fs::write(&file, content).unwrap();
        let mut command = common::sbgc();
        command.env("XDG_CONFIG_HOME", home.path());
        let output = command.args(["--port", "sim", "--baud", "57600", "angles"]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{expected}");
        let message = stderr(&output);
        assert!(message.contains(expected) && message.contains("config.toml"), "{message}");
    }
}

#[test]
#[cfg(unix)]
fn variables_that_are_not_text_are_not_passed_over() {
    use std::os::unix::ffi::OsStrExt as _;

    let name = std::ffi::OsStr::from_bytes(b"tcp://\xFF");
    let output = common::sbgc().env("SBGC_PORT", name).arg("info").output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("SBGC_PORT"), "{}", stderr(&output));
}

#[test]
fn options_of_one_kind_of_simulated_port_do_not_go_with_the_other() {
    let link = ["sim", "--tcp", "127.0.0.1:0", "--link", "/nonexistent/link"];
    for arguments in [&link[..], &["sim", "--pty", "--shared"]] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
    }
}

/// Some of these have no end.
#[test]
#[cfg(unix)]
fn devices_are_not_read_for_ever() {
    for (arguments, code) in [
        (&["--port", "sim", "params", "dump", "/dev/full"][..], 1),
        (&["--port", "sim", "params", "dump", "/dev/null"], 0),
        (&["--port", "sim", "params", "diff", "/dev/zero"], 1),
        (&["--port", "sim", "params", "diff", "/dev/null"], 2),
        (&["--port", "sim", "script", "upload", "1", "/dev/zero", "--yes"], 1),
        (&["--port", "sim:/dev/zero", "info"], 1),
        (&["sim", "--pty", "--state", "/dev/full"], 1),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
    }
}

/// Not even where a program was asked to read it: it may be shown all the same.
#[test]
fn errors_hold_nothing_that_a_terminal_obeys() {
    for arguments in [
        &["--json", "--port", "/dev/\u{202E}\u{9B}x", "info"][..],
        &["--port", "/dev/\u{202E}\u{9B}x", "info"],
        &["--json", "encode", "READ_PARAMS", "profile_id=\u{2028}\u{1B}[31m"],
        &["--json", "info", "\u{202E}\u{9B}"],
        &["info", "\u{202E}\u{9B}"],
    ] {
        let output = run(arguments);
        let message = stderr(&output);
        let obeyed =
            |found: char| found != '\n' && (found.is_control() || "\u{2028}\u{202E}".contains(found));
        assert!(!message.contains(obeyed), "{arguments:?}: {message:?}");
        assert!(matches!(output.status.code(), Some(1 | 2)));
    }
}
