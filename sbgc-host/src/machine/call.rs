//! Requests, and what can become of them.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::MenuCommand;
use sbgc_proto::frame::Version;
use sbgc_proto::{CommandId, Expected};

use super::samples::Shape;

/// Who waits for an answer.
pub trait Waiter {
    /// Whether nobody waits any more.
    fn is_gone(&self) -> bool;

    /// Hands over the outcome. Must not call the machine.
    fn tell(self, outcome: Result<Bytes, Failure>);
}

/// A command that has an answer.
#[derive(Clone, Debug)]
pub struct Call {
    /// Command id.
    pub command: u8,
    /// Payload.
    pub payload: Bytes,
    /// What answers it.
    pub expected: Expected,
    /// What else the answer must look like, because samples with the same id come as well.
    pub shape: Option<Shape>,
    /// How long one attempt may take. All attempts together are the deadline, counted from the call.
    pub timeout: Duration,
    /// How often it may be sent; 1 for everything that must not be carried out twice.
    pub attempts: u32,
    /// What it waits for.
    pub priority: Priority,
    /// Whether it finds out which version the board speaks, and with which it begins. It is sent in both in turn, and
    /// that of the answer is kept.
    pub probe: Option<Version>,
}

/// How long the first answers may take. A board that knows it answers within two of its cycles, so this is for
/// the line and whatever is between.
const PATIENCE: Duration = Duration::from_millis(200);

/// How many attempts are in a hurry. A byte lost once must not cost the better checksum for the whole session.
const TRIES: u32 = 2;

impl Call {
    /// How often it is sent at most; a probe twice more than others.
    pub(super) fn times(&self) -> u32 {
        if self.probe.is_some() { self.attempts.saturating_add(TRIES) } else { self.attempts.max(1) }
    }

    /// How long the attempt with this number, counted from 1, may take.
    pub(super) fn patience(&self, attempt: u32) -> Duration {
        if self.probe.is_some() && attempt <= TRIES { self.timeout.min(PATIENCE) } else { self.timeout }
    }

    /// How long all attempts together may take.
    pub(super) fn allowed(&self) -> Duration {
        let hurried =
            if self.probe.is_some() { self.patience(1).saturating_mul(TRIES) } else { Duration::ZERO };
        let regular = if self.probe.is_some() { self.attempts } else { self.attempts.max(1) };
        self.timeout.saturating_mul(regular).saturating_add(hurried)
    }

    /// Whether a message is the answer.
    pub(super) fn is_answered_by(&self, id: CommandId, payload: &[u8]) -> bool {
        self.expected.matches(id, payload) && self.shape.is_none_or(|shape| shape.fits(payload))
    }

    /// The version in which the attempt with this number goes out; `None` for the one that is in use.
    ///
    /// A board that has seen version 2 once takes nothing else until it restarts, and one whose firmware is older than
    /// 2.68b0 does not know it. On a line that loses much, silence in one is weak evidence, so both alternate after two
    /// attempts in a hurry: in version 2, or, where the board is not to be locked, in 1 and 2.
    pub(super) fn version(&self, attempt: u32) -> Option<Version> {
        let even = attempt.is_multiple_of(2);
        let second = match self.probe? {
            Version::V1 => even,
            Version::V2 => even || attempt <= TRIES,
        };
        Some(if second { Version::V2 } else { Version::V1 })
    }
}

/// What a command waits for before it is sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Priority {
    /// Its turn, and every answer that could be mistaken for its own.
    #[default]
    Normal,
    /// Its turn, and the answers for which somebody waits. For what does no harm if it is repeated.
    Serial,
    /// Its turn only.
    Ordered,
    /// Nothing: it is sent before everything else that waits.
    Urgent,
}

impl Priority {
    /// That of a request: commands that move or stop the gimbal overtake the others.
    pub fn of(command: u8, payload: &[u8]) -> Self {
        let urgent = match CommandId::from_raw(command) {
            CommandId::MotorsOff
            | CommandId::Control
            | CommandId::ControlExt
            | CommandId::ControlQuat
            | CommandId::ControlQuatConfig
            | CommandId::ControlConfig
            | CommandId::ApiVirtChControl
            | CommandId::ApiVirtChHighRes => true,
            CommandId::ExecuteMenu => {
                let stops = [MenuCommand::MotorOff, MenuCommand::MotorsSafeStop, MenuCommand::StopScript];
                payload.first().is_some_and(|&raw| stops.contains(&raw.into()))
            }
            _ => false,
        };
        if urgent { Self::Urgent } else { Self::Normal }
    }
}

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// None came in time.
    Timeout {
        /// Time since the call.
        after: Duration,
        /// How often it was sent; 0 if the port or earlier requests never let it out.
        attempts: u32,
    },
    /// The board rejected the command.
    Refused {
        /// The error code.
        code: u8,
        /// Data that comes with the code.
        data: Bytes,
    },
    /// The port went away.
    Disconnected,
    /// The link was closed from this side.
    Closed,
    /// The stream already runs at this other interval.
    StreamInUse {
        /// The interval at which it runs, in milliseconds.
        running_ms: u16,
    },
    /// A stream runs whose samples nothing would distinguish from those of this one, or from this answer.
    Indistinct,
    /// As many streams run as a board registers.
    TooManyStreams,
}
