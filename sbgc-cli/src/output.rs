//! Standard output: text for people, or JSON Lines.

use std::fmt::Display;
use std::io::{self, IsTerminal as _, Write};

use serde::Serialize as _;
use serde_json::{Map, Value, json};

use crate::options::Global;
use crate::text::ForTerminals;

/// Where results go.
#[derive(Debug)]
pub(crate) struct Output {
    out: io::BufWriter<io::Stdout>,
    json: bool,
    colored: bool,
}

/// What became of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    Accepted,
    Reached,
    Done,
    Stopped,
    Cancelled,
    Failed,
}

impl State {
    pub(crate) const fn as_str(self) -> &'static str {
        match self {
            State::Accepted => "accepted",
            State::Reached => "reached",
            State::Done => "done",
            State::Stopped => "stopped",
            State::Cancelled => "cancelled",
            State::Failed => "failed",
        }
    }
}

impl Output {
    pub(crate) fn new(global: &Global) -> Self {
        let stdout = io::stdout();
        let colored = global.color.is_on(stdout.is_terminal());
        Output { out: io::BufWriter::with_capacity(64 * 1024, stdout), json: global.json, colored }
    }

    /// Whether JSON was asked for.
    pub(crate) fn is_json(&self) -> bool {
        self.json
    }

    /// Whether text may be colored.
    pub(crate) fn is_colored(&self) -> bool {
        self.colored && !self.json
    }

    /// Prints one line of text.
    pub(crate) fn line(&mut self, text: impl Display) -> io::Result<()> {
        writeln!(self.out, "{text}")
    }

    /// Prints one object.
    pub(crate) fn object(&mut self, object: &Value) -> io::Result<()> {
        let mut serializer = serde_json::Serializer::with_formatter(&mut self.out, ForTerminals);
        object.serialize(&mut serializer)?;
        self.out.write_all(b"\n")
    }

    /// Prints what became of an action: as JSON `command`, `state` and the members of `own`, else `text`.
    pub(crate) fn outcome(
        &mut self,
        command: &str,
        state: State,
        own: Value,
        text: impl Display,
    ) -> io::Result<()> {
        if !self.json {
            return self.line(text);
        }
        let mut object = Map::new();
        object.insert("command".into(), command.into());
        object.insert("state".into(), state.as_str().into());
        if let Value::Object(own) = own {
            object.extend(own);
        }
        self.object(&Value::Object(object))
    }

    /// Prints a frame that `--dry-run` keeps from being sent.
    pub(crate) fn frame(&mut self, name: Option<&str>, id: u8, frame: &[u8]) -> io::Result<()> {
        if self.json {
            return self.object(&json!({"name": name, "id": id, "frame": hex::encode(frame)}));
        }
        let pairs: Vec<String> = frame.iter().map(|byte| format!("{byte:02X}")).collect();
        self.line(pairs.join(" "))
    }

    /// Whether nobody can read the output any more: the other end of a pipe is closed.
    #[cfg(unix)]
    pub(crate) fn is_abandoned(&self) -> bool {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};

        let mut waiting = [PollFd::new(self.out.get_ref(), PollFlags::empty())];
        let now = Timespec { tv_sec: 0, tv_nsec: 0 };
        let polled = poll(&mut waiting, Some(&now)).is_ok();
        polled && waiting[0].revents().contains(PollFlags::ERR)
    }

    /// Whether nobody can read the output any more, which is seen here only when something is printed.
    #[cfg(not(unix))]
    pub(crate) fn is_abandoned(&self) -> bool {
        false
    }

    /// What is printed as it is.
    pub(crate) fn writer(&mut self) -> &mut impl Write {
        &mut self.out
    }

    /// Lets what was printed be seen.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
