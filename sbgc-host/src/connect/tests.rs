use std::collections::VecDeque;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use sbgc_proto::Message;
use sbgc_proto::commands::{BoardInfo, BoardInfo3, RealtimeData4};
use sbgc_proto::frame::{Decoder, Event, MAX_FRAME, Versions, encode_into};
use sbgc_proto::units::FirmwareVersion;
use tokio::io::{AsyncReadExt, AsyncWriteExt, DuplexStream, duplex};
use tokio::net::TcpListener;

use super::search::combinations;
use super::*;
use crate::error::Error;
use crate::gimbal::Options;
use crate::machine::{Interruption, LinkState, Sample};
use crate::streams::StreamRequest;
use crate::task::{Dial, Redial};
use crate::transport::{Line, Parity};

const MS: fn(u64) -> Duration = Duration::from_millis;

#[test]
fn the_likeliest_is_tried_first() {
    let address = Address::Serial("ttyUSB0".into());
    let lines = combinations(&address, ConnectOptions::default());
    assert_eq!(lines.len(), 12);
    assert_eq!(lines[0], Some(Line::default()));
    assert_eq!(lines[6].map(|line| line.parity), Some(Parity::Even));
    let chosen = ConnectOptions { baud: Some(9600), parity: Some(Parity::Even), ..Default::default() };
    assert_eq!(combinations(&address, chosen), [Some(Line { baud: 9600, parity: Parity::Even })]);
    assert_eq!(combinations(&Address::Sim, chosen), [None]);
}

/// What a server that does this to each client is found to be.
async fn found(answer: &'static [u8]) -> Error {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let port = listener.local_addr().unwrap().port();
    let server = async {
        let (mut io, _) = listener.accept().await.unwrap();
        io.write_all(answer).await.unwrap();
        io.read_to_end(&mut Vec::new()).await.unwrap();
    };
    let address = Address::Tcp { host: "127.0.0.1".into(), port };
    let link = Options { timeout: MS(10), attempts: 1, ..Options::default() };
    let options = ConnectOptions { link, ..ConnectOptions::default() };
    let (outcome, ()) = tokio::join!(Gimbal::connect_with(&address, options), server);
    outcome.unwrap_err()
}

#[tokio::test]
async fn what_is_no_board_is_told_apart() {
    let silent = found(b"").await;
    assert!(matches!(&silent, Error::Silent { lines, version: None, .. } if lines.is_empty()), "{silent}");
    let text = found(b"login: ").await.to_string();
    assert!(text.contains("first bytes: 6c 6f 67"), "{text}");
    let frames: &[u8] = &[0xFE, 1, 0, 1, 1, 30, 7, 1, 2, 0xFE, 1, 1, 1, 1, 30, 7, 1, 2];
    let mavlink = found(frames).await;
    assert!(matches!(&mavlink, Error::OtherProtocol { foreign: Some(Foreign::Mavlink), .. }), "{mavlink}");
}

/// A board that answers as long as it is there, and can be taken away.
struct Board {
    device: u8,
    version: Version,
    /// Requests that came.
    seen: Arc<Mutex<Vec<u8>>>,
}

impl Board {
    async fn serve(self, mut io: DuplexStream) {
        let mut decoder = Decoder::new(Versions::Only(self.version));
        let mut buffer = [0; 1024];
        while let Ok(count @ 1..) = io.read(&mut buffer).await {
            let mut bytes = &buffer[..count];
            let mut answers = VecDeque::new();
            while let Some(event) = decoder.next(&mut bytes) {
                let Event::Frame { frame, .. } = event else { continue };
                self.seen.lock().unwrap().push(frame.id);
                let mut payload = [0; 255];
                let answer = match CommandId::from_raw(frame.id) {
                    CommandId::BoardInfo => {
                        let firmware_ver = FirmwareVersion::new(2, 60, 0);
                        BoardInfo { firmware_ver, ..BoardInfo::default() }.encode(&mut payload).unwrap()
                    }
                    CommandId::BoardInfo3 => {
                        let device_id = [self.device; 9].into();
                        BoardInfo3 { device_id, ..BoardInfo3::default() }.encode(&mut payload).unwrap()
                    }
                    CommandId::DataStreamInterval => &[85],
                    _ => continue,
                };
                let id = if frame.id == 85 { 67 } else { frame.id };
                let mut out = [0; MAX_FRAME];
                answers.push_back(encode_into(self.version, id, answer, &mut out).unwrap().to_vec());
                if frame.id == 85 && frame.payload[1] > 0 {
                    let sample = [0; <RealtimeData4 as sbgc_proto::wire::Layout>::MIN_LEN];
                    answers.push_back(encode_into(self.version, 25, &sample, &mut out).unwrap().to_vec());
                }
            }
            for answer in answers {
                io.write_all(&answer).await.unwrap();
            }
        }
    }
}

/// A link whose port leads to boards of these devices, one after the other, and what takes the present one away.
async fn linked(devices: &[u8], within: Duration) -> (Gimbal, impl Fn(), Arc<Mutex<Vec<u8>>>) {
    let devices = Arc::new(Mutex::new(devices.iter().copied().collect::<VecDeque<_>>()));
    let (seen, present) = (Arc::<Mutex<Vec<u8>>>::default(), Arc::new(Mutex::new(None)));
    let open = {
        let (seen, present) = (Arc::clone(&seen), Arc::clone(&present));
        move || {
            let device = devices.lock().unwrap().pop_front();
            let Some(device) = device.filter(|device| *device > 0) else { return Err(Error::Disconnected) };
            let (near, far) = duplex(1024);
            let board = Board { device, version: Version::V1, seen: Arc::clone(&seen) };
            *present.lock().unwrap() = Some(tokio::spawn(board.serve(far)).abort_handle());
            Ok(near)
        }
    };
    let first = open().unwrap();
    let dial: Dial = Box::new(move || {
        let opened = open();
        Box::pin(async move { opened.map(|io| Box::new(io) as crate::transport::Io) })
    });
    let redial = Redial { dial, within };
    let (gimbal, connection) = Gimbal::with_dial(Box::new(first), Options::default(), Some(redial));
    connection.spawn();
    let board = gimbal.handshake().await.unwrap();
    assert_eq!(gimbal.version(), Version::V1);
    let (address, after) = (Address::Sim, Duration::ZERO);
    let found = Found { address, line: None, version: Version::V1, board, device_id: None, after };
    gimbal.settle(found, Reconnect::Always).await;
    let unplug = move || present.lock().unwrap().take().unwrap().abort();
    (gimbal, unplug, seen)
}

#[tokio::test(start_paused = true)]
async fn the_same_board_is_found_again_and_its_streams_come_back() {
    // Twice there is nothing to be opened.
    let (gimbal, unplug, _) = linked(&[1, 0, 0, 1], Duration::MAX).await;
    assert_eq!(gimbal.found().unwrap().device_id, Some([1; 9]));
    let mut state = gimbal.link_state();
    let request = StreamRequest::new(CommandId::RealtimeData4, 10_000);
    let mut samples = gimbal.subscribe(request).await.unwrap();
    assert!(matches!(samples.next().await, Some(Sample::Payload(_))));
    let waiting = tokio::spawn({
        let gimbal = gimbal.clone();
        async move { gimbal.angles().await }
    });
    tokio::task::yield_now().await;
    unplug();
    assert!(matches!(waiting.await.unwrap(), Err(Error::Disconnected)));
    assert_eq!(*state.borrow_and_update(), LinkState::Reconnecting);
    assert!(matches!(gimbal.angles().await, Err(Error::Disconnected)));
    assert_eq!(samples.next().await, Some(Sample::Interrupted(Interruption::Lost)));
    state.wait_for(|state| *state == LinkState::Open).await.unwrap();
    assert!(matches!(samples.next().await, Some(Sample::Resumed(_))));
    assert!(matches!(samples.next().await, Some(Sample::Payload(_))));
    gimbal.board_info().await.unwrap();
}

#[tokio::test(start_paused = true)]
async fn another_board_on_the_same_path_is_left_alone() {
    let (gimbal, unplug, seen) = linked(&[1, 2, 2], Duration::MAX).await;
    let mut state = gimbal.link_state();
    seen.lock().unwrap().clear();
    unplug();
    state.wait_for(|state| *state == LinkState::Replaced).await.unwrap();
    assert!(matches!(gimbal.motors_on().await, Err(Error::Disconnected)));
    assert_eq!(seen.lock().unwrap()[..], [CommandId::BoardInfo3.raw()]);
}

#[tokio::test(start_paused = true)]
async fn closing_ends_the_search_for_a_lost_port() {
    let (gimbal, unplug, _) = linked(&[1], Duration::MAX).await;
    let mut state = gimbal.link_state();
    unplug();
    state.wait_for(|state| *state == LinkState::Reconnecting).await.unwrap();
    tokio::time::sleep(MS(20_000)).await;
    gimbal.close().await;
    assert_eq!(*state.borrow(), LinkState::Closed);
}

#[tokio::test(start_paused = true)]
async fn a_lost_port_is_looked_for_as_long_as_asked() {
    let (gimbal, unplug, _) = linked(&[1], MS(10_000)).await;
    let mut state = gimbal.link_state();
    let mut samples = gimbal.listen(CommandId::GetAngles);
    let began = tokio::time::Instant::now();
    unplug();
    state.wait_for(|state| *state == LinkState::Lost).await.unwrap();
    assert!((MS(10_000)..MS(10_100)).contains(&began.elapsed()), "{:?}", began.elapsed());
    assert_eq!(samples.next().await, None);
    assert!(matches!(gimbal.angles().await, Err(Error::Disconnected)));
}

#[tokio::test(start_paused = true)]
async fn the_time_to_look_for_a_port_begins_anew_once_it_was_found() {
    let (gimbal, unplug, _) = linked(&[1, 0, 0, 1, 0, 0, 1], MS(5000)).await;
    let mut state = gimbal.link_state();
    for _ in 0..2 {
        unplug();
        state.wait_for(|state| *state == LinkState::Reconnecting).await.unwrap();
        state.wait_for(|state| *state == LinkState::Open).await.unwrap();
    }
    gimbal.board_info().await.unwrap();
}
