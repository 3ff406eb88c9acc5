//! A bounded queue between the machine and one subscriber.
//!
//! The machine never waits for a subscriber: a full queue drops its oldest sample and counts it. Samples lie one after
//! the other in one buffer, so that none needs memory of its own.

use std::collections::VecDeque;
use std::fmt;
use std::ops::Deref;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker};

use sbgc_proto::frame::MAX_PAYLOAD;

/// What a subscription yields.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(clippy::large_enum_variant, reason = "samples are what it is made for, and need no allocation so")]
pub enum Sample {
    /// The payload of one frame.
    Payload(Payload),
    /// So many samples were lost here, because they were not taken in time.
    Lagged(u64),
}

/// The payload of one frame, kept in place.
#[derive(Clone)]
pub struct Payload {
    length: u8,
    bytes: [u8; MAX_PAYLOAD],
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

/// The queue.
#[derive(Debug)]
pub(crate) struct Queue {
    capacity: usize,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Lengths of the samples in `bytes`.
    lengths: VecDeque<u8>,
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
    pub(crate) fn push(&self, payload: &[u8]) -> bool {
        let mut state = self.lock();
        let full = state.lengths.len() >= self.capacity;
        if full {
            let oldest = state.lengths.pop_front().unwrap_or_default();
            state.bytes.drain(..usize::from(oldest));
            state.lost = state.lost.saturating_add(1);
        }
        // No payload is longer; if one were, its end would be missing and nothing else.
        let length = u8::try_from(payload.len()).unwrap_or(u8::MAX);
        state.lengths.push_back(length);
        state.bytes.extend(payload.iter().take(usize::from(length)));
        wake(state);
        full
    }

    /// No more samples will come.
    pub(crate) fn end(&self) {
        let mut state = self.lock();
        state.ended = true;
        wake(state);
    }

    pub(crate) fn poll(&self, context: &mut Context<'_>) -> Poll<Option<Sample>> {
        let mut state = self.lock();
        if state.lost > 0 {
            return Poll::Ready(Some(Sample::Lagged(std::mem::take(&mut state.lost))));
        }
        if let Some(length) = state.lengths.pop_front() {
            let mut bytes = [0; MAX_PAYLOAD];
            for (place, byte) in bytes.iter_mut().zip(state.bytes.drain(..usize::from(length))) {
                *place = byte;
            }
            return Poll::Ready(Some(Sample::Payload(Payload { length, bytes })));
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
        let lost: Vec<_> = (0..5_u8).map(|byte| queue.push(&vec![byte; usize::from(byte)])).collect();
        assert_eq!(lost, [false, false, true, true, true]);
        assert_eq!(poll(&queue), Poll::Ready(Some(Sample::Lagged(3))));
        assert_eq!((bytes(poll(&queue)), bytes(poll(&queue))), (vec![3; 3], vec![4; 4]));
        assert_eq!(poll(&queue), Poll::Pending);
    }

    #[test]
    fn what_came_before_the_end_is_still_told() {
        let queue = Queue::new(2);
        queue.push(&[1]);
        queue.push(&[]);
        queue.end();
        assert_eq!((bytes(poll(&queue)), bytes(poll(&queue))), (vec![1], vec![]));
        assert_eq!(poll(&queue), Poll::Ready(None));
    }
}
