//! Boards that a test serves itself, on TCP: one that can be looked at, and ones that refuse or fall silent.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use sbgc_host::sim::{Board, Config};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Version, Versions, encode_into};

/// Times of the board, and the speeds of its axes then.
type Record = Vec<(Duration, [f64; 3])>;

/// Commands: id and payload.
type Commands = Arc<Mutex<Vec<(u8, Vec<u8>)>>>;

/// A simulated board that runs on whether or not a program is connected, and keeps a record of its speeds.
pub(crate) struct Watched {
    board: Arc<Mutex<Board>>,
    record: Arc<Mutex<Record>>,
    started: Instant,
    port: String,
}

impl Watched {
    pub(crate) fn start() -> Self {
        Self::with(Config::default())
    }

    pub(crate) fn with(config: Config) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = format!("tcp://{}", listener.local_addr().expect("an address"));
        listener.set_nonblocking(true).expect("it can wait for nobody");
        let watched = Self {
            board: Arc::new(Mutex::new(Board::new(config))),
            record: Arc::default(),
            started: Instant::now(),
            port,
        };
        let (board, record, started) =
            (Arc::clone(&watched.board), Arc::clone(&watched.record), watched.started);
        std::thread::spawn(move || {
            let mut host: Option<TcpStream> = None;
            let mut piece = [0; 1024];
            loop {
                if let Ok((stream, _)) = listener.accept() {
                    stream.set_read_timeout(Some(Duration::from_millis(1))).expect("a time-out");
                    stream.set_nonblocking(false).expect("it can wait");
                    host = Some(stream);
                }
                let read = host.as_mut().map(|stream| stream.read(&mut piece));
                let (output, speeds) = {
                    let mut board = board.lock().expect("no test panics with it");
                    let now = started.elapsed();
                    match read {
                        Some(Ok(0)) => host = None,
                        Some(Ok(count)) => board.receive(now, &piece[..count]),
                        Some(Err(_)) => {}
                        None => std::thread::sleep(Duration::from_millis(1)),
                    }
                    board.advance(now);
                    (board.take_output(), board.motion().axes().map(|axis| axis.speed).into_array())
                };
                if let Some(stream) = &mut host {
                    let _ = stream.write_all(&output);
                }
                record.lock().expect("no test panics with it").push((started.elapsed(), speeds));
            }
        });
        watched
    }

    pub(crate) fn port(&self) -> &str {
        &self.port
    }

    /// The time of the record.
    pub(crate) fn now(&self) -> Duration {
        self.started.elapsed()
    }

    pub(crate) fn angles(&self) -> [f64; 3] {
        self.board.lock().expect("no test panics with it").motion().axes().map(|axis| axis.angle).into_array()
    }

    pub(crate) fn speeds(&self) -> [f64; 3] {
        self.record.lock().expect("no test panics with it").last().map_or([0.0; 3], |last| last.1)
    }

    /// Waits until the yaw axis turns at least this fast, and returns when that was.
    pub(crate) fn wait_for_yaw(&self, speed: f64) {
        self.wait("the axis turns", || self.speeds()[2].abs() >= speed);
    }

    /// Waits until all axes stand for a while, and returns when they began to.
    pub(crate) fn wait_for_rest(&self) -> Duration {
        let since = |board: &Self| {
            let record = board.record.lock().expect("no test panics with it");
            let moving = record.iter().rposition(|(_, speeds)| speeds.iter().any(|speed| speed.abs() > 0.0));
            moving.and_then(|index| record.get(index + 1)).map(|entry| entry.0)
        };
        self.wait("the axes stand", || {
            since(self).is_some_and(|since| self.now() > since + Duration::from_millis(300))
        });
        since(self).expect("they stand")
    }

    fn wait(&self, what: &str, done: impl Fn() -> bool) {
        let end = Instant::now() + Duration::from_secs(20);
        while !done() {
            assert!(Instant::now() < end, "{what}: {:?} at {:?}", self.speeds(), self.angles());
            std::thread::sleep(Duration::from_millis(2));
        }
    }
}

/// What a board does with commands beyond its identification and plain reads.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mood {
    /// Answers each with this error.
    Refuses(u8),
    /// Answers none.
    Silent,
}

/// Serves a board of firmware 2.73 in this mood, and returns its port. All that it was sent is in the list.
pub(crate) fn moody(mood: Mood) -> (String, Commands) {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = format!("tcp://{}", listener.local_addr().expect("an address"));
    let seen = Arc::new(Mutex::new(Vec::new()));
    let list = Arc::clone(&seen);
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let mut stream = stream.expect("a connection");
            let mut decoder = Decoder::new(Versions::Both);
            let mut piece = [0; 512];
            while let Ok(count @ 1..) = stream.read(&mut piece) {
                let mut commands = Vec::new();
                let mut rest = &piece[..count];
                while let Some(event) = decoder.next(&mut rest) {
                    if let Event::Frame { frame, .. } = event {
                        commands.push((frame.id, frame.payload.to_vec()));
                    }
                }
                for (id, payload) in commands {
                    let answer = match (id, mood) {
                        // CMD_BOARD_INFO, CMD_BOARD_INFO_3, CMD_GET_ANGLES.
                        (86, _) => Some((86, [&[36, 0xAF, 0x0A][..], &[0; 15]].concat())),
                        (20, _) => Some((20, [&[0; 25][..], &[9; 10], &[0; 34]].concat())),
                        (73, _) => Some((73, vec![0; 18])),
                        (_, Mood::Refuses(code)) => Some((255, vec![id, code, 0, 0, 0, 0])),
                        (_, Mood::Silent) => None,
                    };
                    list.lock().expect("no test panics with it").push((id, payload));
                    if let Some((id, payload)) = answer {
                        let mut frame = [0; MAX_FRAME];
                        let frame = encode_into(Version::V2, id, &payload, &mut frame).expect("it fits");
                        let _ = stream.write_all(frame);
                    }
                }
            }
        }
    });
    (port, seen)
}
