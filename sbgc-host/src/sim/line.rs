//! The wire between host and board, and the board's two buffers at its end.
//!
//! ```text
//!  host ─► coming ─(bit rate)─► Decoder ─► queue, 255 bytes ─► board
//!  host ◄─ gone ◄──(bit rate)── output, 255 bytes ◄── waiting ◄── board
//! ```
//!
//! A message is weighed when its last byte is there: it is lost if it does not fit what the queue leaves of 255 bytes.
//! An answer that does not fit the output waits, and the board waits with it; a sample of a stream is skipped instead.

use std::collections::VecDeque;
use std::time::Duration;

use bytes::{Bytes, BytesMut};
use sbgc_proto::frame::{self, BOARD_BUFFER, Decoder, Event, Version, Versions};

use super::faults::{Fault, Tamper, Way};

/// Bytes that have left the board and that the host may leave unread; what comes then is lost.
const HOST_BUFFER: usize = 4096;

/// Silence within a frame after which the board gives the frame up.
const GAP: Duration = Duration::from_millis(100);

/// A command as it came.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Received {
    pub(super) version: Version,
    pub(super) id: u8,
    pub(super) payload: Vec<u8>,
}

impl Received {
    fn frame_len(&self) -> usize {
        self.version.frame_len(self.payload.len())
    }
}

/// What became of the messages so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LineCounters {
    /// Messages that the board took.
    pub received: u64,
    /// Messages that were lost because the input buffer was full.
    pub lost: u64,
    /// Bytes that belonged to no valid frame.
    pub skipped_bytes: u64,
    /// Messages that the board sent.
    pub sent: u64,
    /// Samples of streams that were skipped because the output buffer was full.
    pub skipped_samples: u64,
    /// The most bytes that commands have taken of the input buffer.
    pub input_peak: usize,
    /// Bytes that were lost because the host did not read.
    pub unread_bytes: u64,
}

#[derive(Debug)]
pub(super) struct Line {
    byte_time: Option<Duration>,
    /// Bytes on their way to the board, by the time since when the line carries them.
    coming: VecDeque<(Duration, Bytes)>,
    /// When the last of them will be there.
    coming_until: Duration,
    last_byte: Duration,
    decoder: Decoder,
    queue: VecDeque<Received>,
    queued_bytes: usize,
    waiting: VecDeque<Vec<u8>>,
    /// Frames that arrive later because of a fault, in both directions.
    delayed: VecDeque<(Duration, Vec<u8>)>,
    delayed_in: VecDeque<(Duration, Received)>,
    tamper_in: Tamper,
    tamper_out: Tamper,
    /// Whether bytes of the host take no time.
    at_once: bool,
    output: BytesMut,
    /// When the last byte of `gone` was on its way.
    gone_until: Duration,
    gone: BytesMut,
    counters: LineCounters,
    /// What came from the host of a line that carries raw bytes, instead of messages.
    raw: Option<Vec<u8>>,
}

impl Line {
    pub(super) fn new(bit_rate: Option<u32>, seed: u64) -> Self {
        Self {
            byte_time: byte_time(bit_rate),
            coming: VecDeque::new(),
            coming_until: Duration::ZERO,
            last_byte: Duration::ZERO,
            decoder: Decoder::new(Versions::Both),
            queue: VecDeque::new(),
            queued_bytes: 0,
            waiting: VecDeque::new(),
            delayed: VecDeque::new(),
            delayed_in: VecDeque::new(),
            tamper_in: Tamper::new(seed),
            tamper_out: Tamper::new(!seed),
            at_once: false,
            output: BytesMut::new(),
            gone_until: Duration::ZERO,
            gone: BytesMut::new(),
            counters: LineCounters::default(),
            raw: None,
        }
    }

    /// Forgets everything that is in the board; what is on the wire stays there.
    pub(super) fn reset(&mut self) {
        self.decoder = Decoder::new(Versions::Both);
        self.queue.clear();
        self.queued_bytes = 0;
        self.waiting.clear();
        self.delayed.clear();
        self.delayed_in.clear();
        self.output.clear();
        self.raw = None;
    }

    /// Lets it carry raw bytes from now on, or messages again.
    pub(super) fn set_raw(&mut self, raw: bool) {
        self.raw = raw.then(Vec::new);
    }

    /// Whether it carries raw bytes.
    pub(super) fn is_raw(&self) -> bool {
        self.raw.is_some()
    }

    /// The raw bytes that have come.
    pub(super) fn take_raw(&mut self) -> Vec<u8> {
        self.raw.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Sends raw bytes; what finds no room is lost.
    pub(super) fn send_raw(&mut self, now: Duration, bytes: &[u8]) {
        self.carry_out(now);
        let room = BOARD_BUFFER.saturating_sub(self.output.len()).min(bytes.len());
        self.output.extend_from_slice(bytes.get(..room).unwrap_or_default());
        self.carry_out(now);
    }

    /// Forgets what is on the wire, too.
    pub(super) fn cut(&mut self) {
        self.coming.clear();
        self.gone.clear();
    }

    pub(super) fn set_bit_rate(&mut self, bit_rate: Option<u32>) {
        self.byte_time = byte_time(bit_rate);
    }

    /// Lets bytes of the host be there at once, whatever the bit rate.
    pub(super) fn read_at_once(&mut self) {
        self.at_once = true;
    }

    /// Lets something go wrong with frames.
    pub(super) fn tamper(&mut self, way: Way, fault: Fault) {
        match way {
            Way::In => self.tamper_in.set(fault),
            Way::Out => self.tamper_out.set(fault),
        }
    }

    pub(super) fn stop_tampering(&mut self) {
        self.tamper_in.clear();
        self.tamper_out.clear();
    }

    pub(super) fn counters(&self) -> LineCounters {
        self.counters
    }

    /// Puts bytes on the wire to the board.
    pub(super) fn carry_in(&mut self, now: Duration, bytes: &[u8]) {
        if !bytes.is_empty() {
            let start = now.max(self.coming_until);
            self.coming.push_back((start, Bytes::copy_from_slice(bytes)));
            self.coming_until = start.saturating_add(self.time_for(bytes.len()));
        }
    }

    /// Bytes that are on the wire to the board.
    pub(super) fn coming(&self) -> usize {
        self.coming.iter().map(|(_, bytes)| bytes.len()).sum()
    }

    /// Takes in what the wire has brought. With `deaf` it is lost.
    pub(super) fn take_in(&mut self, now: Duration, deaf: bool) {
        while self.delayed_in.front().is_some_and(|(time, _)| *time <= now) {
            if let Some((_, received)) = self.delayed_in.pop_front() {
                self.enqueue(received);
            }
        }
        let byte_time = self.byte_time.filter(|_| !self.at_once);
        while let Some((start, bytes)) = self.coming.front_mut() {
            let there = carried(byte_time, now.saturating_sub(*start), bytes.len());
            let chunk = bytes.split_to(there);
            let last = bytes.is_empty();
            if let Some(byte_time) = byte_time {
                *start = start.saturating_add(times(byte_time, there));
            }
            if last {
                self.coming.pop_front();
            }
            if !chunk.is_empty() {
                self.last_byte = now;
                match &mut self.raw {
                    _ if deaf => {}
                    Some(raw) => raw.extend_from_slice(&chunk),
                    None => self.decode(now, &chunk),
                }
            }
            if !last {
                break;
            }
        }
        if now.saturating_sub(self.last_byte) >= GAP {
            while self.decoder.skip_candidate().is_some() {
                self.decode(now, &[]);
            }
        }
    }

    fn decode(&mut self, now: Duration, mut chunk: &[u8]) {
        while let Some(event) = self.decoder.next(&mut chunk) {
            match event {
                Event::Skipped(skipped) => self.counters.skipped_bytes += skipped.length as u64,
                Event::Frame { frame, .. } => {
                    let received =
                        Received { version: frame.version, id: frame.id, payload: frame.payload.to_vec() };
                    if received.version == Version::V2 {
                        self.decoder.set_versions(Versions::Only(Version::V2));
                    }
                    let (copies, spoiled) = self.tamper_in.fate();
                    for _ in 0..copies {
                        if spoiled {
                            // Its sum is wrong then, and the board ignores it.
                            self.counters.skipped_bytes += received.frame_len() as u64;
                        } else if self.tamper_in.delay.is_zero() {
                            self.enqueue(received.clone());
                        } else {
                            let time = now.saturating_add(self.tamper_in.delay);
                            self.delayed_in.push_back((time, received.clone()));
                        }
                    }
                }
            }
        }
    }

    /// Puts a command into the input buffer, if it has room for it.
    fn enqueue(&mut self, received: Received) {
        let length = received.frame_len();
        if self.queued_bytes + length > BOARD_BUFFER {
            self.counters.lost += 1;
        } else {
            self.queued_bytes += length;
            self.counters.input_peak = self.counters.input_peak.max(self.queued_bytes);
            self.queue.push_back(received);
        }
    }

    /// Whether something has to be looked at when the board next works through its queue.
    pub(super) fn is_busy(&self) -> bool {
        !self.coming.is_empty()
            || !self.queue.is_empty()
            || !self.delayed_in.is_empty()
            || self.decoder.pending() > 0
    }

    /// The next command, unless an answer still waits for room.
    pub(super) fn next_command(&mut self) -> Option<Received> {
        if !self.waiting.is_empty() {
            return None;
        }
        let received = self.queue.pop_front()?;
        self.queued_bytes = self.queued_bytes.saturating_sub(received.frame_len());
        self.counters.received += 1;
        Some(received)
    }

    /// Sends a message; it waits where there is no room for it.
    pub(super) fn send(&mut self, now: Duration, version: Version, id: u8, payload: &[u8]) {
        let Some(frame) = encoded(version, id, payload).filter(|_| !self.is_raw()) else { return };
        self.counters.sent += 1;
        let (copies, spoiled) = self.tamper_out.fate();
        for _ in 0..copies {
            let mut frame = frame.clone();
            if spoiled {
                self.tamper_out.spoil(&mut frame);
            }
            if self.tamper_out.delay.is_zero() {
                self.waiting.push_back(frame);
            } else {
                self.delayed.push_back((now.saturating_add(self.tamper_out.delay), frame));
            }
        }
        self.carry_out(now);
    }

    /// Sends a message, or skips it where there is no room for it.
    pub(super) fn send_sample(&mut self, now: Duration, version: Version, id: u8, payload: &[u8]) {
        self.carry_out(now);
        let fits = self.waiting.is_empty() && self.has_room_for(version.frame_len(payload.len()));
        if fits {
            self.send(now, version, id, payload);
        } else {
            self.counters.skipped_samples += 1;
        }
    }

    /// A frame longer than the buffer is let into the empty buffer, else it would never go out.
    fn has_room_for(&self, length: usize) -> bool {
        self.output.is_empty() || self.output.len() + length <= BOARD_BUFFER
    }

    /// Lets the wire carry to the host what it can up to `now`.
    pub(super) fn carry_out(&mut self, now: Duration) {
        while self.delayed.front().is_some_and(|(time, _)| *time <= now) {
            self.waiting.extend(self.delayed.pop_front().map(|(_, frame)| frame));
        }
        loop {
            let most = self.output.len();
            let count = carried(self.byte_time, now.saturating_sub(self.gone_until), most);
            let bytes = self.output.split_to(count);
            // A wire carries on, whether anybody listens or not.
            let room = HOST_BUFFER.saturating_sub(self.gone.len()).min(count);
            self.gone.extend_from_slice(bytes.get(..room).unwrap_or_default());
            self.counters.unread_bytes += count.saturating_sub(room) as u64;
            self.gone_until = match self.byte_time {
                // Time in which there was nothing to carry is lost.
                _ if count == most => now.max(self.gone_until),
                Some(byte_time) => self.gone_until.saturating_add(times(byte_time, count)),
                None => now,
            };
            match self.waiting.front() {
                Some(frame) if self.has_room_for(frame.len()) => {
                    self.output.extend_from_slice(frame);
                    self.waiting.pop_front();
                }
                _ => break,
            }
        }
    }

    /// When all that waits to be sent will have left.
    pub(super) fn empty_at(&self, now: Duration) -> Duration {
        let delayed = self.delayed.iter().map(|(_, frame)| frame);
        let waiting: usize = self.waiting.iter().chain(delayed).map(Vec::len).sum();
        let start = self.delayed.back().map_or(now, |(time, _)| now.max(*time)).max(self.gone_until);
        start.saturating_add(self.time_for(self.output.len() + waiting))
    }

    /// What has arrived at the host's end.
    pub(super) fn take_gone(&mut self) -> Bytes {
        self.gone.split().freeze()
    }

    /// When the host should look for bytes again.
    pub(super) fn next_out(&self) -> Option<Duration> {
        let delayed = self.delayed.front().map(|(time, _)| *time);
        let Some(byte_time) = self.byte_time.filter(|_| !self.output.is_empty()) else { return delayed };
        // A host does not look for each byte: a millisecond or the rest of what is there.
        let count = self.output.len().clamp(1, 10);
        let next = self.gone_until.saturating_add(times(byte_time, count));
        Some(delayed.map_or(next, |delayed| delayed.min(next)))
    }

    fn time_for(&self, count: usize) -> Duration {
        self.byte_time.map_or(Duration::ZERO, |byte_time| times(byte_time, count))
    }
}

/// The time of a byte with its start and stop bit.
fn byte_time(bit_rate: Option<u32>) -> Option<Duration> {
    let time = bit_rate.and_then(|rate| Duration::from_secs(10).checked_div(rate));
    time.filter(|time| !time.is_zero())
}

fn times(time: Duration, count: usize) -> Duration {
    time.saturating_mul(u32::try_from(count).unwrap_or(u32::MAX))
}

/// Number of bytes that a line carries in `time`, at most `most`.
fn carried(byte_time: Option<Duration>, time: Duration, most: usize) -> usize {
    byte_time.map_or(most, |byte_time| {
        let count = time.as_nanos().checked_div(byte_time.as_nanos()).unwrap_or_default();
        usize::try_from(count).unwrap_or(usize::MAX).min(most)
    })
}

fn encoded(version: Version, id: u8, payload: &[u8]) -> Option<Vec<u8>> {
    let mut frame = vec![0; version.frame_len(payload.len())];
    frame::encode_into(version, id, payload, &mut frame).ok()?;
    Some(frame)
}
