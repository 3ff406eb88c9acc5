//! Link on the halves of an asynchronous UART.

use core::future::{Future, poll_fn};
use core::pin::pin;
use core::task::Poll;

use embedded_io_async::{Read, Write};

use super::error::{PortError, read_answer};
use super::{Link, Millis, Update};
use crate::frame::Frame;
use crate::message::{Message, Request};
use crate::wire::ToWire;

/// Clock of an [`AsyncPort`].
#[allow(async_fn_in_trait, reason = "firmware runs its futures where they are made")]
pub trait Clock {
    /// Returns the time in milliseconds, counted from any moment.
    fn now(&mut self) -> Millis;

    /// Waits until the time has reached `moment`.
    async fn wait_until(&mut self, moment: Millis);
}

/// Bytes taken from the UART at once.
const CHUNK: usize = 16;

/// Link with the two halves of a UART and a clock.
///
/// All futures can be dropped at any time: received and queued bytes stay in the link, provided that the UART's `read`
/// and `write` lose nothing when dropped. A request whose future was dropped is abandoned by the next one.
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
    /// Connects the link to the halves of a UART.
    pub const fn new(link: Link<N>, receive: R, transmit: W, clock: C) -> Self {
        Self { link, receive, transmit, clock, chunk: [0; CHUNK], rest: 0..0 }
    }

    /// Returns the link.
    pub const fn link(&mut self) -> &mut Link<N> {
        &mut self.link
    }

    /// Sends a message without waiting for an answer.
    ///
    /// # Errors
    /// If the message is inconsistent, or the UART fails.
    pub async fn send<M: Message + ToWire>(&mut self, message: &M) -> Result<(), PortError<R::Error>> {
        self.link.send(message)?;
        self.flush().await
    }

    /// Sends a request and passes its answer to `answer`; other messages received meanwhile go to `other`.
    ///
    /// # Errors
    /// If the board rejects the request or does not respond, the answer is invalid, or the UART fails.
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

    /// Waits for the next event, whose message [`frame`](Self::frame) returns.
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

    /// Message that [`next`](Self::next) reported last.
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

#[cfg(test)]
mod tests {
    use core::cell::Cell;
    use core::convert::Infallible;
    use core::task::{Context, Waker};
    use std::collections::VecDeque;
    use std::rc::Rc;

    use super::*;
    use crate::commands::{Angles, BoardInfo, BoardInfoRequest, GetAngles};
    use crate::frame::{MAX_FRAME, Version, encode_into};
    use crate::link::Settings;

    /// A line that hands over a few bytes on every second look.
    struct Line {
        bytes: VecDeque<u8>,
        turn: bool,
    }

    impl embedded_io_async::ErrorType for Line {
        type Error = Infallible;
    }

    impl Read for Line {
        async fn read(&mut self, out: &mut [u8]) -> Result<usize, Infallible> {
            poll_fn(|_| {
                self.turn = !self.turn;
                if self.turn || self.bytes.is_empty() { Poll::Pending } else { Poll::Ready(()) }
            })
            .await;
            let count = out.len().min(self.bytes.len()).min(5);
            for place in &mut out[..count] {
                *place = self.bytes.pop_front().unwrap();
            }
            Ok(count)
        }
    }

    /// Takes one byte on every second look.
    struct Sent(Rc<Cell<Vec<u8>>>, bool);

    impl embedded_io_async::ErrorType for Sent {
        type Error = Infallible;
    }

    impl Write for Sent {
        async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
            poll_fn(|_| {
                self.1 = !self.1;
                if self.1 { Poll::Pending } else { Poll::Ready(()) }
            })
            .await;
            let mut all = self.0.take();
            all.push(bytes[0]);
            self.0.set(all);
            Ok(1)
        }

        async fn flush(&mut self) -> Result<(), Infallible> {
            Ok(())
        }
    }

    /// Each look at it takes a millisecond while somebody waits.
    struct Turns(Millis);

    impl Clock for Turns {
        fn now(&mut self) -> Millis {
            self.0
        }

        async fn wait_until(&mut self, moment: Millis) {
            poll_fn(|_| {
                self.0 += 1;
                if self.0 >= moment { Poll::Ready(()) } else { Poll::Pending }
            })
            .await;
        }
    }

    type Sending = Rc<Cell<Vec<u8>>>;

    fn port(frames: &[(crate::CommandId, &[u8])]) -> (AsyncPort<Line, Sent, Turns, 64>, Sending) {
        let mut bytes = VecDeque::from(vec![0x24, 0x20, 0xC8, 0xE8]);
        for (id, payload) in frames {
            bytes.extend(encode_into(Version::V2, id.raw(), payload, &mut [0; MAX_FRAME]).unwrap());
        }
        let sending = Sending::default();
        let receive = Line { bytes, turn: false };
        let link = Link::new(Settings { attempts: 1, ..Settings::DEFAULT });
        (AsyncPort::new(link, receive, Sent(Rc::clone(&sending), false), Turns(0)), sending)
    }

    /// Polls at most so often; `None` if it was not done by then and is dropped.
    fn run<T>(work: impl Future<Output = T>, polls: usize) -> Option<T> {
        let (mut work, mut context) = (pin!(work), Context::from_waker(Waker::noop()));
        (0..polls).find_map(|_| match work.as_mut().poll(&mut context) {
            Poll::Ready(value) => Some(value),
            Poll::Pending => None,
        })
    }

    #[test]
    fn a_request_is_answered_behind_noise_and_other_messages() {
        let (mut port, sending) = port(&[(Angles::ID, &[7; 18]), (BoardInfo::ID, &[36; 18])]);
        let mut others = Vec::new();
        let request =
            port.request(&BoardInfoRequest {}, |info| info.board_ver.number(), |frame| others.push(frame.id));
        assert_eq!(run(request, 1000), Some(Ok(3.6)));
        assert_eq!(others, [Angles::ID.raw()]);
        assert_eq!(sending.take(), [0x24, 0x56, 0x00, 0x56, 0x74, 0x06]);
    }

    #[test]
    fn silence_ends_a_request() {
        let (mut port, _) = port(&[]);
        let request = port.request(&GetAngles {}, |_| (), |_| {});
        assert_eq!(run(request, 1000), Some(Err(PortError::TimedOut)));
    }

    #[test]
    fn futures_that_are_dropped_anywhere_lose_nothing() {
        for polls in 1..20 {
            let frames: [(_, &[u8]); 3] =
                [(Angles::ID, &[1; 18]), (BoardInfo::ID, &[36; 18]), (Angles::ID, &[2; 18])];
            let (mut port, sending) = port(&frames);
            port.link().request(&BoardInfoRequest {}, 0).unwrap();
            let mut seen = Vec::new();
            for _ in 0..1000 {
                if let Some(update) = run(port.next(), polls)
                    && !matches!(update, Ok(Update::Noise(_)))
                {
                    seen.push((update.unwrap(), port.frame().payload.to_vec()));
                }
            }
            let expected = [
                (Update::Message, vec![1; 18]),
                (Update::Answer, vec![36; 18]),
                (Update::Message, vec![2; 18]),
            ];
            assert_eq!(seen, expected, "dropped after {polls} polls");
            assert_eq!(sending.take(), [0x24, 0x56, 0x00, 0x56, 0x74, 0x06]);
        }
    }
}
