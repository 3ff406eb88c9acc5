//! The data streams of one client.

use std::collections::HashMap;

use bytes::Bytes;
use sbgc_proto::commands::{DataStreamInterval, ErrorCode, StreamConfig, Switch};
use sbgc_proto::{CommandId, Message as _};
use tokio::task::AbortHandle;
use tokio::task::JoinSet;

use super::outbox::Outbox;
use super::strays::Strays;
use crate::streams::Sample;
use crate::{Error, Gimbal, StreamRequest, Subscription};

/// Streams that a client may have; the board itself has ten.
const MAXIMUM: usize = 10;

/// The streams that a client has registered. Dropping it ends them.
#[derive(Debug, Default)]
pub(super) struct Streams {
    running: HashMap<(CommandId, StreamConfig), AbortHandle>,
    tasks: JoinSet<()>,
}

impl Streams {
    /// Carries out a registration and answers it as the board would.
    pub(super) async fn register(
        &mut self,
        gimbal: &Gimbal,
        outbox: &Outbox,
        strays: &Strays,
        payload: &Bytes,
    ) {
        let command = DataStreamInterval::ID;
        let refuse = async |code: ErrorCode| outbox.refuse(command, code.raw(), &[]).await;
        let Ok(wanted) = DataStreamInterval::decode(payload) else { return refuse(ErrorCode::CmdSize).await };
        while self.tasks.try_join_next().is_some() {}
        self.running.retain(|_, running| !running.is_finished());
        let key = (wanted.cmd_id, wanted.config);
        if let Some(running) = self.running.remove(&key) {
            running.abort();
            // It is over when the task is.
            while !running.is_finished() {
                if self.tasks.join_next().await.is_none() {
                    break;
                }
            }
        }
        let confirmation = Bytes::copy_from_slice(&[command.raw(), 0]);
        if wanted.interval_ms.0 == 0 {
            return outbox.answer(CommandId::CONFIRM, confirmation).await;
        }
        if self.running.len() >= MAXIMUM {
            return refuse(ErrorCode::OperationFailed).await;
        }
        match subscribe(gimbal, &wanted).await {
            Ok((subscription, every)) => {
                strays.streamed(wanted.cmd_id);
                outbox.answer(CommandId::CONFIRM, confirmation).await;
                let forwarding = forward(subscription, every, wanted.cmd_id, outbox.clone());
                self.running.insert(key, self.tasks.spawn(forwarding));
            }
            Err(Error::Refused { code, data, .. }) => outbox.refuse(command, code, &data).await,
            Err(Error::StreamInUse { .. }) => refuse(ErrorCode::WrongState).await,
            Err(error) => tracing::debug!(%error, "no stream"),
        }
    }
}

/// Subscribes; where the stream runs already at a shorter interval, that one, with how many samples make one.
async fn subscribe(gimbal: &Gimbal, wanted: &DataStreamInterval) -> Result<(Subscription, u32), Error> {
    let asked_ms = wanted.interval_ms.0;
    let synced = wanted.sync_to_data == Switch::On;
    let request = match wanted.source() {
        // The source knows how long its samples are; the bytes that it does not use stay as they came.
        Some(source) => StreamRequest { config: wanted.config.0.0, ..StreamRequest::of(source, asked_ms) },
        None => StreamRequest { config: wanted.config.0.0, ..StreamRequest::new(wanted.cmd_id, asked_ms) },
    };
    let request = StreamRequest { synced, ..request };
    match gimbal.subscribe(request).await {
        Ok(subscription) => Ok((subscription, 1)),
        Err(Error::StreamInUse { running_ms, .. }) if running_ms > 0 && running_ms < asked_ms => {
            let shared = StreamRequest { interval_ms: running_ms, ..request };
            let every = u32::from(asked_ms.div_ceil(running_ms));
            Ok((gimbal.subscribe(shared).await?, every))
        }
        Err(error) => Err(error),
    }
}

/// Hands samples to the client until it leaves.
async fn forward(mut samples: Subscription, every: u32, id: CommandId, outbox: Outbox) {
    let mut skipped = 0;
    while let Some(sample) = samples.next().await {
        let Sample::Payload(payload) = sample else { continue };
        skipped += 1;
        if skipped < every {
            continue;
        }
        skipped = 0;
        if !outbox.sample(id, Bytes::copy_from_slice(&payload)) {
            return;
        }
    }
}
