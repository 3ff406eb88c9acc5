//! Motion that is waited for.

use std::time::Duration;

use sbgc_proto::commands::{Angles, Confirm, Control, ControlModeKind};
use sbgc_proto::units::{Angle, ControlRate};
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, Message};
use tokio::time::{Instant, sleep_until, timeout_at};

use super::Gimbal;
use super::options::LONGEST;
use crate::streams::Sample;
use crate::{Error, Result};

/// How often the angles are asked for while the board does not say that it is there.
const POLL: Duration = Duration::from_millis(250);

/// How near to the target is there: one degree, as the board itself has it.
const NEAR: u16 = 46;

/// A full turn.
const TURN: u16 = 1 << 14;

impl Gimbal {
    /// Moves the axes that have an angle to it and waits until they are there.
    ///
    /// The angles are Euler angles, the speed 0 is that of the board's settings. The other axes are left as they are.
    /// See [`control_and_wait`](Self::control_and_wait).
    pub async fn move_to(
        &self,
        target: PerAxis<Option<Angle>>,
        speed: ControlRate,
        within: Duration,
    ) -> Result<()> {
        let control = Control::some_angles(target, speed);
        self.control_and_wait(&control, within).await
    }

    /// Moves the gimbal as an automated task and waits until all target angles are reached.
    ///
    /// The board says so itself from firmware 2.62b7 on. For older firmware, and should that message be lost, the
    /// angles are asked for as well. Giving up by dropping the future does not stop the motion, and neither does
    /// [`Error::NotReached`].
    pub async fn control_and_wait(&self, control: &Control, within: Duration) -> Result<()> {
        let deadline = Instant::now() + within.min(LONGEST);
        let control = control.with_auto_task();
        let mut confirmations = self.listen(CommandId::CONFIRM);
        match timeout_at(deadline, self.confirm(&control)).await {
            // Confirmations may be off, or this one lost: where the gimbal goes will tell.
            Ok(Ok(_) | Err(Error::Timeout { .. })) => {}
            Ok(Err(error)) => return Err(error),
            Err(_) => return Err(Error::NotReached { after: within }),
        }
        let mut before = None;
        let mut poll = Instant::now() + POLL;
        loop {
            tokio::select! {
                sample = confirmations.next() => match sample {
                    Some(Sample::Payload(payload)) if says_reached(&payload) => return Ok(()),
                    Some(_) => {}
                    None => return Err(self.gone()),
                },
                () = sleep_until(poll.min(deadline)) => {
                    if Instant::now() >= deadline {
                        return Err(Error::NotReached { after: within });
                    }
                    match timeout_at(deadline, self.angles()).await {
                        Ok(Ok(angles)) if is_reached(&control, before.as_ref(), &angles) => return Ok(()),
                        Ok(Ok(angles)) => before = Some(angles),
                        Ok(Err(error @ (Error::Disconnected | Error::Closed))) => return Err(error),
                        // The next one may come through.
                        Ok(Err(_)) | Err(_) => {}
                    }
                    poll = Instant::now() + POLL;
                }
            }
        }
    }
}

fn says_reached(payload: &[u8]) -> bool {
    Confirm::decode(payload)
        .is_ok_and(|confirm| confirm.cmd_id == CommandId::Control && confirm.data.value() == 1)
}

/// Whether the camera points where `control` wants it, as far as the angles can tell.
fn is_reached(control: &Control, before: Option<&Angles>, now: &Angles) -> bool {
    let Some(before) = before else { return false };
    let modes = control.control_mode.into_array().into_iter().zip(control.axes.into_array());
    let angles = before.axes.into_array().into_iter().zip(now.axes.into_array());
    modes.zip(angles).all(|((mode, wanted), (before, now))| {
        let there = near(now.imu_angle, now.target_angle);
        match mode.kind() {
            ControlModeKind::Angle | ControlModeKind::AngleShortest => {
                there && near(now.target_angle, wanted.angle)
            }
            // Where the frame is, the angles do not say; but the target has come to rest.
            ControlModeKind::AngleRelFrame => there && before.target_angle == now.target_angle,
            _ => true,
        }
    })
}

/// Whether two angles are at most a degree apart, whole turns aside.
fn near(one: Angle, other: Angle) -> bool {
    let apart = one.0.wrapping_sub(other.0).cast_unsigned() % TURN;
    apart.min(TURN - apart) <= NEAR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearness_goes_around() {
        let degrees = Angle::from_degrees;
        assert!(near(degrees(10.0), degrees(10.9)) && !near(degrees(10.0), degrees(11.2)));
        assert!(near(degrees(179.8), degrees(-179.8)));
        assert!(near(degrees(0.0), degrees(360.0)) && near(degrees(-0.5), degrees(0.4)));
        assert!(!near(degrees(90.0), degrees(-90.0)));
    }
}
