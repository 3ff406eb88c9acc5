//! Owning the motion until something ends it.

use std::io;
use std::time::Duration;

use sbgc_host::{ControlSession, Error, Gimbal, SessionOptions};
use sbgc_proto::wire::PerAxis;
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::output::Output;
use crate::signals;

/// How often set-points are sent: the board ends control after a second without one.
const INTERVAL: Duration = Duration::from_millis(100);

/// How often the board is asked whether it is there, and the output whether anybody reads it.
const WATCH: Duration = Duration::from_millis(200);

/// How many questions in a row may stay without an answer.
const SILENT: u32 = 3;

/// How the motion ends that was owned.
pub(super) enum End {
    /// The axes stop.
    Stop,
    /// The axes are held where they were told to go.
    Hold,
}

/// Does `work` while a session owns the motion, and ends the session as that says.
///
/// A signal, a closed output, a board that is gone and any error stop the axes that were moved.
pub(super) async fn own(
    gimbal: &Gimbal,
    output: &Output,
    work: impl AsyncFnOnce(&ControlSession) -> Result<End, Failure>,
) -> Result<(), Failure> {
    let options = SessionOptions { interval: INTERVAL, confirmations: true, ..SessionOptions::default() };
    let session = tokio::select! {
        biased;
        signal = signals::stopped() => return Err(Failure::Signal(signal)),
        session = ControlSession::start(gimbal, options) => session?,
    };
    let outcome = tokio::select! {
        biased;
        signal = signals::stopped() => Err(Failure::Signal(signal)),
        outcome = work(&session) => outcome,
        failure = watch(gimbal, output) => Err(failure),
    };
    match outcome {
        Ok(End::Hold) => Ok(session.hold().await?),
        Ok(End::Stop) => Ok(session.stop().await?),
        Err(failure) => {
            // What ended it says more than that the board did not confirm the stop, which was sent all the same.
            let _ = session.stop().await;
            Err(failure)
        }
    }
}

/// Returns when nobody reads the output any more, or the board is gone.
async fn watch(gimbal: &Gimbal, output: &Output) -> Failure {
    let mut silent = 0;
    loop {
        tokio::time::sleep(WATCH).await;
        // Tests have a debug build panic here.
        debug_assert!(std::env::var_os("SBGC_TEST_PANIC").is_none(), "SBGC_TEST_PANIC is set");
        if output.is_abandoned() {
            return Failure::Output(io::ErrorKind::BrokenPipe.into());
        }
        match gimbal.angles().await {
            Ok(_) => silent = 0,
            Err(Error::Timeout { .. }) if silent + 1 < SILENT => silent += 1,
            Err(error) => return error.into(),
        }
    }
}

/// The values of the axes as the members of an outcome.
pub(super) fn members(values: PerAxis<Option<f32>>) -> Value {
    let plain = |value: Option<f32>| value.map(crate::values::plain);
    json!({"roll": plain(values.roll), "pitch": plain(values.pitch), "yaw": plain(values.yaw)})
}
