//! `sbgc calibrate` and `tune` as a person uses them.

mod common;

use std::io::{BufRead as _, BufReader};
use std::process::Stdio;

use common::boards::{Mood, Watched, moody};
use common::{objects, run, sbgc, stderr, stdout};
use sbgc_host::sim::Config;
use serde_json::{Value, json};

#[test]
fn steps_and_outcome_are_json() {
    let board = Watched::start();
    let output = run(&["--port", board.port(), "--json", "calibrate", "gyro"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let lines = objects(&output);
    let (last, steps) = lines.split_last().unwrap();
    assert_eq!((&last["command"], &last["state"]), (&json!("calibrate gyro"), &json!("done")));
    assert_eq!(steps[0]["state"], "waiting");
    assert!(steps.len() > 4, "{steps:?}");
    for step in &steps[1..] {
        assert_eq!(step["state"], "running");
        assert!(step["progress"].is_null() || (0.0..=1.0).contains(&step["progress"].as_f64().unwrap()));
        assert!(step["message"].is_string());
    }
    assert!(stderr(&output).contains("Hold the sensor still"), "{}", stderr(&output));
}

#[test]
fn text_has_the_outcome_and_no_bar() {
    let board = Watched::start();
    let output = run(&["--port", board.port(), "calibrate", "battery", "--voltage", "15.5V"]);
    assert_eq!(stdout(&output), "calibrate battery: done\n", "{}", stderr(&output));
    assert!(!stderr(&output).contains('\u{1B}') && !stderr(&output).contains('\r'), "{}", stderr(&output));
}

#[test]
fn poles_encoders_and_tuning_ask_and_nothing_else() {
    for (arguments, asks) in [
        (&["calibrate", "poles"][..], true),
        (&["calibrate", "encoder-offset"], true),
        (&["calibrate", "encoder-field-offset"], true),
        (&["tune"], true),
        (&["calibrate", "acc"], false),
        (&["calibrate", "orientation"], false),
        (&["calibrate", "cogging"], false),
        (&["calibrate", "bode"], false),
    ] {
        let (port, seen) = moody(Mood::Refuses(8));
        let output = run(&[&["--port", &port], arguments].concat());
        let expected = if asks { 5 } else { 4 };
        assert_eq!(output.status.code(), Some(expected), "{arguments:?}: {}", stderr(&output));
        let sent: Vec<u8> = seen.lock().unwrap().iter().map(|(id, _)| *id).filter(|id| *id != 86).collect();
        assert_eq!(sent.is_empty(), asks, "{arguments:?} sent {sent:?}");
        let output = run(&[&["--port", &port, "--json", "--dry-run"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        assert_eq!(objects(&output).len(), 1);
        let (port, _) = moody(Mood::Silent);
        let output = run(&[&["--port", &port, "--yes", "--timeout", "50ms"], arguments].concat());
        assert_eq!(output.status.code(), Some(3), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn motors_that_are_not_as_they_must_be_are_said() {
    let board = Watched::with(Config { motors_on: false, ..Config::default() });
    let output = run(&["--port", board.port(), "--yes", "calibrate", "poles"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("motors have to be on"), "{}", stderr(&output));
}

#[test]
fn what_fails_is_said_and_has_a_code() {
    let board = Watched::start();
    let output = run(&[
        "--port",
        board.port(),
        "--json",
        "calibrate",
        "external-reference",
        "--reference",
        "-1,0,0",
        "--patience",
        "1s",
    ]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let last = objects(&output).pop().unwrap();
    assert!(["failed", "cancelled"].contains(&last["state"].as_str().unwrap()), "{last}");
}

#[test]
fn bad_input_is_wrong_usage() {
    for (arguments, part) in [
        (&["calibrate", "gryo"][..], "gyro"),
        (&["calibrate"], "KIND"),
        (&["calibrate", "battery"], "--voltage"),
        (&["calibrate", "battery", "--voltage", "500"], "1 to 100 V"),
        (&["calibrate", "external-reference", "--reference", "1,2"], "three numbers"),
        (&["tune", "--axes", "rol"], "roll"),
        (&["tune", "--gain", "256"], "256"),
    ] {
        let output = run(&[&["--port", "sim"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{part:?} is not in: {}", stderr(&output));
    }
}

#[test]
fn an_interrupt_stops_the_tuning() {
    let board = Watched::start();
    let mut command = sbgc();
    command.args(["--port", board.port(), "--yes", "--json", "tune"]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    while !lines.next().unwrap().unwrap().contains("running") {}
    let sent = std::process::Command::new("kill").args(["-s", "INT", &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
    let last: Value = serde_json::from_str(&lines.last().unwrap().unwrap()).unwrap();
    assert_eq!((&last["command"], &last["state"]), (&json!("tune"), &json!("cancelled")));
    assert_eq!(child.wait().unwrap().code(), Some(130));
    // Another one may begin at once.
    let again = run(&["--port", board.port(), "calibrate", "battery", "--voltage", "15.5"]);
    assert_eq!(again.status.code(), Some(0), "{}", stderr(&again));
}
