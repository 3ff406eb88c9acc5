//! What the handles and the task share without asking each other.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use bytes::Bytes;
use sbgc_proto::frame::Version;
use tokio::sync::{Notify, oneshot, watch};

use super::LinkCounters;
use super::session::{Call, Failure};
use crate::streams::queue::Queue;

/// Whether the port is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LinkState {
    /// It is.
    Open,
    /// It went away.
    Lost,
    /// It was closed from this side.
    Closed,
}

/// What a handle asks of the task.
#[derive(Debug)]
pub(crate) enum Command {
    /// To send a request and hand back its answer.
    Call(Call, oneshot::Sender<Result<Bytes, Failure>>),
    /// To send a command.
    Send(u8, Bytes),
    /// To keep a data stream running as long as there are users of it.
    Stream(StreamCall),
    /// To send what is still to be sent, and end.
    Close,
}

/// A data stream that is wanted.
#[derive(Debug)]
pub(crate) struct StreamCall {
    /// The request that starts it.
    pub(crate) start: Call,
    /// Payload of the command that stops it. Equal for streams that are the same to the board.
    pub(crate) stop: Bytes,
    /// Who wants it.
    pub(crate) user: Weak<Queue>,
    pub(crate) reply: oneshot::Sender<Result<(), StreamFailure>>,
}

/// Why a stream does not run.
#[derive(Clone, Debug)]
pub(crate) enum StreamFailure {
    /// The board did not take the request.
    Failed(Failure),
    /// It runs already, started by this other payload.
    Running(Bytes),
}

/// The part in common.
#[derive(Debug)]
pub(crate) struct Shared {
    version: AtomicU8,
    /// Rung when a set-point was put in or a subscriber left.
    pub(crate) bell: Notify,
    setpoints: Mutex<Vec<(u8, Bytes)>>,
    listeners: Mutex<Vec<Arc<Queue>>>,
    counters: Mutex<LinkCounters>,
    /// Whether a control session or a calibration owns the motion.
    pub(crate) motion_owned: AtomicBool,
    pub(crate) state: watch::Sender<LinkState>,
}

impl Shared {
    pub(crate) fn new(version: Version) -> Self {
        Self {
            version: AtomicU8::new(version.start_byte()),
            bell: Notify::new(),
            setpoints: Mutex::default(),
            listeners: Mutex::default(),
            counters: Mutex::default(),
            motion_owned: AtomicBool::new(false),
            state: watch::Sender::new(LinkState::Open),
        }
    }

    /// The version in which frames go out.
    pub(crate) fn version(&self) -> Version {
        Version::from_start_byte(self.version.load(Ordering::Relaxed)).unwrap_or(Version::V2)
    }

    pub(crate) fn set_version(&self, version: Version) {
        self.version.store(version.start_byte(), Ordering::Relaxed);
    }

    /// Puts in a set-point, in place of an older one that was not yet sent.
    pub(crate) fn put_setpoint(&self, command: u8, payload: Bytes) {
        let mut setpoints = lock(&self.setpoints);
        match setpoints.iter_mut().find(|(other, _)| *other == command) {
            Some(older) => {
                older.1 = payload;
                drop(setpoints);
                lock(&self.counters).superseded += 1;
            }
            None => {
                setpoints.push((command, payload));
                drop(setpoints);
                self.bell.notify_one();
            }
        }
    }

    /// The set-point that waits longest, if its payload is not longer than `room`.
    pub(crate) fn take_setpoint(&self, room: usize) -> Option<(u8, Bytes)> {
        let mut setpoints = lock(&self.setpoints);
        let fits = setpoints.first().is_some_and(|(_, payload)| payload.len() <= room);
        fits.then(|| setpoints.remove(0))
    }

    pub(crate) fn has_setpoint(&self) -> bool {
        !lock(&self.setpoints).is_empty()
    }

    pub(crate) fn counters(&self) -> LinkCounters {
        *lock(&self.counters)
    }

    pub(crate) fn count(&self, change: impl FnOnce(&mut LinkCounters)) {
        change(&mut lock(&self.counters));
    }

    pub(crate) fn add_listener(&self, queue: Arc<Queue>) {
        lock(&self.listeners).push(queue);
        // The task may have ended meanwhile, and would not end this one.
        if *self.state.borrow() != LinkState::Open {
            self.end_listeners();
        }
    }

    pub(crate) fn remove_listener(&self, queue: &Arc<Queue>) {
        lock(&self.listeners).retain(|other| !Arc::ptr_eq(other, queue));
    }

    pub(crate) fn end_listeners(&self) {
        lock(&self.listeners).iter().for_each(|queue| queue.end());
    }

    /// Hands a frame to all who listen; says whether there was anybody.
    pub(crate) fn publish(&self, command: u8, payload: &Bytes) -> bool {
        let (mut taken, mut lost) = (false, 0);
        for queue in lock(&self.listeners).iter().filter(|queue| queue.takes(command, payload)) {
            taken = true;
            lost += u64::from(queue.push(payload.clone()));
        }
        if lost > 0 {
            self.count(|counters| counters.lost_samples += lost);
        }
        taken
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
