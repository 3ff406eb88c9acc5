//! A bounded queue between the machine and one subscriber.
//!
//! The machine never waits for a subscriber: a full queue drops its oldest sample and counts it. Samples lie one after
//! the other in one buffer, so that none needs memory of its own.

use std::collections::VecDeque;
use std::fmt;
use std::ops::Deref;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use sbgc_proto::CommandId;
use sbgc_proto::frame::MAX_PAYLOAD;

/// What a subscription yields.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(clippy::large_enum_variant, reason = "samples are what it is made for, and need no allocation so")]
pub enum Sample {
    /// The payload of one frame.
    Payload(Payload),
    /// So many samples were lost here, because they were not taken in time.
    Lagged(u64),
    /// The stream has stopped. The driver registers it again until it [resumes](Self::Resumed) or the subscription
    /// ends.
    Interrupted(Interruption),
    /// The stream is back after so much time without samples.
    Resumed(Duration),
}

/// Why a stream has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Interruption {
    /// No samples came for three intervals.
    Silent,
    /// The board was reset.
    Reset,
    /// The board refused to register the stream again. The subscription ends.
    Refused,
    /// The port went away.
    Lost,
}

impl fmt::Display for Interruption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Interruption::Silent => "no samples came for three intervals",
            Interruption::Reset => "the board was reset",
            Interruption::Refused => "the board refused to register the stream again",
            Interruption::Lost => "the port went away",
        })
    }
}

/// The payload of one frame, kept in place.
#[derive(Clone)]
pub struct Payload {
    command: u8,
    length: u8,
    bytes: [u8; MAX_PAYLOAD],
}

impl Payload {
    /// The command id of the frame.
    pub const fn command(&self) -> CommandId {
        CommandId::from_raw(self.command)
    }
}

impl Deref for Payload {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length)).unwrap_or_default()
    }
}

impl AsRef<[u8]> for Payload {
    fn as_ref(&self) -> &[u8] {
        self
    }
}

impl PartialEq for Payload {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Eq for Payload {}

impl fmt::Debug for Payload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Payload").field(&&**self).finish()
    }
}

/// A bounded queue between the machine and one subscriber.
#[derive(Debug)]
pub struct Queue {
    capacity: usize,
    state: Mutex<State>,
}

/// What is in the queue.
#[derive(Clone, Copy, Debug)]
enum Entry {
    /// Of this command, so many of the bytes.
    Sample(u8, u8),
    Interrupted(Interruption),
    Resumed(Duration),
}

#[derive(Debug, Default)]
struct State {
    entries: VecDeque<Entry>,
    /// How many of the entries are samples.
    samples: usize,
    /// The samples, one after the other.
    bytes: VecDeque<u8>,
    lost: u64,
    ended: bool,
    waker: Option<Waker>,
}

impl Queue {
    pub(crate) fn new(capacity: usize) -> Self {
        Self { capacity: capacity.max(1), state: Mutex::default() }
    }

    /// Appends a sample. Returns whether another was lost for it.
    pub(crate) fn push(&self, command: u8, payload: &[u8]) -> bool {
        let mut state = self.lock();
        let full = state.samples >= self.capacity;
        if full {
            state.drop_oldest();
        }
        // No payload is longer; if one were, its end would be missing and nothing else.
        let length = u8::try_from(payload.len()).unwrap_or(u8::MAX);
        state.entries.push_back(Entry::Sample(command, length));
        state.samples += 1;
        state.bytes.extend(payload.iter().take(usize::from(length)));
        wake(state);
        full
    }

    /// No samples come for now.
    pub(super) fn interrupted(&self, interruption: Interruption) {
        self.mark(Entry::Interrupted(interruption));
    }

    /// Samples come again.
    pub(super) fn resumed(&self, after: Duration) {
        self.mark(Entry::Resumed(after));
    }

    fn mark(&self, entry: Entry) {
        let mut state = self.lock();
        state.entries.push_back(entry);
        wake(state);
    }

    /// No more samples will come.
    pub(crate) fn end(&self) {
        let mut state = self.lock();
        state.ended = true;
        wake(state);
    }

    /// The next sample, a gap in them, or `None` when no more will come.
    pub fn poll(&self, context: &mut Context<'_>) -> Poll<Option<Sample>> {
        let mut state = self.lock();
        if state.lost > 0 {
            return Poll::Ready(Some(Sample::Lagged(std::mem::take(&mut state.lost))));
        }
        if let Some(entry) = state.entries.pop_front() {
            return Poll::Ready(Some(match entry {
                Entry::Sample(command, length) => Sample::Payload(state.take(command, length)),
                Entry::Interrupted(interruption) => Sample::Interrupted(interruption),
                Entry::Resumed(after) => Sample::Resumed(after),
            }));
        }
        if state.ended {
            return Poll::Ready(None);
        }
        match &mut state.waker {
            Some(waker) => waker.clone_from(context.waker()),
            none => *none = Some(context.waker().clone()),
        }
        Poll::Pending
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    /// Drops the oldest sample. What is marked around it stays, but for marks that a later one makes useless.
    fn drop_oldest(&mut self) {
        let Some(index) = self.entries.iter().position(|entry| matches!(entry, Entry::Sample(..))) else {
            return;
        };
        if let Some(Entry::Sample(_, length)) = self.entries.remove(index) {
            self.samples = self.samples.saturating_sub(1);
            self.bytes.drain(..usize::from(length).min(self.bytes.len()));
            self.lost = self.lost.saturating_add(1);
        }
        // However long nobody takes anything, the last interruption and its end are all that matter.
        if index > 2 {
            self.entries.pop_front();
        }
    }

    fn take(&mut self, command: u8, length: u8) -> Payload {
        self.samples = self.samples.saturating_sub(1);
        let mut bytes = [0; MAX_PAYLOAD];
        let length_in_use = usize::from(length).min(self.bytes.len());
        for (place, byte) in bytes.iter_mut().zip(self.bytes.drain(..length_in_use)) {
            *place = byte;
        }
        Payload { command, length, bytes }
    }
}

/// Wakes the subscriber, with the lock released.
fn wake(mut state: MutexGuard<'_, State>) {
    let waker = state.waker.take();
    drop(state);
    if let Some(waker) = waker {
        waker.wake();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poll(queue: &Queue) -> Poll<Option<Sample>> {
        queue.poll(&mut Context::from_waker(Waker::noop()))
    }

    fn bytes(sample: Poll<Option<Sample>>) -> Vec<u8> {
        match sample {
            Poll::Ready(Some(Sample::Payload(payload))) => payload.to_vec(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_full_queue_drops_its_oldest_and_says_how_many() {
        let queue = Queue::new(2);
        let lost: Vec<_> = (0..5_u8).map(|byte| queue.push(7, &vec![byte; usize::from(byte)])).collect();
        assert_eq!(lost, [false, false, true, true, true]);
        assert_eq!(poll(&queue), Poll::Ready(Some(Sample::Lagged(3))));
        assert_eq!((bytes(poll(&queue)), bytes(poll(&queue))), (vec![3; 3], vec![4; 4]));
        assert_eq!(poll(&queue), Poll::Pending);
    }

    #[test]
    fn what_came_before_the_end_is_still_told() {
        let queue = Queue::new(2);
        queue.push(7, &[1]);
        queue.push(7, &[]);
        queue.end();
        assert_eq!((bytes(poll(&queue)), bytes(poll(&queue))), (vec![1], vec![]));
        assert_eq!(poll(&queue), Poll::Ready(None));
    }
}
