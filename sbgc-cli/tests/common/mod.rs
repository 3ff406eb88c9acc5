//! Running the built program as a person would.

#![allow(dead_code, reason = "each test program uses a part of it")]

pub(crate) mod boards;

use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;

/// The program, without what the surroundings say.
pub(crate) fn sbgc() -> Command {
    let program = env!("CARGO_BIN_EXE_sbgc");
    let mut command = if hangup_is_ignored() {
        // Tests under nohup: a child inherits it, and the program would rightly live on.
        let mut command = Command::new("env");
        command.args(["--default-signal=HUP", program]);
        command
    } else {
        Command::new(program)
    };
    for (variable, _) in std::env::vars() {
        if variable.starts_with("SBGC_") {
            command.env_remove(variable);
        }
    }
    // Nobody's own settings.
    command
        .env("XDG_CONFIG_HOME", "/nonexistent")
        .env("XDG_STATE_HOME", std::env::temp_dir().join("sbgc-test-state"));
    command
}

fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 1 != 0)
}

/// Runs it with these arguments.
pub(crate) fn run(arguments: &[&str]) -> Output {
    sbgc().args(arguments).output().expect("the program can be started")
}

/// Runs it with these arguments and this on its standard input.
pub(crate) fn run_with_input(arguments: &[&str], input: &[u8]) -> Output {
    let mut command = sbgc();
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program can be started");
    let mut pipe = child.stdin.take().expect("it was asked for");
    let input = input.to_vec();
    let writer = std::thread::spawn(move || {
        // The program may end before it has read everything.
        let _ = pipe.write_all(&input);
    });
    let output = child.wait_with_output().expect("it ends");
    writer.join().expect("writing does not panic");
    output
}

/// Standard output as text.
pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("text")
}

/// Standard error as text.
pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("text")
}

/// Standard output as one JSON object a line.
pub(crate) fn objects(output: &Output) -> Vec<Value> {
    stdout(output).lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// A simulated board on a pseudo-terminal, served by the program itself.
pub(crate) struct Board {
    child: Child,
    directory: Option<tempfile::TempDir>,
}

impl Board {
    /// Starts it and waits until it says where it is.
    pub(crate) fn start() -> Self {
        Self::start_in(tempfile::tempdir().expect("a place for the link"))
    }

    /// The same with its link in `directory`.
    pub(crate) fn start_in(directory: tempfile::TempDir) -> Self {
        let link = directory.path().join("gimbal");
        let mut command = sbgc();
        command.args(["sim", "--pty", "--link"]).arg(&link).stdout(Stdio::piped());
        let mut child = command.spawn().expect("the program can be started");
        let mut first = String::new();
        BufReader::new(child.stdout.take().expect("it was asked for"))
            .read_line(&mut first)
            .expect("a first line");
        assert!(first.contains(link.to_str().expect("text")), "the first line says where it is: {first:?}");
        Board { child, directory: Some(directory) }
    }

    /// Ends it without asking; the link stays.
    pub(crate) fn kill(mut self) -> (PathBuf, tempfile::TempDir) {
        let link = self.link();
        self.child.kill().expect("it runs");
        self.child.wait().expect("it ends");
        (link, self.directory.take().expect("it is there until now"))
    }

    /// Sends it a signal.
    pub(crate) fn signal(&self, signal: &str) {
        let id = self.child.id().to_string();
        let sent = Command::new("kill").args(["-s", signal, &id]).status().expect("kill is there");
        assert!(sent.success());
    }

    /// Waits until it has ended; its exit code, and where its link was.
    pub(crate) fn wait(mut self) -> (i32, tempfile::TempDir) {
        let code = self.child.wait().expect("it ends").code().expect("it exits");
        (code, self.directory.take().expect("it is there until now"))
    }

    /// Asks it to end, and waits for that.
    pub(crate) fn stop(mut self) {
        self.signal("TERM");
        assert!(self.child.wait().expect("it ends").success());
    }

    /// The port under which it is found.
    pub(crate) fn port(&self) -> String {
        self.link().to_str().expect("text").to_owned()
    }

    pub(crate) fn link(&self) -> PathBuf {
        self.directory.as_ref().expect("it is there until it is killed").path().join("gimbal")
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A simulated board that the program serves with options, and where it is.
pub(crate) struct Served {
    child: Child,
    port: String,
}

impl Served {
    pub(crate) fn start(arguments: &[&str]) -> Self {
        let mut command = sbgc();
        command.arg("sim").args(arguments).stdout(Stdio::piped());
        let mut child = command.spawn().expect("the program can be started");
        let mut first = String::new();
        let stdout = child.stdout.take().expect("it was asked for");
        BufReader::new(stdout).read_line(&mut first).expect("a first line");
        Self { child, port: first.trim().to_owned() }
    }

    pub(crate) fn port(&self) -> &str {
        &self.port
    }

    /// Runs the program with it.
    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        run(&[&["--port", &self.port], arguments].concat())
    }

    /// Ends it by a signal, and returns its exit code.
    pub(crate) fn end(mut self, name: &str) -> Option<i32> {
        signal(self.child.id(), name);
        self.child.wait().expect("it ends").code()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A program whose lines are read while it runs. It is ended when it is dropped.
pub(crate) struct Running {
    child: Child,
    lines: std::io::Lines<BufReader<std::process::ChildStdout>>,
}

impl Running {
    pub(crate) fn start(arguments: &[&str]) -> Self {
        let mut command = sbgc();
        command.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the program can be started");
        let lines = BufReader::new(child.stdout.take().expect("it was asked for")).lines();
        Self { child, lines }
    }

    /// The next line of its output.
    pub(crate) fn line(&mut self) -> String {
        self.lines.next().expect("one more line").expect("text")
    }

    /// The next line as JSON.
    pub(crate) fn object(&mut self) -> Value {
        serde_json::from_str(&self.line()).expect("JSON")
    }

    /// Waits until it says this on standard error.
    pub(crate) fn wait_until_said(&mut self, part: &str) {
        let (mut said, mut byte) = (Vec::new(), [0]);
        let error = self.child.stderr.as_mut().expect("it was asked for");
        while !String::from_utf8_lossy(&said).contains(part) {
            let read = std::io::Read::read(error, &mut byte).expect("it is open");
            assert!(read > 0, "{part:?} is not in: {}", String::from_utf8_lossy(&said));
            said.push(byte[0]);
        }
    }

    /// Sends it a signal and returns its exit code.
    pub(crate) fn end(mut self, name: &str) -> Option<i32> {
        signal(self.child.id(), name);
        self.child.wait().expect("it ends").code()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Sends a signal to a process.
pub(crate) fn signal(process: u32, signal: &str) {
    let sent =
        Command::new("kill").args(["-s", signal, &process.to_string()]).status().expect("kill is there");
    assert!(sent.success());
}

/// A pseudo-terminal: its master, and the name of the other side.
#[cfg(unix)]
pub(crate) fn terminal() -> (serialport::TTYPort, String) {
    use serialport::SerialPort as _;

    let (mut master, slave) = serialport::TTYPort::pair().expect("a pseudo-terminal");
    master.set_timeout(std::time::Duration::from_millis(100)).expect("a time-out");
    let name = slave.name().expect("it has one");
    // Like a terminal at which a person sits: lines, with their ends.
    let cooked = Command::new("stty").args(["-F", &name, "sane", "rows", "24", "cols", "80"]).status();
    assert!(cooked.expect("stty is there").success());
    // The name stays good as long as the master lives; the other side is the program's.
    std::mem::forget(slave);
    (master, name)
}

/// Every command and every command of a command, as words.
pub(crate) fn all_commands() -> Vec<Vec<String>> {
    let top =
        stdout(&sbgc().arg("--help").env("COLUMNS", "120").output().expect("the program can be started"));
    let list = top.split("\n\n").nth(2).expect("the commands come after about and usage");
    // A group begins with a capital letter.
    let names = list.lines().filter_map(|line| {
        let mut words = line.split_whitespace();
        let first = words.next()?;
        if first.starts_with(char::is_uppercase) { words.next() } else { Some(first) }
    });
    let mut all = Vec::new();
    let mut open: Vec<Vec<String>> = names.map(|name| vec![name.to_owned()]).collect();
    while let Some(path) = open.pop() {
        let help = stdout(&sbgc().args(&path).arg("--help").output().expect("the program can be started"));
        if let Some((_, list)) = help.split_once("\nCommands:\n") {
            for line in list.lines().take_while(|line| !line.is_empty()) {
                let name = line.split_whitespace().next().expect("a name");
                let continued = line.starts_with("      ");
                if !continued {
                    open.push(path.iter().cloned().chain([name.to_owned()]).collect());
                }
            }
        }
        all.push(path);
    }
    all.sort();
    assert!(all.len() > 20, "{all:?}");
    all
}
