//! Moves that are waited for.
//!
//! A move has arrived when the board says so and the angles agree, or when the angles alone say it twice in a row.
//! Neither counts by itself at first sight: the board's message does not say whose target was reached, so with two
//! programs it may be that of the other, and angles may be on target only in passing. Only the axes that the command
//! moves to an angle are looked at.

use std::time::Duration;

use sbgc_proto::commands::{Angles, AxisAngles, Confirm, Control, ControlAxis, ControlMode, ControlModeKind};
use sbgc_proto::units::{Angle, ControlRate};
use sbgc_proto::wire::PerAxis;
use sbgc_proto::{CommandId, Message};
use tokio::time::{Instant, sleep_until, timeout_at};

use crate::error::{Error, Result};
use crate::gimbal::{Gimbal, LONGEST};
use crate::streams::{Sample, Subscription};

/// How often the angles are requested while the board does not report arrival.
const POLL: Duration = Duration::from_millis(250);

/// Arrival tolerance: one degree, as in the board's own check.
const NEAR: u16 = 46;

/// A full turn.
const TURN: u16 = 1 << 14;

impl Gimbal {
    /// Moves the axes that have an angle to it and waits until they are there.
    ///
    /// The angles are Euler angles over two turns either way; speed 0 is that of the board's settings. The other axes
    /// are left as they are. See [`control_and_wait`](Self::control_and_wait).
    ///
    /// # Errors
    /// If the board does not take the command, or does not get there `within` this time.
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
    /// The board reports arrival from firmware 2.62b7 on; the angles are requested as well, and decide with it. Giving
    /// up by dropping the future does not stop the motion, and neither does [`Error::NotReached`]: use a
    /// [`ControlSession`](crate::ControlSession) for that.
    ///
    /// # Errors
    /// If the board does not take the command, or does not get there `within` this time.
    pub async fn control_and_wait(&self, control: &Control, within: Duration) -> Result<()> {
        let arrival = Arrival::watch(self, control.with_auto_task(), within);
        arrival.started(self.confirm(&arrival.control)).await?;
        arrival.wait().await
    }
}

/// Waits for the end of one move.
pub(crate) struct Arrival<'a> {
    gimbal: &'a Gimbal,
    pub(crate) control: Control,
    confirmations: Subscription,
    within: Duration,
    deadline: Instant,
}

impl<'a> Arrival<'a> {
    /// Begins to listen, so that no report of the board is missed; to be called before the command is sent.
    pub(crate) fn watch(gimbal: &'a Gimbal, control: Control, within: Duration) -> Self {
        let confirmations = gimbal.listen(CommandId::CONFIRM);
        let deadline = Instant::now() + within.min(LONGEST);
        Self { gimbal, control, confirmations, within, deadline }
    }

    /// Waits until the board has taken the command, or might have.
    pub(crate) async fn started(&self, confirmed: impl Future<Output = Result<Confirm>>) -> Result<()> {
        match timeout_at(self.deadline, confirmed).await {
            // Confirmations may be off, or this one lost: where the gimbal goes will tell.
            Ok(Ok(_) | Err(Error::Timeout { .. })) => Ok(()),
            Ok(Err(error)) => Err(error),
            Err(_) => Err(Error::NotReached { after: self.within }),
        }
    }

    /// Waits until the gimbal is there.
    pub(crate) async fn wait(mut self) -> Result<()> {
        let mut before: Option<Angles> = None;
        let mut poll = Instant::now() + POLL;
        loop {
            let reported = tokio::select! {
                sample = self.confirmations.next() => match sample {
                    Some(Sample::Payload(payload)) if reports_arrival(&payload) => true,
                    Some(_) => continue,
                    None => return Err(self.gimbal.gone()),
                },
                () = sleep_until(poll.min(self.deadline)) => false,
            };
            if Instant::now() >= self.deadline {
                return Err(Error::NotReached { after: self.within });
            }
            match timeout_at(self.deadline, self.gimbal.angles()).await {
                Ok(Ok(angles)) if is_there(&self.control, before.as_ref(), &angles, reported) => {
                    return Ok(());
                }
                Ok(Ok(angles)) => before = Some(angles),
                Ok(Err(error @ (Error::Disconnected | Error::Closed))) => return Err(error),
                // The next one may come through.
                Ok(Err(_)) | Err(_) => {}
            }
            poll = Instant::now() + POLL;
        }
    }
}

fn reports_arrival(payload: &[u8]) -> bool {
    Confirm::decode(payload)
        .is_ok_and(|confirm| confirm.cmd_id == CommandId::Control && confirm.data.value() == 1)
}

/// Whether all axes that `control` moves to an angle are there, by the angles of now and, unless the board has
/// `reported` it, by those before, too.
fn is_there(control: &Control, before: Option<&Angles>, now: &Angles, reported: bool) -> bool {
    let commands = control.control_mode.into_array().into_iter().zip(control.axes.into_array());
    let now = now.axes.into_array();
    let before = before.map(|angles| angles.axes.into_array());
    commands.enumerate().all(|(index, (mode, wanted))| {
        let Some(now) = now.get(index) else { return false };
        let before = before.as_ref().and_then(|before| before.get(index));
        match mode.kind() {
            ControlModeKind::Angle | ControlModeKind::AngleShortest | ControlModeKind::SpeedAngle => {
                let on_target = |angles: &AxisAngles| is_on_target(mode, wanted, *angles);
                on_target(now) && (reported || before.is_some_and(on_target))
            }
            // Where the frame is, the angles do not say; but the target has come to rest.
            ControlModeKind::AngleRelFrame => {
                let follows = near(now.imu_angle, now.target_angle);
                follows && before.is_some_and(|before| before.target_angle == now.target_angle)
            }
            _ => true,
        }
    })
}

fn is_on_target(mode: ControlMode, wanted: ControlAxis, angles: AxisAngles) -> bool {
    let near = if mode.kind() == ControlModeKind::AngleShortest { near_around } else { near };
    near(angles.imu_angle, wanted.angle) && near(angles.target_angle, wanted.angle)
}

/// Whether two angles are at most a degree apart; a whole turn apart is apart.
fn near(one: Angle, other: Angle) -> bool {
    let apart = one.0.wrapping_sub(other.0).cast_unsigned();
    apart.min(apart.wrapping_neg()) <= NEAR
}

/// Whether two angles are at most a degree apart, whole turns aside.
fn near_around(one: Angle, other: Angle) -> bool {
    let apart = one.0.wrapping_sub(other.0).cast_unsigned() % TURN;
    apart.min(TURN - apart) <= NEAR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_turn_is_not_near_except_by_the_shortest_way() {
        let degrees = Angle::from_degrees;
        assert!(near(degrees(10.0), degrees(10.9)) && !near(degrees(10.0), degrees(11.2)));
        assert!(near(degrees(-0.5), degrees(0.4)) && !near(degrees(0.0), degrees(360.0)));
        assert!(near_around(degrees(179.8), degrees(-179.8)) && near_around(degrees(0.0), degrees(360.0)));
        assert!(!near_around(degrees(90.0), degrees(-90.0)));
    }
}
