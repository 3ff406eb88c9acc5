//! Session with a board, for firmware: no I/O, no clock, no heap, no statics.
//!
//! ```text
//!  request, send ──► Link ──► output, sent ──► UART
//!                     ▲ │
//!   caller's clock ───┘ └──── poll ──► Update: answer, message, refusal, silence
//!                     ▲
//!  UART ──► receive ──┘
//! ```
//!
//! [`Link`] receives bytes and the time, and reports what to send and what happened. It matches answers to requests
//! with the same declarations as the driver for computers, enforces timeouts, abandons incomplete frames after a gap,
//! repeats read-only requests, and detects whether the board supports version 2 of the protocol. Use one link per
//! board.
//!
//! ```
//! use sbgc_proto::commands::{BoardInfo, BoardInfoRequest};
//! use sbgc_proto::link::{Link, Settings, Update};
//!
//! let mut link = Link::<64>::new(Settings::default());
//! let mut clock = 0; // milliseconds, from any moment on
//! link.request(&BoardInfoRequest {}, clock).unwrap();
//! assert_eq!(link.output(), b"\x24\x56\x00\x56\x74\x06");
//! link.sent(6);
//!
//! clock += 3;
//! # let mut answer = [0; 32];
//! # let answer = sbgc_proto::frame::encode_into(
//! #     sbgc_proto::frame::Version::V2, 86, &[36, 0x30, 0x0B, 4, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], &mut answer).unwrap();
//! for &byte in answer {
//!     link.receive(byte, clock);
//!     while let Some(update) = link.poll(clock) {
//!         assert_eq!(update, Update::Answer);
//!         let info: BoardInfo = link.frame().read().expect("the answer has the id of the request").unwrap();
//!         assert_eq!(info.board_ver.number(), 3.6);
//!     }
//! }
//! ```
//!
//! With the features `embedded-io` and `embedded-io-async`, [`Port`](port::Port) and
//! [`AsyncPort`](async_port::AsyncPort) connect it to the halves of a UART.

#![doc = ""]
#![doc = include_str!("firmware.md")]
#![doc = ""]
#![doc = "# What the parts cost"]
#![doc = "In bytes, less what a program takes that does nothing; fat LTO, abort on panic, all of them linked without a \
path to a panic at both levels. `sbgc-proto/examples/cortex-m/sizes.sh` makes the table."]
#![doc = ""]
#![doc = include_str!("sizes.md")]

#[cfg(feature = "embedded-io-async")]
pub mod async_port;
#[cfg(any(feature = "embedded-io", feature = "embedded-io-async"))]
mod error;
mod output;
#[cfg(feature = "embedded-io")]
pub mod port;
#[cfg(test)]
mod tests;

use core::fmt;

#[cfg(any(feature = "embedded-io", feature = "embedded-io-async"))]
pub use error::PortError;

use crate::commands::ErrorReport;
use crate::frame::{Decoder, Event, Frame, Skipped, Version, Versions};
use crate::message::{Message, Request};
use crate::wire::ToWire;
use crate::{CommandId, EncodeError, Expected};
use output::Output;

/// Time of the caller's clock in milliseconds. It may overflow: only differences below 24 days matter.
pub type Millis = u32;

/// Settings of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Settings {
    /// Protocol versions to use. With both, version 2 is tried first, alternating with version 1 until the board
    /// responds.
    pub versions: Versions,
    /// Timeout for answers.
    pub timeout_ms: Millis,
    /// Timeout for answers to requests declared as slow, such as calibrations.
    pub slow_timeout_ms: Millis,
    /// Maximum number of times a read-only request is sent; requests with an effect are sent once.
    pub attempts: u8,
    /// Gap after which an incomplete frame is abandoned. A board sends a frame without pauses, so a few byte times plus
    /// the time between two calls are sufficient.
    pub gap_ms: Millis,
}

impl Settings {
    /// Both versions, timeouts of 200 ms and 10 s (slow), three attempts, a gap of 20 ms.
    pub const DEFAULT: Self =
        Self { versions: Versions::Both, timeout_ms: 200, slow_timeout_ms: 10_000, attempts: 3, gap_ms: 20 };
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Event on a [`Link`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Update {
    /// The request was answered; [`Link::frame`] returns the answer.
    Answer,
    /// The board rejected the request with CMD_ERROR; [`Link::frame`] returns the error.
    Refused,
    /// The request timed out.
    TimedOut,
    /// An unsolicited message was received, such as a sample of a stream; [`Link::frame`] returns it.
    Message,
    /// Bytes were received that belong to no frame.
    Noise(Skipped),
}

/// Reason why a message was not accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SendError {
    /// Another request is waiting for its answer.
    Busy,
    /// The message is inconsistent or does not fit into the free part of the output.
    Encode(EncodeError),
}

impl fmt::Display for SendError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Busy => f.write_str("another request is waiting for its answer"),
            Self::Encode(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SendError {}

impl From<EncodeError> for SendError {
    fn from(error: EncodeError) -> Self {
        Self::Encode(error)
    }
}

/// The request that waits for its answer.
#[derive(Clone, Debug)]
struct Waiting {
    id: CommandId,
    expected: Expected,
    /// The length of its payload, which is kept to be sent again.
    length: usize,
    since: Millis,
    timeout: Millis,
    attempts_left: u8,
}

/// Session with one board; see the [module](self).
///
/// `N` is the size of the output and of the buffer for a repeated request in bytes: 64 for most programs, at most the
/// 255 that a board accepts at once.
#[derive(Clone, Debug)]
pub struct Link<const N: usize> {
    settings: Settings,
    decoder: Decoder,
    output: Output<N>,
    version: Version,
    /// A frame of this version has come, so the board knows it.
    is_settled: bool,
    waiting: Option<Waiting>,
    request: [u8; N],
    last_byte: Millis,
    /// Version, id and length of the payload of the frame that came last.
    frame: (Version, u8, u8),
}

impl<const N: usize> Link<N> {
    /// Creates a link to a board that has not responded yet.
    pub const fn new(settings: Settings) -> Self {
        let version = match settings.versions {
            Versions::Both => Version::V2,
            Versions::Only(version) => version,
        };
        Self {
            settings,
            decoder: Decoder::new(settings.versions),
            output: Output::new(),
            version,
            is_settled: false,
            waiting: None,
            request: [0; N],
            last_byte: 0,
            frame: (version, 0, 0),
        }
    }

    /// Queues a message without waiting for an answer.
    ///
    /// # Errors
    /// If the message is inconsistent or does not fit into the output.
    pub fn send<M: Message + ToWire>(&mut self, message: &M) -> Result<(), SendError> {
        let version = self.version;
        self.output.put(|free| message.encode_frame(version, free).map(<[u8]>::len))?;
        Ok(())
    }

    /// Queues a request and starts waiting for its answer.
    ///
    /// A board that has not responded yet may support version 1 only. Start with a read-only request, such as
    /// [`BoardInfoRequest`](crate::commands::BoardInfoRequest), which is tried in both versions.
    ///
    /// # Errors
    /// If another request is waiting, or this one is inconsistent or does not fit into the output.
    pub fn request<Q: Request + ToWire>(&mut self, request: &Q, now: Millis) -> Result<(), SendError> {
        if self.waiting.is_some() {
            return Err(SendError::Busy);
        }
        let payload = request.encode(&mut self.request)?;
        let (length, expected) = (payload.len(), Expected::of_encoded::<Q>(payload));
        self.put_request(Q::ID, length)?;
        self.waiting = Some(Waiting {
            id: Q::ID,
            expected,
            length,
            since: now,
            timeout: if Q::REQUEST.slow { self.settings.slow_timeout_ms } else { self.settings.timeout_ms },
            attempts_left: if Q::REQUEST.acts { 0 } else { self.settings.attempts.saturating_sub(1) },
        });
        Ok(())
    }

    fn put_request(&mut self, id: CommandId, length: usize) -> Result<(), EncodeError> {
        let payload = self.request.get(..length).unwrap_or_default();
        let version = self.version;
        self.output.put(|free| Ok(crate::frame::encode_into(version, id.raw(), payload, free)?.len()))
    }

    /// Whether a request is waiting for its answer.
    pub const fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Abandons the waiting request. If its answer arrives nevertheless, it is reported as a
    /// [message](Update::Message).
    pub fn cancel(&mut self) {
        self.waiting = None;
    }

    /// Bytes to send.
    pub fn output(&self) -> &[u8] {
        self.output.as_slice()
    }

    /// Removes the first `count` bytes, which were sent, from the output.
    pub fn sent(&mut self, count: usize) {
        self.output.sent(count);
    }

    /// Adds a byte received from the board. After each byte, call [`poll`](Self::poll) until it returns `None`.
    pub fn receive(&mut self, byte: u8, now: Millis) {
        self.last_byte = now;
        self.decoder.put(byte);
    }

    /// Takes bytes from the queue of an interrupt until an event occurs, and returns it.
    ///
    /// Call it every few milliseconds, and each time until it returns `None`.
    ///
    /// ```
    /// use sbgc_proto::heapless::spsc::Queue;
    /// use sbgc_proto::link::{Link, Settings, Update};
    ///
    /// let mut queue = Queue::<u8, 64>::new();
    /// let (mut interrupt, mut received) = queue.split();
    /// for byte in *b"\x3E\x43\x02\x45\x5D\xFF\x5C" {
    ///     interrupt.enqueue(byte).unwrap();
    /// }
    /// let mut link = Link::<64>::new(Settings::DEFAULT);
    /// assert_eq!(link.poll_queue(&mut received, 0), Some(Update::Message));
    /// assert_eq!(link.frame().id, 67);
    /// assert_eq!(link.poll_queue(&mut received, 0), None);
    /// ```
    pub fn poll_queue(
        &mut self,
        queue: &mut heapless::spsc::Consumer<'_, u8>,
        now: Millis,
    ) -> Option<Update> {
        loop {
            if let Some(update) = self.poll(now) {
                return Some(update);
            }
            self.receive(queue.dequeue()?, now);
        }
    }

    /// Returns the next event, and repeats requests that were not answered.
    ///
    /// Returns `None` if there is none; there may still be new [output](Self::output).
    pub fn poll(&mut self, now: Millis) -> Option<Update> {
        if !self.decoder.is_ready() {
            if self.decoder.pending() > 0 && now.wrapping_sub(self.last_byte) >= self.settings.gap_ms {
                return self.decoder.skip_candidate().map(Update::Noise);
            }
            return self.expire(now);
        }
        let frame = match self.decoder.more()? {
            Event::Skipped(skipped) => return Some(Update::Noise(skipped)),
            Event::Frame { frame, .. } => frame,
        };
        let update = match &self.waiting {
            Some(waiting) if answers(waiting, &frame) => Update::Answer,
            Some(waiting) if refuses(waiting, &frame) => Update::Refused,
            _ => Update::Message,
        };
        let (version, length) = (frame.version, u8::try_from(frame.payload.len()).unwrap_or(u8::MAX));
        self.frame = (version, frame.id, length);
        // Whatever is sent now, the board has understood this version, or sends it by itself.
        if !self.is_settled {
            (self.version, self.is_settled) = (version, true);
        }
        if update != Update::Message {
            self.waiting = None;
        }
        Some(update)
    }

    /// Frame that [`poll`](Self::poll) reported last; valid until the next byte or the next call of `poll`.
    pub fn frame(&self) -> Frame<'_> {
        let (version, id, length) = self.frame;
        Frame { version, id, payload: self.decoder.last_payload(length.into()) }
    }

    /// Time at which [`poll`](Self::poll) must be called next even if no byte is received.
    pub fn deadline(&self) -> Option<Millis> {
        let gap = (self.decoder.pending() > 0).then(|| self.last_byte.wrapping_add(self.settings.gap_ms));
        let answer = self.waiting.as_ref().map(|waiting| waiting.since.wrapping_add(waiting.timeout));
        match (gap, answer) {
            (Some(gap), Some(answer)) => Some(if is_reached(gap, answer) { gap } else { answer }),
            (gap, answer) => gap.or(answer),
        }
    }

    /// Protocol version of sent messages.
    pub const fn version(&self) -> Version {
        self.version
    }

    /// Whether the board has responded in that version.
    pub const fn is_settled(&self) -> bool {
        self.is_settled
    }

    /// Decoder, which provides counters.
    pub const fn decoder(&self) -> &Decoder {
        &self.decoder
    }

    fn expire(&mut self, now: Millis) -> Option<Update> {
        let waiting = self.waiting.as_mut()?;
        if now.wrapping_sub(waiting.since) < waiting.timeout {
            return None;
        }
        if waiting.attempts_left > 0 {
            waiting.attempts_left -= 1;
            waiting.since = now;
            let (id, length) = (waiting.id, waiting.length);
            if !self.is_settled && self.settings.versions == Versions::Both {
                self.version = if self.version == Version::V2 { Version::V1 } else { Version::V2 };
            }
            // What does not fit now may fit the next time.
            let _ = self.put_request(id, length);
            return None;
        }
        self.waiting = None;
        Some(Update::TimedOut)
    }
}

/// Whether `moment` is now or earlier.
const fn is_reached(moment: Millis, now: Millis) -> bool {
    now.wrapping_sub(moment) <= Millis::MAX / 2
}

fn answers(waiting: &Waiting, frame: &Frame<'_>) -> bool {
    waiting.expected.matches(frame.command(), frame.payload)
}

/// An error that names no command is about the one that waits.
fn refuses(waiting: &Waiting, frame: &Frame<'_>) -> bool {
    frame.id == crate::commands::Error::ID.raw()
        && ErrorReport::from_payload(frame.payload)
            .is_ok_and(|report| report.command.is_none_or(|command| command == waiting.id))
}
