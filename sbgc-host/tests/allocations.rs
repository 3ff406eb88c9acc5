//! Streamed frames cost no allocation, from the port to the subscriber.

mod support;

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};

use sbgc_host::proto::Message;
use sbgc_host::proto::commands::RealtimeData4;
use sbgc_host::streams::Item;
use sbgc_host::{Gimbal, Options};
use support::*;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::runtime::Builder;

/// A port at which a board confirms what it is sent, and then streams without end.
struct Port {
    confirmation: Vec<u8>,
    sample: Vec<u8>,
    confirms: usize,
    streams: bool,
    /// Samples before it has nothing for a moment, so that the subscriber gets its turn.
    left: usize,
}

impl AsyncRead for Port {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        if self.confirms > 0 {
            self.confirms -= 1;
            buffer.put_slice(&self.confirmation);
        } else if self.streams && self.left > 0 {
            self.left -= 1;
            buffer.put_slice(&self.sample);
        } else {
            self.left = 2;
            context.waker().wake_by_ref();
            return Poll::Pending;
        }
        Poll::Ready(Ok(()))
    }
}

impl AsyncWrite for Port {
    fn poll_write(mut self: Pin<&mut Self>, _: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        (self.confirms, self.streams) = (self.confirms + 1, true);
        Poll::Ready(Ok(bytes.len()))
    }

    fn poll_flush(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }
}

#[test]
fn a_streamed_frame_allocates_nothing() {
    let mut payload = [0; 255];
    let sample = RealtimeData4::default().encode(&mut payload).unwrap();
    let (confirmation, sample) = (encoded(CONFIRM, &[STREAM]), encoded(REALTIME_4, sample));
    let port = Port { confirmation, sample, confirms: 0, streams: false, left: 0 };
    let runtime = Builder::new_current_thread().enable_time().build().unwrap();
    let mut samples = runtime.block_on(async {
        let gimbal = Gimbal::spawn(port, Options::default());
        gimbal.stream::<RealtimeData4>(MS(10)).await.unwrap()
    });
    // The driver's task runs on this thread as well, in between.
    let mut receive = |count: usize| {
        allocation_counter::measure(|| {
            runtime.block_on(async {
                for _ in 0..count {
                    assert!(matches!(samples.next().await, Some(Item::Message(_))));
                }
            });
        })
        .count_total
    };
    // Queues grow to their size at first.
    receive(1000);
    let (few, many) = (receive(10), receive(10_000));
    assert_eq!(few, many, "allocations for 10 and for 10,000 frames");
}
