//! The one task that owns the port.
//!
//! It waits for whatever comes first: bytes to read, room to write, a command from a handle, a deadline. Nothing here
//! waits for one of them alone, so a peer that does not read cannot stop us from reading, and a handle that asks too
//! much waits in its own channel.

use std::fmt;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use bytes::{Buf, Bytes, BytesMut};
use sbgc_proto::frame::{BOARD_BUFFER, MAX_PAYLOAD, Version};
use sbgc_proto::{CommandId, Direction};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::sync::{mpsc, oneshot};
use tokio::time::{Instant, sleep_until, timeout};

use super::codec::{self, Codec, Item};
use super::pacer::Pacer;
use super::registry::Registry;
use super::session::{Failure, Session, Verdict, Waiter};
use super::shared::{Command, LinkState, Shared};

/// How many commands and requests may wait to be sent before those that come next wait in the handles.
const HIGH_WATER: usize = 32;

/// How much is read at once.
const READ_SIZE: usize = 4096;

/// How long what is left to be sent may take when the link ends.
const FLUSH: Duration = Duration::from_secs(1);

#[derive(Debug)]
enum Waiting {
    Caller(oneshot::Sender<Result<Bytes, Failure>>),
    Stream(u64),
}

impl Waiter for Waiting {
    fn is_gone(&self) -> bool {
        match self {
            Waiting::Caller(reply) => reply.is_closed(),
            Waiting::Stream(_) => false,
        }
    }
}

/// Everything but the port itself.
#[derive(Debug)]
pub(crate) struct Task {
    shared: Arc<Shared>,
    commands: mpsc::Receiver<Command>,
    gap: Duration,
    codec: Codec,
    session: Session<Waiting>,
    registry: Registry,
    pacer: Pacer,
    input: BytesMut,
    last_read: Instant,
    /// What is being written, and how long it was at first.
    batch: BytesMut,
    batch_length: usize,
    /// Until when the rest may be sent, once the link is to end.
    ending: Option<Instant>,
}

enum Event {
    Read(io::Result<usize>),
    Written(io::Result<usize>),
    Command(Option<Command>),
    Time,
}

impl Task {
    pub(crate) fn new(
        shared: Arc<Shared>,
        commands: mpsc::Receiver<Command>,
        baud: Option<u32>,
        gap: Duration,
        now: Instant,
    ) -> Self {
        Self {
            shared,
            commands,
            gap,
            codec: Codec::default(),
            session: Session::default(),
            registry: Registry::default(),
            pacer: Pacer::new(baud, now),
            input: BytesMut::with_capacity(READ_SIZE),
            last_read: now,
            batch: BytesMut::with_capacity(BOARD_BUFFER),
            batch_length: 0,
            ending: None,
        }
    }

    /// Serves the port until it fails, all handles are gone or one of them closes it.
    pub(crate) async fn run<Io: AsyncRead + AsyncWrite>(mut self, io: Io) -> io::Result<()> {
        let (mut reader, mut writer) = tokio::io::split(io);
        let outcome = self.serve(&mut reader, &mut writer).await;
        if outcome.is_ok() {
            // The other side need not care, and may be gone.
            let _ = timeout(FLUSH, writer.shutdown()).await;
        }
        // Whoever waits for the end may open the port again at once.
        drop((reader, writer));
        outcome
    }

    async fn serve(
        &mut self,
        reader: &mut (impl AsyncRead + Unpin),
        writer: &mut (impl AsyncWrite + Unpin),
    ) -> io::Result<()> {
        let shared = Arc::clone(&self.shared);
        loop {
            let now = Instant::now();
            self.on_time(now);
            self.fill_batch(now)?;
            if self.is_done(now) {
                return Ok(());
            }
            let wake = self.next_wake(now);
            self.input.reserve(READ_SIZE / 4);
            let accepts = self.ending.is_none() && self.session.queued() < HIGH_WATER;
            let event = tokio::select! {
                read = reader.read_buf(&mut self.input) => Event::Read(read),
                written = writer.write_buf(&mut self.batch), if !self.batch.is_empty() => Event::Written(written),
                command = self.commands.recv(), if accepts => Event::Command(command),
                () = shared.bell.notified() => Event::Time,
                () = sleep_until(wake.unwrap_or(now)), if wake.is_some() => Event::Time,
            };
            let now = Instant::now();
            match event {
                Event::Read(Ok(0)) => return Err(self.on_lost(now, io::ErrorKind::UnexpectedEof.into())),
                Event::Read(Ok(_)) => self.on_bytes(now),
                Event::Written(Ok(0)) => return Err(self.on_lost(now, io::ErrorKind::WriteZero.into())),
                Event::Written(Ok(count)) => self.on_written(now, count),
                Event::Read(Err(error)) | Event::Written(Err(error)) => return Err(self.on_lost(now, error)),
                Event::Command(Some(Command::Close) | None) => self.on_close(now),
                Event::Command(Some(command)) => self.on_command(now, command),
                Event::Time => {}
            }
        }
    }

    fn on_command(&mut self, now: Instant, command: Command) {
        match command {
            Command::Call(call, reply) => self.session.request(now, call, Waiting::Caller(reply)),
            Command::Send(command, payload) => self.session.send(now, command, payload),
            Command::Stream(wanted) => {
                if let Some((number, start)) = self.registry.add(wanted) {
                    self.session.request(now, start, Waiting::Stream(number));
                }
            }
            Command::Close => self.on_close(now),
        }
    }

    /// Nothing new is taken, nobody waits any more; what is left is sent, and the streams are given back.
    fn on_close(&mut self, now: Instant) {
        self.ending = Some(now + FLUSH);
        self.commands.close();
        while let Ok(command) = self.commands.try_recv() {
            // Those who ask learn it when their command is dropped.
            if let Command::Send(command, payload) = command {
                self.session.send(now, command, payload);
            }
        }
        for waiting in self.session.dismiss() {
            self.tell(now, waiting, Err(Failure::Closed));
        }
        for stop in self.registry.clear() {
            self.session.send(now, CommandId::DataStreamInterval.raw(), stop);
        }
    }

    fn is_done(&self, now: Instant) -> bool {
        let empty = self.batch.is_empty() && self.session.queued() == 0 && !self.shared.has_setpoint();
        self.ending.is_some_and(|until| empty || now >= until)
    }

    /// The port is gone; what came before that still counts.
    fn on_lost(&mut self, now: Instant, error: io::Error) -> io::Error {
        while let Some(item) =
            self.codec.take(&mut self.input).or_else(|| self.codec.end_candidate(&mut self.input))
        {
            self.on_item(now, item);
        }
        tracing::debug!(%error, "port lost");
        // Before anybody learns that an answer will not come.
        self.shared.state.send_replace(LinkState::Lost);
        for waiting in self.session.on_disconnect() {
            self.tell(now, waiting, Err(Failure::Disconnected));
        }
        self.update_counters();
        error
    }

    fn on_bytes(&mut self, now: Instant) {
        self.last_read = now;
        while let Some(item) = self.codec.take(&mut self.input) {
            self.on_item(now, item);
        }
        self.update_counters();
    }

    fn on_item(&mut self, now: Instant, item: Item) {
        let frame = match item {
            Item::Frame(frame) => frame,
            Item::Noise { cause, length } => {
                tracing::debug!("skipped {length} bytes: {cause}");
                return;
            }
        };
        tracing::debug!("received {}", Shown(Direction::Incoming, frame.version, frame.id, &frame.payload));
        // Subscribers get it, too, whether or not it is an answer, and before the one who waits for that goes on.
        let taken = self.shared.publish(frame.id, &frame.payload);
        match self.session.on_frame(now, frame.id, &frame.payload) {
            Verdict::Answer(waiting, outcome) => self.tell(now, waiting, outcome),
            Verdict::Late => self.shared.count(|counters| counters.late += 1),
            Verdict::Unsolicited if !taken => self.shared.count(|counters| counters.unsolicited += 1),
            Verdict::Unawaited | Verdict::Unsolicited => {}
        }
    }

    fn tell(&mut self, now: Instant, waiting: Waiting, outcome: Result<Bytes, Failure>) {
        match waiting {
            // Whoever left meanwhile does not need it.
            Waiting::Caller(reply) => drop(reply.send(outcome)),
            Waiting::Stream(number) => {
                if let Some(stop) = self.registry.settle(number, outcome.map(drop)) {
                    self.session.send(now, CommandId::DataStreamInterval.raw(), stop);
                }
            }
        }
    }

    fn on_time(&mut self, now: Instant) {
        while let Some((waiting, failure)) = self.session.on_deadline(now) {
            self.tell(now, waiting, Err(failure));
        }
        if !self.input.is_empty() && now >= self.last_read + self.gap {
            while let Some(item) =
                self.codec.end_candidate(&mut self.input).or_else(|| self.codec.take(&mut self.input))
            {
                self.on_item(now, item);
            }
        }
        for stop in self.registry.sweep() {
            self.session.send(now, CommandId::DataStreamInterval.raw(), stop);
        }
        self.update_counters();
    }

    /// Puts together what may go out now, at the last moment, so that set-points are the newest.
    fn fill_batch(&mut self, now: Instant) -> io::Result<()> {
        if !self.batch.is_empty() || now < self.pacer.not_before() {
            return Ok(());
        }
        let version = self.shared.version();
        let mut frames = 0;
        while let Some(room) = BOARD_BUFFER.checked_sub(self.batch.len() + version.overhead()) {
            // Alone in its batch goes whatever was let in, so that nothing stays for ever.
            let room = if self.batch.is_empty() { MAX_PAYLOAD } else { room };
            let (command, payload) = if let Some((command, payload)) = self.shared.take_setpoint(room) {
                self.session.sent_unawaited(now, command);
                (command, payload)
            } else if let Some(outgoing) = self.session.next_to_send(now, room) {
                (outgoing.command, outgoing.payload)
            } else {
                break;
            };
            codec::append(version, command, &payload, &mut self.batch).map_err(io::Error::other)?;
            tracing::debug!("sent {}", Shown(Direction::Outgoing, version, command, &payload));
            frames += 1;
        }
        self.batch_length = self.batch.len();
        self.pacer.begin(now);
        self.shared.count(|counters| counters.sent_frames += frames);
        Ok(())
    }

    fn on_written(&mut self, now: Instant, count: usize) {
        self.shared.count(|counters| counters.sent_bytes += count as u64);
        if !self.batch.has_remaining() {
            self.pacer.end(now, self.batch_length);
        }
    }

    /// When something is to be done even if nothing happens.
    fn next_wake(&self, now: Instant) -> Option<Instant> {
        let gap = (!self.input.is_empty()).then(|| self.last_read + self.gap);
        let wants = self.batch.is_empty() && (self.session.wants_to_send(now) || self.shared.has_setpoint());
        let send = wants.then(|| self.pacer.not_before());
        [self.session.next_deadline(now), gap, send, self.ending].into_iter().flatten().min()
    }

    fn update_counters(&self) {
        self.shared.count(|counters| {
            counters.received = self.codec.counters();
            counters.timeouts = self.session.timeouts();
            counters.repeats = self.session.repeats();
        });
    }
}

impl Drop for Task {
    /// However it ends, nobody goes on waiting for it.
    fn drop(&mut self) {
        self.shared.state.send_if_modified(|state| {
            let open = *state == LinkState::Open;
            if open {
                *state = LinkState::Closed;
            }
            open
        });
        self.shared.end_listeners();
    }
}

/// A frame as the log shows it: its name, and its payload in hex.
struct Shown<'a>(Direction, Version, u8, &'a [u8]);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(direction, version, id, payload) = *self;
        let name = CommandId::from_raw(id).spec_name(direction).unwrap_or("unknown command");
        write!(f, "{name} ({id}), version {}, {} bytes", version.number(), payload.len())?;
        if !payload.is_empty() {
            f.write_str(": ")?;
        }
        payload.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_shown_with_name_and_payload() {
        let shown = |direction, id, payload: &[u8]| Shown(direction, Version::V2, id, payload).to_string();
        assert_eq!(shown(Direction::Outgoing, 86, &[]), "CMD_BOARD_INFO (86), version 2, 0 bytes");
        assert_eq!(
            shown(Direction::Incoming, 67, &[0x5D, 0xFF]),
            "CMD_CONFIRM (67), version 2, 2 bytes: 5dff"
        );
        assert_eq!(shown(Direction::Incoming, 200, &[1]), "unknown command (200), version 2, 1 bytes: 01");
    }
}
