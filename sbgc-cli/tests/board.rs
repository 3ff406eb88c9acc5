//! The program against a simulated board: inside itself, and over a real pseudo-terminal with serial port code on both
//! sides, in both versions of the protocol.
#![cfg(unix)]

mod common;

use std::time::{Duration, Instant};

use common::{Board, objects, run, stderr, stdout};

fn success(arguments: &[&str]) -> std::process::Output {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
    output
}

/// Every command that talks to a board.
fn everything(port: &str, protocol: &str) {
    let with = |rest: &[&str]| {
        let mut arguments = vec!["--port", port, "--protocol", protocol];
        arguments.extend(rest);
        success(&arguments)
    };
    assert!(stdout(&with(&["info"])).contains("firmware_ver = 2."));
    let info = objects(&with(&["info", "--json"]));
    assert!(info[0]["board_ver"].is_number() && info[0]["eeprom_size"].is_number(), "{info:?}");

    assert_eq!(stdout(&with(&["motors", "on"])), "motors on\n");
    assert_eq!(stdout(&with(&["control", "angle", "--pitch", "20", "--yaw", "-30", "--wait"])), "reached\n");
    let angles = &objects(&with(&["angles", "--json"]))[0];
    let near = |path: &str, degrees: f64| (angles[path].as_f64().unwrap() - degrees).abs() < 1.5;
    assert!(near("axes.pitch.imu_angle", 20.0) && near("axes.yaw.imu_angle", -30.0), "{angles}");
    assert!(stdout(&with(&["angles"])).contains("PITCH"));

    let samples = objects(&with(&["stream", "--interval", "20", "--count", "5", "--json"]));
    assert_eq!(samples.len(), 5);
    let times: Vec<u64> = samples.iter().map(|sample| sample["timestamp_ms"].as_u64().unwrap()).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    assert_eq!(stdout(&with(&["stream", "--count", "2", "--data", "IMU_ANGLES"])).lines().count(), 2);

    let params = stdout(&with(&["params", "get"]));
    assert!(params.lines().count() > 100, "{params}");
    let profile = &objects(&with(&["params", "get", "servo_rate", "--profile", "2", "--json"]))[0];
    assert_eq!(profile["profile"], 2);
    assert!(profile["params"]["servo_rate"].is_number(), "{profile}");
    assert_eq!(stdout(&with(&["motors", "off"])), "motors off\n");
}

#[test]
fn the_board_inside_the_program() {
    success(&["--port", "sim", "control", "angle", "--pitch", "20", "--yaw", "-30", "--wait"]);
    success(&["--port", "sim", "info"]);
    success(&["--port", "sim", "stream", "--count", "3"]);
}

#[test]
fn a_real_pseudo_terminal_in_version_1() {
    let board = Board::start();
    everything(&board.port(), "1");
}

#[test]
fn a_real_pseudo_terminal_in_version_2() {
    let board = Board::start();
    everything(&board.port(), "2");
    // The version is locked now, and found without being told.
    everything(&board.port(), "auto");
}

#[test]
fn the_link_goes_when_the_board_is_stopped() {
    let board = Board::start();
    let link = board.link();
    assert!(link.exists());
    success(&["--port", link.to_str().unwrap(), "info"]);
}

#[test]
fn the_port_may_come_from_the_environment() {
    let output = common::sbgc().env("SBGC_PORT", "sim").arg("angles").output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn nobody_at_the_other_end_is_said_in_time() {
    // A terminal that nobody answers on.
    let pair = serial_pair();
    let began = Instant::now();
    let output = run(&["--port", &pair.1, "--timeout", "100", "info"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("CMD_BOARD_INFO"), "{}", stderr(&output));
    assert!(began.elapsed() < Duration::from_secs(20));
}

#[test]
fn hostile_noise_neither_stops_nor_hangs_the_program() {
    use std::io::{Read, Write};

    let (mut master, port) = serial_pair();
    let hostile = std::thread::spawn(move || {
        // Noise, half frames, unknown ids and false lengths until the other side goes away.
        let mut noise = Vec::new();
        for byte in 0..=255_u8 {
            noise.extend([
                byte,
                b'>',
                byte,
                0xFF,
                byte.wrapping_sub(1),
                b'$',
                byte,
                0,
                byte,
                0x3E,
                0xC8,
                1,
                0xC9,
                5,
                5,
            ]);
        }
        let mut sink = [0; 256];
        let end = Instant::now() + Duration::from_secs(3);
        while Instant::now() < end {
            let _ = master.write(&noise);
            let _ = master.read(&mut sink);
        }
    });
    let output = run(&["--port", &port, "--timeout", "100", "info"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    hostile.join().unwrap();
}

/// A pseudo-terminal: the master, and the name of the other side.
fn serial_pair() -> (serialport::TTYPort, String) {
    use serialport::SerialPort as _;

    let (mut master, slave) = serialport::TTYPort::pair().expect("a pseudo-terminal");
    master.set_timeout(Duration::from_millis(10)).expect("a time-out");
    let name = slave.name().expect("it has one");
    // The name stays good as long as the master lives; the other side is the program's.
    std::mem::forget(slave);
    (master, name)
}
