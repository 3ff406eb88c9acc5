//! Being asked to stop.

/// Resolves when the program is asked to stop: interrupted from the keyboard, or terminated.
#[cfg(unix)]
pub(crate) async fn stopped() {
    use tokio::signal::unix::{SignalKind, signal};

    match signal(SignalKind::terminate()) {
        Ok(mut terminate) => tokio::select! {
            _ = tokio::signal::ctrl_c() => {}
            _ = terminate.recv() => {}
        },
        Err(_) => drop(tokio::signal::ctrl_c().await),
    }
}

/// Resolves when the program is interrupted from the keyboard.
#[cfg(not(unix))]
pub(crate) async fn stopped() {
    drop(tokio::signal::ctrl_c().await);
}
