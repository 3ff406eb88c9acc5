//! One board, several clients: real sockets, and the simulated board behind them.
#![cfg(feature = "sim")]

use std::net::SocketAddr;
use std::time::Duration;

use sbgc_host::proxy::{self, ProxyOptions};
use sbgc_host::sim::{self, Config};
use sbgc_host::transport::{Address, Line};
use sbgc_host::{Error, Gimbal, Options, Sample, StreamRequest, Subscription, VersionChoice};
use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    CalibGyroSimple, MotorsOffMode, ProfileId, ReadParams3, RealtimeDataCustomFlags, SelectImu3, StreamSource,
};
use sbgc_proto::frame::Version;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::time::timeout;

async fn proxy(options: ProxyOptions) -> (Gimbal, SocketAddr) {
    let gimbal = Gimbal::spawn(sim::in_process(Config::default()), Options::default());
    gimbal.handshake().await.unwrap();
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let board = gimbal.clone();
    tokio::spawn(async move { proxy::serve(&board, listener, options).await });
    (gimbal, address)
}

async fn client(address: SocketAddr, version: VersionChoice) -> Gimbal {
    let address = Address::Tcp { host: address.ip().to_string(), port: address.port() };
    let io = address.open(Line::default()).await.unwrap();
    let gimbal = Gimbal::spawn(io, Options { version, ..Options::default() });
    gimbal.handshake().await.unwrap();
    gimbal
}

fn angles(interval_ms: u16) -> StreamRequest {
    StreamRequest::of(StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::IMU_ANGLES), interval_ms)
}

#[tokio::test]
async fn answers_go_to_who_asked_in_its_own_version() {
    let (_board, address) = proxy(ProxyOptions::default()).await;
    let old = client(address, VersionChoice::Only(Version::V1)).await;
    let new = client(address, VersionChoice::Only(Version::V2)).await;
    for round in 0..20 {
        let (first, second) = (
            ReadParams3 { profile_id: ProfileId::Profile1 },
            ReadParams3 { profile_id: ProfileId::Profile2 },
        );
        let (one, other) = tokio::join!(old.request(&first), new.request(&second));
        let (one, other) = (one.unwrap(), other.unwrap());
        assert_eq!(one.profile_id, ProfileId::Profile1, "round {round}");
        assert_eq!(other.profile_id, ProfileId::Profile2, "round {round}");
    }
    // Writes are confirmed to the one that sent them.
    new.motors_on().await.unwrap();
    old.motors_off(MotorsOffMode::Normal).await.unwrap();
    assert_eq!((old.counters().unsolicited, new.counters().unsolicited), (0, 0));
}

#[tokio::test]
async fn refusals_come_through() {
    let (_board, address) = proxy(ProxyOptions::default()).await;
    let client = client(address, VersionChoice::Auto).await;
    let unknown =
        client.request_raw(CommandId::from_raw(200), [1].as_slice().into(), CommandId::CONFIRM).await;
    // Nothing is known of it, so nobody waits for its answer: what the board says still comes back.
    assert!(matches!(unknown, Err(Error::Refused { .. } | Error::Timeout { .. })), "{unknown:?}");
    let refused = client.subscribe(StreamRequest::new(CommandId::BoardInfo, 100)).await.unwrap_err();
    assert!(matches!(refused, Error::Refused { .. }), "{refused}");
}

#[tokio::test]
async fn streams_are_shared_and_end_with_their_clients() {
    let (board, address) = proxy(ProxyOptions::default()).await;
    let (one, other) =
        (client(address, VersionChoice::Auto).await, client(address, VersionChoice::Auto).await);
    let mut fast = one.subscribe(angles(20)).await.unwrap();
    // The same stream at a fifth of the rate.
    let mut slow = other.subscribe(angles(100)).await.unwrap();
    let mut times = Vec::new();
    for _ in 0..3 {
        let Some(Sample::Payload(payload)) = slow.next().await else { panic!("the stream ended") };
        times.push(u16::from_le_bytes([payload[0], payload[1]]));
    }
    assert!(times.windows(2).all(|pair| (95..=105).contains(&(pair[1] - pair[0]))), "{times:?}");
    assert!(matches!(fast.next().await, Some(Sample::Payload(_))));
    // One leaves without a word; the other goes on.
    drop((fast, one));
    assert!(matches!(slow.next().await, Some(Sample::Payload(_))));
    drop(slow);
    other.close().await;
    // Then the board is left alone, and the stream is free for another rate.
    let begun = tokio::time::Instant::now();
    while let Err(error) = board.subscribe(angles(50)).await {
        assert!(matches!(error, Error::StreamInUse { .. }), "{error}");
        assert!(begun.elapsed() < Duration::from_secs(5), "the streams end with their clients");
        tokio::task::yield_now().await;
    }
}

#[tokio::test]
async fn read_only_clients_can_ask_and_subscribe_only() {
    let (_board, address) = proxy(ProxyOptions { read_only: true, ..ProxyOptions::default() }).await;
    let client = client(address, VersionChoice::Auto).await;
    client.angles().await.unwrap();
    client.subscribe(angles(20)).await.unwrap();
    for refused in
        [client.motors_on().await.unwrap_err(), client.confirm(&SelectImu3::default()).await.unwrap_err()]
    {
        assert!(matches!(refused, Error::Refused { code: 9, .. }), "{refused}");
    }
}

#[tokio::test]
async fn there_is_a_limit_to_clients() {
    let (_board, address) = proxy(ProxyOptions { clients: 1, ..ProxyOptions::default() }).await;
    let first = client(address, VersionChoice::Auto).await;
    let mut second = TcpStream::connect(address).await.unwrap();
    assert_eq!(second.read(&mut [0; 8]).await.unwrap_or(0), 0, "it is disconnected");
    first.close().await;
    let begun = tokio::time::Instant::now();
    loop {
        let mut again = TcpStream::connect(address).await.unwrap();
        again.write_all(&[0x24, 0x56, 0x00, 0x56]).await.unwrap();
        again.write_all(&crc(&[0x56, 0x00, 0x56])).await.unwrap();
        if let Ok(Ok(1..)) = timeout(Duration::from_millis(200), again.read(&mut [0; 8])).await {
            break;
        }
        assert!(begun.elapsed() < Duration::from_secs(5), "its place is free when it has left");
    }
}

#[tokio::test]
async fn noise_and_false_starts_hold_nothing_up() {
    let (_board, address) = proxy(ProxyOptions::default()).await;
    let mut stream = TcpStream::connect(address).await.unwrap();
    // A false start that promises 255 bytes, then a request.
    let mut bytes = vec![0x24, 0x56, 0xFF, 0x55];
    bytes.extend([0x24, 0x49, 0x00, 0x49]);
    bytes.extend(crc(&[0x49, 0x00, 0x49]));
    stream.write_all(&bytes).await.unwrap();
    let mut answer = [0; 4];
    timeout(Duration::from_secs(5), stream.read_exact(&mut answer)).await.unwrap().unwrap();
    assert_eq!(answer[..3], [0x24, 0x49, 18]);
}

/// CRC16 of version 2, polynomial 0x8005, low bit first.
fn crc(bytes: &[u8]) -> [u8; 2] {
    let mut register = 0_u16;
    for byte in bytes {
        for bit in 0..8 {
            let carry = register >> 15 != u16::from(byte >> bit & 1);
            register <<= 1;
            if carry {
                register ^= 0x8005;
            }
        }
    }
    register.to_le_bytes()
}

/// The next payload of a subscription.
async fn next(subscription: &mut Subscription) -> Vec<u8> {
    match timeout(Duration::from_secs(10), subscription.next()).await {
        Ok(Some(Sample::Payload(payload))) => payload.to_vec(),
        other => panic!("{other:?}"),
    }
}

#[tokio::test]
async fn what_the_board_sends_by_itself_comes_through() {
    let (_board, address) = proxy(ProxyOptions::default()).await;
    let (one, other) =
        (client(address, VersionChoice::Auto).await, client(address, VersionChoice::Only(Version::V1)).await);
    // The steps of a script go to all.
    let mut traces = [one.listen(CommandId::ScriptDebug), other.listen(CommandId::ScriptDebug)];
    one.script_upload(1, b"WAIT(20)\nMOTORS(1)\nEND()\n", |_, _| {}).await.unwrap();
    one.script_run(1, true).await.unwrap();
    for trace in &mut traces {
        assert_eq!((next(trace).await, next(trace).await), (vec![1, 0, 0], vec![2, 0, 0]));
    }
    // The second confirmation of a calibration goes to the one that asked for it.
    let mut confirmations = one.listen(CommandId::CONFIRM);
    let mut of_others = other.listen(CommandId::CONFIRM);
    one.confirm(&CalibGyroSimple {}).await.unwrap();
    for _ in 0..2 {
        assert_eq!(next(&mut confirmations).await[0], CommandId::CalibGyro.raw());
    }
    // A restart is announced to all, and streams go on after it.
    let mut notices = other.listen(CommandId::Reset);
    let mut samples = other.subscribe(angles(20)).await.unwrap();
    next(&mut samples).await;
    one.restart(Duration::ZERO).await.unwrap();
    next(&mut notices).await;
    let resumed = async {
        loop {
            match samples.next().await {
                Some(Sample::Resumed(_)) => return,
                Some(_) => {}
                None => panic!("the stream ended"),
            }
        }
    };
    timeout(Duration::from_secs(20), resumed).await.unwrap();
    // Only the registrations of the other client itself were confirmed to it.
    assert_eq!(next(&mut of_others).await[0], CommandId::DataStreamInterval.raw());
}

#[tokio::test]
async fn streams_follow_the_sensors_through_the_proxy() {
    let (_board, address) = proxy(ProxyOptions::default()).await;
    let (one, other) =
        (client(address, VersionChoice::Auto).await, client(address, VersionChoice::Auto).await);
    // Each 50th cycle of 0.8 ms.
    let synced = StreamRequest { synced: true, ..angles(50) };
    let mut samples = one.subscribe(synced).await.unwrap();
    let mut times = Vec::new();
    for _ in 0..4 {
        let payload = next(&mut samples).await;
        times.push(u16::from_le_bytes([payload[0], payload[1]]));
    }
    assert!(times.windows(2).all(|pair| pair[1].wrapping_sub(pair[0]) == 40), "{times:?}");
    // The same stream by time is another one.
    let error = other.subscribe(angles(50)).await.unwrap_err();
    assert!(matches!(error, Error::Refused { .. }), "{error}");
    drop(other.subscribe(synced).await.unwrap());
}
