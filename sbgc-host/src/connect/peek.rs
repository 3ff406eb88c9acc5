//! The first bytes that come from a port.

use std::io;
use std::pin::Pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll};

use bytes::Bytes;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};

use crate::transport::Io;

/// How many bytes are kept: two of the longest frames of any protocol that is to be recognised.
const KEPT: usize = 600;

/// The bytes that were kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Peeked(Arc<Mutex<Vec<u8>>>);

impl Peeked {
    /// A port of which the first bytes are kept.
    pub(super) fn new(io: Io) -> (Self, Peek) {
        let peeked = Self::default();
        (peeked.clone(), Peek { io, peeked })
    }

    pub(super) fn bytes(&self) -> Bytes {
        Bytes::copy_from_slice(&self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn keep(&self, bytes: &[u8]) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let room = KEPT.saturating_sub(kept.len());
        kept.extend(bytes.iter().take(room));
    }
}

/// A port that passes everything on.
pub(super) struct Peek {
    io: Io,
    peeked: Peeked,
}

impl AsyncRead for Peek {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        let polled = Pin::new(&mut self.io).poll_read(context, buffer);
        self.peeked.keep(buffer.filled().get(before..).unwrap_or_default());
        polled
    }
}

impl AsyncWrite for Peek {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.io).poll_write(context, bytes)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_shutdown(context)
    }
}
