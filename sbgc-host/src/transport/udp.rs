//! Boards behind a serial bridge that passes the bytes on in datagrams.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{UdpSocket, lookup_host};

use super::Address;
use crate::error::{Error, Result};

/// The longest datagram that is taken whole. Bridges send far shorter ones.
const LONGEST: usize = 2048;

/// Bytes in datagrams to and from one peer.
///
/// What arrives out of order or is lost is for the framing to notice.
#[derive(Debug)]
pub struct UdpStream {
    socket: UdpSocket,
    /// What of the last datagram was not yet taken.
    rest: Vec<u8>,
}

/// Connects to a bridge. Nothing is sent, so nobody need be there yet.
///
/// # Errors
/// If the host cannot be found or no socket can be opened.
pub async fn connect_udp(host: &str, port: u16) -> Result<UdpStream> {
    let connecting = async {
        let mut outcome = Err(io::ErrorKind::NotFound.into());
        for peer in lookup_host((host, port)).await? {
            let any = if peer.is_ipv4() { "0.0.0.0:0" } else { "[::]:0" };
            let socket = UdpSocket::bind(any).await?;
            outcome = socket.connect(peer).await.map(|()| UdpStream { socket, rest: Vec::new() });
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    };
    connecting.await.map_err(|source| {
        let address = Address::Udp { host: host.into(), port }.to_string();
        Error::Open { address, source }
    })
}

impl AsyncRead for UdpStream {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        while self.rest.is_empty() {
            let mut datagram = [0; LONGEST];
            let mut read = ReadBuf::new(&mut datagram);
            match ready!(self.socket.poll_recv(context, &mut read)) {
                Ok(()) => self.rest.extend_from_slice(read.filled()),
                // Nobody listens there at present; the bridge may come back.
                Err(error) if error.kind() == io::ErrorKind::ConnectionRefused => {}
                Err(error) => return Poll::Ready(Err(error)),
            }
        }
        let count = self.rest.len().min(buffer.remaining());
        let taken: Vec<u8> = self.rest.drain(..count).collect();
        buffer.put_slice(&taken);
        Poll::Ready(Ok(()))
    }
}

impl AsyncWrite for UdpStream {
    fn poll_write(self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        match ready!(self.socket.poll_send(context, bytes)) {
            Err(error) if error.kind() == io::ErrorKind::ConnectionRefused => Poll::Ready(Ok(bytes.len())),
            outcome => Poll::Ready(outcome),
        }
    }

    fn poll_flush(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::net::UdpSocket;

    use crate::transport::{Address, Line};

    #[tokio::test]
    async fn bytes_pass_both_ways_in_datagrams() {
        let bridge = UdpSocket::bind("127.0.0.1:0").await.unwrap();
        let port = bridge.local_addr().unwrap().port();
        let address: Address = format!("udp://127.0.0.1:{port}").parse().unwrap();
        let mut near = address.open(Line::default()).await.unwrap();
        near.write_all(b"ping").await.unwrap();
        let mut buffer = [0; 8];
        let (count, peer) = bridge.recv_from(&mut buffer).await.unwrap();
        bridge.send_to(&buffer[..count], peer).await.unwrap();
        let mut read = [0; 2];
        for half in [b"pi", b"ng"] {
            near.read_exact(&mut read).await.unwrap();
            assert_eq!(&read, half);
        }
    }
}
