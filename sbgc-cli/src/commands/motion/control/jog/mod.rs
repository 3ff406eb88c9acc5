//! `sbgc control jog`: moving the axes by keys.
//!
//! What the keys do is in [`pilot`], which knows neither terminal nor board; the terminal is in [`screen`].

mod pilot;
mod screen;

use std::io::{self, IsTerminal as _};
use std::time::Duration;

use clap::Args;
use sbgc_host::{ControlSession, Gimbal, Setpoint};
use sbgc_proto::wire::PerAxis;
use tokio::time::{Instant, MissedTickBehavior};

use self::pilot::{Pilot, Wish};
use self::screen::{Keys, Screen};
use super::limits::speed;
use super::own::{End, own};
use crate::connect::with_board_to_the_end;
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::output::Output;
use crate::talk;

const EXAMPLES: &str = "Examples:
  sbgc control jog
  sbgc control jog --speed 5";

/// How often keys that were released are noticed, and the screen is drawn.
const TICK: Duration = Duration::from_millis(50);

/// How often the angles are read.
const LOOK: Duration = Duration::from_millis(200);

/// Move the axes by keys, on a terminal
///
/// Arrows move yaw and pitch, a and d roll; an axis stops when its key is released. + and - change the speed,
/// space stops, q ends.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Jog {
    /// Speed at the start, in degrees per second
    #[arg(long, value_name = "DEG/S", default_value = "20", value_parser = speed)]
    speed: f32,
}

impl Jog {
    pub(super) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        if global.dry_run {
            talk::say("jog sends what the keys say; there is nothing to show beforehand");
            return Ok(());
        }
        if !io::stdin().is_terminal() || !io::stdout().is_terminal() {
            let message = "jog needs a terminal for its keys and its screen; see `sbgc control speed`";
            return Err(Failure::Usage(String::from(message)));
        }
        let ended = with_board_to_the_end(global, async |gimbal, _| {
            let work = async |session: &ControlSession| self.fly(&gimbal, session).await;
            own(&gimbal, output, work).await
        });
        until_stopped(ended.await)
    }

    async fn fly(&self, gimbal: &Gimbal, session: &ControlSession) -> Result<End, Failure> {
        let mut screen = Screen::open()?;
        let mut keys = Keys::listen();
        let mut pilot = Pilot::new(self.speed);
        let mut ticks = tokio::time::interval(TICK);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut angles = None;
        let mut look = Instant::now();
        let mut sent = PerAxis::default();
        loop {
            tokio::select! {
                key = keys.next() => match key {
                    Some(key) => {
                        if pilot.press(&key, Instant::now()) == Wish::End {
                            return Ok(End::Stop);
                        }
                    }
                    None => return Err(Failure::Failed(String::from("the terminal is gone"))),
                },
                _ = ticks.tick() => {
                    if look.elapsed() >= LOOK {
                        look = Instant::now();
                        angles = gimbal.angles().await.ok().or(angles);
                    }
                }
            }
            let speeds = pilot.speeds(Instant::now());
            if speeds != sent {
                session.set(Setpoint::speeds(speeds)?)?;
                sent = speeds;
            }
            screen.draw(&pilot, speeds, angles.as_ref())?;
        }
    }
}
