//! `sbgc eeprom`, `file`, `script`, `i2c`, `pin`, `servo`, `beep`, `imu`, `reset` and `boot` as a person uses them.

mod common;

use common::boards::{Mood, moody};
use common::{Board, objects, run, run_with_input, stderr, stdout};
use serde_json::{Value, json};

/// A page of 64 bytes in hex, beginning with these.
fn page(start: &str) -> String {
    format!("{start:0<128}")
}

fn failed(arguments: &[&str], code: i32, part: &str) {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}{}", stdout(&output), stderr(&output));
    assert!(stderr(&output).contains(part), "{arguments:?}: {part:?} is not in: {}", stderr(&output));
}

fn json(arguments: &[&str]) -> Value {
    let output = run(&[&["--json", "--yes"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    let mut objects = objects(&output);
    assert_eq!(objects.len(), 1, "{arguments:?}");
    objects.remove(0)
}

#[test]
fn eeprom_is_read_written_backed_up_and_restored() {
    let board = Board::start();
    let port = board.port();
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let backup = path("backup");

    let saved = json(&["--port", &port, "eeprom", "backup", &backup]);
    assert_eq!((&saved["address"], &saved["length"]), (&json!(0), &json!(32768)));
    let before = std::fs::read(&backup).unwrap();
    assert_eq!(before.len(), 32768);

    // Nobody to ask: nothing is written.
    let data = page("c0ffee");
    failed(&["--port", &port, "eeprom", "write", "0x7fc0", &data], 5, "--yes");
    let there = json(&["--port", &port, "eeprom", "read", "0x7fc0", "64"]);
    assert_eq!(there["data"], hex::encode(&before[0x7FC0..]));

    let written = json(&["--port", &port, "eeprom", "write", "0x7fc0", &data]);
    assert_eq!(written, json!({"address": 0x7FC0, "length": 64, "data": data}));
    let there = json(&["--port", &port, "eeprom", "read", "32705", "2"]);
    assert_eq!(there, json!({"address": 32705, "length": 2, "data": "ffee"}));
    let text = run(&["--port", &port, "eeprom", "read", "0x7fc0", "18"]);
    assert_eq!(
        stdout(&text).lines().next().unwrap(),
        "00007fc0  c0 ff ee 00 00 00 00 00 00 00 00 00 00 00 00 00"
    );

    // The restore sends that one block and nothing else.
    let frames = objects(&run(&["--port", &port, "--json", "--dry-run", "eeprom", "restore", &backup]));
    assert_eq!(frames.len(), 1);
    assert_eq!(frames[0]["name"], "CMD_EEPROM_WRITE");
    failed(&["--port", &port, "eeprom", "restore", &backup], 5, "in 1 blocks of 64");
    json(&["--port", &port, "eeprom", "restore", &backup]);
    json(&["--port", &port, "eeprom", "backup", &path("again")]);
    assert_eq!(std::fs::read(path("again")).unwrap(), before);
    std::fs::write(path("short"), [0; 640]).unwrap();
    failed(&["--port", &port, "--yes", "eeprom", "restore", &path("short")], 1, "another board");
}

#[test]
fn mistakes_are_found_before_anything_is_sent() {
    let (port, seen) = moody(Mood::Silent);
    let directory = tempfile::tempdir().unwrap();
    let empty = directory.path().join("empty").to_str().unwrap().to_owned();
    std::fs::write(&empty, []).unwrap();
    let odd = page("00");
    for (arguments, part) in [
        (&["eeprom", "write", "1", &odd][..], "not a multiple of 64"),
        (&["eeprom", "write", "64", "aabb"], "not a multiple of 64"),
        (&["eeprom", "write", "64", "xyz"], "hex"),
        (&["eeprom", "write", "64", &empty], "nothing to write"),
        (&["eeprom", "read", "0", "0"], "out of range"),
        (&["file", "write", "script:1", &empty], "1 to 65535"),
        (&["script", "upload", "1", &empty], "1 to 65535"),
        (&["file", "read", "scrpt:1"], "did you mean script"),
        (&["script", "run", "0"], "1..=10"),
        (&["script", "upload", "11", &empty], "1..=10"),
        (&["i2c", "read", "0x80", "0", "1"], "0 to 127"),
        (&["i2c", "read", "0x50", "0", "0"], "1 to 255"),
        (&["i2c", "write", "0x50", "0", ""], "1 to 240"),
        (&["pin", "15", "high"], "unknown pin"),
        (&["pin", "aux9", "high"], "did you mean"),
        (&["beep", "H5"], "unknown note"),
        (&["beep", "100"], "554"),
        (&["beep", "--sound", "intr"], "did you mean intro"),
    ] {
        let output = run(&[&["--port", &port, "--yes"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{arguments:?}: {part:?} is not in: {}", stderr(&output));
    }
    assert!(seen.lock().unwrap().is_empty());
    failed(&["--port", &port, "--yes", "servo", "1", "30000"], 2, "-1 to 20000");
    failed(&["--port", &port, "file", "write", "script:0", "/nonexistent"], 1, "/nonexistent");
}

/// Commands that change something, and whether they ask.
const ACTIONS: [(&[&str], bool); 15] = [
    (&["eeprom", "write", "0", "PAGE"], true),
    (&["file", "write", "script:0", "Cargo.toml"], true),
    (&["file", "delete", "script:0"], true),
    (&["script", "upload", "1", "Cargo.toml"], true),
    (&["script", "delete", "1"], true),
    (&["script", "run", "1"], false),
    (&["script", "stop", "1"], false),
    (&["i2c", "write", "0x68", "0x6b", "00"], true),
    (&["pin", "16", "high"], true),
    (&["servo", "1", "1500", "-1"], true),
    (&["beep"], false),
    (&["beep", "C5", "E5"], false),
    (&["imu", "select", "main"], false),
    (&["reset"], false),
    (&["boot"], true),
];

fn spelled(arguments: &[&str]) -> Vec<String> {
    arguments.iter().map(|word| if *word == "PAGE" { page("01") } else { (*word).to_owned() }).collect()
}

#[test]
fn what_is_dangerous_asks_and_nothing_else() {
    for (arguments, asks) in ACTIONS {
        // A board that refuses: what does not ask gets as far as that, what asks does not or reads first.
        let (port, seen) = moody(Mood::Refuses(8));
        let words = spelled(arguments);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let output = run_with_input(&[&["--port", &port], &words[..]].concat(), b"y\n");
        let reads = ["eeprom", "file"].contains(&words[0]) || (words[0] == "script" && asks);
        let expected = if asks && !reads { 5 } else { 4 };
        assert_eq!(output.status.code(), Some(expected), "{arguments:?}: {}", stderr(&output));
        let changing = [47, 54, 39, 84, 123, 133, 8, 51];
        let sent = seen.lock().unwrap().iter().any(|(id, _)| asks && changing.contains(id));
        assert!(!sent, "{arguments:?} sent something that it has to ask for");
    }
}

#[test]
fn a_dry_run_prints_frames_and_sends_none() {
    for (arguments, _) in ACTIONS {
        let (port, seen) = moody(Mood::Silent);
        let words = spelled(arguments);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let output = run(&[&["--port", &port, "--json", "--dry-run"], &words[..]].concat());
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        let frames = objects(&output);
        assert!(!frames.is_empty(), "{arguments:?}");
        for frame in &frames {
            assert!(frame["name"].as_str().unwrap().starts_with("CMD_"), "{frame}");
            assert!(frame["frame"].as_str().unwrap().starts_with("24"), "{frame}");
        }
        let sent: Vec<u8> = seen.lock().unwrap().iter().map(|(id, _)| *id).collect();
        assert!(sent.iter().all(|id| [86, 20].contains(id)), "{arguments:?} sent {sent:?}");
    }
}

#[test]
fn refusals_and_silence_have_exit_codes() {
    let reading: [&[&str]; 5] = [
        &["eeprom", "read", "0", "64"],
        &["file", "read", "script:0"],
        &["i2c", "read", "0x68", "0", "1"],
        &["imu", "info"],
        &["imu", "external"],
    ];
    for (mood, code, kind) in [(Mood::Refuses(10), 4, "refused"), (Mood::Silent, 3, "no_answer")] {
        let (port, _) = moody(mood);
        let actions = ACTIONS.iter().map(|action| action.0);
        for arguments in reading.into_iter().chain(actions) {
            // These are not confirmed by all boards, so silence is a normal result.
            let unconfirmed = ["boot", "pin", "servo", "beep", "imu", "script"].contains(&arguments[0]);
            if mood == Mood::Silent && unconfirmed {
                continue;
            }
            let words = spelled(arguments);
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let output =
                run(&[&["--port", &port, "--timeout", "60ms", "--json", "--yes"], &words[..]].concat());
            assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
            let error: Value = serde_json::from_str(stderr(&output).lines().last().unwrap()).unwrap();
            assert_eq!((&error["error"]["kind"], &error["error"]["code"]), (&json!(kind), &json!(code)));
            assert_eq!(stdout(&output), "", "{arguments:?}");
        }
    }
}

#[test]
fn melodies_are_sent_as_notes() {
    let output = run(&["--port", "sim", "--dry-run", "beep", "C5", "E5", "--length", "80ms"]);
    // 10 samples of 8 ms, then C6 and E6: the board plays no C5.
    let frame = stdout(&output).replace(' ', "").to_lowercase();
    assert!(frame.contains("00800a"), "{frame}");
    assert!(
        frame.contains(&hex::encode([1047_u16.to_le_bytes(), 1319_u16.to_le_bytes()].concat())),
        "{frame}"
    );
}

#[test]
fn a_reset_is_announced() {
    let board = Board::start();
    let object = json(&["--port", &board.port(), "reset", "--wait"]);
    assert_eq!(object, json!({"command": "reset", "state": "done"}));
    let output = run(&["--port", &board.port(), "reset"]);
    assert_eq!(stdout(&output), "accepted\n", "{}", stderr(&output));
}
