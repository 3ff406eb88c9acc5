//! Being asked to stop: SIGINT, SIGTERM, SIGHUP and SIGQUIT.
//!
//! Handlers are installed before anything is printed, so whoever waits for the first line may send a signal at once.
//! Work with a board ends by [`stopped`], so that streams are unregistered and motion stops; work that cannot be
//! interrupted runs in [`blocking`]. A second signal of an impatient user ends the program at once.

use std::fmt;

/// A signal that asks the program to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Signal(i32);

impl Signal {
    /// What a shell reports of a program that was ended by it.
    pub(crate) fn code(self) -> u8 {
        u8::try_from(128 + self.0).unwrap_or(u8::MAX)
    }

    /// Whether it ends a command as usual that runs until it is stopped.
    pub(crate) fn is_ordinary(self) -> bool {
        // SIGHUP, SIGINT, SIGTERM; SIGQUIT is for giving up.
        matches!(self.0, 1 | 2 | 15)
    }
}

impl fmt::Display for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            1 => f.write_str("SIGHUP"),
            2 => f.write_str("SIGINT"),
            3 => f.write_str("SIGQUIT"),
            15 => f.write_str("SIGTERM"),
            other => write!(f, "signal {other}"),
        }
    }
}

pub(crate) use system::{blocking, install, interrupted, stopped};

#[cfg(unix)]
mod system {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{LazyLock, Mutex, PoisonError};
    use std::time::{Duration, Instant};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::iterator::Signals;
    use tokio::sync::{oneshot, watch};

    use super::Signal;

    /// The signal that came.
    static STOP: LazyLock<watch::Sender<Option<Signal>>> = LazyLock::new(|| watch::Sender::new(None));
    /// Whether work runs that does not look at it.
    static BLOCKING: AtomicBool = AtomicBool::new(false);
    /// Who asks a question that an interrupt answers with no.
    static ASKING: Mutex<Option<oneshot::Sender<()>>> = Mutex::new(None);

    /// How soon after the first a signal may come from the same cause, as when a terminal is closed.
    const SAME: Duration = Duration::from_millis(500);

    /// Installs the handlers. Without them the program is ended as the system does it.
    pub(crate) fn install() {
        let mut wanted = vec![SIGINT, SIGTERM, SIGQUIT];
        if !hangup_is_ignored() {
            wanted.push(SIGHUP);
        }
        let Ok(mut signals) = Signals::new(wanted) else { return };
        std::thread::spawn(move || {
            let mut first: Option<Instant> = None;
            for number in signals.forever() {
                let signal = Signal(number);
                let asking = ASKING.lock().unwrap_or_else(PoisonError::into_inner).take();
                match asking {
                    Some(asking) if number == SIGINT => {
                        let _ = asking.send(());
                        continue;
                    }
                    _ => {}
                }
                let again = first.is_some_and(|first| first.elapsed() >= SAME);
                if again || BLOCKING.load(Ordering::Relaxed) {
                    std::process::exit(signal.code().into());
                }
                first.get_or_insert_with(Instant::now);
                STOP.send_if_modified(|stop| stop.replace(signal).is_none());
            }
        });
    }

    /// Whether `nohup` or the like wants the program to live on.
    fn hangup_is_ignored() -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
            .is_some_and(|mask| mask & (1 << (SIGHUP - 1)) != 0)
    }

    /// Resolves when the program is asked to stop.
    pub(crate) async fn stopped() -> Signal {
        let mut stop = STOP.subscribe();
        let signal = stop.wait_for(Option::is_some).await.ok().and_then(|signal| *signal);
        match signal {
            Some(signal) => signal,
            None => std::future::pending().await,
        }
    }

    /// Resolves when the user interrupts a question that is asked from now on. Other signals stop the program as ever.
    pub(crate) fn interrupted() -> impl Future<Output = ()> {
        let (sender, receiver) = oneshot::channel();
        *ASKING.lock().unwrap_or_else(PoisonError::into_inner) = Some(sender);
        async move {
            if receiver.await.is_err() {
                std::future::pending::<()>().await;
            }
        }
    }

    /// Runs work that does not look for signals: while it runs, they end the program at once.
    pub(crate) fn blocking<T>(work: impl FnOnce() -> T) -> T {
        if let Some(signal) = *STOP.borrow() {
            std::process::exit(signal.code().into());
        }
        BLOCKING.store(true, Ordering::Relaxed);
        let result = work();
        BLOCKING.store(false, Ordering::Relaxed);
        result
    }
}

#[cfg(not(unix))]
mod system {
    use super::Signal;

    /// The system knows the keyboard's interrupt only, and asks for it when somebody waits.
    pub(crate) fn install() {}

    /// Resolves when the program is interrupted from the keyboard.
    pub(crate) async fn stopped() -> Signal {
        match tokio::signal::ctrl_c().await {
            Ok(()) => Signal(2),
            Err(_) => std::future::pending().await,
        }
    }

    /// Resolves when the user interrupts a question.
    pub(crate) async fn interrupted() {
        stopped().await;
    }

    /// Runs work that does not look for signals.
    pub(crate) fn blocking<T>(work: impl FnOnce() -> T) -> T {
        work()
    }
}
