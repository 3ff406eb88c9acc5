//! Sending a capture's outgoing frames again, with their distances in time.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::{CommandId, Direction};
use tokio::time::{Instant, sleep_until};

use super::{Captured, likely_direction};
use crate::{Gimbal, Result};

/// A frame to be sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReplayStep {
    /// When, counted from the first frame.
    pub after: Duration,
    /// Id of the command.
    pub command: CommandId,
    /// The payload.
    pub payload: Bytes,
}

/// What a capture's host sent, in its order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Replay {
    steps: Vec<ReplayStep>,
}

/// Clocks of a day start again; anything else that goes backwards is taken as no distance.
const HALF_A_DAY: Duration = Duration::from_hours(12);

impl Replay {
    /// Takes the outgoing frames of a capture.
    ///
    /// Where the capture has no directions, those are taken that an answer or sample cannot be. Without times the
    /// frames follow each other as fast as the board takes them.
    pub fn new(items: impl IntoIterator<Item = Captured>) -> Self {
        let (mut steps, mut after, mut last) = (Vec::new(), Duration::ZERO, None);
        for item in items {
            let Captured::Frame { time, direction, id, payload, .. } = item else { continue };
            let command = CommandId::from_raw(id);
            if direction.unwrap_or_else(|| likely_direction(command, payload.len())) != Direction::Outgoing {
                continue;
            }
            if let (Some(time), Some(last)) = (time, last) {
                after += distance(last, time);
            }
            last = time.or(last);
            steps.push(ReplayStep { after, command, payload: payload.into() });
        }
        Self { steps }
    }

    /// The frames, with the times at which they are sent.
    pub fn steps(&self) -> &[ReplayStep] {
        &self.steps
    }

    /// How long it takes at the speed of the capture.
    pub fn duration(&self) -> Duration {
        self.steps.last().map_or(Duration::ZERO, |step| step.after)
    }

    /// Sends the frames to a board, `speed` times as fast as they were captured; calls `sent` after each.
    ///
    /// Answers are not waited for: [`Gimbal::listen`] shows them.
    ///
    /// # Errors
    /// If a frame does not fit the board's input buffer, or the link has ended.
    pub async fn run(&self, gimbal: &Gimbal, speed: f64, mut sent: impl FnMut(&ReplayStep)) -> Result<()> {
        let began = Instant::now();
        for step in &self.steps {
            let after =
                Duration::try_from_secs_f64(step.after.as_secs_f64() / speed).unwrap_or(Duration::MAX);
            match began.checked_add(after) {
                Some(due) => sleep_until(due).await,
                None => std::future::pending().await,
            }
            gimbal.send_raw(step.command, step.payload.clone()).await?;
            sent(step);
        }
        Ok(())
    }
}

fn distance(last: Duration, time: Duration) -> Duration {
    match time.checked_sub(last) {
        Some(distance) => distance,
        None if last.saturating_sub(time) > HALF_A_DAY => (time + 2 * HALF_A_DAY).saturating_sub(last),
        None => Duration::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Options;
    use crate::capture::{Format, Reader};
    use tokio::io::AsyncReadExt;

    fn replay(log: &str) -> Replay {
        let (mut reader, mut items) = (Reader::new(Format::Log), Vec::new());
        reader.feed(log.as_bytes(), &mut |item| items.push(item)).unwrap();
        reader.finish(&mut |item| items.push(item)).unwrap();
        Replay::new(items)
    }

    #[test]
    fn distances_are_those_of_the_capture() {
        let replay = replay(
            "23:59:59.9 out: [86,0]\n23:59:59.95 in: [67,2] 56 00\n00:00:00.1 out: [73,0]\n00:00:00.0 out: [77,0]\n",
        );
        let steps: Vec<_> =
            replay.steps().iter().map(|step| (step.after.as_millis(), step.command.raw())).collect();
        assert_eq!(steps, [(0, 86), (200, 73), (200, 77)]);
        assert_eq!(replay.duration().as_millis(), 200);
    }

    #[tokio::test(start_paused = true)]
    async fn frames_are_sent_at_their_times() {
        let (near, mut far) = tokio::io::duplex(256);
        let gimbal = Gimbal::spawn(near, Options::default());
        let replay = replay("1.0 out: [86,0]\n3.0 out: [73,0]\n");
        let began = Instant::now();
        let mut count = 0;
        replay.run(&gimbal, 2.0, |_| count += 1).await.unwrap();
        assert_eq!((count, began.elapsed()), (2, Duration::from_secs(1)));
        let mut sent = [0; 12];
        far.read_exact(&mut sent).await.unwrap();
        assert_eq!((sent[1], sent[7]), (86, 73));
    }
}
