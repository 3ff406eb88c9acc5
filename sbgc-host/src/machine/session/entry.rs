//! What the table of requests consists of, and what it hands out.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::frame::Version;

use crate::machine::call::{Call, Failure};

/// A frame to be sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::machine) struct Outgoing {
    /// Number of the command in this table.
    pub(in crate::machine) number: u64,
    /// Command id.
    pub(in crate::machine) command: u8,
    /// Payload.
    pub(in crate::machine) payload: Bytes,
    /// The version, if it is not the one in use.
    pub(in crate::machine) version: Option<Version>,
}

/// What a frame was.
#[derive(Debug, PartialEq, Eq)]
pub(in crate::machine) enum Verdict<W> {
    /// The answer to a request, to be handed over.
    Answer(W, Result<Bytes, Failure>),
    /// An answer that came too late.
    Late,
    /// The answer to a command that was sent without waiting for it.
    Unawaited,
    /// None of these.
    Unsolicited,
}

/// A request that has waited in vain.
#[derive(Debug, PartialEq, Eq)]
pub(in crate::machine) struct Expired<W> {
    /// Its number, for it may be on its way to the port.
    pub(in crate::machine) number: u64,
    /// Who waited; `None` if nobody did any more.
    pub(in crate::machine) waiter: Option<W>,
    pub(in crate::machine) failure: Failure,
}

/// A command that waits to be sent.
#[derive(Debug)]
pub(super) struct Queued<W> {
    pub(super) number: u64,
    pub(super) call: Call,
    /// `None` for a command whose answer nobody waits for.
    pub(super) waiter: Option<W>,
    pub(super) called: Duration,
    pub(super) deadline: Duration,
}

/// A command that was handed out to be sent.
#[derive(Debug)]
pub(super) struct Sent<W> {
    pub(super) number: u64,
    pub(super) call: Call,
    /// `None` if nobody waits: the entry is a tombstone.
    pub(super) waiter: Option<W>,
    /// Whether anybody ever waited.
    pub(super) awaited: bool,
    pub(super) called: Duration,
    pub(super) deadline: Duration,
    /// Until when this attempt, or for a tombstone any late answer, may be answered.
    pub(super) until: Duration,
    pub(super) handed_out: Duration,
    pub(super) first_out: Duration,
    /// How often it was handed out.
    pub(super) times: u32,
    /// How many answers may still come.
    pub(super) answers: u32,
    /// Whether it waits to be sent again.
    pub(super) again: bool,
    /// Whether the port has taken the last attempt.
    pub(super) written: bool,
}

impl<W> Sent<W> {
    /// Whether an answer may come that belongs to it.
    pub(super) fn expects(&self, now: Duration) -> bool {
        (self.written || self.times > 1) && (self.waiter.is_some() || now < self.until)
    }
}
