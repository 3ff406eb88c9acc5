//! `sbgc record`: everything that passes the port, into a file.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use clap::Args;
use sbgc_host::Gimbal;
use sbgc_host::capture::{Captured, Frames, Passed, Recorder};

use super::explain::Explainer;
use crate::connect::with_tapped_board;
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::sampling::{Next, Sampling, Selection};
use crate::{signals, talk, values};

const EXAMPLES: &str = "Examples:
  sbgc record session.log --for 1s
  sbgc record session.log realtime4 --interval 50Hz --count 20 --json";

/// Record a stream and all other traffic
///
/// Subscribes like `sbgc stream` and writes every frame of both directions with its time, one per line, as it passes.
/// Replaces an existing file. Read it with `sbgc decode`, `sbgc plot` or `sbgc replay`.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Record {
    /// File to write
    file: PathBuf,

    #[command(flatten)]
    selection: Selection,

    /// Stop after N samples
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,

    /// Stop after this time
    #[arg(long = "for", value_name = "TIME", value_parser = values::seconds)]
    time: Option<Duration>,
}

impl Record {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        self.selection.source()?;
        let began = SystemTime::now();
        let mut sink = Sink {
            path: &self.file,
            began,
            recorder: None,
            frames: 0,
            explainer: Explainer::new(None, None, output),
        };
        let recorded = with_tapped_board(global, async |gimbal, frames| {
            // Nothing is replaced unless there is something to record.
            sink.open()?;
            until_stopped(self.record(&gimbal, frames, &mut sink).await)
        })
        .await;
        let (outcome, mut frames) = match recorded {
            Ok(((), frames)) => (Ok(()), Some(frames)),
            Err(failure) => (Err(failure), None),
        };
        // The end of the stream belongs to it.
        while let Some(passed) = frames.as_mut().and_then(|frames| frames.try_recv().ok()) {
            sink.write(&passed)?;
        }
        if sink.recorder.is_some() {
            talk::say(format_args!("{} frames in {}", sink.frames, self.file.display()));
        }
        until_stopped(outcome)
    }

    async fn record(
        &self,
        gimbal: &Gimbal,
        frames: &mut Frames,
        sink: &mut Sink<'_, '_>,
    ) -> Result<(), Failure> {
        let limit = tokio::time::sleep(self.time.unwrap_or(Duration::from_hours(24 * 365)));
        tokio::pin!(limit);
        let sampling = Sampling::start(gimbal, self.selection.source()?, self.selection.interval);
        let samples = async {
            let mut sampling = sampling.await?;
            let mut left = self.count.unwrap_or(u64::MAX);
            while left > 0 {
                match sampling.next().await? {
                    Next::Sample(..) => left -= 1,
                    Next::Said(what) => tracing::info!("{what}"),
                    Next::Lost(_) => {}
                }
            }
            Ok::<_, Failure>(())
        };
        tokio::pin!(samples);
        loop {
            tokio::select! {
                biased;
                signal = signals::stopped() => return Err(Failure::Signal(signal)),
                Some(passed) = frames.recv() => sink.write(&passed)?,
                ended = &mut samples => return ended,
                () = &mut limit => return Ok(()),
            }
        }
    }
}

/// The file, and the frames as they are shown with `--json`.
struct Sink<'r, 'o> {
    path: &'r Path,
    began: SystemTime,
    recorder: Option<Recorder<File>>,
    frames: u64,
    explainer: Explainer<'o>,
}

impl Sink<'_, '_> {
    fn open(&mut self) -> Result<(), Failure> {
        let file = replace(self.path).map_err(|source| self.failed(source))?;
        self.recorder = Some(Recorder::new(file, self.began));
        Ok(())
    }

    fn write(&mut self, passed: &Passed) -> Result<(), Failure> {
        let Some(recorder) = &mut self.recorder else { return Ok(()) };
        recorder.write(passed).map_err(|source| self.failed(source))?;
        self.frames += 1;
        if self.explainer.output.is_json() {
            let Passed { direction, version, id, payload, .. } = passed.clone();
            let (at, direction, version) = (self.frames, Some(direction), Some(version));
            self.explainer.print(Captured::Frame { at, time: None, version, direction, id, payload })?;
            self.explainer.output.flush()?;
        }
        Ok(())
    }

    fn failed(&self, source: io::Error) -> Failure {
        Failure::File { place: self.path.display().to_string(), source }
    }
}

/// An empty file in the place of what was there; whoever reads the old one keeps it.
fn replace(path: &Path) -> io::Result<File> {
    if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        return File::options().write(true).open(path);
    }
    // What a link leads to is replaced, not the link.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.new", std::process::id()));
    let new = path.with_file_name(name);
    let file = File::options().write(true).create_new(true).open(&new)?;
    fs::rename(&new, &path).inspect_err(|_| drop(fs::remove_file(&new)))?;
    Ok(file)
}
