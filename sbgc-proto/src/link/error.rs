//! What goes wrong on a UART.

use core::fmt;

use super::SendError;
use crate::DecodeError;
use crate::commands::ErrorReport;
use crate::frame::Frame;
use crate::message::Request;

/// Why something did not work on a port, whose own errors are `E`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PortError<E> {
    /// The UART has failed.
    Uart(E),
    /// The message was not taken.
    Send(SendError),
    /// The board has refused the request.
    Refused(ErrorReport),
    /// The request was not answered in time.
    TimedOut,
    /// The answer is too short.
    Decode(DecodeError),
}

impl<E> PortError<E> {
    pub(super) fn refused(frame: &Frame<'_>) -> Self {
        match ErrorReport::from_payload(frame.payload) {
            Ok(report) => Self::Refused(report),
            Err(error) => Self::Decode(error),
        }
    }
}

impl<E> From<SendError> for PortError<E> {
    fn from(error: SendError) -> Self {
        Self::Send(error)
    }
}

impl<E: fmt::Debug> fmt::Display for PortError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uart(error) => write!(f, "the UART failed: {error:?}"),
            Self::Send(error) => error.fmt(f),
            Self::Refused(report) => write!(f, "the board refused the request: {report:?}"),
            Self::TimedOut => f.write_str("the board did not answer in time"),
            Self::Decode(error) => error.fmt(f),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for PortError<E> {}

/// Reads the answer to a request and hands it on.
pub(super) fn read_answer<Q: Request, T, E>(
    request: &Q,
    frame: &Frame<'_>,
    answer: impl FnOnce(Q::Answer<'_>) -> T,
) -> Result<T, PortError<E>> {
    request.decode_answer(frame.payload).map(answer).map_err(PortError::Decode)
}
