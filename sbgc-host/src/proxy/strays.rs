//! Who gets what the board sends by itself.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use bytes::Bytes;
use sbgc_proto::CommandId;

use super::outbox::Outbox;
use crate::Gimbal;
use crate::streams::Sample;

/// Hands on frames that are neither answers nor samples, as far as the proxy has to do with it.
///
/// - Confirmations and errors go to the client that sent their command last: of set-points, and the second confirmation
///   of a calibration.
/// - More answers of a kind that a client has asked for, such as the progress of tuning, go to that client.
/// - Everything else, such as events and traces of scripts, goes to all clients, as the board sends it to its port.
/// - Samples of streams that clients have had go to nobody: they were on their way when the stream ended.
#[derive(Clone, Debug, Default)]
pub(super) struct Strays(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    clients: Vec<Outbox>,
    /// Who has sent a command last.
    senders: HashMap<CommandId, Outbox>,
    /// Who has asked last for something that is answered by it.
    askers: HashMap<CommandId, Outbox>,
    streamed: Vec<CommandId>,
}

impl Strays {
    /// A client that has come.
    pub(super) fn add(&self, outbox: &Outbox) {
        let mut state = self.lock();
        // Those that have left make room.
        state.clients.retain(|client| !client.is_closed());
        state.senders.retain(|_, client| !client.is_closed());
        state.askers.retain(|_, client| !client.is_closed());
        state.clients.push(outbox.clone());
    }

    /// A client sends a command.
    pub(super) fn sent(&self, command: CommandId, answer: Option<CommandId>, outbox: &Outbox) {
        let mut state = self.lock();
        state.senders.insert(command, outbox.clone());
        if let Some(answer) = answer.filter(|answer| *answer != CommandId::CONFIRM) {
            state.askers.insert(answer, outbox.clone());
        }
    }

    /// A client has a stream of these messages.
    pub(super) fn streamed(&self, command: CommandId) {
        let mut state = self.lock();
        // Events come without a stream, too.
        if command != CommandId::Event && !state.streamed.contains(&command) {
            state.streamed.push(command);
        }
    }

    /// Hands frames on as long as the link lives.
    pub(super) async fn forward(self, gimbal: Gimbal) {
        let mut strays = gimbal.listen_unsolicited();
        while let Some(sample) = strays.next().await {
            if let Sample::Payload(payload) = sample {
                self.hand_on(payload.command(), Bytes::copy_from_slice(&payload));
            }
        }
    }

    fn hand_on(&self, command: CommandId, payload: Bytes) {
        let state = self.lock();
        let cause = match command {
            CommandId::CONFIRM | CommandId::Error => {
                payload.first().and_then(|command| state.senders.get(&CommandId::from_raw(*command)))
            }
            _ => state.askers.get(&command),
        };
        if let Some(client) = cause {
            client.sample(command, payload);
        } else if !state.streamed.contains(&command) {
            for client in &state.clients {
                client.sample(command, payload.clone());
            }
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
