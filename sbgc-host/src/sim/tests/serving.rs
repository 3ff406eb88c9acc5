//! The board behind streams of bytes.

use std::time::Duration;

use sbgc_proto::Message;
use sbgc_proto::commands::{BoardInfoRequest, DataStreamInterval, RealtimeDataCustomFlags, StreamSource};
use sbgc_proto::frame::Version;
use sbgc_proto::units::StreamInterval;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::{Instant, timeout};

use super::ms;
use crate::sim::{Board, Config, in_process, serve_tcp};

/// Asks who the board is and waits for the answer.
async fn says_who_it_is(io: &mut (impl AsyncRead + AsyncWrite + Unpin)) {
    let mut buffer = [0; 16];
    let frame = BoardInfoRequest {}.encode_frame(Version::V2, &mut buffer).unwrap();
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
async fn one_after_the_other_on_tcp() {
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let server = tokio::spawn(serve_tcp(Board::new(Config::default()), listener));
    for _ in 0..2 {
        let mut stream = tokio::net::TcpStream::connect(address).await.unwrap();
        says_who_it_is(&mut stream).await;
    }
    server.abort();
}

#[cfg(unix)]
mod pty {
    use std::fs;

    use tokio_serial::{SerialPortBuilderExt, SerialStream};

    use super::{Board, Config, says_who_it_is};
    use crate::sim::Pty;

    fn open(path: &std::path::Path) -> SerialStream {
        tokio_serial::new(path.to_str().unwrap(), 115_200).open_native_async().unwrap()
    }

    #[tokio::test]
    async fn a_host_can_close_and_open_it_again() {
        let link = std::env::temp_dir().join(format!("sbgc-sim-{}", std::process::id()));
        let mut pty = Pty::open(Some(&link)).unwrap();
        let path = pty.path().to_path_buf();
        let server = tokio::spawn(async move { pty.serve(&mut Board::new(Config::default())).await });
        for path in [&path, &link] {
            says_who_it_is(&mut open(path)).await;
        }
        server.abort();
        assert!(server.await.unwrap_err().is_cancelled());
        assert!(fs::symlink_metadata(&link).is_err(), "the link is still there");
    }

    #[tokio::test]
    async fn only_a_left_over_link_is_replaced() {
        let link = std::env::temp_dir().join(format!("sbgc-sim-link-{}", std::process::id()));
        fs::write(&link, "mine").unwrap();
        let error = Pty::open(Some(&link)).unwrap_err();
        assert_eq!(error.kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read(&link).unwrap(), b"mine");
        fs::remove_file(&link).unwrap();

        // A link to a device that is there is somebody's.
        std::os::unix::fs::symlink("/dev/null", &link).unwrap();
        assert_eq!(Pty::open(Some(&link)).unwrap_err().kind(), std::io::ErrorKind::AlreadyExists);
        fs::remove_file(&link).unwrap();

        std::os::unix::fs::symlink("/dev/pts/no-such", &link).unwrap();
        let pty = Pty::open(Some(&link)).unwrap();
        assert_eq!(fs::read_link(&link).unwrap(), pty.path());
        drop(pty);
        assert!(fs::symlink_metadata(&link).is_err());
    }
}
