//! The data streams that run on the board for this link.
//!
//! A board has ten registrations for all its ports together, so equal requests share one, and one that nobody uses
//! any more is given back.

use std::sync::Weak;

use bytes::Bytes;
use tokio::sync::oneshot;

use super::session::{Call, Failure};
use super::shared::{StreamCall, StreamFailure};
use crate::streams::queue::Queue;

type Reply = oneshot::Sender<Result<(), StreamFailure>>;

#[derive(Debug)]
struct Registration {
    number: u64,
    start: Bytes,
    stop: Bytes,
    users: Vec<Weak<Queue>>,
    /// Who waits for the confirmation; `None` once it has come.
    waiting: Option<Vec<Reply>>,
}

/// All of them.
#[derive(Debug, Default)]
pub(super) struct Registry {
    list: Vec<Registration>,
    next_number: u64,
}

impl Registry {
    /// Adds a user. Returns the number and the request of a registration that is not there yet.
    pub(super) fn add(&mut self, wanted: StreamCall) -> Option<(u64, Call)> {
        let StreamCall { start, stop, user, reply } = wanted;
        if let Some(running) = self.list.iter_mut().find(|running| running.stop == stop) {
            if running.start != start.payload {
                // Nobody is left to hear it if this fails, and nothing is lost.
                let _ = reply.send(Err(StreamFailure::Running(running.start.clone())));
                return None;
            }
            running.users.push(user);
            match &mut running.waiting {
                Some(waiting) => waiting.push(reply),
                None => {
                    let _ = reply.send(Ok(()));
                }
            }
            return None;
        }
        let number = self.next_number;
        self.next_number = number.wrapping_add(1);
        let (users, waiting) = (vec![user], Some(vec![reply]));
        self.list.push(Registration { number, start: start.payload.clone(), stop, users, waiting });
        Some((number, start))
    }

    /// A registration was confirmed, or it failed. Returns the payload that takes back one that may yet be there.
    pub(super) fn settle(&mut self, number: u64, outcome: Result<(), Failure>) -> Option<Bytes> {
        let index = self.list.iter().position(|registration| registration.number == number)?;
        match outcome {
            Ok(()) => {
                let waiting = self.list.get_mut(index)?.waiting.take();
                for reply in waiting.into_iter().flatten() {
                    let _ = reply.send(Ok(()));
                }
                None
            }
            Err(failure) => {
                let registration = self.list.swap_remove(index);
                for reply in registration.waiting.into_iter().flatten() {
                    let _ = reply.send(Err(StreamFailure::Failed(failure.clone())));
                }
                // Perhaps only the confirmation was lost.
                matches!(failure, Failure::Timeout { .. }).then_some(registration.stop)
            }
        }
    }

    /// Payloads that take back what nobody uses any more.
    pub(super) fn sweep(&mut self) -> Vec<Bytes> {
        let mut stops = Vec::new();
        self.list.retain_mut(|registration| {
            registration.users.retain(|user| user.strong_count() > 0);
            let used = !registration.users.is_empty();
            if !used {
                stops.push(registration.stop.clone());
            }
            used
        });
        stops
    }

    /// Payloads that take back everything.
    pub(super) fn clear(&mut self) -> Vec<Bytes> {
        self.list.drain(..).map(|registration| registration.stop).collect()
    }
}
