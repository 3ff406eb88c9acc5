//! The board behind streams of bytes.

use std::time::Duration;

use sbgc_proto::Message;
use sbgc_proto::commands::{
    BoardInfoRequest, DataStreamInterval, RealtimeData3, RealtimeDataCustomFlags, RtDataFlags, StreamSource,
};
use sbgc_proto::frame::Version;
use sbgc_proto::units::StreamInterval;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::{Instant, timeout};

use super::ms;
use crate::sim::{Board, Config, Fault, SharedBoard, in_process, serve_shared_tcp, serve_tcp};

/// Asks who the board is and waits for the answer.
async fn says_who_it_is(io: &mut (impl AsyncRead + AsyncWrite + Unpin)) {
    let mut buffer = [0; 16];
    let frame = BoardInfoRequest.encode_frame(Version::V2, &mut buffer).unwrap();
    io.write_all(frame).await.unwrap();
    let mut answer = [0; 24];
    timeout(Duration::from_secs(5), io.read_exact(&mut answer)).await.unwrap().unwrap();
    assert_eq!(answer[..4], [b'$', 86, 18, 104]);
}

#[tokio::test(start_paused = true)]
async fn in_process_the_clock_is_that_of_tokio() {
    let mut line = in_process(Config { bit_rate: Some(10_000), ..Config::default() });
    tokio::time::sleep(ms(1)).await;
    let start = Instant::now();
    says_who_it_is(&mut line).await;
    // 6 bytes until 7 ms, seen at 8, and 24 bytes more.
    assert_eq!(start.elapsed(), ms(31));
}

#[tokio::test(start_paused = true)]
async fn a_stream_of_each_cycle_loses_nothing() {
    let mut line = in_process(Config::default());
    let source = StreamSource::RealtimeDataCustom(RealtimeDataCustomFlags::IMU_ANGLES);
    let request = DataStreamInterval::new(source, StreamInterval::EVERY_CYCLE);
    let mut buffer = [0; 64];
    let frame = request.encode_frame(Version::V1, &mut buffer).unwrap();
    tokio::time::sleep(ms(1)).await;
    line.write_all(frame).await.unwrap();
    let mut confirm = [0; 7];
    line.read_exact(&mut confirm).await.unwrap();
    assert_eq!(confirm[..2], [b'>', 67]);
    let start = Instant::now();
    let mut samples = vec![0; 13 * 12_500];
    line.read_exact(&mut samples).await.unwrap();
    assert_eq!(start.elapsed(), Duration::from_secs(10));
}

#[tokio::test]
async fn each_on_tcp_has_a_board_of_its_own() {
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let server = tokio::spawn(serve_tcp(Config::default(), listener));
    // One that is idle keeps nobody waiting.
    let idle = tokio::net::TcpStream::connect(address).await.unwrap();
    let mut clients = Vec::new();
    for _ in 0..2 {
        let mut stream = tokio::net::TcpStream::connect(address).await.unwrap();
        says_who_it_is(&mut stream).await;
        clients.push(stream);
    }
    // What one of them turns off is on for the other.
    turn_motors_off(&mut clients[0]).await;
    assert!(!motors_are_on(&mut clients[0]).await && motors_are_on(&mut clients[1]).await);
    drop(idle);
    server.abort();
}

#[tokio::test]
async fn a_shared_board_is_one_for_all() {
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let board = SharedBoard::new(Board::new(Config::default()));
    let server = tokio::spawn(serve_shared_tcp(board.clone(), listener));
    let mut first = tokio::net::TcpStream::connect(address).await.unwrap();
    let mut second = tokio::net::TcpStream::connect(address).await.unwrap();
    turn_motors_off(&mut first).await;
    assert!(!motors_are_on(&mut second).await);
    // Each has its own port, so each may speak a version of its own.
    assert!(board.with(|board| board.last_commands().any(|command| command.port == 2)));
    server.abort();
}

#[tokio::test]
async fn an_unplugged_board_takes_nobody_until_it_is_back() {
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let unplug = Fault::Unplug { at: ms(100), lasts: ms(300) };
    let server = tokio::spawn(serve_tcp(Config { faults: vec![unplug], ..Config::default() }, listener));
    let mut stream = tokio::net::TcpStream::connect(address).await.unwrap();
    says_who_it_is(&mut stream).await;
    // The connection ends, and a new one is refused for a while.
    assert_eq!(timeout(Duration::from_secs(5), stream.read(&mut [0; 8])).await.unwrap().unwrap_or(0), 0);
    assert!(tokio::net::TcpStream::connect(address).await.is_err());
    let start = Instant::now();
    let mut again = loop {
        match tokio::net::TcpStream::connect(address).await {
            Ok(stream) => break stream,
            Err(_) => assert!(start.elapsed() < Duration::from_secs(10)),
        }
        tokio::time::sleep(ms(20)).await;
    };
    says_who_it_is(&mut again).await;
    server.abort();
}

async fn ask(stream: &mut (impl AsyncRead + AsyncWrite + Unpin), id: u8, answer: usize) -> Vec<u8> {
    let mut buffer = [0; 16];
    let frame = sbgc_proto::frame::encode_into(Version::V2, id, &[], &mut buffer).unwrap();
    stream.write_all(frame).await.unwrap();
    let mut got = vec![0; 6 + answer];
    timeout(Duration::from_secs(5), stream.read_exact(&mut got)).await.unwrap().unwrap();
    got
}

async fn turn_motors_off(stream: &mut (impl AsyncRead + AsyncWrite + Unpin)) {
    assert_eq!(ask(stream, 109, 2).await[1], 67);
}

async fn motors_are_on(stream: &mut (impl AsyncRead + AsyncWrite + Unpin)) -> bool {
    let got = ask(stream, 23, 63).await;
    RealtimeData3::decode(&got[4..67]).unwrap().rt_data_flags.contains(RtDataFlags::MOTORS_ON)
}

#[cfg(unix)]
mod pty {
    use std::fs;

    use tokio_serial::{SerialPortBuilderExt, SerialStream};

    use std::time::Duration;

    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::time::{sleep, timeout};

    use super::{Board, Config, SharedBoard, motors_are_on, says_who_it_is};
    use crate::sim::{LineRate, Pty};

    fn open(path: &std::path::Path) -> SerialStream {
        tokio_serial::new(path.to_str().unwrap(), 115_200).open_native_async().unwrap()
    }

    #[tokio::test]
    async fn a_host_can_close_and_open_it_again() {
        let link = std::env::temp_dir().join(format!("sbgc-sim-{}", std::process::id()));
        let mut pty = Pty::open(Some(&link), LineRate::Only(115_200)).unwrap();
        let path = pty.path().to_path_buf();
        let server =
            tokio::spawn(async move { pty.serve(&SharedBoard::new(Board::new(Config::default()))).await });
        for path in [&path, &link] {
            says_who_it_is(&mut open(path)).await;
        }
        server.abort();
        assert!(server.await.unwrap_err().is_cancelled());
        assert!(fs::symlink_metadata(&link).is_err(), "the link is still there");
    }

    #[tokio::test]
    async fn nothing_of_a_backlog_reaches_the_next_host() {
        let mut pty = Pty::open(None, LineRate::Any).unwrap();
        let path = pty.path().to_path_buf();
        let board = SharedBoard::new(Board::new(Config::default()));
        let shared = board.clone();
        let server = tokio::spawn(async move { pty.serve(&shared).await });
        // It sends and never reads; the last command turns the motors off.
        let mut first = open(&path);
        let mut control = vec![0x3E, 67, 15, 82];
        control.resize(20, 0);
        for _ in 0..1000 {
            first.write_all(&control).await.unwrap();
        }
        first.write_all(&[0x3E, 109, 0, 109, 0]).await.unwrap();
        let start = tokio::time::Instant::now();
        while board.with(|board| board.motion().motors_on()) {
            assert!(start.elapsed() < Duration::from_secs(20), "the board stopped obeying");
            sleep(Duration::from_millis(20)).await;
        }
        drop(first);
        let mut second = open(&path);
        sleep(Duration::from_millis(100)).await;
        assert!(!motors_are_on(&mut second).await, "the first answer is the first that it asked for");
        server.abort();
    }

    #[tokio::test]
    async fn another_bit_rate_gives_garbage() {
        let mut pty = Pty::open(None, LineRate::Only(57_600)).unwrap();
        let path = pty.path().to_path_buf();
        let board = SharedBoard::new(Board::new(Config::default()));
        let server = tokio::spawn(async move { pty.serve(&board).await });
        let mut wrong = open(&path);
        wrong.write_all(&[0x3E, 86, 0, 86, 0]).await.unwrap();
        assert!(timeout(Duration::from_millis(300), wrong.read(&mut [0; 64])).await.is_err());
        drop(wrong);
        let mut right = tokio_serial::new(path.to_str().unwrap(), 57_600).open_native_async().unwrap();
        says_who_it_is(&mut right).await;
        server.abort();
    }

    #[tokio::test]
    async fn only_a_left_over_link_is_replaced() {
        let link = std::env::temp_dir().join(format!("sbgc-sim-link-{}", std::process::id()));
        fs::write(&link, "mine").unwrap();
        let error = Pty::open(Some(&link), LineRate::Only(115_200)).unwrap_err();
        assert_eq!(error.kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read(&link).unwrap(), b"mine");
        fs::remove_file(&link).unwrap();

        // A link to a device that is there is somebody's.
        std::os::unix::fs::symlink("/dev/null", &link).unwrap();
        assert_eq!(
            Pty::open(Some(&link), LineRate::Only(115_200)).unwrap_err().kind(),
            std::io::ErrorKind::AlreadyExists
        );
        fs::remove_file(&link).unwrap();

        std::os::unix::fs::symlink("/dev/pts/no-such", &link).unwrap();
        let pty = Pty::open(Some(&link), LineRate::Only(115_200)).unwrap();
        assert_eq!(fs::read_link(&link).unwrap(), pty.path());
        drop(pty);
        assert!(fs::symlink_metadata(&link).is_err());
    }
}
