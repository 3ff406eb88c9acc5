//! What the driver costs: the time that it adds to a request, and what a gimbal needs at 100 Hz.
//!
//! `cargo bench -p sbgc-benches --bench driver`, best on a machine that does nothing else; `-- requests` or `-- gimbals`
//! runs one of them. Requests are cold: each comes after a pause longer than a cycle of the board, as they do where
//! somebody looks at a gimbal now and then. What the driver adds is the time of the request less that of the same bytes
//! through the bare pipe.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

use sbgc_host::sim::{Config, in_process};
use sbgc_host::streams::{Item, TypedStream};
use sbgc_host::{Gimbal, Options};
use sbgc_proto::commands::RealtimeData4;
use sbgc_proto::frame::{MAX_FRAME, Version, encode_into};
use tokio::io::{AsyncReadExt, AsyncWriteExt, DuplexStream, duplex};
use tokio::runtime::{Builder, Runtime};
use tokio::task::JoinSet;

/// `CMD_GET_ANGLES`.
const GET_ANGLES: u8 = 73;

/// Longer than a cycle of the board, so that no request waits for the one before it.
const PAUSE: Duration = Duration::from_millis(9);

const REQUESTS: usize = 1000;

const GIMBALS: u32 = 100;

const SECONDS: u32 = 10;

fn main() -> io::Result<()> {
    let chosen: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wanted = |name: &str| chosen.is_empty() || chosen.iter().any(|chosen| name.contains(chosen.as_str()));
    if wanted("requests") {
        println!(
            "cold requests, {REQUESTS} each; microseconds at the median, the 99th and the 99.9th percentile"
        );
        for (name, runtime) in [
            ("current thread", Builder::new_current_thread().enable_all().build()?),
            ("multi thread", Builder::new_multi_thread().enable_all().build()?),
        ] {
            requests(name, &runtime)?;
        }
    }
    if wanted("gimbals") {
        gimbals(&Builder::new_current_thread().enable_all().build()?)?;
    }
    Ok(())
}

/// Answers each request at once.
async fn answer(mut io: DuplexStream) {
    let mut frame = [0; MAX_FRAME];
    let answer = encode_into(Version::V2, GET_ANGLES, &[0; 18], &mut frame).expect("it fits").to_vec();
    let mut request = [0; 6];
    while io.read_exact(&mut request).await.is_ok() && io.write_all(&answer).await.is_ok() {}
}

fn requests(name: &str, runtime: &Runtime) -> io::Result<()> {
    let bare = runtime.block_on(async {
        let (mut near, far) = duplex(1024);
        tokio::spawn(answer(far));
        let mut frame = [0; MAX_FRAME];
        let request = encode_into(Version::V2, GET_ANGLES, &[], &mut frame).expect("it fits").to_vec();
        let work = async {
            let mut times = Vec::with_capacity(REQUESTS);
            for _ in 0..REQUESTS {
                tokio::time::sleep(PAUSE).await;
                let began = Instant::now();
                near.write_all(&request).await?;
                near.read_exact(&mut [0; 24]).await?;
                times.push(began.elapsed());
            }
            Ok::<_, io::Error>(times)
        };
        work.await
    })?;
    let driven = runtime.block_on(async {
        let (near, far) = duplex(1024);
        tokio::spawn(answer(far));
        let gimbal = Gimbal::spawn(near, Options::default());
        // As a program does it, in a task of its own.
        let asking = tokio::spawn(async move {
            let mut times = Vec::with_capacity(REQUESTS);
            for _ in 0..REQUESTS {
                tokio::time::sleep(PAUSE).await;
                let began = Instant::now();
                gimbal.angles().await.map_err(io::Error::other)?;
                times.push(began.elapsed());
            }
            Ok::<_, io::Error>(times)
        });
        asking.await.map_err(io::Error::other)?
    })?;
    let (bare, driven) = (percentiles(bare), percentiles(driven));
    println!(
        "  {name:<16} bare pipe {bare:>8.1?}   driver {driven:>8.1?}   added at the median {:.1}",
        driven[0] - bare[0]
    );
    Ok(())
}

/// Median, 99th and 99.9th percentile in microseconds.
fn percentiles(mut times: Vec<Duration>) -> [f64; 3] {
    times.sort_unstable();
    [500, 990, 999].map(|part| {
        let time = times.get(times.len() * part / 1000).copied().unwrap_or_default();
        time.as_secs_f64() * 1e6
    })
}

/// What came of all streams while that was counted.
#[derive(Default)]
struct Counts {
    on: AtomicBool,
    received: AtomicU64,
    lost: AtomicU64,
}

async fn count(mut samples: TypedStream<RealtimeData4>, counts: Arc<Counts>) {
    while let Some(item) = samples.next().await {
        match item {
            _ if !counts.on.load(Relaxed) => {}
            Item::Message(_) => {
                counts.received.fetch_add(1, Relaxed);
            }
            Item::Lagged(lost) => {
                counts.lost.fetch_add(lost, Relaxed);
            }
            _ => {}
        }
    }
}

/// Many gimbals in one process, each with its simulated board and a stream of 100 samples per second.
fn gimbals(runtime: &Runtime) -> io::Result<()> {
    let (_, memory_before) = used()?;
    let counts = Arc::new(Counts::default());
    let (cpu, memory) = runtime.block_on(async {
        let mut tasks = JoinSet::new();
        for _ in 0..GIMBALS {
            let gimbal = Gimbal::spawn(in_process(Config::default()), Options::default());
            gimbal.handshake().await.map_err(io::Error::other)?;
            let samples = gimbal.stream::<RealtimeData4>(Duration::from_millis(10)).await;
            tasks.spawn(count(samples.map_err(io::Error::other)?, Arc::clone(&counts)));
        }
        // All of them run.
        counts.on.store(true, Relaxed);
        let (before, _) = used()?;
        tokio::time::sleep(SECONDS * Duration::from_secs(1)).await;
        counts.on.store(false, Relaxed);
        let (after, memory) = used()?;
        Ok::<_, io::Error>((after.saturating_sub(before), memory))
    })?;
    let (received, lost) = (counts.received.load(Relaxed), counts.lost.load(Relaxed));
    let each = GIMBALS * SECONDS;
    println!(
        "{GIMBALS} gimbals with simulated boards at 100 Hz for {SECONDS} s: {received} samples, {lost} lost"
    );
    println!(
        "  {:.3} ms of CPU per gimbal and second, board included",
        cpu.as_secs_f64() * 1000.0 / f64::from(each)
    );
    println!(
        "  {} KiB of memory per gimbal, board included",
        memory.saturating_sub(memory_before) / 1024 / u64::from(GIMBALS)
    );
    Ok(())
}

/// CPU time and resident memory of this process, where the system tells them in `/proc`.
fn used() -> io::Result<(Duration, u64)> {
    let stat = std::fs::read_to_string("/proc/self/stat")?;
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let field = |index: usize| -> u64 {
        after_name.split_whitespace().nth(index).and_then(|field| field.parse().ok()).unwrap_or_default()
    };
    // User and system time in hundredths of a second, then the pages in memory.
    Ok((Duration::from_millis((field(11) + field(12)) * 10), field(21) * 4096))
}
