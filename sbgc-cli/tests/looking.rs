//! Finding the board, looking at it, and its traffic: the built program against the simulated board.
#![cfg(unix)]

mod common;

use std::fs;
use std::fs::File;
use std::io::{BufRead as _, Read as _, Write as _};
use std::process::Stdio;
use std::time::{Duration, Instant};

use common::{Board, objects, run, sbgc, stderr, stdout};
use serde_json::Value;

fn success(arguments: &[&str]) -> std::process::Output {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
    output
}

fn keys(object: &Value) -> Vec<&str> {
    object.as_object().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn ports_are_listed_with_their_keys() {
    for port in objects(&success(&["ports", "--json"])) {
        assert_eq!(keys(&port), ["port", "kind", "description", "likely"]);
        assert!(port["likely"].is_boolean() && port["port"].is_string());
    }
}

#[test]
fn a_board_is_detected_on_its_port() {
    let keys_wanted = ["port", "baud", "parity", "protocol", "found", "firmware", "reason"];
    let board = Board::start();
    // Parity cannot be seen on a pseudo-terminal, so the board answers with either, at its own rate alone.
    let answered = objects(&success(&["detect", "--port", &board.port(), "--timeout", "50ms", "--json"]));
    assert_eq!(answered.len(), 2, "{answered:?}");
    for (found, parity) in answered.iter().zip(["none", "even"]) {
        assert_eq!(keys(found), keys_wanted);
        assert_eq!((&found["found"], &found["baud"]), (&true.into(), &115_200.into()));
        assert_eq!((&found["parity"], &found["protocol"]), (&parity.into(), &2.into()));
        assert!(found["port"] == board.port() && found["reason"].is_null(), "{found}");
        assert!(found["firmware"].as_str().unwrap().starts_with("2."), "{found}");
    }
    let text = stdout(&success(&["detect", "--port", &board.port(), "--baud", "115200"]));
    let lines: Vec<_> = text.lines().collect();
    assert!(lines[0].contains("board 3.6, firmware 2.") && lines[0].contains("at 115200 baud, parity none"));
    assert!(lines[1].contains(": also at 115200 baud, parity even"), "{text}");
    let narrow = ["--baud", "115200", "--parity", "even", "--protocol", "2", "--json"];
    let one = objects(&success(&[&["detect", "--port", &board.port()][..], &narrow].concat()));
    assert_eq!(one.len(), 1, "{one:?}");
    let inside = objects(&success(&["detect", "--port", "sim", "--json"]));
    assert_eq!(inside.len(), 1);
    assert!(inside[0]["baud"].is_null() && inside[0]["parity"].is_null(), "{inside:?}");

    let (_master, silent) = common::terminal();
    let output = run(&["detect", "--port", &silent, "--baud", "9600", "--timeout", "20ms", "--json"]);
    assert_eq!(output.status.code(), Some(3));
    let tried = objects(&output);
    assert_eq!(keys(&tried[0]), keys_wanted);
    assert_eq!(tried[0]["found"], false);
    let reason = "no answer at 9600 baud, parity none and even (tried versions 1 and 2)";
    assert_eq!(tried[0]["reason"], reason);
    let output = run(&["detect", "--port", "/dev/ttyNOWHERE7", "--json"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let tried = objects(&output);
    assert_eq!((tried.len(), &tried[0]["found"]), (1, &false.into()));
    assert!(tried[0]["reason"].as_str().unwrap().contains("/dev/ttyNOWHERE7"), "{}", tried[0]);
    assert_eq!(run(&["detect", "--port", "tcp://nowhere"]).status.code(), Some(2));
}

#[test]
fn the_whole_board_is_shown() {
    let info = &objects(&success(&["--port", "sim", "info", "--json"]))[0];
    // Of CMD_BOARD_INFO, CMD_BOARD_INFO_3 and CMD_READ_STATE_VARS.
    for path in ["board_ver", "firmware_ver", "eeprom_size", "adj_vars_total_num", "work_time", "energy"] {
        assert!(!info[path].is_null(), "{path}: {info}");
    }
    assert!(info["device_id"].is_string() && info["reserved"].is_null(), "{info}");
    let text = stdout(&success(&["--port", "sim", "info"]));
    assert!(text.contains("eeprom_size") && text.contains("32768 byte"), "{text}");
    assert!(text.lines().last().unwrap().contains("--json shows them all"), "{text}");
    // On a terminal, long lists of names are broken to its width.
    let (mut master, name) = common::terminal();
    let terminal = File::options().read(true).write(true).open(&name).unwrap();
    let mut child = sbgc().args(["--port", "sim", "info"]).stdout(terminal).spawn().unwrap();
    let (mut shown, mut piece) = (Vec::new(), [0; 4096]);
    while !String::from_utf8_lossy(&shown).contains("--json shows them all") {
        let length = master.read(&mut piece).unwrap_or(0);
        shown.extend_from_slice(&piece[..length]);
    }
    assert!(child.wait().unwrap().success());
    let shown = String::from_utf8(shown).unwrap();
    assert!(shown.contains("BOARD_FEATURE_3AXIS|"), "{shown}");
    assert!(shown.lines().all(|line| line.trim_end().chars().count() <= 80), "{shown}");
    // A board that says no to what else is asked is still shown.
    let old = common::boards::moody(common::boards::Mood::Refuses(2)).0;
    let info = &objects(&success(&["--port", &old, "info", "--json"]))[0];
    assert!(info["firmware_ver"].is_string() && info["work_time"].is_null(), "{info}");
}

#[test]
fn the_doctor_says_what_is_wrong_and_what_to_do() {
    let board = Board::start();
    let examined = |port: &str, more: &[&str]| {
        let mut arguments = vec!["doctor", "--port", port, "--json"];
        arguments.extend(more);
        let output = run(&arguments);
        let findings = objects(&output);
        for finding in &findings {
            assert_eq!(keys(finding), ["finding", "severity", "port", "message", "remedy"]);
            let severity = finding["severity"].as_str().unwrap();
            assert!(["ok", "warning", "error"].contains(&severity));
            assert_eq!(finding["remedy"].is_null(), severity == "ok", "{finding}");
        }
        let worst = findings.into_iter().rev().find(|finding| finding["severity"] == "error");
        (output.status.code().unwrap(), worst.map(|finding| finding["finding"].as_str().unwrap().to_owned()))
    };
    assert_eq!(examined(&board.port(), &[]), (0, None));
    // In use by another program.
    let mut other = sbgc()
        .args(["--port", &board.port(), "stream", "--interval", "5ms"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut byte = [0; 1];
    other.stdout.as_mut().unwrap().read_exact(&mut byte).unwrap();
    assert_eq!(examined(&board.port(), &[]), (1, Some("busy".into())));
    other.kill().unwrap();
    other.wait().unwrap();
    let quick = ["--baud", "115200", "--parity", "none", "--timeout", "20ms"];
    assert_eq!(examined("/dev/ttyNOWHERE7", &quick), (1, Some("missing".into())));
    let (mut master, silent) = common::terminal();
    assert_eq!(examined(&silent, &quick), (3, Some("silent".into())));
    // Something else talks there.
    let talking = std::thread::spawn(move || {
        let end = Instant::now() + Duration::from_secs(4);
        while Instant::now() < end {
            let _ = master.write_all(b"$GPGGA,092750.000,5321.6802,N,00630.3372,W,1,8,1.03,61.7,M*76\r\n");
            std::thread::park_timeout(Duration::from_millis(20));
        }
        master
    });
    assert_eq!(examined(&silent, &quick), (3, Some("protocol".into())));
    drop(talking.join().unwrap());
}

#[test]
fn streams_of_every_kind() {
    let board = Board::start();
    let stream = |arguments: &[&str]| {
        let port = board.port();
        let mut all = vec!["--port", &port, "stream"];
        all.extend(arguments);
        success(&all)
    };
    for kind in
        [&["attitude"][..], &["realtime3"], &["realtime4"], &["custom", "--data", "IMU_ANGLES,GYRO_DATA"]]
    {
        let mut arguments = kind.to_vec();
        arguments.extend(["--count", "2", "--interval", "50Hz", "--json"]);
        let samples = objects(&stream(&arguments));
        assert_eq!(samples.len(), 2, "{kind:?}");
        assert_eq!(keys(&samples[0])[0], "timestamp_ms", "{kind:?}");
        assert!(samples[0]["timestamp_ms"].is_number());
        assert!(keys(&samples[0]).len() > 6, "{}", samples[0]);
    }
    let csv = stdout(&stream(&["--csv", "--count", "3", "--fields", "imu_angles.yaw,imu_angles.roll"]));
    let lines: Vec<_> = csv.lines().collect();
    assert_eq!(lines[0], "timestamp_ms,imu_angles.yaw,imu_angles.roll");
    assert_eq!(lines.len(), 4);
    for line in &lines[1..] {
        assert!(line.split(',').all(|value| value.parse::<f64>().is_ok()), "{line}");
    }
    let one = objects(&stream(&["--count", "1", "--json", "--fields", "target_angles.pitch"]));
    assert_eq!(keys(&one[0]), ["timestamp_ms", "target_angles.pitch"]);
    let began = Instant::now();
    stream(&["--for", "300ms"]);
    assert!(began.elapsed() >= Duration::from_millis(300) && began.elapsed() < Duration::from_secs(20));
    let refused = run(&["--port", &board.port(), "stream", "custom"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("--data"), "{}", stderr(&refused));
}

#[test]
fn debug_variables_have_names_and_values() {
    let variables = objects(&success(&["--port", "sim", "debug-vars", "--json"]));
    assert!(!variables.is_empty());
    for (id, variable) in variables.iter().enumerate() {
        assert_eq!(keys(variable), ["name", "id", "value", "min", "max", "unit"]);
        assert_eq!(variable["id"], id);
        assert!(variable["value"].is_number(), "{variable}");
    }
    let output = run(&["--port", "sim", "debug-vars", "nonsense"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}

#[test]
fn what_is_recorded_is_decoded_replayed_and_drawn() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("session.log");
    let path = file.to_str().unwrap();
    fs::write(&file, "the old one").unwrap();
    let board = Board::start();
    let recorded = success(&[
        "--port",
        &board.port(),
        "record",
        path,
        "realtime3",
        "--interval",
        "20ms",
        "--count",
        "10",
        "--json",
    ]);
    let frames = objects(&recorded);
    assert!(frames.iter().filter(|frame| frame["name"] == "CMD_REALTIME_DATA_3").count() >= 10);
    assert!(frames.iter().all(|frame| frame["kind"] == "frame" && frame["version"].is_number()));
    let lines = fs::read_to_string(&file).unwrap();
    assert_eq!(lines.lines().count(), frames.len(), "one per line, in the place of the old file");
    assert!(lines.contains(" out: [86,0]") && lines.contains(" in: [86,"), "both directions: {lines}");
    let decoded = objects(&success(&["decode", path, "--json"]));
    assert_eq!(decoded.len(), frames.len());
    for (decoded, frame) in decoded.iter().zip(&frames) {
        assert_eq!(decoded["payload"], frame["payload"]);
        assert_eq!(decoded["direction"], frame["direction"]);
    }

    let sent = objects(&success(&["--port", &board.port(), "replay", path, "--speed", "10", "--json"]));
    let outcome = sent.last().unwrap();
    assert_eq!((outcome["command"].as_str(), outcome["state"].as_str()), (Some("replay"), Some("done")));
    let outgoing = frames.iter().filter(|frame| frame["direction"] == "outgoing").count();
    assert_eq!(sent.len() - 1, outgoing);
    assert_eq!(outcome["frames"], outgoing);

    for name in ["picture.svg", "picture.png"] {
        let picture = directory.path().join(name);
        success(&["plot", path, "-o", picture.to_str().unwrap(), "--fields", "imu_angle.pitch,bat_level"]);
        let bytes = fs::read(&picture).unwrap();
        if name.ends_with("svg") {
            let svg = String::from_utf8(bytes).unwrap();
            for part in
                ["<svg", "time (s)", "deg", "V", "imu_angle.pitch", "bat_level", "CMD_REALTIME_DATA_3"]
            {
                assert!(svg.contains(part), "{part:?} is not in the picture");
            }
        } else {
            assert!(bytes.starts_with(b"\x89PNG") && bytes.len() > 5000);
        }
    }
    for (arguments, code) in [
        (&["plot", path, "-o", "picture.gif"][..], 2),
        (&["plot", path, "-o", "x.svg", "--fields", "nonsense"], 2),
        (&["plot", "/nonexistent", "-o", "x.svg"], 1),
        (&["replay", "/nonexistent"], 1),
    ] {
        assert_eq!(run(arguments).status.code(), Some(code), "{arguments:?}");
    }
}

#[test]
fn a_recording_that_cannot_begin_leaves_the_old_one() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("session.log");
    fs::write(&file, "the old one").unwrap();
    let output = run(&["--port", "/dev/ttyNOWHERE7", "record", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_to_string(&file).unwrap(), "the old one");
}

#[test]
fn a_recording_is_whole_up_to_its_last_line_when_the_program_is_killed() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("session.log");
    let board = Board::start();
    let mut child = sbgc()
        .args(["--port", &board.port(), "record", file.to_str().unwrap(), "--interval", "5ms", "--json"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = std::io::BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.by_ref().take(20).all(|line| line.is_ok()));
    child.kill().unwrap();
    child.wait().unwrap();
    let decoded = objects(&success(&["decode", file.to_str().unwrap(), "--json"]));
    assert!(decoded.len() >= 20 && decoded.iter().all(|item| item["kind"] == "frame"), "{}", decoded.len());
}

#[test]
fn a_proxy_serves_several_clients_and_ends_when_asked() {
    let board = Board::start();
    let mut proxy = sbgc()
        .args(["--port", &board.port(), "proxy", "--listen", "127.0.0.1:0", "--json", "--read-only"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    std::io::BufReader::new(proxy.stdout.take().unwrap()).read_line(&mut first).unwrap();
    let first: Value = serde_json::from_str(&first).unwrap();
    let port = first["port"].as_str().unwrap().to_owned();
    let clients: Vec<_> = (0..3)
        .map(|_| {
            let port = port.clone();
            std::thread::spawn(move || {
                objects(&success(&[
                    "--port",
                    &port,
                    "stream",
                    "--interval",
                    "20ms",
                    "--count",
                    "5",
                    "--json",
                ]))
                .len()
            })
        })
        .collect();
    for client in clients {
        assert_eq!(client.join().unwrap(), 5);
    }
    let refused = run(&["--port", &port, "motors", "on"]);
    assert_eq!(refused.status.code(), Some(4), "{}", stderr(&refused));
    common::signal(proxy.id(), "TERM");
    assert_eq!(proxy.wait().unwrap().code(), Some(0));
}

/// What a terminal of 80 by 24 shows after these bytes.
fn shown(bytes: &[u8]) -> String {
    let mut terminal = vt100::Parser::new(24, 80, 0);
    terminal.process(bytes);
    terminal.screen().contents()
}

#[test]
fn the_monitor_shows_the_board_and_restores_the_terminal() {
    use std::os::unix::fs::OpenOptionsExt as _;

    for end in [&b"q"[..], b"\x03", b"TERM"] {
        let (mut master, name) = common::terminal();
        let terminal = || File::options().read(true).write(true).custom_flags(0o400).open(&name).unwrap();
        let mut child = sbgc()
            .args(["--port", "sim", "--color", "never", "monitor", "--interval", "20ms"])
            .env("TERM", "xterm")
            .stdin(terminal())
            .stdout(terminal())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (mut bytes, mut piece) = (Vec::new(), [0; 4096]);
        let began = Instant::now();
        let all = ["battery 1", "PITCH", "samples/s", "motor power", "motors ON", "ROLL, 30 s"];
        while !all.iter().all(|part| shown(&bytes).contains(part)) {
            assert!(began.elapsed() < Duration::from_secs(20), "{}", shown(&bytes));
            if let Ok(length) = master.read(&mut piece) {
                bytes.extend_from_slice(&piece[..length]);
            }
        }
        let text = String::from_utf8_lossy(&bytes).into_owned();
        assert!(text.contains("\u{1B}[?1049h"), "a screen of its own");
        assert!(!text.contains("\u{1B}[3") || !text.contains(";5;"), "no colors");
        if end == b"TERM" {
            common::signal(child.id(), "TERM");
        } else {
            master.write_all(end).unwrap();
        }
        let mut after = Vec::new();
        while child.try_wait().unwrap().is_none() {
            assert!(began.elapsed() < Duration::from_secs(40), "it ends");
            if let Ok(length) = master.read(&mut piece) {
                after.extend_from_slice(&piece[..length]);
            }
        }
        while let Ok(length @ 1..) = master.read(&mut piece) {
            after.extend_from_slice(&piece[..length]);
        }
        assert_eq!(child.wait().unwrap().code(), Some(0), "{end:?}");
        assert!(String::from_utf8_lossy(&after).contains("\u{1B}[?1049l"), "the screen is left: {end:?}");
    }
    let output = run(&["--port", "sim", "monitor"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("terminal"), "{}", stderr(&output));
}
