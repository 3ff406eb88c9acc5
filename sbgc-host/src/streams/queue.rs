//! A bounded queue between the task and one subscriber.
//!
//! The task never waits for a subscriber: a full queue loses its oldest sample and counts it.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker};

use bytes::Bytes;

/// What a subscription yields.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sample {
    /// The payload of one frame.
    Payload(Bytes),
    /// So many samples were lost here, because they were not taken in time.
    Lagged(u64),
}

/// The queue.
#[derive(Debug)]
pub(crate) struct Queue {
    command: u8,
    /// The only length of payload that is taken, if there is but one.
    length: Option<usize>,
    capacity: usize,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    samples: VecDeque<Bytes>,
    lost: u64,
    ended: bool,
    waker: Option<Waker>,
}

impl Queue {
    pub(crate) fn new(command: u8, length: Option<usize>, capacity: usize) -> Self {
        Self { command, length, capacity: capacity.max(1), state: Mutex::default() }
    }

    /// Whether frames like this one are wanted.
    pub(crate) fn takes(&self, command: u8, payload: &Bytes) -> bool {
        command == self.command && self.length.is_none_or(|length| length == payload.len())
    }

    /// Appends a sample; says whether another was lost for it.
    pub(crate) fn push(&self, payload: Bytes) -> bool {
        let mut state = self.lock();
        let full = state.samples.len() >= self.capacity;
        if full {
            state.samples.pop_front();
            state.lost = state.lost.saturating_add(1);
        }
        state.samples.push_back(payload);
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
        if let Some(payload) = state.samples.pop_front() {
            return Poll::Ready(Some(Sample::Payload(payload)));
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

    fn sample(byte: u8) -> Poll<Option<Sample>> {
        Poll::Ready(Some(Sample::Payload(Bytes::copy_from_slice(&[byte]))))
    }

    #[test]
    fn a_full_queue_loses_its_oldest_and_says_how_many() {
        let queue = Queue::new(25, None, 2);
        let lost: Vec<_> = (0..5).map(|byte| queue.push(Bytes::copy_from_slice(&[byte]))).collect();
        assert_eq!(lost, [false, false, true, true, true]);
        assert_eq!(poll(&queue), Poll::Ready(Some(Sample::Lagged(3))));
        assert_eq!((poll(&queue), poll(&queue)), (sample(3), sample(4)));
        assert_eq!(poll(&queue), Poll::Pending);
    }

    #[test]
    fn what_came_before_the_end_is_still_told() {
        let queue = Queue::new(25, None, 2);
        queue.push(Bytes::copy_from_slice(&[1]));
        queue.end();
        assert_eq!((poll(&queue), poll(&queue)), (sample(1), Poll::Ready(None)));
    }

    #[test]
    fn takes_its_command_and_length_only() {
        let queue = Queue::new(88, Some(3), 2);
        assert!(queue.takes(88, &Bytes::from_static(b"abc")));
        assert!(!queue.takes(88, &Bytes::from_static(b"ab")));
        assert!(!queue.takes(25, &Bytes::from_static(b"abc")));
    }
}
