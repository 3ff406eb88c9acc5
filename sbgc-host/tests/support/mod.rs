//! A board that does what a test says, at the other end of a pipe in the same runtime.
#![allow(dead_code, unreachable_pub, reason = "no test uses all of it, and each is a crate of its own")]

use std::collections::VecDeque;
use std::time::Duration;

use sbgc_host::proto::frame::{self, Decoder, Event, Version, Versions};
use sbgc_host::{Gimbal, Options};
use tokio::io::{AsyncReadExt, AsyncWriteExt, DuplexStream, duplex};
use tokio::time::Instant;

pub const CONFIRM: u8 = 67;
pub const BOARD_INFO: u8 = 86;
pub const GET_ANGLES: u8 = 73;
pub const MOTORS_ON: u8 = 77;
pub const STREAM: u8 = 85;
pub const REALTIME_4: u8 = 25;

pub const MS: fn(u64) -> Duration = Duration::from_millis;

/// A frame that the driver sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    pub version: Version,
    pub id: u8,
    pub payload: Vec<u8>,
}

pub struct Board {
    pub io: DuplexStream,
    decoder: Decoder,
    frames: VecDeque<Frame>,
}

/// A gimbal over a pipe that holds so many bytes each way, and the board at its end.
pub fn gimbal_with(capacity: usize, options: Options) -> (Gimbal, Board) {
    let (near, far) = duplex(capacity);
    let board = Board { io: far, decoder: Decoder::new(Versions::Both), frames: VecDeque::new() };
    (Gimbal::spawn(near, options), board)
}

pub fn gimbal() -> (Gimbal, Board) {
    gimbal_with(4096, Options::default())
}

impl Board {
    /// The next frame, `None` when the driver has closed the port.
    pub async fn try_next(&mut self) -> Option<Frame> {
        while self.frames.is_empty() {
            let mut buffer = [0; 4096];
            let count = self.io.read(&mut buffer).await.unwrap_or(0);
            if count == 0 {
                return None;
            }
            let mut bytes = &buffer[..count];
            while let Some(event) = self.decoder.next(&mut bytes) {
                let Event::Frame { frame, .. } = event else { panic!("the driver sent {event:?}") };
                let payload = frame.payload.to_vec();
                self.frames.push_back(Frame { version: frame.version, id: frame.id, payload });
            }
        }
        self.frames.pop_front()
    }

    pub async fn next(&mut self) -> Frame {
        self.try_next().await.expect("the driver is there")
    }

    /// The next frame, which must be this command.
    pub async fn expect(&mut self, id: u8) -> Frame {
        let frame = self.next().await;
        assert_eq!(frame.id, id, "payload {:?}", frame.payload);
        frame
    }

    /// Whether nothing comes for so long.
    pub async fn is_quiet(&mut self, time: Duration) -> bool {
        tokio::time::timeout(time, self.next()).await.is_err()
    }

    pub async fn send(&mut self, id: u8, payload: &[u8]) {
        self.io.write_all(&encoded(id, payload)).await.expect("the driver is there");
    }

    pub async fn send_in(&mut self, version: Version, id: u8, payload: &[u8]) {
        let mut out = [0; frame::MAX_FRAME];
        let frame = frame::encode_into(version, id, payload, &mut out).expect("a frame");
        self.send_bytes(frame).await;
    }

    pub async fn send_bytes(&mut self, bytes: &[u8]) {
        self.io.write_all(bytes).await.expect("the driver is there");
    }

    pub async fn confirm(&mut self, command: u8) {
        self.send(CONFIRM, &[command]).await;
    }

    /// The next frame must be a stream request, which is confirmed. Returns its payload.
    pub async fn confirm_stream(&mut self) -> Vec<u8> {
        let request = self.expect(STREAM).await;
        self.confirm(STREAM).await;
        request.payload
    }
}

pub fn encoded(id: u8, payload: &[u8]) -> Vec<u8> {
    let mut out = [0; frame::MAX_FRAME];
    frame::encode_into(Version::V2, id, payload, &mut out).expect("a frame").to_vec()
}

/// A `CMD_BOARD_INFO` of this firmware.
pub fn board_info(firmware: u16) -> [u8; 18] {
    let [low, high] = firmware.to_le_bytes();
    let mut payload = [0; 18];
    payload[..3].copy_from_slice(&[30, low, high]);
    payload
}

/// Time since `start`, to the millisecond: paused time runs in whole ones.
pub fn since(start: Instant) -> u64 {
    u64::try_from(start.elapsed().as_millis()).expect("short")
}
