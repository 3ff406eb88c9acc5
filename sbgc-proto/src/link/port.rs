//! Link on the halves of a blocking UART.

use embedded_io::{Read, ReadReady, Write};

use super::error::{PortError, read_answer};
use super::{Link, Millis, Update};
use crate::frame::Frame;
use crate::message::{Message, Request};
use crate::wire::ToWire;

/// Link with the two halves of a UART and a clock.
///
/// It never blocks on a read: it checks whether a byte is available, and checks the clock in between.
///
/// ```
/// # use core::convert::Infallible;
/// # use sbgc_proto::frame::{Version, encode_into};
/// # struct Receive(Vec<u8>);
/// # impl embedded_io::ErrorType for Receive { type Error = Infallible; }
/// # impl embedded_io::Read for Receive {
/// #     fn read(&mut self, out: &mut [u8]) -> Result<usize, Infallible> {
/// #         let count = out.len().min(self.0.len());
/// #         out[..count].copy_from_slice(&self.0[..count]);
/// #         self.0.drain(..count);
/// #         Ok(count)
/// #     }
/// # }
/// # impl embedded_io::ReadReady for Receive {
/// #     fn read_ready(&mut self) -> Result<bool, Infallible> { Ok(!self.0.is_empty()) }
/// # }
/// # let mut answer = [0; 64];
/// # let receive = Receive(encode_into(Version::V2, 73, &[0; 18], &mut answer).unwrap().to_vec());
/// # let transmit = Vec::new();
/// # struct Transmit(Vec<u8>);
/// # impl embedded_io::ErrorType for Transmit { type Error = Infallible; }
/// # impl embedded_io::Write for Transmit {
/// #     fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> { self.0.extend(bytes); Ok(bytes.len()) }
/// #     fn flush(&mut self) -> Result<(), Infallible> { Ok(()) }
/// # }
/// # let transmit = Transmit(transmit);
/// # let milliseconds = || 0;
/// use sbgc_proto::commands::GetAngles;
/// use sbgc_proto::link::port::Port;
/// use sbgc_proto::link::{Link, Settings};
///
/// let mut port = Port::new(Link::<64>::new(Settings::default()), receive, transmit, milliseconds);
/// let pitch = port.request(&GetAngles {}, |angles| angles.axes.pitch.imu_angle, |_other| {}).unwrap();
/// assert_eq!(pitch.degrees(), 0.0);
/// ```
#[derive(Debug)]
pub struct Port<R, W, C, const N: usize> {
    link: Link<N>,
    receive: R,
    transmit: W,
    clock: C,
}

impl<R: Read + ReadReady, W: Write<Error = R::Error>, C: FnMut() -> Millis, const N: usize> Port<R, W, C, N> {
    /// Connects the link to the halves of a UART. `clock` returns milliseconds.
    pub const fn new(link: Link<N>, receive: R, transmit: W, clock: C) -> Self {
        Self { link, receive, transmit, clock }
    }

    /// Returns the link.
    pub const fn link(&mut self) -> &mut Link<N> {
        &mut self.link
    }

    /// Returns the time of the clock.
    pub fn now(&mut self) -> Millis {
        (self.clock)()
    }

    /// Sends a message without waiting for an answer.
    ///
    /// # Errors
    /// If the message is inconsistent, or the UART fails.
    pub fn send<M: Message + ToWire>(&mut self, message: &M) -> Result<(), PortError<R::Error>> {
        self.link.send(message)?;
        self.flush()
    }

    /// Sends a request and passes its answer to `answer`; other messages received meanwhile go to `other`.
    ///
    /// # Errors
    /// If the board rejects the request or does not respond, the answer is invalid, or the UART fails.
    pub fn request<Q: Request + ToWire, T>(
        &mut self,
        request: &Q,
        answer: impl FnOnce(Q::Answer<'_>) -> T,
        mut other: impl FnMut(Frame<'_>),
    ) -> Result<T, PortError<R::Error>> {
        let now = (self.clock)();
        self.link.request(request, now)?;
        loop {
            match self.poll()? {
                Some(Update::Answer) => return read_answer(request, &self.link.frame(), answer),
                Some(Update::Refused) => return Err(PortError::refused(&self.link.frame())),
                Some(Update::TimedOut) => return Err(PortError::TimedOut),
                Some(Update::Message) => other(self.link.frame()),
                Some(Update::Noise(_)) | None => {}
            }
        }
    }

    /// Sends queued bytes, reads available ones, and returns the next event, whose message [`frame`] returns; `None` if
    /// there is none.
    ///
    /// [`frame`]: Link::frame
    ///
    /// # Errors
    /// If the UART fails.
    pub fn poll(&mut self) -> Result<Option<Update>, PortError<R::Error>> {
        loop {
            let now = (self.clock)();
            let update = self.link.poll(now);
            self.flush()?;
            if update.is_some() || !self.receive.read_ready().map_err(PortError::Uart)? {
                return Ok(update);
            }
            let mut byte = [0];
            match self.receive.read(&mut byte).map_err(PortError::Uart)? {
                0 => return Ok(None),
                _ => self.link.receive(byte[0], now),
            }
        }
    }

    /// Message that [`poll`](Self::poll) reported last.
    pub fn frame(&self) -> Frame<'_> {
        self.link.frame()
    }

    fn flush(&mut self) -> Result<(), PortError<R::Error>> {
        while !self.link.output().is_empty() {
            let count = self.transmit.write(self.link.output()).map_err(PortError::Uart)?;
            if count == 0 {
                break;
            }
            self.link.sent(count);
        }
        Ok(())
    }
}
