//! One client: its frames in, answers and samples out.

use std::future::poll_fn;
use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::task::Poll;
use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::commands::{DataStreamInterval, ErrorCode};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, Versions, encode_into};
use sbgc_proto::{CommandId, Message as _, RequestInfo};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::{Semaphore, mpsc};
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::outbox::{Outbox, Outgoing};
use super::strays::Strays;
use super::streams::Streams;
use crate::{Error, Gimbal};

/// How many frames may wait for a client that does not read.
const QUEUE: usize = 256;

/// How many of a client's requests may wait for the board; then nothing more is read from it.
const PENDING: usize = 32;

/// How long a client may take to accept bytes before it is disconnected.
const PATIENCE: Duration = Duration::from_secs(5);

/// How long the bytes of one frame may stop coming before what came of it counts as noise.
const GAP: Duration = Duration::from_millis(100);

/// How long an answer may take that the work comes before.
const SLOW: Duration = Duration::from_secs(30);

/// Commands that say where to go or how fast, and follow each other without waiting for confirmations.
const SETPOINTS: [CommandId; 9] = [
    CommandId::Control,
    CommandId::ControlExt,
    CommandId::ControlQuat,
    CommandId::ExtMotorsControl,
    CommandId::ServoOut,
    CommandId::ServoOutExt,
    CommandId::ApiVirtChControl,
    CommandId::ApiVirtChHighRes,
    CommandId::HelperData,
];

/// What the proxy knows of a client.
pub(super) struct Client {
    gimbal: Gimbal,
    read_only: bool,
    strays: Strays,
    outbox: Outbox,
    inbox: mpsc::Receiver<Outgoing>,
    streams: Streams,
    requests: JoinSet<()>,
    pending: Arc<Semaphore>,
}

impl Client {
    pub(super) fn new(gimbal: Gimbal, read_only: bool, strays: Strays) -> Self {
        let (sender, inbox) = mpsc::channel(QUEUE);
        let outbox = Outbox { sender, old: Arc::default() };
        strays.add(&outbox);
        Self {
            streams: Streams::default(),
            requests: JoinSet::new(),
            pending: Arc::new(Semaphore::new(PENDING)),
            outbox,
            gimbal,
            read_only,
            strays,
            inbox,
        }
    }

    /// Serves the client until it leaves.
    pub(super) async fn run(self, stream: TcpStream) -> io::Result<()> {
        stream.set_nodelay(true)?;
        let (mut from, mut to) = stream.into_split();
        let old = Arc::clone(&self.outbox.old);
        let (mut serving, mut inbox) = self.split();
        let write = async {
            let mut buffer = [0; MAX_FRAME];
            while let Some((id, payload)) = inbox.recv().await {
                let version = if old.load(Ordering::Relaxed) { Version::V1 } else { Version::V2 };
                // What came from a board fits a frame.
                let Ok(frame) = encode_into(version, id.raw(), &payload, &mut buffer) else { continue };
                timeout(PATIENCE, to.write_all(frame)).await.map_err(|_| io::ErrorKind::TimedOut)??;
            }
            Ok(())
        };
        let read = async {
            let mut decoder = Decoder::new(Versions::Both);
            let mut piece = [0; 1024];
            loop {
                let length = match timeout(GAP, from.read(&mut piece)).await {
                    Ok(read) => read?,
                    Err(_) if decoder.pending() > 0 => {
                        // A false start holds up nothing behind it.
                        decoder.skip_candidate();
                        let mut frames = Vec::new();
                        while let Some(event) = decoder.more() {
                            frames.extend(frame_of(&event));
                        }
                        serving.take(frames).await;
                        continue;
                    }
                    Err(_) => from.read(&mut piece).await?,
                };
                if length == 0 {
                    return Ok(());
                }
                let mut bytes = piece.get(..length).unwrap_or_default();
                let mut frames = Vec::new();
                while let Some(event) = decoder.next(&mut bytes) {
                    frames.extend(frame_of(&event));
                }
                serving.take(frames).await;
            }
        };
        tokio::select! {
            ended = read => ended,
            ended = write => ended,
        }
    }

    fn split(self) -> (Serving, mpsc::Receiver<Outgoing>) {
        let Self { gimbal, read_only, strays, outbox, inbox, streams, requests, pending } = self;
        (Serving { gimbal, read_only, strays, outbox, streams, requests, pending }, inbox)
    }
}

fn frame_of(event: &Event<'_>) -> Option<(Version, CommandId, Bytes)> {
    match event {
        Event::Frame { frame, .. } => {
            Some((frame.version, CommandId::from_raw(frame.id), Bytes::copy_from_slice(frame.payload)))
        }
        Event::Skipped(_) => None,
    }
}

/// The side of a client that carries out what it sends.
struct Serving {
    gimbal: Gimbal,
    read_only: bool,
    strays: Strays,
    outbox: Outbox,
    streams: Streams,
    requests: JoinSet<()>,
    pending: Arc<Semaphore>,
}

impl Serving {
    async fn take(&mut self, frames: Vec<(Version, CommandId, Bytes)>) {
        for (version, command, payload) in frames {
            self.outbox.old.store(version == Version::V1, Ordering::Relaxed);
            self.carry_out(command, payload).await;
            while self.requests.try_join_next().is_some() {}
        }
    }

    async fn carry_out(&mut self, command: CommandId, payload: Bytes) {
        if command == DataStreamInterval::ID {
            self.streams.register(&self.gimbal, &self.outbox, &self.strays, &payload).await;
            return;
        }
        let info = RequestInfo::of_payload(command, &payload);
        if self.read_only && info.is_none_or(|info| info.acts) {
            self.outbox.refuse(command, ErrorCode::NotSupported.raw(), &[]).await;
            return;
        }
        let answer = info.and_then(|info| info.answer);
        self.strays.sent(command, answer, &self.outbox);
        match answer {
            Some(answer) if !SETPOINTS.contains(&command) => {
                let slow = info.is_some_and(|info| info.slow);
                self.request(command, payload, answer, slow).await;
            }
            _ => {
                if let Err(error) = self.gimbal.send_raw(command, payload).await {
                    tracing::debug!(%error, "not sent");
                }
            }
        }
    }

    async fn request(&mut self, command: CommandId, payload: Bytes, answer: CommandId, slow: bool) {
        let Ok(permit) = Arc::clone(&self.pending).acquire_owned().await else { return };
        let (outbox, gimbal) = (self.outbox.clone(), self.gimbal.clone());
        let mut request: Pin<Box<dyn Future<Output = ()> + Send>> = Box::pin(async move {
            let gimbal = if slow { gimbal.with_timeout(SLOW) } else { gimbal };
            match gimbal.request_raw(command, payload, answer).await {
                Ok(payload) => outbox.answer(answer, payload).await,
                Err(Error::Refused { code, data, .. }) => outbox.refuse(command, code, &data).await,
                // Silence of the board is silence of the proxy.
                Err(error) => tracing::debug!(%error, "no answer"),
            }
            drop(permit);
        });
        // Polled here once, so that a client's commands reach the board in their order.
        let done = poll_fn(|context| Poll::Ready(request.as_mut().poll(context).is_ready())).await;
        if !done {
            self.requests.spawn(request);
        }
    }
}
