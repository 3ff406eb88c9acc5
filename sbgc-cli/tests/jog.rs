//! `sbgc control jog` by its keys and its screen.
#![cfg(unix)]

mod common;

use std::fs::File;
use std::io::{Read as _, Write as _};
use std::process::Child;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use common::boards::Watched;
use common::{run, sbgc, stderr};
use serialport::SerialPort as _;

const RIGHT: &[u8] = b"\x1b[C";
const UP: &[u8] = b"\x1b[A";

/// The program on a terminal.
struct Terminal {
    child: Child,
    keys: serialport::TTYPort,
    screen: Arc<Mutex<vt100::Parser>>,
}

impl Terminal {
    fn start(arguments: &[&str]) -> Self {
        let (mut master, slave) = serialport::TTYPort::pair().expect("a pseudo-terminal");
        let name = slave.name().expect("it has one");
        let open = || File::options().read(true).write(true).open(&name).expect("it can be opened");
        let mut command = sbgc();
        command.args(arguments).env("TERM", "xterm").stdin(open()).stdout(open()).stderr(open());
        let child = command.spawn().expect("the program can be started");
        drop(slave);
        let screen = Arc::new(Mutex::new(vt100::Parser::new(24, 80, 0)));
        let parser = Arc::clone(&screen);
        let mut reader = master.try_clone_native().expect("it can be read from twice");
        reader.set_timeout(Duration::from_millis(100)).expect("a time-out");
        master.set_timeout(Duration::from_secs(2)).expect("a time-out");
        std::thread::spawn(move || {
            let mut piece = [0; 1024];
            loop {
                match reader.read(&mut piece) {
                    Ok(count) => parser.lock().unwrap().process(&piece[..count]),
                    Err(error) if error.kind() == std::io::ErrorKind::TimedOut => {}
                    Err(_) => return,
                }
            }
        });
        Self { child, keys: master, screen }
    }

    fn press(&mut self, key: &[u8]) {
        self.keys.write_all(key).unwrap();
    }

    /// Holds a key as a keyboard does: it repeats.
    fn hold(&mut self, key: &[u8], time: Duration) {
        let end = Instant::now() + time;
        self.press(key);
        while Instant::now() < end {
            std::thread::sleep(Duration::from_millis(40));
            self.press(key);
        }
    }

    fn text(&self) -> String {
        self.screen.lock().unwrap().screen().contents()
    }

    fn wait_for(&self, part: &str) {
        let end = Instant::now() + Duration::from_secs(10);
        while !self.text().contains(part) {
            assert!(Instant::now() < end, "{part:?} is not on the screen:\n{}", self.text());
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    fn ends(&mut self, code: i32) {
        assert_eq!(self.child.wait().unwrap().code(), Some(code), "{}", self.text());
        let end = Instant::now() + Duration::from_secs(2);
        while self.screen.lock().unwrap().screen().alternate_screen() {
            assert!(Instant::now() < end, "the terminal is not restored");
            std::thread::sleep(Duration::from_millis(10));
        }
        assert!(!self.screen.lock().unwrap().screen().hide_cursor());
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn keys_move_the_axes_and_releasing_stops_them() {
    let board = Watched::start();
    let mut terminal = Terminal::start(&["--port", board.port(), "control", "jog"]);
    terminal.wait_for("speed 20 deg/s");
    terminal.wait_for("q  quit");
    assert!(terminal.text().contains("stopped"));
    terminal.hold(RIGHT, Duration::from_millis(900));
    assert!((board.speeds()[2] - 20.0).abs() < 0.2, "{:?}", board.speeds());
    terminal.wait_for("+20 deg/s");
    let released = board.now();
    let rest = board.wait_for_rest();
    assert!(rest < released + Duration::from_millis(1200), "{:?}", rest.saturating_sub(released));
    let [roll, pitch, yaw] = board.angles();
    assert!(yaw > 10.0 && roll == 0.0 && pitch == 0.0, "{:?}", board.angles());

    terminal.press(b"+");
    terminal.wait_for("speed 30 deg/s");
    terminal.press(UP);
    terminal.wait_for("+30 deg/s");
    terminal.press(b" ");
    board.wait_for_rest();
    terminal.press(b"--");
    terminal.wait_for("speed 15 deg/s");
    terminal.press(b"q");
    terminal.ends(0);
}

#[test]
fn each_end_stops_the_motion_and_restores_the_terminal() {
    let board = Watched::start();
    for name in ["INT", "TERM", "HUP"] {
        let mut terminal = Terminal::start(&["--port", board.port(), "control", "jog", "--speed", "40"]);
        terminal.wait_for("speed 40 deg/s");
        terminal.hold(RIGHT, Duration::from_millis(400));
        board.wait_for_yaw(30.0);
        let id = terminal.child.id().to_string();
        assert!(std::process::Command::new("kill").args(["-s", name, &id]).status().unwrap().success());
        terminal.ends(0);
        board.wait_for_rest();
    }
    let mut terminal = Terminal::start(&["--port", board.port(), "control", "jog"]);
    terminal.wait_for("speed 20 deg/s");
    terminal.press(b"\x03");
    terminal.ends(0);
    // A program that is killed leaves its terminal as it was, but not the axes.
    let mut terminal = Terminal::start(&["--port", board.port(), "control", "jog", "--speed", "40"]);
    terminal.wait_for("speed 40 deg/s");
    terminal.hold(RIGHT, Duration::from_millis(400));
    board.wait_for_yaw(30.0);
    terminal.child.kill().unwrap();
    let killed = board.now();
    let rest = board.wait_for_rest();
    assert!(rest < killed + Duration::from_millis(1600), "{:?}", rest.saturating_sub(killed));
}

#[test]
fn it_needs_a_terminal() {
    let output = run(&["--port", "sim", "control", "jog"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("needs a terminal"), "{}", stderr(&output));
}
