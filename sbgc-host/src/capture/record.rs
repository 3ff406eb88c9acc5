//! Recordings: every frame that passes a port, with its direction and time, as lines that [`Reader`](super::Reader)
//! reads.
//!
//! [`tap`] stands between a port and the driver and copies what passes; [`Recorder`] writes it, a line per frame and
//! each at once, so that a recording can be read up to its last frame whatever ends the program.

use std::io::{self, Write};
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::{Duration, SystemTime};

use sbgc_proto::Direction;
use sbgc_proto::frame::{Decoder, Event, Version, Versions};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::sync::mpsc;
use tokio::time::Instant;

/// A frame that passed a port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Passed {
    /// When, counted from when the tap was set.
    pub after: Duration,
    /// Which way it went.
    pub direction: Direction,
    /// Version of its framing.
    pub version: Version,
    /// Id of the command.
    pub id: u8,
    /// The payload.
    pub payload: Vec<u8>,
}

/// Frames as they pass a tap, for whoever records or shows them. Ends when the port is closed.
pub type Frames = mpsc::UnboundedReceiver<Passed>;

/// Puts a tap on a port: returns the port to use in its place, and the frames that pass it in both directions.
///
/// Bytes that belong to no frame do not show. A tap that nobody reads any more costs nothing.
pub fn tap<Io>(io: Io) -> (Tap<Io>, Frames) {
    let (tapping, frames) = Tapping::new();
    (tapping.tap(io), frames)
}

/// Puts taps on one port after the other, such as one that is opened again; their frames go the same way.
///
/// ```
/// use std::sync::Arc;
///
/// use sbgc_host::capture::Tapping;
/// use sbgc_host::connect::Wrap;
///
/// let (tapping, _frames) = Tapping::new();
/// let _wrap: Wrap = Arc::new(move |io| Box::new(tapping.tap(io)));
/// ```
#[derive(Clone, Debug)]
pub struct Tapping {
    began: Instant,
    sender: mpsc::UnboundedSender<Passed>,
}

impl Tapping {
    /// Times are counted from now. The frames end when it and all of its taps are dropped.
    pub fn new() -> (Self, Frames) {
        let (sender, frames) = mpsc::unbounded_channel();
        (Self { began: Instant::now(), sender }, frames)
    }

    /// Puts a tap on a port.
    pub fn tap<Io>(&self, io: Io) -> Tap<Io> {
        let side = |direction| Side { direction, decoder: Decoder::new(Versions::Both) };
        let (incoming, outgoing) = (side(Direction::Incoming), side(Direction::Outgoing));
        Tap { io, began: self.began, sender: self.sender.clone(), incoming, outgoing }
    }
}

/// A port with a tap on it, made by [`tap`] or [`Tapping`].
#[derive(Debug)]
pub struct Tap<Io> {
    io: Io,
    began: Instant,
    sender: mpsc::UnboundedSender<Passed>,
    incoming: Side,
    outgoing: Side,
}

#[derive(Debug)]
struct Side {
    direction: Direction,
    decoder: Decoder,
}

impl Side {
    fn feed(&mut self, mut bytes: &[u8], began: Instant, sender: &mpsc::UnboundedSender<Passed>) {
        while let Some(event) = self.decoder.next(&mut bytes) {
            if let Event::Frame { frame, .. } = event {
                let passed = Passed {
                    after: began.elapsed(),
                    direction: self.direction,
                    version: frame.version,
                    id: frame.id,
                    payload: frame.payload.to_vec(),
                };
                // Whoever read them may have enough.
                let _ = sender.send(passed);
            }
        }
    }
}

impl<Io: AsyncRead + Unpin> AsyncRead for Tap<Io> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        ready!(Pin::new(&mut self.io).poll_read(context, buffer))?;
        let Self { incoming, began, sender, .. } = &mut *self;
        incoming.feed(buffer.filled().get(before..).unwrap_or_default(), *began, sender);
        Poll::Ready(Ok(()))
    }
}

impl<Io: AsyncWrite + Unpin> AsyncWrite for Tap<Io> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let written = ready!(Pin::new(&mut self.io).poll_write(context, bytes))?;
        let Self { outgoing, began, sender, .. } = &mut *self;
        outgoing.feed(bytes.get(..written).unwrap_or_default(), *began, sender);
        Poll::Ready(Ok(written))
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_shutdown(context)
    }
}

/// Writes a recording.
///
/// ```
/// use sbgc_host::capture::{Passed, Recorder};
/// use sbgc_host::proto::{Direction, frame::Version};
/// use std::time::{Duration, SystemTime};
///
/// let mut recorder = Recorder::new(Vec::new(), SystemTime::UNIX_EPOCH);
/// recorder.write(&Passed {
///     after: Duration::from_micros(1_500_000),
///     direction: Direction::Outgoing,
///     version: Version::V2,
///     id: 82,
///     payload: vec![1],
/// })?;
/// assert_eq!(recorder.into_inner(), b"1970-01-01T00:00:01.500000Z v2 out: [82,1] 01\n");
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct Recorder<W> {
    writer: W,
    began: SystemTime,
}

impl<W: Write> Recorder<W> {
    /// Writes to `writer`, which should not keep lines back; `began` is when the tap was set.
    pub fn new(writer: W, began: SystemTime) -> Self {
        Self { writer, began }
    }

    /// Writes a frame as one line, in one piece.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn write(&mut self, passed: &Passed) -> io::Result<()> {
        use std::fmt::Write as _;

        let at = self.began.duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default() + passed.after;
        let way = match passed.direction {
            Direction::Outgoing => "out",
            Direction::Incoming => "in",
        };
        let (version, length) = (passed.version.number(), passed.payload.len());
        let mut line = format!("{} v{version} {way}: [{},{length}] ", super::time::iso(at), passed.id);
        for byte in &passed.payload {
            let _ = write!(line, "{byte:02x}");
        }
        line.truncate(line.trim_end().len());
        line.push('\n');
        self.writer.write_all(line.as_bytes())
    }

    /// What it writes to.
    pub fn into_inner(self) -> W {
        self.writer
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capture::{Captured, Format, Reader};
    use tokio::io::{AsyncReadExt, AsyncWriteExt};

    #[tokio::test(start_paused = true)]
    async fn frames_of_both_directions_pass_with_their_times() {
        let (near, mut far) = tokio::io::duplex(64);
        let (mut port, mut frames) = tap(near);
        // A frame in two pieces, noise between frames.
        port.write_all(&[0x24, 0x52, 0x01]).await.unwrap();
        tokio::time::sleep(Duration::from_millis(7)).await;
        port.write_all(&[0x53, 0x01, 0x12, 0x3D]).await.unwrap();
        far.write_all(&[9, 9, 0x3E, 0x52, 0x01, 0x53, 0x01, 0x01]).await.unwrap();
        let mut read = [0; 8];
        port.read_exact(&mut read).await.unwrap();
        let mut sent = [0; 7];
        far.read_exact(&mut sent).await.unwrap();
        assert_eq!((sent[0], read[2]), (0x24, 0x3E), "the bytes themselves pass unchanged");
        let passed = |direction, version| Passed {
            after: Duration::from_millis(7),
            direction,
            version,
            id: 82,
            payload: vec![1],
        };
        assert_eq!(frames.recv().await, Some(passed(Direction::Outgoing, Version::V2)));
        assert_eq!(frames.recv().await, Some(passed(Direction::Incoming, Version::V1)));
        drop(port);
        assert_eq!(frames.recv().await, None);
    }

    #[test]
    fn what_is_recorded_is_read() {
        let began = SystemTime::UNIX_EPOCH + Duration::from_secs(1_795_285_336);
        let mut recorder = Recorder::new(Vec::new(), began);
        let frames = [(Direction::Outgoing, 86, vec![]), (Direction::Incoming, 67, vec![0x5D, 0xFF])];
        for (index, (direction, id, payload)) in frames.iter().enumerate() {
            let after = Duration::from_millis(25 * u64::try_from(index).unwrap());
            let version = Version::V1;
            let passed = Passed { after, direction: *direction, version, id: *id, payload: payload.clone() };
            recorder.write(&passed).unwrap();
        }
        let (mut reader, mut items) = (Reader::new(Format::Auto), Vec::new());
        reader.feed(&recorder.into_inner(), &mut |item| items.push(item)).unwrap();
        reader.finish(&mut |item| items.push(item)).unwrap();
        let read: Vec<_> = items
            .iter()
            .map(|item| match item {
                Captured::Frame { time, version, direction, id, payload, .. } => {
                    (time.unwrap().as_millis(), *version, direction.unwrap(), *id, payload.clone())
                }
                Captured::Skipped { .. } => panic!("{item:?}"),
            })
            .collect();
        let version = Some(Version::V1);
        assert_eq!(
            read,
            [
                (1_795_285_336_000, version, Direction::Outgoing, 86, vec![]),
                (1_795_285_336_025, version, Direction::Incoming, 67, vec![0x5D, 0xFF]),
            ]
        );
    }
}
