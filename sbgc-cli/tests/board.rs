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
    let info = stdout(&with(&["info"]));
    assert!(info.lines().any(|line| line.starts_with("firmware_ver ") && line.contains(" 2.")), "{info}");
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
    let lines = stdout(&with(&["stream", "--count", "2", "--data", "IMU_ANGLES"]));
    assert_eq!(lines.lines().count(), 4, "two lines of names, two of values: {lines}");
    assert!(lines.starts_with("timestamp_ms (ms)"), "{lines}");

    let params = stdout(&with(&["params", "list"]));
    assert!(params.lines().count() > 100, "{params}");
    let profile = &objects(&with(&["params", "get", "servo_rate", "--profile", "2", "--json"]))[0];
    assert_eq!(profile["path"], "servo_rate");
    assert!(profile["value"].is_number(), "{profile}");
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
    board.stop();
    assert!(link.symlink_metadata().is_err());
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
    for part in [&pair.1, "tried 115200 baud, versions 1 and 2", "check power and cable"] {
        assert!(stderr(&output).contains(part), "{part:?} is not in: {}", stderr(&output));
    }
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

/// What passes the link while somebody looks at the board for a while.
fn frames_nobody_asked_for(port: &str) -> String {
    // Samples that were on their way when the stream ended.
    success(&["--port", port, "angles"]);
    let output =
        success(&["--port", port, "-v", "stream", "--data", "GYRO_DATA", "--interval", "50", "--count", "5"]);
    let talk = stderr(&output);
    let counters = talk.lines().find(|line| line.contains("frames sent")).expect("-v counts at the end");
    counters.to_owned()
}

/// Starts a stream of many samples per second and hands over the program and its output once the first came.
fn streaming(port: &str) -> (std::process::Child, impl std::io::BufRead + use<>) {
    use std::io::BufRead as _;

    let mut command = common::sbgc();
    command.args(["--port", port, "stream", "--interval", "2", "--json"]);
    command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut lines = std::io::BufReader::new(child.stdout.take().unwrap());
    let mut first = String::new();
    lines.read_line(&mut first).unwrap();
    assert!(first.contains("timestamp_ms"), "{first}");
    (child, lines)
}

#[test]
fn a_stream_is_taken_from_the_board_however_it_is_stopped() {
    let board = Board::start();
    for signal in ["INT", "TERM"] {
        let (child, output) = streaming(&board.port());
        let kill = std::process::Command::new("kill")
            .args(["-s", signal, &child.id().to_string()])
            .status()
            .unwrap();
        assert!(kill.success());
        std::thread::spawn(move || std::io::copy(&mut { output }, &mut std::io::sink()));
        let ended = child.wait_with_output().unwrap();
        assert_eq!(ended.status.code(), Some(0), "{signal}: {}", stderr(&ended));
        assert_eq!(stderr(&ended), "");
        let counters = frames_nobody_asked_for(&board.port());
        assert!(!counters.contains("nobody asked for"), "after {signal}: {counters}");
    }
    // Whoever read the output has had enough.
    let (child, output) = streaming(&board.port());
    drop(output);
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(0), "{}", stderr(&ended));
    assert_eq!(stderr(&ended), "");
    let counters = frames_nobody_asked_for(&board.port());
    assert!(!counters.contains("nobody asked for"), "after a closed pipe: {counters}");
}

#[test]
fn a_board_that_goes_away_ends_the_stream_with_an_error() {
    let board = Board::start();
    let (child, output) = streaming(&board.port());
    drop(board);
    std::thread::spawn(move || std::io::copy(&mut { output }, &mut std::io::sink()));
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    let said = stderr(&ended);
    assert_eq!(
        said,
        "{\"error\":{\"kind\":\"port\",\"message\":\"the connection to the board was lost; check cable and power, then connect again\",\"code\":1}}\n"
    );
}

#[test]
fn a_board_that_falls_silent_ends_the_stream_with_an_error() {
    let board = Board::start();
    let (child, output) = streaming(&board.port());
    board.signal("STOP");
    std::thread::spawn(move || std::io::copy(&mut { output }, &mut std::io::sink()));
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(3), "{}", stderr(&ended));
    assert!(stderr(&ended).contains("CMD_BOARD_INFO: no answer"), "{}", stderr(&ended));
}

#[test]
fn a_board_that_was_reset_streams_again() {
    use std::io::{BufRead as _, Read as _, Write as _};
    use std::net::{TcpListener, TcpStream};

    let mut command = common::sbgc();
    command.args(["sim", "--tcp", "127.0.0.1:0"]).stdout(std::process::Stdio::piped());
    let mut board = command.spawn().unwrap();
    let mut place = String::new();
    std::io::BufReader::new(board.stdout.take().unwrap()).read_line(&mut place).unwrap();
    let mut to_board = TcpStream::connect(place.trim().trim_start_matches("tcp://")).unwrap();
    let mut from_board = to_board.try_clone().unwrap();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = format!("tcp://{}", listener.local_addr().unwrap());
    // Between program and board stands somebody who resets the board once samples are coming.
    let between = std::thread::spawn(move || {
        let mut from_host = listener.accept().unwrap().0;
        let mut to_host = from_host.try_clone().unwrap();
        let mut reset = to_board.try_clone().unwrap();
        std::thread::spawn(move || std::io::copy(&mut from_host, &mut to_board));
        let (mut passed, mut piece, mut done) = (0, [0; 256], false);
        while let Ok(count @ 1..) = from_board.read(&mut piece) {
            if to_host.write_all(&piece[..count]).is_err() {
                break;
            }
            passed += count;
            if passed > 1000 && !done {
                done = true;
                // CMD_RESET, at once.
                reset.write_all(&[0x24, 0x72, 0x03, 0x75, 0, 0, 0, 0x7B, 0x2A]).unwrap();
            }
        }
        assert!(done);
    });
    let output = success(&["--port", &port, "-v", "stream", "--interval", "2", "--count", "300", "--json"]);
    assert_eq!(objects(&output).len(), 300);
    assert!(stderr(&output).contains("stream resumed"), "{}", stderr(&output));
    board.kill().unwrap();
    board.wait().unwrap();
    between.join().unwrap();
}

#[test]
fn one_program_at_a_time_has_the_port() {
    let board = Board::start();
    let (mut child, output) = streaming(&board.port());
    let second = run(&["--port", &board.port(), "info"]);
    assert_eq!(second.status.code(), Some(1));
    assert!(stderr(&second).contains("in use by another program"), "{}", stderr(&second));
    // The one that has it may be killed and leaves nothing behind that hinders the next.
    child.kill().unwrap();
    child.wait().unwrap();
    drop(output);
    // The board finds the lock that was left behind within a moment.
    let end = Instant::now() + Duration::from_secs(10);
    while !run(&["--port", &board.port(), "info"]).status.success() {
        assert!(Instant::now() < end, "the port is free again");
    }
}

#[test]
fn a_board_that_was_killed_is_replaced_under_its_link() {
    let board = Board::start();
    let (link, directory) = board.kill();
    assert!(link.symlink_metadata().is_ok(), "it could not remove the link");
    let again = Board::start_in(directory);
    success(&["--port", &again.port(), "info"]);
}

#[test]
fn every_frame_is_shown_to_those_who_ask() {
    let output = success(&["--port", "sim", "-vv", "motors", "on"]);
    let talk = stderr(&output);
    for part in [
        "sent CMD_BOARD_INFO (86), version 2, 0 bytes",
        "received CMD_BOARD_INFO (86), version 2, 18 bytes: ",
        "sent CMD_MOTORS_ON (77)",
        "received CMD_CONFIRM (67), version 2, ",
        "frames sent",
    ] {
        assert!(talk.contains(part), "{part:?} is not in: {talk}");
    }
    assert!(!talk.contains('\u{1B}'), "no colours where nobody sees them: {talk}");
    assert_eq!(stdout(&output), "motors on\n");
}

#[test]
fn a_board_on_tcp_says_its_port_and_takes_one_after_the_other() {
    use std::io::BufRead as _;

    let mut command = common::sbgc();
    command.args(["sim", "--tcp", "localhost:0"]).stdout(std::process::Stdio::piped());
    let mut board = command.spawn().unwrap();
    let mut port = String::new();
    std::io::BufReader::new(board.stdout.take().unwrap()).read_line(&mut port).unwrap();
    assert!(port.starts_with("tcp://") && !port.ends_with(":0\n"), "{port}");
    for _ in 0..3 {
        success(&["--port", port.trim(), "angles"]);
    }
    let taken = run(&["sim", "--tcp", port.trim().trim_start_matches("tcp://")]);
    assert_eq!(taken.status.code(), Some(1));
    assert!(stderr(&taken).contains(port.trim()), "{}", stderr(&taken));
    board.kill().unwrap();
    board.wait().unwrap();
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

/// A program that ends with the test, however that ends.
struct Killed(std::process::Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn what_follows_a_board_goes_on_when_it_was_unplugged() {
    use std::io::BufRead as _;

    let mut command = common::sbgc();
    command.args(["sim", "--tcp", "127.0.0.1:0", "--fault", "unplug=2s/1s"]);
    let mut board = Killed(command.stdout(std::process::Stdio::piped()).spawn().unwrap());
    let mut place = String::new();
    std::io::BufReader::new(board.0.stdout.take().unwrap()).read_line(&mut place).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("recording.log");
    let record = common::sbgc()
        .args(["--port", place.trim(), "record", file.to_str().unwrap(), "--count", "150"])
        .spawn()
        .unwrap();
    let output =
        success(&["--port", place.trim(), "stream", "--interval", "20ms", "--count", "200", "--csv"]);
    assert_eq!(stdout(&output).lines().count(), 201);
    let said = stderr(&output);
    assert!(
        said.contains("stream interrupted: the port went away") && said.contains("resumed after"),
        "{said}"
    );
    // What passed after the port was opened again is recorded as well.
    assert!(record.wait_with_output().unwrap().status.success());
    let summary = stdout(&success(&["decode", "--summary", file.to_str().unwrap()]));
    assert!(summary.contains("CMD_REALTIME_DATA_CUSTOM"), "{summary}");
    let asked = std::fs::read_to_string(&file).unwrap().matches("out: [20,").count();
    assert!(asked >= 2, "the board was not asked again who it is");
    drop(board);
    // What asks once does not wait.
    assert_eq!(run(&["--port", place.trim(), "angles"]).status.code(), Some(1));
}
