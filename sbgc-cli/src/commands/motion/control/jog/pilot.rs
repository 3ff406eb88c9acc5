//! What the keys make of the speeds.
//!
//! A terminal reports a key that is held only by repeating it, so an axis goes on for as long as the next repetition
//! may take: longer after the first press, since repetition sets in late. Where the terminal reports releases, they
//! count at once.

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use sbgc_proto::wire::PerAxis;
use tokio::time::Instant;

/// How long an axis goes on after the first press of its key, and after a repetition.
const FIRST: Duration = Duration::from_millis(600);
const REPEATED: Duration = Duration::from_millis(200);

/// Speeds to choose from, in degrees per second.
const SPEEDS: [f32; 13] = [0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0];

/// What is to happen beyond the speeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wish {
    GoOn,
    End,
}

/// One axis and the key that moves it.
#[derive(Clone, Copy, Debug, Default)]
struct Held {
    /// 1, -1, or 0 for standing still.
    direction: f32,
    until: Option<Instant>,
    /// Whether it was moved at all: only then it is told to stand still.
    moved: bool,
}

/// The speeds, as the keys want them.
#[derive(Clone, Debug)]
pub(super) struct Pilot {
    speed: f32,
    axes: [Held; 3],
}

const ROLL: usize = 0;
const PITCH: usize = 1;
const YAW: usize = 2;

impl Pilot {
    pub(super) fn new(speed: f32) -> Self {
        Self { speed, axes: [Held::default(); 3] }
    }

    /// The speed of an axis whose key is held, in degrees per second.
    pub(super) fn speed(&self) -> f32 {
        self.speed
    }

    /// A key was pressed, repeated or released.
    pub(super) fn press(&mut self, key: &KeyEvent, now: Instant) -> Wish {
        let released = key.kind == KeyEventKind::Release;
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        match key.code {
            KeyCode::Char('c' | 'd') if control => return Wish::End,
            _ if control => {}
            KeyCode::Left => self.hold(YAW, -1.0, released, now),
            KeyCode::Right => self.hold(YAW, 1.0, released, now),
            KeyCode::Up => self.hold(PITCH, 1.0, released, now),
            KeyCode::Down => self.hold(PITCH, -1.0, released, now),
            KeyCode::Char('a' | 'A') => self.hold(ROLL, -1.0, released, now),
            KeyCode::Char('d' | 'D') => self.hold(ROLL, 1.0, released, now),
            _ if released => {}
            KeyCode::Char('q' | 'Q') | KeyCode::Esc => return Wish::End,
            KeyCode::Char(' ') => self.axes.iter_mut().for_each(|axis| axis.until = None),
            KeyCode::Char('+' | '=') => self.change_speed(SPEEDS.iter().find(|speed| **speed > self.speed)),
            KeyCode::Char('-' | '_') => {
                self.change_speed(SPEEDS.iter().rev().find(|speed| **speed < self.speed));
            }
            _ => {}
        }
        Wish::GoOn
    }

    fn change_speed(&mut self, speed: Option<&f32>) {
        self.speed = speed.copied().unwrap_or(self.speed);
    }

    fn hold(&mut self, axis: usize, direction: f32, released: bool, now: Instant) {
        let Some(axis) = self.axes.get_mut(axis) else { return };
        let same = (axis.direction - direction).abs() < 0.5;
        let held = axis.until.is_some_and(|until| until > now) && same;
        if released {
            if same {
                axis.until = None;
            }
            return;
        }
        let time = if held { REPEATED } else { FIRST };
        // A repetition must not cut the time that the first press has given.
        let until = now + time;
        axis.until = Some(axis.until.filter(|_| held).map_or(until, |before| before.max(until)));
        axis.direction = direction;
        axis.moved = true;
    }

    /// The speeds now; nothing for axes that no key has moved yet.
    pub(super) fn speeds(&self, now: Instant) -> PerAxis<Option<f32>> {
        let speed = |axis: Held| {
            let held = axis.until.is_some_and(|until| until > now);
            axis.moved.then_some(if held { axis.direction * self.speed } else { 0.0 })
        };
        self.axes.map(speed).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(pilot: &mut Pilot, code: KeyCode, now: Instant) -> Wish {
        pilot.press(&KeyEvent::new(code, KeyModifiers::NONE), now)
    }

    fn speeds(pilot: &Pilot, now: Instant) -> [Option<f32>; 3] {
        pilot.speeds(now).into_array()
    }

    #[test]
    fn keys_move_their_axes_until_they_are_released() {
        let (mut pilot, start) = (Pilot::new(20.0), Instant::now());
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        assert_eq!(speeds(&pilot, at(0)), [None; 3]);
        for (code, axis, direction) in [
            (KeyCode::Left, YAW, -1.0),
            (KeyCode::Right, YAW, 1.0),
            (KeyCode::Up, PITCH, 1.0),
            (KeyCode::Down, PITCH, -1.0),
            (KeyCode::Char('a'), ROLL, -1.0),
            (KeyCode::Char('d'), ROLL, 1.0),
        ] {
            let mut pilot = Pilot::new(20.0);
            press(&mut pilot, code, at(0));
            assert_eq!(speeds(&pilot, at(1))[axis], Some(20.0 * direction), "{code:?}");
        }
        // Held: the repetition begins late and goes on quickly.
        press(&mut pilot, KeyCode::Right, at(0));
        assert_eq!(speeds(&pilot, at(590)), [None, None, Some(20.0)]);
        for time in (500..1500).step_by(40) {
            press(&mut pilot, KeyCode::Right, at(time));
            assert_eq!(speeds(&pilot, at(time + 39))[YAW], Some(20.0));
        }
        assert_eq!(speeds(&pilot, at(1460 + 190))[YAW], Some(20.0));
        assert_eq!(speeds(&pilot, at(1460 + 210))[YAW], Some(0.0), "it is released");
        // A terminal that reports releases.
        press(&mut pilot, KeyCode::Up, at(2000));
        let release = KeyEvent::new_with_kind(KeyCode::Up, KeyModifiers::NONE, KeyEventKind::Release);
        pilot.press(&release, at(2010));
        assert_eq!(speeds(&pilot, at(2011))[PITCH], Some(0.0));
    }

    #[test]
    fn speed_stop_and_end() {
        let (mut pilot, now) = (Pilot::new(20.0), Instant::now());
        press(&mut pilot, KeyCode::Char('+'), now);
        assert!((pilot.speed() - 30.0).abs() < 1e-6);
        for _ in 0..30 {
            press(&mut pilot, KeyCode::Char('-'), now);
        }
        assert!((pilot.speed() - 0.2).abs() < 1e-6);
        press(&mut pilot, KeyCode::Left, now);
        press(&mut pilot, KeyCode::Char(' '), now);
        assert_eq!(speeds(&pilot, now)[YAW], Some(0.0));
        assert_eq!(press(&mut pilot, KeyCode::Char('x'), now), Wish::GoOn);
        assert_eq!(press(&mut pilot, KeyCode::Char('q'), now), Wish::End);
        let interrupt = KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL);
        assert_eq!(pilot.press(&interrupt, now), Wish::End);
    }
}
