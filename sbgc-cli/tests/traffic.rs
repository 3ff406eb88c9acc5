//! Events, streams of all kinds, commands by name, and the proxy: two programs at one simulated board.
#![cfg(unix)]

mod common;

use common::boards::{Mood, moody};
use common::{Board, Running, Served, objects, run, stderr, stdout};
use serde_json::{Value, json};

/// A board that several programs use at once.
fn shared() -> Served {
    Served::start(&["--tcp", "127.0.0.1:0", "--shared"])
}

fn keys(object: &Value) -> Vec<&str> {
    object.as_object().unwrap().keys().map(String::as_str).collect()
}

fn error(output: &std::process::Output) -> Value {
    serde_json::from_str(stderr(output).lines().last().unwrap()).unwrap()
}

#[test]
fn events_are_shown_as_they_happen() {
    let board = shared();
    let mut events =
        Running::start(&["--port", board.port(), "-vv", "--json", "events", "motor-state", "--count", "2"]);
    // Registered.
    events.wait_until_said("received CMD_CONFIRM");
    for word in ["off", "on"] {
        assert!(board.run(&["motors", word]).status.success());
        let event = events.object();
        assert_eq!(
            keys(&event),
            ["timestamp_ms", "event_id", "event_type", "param1", "extra"],
            "those of the message: {event}"
        );
        assert!(event["timestamp_ms"].is_number());
        assert_eq!(event["event_id"], "EVENT_ID_MOTOR_STATE");
    }
    // It has seen as many as it was to.
    drop(events);

    let mut all = Running::start(&["--port", board.port(), "-vv", "events"]);
    all.wait_until_said("received CMD_CONFIRM");
    assert_eq!(all.end("INT"), Some(0));
}

#[test]
fn events_that_cannot_be_had_are_refused() {
    let output = run(&["--port", "sim", "events", "motor-stat"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("MOTOR_STATE"), "{}", stderr(&output));
    for arguments in [&["--count", "0"][..], &["--for", "0"], &["--interval", "fast"]] {
        let output = run(&[&["--port", "sim", "events"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    for (mood, code) in [(Mood::Refuses(9), 4), (Mood::Silent, 3)] {
        let output = run(&["--port", &moody(mood).0, "--timeout", "50ms", "--json", "events"]);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        assert_eq!(error(&output)["error"]["code"], code);
    }
}

#[test]
fn streams_of_the_rarer_kinds() {
    let board = Board::start();
    let port = board.port();
    for (kind, part) in [
        (&["custom2", "--data", "FRAME_IMU_ANGLES"][..], "frame"),
        // The two bytes more than the published ones keep it raw.
        (&["ahrs"], "data"),
        (&["can-drv", "--data", "BUS_VOLTAGE", "--device", "0"], "bus_voltage"),
        (&["ext-motors", "--data", "CONTROL_MODE,SPEED16", "--device", "1"], "speed"),
    ] {
        let rest = ["--count", "2", "--interval", "20ms", "--json"];
        let output = run(&[&["--port", &port, "stream"], kind, &rest].concat());
        assert_eq!(output.status.code(), Some(0), "{kind:?}: {}", stderr(&output));
        let samples = objects(&output);
        assert_eq!(samples.len(), 2, "{kind:?}");
        assert_eq!(keys(&samples[0])[0], "timestamp_ms", "{kind:?}");
        let own = keys(&samples[0]).iter().any(|key| key.to_ascii_lowercase().contains(part));
        assert!(own && keys(&samples[0]).len() > 1, "{kind:?}: {}", samples[0]);
        // What is printed as CSV has as many columns on each line.
        let csv = stdout(&run(&[&["--port", &port, "stream"], kind, &["--count", "2", "--csv"]].concat()));
        let columns: Vec<_> = csv.lines().map(|line| line.split(',').count()).collect();
        assert_eq!(columns.len(), 3, "{csv}");
        assert!(columns.iter().all(|count| *count == columns[0]), "{csv}");
    }
    for (arguments, part) in [
        (&["custom2"][..], "--data"),
        (&["ext-motors", "--data", "SPEED"], "SPEED16"),
        (&["realtime3", "--data", "IMU_ANGLES"], "takes no --data"),
        (&["ahrs", "--fields", "nothing"], "nothing"),
    ] {
        let output = run(&[&["--port", &port, "stream"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{arguments:?}: {}", stderr(&output));
    }
    for (mood, code) in [(Mood::Refuses(9), 4), (Mood::Silent, 3)] {
        let output = run(&["--port", &moody(mood).0, "--timeout", "50ms", "--json", "stream"]);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        assert_eq!(error(&output)["error"]["code"], code);
    }
}

#[test]
fn commands_are_sent_by_name_and_as_they_are() {
    let board = Board::start();
    let port = board.port();
    let send = |arguments: &[&str]| run(&[&["--port", &port, "send"], arguments].concat());

    let asked = objects(&send(&["GET_ANGLES", "--json"]));
    let [request, answer, outcome] = asked.as_slice() else { panic!("{asked:?}") };
    assert_eq!((&request["kind"], &request["direction"]), (&json!("frame"), &json!("outgoing")));
    assert_eq!((&answer["name"], &answer["direction"]), (&json!("CMD_GET_ANGLES"), &json!("incoming")));
    assert_eq!(answer["fields"].as_array().unwrap().len(), 9);
    assert_eq!(
        *outcome,
        json!({"command": "send", "state": "done", "name": "CMD_GET_ANGLES", "id": 73}),
        "the contract's keys"
    );
    // By number, and in full as people read it.
    assert!(stdout(&send(&["73"])).contains("target_angle"), "{}", stdout(&send(&["73"])));
    let confirmed = objects(&send(&["EXECUTE_MENU", "cmd_id=MENU_CMD_MOTOR_ON", "--json"]));
    assert_eq!(confirmed.last().unwrap()["state"], "accepted", "{confirmed:?}");
    let raw = objects(&send(&["--raw", "24 49 00 49 04 08", "--json"]));
    assert_eq!(raw[1]["name"], "CMD_GET_ANGLES");
    let payload = objects(&send(&["READ_PARAMS_3", "--payload", "01", "--json"]));
    assert_eq!(payload[1]["payload"].as_str().unwrap()[..2], *"01");
    let frames = objects(&send(&["MOTORS_ON", "--dry-run", "--json"]));
    assert_eq!(frames.len(), 1);
    assert_eq!(keys(&frames[0]), ["name", "id", "frame"]);

    // What the board refuses, and what it does not know.
    let refused = send(&["CALIB_BAT", "actual_voltage=0", "--json"]);
    assert_eq!(refused.status.code(), Some(4), "{}{}", stdout(&refused), stderr(&refused));
    assert_eq!(error(&refused)["error"]["kind"], "refused");
    // What other commands ask about is asked about here.
    let asks = send(&["WRITE_PROFILE_NAMES"]);
    assert_eq!(asks.status.code(), Some(5), "{}", stderr(&asks));
    for (arguments, part) in [
        (&["GET_ANGELS"][..], "GET_ANGLES"),
        (&["READ_PARAMS_3", "profil_id=1"], "profile_id"),
        (&["READ_PARAMS_3", "profile_id"], "FIELD=VALUE"),
        (&["MOTORS_OFF", "--form", "long"], "available: "),
        (&["--raw", "24 49 00 49 04 09"], "correct checksums"),
        (&["--raw", "24 49 00 49 04"], "incomplete"),
        (&["--raw", "xyz"], "hex"),
        (&[], "NAME"),
    ] {
        let output = send(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{arguments:?}: {part:?} is not in {}", stderr(&output));
    }
    let silent = run(&["--port", &moody(Mood::Silent).0, "--timeout", "50ms", "send", "READ_PARAMS_3"]);
    assert_eq!(silent.status.code(), Some(3), "{}", stderr(&silent));
}

#[test]
fn scripts_are_uploaded_traced_and_deleted() {
    let board = shared();
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("look.script");
    std::fs::write(&file, "WAIT(30)\nMOTORS(1)\nGOTO(1)\n").unwrap();
    let path = file.to_str().unwrap();
    let json_of = |arguments: &[&str]| {
        let output = board.run(&[arguments, &["--json"]].concat());
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        objects(&output)
    };

    let empty = board.run(&["script", "run", "3"]);
    assert_eq!(empty.status.code(), Some(1), "{}", stderr(&empty));
    assert!(stderr(&empty).contains("slot 3"), "{}", stderr(&empty));
    assert_eq!(board.run(&["script", "upload", "3", path]).status.code(), Some(5));
    let size = std::fs::metadata(&file).unwrap().len();
    let uploaded = json_of(&["script", "upload", "3", path, "--yes"]);
    assert_eq!(uploaded, [json!({"slot": 3, "size": size, "state": "done"})]);
    let info = &json_of(&["info"])[0];
    assert_eq!(info["script_slot3_size"], size);
    assert_eq!(json_of(&["script", "run", "3"])[0], json!({"slot": 3, "size": size, "state": "accepted"}));
    assert_eq!(json_of(&["script", "stop", "3"])[0], json!({"slot": 3, "size": size, "state": "stopped"}));

    let mut trace = Running::start(&["--port", board.port(), "--json", "script", "trace", "3"]);
    for count in 1..=3 {
        let step = trace.object();
        assert_eq!(keys(&step), ["slot", "size", "state", "cmd_count", "err_code"], "{step}");
        assert_eq!(
            (&step["slot"], &step["state"], &step["cmd_count"]),
            (&3.into(), &"running".into(), &count.into())
        );
    }
    assert_eq!(trace.end("TERM"), Some(0));
    json_of(&["script", "stop", "3"]);

    // As a file it is the same.
    let read = board.run(&["file", "read", "script:2"]);
    assert_eq!(read.stdout, std::fs::read(&file).unwrap());
    let copy = directory.path().join("copy");
    let saved = json_of(&["file", "read", "script:2", copy.to_str().unwrap()]);
    assert_eq!((&saved[0]["size"], &saved[0]["state"]), (&size.into(), &"done".into()));
    assert_eq!(std::fs::read(&copy).unwrap(), read.stdout);
    let written = json_of(&["file", "write", "script:5", path, "--yes"]);
    assert_eq!(keys(&written[0]), ["id", "size", "state"]);
    assert_eq!(board.run(&["file", "delete", "script:5"]).status.code(), Some(5));
    json_of(&["file", "delete", "script:5", "--yes"]);
    let gone = board.run(&["file", "read", "script:5"]);
    assert!([Some(1), Some(4)].contains(&gone.status.code()), "{}", stderr(&gone));
    assert_eq!(board.run(&["script", "delete", "3"]).status.code(), Some(5));
    let deleted = json_of(&["script", "delete", "3", "--yes"]);
    assert_eq!(deleted, [json!({"slot": 3, "size": size, "state": "done"})]);
    assert_eq!(json_of(&["info"])[0]["script_slot3_size"], 0);
}

#[test]
fn pins_servos_and_i2c_are_driven() {
    let board = Board::start();
    let port = board.port();
    let json_of = |arguments: &[&str]| {
        let output = run(&[&["--port", &port, "--json", "--yes"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        objects(&output).pop().unwrap()
    };
    let pin = json_of(&["pin", "aux1", "high"]);
    assert_eq!(
        (&pin["command"], &pin["state"], &pin["level"]),
        (&"pin".into(), &"done".into(), &"high".into())
    );
    let servo = json_of(&["servo", "2", "1000", "-1"]);
    assert_eq!(servo, json!({"command": "servo", "state": "accepted", "servo": 2, "times": [1000, -1]}));
    let beep = json_of(&["beep", "C6", "E6"]);
    assert_eq!((&beep["command"], &beep["state"]), (&"beep".into(), &"accepted".into()));
    let chosen = json_of(&["imu", "select", "frame"]);
    assert_eq!((&chosen["command"], &chosen["imu"]), (&"imu select".into(), &"frame".into()));
    assert!(json_of(&["imu", "info"]).as_object().unwrap().len() > 5);

    // A register of the motion sensor keeps what is written to it.
    let written = json_of(&["i2c", "write", "0x68", "0x19", "07"]);
    assert_eq!(written, json!({"address": 0x68, "register": 0x19, "length": 1, "data": "07"}));
    let read = json_of(&["i2c", "read", "0x68", "0x19", "1"]);
    assert_eq!(read, json!({"address": 0x68, "register": 0x19, "length": 1, "data": "07"}));
    let nobody = run(&["--port", &port, "--json", "i2c", "read", "0x10", "0", "1"]);
    assert_eq!(nobody.status.code(), Some(4), "{}", stderr(&nobody));
    let booting = json_of(&["boot"]);
    assert_eq!((&booting["command"], &booting["state"]), (&"boot".into(), &"accepted".into()));
}

#[test]
fn a_proxy_passes_on_traces_and_refusals() {
    let board = Board::start();
    let mut proxy = Running::start(&["--port", &board.port(), "proxy", "--listen", "127.0.0.1:0", "--json"]);
    let first = proxy.object();
    assert_eq!(keys(&first), ["port"]);
    let port = first["port"].as_str().unwrap().to_owned();
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("script");
    std::fs::write(&file, "WAIT(20)\nGOTO(1)\n").unwrap();
    let upload = ["--port", &port, "--yes", "script", "upload", "1", file.to_str().unwrap()];
    assert_eq!(run(&upload).status.code(), Some(0));
    // One program only listens, and sees the steps that another one has asked for.
    let mut listening = Running::start(&["--port", &port, "-vv", "--json", "script", "trace"]);
    listening.wait_until_said("received CMD_BOARD_INFO");
    let mut running = Running::start(&["--port", &port, "--json", "script", "trace", "1"]);
    assert_eq!(running.object()["state"], "running");
    assert_eq!(listening.object()["state"], "running");
    assert_eq!((running.end("INT"), listening.end("INT")), (Some(0), Some(0)));
    let refused = run(&["--port", &port, "script", "run", "2"]);
    assert_eq!(refused.status.code(), Some(1), "{}", stderr(&refused));
    assert_eq!(proxy.end("HUP"), Some(0));
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let taken = listener.local_addr().unwrap().to_string();
    for (listen, code) in [("nowhere", 2), (&*taken, 1)] {
        let output = run(&["--port", "sim", "proxy", "--listen", listen]);
        assert_eq!(output.status.code(), Some(code), "{listen}: {}", stderr(&output));
    }
}
