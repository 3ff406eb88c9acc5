//! `sbgc control`, `motors` and `menu` as a person uses them: what moves, what stops, and what is printed.

mod common;

use std::io::Read as _;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use common::boards::{Mood, Watched, moody};
use common::{objects, run, sbgc, stderr, stdout};
use sbgc_host::sim::Config;
use serde_json::json;

fn start(arguments: &[&str]) -> Child {
    let mut command = sbgc();
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the program can be started")
}

fn signal(child: &Child, name: &str) {
    let sent = std::process::Command::new("kill").args(["-s", name, &child.id().to_string()]).status();
    assert!(sent.expect("kill is there").success());
}

/// All ways in which a program ends that a program can notice, with the exit code.
const ENDS: [(&str, i32); 4] = [("INT", 130), ("TERM", 143), ("HUP", 129), ("QUIT", 131)];

#[test]
fn each_signal_stops_the_motion() {
    let board = Watched::start();
    for arguments in [
        &["control", "speed", "--yaw", "40"][..],
        &["control", "rc", "--yaw", "400"],
        &["control", "angle", "--yaw", "700", "--speed", "40", "--wait"],
        &["control", "speed-angle", "--yaw", "-700", "--speed", "40", "--wait"],
    ] {
        for (name, code) in ENDS {
            let child = start(&[&["--port", board.port()], arguments].concat());
            board.wait_for_yaw(30.0);
            signal(&child, name);
            let ended = board.now();
            let output = child.wait_with_output().unwrap();
            assert_eq!(output.status.code(), Some(code), "{arguments:?} {name}: {}", stderr(&output));
            let rest = board.wait_for_rest();
            assert!(
                rest < ended + Duration::from_millis(600),
                "{arguments:?} {name}: {:?}",
                rest.saturating_sub(ended)
            );
            // Nothing makes it move again.
            std::thread::sleep(Duration::from_millis(100));
            assert_eq!(board.speeds().map(f64::to_bits), [0; 3]);
        }
    }
}

#[test]
fn a_closed_pipe_stops_the_motion() {
    let board = Watched::start();
    let mut child = start(&["--port", board.port(), "control", "speed", "--yaw", "40"]);
    board.wait_for_yaw(38.0);
    drop(child.stdout.take());
    let ended = board.now();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    let rest = board.wait_for_rest();
    assert!(rest < ended + Duration::from_millis(900), "{:?}", rest.saturating_sub(ended));
}

#[test]
#[cfg(debug_assertions)]
fn a_panic_stops_the_motion() {
    let board = Watched::start();
    for arguments in [
        &["control", "speed", "--yaw", "40"][..],
        &["control", "angle", "--yaw", "-700", "--speed", "40", "--wait"],
    ] {
        let mut command = sbgc();
        command.args(["--port", board.port()]).args(arguments).env("SBGC_TEST_PANIC", "1");
        let output = command.stdin(Stdio::null()).output().unwrap();
        let ended = board.now();
        assert_eq!(output.status.code(), Some(101), "{}", stderr(&output));
        assert!(stderr(&output).contains("panicked"), "{}", stderr(&output));
        let rest = board.wait_for_rest();
        assert!(rest > Duration::ZERO && rest < ended + Duration::from_millis(500), "{rest:?}, {ended:?}");
    }
}

#[test]
fn a_killed_program_is_stopped_by_the_board() {
    let board = Watched::start();
    for arguments in [
        &["control", "speed", "--yaw", "-40"][..],
        &["control", "rc", "--yaw", "500"],
        &["control", "angle", "--yaw", "700", "--speed", "40", "--wait"],
        &["control", "speed-angle", "--yaw", "-700", "--speed", "40", "--wait"],
    ] {
        let mut child = start(&[&["--port", board.port()], arguments].concat());
        board.wait_for_yaw(35.0);
        child.kill().unwrap();
        child.wait().unwrap();
        let ended = board.now();
        let rest = board.wait_for_rest();
        let after = rest.saturating_sub(ended);
        let expected = Duration::from_millis(700)..Duration::from_millis(1600);
        assert!(expected.contains(&after), "{arguments:?}: {after:?}");
    }
    // What the killed one left armed does not end a move that is left to the board.
    let output = run(&["--port", board.port(), "control", "angle", "--pitch", "50", "--speed", "25"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    board.wait_for_rest();
    assert!((board.angles()[1] - 50.0).abs() < 0.1, "{:?}", board.angles());
}

#[test]
fn a_time_ends_the_motion() {
    let board = Watched::start();
    let began = Instant::now();
    let output =
        run(&["--port", board.port(), "--json", "control", "speed", "--yaw", "-30deg/s", "--for", "700ms"]);
    assert!(began.elapsed() > Duration::from_millis(700));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(
        objects(&output),
        [json!({"command": "control speed", "state": "done", "roll": null, "pitch": null, "yaw": -30.0})]
    );
    board.wait_for_rest();
    let [roll, pitch, yaw] = board.angles();
    assert!((-27.0..-15.0).contains(&yaw) && roll == 0.0 && pitch == 0.0, "{:?}", board.angles());
}

#[test]
fn moves_are_handed_over() {
    let board = Watched::start();
    let began = Instant::now();
    let output = run(&["--port", board.port(), "--json", "control", "angle", "--yaw", "60", "--roll=-5deg"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(began.elapsed() < Duration::from_secs(1), "it does not wait");
    assert_eq!(
        objects(&output),
        [json!({"command": "control angle", "state": "accepted", "roll": -5.0, "pitch": null, "yaw": 60.0})]
    );
    board.wait_for_rest();
    let [roll, pitch, yaw] = board.angles();
    assert!((yaw - 60.0).abs() < 0.1 && (roll + 5.0).abs() < 0.1 && pitch == 0.0, "{:?}", board.angles());

    let output = run(&["--port", board.port(), "control", "home", "--wait"]);
    assert_eq!(
        (output.status.code(), stdout(&output).as_str()),
        (Some(0), "reached\n"),
        "{}",
        stderr(&output)
    );
    board.wait_for_rest();
    assert!(board.angles().iter().all(|angle| angle.abs() < 0.1), "{:?}", board.angles());
}

#[test]
fn a_move_that_arrived_is_held() {
    let board = Watched::start();
    for (command, angle) in [("angle", 40.0), ("speed-angle", -20.0)] {
        let typed = angle.to_string();
        let output = run(&[
            "--port",
            board.port(),
            "--json",
            "control",
            command,
            "--pitch",
            &typed,
            "--speed",
            "50",
            "--wait",
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let object = &objects(&output)[0];
        assert_eq!(object["state"], "reached");
        assert_eq!(object["command"], format!("control {command}"));
        assert_eq!(object["pitch"], angle);
        // The time-out is not armed any more.
        std::thread::sleep(Duration::from_millis(1300));
        assert!((board.angles()[1] - angle).abs() < 0.1, "{:?}", board.angles());
    }
}

#[test]
fn a_move_that_does_not_arrive_fails_and_stops() {
    let board = Watched::start();
    let output = run(&[
        "--port",
        board.port(),
        "--json",
        "control",
        "angle",
        "--yaw",
        "300",
        "--speed",
        "20",
        "--wait",
        "--patience",
        "600ms",
    ]);
    let ended = board.now();
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("not reached within 600 ms"), "{}", stderr(&output));
    assert_eq!(stdout(&output), "");
    assert!(board.wait_for_rest() < ended + Duration::from_millis(500));
}

#[test]
fn stop_ends_a_move_that_was_handed_over() {
    let board = Watched::start();
    run(&["--port", board.port(), "control", "angle", "--yaw", "500", "--speed", "40"]);
    board.wait_for_yaw(35.0);
    let output = run(&["--port", board.port(), "--json", "control", "stop"]);
    assert_eq!(objects(&output), [json!({"command": "control stop", "state": "stopped"})]);
    let ended = board.now();
    assert!(board.wait_for_rest() < ended + Duration::from_millis(500));
}

#[test]
fn only_the_named_axes_are_stopped() {
    let board = Watched::start();
    run(&["--port", board.port(), "control", "angle", "--pitch", "80", "--speed", "20"]);
    let output = run(&["--port", board.port(), "control", "speed", "--yaw", "30", "--for", "500ms"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!((board.speeds()[1] - 20.0).abs() < 0.2, "pitch goes on: {:?}", board.speeds());
    board.wait_for_rest();
    assert!((board.angles()[1] - 80.0).abs() < 0.1, "{:?}", board.angles());
}

#[test]
fn what_cannot_be_is_refused_before_anything_is_sent() {
    for (arguments, part) in [
        (&["control", "angle", "--yaw", "721"][..], "-720 to 719.97"),
        (&["control", "angle", "--yaw", "nan"], "expected an angle"),
        (&["control", "angle"], "required"),
        (&["control", "angle", "--yaw", "1", "--speed", "0"], "to 4000 deg/s"),
        (&["control", "angle", "--yaw", "1", "--patience", "3s"], "--wait"),
        (&["control", "speed", "--yaw", "inf"], "expected a speed"),
        (&["control", "speed", "--yaw", "5000"], "-4000.122 to 4000"),
        (&["control", "speed", "--yaw", "5", "--for", "0"], "more than 0s"),
        (&["control", "rc", "--yaw", "501"], "-500 to 500"),
        (&["control", "rc", "--yaw", "NaN"], "-500 to 500"),
        (&["control", "speed-angle", "--yaw", "5"], "--speed"),
        (&["control", "fly"], "fly"),
        (&["motors", "maybe"], "on, off"),
    ] {
        let output = run(&[&["--port", "sim"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{part:?} is not in: {}", stderr(&output));
        assert_eq!(stdout(&output), "");
    }
}

#[test]
fn the_menu_knows_its_names() {
    for name in ["motor-off", "MENU_CMD_MOTOR_OFF", "menu-cmd-motor_off", "Motor_Off"] {
        let output = run(&["--port", "sim", "--json", "menu", name]);
        let expected = json!({"command": "menu", "state": "done", "name": "MENU_CMD_MOTOR_OFF"});
        assert_eq!(objects(&output), [expected], "{}", stderr(&output));
    }
    let output = run(&["--port", "sim", "menu", "motr-off"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("motor_off") || stderr(&output).contains("motor-off"),
        "{}",
        stderr(&output)
    );
    let output = run(&["--json", "menu", "list"]);
    assert!(objects(&output).iter().any(|object| object["name"] == "MENU_CMD_HOME_POSITION"));
}

#[test]
fn motors_go_on_and_off() {
    let board = Watched::with(Config { motors_on: false, ..Config::default() });
    for (word, on) in [("on", true), ("off", false)] {
        let output = run(&["--port", board.port(), "--json", "motors", word]);
        let command = format!("motors {word}");
        assert_eq!(objects(&output), [json!({"command": command, "state": "done", "motors_on": on})]);
    }
}

/// Commands of motion that change something.
const ACTIONS: [&[&str]; 9] = [
    &["control", "angle", "--yaw", "1"],
    &["control", "angle", "--yaw", "1", "--wait"],
    &["control", "speed-angle", "--yaw", "1", "--speed", "5"],
    &["control", "speed", "--yaw", "1", "--for", "1s"],
    &["control", "rc", "--yaw", "1", "--for", "1s"],
    &["control", "home"],
    &["control", "stop"],
    &["motors", "on"],
    &["menu", "home-position"],
];

#[test]
fn refusals_and_silence_have_exit_codes() {
    for (mood, code, kind) in [(Mood::Refuses(8), 4, "refused"), (Mood::Silent, 3, "no_answer")] {
        let (port, _) = moody(mood);
        for arguments in ACTIONS {
            let output = run(&[&["--port", &port, "--timeout", "60ms", "--json"], arguments].concat());
            assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
            let error: serde_json::Value = serde_json::from_str(stderr(&output).trim()).unwrap();
            assert_eq!((&error["error"]["kind"], &error["error"]["code"]), (&json!(kind), &json!(code)));
            assert_eq!(stdout(&output), "", "{arguments:?}");
        }
    }
}

#[test]
fn a_dry_run_prints_frames_and_sends_none() {
    for arguments in ACTIONS {
        let (port, seen) = moody(Mood::Silent);
        let output = run(&[&["--port", &port, "--json", "--dry-run", "--yes"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        let frames = objects(&output);
        assert!(!frames.is_empty(), "{arguments:?}");
        for frame in &frames {
            assert!(frame["frame"].as_str().unwrap().starts_with("24"), "{frame}");
            assert!(frame["name"].as_str().unwrap().starts_with("CMD_"), "{frame}");
        }
        let sent: Vec<u8> = seen.lock().unwrap().iter().map(|(id, _)| *id).collect();
        assert!(sent.iter().all(|id| [86, 20, 73].contains(id)), "{arguments:?} sent {sent:?}");
    }
}

#[test]
fn nobody_is_asked_and_nothing_is_read_from_standard_input() {
    let mut child = start(&["--port", "sim", "control", "angle", "--yaw", "1"]);
    let mut text = String::new();
    child.stdout.take().unwrap().read_to_string(&mut text).unwrap();
    assert!(child.wait().unwrap().success());
    assert_eq!(text, "accepted\n");
}
