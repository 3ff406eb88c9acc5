//! Boards behind a server that passes the bytes on.

use std::io;
use std::time::Duration;

use tokio::net::TcpStream;
use tokio::time::timeout;

use super::Address;
use crate::{Error, Result};

/// How long a host may take to accept. The system alone would try for minutes.
const PATIENCE: Duration = Duration::from_secs(10);

/// Connects. Small packets go out at once, since a request is worth nothing later.
pub async fn connect_tcp(host: &str, port: u16) -> Result<TcpStream> {
    let connecting = async {
        let stream = TcpStream::connect((host, port)).await?;
        stream.set_nodelay(true)?;
        Ok(stream)
    };
    timeout(PATIENCE, connecting).await.unwrap_or_else(|_| Err(io::ErrorKind::TimedOut.into())).map_err(
        |source| {
            let address = Address::Tcp { host: host.into(), port }.to_string();
            Error::Open { address, source }
        },
    )
}

#[cfg(test)]
mod tests {
    use crate::transport::{Address, Line};
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::net::TcpListener;

    #[tokio::test]
    async fn where_nobody_listens_is_said() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let port = listener.local_addr().unwrap().port();
        drop(listener);
        let error = super::connect_tcp("127.0.0.1", port).await.unwrap_err();
        assert!(error.to_string().starts_with(&format!("cannot open tcp://127.0.0.1:{port}: ")), "{error}");
    }

    #[tokio::test]
    async fn bytes_pass_both_ways() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let port = listener.local_addr().unwrap().port();
        let address = Address::Tcp { host: "127.0.0.1".into(), port };
        let (io, accepted) = tokio::join!(address.open(Line::default()), listener.accept());
        let (mut near, (mut far, _)) = (io.unwrap(), accepted.unwrap());
        near.write_all(b"ping").await.unwrap();
        let mut buffer = [0; 4];
        far.read_exact(&mut buffer).await.unwrap();
        far.write_all(&buffer).await.unwrap();
        near.read_exact(&mut buffer).await.unwrap();
        assert_eq!(&buffer, b"ping");
    }
}
