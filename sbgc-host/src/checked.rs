//! Commands of which the protocol does not say whether they are confirmed.

use std::future::poll_fn;
use std::task::Poll;

use bytes::Bytes;
use sbgc_proto::commands::Confirm;
use sbgc_proto::wire::ToWire;
use sbgc_proto::{CommandId, Message};

use crate::error::Result;
use crate::gimbal::{Gimbal, encode, explain};
use crate::machine::{Failure, Payload};
use crate::streams::{Sample, Subscription};

impl Gimbal {
    /// Sends a command that may be confirmed or not, and finds out whether the board took it.
    ///
    /// A request goes out right behind it. The board works in order, so once that is answered, a refusal or a
    /// confirmation of the command would have come before. Returns the confirmation, if there was one.
    ///
    /// # Errors
    /// If the board refuses the command, or does not answer the request.
    pub async fn send_checked<M: Message + ToWire>(&self, command: &M) -> Result<Option<Confirm>> {
        self.send_checked_raw(M::ID, encode(command)?).await
    }

    /// Like [`send_checked`](Self::send_checked), for payload bytes.
    ///
    /// # Errors
    /// If the board refuses the command, or does not answer the request.
    pub async fn send_checked_raw(&self, id: CommandId, payload: Bytes) -> Result<Option<Confirm>> {
        let mut errors = self.listen(CommandId::Error);
        let mut confirmations = self.listen(CommandId::CONFIRM);
        self.send_raw(id, payload).await?;
        self.board_info().await?;
        while let Some(payload) = next_now(&mut errors).await {
            let (code, data) = match *payload {
                [code] | [code, _, _, _, _] => (code, payload.get(1..)),
                [command, code, ..] if command == id.raw() => (code, payload.get(2..)),
                _ => continue,
            };
            let data = Bytes::copy_from_slice(data.unwrap_or_default());
            return Err(explain(id, Failure::Refused { code, data }));
        }
        while let Some(payload) = next_now(&mut confirmations).await {
            if let Ok(confirm) = Confirm::decode(&payload)
                && confirm.cmd_id == id
            {
                return Ok(Some(confirm));
            }
        }
        Ok(None)
    }
}

/// The next payload that is already there.
async fn next_now(samples: &mut Subscription) -> Option<Payload> {
    loop {
        let mut next = std::pin::pin!(samples.next());
        let sample = poll_fn(|context| {
            Poll::Ready(match next.as_mut().poll(context) {
                Poll::Ready(sample) => sample,
                Poll::Pending => None,
            })
        });
        if let Sample::Payload(payload) = sample.await? {
            return Some(payload);
        }
    }
}
