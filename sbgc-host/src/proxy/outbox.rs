//! Frames that wait for a client.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use bytes::{BufMut as _, Bytes, BytesMut};
use sbgc_proto::CommandId;
use tokio::sync::mpsc;

/// A frame for a client.
pub(super) type Outgoing = (CommandId, Bytes);

/// Where frames for a client wait.
#[derive(Clone, Debug)]
pub(super) struct Outbox {
    pub(super) sender: mpsc::Sender<Outgoing>,
    /// Whether it spoke version 1 last.
    pub(super) old: Arc<AtomicBool>,
}

impl Outbox {
    /// Puts in an answer, which waits for room.
    pub(super) async fn answer(&self, id: CommandId, payload: Bytes) {
        // A client that has left needs no answer.
        let _ = self.sender.send((id, payload)).await;
    }

    /// Puts in a sample, which is lost where there is no room. False when the client has left.
    pub(super) fn sample(&self, id: CommandId, payload: Bytes) -> bool {
        !matches!(self.sender.try_send((id, payload)), Err(mpsc::error::TrySendError::Closed(_)))
    }

    /// Whether the client has left.
    pub(super) fn is_closed(&self) -> bool {
        self.sender.is_closed()
    }

    /// Puts in a refusal.
    pub(super) async fn refuse(&self, command: CommandId, code: u8, data: &[u8]) {
        let mut payload = BytesMut::with_capacity(2 + data.len().max(4));
        payload.extend_from_slice(&[command.raw(), code]);
        payload.extend_from_slice(data);
        payload.put_bytes(0, 4_usize.saturating_sub(data.len()));
        self.answer(CommandId::Error, payload.freeze()).await;
    }
}
