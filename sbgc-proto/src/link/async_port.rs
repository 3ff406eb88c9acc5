//! The link on the halves of a UART whose calls are futures.

use core::future::{Future, poll_fn};
use core::pin::pin;
use core::task::Poll;

use embedded_io_async::{Read, Write};

use super::error::{PortError, read_answer};
use super::{Link, Millis, Update};
use crate::frame::Frame;
use crate::message::{Message, Request};
use crate::wire::ToWire;

/// What an [`AsyncPort`] needs to know of time.
#[allow(async_fn_in_trait, reason = "firmware runs its futures where they are made")]
pub trait Clock {
    /// The time in milliseconds, from any moment on.
    fn now(&mut self) -> Millis;

    /// Waits until the time is `moment`, or past it.
    async fn wait_until(&mut self, moment: Millis);
}

/// Bytes taken from the UART at once.
const CHUNK: usize = 16;

/// A link with the two halves of a UART and a clock.
///
/// Every future here may be dropped at any moment: what was received and what waits to be sent stays in the link, as
/// long as the UART's own `read` and `write` lose nothing when they are dropped. A request whose future was dropped is
/// given up by the next one.
#[derive(Debug)]
pub struct AsyncPort<R, W, C, const N: usize> {
    link: Link<N>,
    receive: R,
    transmit: W,
    clock: C,
    chunk: [u8; CHUNK],
    /// Which bytes of the chunk the link has not taken.
    rest: core::ops::Range<usize>,
}

impl<R: Read, W: Write<Error = R::Error>, C: Clock, const N: usize> AsyncPort<R, W, C, N> {
    /// Puts the link on the halves of a UART.
    pub const fn new(link: Link<N>, receive: R, transmit: W, clock: C) -> Self {
        Self { link, receive, transmit, clock, chunk: [0; CHUNK], rest: 0..0 }
    }

    /// The link.
    pub const fn link(&mut self) -> &mut Link<N> {
        &mut self.link
    }

    /// Sends a message that nothing answers, or whose answer does not matter.
    ///
    /// # Errors
    /// If it cannot be written, or the UART fails.
    pub async fn send<M: Message + ToWire>(&mut self, message: &M) -> Result<(), PortError<R::Error>> {
        self.link.send(message)?;
        self.flush().await
    }

    /// Sends a request and hands its answer to `answer`; what else comes meanwhile goes to `other`.
    ///
    /// # Errors
    /// If the board refuses or is silent, the answer cannot be read, or the UART fails.
    pub async fn request<Q: Request + ToWire, T>(
        &mut self,
        request: &Q,
        answer: impl FnOnce(Q::Answer<'_>) -> T,
        mut other: impl FnMut(Frame<'_>),
    ) -> Result<T, PortError<R::Error>> {
        // Of a request whose future was dropped.
        self.link.cancel();
        let now = self.clock.now();
        self.link.request(request, now)?;
        loop {
            match self.next().await? {
                Update::Answer => return read_answer(request, &self.link.frame(), answer),
                Update::Refused => return Err(PortError::refused(&self.link.frame())),
                Update::TimedOut => return Err(PortError::TimedOut),
                Update::Message => other(self.link.frame()),
                Update::Noise(_) => {}
            }
        }
    }

    /// Waits until something has happened; [`frame`](Self::frame) has the message.
    ///
    /// # Errors
    /// If the UART fails.
    pub async fn next(&mut self) -> Result<Update, PortError<R::Error>> {
        loop {
            let now = self.clock.now();
            let update = self.link.poll(now);
            if let Some(update) = update {
                return Ok(update);
            }
            self.flush().await?;
            if let Some(&byte) = self.rest.next().and_then(|index| self.chunk.get(index)) {
                self.link.receive(byte, now);
                continue;
            }
            let deadline = self.link.deadline();
            let read = self.receive.read(&mut self.chunk);
            let wait = async {
                match deadline {
                    Some(moment) => self.clock.wait_until(moment).await,
                    None => core::future::pending().await,
                }
            };
            if let Some(count) = first(read, wait).await {
                self.rest = 0..count.map_err(PortError::Uart)?;
            }
        }
    }

    /// The message that [`next`](Self::next) told of last.
    pub fn frame(&self) -> Frame<'_> {
        self.link.frame()
    }

    async fn flush(&mut self) -> Result<(), PortError<R::Error>> {
        while !self.link.output().is_empty() {
            let count = self.transmit.write(self.link.output()).await.map_err(PortError::Uart)?;
            if count == 0 {
                break;
            }
            self.link.sent(count);
        }
        Ok(())
    }
}

/// What `work` comes to, unless `limit` ends before it.
async fn first<T>(work: impl Future<Output = T>, limit: impl Future<Output = ()>) -> Option<T> {
    let (mut work, mut limit) = (pin!(work), pin!(limit));
    poll_fn(|context| match work.as_mut().poll(context) {
        Poll::Ready(value) => Poll::Ready(Some(value)),
        Poll::Pending => limit.as_mut().poll(context).map(|()| None),
    })
    .await
}
